#!/usr/bin/env python3
"""tests/truth/check_seidel.py - Seidel and chromatic sums against numbers from outside:
check_seidel.py BUILD_DIR [--write]

seidel.json: systems as .lens files, with the values by surface of an independent 50-digit program;
where ../shared is here too, seidel.json must hold every case of its truth (--write makes it anew).
Each value must be within 16 x 2^-53 of itself, or within 1e-30 of the largest of its lens where it
vanishes: the sums are made in pairs of doubles, so that nothing is lost where terms cancel.
"""
# SPDX-License-Identifier: MIT

import csv
import io
import os
import sys
from fractions import Fraction

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import reference
from harness import ROOT, Checks, Program

OWN = "tests/truth/seidel.json"
UNIT = Fraction(1, 2 ** 53)
ALLOWED = 16
SUMS = ("S1", "S2", "S3", "S4", "S5", "C1", "C2")
ASPHERES = ("asphere_S1", "asphere_S2", "asphere_S3", "asphere_S5")
TRANSVERSE = ("TSC", "CC_s", "CC_t", "TAC", "TPC", "DC", "TAchC", "TchC")
WAVES = ("W040", "W131", "W222", "W220", "W311", "W020c", "W111c")


# -------- the reference --------

def values_of(part):
    """A surface or the whole of the reference by the names of the program."""
    values = dict(zip(SUMS, part["S"]))
    values.update({name: part[key] for name, key in (("C1", "CI"), ("C2", "CII")) if key in part})
    if "asph" in part:
        sums = dict(zip(SUMS, part["asph"]))
        values.update({name: sums[name[-2:]] for name in ASPHERES})
    return values


def reference_cases():
    """All cases with Seidel sums of ../shared/reference/truth."""
    cases = []
    for case in reference.systems():
        sums = case["expected"].get("seidel")
        if sums:
            cases.append({"lens": reference.lens_text(case["system"]),
                          "wavelength": "0.5875618",
                          "surfaces": [values_of(one) for one in sums["surf"]],
                          "sum": values_of(sums), "lagrange": sums["H"], "transverse": sums["T"],
                          "waves": {name: sums["W"][name] for name in WAVES
                                    if name in sums["W"]}})
    return cases


# -------- the program's answers --------

def rows_of(checks, program, case, *words):
    result = program.run("seidel", "-", "--csv", *words, stdin=case["lens"])
    name = case["lens"].splitlines()[0][5:]
    if not checks.check(result.returncode == 0, f"{name}: {result.stderr.decode().strip()}"):
        return None
    return list(csv.DictReader(io.StringIO(result.stdout.decode(), newline="")))


def check_value(checks, name, text, expected, scale, factor=1, unit="mm"):
    """|value - factor expected| in units of 2^-53 of it; `scale`: the largest of the lens."""
    truth = Fraction(expected) * factor
    case, _, quantity = name.rpartition(": ")
    checks.against("algebra" if case == "afocal" else "seidel", case, quantity, text, truth,
                   max(ALLOWED * UNIT * abs(truth), Fraction(scale) * Fraction(1, 10 ** 30)), unit)


def check_case(checks, program, case):
    name = case["lens"].splitlines()[0][5:]
    plain = rows_of(checks, program, case, "--columns",
                    ",".join(("surface", "lagrange_mm") + SUMS + ASPHERES))
    if plain is None or not checks.check(
            [row["surface"] for row in plain] ==
            [str(i + 1) for i in range(len(case["surfaces"]))] + ["sum"], f"{name}: rows"):
        return
    for row, part in zip(plain, case["surfaces"] + [case["sum"]]):
        for key, expected in part.items():
            scale = max(abs(float(one[key])) for one in case["surfaces"] if key in one)
            check_value(checks, f"{name}: {key} of {row['surface']}", row[key], expected, scale)
    check_value(checks, f"{name}: lagrange", plain[-1]["lagrange_mm"], case["lagrange"], 0)
    across = rows_of(checks, program, case, "--form", "transverse")[-1]
    for key, expected in case["transverse"].items():
        check_value(checks, f"{name}: {key}", across[key + "_mm"], expected,
                    float(case["transverse"]["TSC"]))
        checks.check(across[key + "_mrad"] == "", f"{name}: {key} in mm and mrad")
    waves = rows_of(checks, program, case, "--form", "waves")[-1]
    for key, expected in case["waves"].items():
        check_value(checks, f"{name}: {key}", waves[key], expected, 0,
                    1000 / Fraction(case["wavelength"]), "waves")


def check_afocal(checks, program):
    """
    A Galilean telescope of thin lenses, stop on the first: behind it the marginal ray is parallel,
    at 1/3 of its height; an angle is -W'/(n' y'). Expected: S1 of the lens's two halves by hand,
    from the formula in exact fractions.
    """
    lens = ("lens afocal\naperture epd 20\nfield angle 1\nsurface 75 0 1.5 - stop\n"
            "surface - 100 air -\nsurface -25 0 1.5 -\nsurface - 0 air -\n")
    case = {"lens": lens}
    rows = rows_of(checks, program, case, "--form", "transverse")
    plain = rows_of(checks, program, case)
    y, v, total = Fraction(10), Fraction(0), Fraction(0)
    data = ((Fraction(1, 75), 1, Fraction(3, 2), 0), (Fraction(0), Fraction(3, 2), 1, 100),
            (Fraction(-1, 25), 1, Fraction(3, 2), 0), (Fraction(0), Fraction(3, 2), 1, 0))
    for c, n, m, t in data:
        after = v - y * (m - n) * c
        total -= (v + n * y * c) ** 2 * y * (after / m ** 2 - v / n ** 2)
        y, v = y + t * after / m, after
    checks.check(v == 0 and y == Fraction(10, 3), "the telescope of the test is not afocal")
    check_value(checks, "afocal: S1", plain[-1]["S1"], str(total), 0)
    check_value(checks, "afocal: TSC_mrad", rows[-1]["TSC_mrad"], str(-1000 * total / 2 / y), 0, 1,
                "mrad")
    checks.check(rows[-1]["TSC_mm"] == "", "afocal: TSC_mm is not absent")


def main():
    os.chdir(ROOT)
    checks, program = Checks(), Program(sys.argv[1])
    cases = reference.own_cases(checks, OWN, reference_cases(),
                                "Seidel and chromatic sums by an independent 50-digit program, mm: F to C; "
                                "systems as .lens files")
    checks.check(len(cases) >= 24, f"{OWN} has lost its cases")
    for case in cases:
        check_case(checks, program, case)
    check_afocal(checks, program)
    checks.finish()


main()
