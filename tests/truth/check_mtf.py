#!/usr/bin/env python3
"""tests/truth/check_mtf.py - lenscalc mtf against closed forms and integrals of its own here:
check_mtf.py BUILD_DIR

Small round pupils off the axis, whose cut-offs are cos t and cos^3 t of that on it; the closed
form of a round pupil; a fast paraboloid, whose pupil is not even over direction cosines; rings;
and that contrast by waves and by rays fall alike at low frequencies.
"""
# SPDX-License-Identifier: MIT

import csv
import io
import math
import os
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program

WAVE = 587.5618e-6  # mm


def rows(program, words, text=None):
    result = subprocess.run(program.command + ["mtf"] + words + ["--csv"], input=text, text=True,
                            capture_output=True, env=program.environment())
    table = list(csv.DictReader(io.StringIO(result.stdout)))
    if not table:
        sys.exit(result.stderr)
    return table


def near(checks, name, actual, expected, allowed):
    try:
        error = abs(float(actual) - expected)
    except ValueError:
        error = math.inf
    checks.check(error <= allowed, f"{name} is {actual}, expected {expected} within {allowed:.3g}")


def closed(s):
    return 0 if s >= 1 else 2 / math.pi * (math.acos(s) - s * math.sqrt(1 - s * s))


def check_obliquity(checks, program):
    """A concave mirror that images what stands beside its centre on the other side of that, all but
    without aberrations, as it is so small."""
    radius, distance = 0.01, 200
    for tangent in (0, 0.3, 0.7):
        lens = (f"lens speck\nwavelength d\nobject {distance}\nfield height {tangent * distance}\n"
                f"aperture stop\nsurface {-distance} {-distance} mirror {2 * radius} stop\n")
        cosine = 1 / math.hypot(1, tangent)
        axis = 2 * radius / distance / WAVE
        for share in (0.2, 0.5, 0.9):
            for power, column in ((3, "tangential"), (1, "sagittal")):
                cutoff = axis * cosine ** power
                words = ["-", "--focus", str(-distance), "--frequency", repr(share * cutoff)]
                row = rows(program, words, lens)[0]
                name = f"speck, tan {tangent}, {column}"
                near(checks, name + " cut-off", row.get(f"cutoff_{column}_per_mm", ""), cutoff,
                     1e-6 * cutoff)
                near(checks, name, row[column], closed(share), 2e-5)


def paraboloid(f, radius, shift):
    """Overlap of the pupil of a paraboloid: y = 2 f tan(u/2), A^2 = y dy/(a da), a = sin u."""
    def square(a):
        u = math.asin(min(a, 1))
        y, slope = 2 * f * math.tan(u / 2), f / math.cos(u / 2) ** 2 / math.cos(u)
        return f * f if a < 1e-9 else y * slope / a

    edge = math.sin(2 * math.atan(radius / (2 * f)))
    reach, count, total = edge * edge - shift * shift / 4, 160, 0.0
    if reach <= 0:
        return 0
    high = math.sqrt(reach)
    for i in range(count):  # Gauss and Chebyshev across, midpoints along
        turn = math.pi * ((i + 0.5) / count - 0.5)
        t = high * math.sin(turn)
        length = math.sqrt(edge * edge - t * t) - shift / 2
        for k in range(count):
            s = length * (2 * (k + 0.5) / count - 1)
            a = math.hypot(s - shift / 2, t), math.hypot(s + shift / 2, t)
            total += (math.sqrt(square(a[0]) * square(a[1])) * 2 * length / count
                      * high * math.cos(turn) * math.pi / count)
    return total / (math.pi * radius * radius)


def check_paraboloid(checks, program):
    for f, radius in ((100, 25), (100, 60)):
        lens = (f"lens dish\nwavelength d\nobject inf\naperture stop\n"
                f"surface {-2 * f} {-f} mirror {2 * radius} k=-1 stop\n")
        edge = math.sin(2 * math.atan(radius / (2 * f)))
        for share in (0.1, 0.4, 0.8):
            words = ["-", "--field", "0", "--focus", str(-f), "--error", "1e-7", "--frequency",
                     repr(share * 2 * edge / WAVE)]
            near(checks, f"paraboloid, {radius} mm, {share}", rows(program, words, lens)[0]["sagittal"],
                 paraboloid(f, radius, share * 2 * edge), 2e-5)


def ring(s, hole):
    """O'Neill's overlap of rings is that of discs, less, and more."""
    def lens_area(a, b, d):
        if d >= a + b:
            return 0
        if d <= abs(a - b):
            return math.pi * min(a, b) ** 2
        x = (d * d + a * a - b * b) / (2 * d)
        y = d - x
        return (a * a * math.acos(x / a) - x * math.sqrt(a * a - x * x)
                + b * b * math.acos(y / b) - y * math.sqrt(b * b - y * y))
    d = 2 * s
    whole = lens_area(1, 1, d) - 2 * lens_area(1, hole, d) + lens_area(hole, hole, d)
    return whole / (math.pi * (1 - hole * hole))


def check_ring(checks, program):
    """A disc before a slow paraboloid."""
    radius, hole = 1, 0.4
    lens = (f"lens ring\nwavelength d\nobject inf\naperture stop\n"
            f"surface - 50 air 3\nblock circle {2 * hole * radius}\n"
            f"surface -2000 -1000 mirror {2 * radius} k=-1 stop\n")
    for share in (0.05, 0.25, 0.5, 0.65, 0.9):
        words = ["-", "--field", "0", "--focus", "-1000", "--frequency",
                 repr(share * 2 * radius / 1000 / WAVE)]
        row = rows(program, words, lens)[0]
        for column in ("tangential", "sagittal"):
            near(checks, f"ring, {share}, {column}", row[column], ring(share, hole), 2e-5)


def check_rays(checks, program):
    """Contrast by waves is that of a perfect pupil times that by rays, as long as both are near 1."""
    for lens, words in (("double-gauss", ["-N", "4", "--field", "10"]),
                        ("cooke-triplet-50", ["--field", "15"])):
        for frequency in ("0.5", "1"):
            both = [rows(program, [lens, *words, "-w", "d", "--frequency", frequency, "--method", way])
                    [0] for way in ("diffraction", "geometric")]
            for column in ("tangential", "sagittal"):
                limit = float(both[0]["limit_" + column])
                loss = 1 - float(both[1][column])
                near(checks, f"{lens}, {frequency}/mm, {column}", both[0][column],
                     limit * float(both[1][column]), 0.02 * loss + 1e-5)


def curves(program, words, error):
    """Contrasts of the curves of --plot, from the drawing."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "mtf.svg")
        subprocess.run(program.command + ["mtf", *words, "--error", error, "--plot", path],
                       stdout=subprocess.DEVNULL, check=True, env=program.environment())
        with open(path, encoding="utf-8") as file:
            lines = re.findall('<path d="M([-0-9. L]*)"', file.read())
    points = [[float(x) for x in line.replace("L", " ").split()] for line in lines]
    frame = (88, 440)  # y of contrast 1 and 0
    return [[(frame[1] - y) / (frame[1] - frame[0]) for y in line[1::2]] for line in points
            if len(line) == 2 * 61]


def check_curves(checks, program):
    """What is drawn from one sampling of the pupil is what overlaps one by one give."""
    for words in (["cooke-triplet-50", "-w", "d", "--field", "0,20"], ["questar-35", "-w", "d"],
                  ["double-gauss", "-N", "8", "--field", "14"]):
        drawn, exact = curves(program, words, "1e-4"), curves(program, words, "9e-5")
        checks.check(len(drawn) == len(exact) >= 3, f"{words}: {len(drawn)} curves")
        worst = max(abs(a - b) for x, y in zip(drawn, exact) for a, b in zip(x, y))
        checks.check(worst < 1e-3, f"{words}: curves are {worst} off")


def main():
    program, checks = Program(sys.argv[1]), Checks()
    check_obliquity(checks, program)
    check_paraboloid(checks, program)
    check_ring(checks, program)
    check_rays(checks, program)
    check_curves(checks, program)
    checks.finish()


if __name__ == "__main__":
    main()
