#!/usr/bin/env python3
"""tests/truth/check_color.py - colour of lenses against numbers from outside:
check_color.py BUILD_DIR [--write]

color.json: systems as .lens files, with the paraxial images, the foci of real rays by zone and the
chief rays by wavelength of an independent 50-digit program; where ../shared is here too, color.json
must hold every case of its truth (--write makes it anew). A shift is the difference of two places:
it is judged by the rounding of these. Thin lenses: f_F - f_C = f_F f_C/(f_d V).
"""
# SPDX-License-Identifier: MIT

import csv
import io
import os
import sys
from decimal import Decimal
from fractions import Fraction

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import reference
from harness import ROOT, Checks, Program

OWN = "tests/truth/color.json"
UNIT = 2.0 ** -53
NAMES = {"d": 587.5618, "F": 486.1327, "C": 656.2725, "g": 435.8343, "e": 546.0740}
ZONES = {"0.3": 6, "0.5": 10, "0.85": 17, "1": 20}  # of 20 steps


def reference_cases():
    """All cases of ../shared with more than one wavelength."""
    cases = []
    for case in reference.systems():
        system, expected = case["system"], case["expected"]
        if "primary" not in system or "lsa" not in expected:
            continue
        waves = [system["primary"]] + [one for one in system["wavelengths"]
                                       if one != system["primary"]]
        if len(waves) < 2 or not expected.get("fields"):
            continue
        focus = system.get("focus") or "paraxial"
        if focus != "paraxial" and not isinstance(focus, dict):
            continue
        value = Decimal(system["field"]["value"])
        cases.append({
            "lens": reference.lens_text(system, waves),
            "focus": focus["from_last"] if isinstance(focus, dict) else focus,
            "images": {one: expected["first_order"][one]["img_z"] for one in waves},
            "zones": {one: {zone: expected["lsa"][one][zone]["lsa"] for zone in ZONES
                            if expected["lsa"][one].get(zone, {}).get("lsa")} for one in waves},
            "fields": {str(value * Decimal(part)): one["chief_y_by_wavelength"]
                       for part, one in expected["fields"].items()
                       if one["chief_y_by_wavelength"]}})
    return cases


def rows_of(checks, program, name, lens, *words):
    result = program.run("color", "-", "--csv", *words, stdin=lens)
    if not checks.check(result.returncode == 0, f"{name}: {result.stderr.decode().strip()}"):
        return []
    return list(csv.DictReader(io.StringIO(result.stdout.decode(), newline="")))


def check_shift(checks, name, text, expected, size, allowed, factor=1):
    """|text - expected| in roundings of the places that the shift lies between."""
    if not checks.check(text not in (None, ""), f"{name} is absent"):
        return
    case, _, quantity = name.rpartition(": ")
    checks.against("algebra" if case == "thin" else "color", case, quantity,
                   Fraction(text) / factor, expected, allowed * UNIT * abs(float(size)), "mm")


def wave_of(row):
    return min(NAMES, key=lambda name: abs(NAMES[name] - float(row["wavelength_nm"])))


def check_case(checks, program, case):
    name = case["lens"].splitlines()[0][5:]
    images = {one: Fraction(z) for one, z in case["images"].items()}
    waves = list(images)
    primary = images[waves[0]]
    for row in rows_of(checks, program, name, case["lens"], "--focus", case["focus"]):
        wave = wave_of(row)
        check_shift(checks, f"{name}: axial {wave}", row["axial_mm"], images[wave] - primary,
                    max(abs(images[wave]), abs(primary)), 4)
    zones = rows_of(checks, program, name, case["lens"], "--show", "zone", "--steps", "20",
                    "--aim", "entrance")
    found = {(wave_of(row), round(20 * float(row["zone"]))): row["axial_mm"] for row in zones}
    for wave, by_zone in case["zones"].items():
        for zone, lsa in by_zone.items():
            # height over slope: a rounding of either counts as much as the focal length is long
            check_shift(checks, f"{name}: zone {zone} {wave}", found.get((wave, ZONES[zone])), lsa,
                        max(abs(primary), abs(primary + Fraction(lsa)), 1), 400)
    for field, heights in case["fields"].items():
        lens = "\n".join("field " + line.split()[1] + " " + field if line.startswith("field ")
                         else line for line in case["lens"].splitlines()) + "\n"
        if float(field) == 0:
            continue
        for row in rows_of(checks, program, name, lens, "--focus", case["focus"]):
            wave = wave_of(row)
            shift = Fraction(heights[wave]) - Fraction(heights[waves[0]])
            size = max(abs(Fraction(heights[wave])), 1)
            check_shift(checks, f"{name}: lateral {field} {wave}", row["lateral_um"], shift, size,
                        400, 1000)
            check_shift(checks, f"{name}: chief {field} {wave}", row["chief_y_mm"],
                        heights[wave], size, 400)


def check_thin(checks, program):
    """A thin singlet by its glass nd/Vd: f = R/(2 (n - 1)), n(F) - n(C) = (nd - 1)/Vd."""
    for nd, abbe, radius in (("1.5168", "64.17", "100"), ("1.7", "30", "-40")):
        lens = (f"lens thin\nwavelength d F C\nfield angle 5\naperture epd 5\n"
                f"surface {radius} 0 {nd}/{abbe} - stop\nsurface {-Fraction(radius)} 0 air -\n")
        d, F, C = (Fraction(str(NAMES[one])) / 1000 for one in "dFC")
        b = (Fraction(nd) - 1) / Fraction(abbe) / (1 / F ** 2 - 1 / C ** 2)
        n = {one: Fraction(nd) + b * (1 / at ** 2 - 1 / d ** 2)
             for one, at in (("d", d), ("F", F), ("C", C))}
        f = {one: Fraction(radius) / 2 / (value - 1) for one, value in n.items()}
        rule = -f["F"] * f["C"] / f["d"] / Fraction(abbe)
        row = rows_of(checks, program, "thin", lens)[0]
        checks.check(abs(rule - (f["F"] - f["C"])) < Fraction(1, 10 ** 30), "the rule itself")
        check_shift(checks, "thin: axial_color", row["axial_color_mm"], rule, f["d"], 4)
        check_shift(checks, "thin: secondary", row["secondary_mm"],
                    (f["F"] + f["C"]) / 2 - f["d"], f["d"], 4)
        for one in rows_of(checks, program, "thin", lens):
            # the stop is on the lens: the chief ray goes through its middle
            checks.check(abs(float(one["lateral_um"])) < 1e-10, f"thin: lateral {one}")


def main():
    os.chdir(ROOT)
    checks, program = Checks(), Program(sys.argv[1])
    cases = reference.own_cases(checks, OWN, reference_cases(),
                                "images, foci by zone and chief rays by wavelength, mm, by an independent "
                                "50-digit program; systems as .lens files")
    checks.check(len(cases) >= 20, f"{OWN} has lost its cases")
    for case in cases:
        check_case(checks, program, case)
    check_thin(checks, program)
    checks.finish()


main()
