#!/usr/bin/env python3
"""tests/truth/check_stack.py - the shots of focus stacks by closed forms: check_stack.py BUILD_DIR

A thin lens with pupils of equal size, focused at s, images with m = f/(s - f); what is sharp reaches
from f + f (1 + m)/(m + e) to f + f (1 + m)/(m - e) less f, with e = N c/f, as textbooks have it.
"""
# SPDX-License-Identifier: MIT

import math
import os
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program

C = math.hypot(36, 24) / 1500  # mm
# question, f, N, c in mm, magnification of the first shot, near and far end in mm; None: not pinned
STACKS = (
    ("-f 100 -N 8 --near 30cm --far 33cm", 100, 8, C, None, 300, 330),
    ("-f 100 -N 8 --near 30cm --dof 3cm", 100, 8, C, None, 300, 330),
    ("-f 100 -N 8 --far 33cm --dof 3cm", 100, 8, C, None, 300, 330),
    ("-f 100 -N 5.6 -m 1:1 --dof 5mm", 100, 5.6, C, 1, None, None),
    ("-f 100 -N 5.6 -m 1:1 --far 205mm", 100, 5.6, C, 1, None, 205),
    ("-f 60 -N 4 -m 2 --dof 0.01mm", 60, 4, C, 2, None, None),
    ("-N 8 -m 1:2 --near 30cm --far 305mm", None, 8, C, 0.5, 300, 305),
    # H = f^2/(N c) + f
    ("-f 100 --hyperfocal 30.1m -m 1:1 --dof 2mm", 100, 1e4 / (3e4 * C), C, 1, None, None),
    ("-f 100 -N 8 --hyperfocal 30.1m --near 30cm --far 31cm", 100, 8, 1e4 / (3e4 * 8), None,
     300, 310),
)
REFUSED = (
    ("-f 100 -N 8 --near 30cm --far 33cm -m 1:1", "leave out --near, --magnification"),
    ("-f 100 -N 8 --near 30cm --far 33cm --dof 3cm", "the third follows"),
    ("-f 100 -N 8 -c 0.03 --near 30cm --far 33cm --hyperfocal 30m", "leave out"),
    ("-f 100 -N 8 -m 1:1", "needs two of --near, --far and --dof"),
    ("-f 100 -N 8 -m 1:1 --near 199mm", "--stack has no end"),
    ("-f 100 -N 8 -m 1:1 --dof 5mm -s 0.2", "no --distance of its own"),
)


def check_shots(checks, name, rows, stack):
    _, f, N, c, m, near, far = stack
    f = f or float(rows[0]["focal_mm"])
    e = N * c / f
    limits = []
    for row in rows:
        s = 1000 * float(row["distance_m"])
        scale = f / (s - f)
        limits.append([f * (1 + scale) / (scale + sign * e) for sign in (1, -1)])
        for column, value in zip(("near_m", "far_m"), limits[-1]):
            checks.near("limit", f"{name}: {column}", 1000 * float(row[column]), value, 1e-9 * value)
    for before, after in zip(limits, limits[1:]):
        checks.check(after[0] <= before[1], f"{name}: a gap between {before} and {after}")
    if m is not None:
        checks.near("m", f"{name}: magnification", rows[0]["magnification"], m, 1e-12 * m)
    depth = [word for word, before in zip(name.split(), [None, *name.split()]) if before == "--dof"]
    if near is not None and len(rows) > 1:
        checks.near("end", f"{name}: near end", limits[0][0], near, 1e-9 * near)
    if far is not None and len(rows) > 1:
        checks.near("end", f"{name}: far end", limits[-1][1], far, 1e-9 * far)
    if depth and len(rows) > 1:
        wanted = float(depth[0].rstrip("cm")) * (10 if depth[0].endswith("cm") else 1)
        checks.near("depth", f"{name}: depth", limits[-1][1] - limits[0][0], wanted, 1e-7 * wanted)


def main():
    checks, program = Checks(), Program(sys.argv[1])
    for stack in STACKS:
        rows = program.rows("dof", *stack[0].split(), "--stack")
        if checks.check(not isinstance(rows, str), f"{stack[0]}: {rows}"):
            check_shots(checks, stack[0], rows, stack)
    for question, words in REFUSED:
        result = program.run("dof", *question.split(), "--stack")
        checks.check(result.returncode == 2 and words in result.stderr.decode(),
                     f"{question}: {result.returncode} {result.stderr.decode()[:150]}")
    checks.finish()


if __name__ == "__main__":
    main()
