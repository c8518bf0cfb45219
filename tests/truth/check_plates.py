#!/usr/bin/env python3
"""tests/truth/check_plates.py - radii fitted to test plates, by trying them all:
check_plates.py BUILD_DIR

Of a short list every combination of plates and signs is put into the lens and what varies still is
optimised by itself: none is better than the one that was chosen. Plates that are too small are not
taken, however near their radii are.
"""
# SPDX-License-Identifier: MIT

import itertools
import math
import os
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program

DOUBLET = """wavelength d F C
field angle 0 1
aperture epd 20
focus table
surface {0} 6 {glass} 22 stop
surface {1} 3 N-SF5 22
surface {2} 96 air 22
"""
GOALS = ("--goals", "poly,efl=100:0.1")
SMALL = [(61.5, 21), (44, 12), (161, 5)]  # radius, diameter: none covers 22 mm
PLATES = [(55, 30), (46, 25), (62.3, 40), (150, 60), (118, 22), (210, 50)]


def write(name, text):
    with open(name, "w") as file:
        file.write(text)
    return name


def table(plates, unit="mm", scale=1.0):
    return f"# a maker\nradius_{unit}\tname\tdiameter_{unit}\n" + "".join(
        f"{r / scale!r}\tP{i}\t{d / scale!r}\n" for i, (r, d) in enumerate(plates))


def lens_of(radii, glass="N-BK7"):
    return DOUBLET.format(*radii, glass=glass)


def surfaces(name):
    with open(name) as file:
        return [line.split() for line in file if line.startswith("surface")]


def check_best(checks, program):
    start = write("start.lens", lens_of((61, -44, -130)))
    maker = write("plates.tsv", table(PLATES + SMALL))
    asked = ("optimize", start, *GOALS, "--vary", "R1,R2,R3,t3", "--test-plates", maker)
    rows = program.rows(*asked, "--show", "plates", "-o", "found.lens")
    if not checks.check(isinstance(rows, list), rows):
        return
    answer = program.rows(*asked)[0]
    found = float(answer["merit_after"])
    radii = [float(words[1]) for words in surfaces("found.lens")]
    for radius in radii:
        checks.check(abs(radius) in [r for r, d in PLATES], f"{radius} is of no plate")
    for one, after in zip(rows, rows[1:]):
        checks.check(one["merit_after"] == after["merit_before"] or one["loss"] == "",
                     f"rows do not join: {rows}")
    checks.near("same", "the last row", rows[-1]["merit_after"], found, 1e-9 * found)
    last = {row["surface"]: float(row["radius_mm"]) for row in rows}
    checks.check([last[str(i + 1)] for i in range(3)] == radii, f"rows {last}, lens {radii}")
    free = program.rows("optimize", start, *GOALS, "--vary", "R1,R2,R3,t3")[0]["merit_after"]
    checks.near("loss", "of all rows", sum(float(row["loss"] or 0) for row in rows),
                found - float(free), 1e-9 * found)
    # the lens as it is written; and all others of these signs, and some of others
    written = program.rows("optimize", "found.lens", *GOALS, "--vary", "t3")[0]["merit_before"]
    checks.near("written", "the lens", written, found, 1e-6 * found)
    best = math.inf, None
    for some in itertools.product([r for r, d in PLATES], repeat=3):
        for signs in ((1, -1, -1), (1, -1, 1)):
            trial = [sign * radius for sign, radius in zip(signs, some)]
            if abs(trial[0]) > 120 or abs(trial[1]) > 120:
                continue  # no doublet of this focal length
            rows = program.rows("optimize", write("one.lens", lens_of(trial)), *GOALS, "--vary",
                                "t3", "--columns", "merit_after")
            if isinstance(rows, list):
                best = min(best, (float(rows[0]["merit_after"]), trial))
    checks.check(found <= best[0] * (1 + 1e-6), f"{found} with {radii}, {best} is better")
    # the same list in inches
    inches = write("inches.tsv", table(PLATES + SMALL, "in", 25.4))
    again = program.rows(*asked[:-1], inches)[0]
    checks.near("inches", "merit", again["merit_after"], found, 1e-9 * found)


def check_glasses(checks, program):
    """The glasses first: what they are is what they are without plates."""
    start = write("model.lens", lens_of((61, -44, -130), "1.52/62"))
    maker = write("plates.tsv", table(PLATES))
    asked = ("optimize", start, *GOALS, "--vary", "R1,R2,R3,t3,glass1", "--glasses",
             "N-BK7,N-SK2,N-PSK53A")
    alone = program.rows(*asked, "-o", "glass.lens")
    both = program.rows(*asked, "--test-plates", maker, "-o", "both.lens")
    if not checks.check(isinstance(alone, list) and isinstance(both, list), f"{alone} {both}"):
        return
    glasses = [[words[3] for words in surfaces(name)] for name in ("glass.lens", "both.lens")]
    checks.check(glasses[0] == glasses[1], f"glasses {glasses}")
    radii = [abs(float(words[1])) for words in surfaces("both.lens")]
    checks.check(all(radius in [r for r, d in PLATES] for radius in radii), f"radii {radii}")
    searched = program.rows(*asked, "--test-plates", maker, "--global", "2", "--rays", "9",
                            "--spread", "0.1", "-o", "search.lens")
    checks.check(isinstance(searched, list), searched)
    radii = [abs(float(words[1])) for words in surfaces("search.lens")]
    checks.check(all(radius in [r for r, d in PLATES] for radius in radii), f"searched {radii}")


BAD = [("radius_mm\tdiameter_mm\n-50\t30\n", 4, b"radius_mm '-50' is no radius above 0"),
       ("radius_mm\tdiameter_mm\n50\t0\n", 4, b"diameter_mm '0' is no diameter above 0"),
       ("radius_mm\tdiameter\n50\t30\n", 4, b"there is no column diameter_mm"),
       ("radius_mm\tdiameter_mm\n", 4, b"there is no plate in it"),
       ("radius_mm\tdiameter_mm\n50\t21.9\n", 1, b"no test plate is as large")]


def check_bad(checks, program):
    start = write("start.lens", lens_of((61, -44, -130)))
    words = ("optimize", start, *GOALS, "--vary", "R1,R2,R3,t3")
    for text, status, message in BAD:
        result = program.run(*words, "--test-plates", write("bad.tsv", text))
        checks.check(result.returncode == status and message in result.stderr,
                     f"{text!r}: {result.returncode} {result.stderr.decode()}")
    plates = write("plates.tsv", table(PLATES))
    held = program.run("optimize", start, *GOALS, "--vary", "t3", "--test-plates", plates)
    checks.check(held.returncode == 1 and b"no radius of a sphere varies" in held.stderr, held)
    none = program.run(*words, "--show", "plates")
    checks.check(none.returncode == 2 and b"needs --test-plates" in none.stderr, none)


def main():
    checks, program = Checks(), Program(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        check_best(checks, program)
        check_glasses(checks, program)
        check_bad(checks, program)
    checks.finish()


if __name__ == "__main__":
    main()
