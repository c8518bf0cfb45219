#!/usr/bin/env python3
"""tests/stress/check_dof.py - depth of field far from the usual, and back again, in 60 digits.

tests/stress/check_dof.py BUILD_DIR SECONDS. Random focal lengths of 0.01 mm to 10 m, f-numbers of
0.1 to 1000, circles of confusion of 1e-9 to 1 mm and distances from just outside the focal length
to a light year go through one batch; then near and far limits are given and the setting is solved
for. Decimal arithmetic starts from the doubles that the program reads. Off by one unit is
2^-53 x (condition + 1) of the value, the condition being that of the formula.
"""
# SPDX-License-Identifier: MIT

import csv
import io
import os
import random
import subprocess
import sys
import time
from decimal import Decimal, getcontext

getcontext().prec = 60
ALLOWED = 16
ROWS = 20000
EPS = Decimal(2) ** -53


def batch(program, header, rows, *options):
    text = header + "\n" + "".join(",".join(map(repr, row)) + "\n" for row in rows)
    result = subprocess.run([program, "dof", "--batch", "-", "--csv", *options], input=text,
                            capture_output=True, text=True, check=False)
    if result.returncode not in (0, 3):
        sys.exit(f"FAILED {result.stderr[:500]}\n0 passed, 1 failed")
    return list(csv.DictReader(io.StringIO(result.stdout)))


def limits(f, N, c, s):
    """near and far with their conditions; far None where it is infinite"""
    near_below, far_below = f * f + N * c * (s - f), f * f - N * c * (s - f)
    size = f * f + N * c * (s + f)
    near = s * f * f / near_below
    far = s * f * f / far_below if far_below > 0 else None
    return near, size / near_below, far, size / abs(far_below) if far_below else Decimal("inf")


class Worst:
    def __init__(self, name):
        self.name, self.units, self.row, self.passed, self.failed = name, Decimal(0), None, 0, 0

    def check(self, what, actual, truth, condition, row):
        units = abs(actual - truth) / (EPS * abs(truth) * (condition + 1))
        if units > self.units:
            self.units, self.row = units, (what, row)
        self.verdict(units <= ALLOWED, what, f"{actual}, not {truth:.20}: {units:.3g} units", row)

    def verdict(self, good, what, said, row):
        self.passed += good
        self.failed += not good
        if not good and self.failed <= 10:
            print(f"FAILED {what} {said} for {row}")

    def show(self):
        print(f"{self.name:16} {self.passed + self.failed:9} figures: worst {self.units:.2f} of "
              f"{ALLOWED} units{f' ({self.row[0]} of {self.row[1]})' if self.row else ''}")


def magnitude(draw, low, high):
    return float(f"{low * (high / low) ** draw.random():.{draw.randint(2, 17)}g}")


def forward(program, draw, worst):
    rows = []
    for _ in range(ROWS):
        f = magnitude(draw, 1e-2, 1e4)
        s = magnitude(draw, 1.0001 * f, 1e19) if draw.random() < 0.7 else f * (
            1 + magnitude(draw, 1e-9, 1))
        N = magnitude(draw, 0.1, 1000)
        c = magnitude(draw, 1e-9, min(1, 0.5 * f / N))
        rows.append((f, N, s, c))
    answers = batch(program, "f_mm,N,s_mm,c_mm", rows, "--columns", "near_mm,far_mm,error")
    for row, answer in zip(rows, answers):
        f, N, s, c = map(Decimal, row)
        if answer["error"]:
            worst.verdict(s <= f, "refused", answer["error"], row)
            continue
        near, near_condition, far, far_condition = limits(f, N, c, s)
        input_condition = (s + f) / (s - f) if s < 2 * f else Decimal(1)
        worst.check("near", Decimal(answer["near_mm"]), near, near_condition * input_condition, row)
        condition = far_condition * input_condition
        if condition * EPS > Decimal("0.01"):
            continue  # at the hyperfocal distance to all digits: infinite or not, both are right
        if far is None or answer["far_mm"] == "inf":
            worst.verdict(far is None and answer["far_mm"] == "inf", "far", answer["far_mm"], row)
        else:
            worst.check("far", Decimal(answer["far_mm"]), far, condition, row)


def inverse(program, draw, worst):
    """near and far with the focal length: the f-number and the distance that give them"""
    rows = []
    for _ in range(ROWS):
        f = magnitude(draw, 1, 1000)
        near = magnitude(draw, 1.5 * f, 1e9)
        far = near * (1 + magnitude(draw, 1e-3, 1e3))
        c = magnitude(draw, 1e-6, 1e-1)
        rows.append((f, near, far, c))
    answers = batch(program, "f_mm,near_mm,far_mm,c_mm", rows, "--columns",
                    "fnumber,distance_mm,error")
    for row, answer in zip(rows, answers):
        f, near, far, c = map(Decimal, row)
        # s = 2 n r/(n + r), N c (s - f)(n + r) = f^2 (r - n)
        s = 2 * near * far / (near + far)
        N = f * f * (far - near) / (c * (s - f) * (near + far))
        if answer["error"]:
            worst.verdict(c >= f / N, "refused", answer["error"], row)
            continue
        condition = (far + near) / (far - near) + s / (s - f)
        worst.check("distance", Decimal(answer["distance_mm"]), s, Decimal(1), row)
        worst.check("f-number", Decimal(answer["fnumber"]), N, condition, row)


def main():
    program = os.path.join(os.path.abspath(sys.argv[1]), "lenscalc")
    end = time.monotonic() + float(sys.argv[2])
    draw = random.Random(int(sys.argv[3]) if len(sys.argv) > 3 else 1)
    there, back = Worst("dof"), Worst("dof, inverse")
    while not there.passed or (time.monotonic() < end and there.failed + back.failed < 20):
        forward(program, draw, there)
        inverse(program, draw, back)
    there.show()
    back.show()
    print(f"{there.passed + back.passed} passed, {there.failed + back.failed} failed")
    return there.failed + back.failed != 0


if __name__ == "__main__":
    sys.exit(main())
