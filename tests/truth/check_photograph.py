#!/usr/bin/env python3
"""tests/truth/check_photograph.py - pictures of lenscalc render: check_photograph.py BUILD_DIR

A white card gives the irradiance of an independent program's quadrature (the course's double
Gauss), pixel by pixel; exposure is luminance times time times that. A small white square comes
where the magnification of thin-lens algebra puts it, upside up. The error falls faster than
random numbers let it. Threads change nothing.
"""
# SPDX-License-Identifier: MIT

import math
import os
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program
from photographs import DOUBLE_GAUSS, IRRADIANCE, MEAN, on_diagonal, take, write_pfm



def check_white(checks, program, folder):
    """Green of every film radius, with 1000 cd/m2 and 1/100 s: H = 10 E/L."""
    write_pfm(os.path.join(folder, "white.pfm"), [[1.0, 1.0], [1.0, 1.0]])
    common = ["white.pfm", "--lens", DOUBLE_GAUSS, "-s", "10m", "-t", "0.01", "-w", "d",
              "--field-width", "60m", "--samples", "1024"]
    rows = take(program, checks, folder, *common, "--focus", "36.105905", "--size", "90x60")
    if rows is None:
        return
    for radius, expected in IRRADIANCE.items():
        found = on_diagonal(rows, 36, radius) / 10
        # one ray of a hundred is lost, so that 4 x 1024 know it to 1.5e-3 at 1 sigma
        checks.check(abs(found - expected) < 5e-3 * expected,
                     f"E/L at {radius} mm is {found}, expected {expected}")
    rows = take(program, checks, folder, *common, "--focus", "36.3612", "--size", "45x30")
    if rows is not None:
        mean = sum(pixel[1] for row in rows for pixel in row) / (45 * 30) / 10
        checks.check(abs(mean - MEAN) < 1e-4, f"mean E/L is {mean}, expected {MEAN}")


def check_small(checks, program, folder):
    """A pupil far smaller than its way over the film from one row to the next: E/L = pi/4 N^2."""
    write_pfm(os.path.join(folder, "white.pfm"), [[1.0, 1.0], [1.0, 1.0]])
    for number in 128, 1000:
        rows = take(program, checks, folder, "white.pfm", "--lens", DOUBLE_GAUSS, "-s", "10m",
                    "-N", str(number), "-t", "1", "-w", "d", "--field-width", "60m", "--focus",
                    "36.105905", "--size", "91x61", "--samples", "16")
        if rows is not None:
            expected, found = 1000 * math.pi / 4 / number ** 2, rows[30][45][1]
            checks.check(abs(found - expected) < 0.01 * expected,
                         f"{found} lx s at f/{number}, expected {expected}")
            # 16 mm from the axis .0715 of .1925 is left wide open, and more of small pupils
            checks.check(min(row[5][1] for row in rows) > 0.5 * expected, f"f/{number} is dark")
    result = program.run("render", "--lens", DOUBLE_GAUSS, "-N", "20000", "-w", "d", "--samples",
                         "1024", "--rays", "small.csv", cwd=folder)
    checks.check(b"of the rays arrive" in result.stderr, f"f/20000: {result.stderr}")


def check_place(checks, program, folder):
    """One pixel of 100 x 100 on a card 2 m wide, 10 m from the front principal plane, at f/22."""
    card = [[0.0] * 100 for _ in range(100)]
    card[46][53] = 1.0  # 70 mm to the right and 70 mm up, from its middle
    write_pfm(os.path.join(folder, "spot.pfm"), card)
    rows = take(program, checks, folder, "spot.pfm", "--lens", DOUBLE_GAUSS, "-s", "10m", "-N",
                "22", "--field-width", "2m", "--sensor", "9x6mm", "--size", "180x120", "-w", "d",
                "--samples", "64")
    if rows is None:
        return
    total = sum(pixel[0] for row in rows for pixel in row)
    x = sum(pixel[0] * (i + 0.5) for row in rows for i, pixel in enumerate(row)) / total
    y = sum(pixel[0] * (j + 0.5) for j, row in enumerate(rows) for pixel in row) / total
    f = 50.358167  # mm, of this lens in golden figures
    size = 70 * f / (10000 - f) / 0.05  # pixels of 0.05 mm
    checks.check(abs(x - 90 - size) < 0.02 and abs(60 - y - size) < 0.02,
                 f"the spot lies {x - 90:.3f} right and {60 - y:.3f} up, expected {size:.3f}")


def check_error(checks, program, folder):
    """Of a checkerboard out of focus, against 4096 rays a pixel."""
    common = ["chart:checker", "--lens", DOUBLE_GAUSS, "-s", "1m", "--defocus", "0.5", "-t", "0.01",
              "--size", "24x16", "-w", "d"]
    best = take(program, checks, folder, *common, "--samples", "4096", "--seed", "9")
    errors = []
    for samples in 4, 64:
        rows = take(program, checks, folder, *common, "--samples", str(samples))
        errors.append(math.sqrt(sum((a[0] - b[0]) ** 2 for row, other in zip(rows, best)
                                    for a, b in zip(row, other))))
    slope = math.log(errors[1] / errors[0]) / math.log(16)
    checks.check(slope <= -0.7, f"the error falls with the power {slope:.2f} of the samples")


def check_threads(checks, program, folder):
    common = ["chart:star", "--lens", "nikkor-z-58-f095", "-s", "1m", "--size", "70x40",
              "--samples", "4"]
    one = take(program, checks, folder, *common, name="one.pfm")
    two = take(program, checks, folder, *common, "--threads", "2", name="two.pfm")
    checks.check(one == two, "two threads take another picture than one")
    other = take(program, checks, folder, *common, "--seed", "1", name="three.pfm")
    checks.check(one != other, "another seed takes the same picture")


def check_light(checks, program, folder):
    """A Lambertian white in 81920 lx, EV 15; an 85B, 131 mired, by Wien's law at both ends."""
    write_pfm(os.path.join(folder, "white.pfm"), [[1.0, 1.0], [1.0, 1.0]])
    common = ["white.pfm", "--lens", DOUBLE_GAUSS, "-s", "10m", "-t", "0.01", "--size", "8x8",
              "--samples", "1"]
    plain = take(program, checks, folder, *common)
    light = take(program, checks, folder, *common, "--ev", "15")
    amber = take(program, checks, folder, *common, "--filter", "wratten-85b")
    if None in (plain, light, amber):
        return
    kelvin, second = 5500, 0.014387769  # m K
    warmer = 1e6 / (1e6 / kelvin + 131)
    for k, wavelength in enumerate((611e-9, 549e-9, 464e-9)):
        wien = [math.exp(-second / (length * warmer)) / math.exp(-second / (length * kelvin))
                for length in (wavelength, 555e-9)]
        through = 2 ** -0.667 * wien[0] / wien[1]
        found = amber[4][4][k] / plain[4][4][k]
        checks.check(abs(found / through - 1) < 1e-5, f"85B: {found}, expected {through}")
        found = light[4][4][k] / plain[4][4][k] * 1000
        checks.check(abs(found * math.pi / 81920 - 1) < 1e-5, f"white in EV 15: {found} cd/m2")


def main():
    program, checks = Program(sys.argv[1]), Checks()
    with tempfile.TemporaryDirectory(prefix="lenscalc-photograph-") as folder:
        check_white(checks, program, folder)
        check_small(checks, program, folder)
        check_place(checks, program, folder)
        check_error(checks, program, folder)
        check_threads(checks, program, folder)
        check_light(checks, program, folder)
    return checks.finish()


if __name__ == "__main__":
    sys.exit(main())
