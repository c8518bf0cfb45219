#!/usr/bin/env python3
"""tests/truth/check_designs.py - crude starts end at lenses: check_designs.py BUILD_DIR

Each file of designs/ is a start as a designer writes it down: plates, thin lenses, spheres. One
command has to end at a lens whose spots stay below a limit at nine fields, of which most lie
between those it was optimised for, by all the rays that `spot` takes, with the focal length (of a
near object the magnification) that was asked for and what was asked of its edges and gaps. Limits
are half as much again as the best known lens of the same start, or what such lenses are used for.

Where ../shared has open cases with a judge of its own, they are judged too (with numpy), all of
them with LENSCALC_ALL.
"""
# SPDX-License-Identifier: MIT

import os
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import EVERYTHING, SHARED, Checks, Program

HERE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "designs")
SHARES = (0, 0.17, 0.33, 0.5, 0.62, 0.75, 0.87, 0.96, 1)  # of the largest field
# start, words beside it, the option of fields and the largest, what lens or conjugate have to say
# in each position, largest mean spot in um
CASES = (
    ("triplet", "", "--field", 20, {"efl_mm": [50]}, 20),
    ("dgauss", "", "--field", 22, {"efl_mm": [50]}, 29),
    ("telephoto", "", "--field", 6, {"efl_mm": [200]}, 18),
    ("retrofocus", "", "--field", 37, {"efl_mm": [28]}, 8),
    ("zoom", "", "--height", 14, {"efl_mm": [35, 60, 105]}, 8),
    ("asphere", "", "--field", 0, {"efl_mm": [20]}, 0.1),
    ("schmidt", "", "--field", 1, {"efl_mm": [200]}, 4),
    ("rc", "", "--field", 0.3, {"efl_mm": [1000]}, 2),
    ("eyepiece", "", "--field", 22, {"efl_mm": [25]}, 18),
    ("scan", "", "--field", 20, {"efl_mm": [160]}, 1.5),
    ("relay", "", "--height", 8, {"magnification": [-1]}, 21),
    ("phone", "--global 8", "--field", 35, {"efl_mm": [3.6]}, 5),
)
WITHIN = 0.005  # of focal lengths
MISSED = 1  # deviations by which a goal may be missed


def check_case(checks, program, folder, case):
    name, words, option, field, figures, limit = case
    end = os.path.join(folder, f"{name}-end.lens")
    ask = ["optimize", os.path.join(HERE, f"{name}.lens"), *words.split()]
    result = program.run(*ask, "-o", end, timeout=120)
    ends = [path for path in (end, end[:-5] + "-1.lens") if os.path.exists(path)]
    if not checks.check(result.returncode == 0 and ends, f"{name}: {result.stderr.decode()[:300]}"):
        return
    fields = ",".join(f"{field * share:.6g}" for share in SHARES)
    rows = program.rows("spot", ends[0], "--position", "all", option, fields)
    lens = program.rows("conjugate" if "magnification" in figures else "lens", ends[0],
                        "--position", "all", "-w", "d" if name not in ("asphere", "scan") else "633")
    if not checks.check(not isinstance(rows, str), f"{name}: {rows}"):
        return
    mean = (sum(float(row["rms_um"]) ** 2 for row in rows) / len(rows)) ** 0.5
    checks.check(mean <= limit, f"{name}: spots of {mean:.4g} um, not {limit}")
    for figure, wanted in figures.items():
        for row, target in zip(lens, wanted):
            checks.check(abs(float(row[figure]) / target - 1) < WITHIN,
                         f"{name}: {figure} {row[figure]}, not {target}")


def check_open_cases(checks, program):
    judge = os.path.join(SHARED, "data", "design", "judge.py")
    python = next((path for path in ("/usr/bin/python3", sys.executable) if subprocess.run(
        [path, "-c", "import numpy"], capture_output=True).returncode == 0), None)
    if not os.path.exists(judge) or python is None:
        print("the open cases: skipped, no judge or no numpy")
        return
    cases = [] if EVERYTHING else ["achromat-plates", "asphere-f12", "double-gauss-60"]
    result = subprocess.run([python, judge, program.binary, *cases], capture_output=True, text=True)
    checks.check(result.returncode == 0, f"open cases: {result.stdout}")


def main():
    checks, program = Checks(), Program(sys.argv[1])
    with tempfile.TemporaryDirectory(prefix="lenscalc-designs-") as folder:
        for case in CASES if EVERYTHING else [case for case in CASES if not case[1]]:
            check_case(checks, program, folder, case)
    check_open_cases(checks, program)
    checks.finish()


if __name__ == "__main__":
    main()
