#!/usr/bin/env python3
"""tests/truth/check_stop_size.py - stops of the size of the exact marginal ray:
check_stop_size.py BUILD_DIR

A ray of the axis through the edge of such a stop has entered as the aperture says: at half the
entrance pupil's diameter, f/(2N), or with the sine of the numerical aperture; and a ray that is
traced here, by Snell's law in a plane through spheres, from there meets the stop at the edge that
is printed. Through a stop of the paraxial size it has not: that is said.
"""
# SPDX-License-Identifier: MIT

import json
import math
import os
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program

# radius, thickness, index behind; the stop is the plane
FAST = [(40, 8, 1.62), (-300, 18, 1), (0, 6, 1), (-40, 2, 1.7), (90, 20, 1)]
STOP = 2


def write(name, aperture, head=""):
    with open(name, "w") as file:
        file.write(f"wavelength d\n{head}aperture {aperture}\n")
        for i, (radius, gap, n) in enumerate(FAST):
            word = "stop -" if i == STOP else f"surface {radius}"
            file.write(f"{word} {gap} {n if n != 1 else 'air'} -\n")
    return name


def paraxial(y, u):
    n = 1
    for radius, gap, behind in FAST:
        u = (n * u - y * (behind - n) * (1 / radius if radius else 0)) / behind
        n, y = behind, y + gap * u
    return u


def height_in_stop(y, u):
    """Of a meridional ray that crosses the plane of the first vertex at y with the angle u."""
    z, n = 0.0, 1.0
    for i, (radius, gap, behind) in enumerate(FAST):
        if radius:
            # the sphere about (radius, 0): points (z + s cos u, y + s sin u)
            b = (z - radius) * math.cos(u) + y * math.sin(u)
            c = (z - radius) ** 2 + y * y - radius * radius
            s = -b - math.copysign(math.sqrt(b * b - c), radius)
        else:
            s = -z / math.cos(u)
        z, y = z + s * math.cos(u), y + s * math.sin(u)
        if i == STOP:
            return y
        normal = math.asin(y / radius)  # of the surface there, against the axis
        u = math.asin(n / behind * math.sin(u + normal)) - normal
        z, n = z - gap, behind
    return None


def edge(program, lens, *words):
    """The ray of the axis through the upper edge of the stop, before the lens and in the stop."""
    rows = program.rows("trace", lens, "--field", "0", "--pupil-point", "0:1", "--all", *words)
    if not isinstance(rows, list):
        return rows
    warned = "paraxial marginal ray" in rows[0]["warning"]
    return [float(rows[0]["y_mm"]), float(rows[STOP]["y_out_mm"])], warned


def check_rays(checks, program):
    for aperture in ("f/5", "f/6.3", "epd 30"):
        lens = write("fast.lens", aperture)
        efl = -1 / paraxial(1.0, 0.0)
        half = 15 if aperture == "epd 30" else efl / float(aperture[2:]) / 2
        got = edge(program, lens, "--stop-size", "real")
        if not checks.check(isinstance(got, tuple), got):
            continue
        checks.near("entrance", aperture, got[0][0], half, 1e-9 * half)
        checks.near("rim", aperture, got[0][1], height_in_stop(half, 0.0), 1e-9 * half)
        before = edge(program, lens)
        off = abs(before[0][0] / half - 1)
        checks.check(off > 1e-3 and before[1] == (off > 0.02) and not got[1],
                     f"{aperture}: {before} {off}")
        # as a word of the file, of which the option may ask otherwise
        word = write("word.lens", aperture + " real")
        checks.check(edge(program, word)[0] == got[0], f"{aperture} real: {edge(program, word)}")
        checks.check(edge(program, word, "--stop-size", "paraxial")[0] == before[0], "paraxial")
    # a near object: the sine
    near = write("near.lens", "na 0.08 real", "object 200\n")
    got = edge(program, near)
    if checks.check(isinstance(got, tuple), got):
        u = math.asin(0.08)
        wanted = height_in_stop(200 * math.tan(u), u)
        checks.near("stop", "na 0.08", got[0][1], wanted, 1e-9 * wanted)


def check_files(checks, program):
    lens = write("fast.lens", "f/5")
    program.run("convert", lens, "--stop-size", "real", "-o", "real.lens")
    with open("real.lens") as file:
        checks.check("f/5 real\n" in file.read(), "convert writes no 'real'")
    program.run("convert", "real.lens", "-o", "real.json")
    with open("real.json") as file:
        checks.check(json.load(file).get("stop_is_real") is True, "the JSON has no stop_is_real")
    program.run("convert", "real.json", "-o", "again.lens")
    with open("real.lens") as one, open("again.lens") as other:
        checks.check([line for line in one if line.startswith("aperture")] ==
                     [line for line in other if line.startswith("aperture")], "by JSON and back")
    # the stop's own diameter is that of any ray
    own = write("own.lens", "stop")
    with open(own) as file:
        text = file.read().replace("stop - 6 air -", "stop - 6 air 20")
    with open(own, "w") as file:
        file.write(text)
    checks.check(edge(program, own, "--stop-size", "real")[0] == edge(program, own)[0], "own")


def check_design(checks, program):
    """What is found has the merit of the lens that is written, and is better than the other."""
    lens = write("fast.lens", "f/5", "field angle 0 2\n")
    asked = ("--vary", "R1,R2,R4,R5", "--goals", "poly,efl=212")
    merits = {}
    for size in ("real", "paraxial"):
        rows = program.rows("optimize", lens, *asked, "--stop-size", size, "-o", f"{size}.lens",
                            "--force")
        if checks.check(isinstance(rows, list), rows):
            merits[size] = float(rows[0]["merit_after"])
    again = program.rows("optimize", "real.lens", *asked)[0]
    checks.near("written", "merit", again["merit_before"], merits["real"], 1e-7 * merits["real"])
    other = program.rows("optimize", "paraxial.lens", *asked, "--stop-size", "real")[0]
    checks.check(float(other["merit_before"]) > merits["real"] * (1 + 1e-6), f"{other} {merits}")


REFUSED = [(("lens",), b"traces no rays that fill the stop"),
           (("seidel",), b"traces no rays that fill the stop"),
           (("dof", "-s", "3", "-N", "8", "--lens"), b"needs --exact"),
           (("convert", "--to", "zmx"), b"the word 'real' of the aperture"),
           (("convert", "--reverse"), b"the stop has the size of a real ray"),
           (("spot", "-N", "1.2"), b"the marginal ray of the aperture is lost at surface")]


def check_refused(checks, program):
    lens = write("fast.lens", "f/5")
    for words, message in REFUSED:
        result = program.run(*words, lens, "--stop-size", "real")
        checks.check(result.returncode != 0 and message in result.stderr,
                     f"{words}: {result.stderr.decode()}")


def main():
    checks, program = Checks(), Program(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        check_rays(checks, program)
        check_files(checks, program)
        check_design(checks, program)
        check_refused(checks, program)
    checks.finish()


if __name__ == "__main__":
    main()
