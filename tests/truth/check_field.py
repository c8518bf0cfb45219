#!/usr/bin/env python3
"""tests/truth/check_field.py - lenscalc field against an independent program of 50 digits:
check_field.py BUILD_DIR

field.json: tangential and sagittal foci, chief rays, and relative illumination by the rays of an
object point; the lenses are those of check.json. ../shared/reference/truth, where it exists, must
say the same.
"""
# SPDX-License-Identifier: MIT

import glob
import json
import os
import re
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import SHARED, Checks, Program

EPSILON = 2.0 ** -53


def size_of(case):
    """Of the lens in mm: what its foci depend on is of this size."""
    surfaces = [line.split() for line in case["lens"].splitlines() if line.startswith("surface")]
    return (sum(abs(float(words[2])) for words in surfaces) +
            max(abs(float(words[1])) for words in surfaces if words[1] != "inf") / 4)


def allowed_of(case, z, power):
    """64 ulp of the foci's sensitivity: z itself, and z^2/f where the beam is nearly parallel."""
    magnified = 25 if "mirror" in case["lens"] and case["lens"].count("surface") > 1 else 1
    return 64 * EPSILON * (abs(z) + magnified * size_of(case) + z * z * power)


def field_words(case, fraction):
    value = case["field"]["value"] * float(fraction)
    return ["--field", f"{value!r}deg"] if case["field"]["type"] == "angle_deg" else None


def check_case(checks, program, case, truth):
    name = case["name"]
    for field in truth["fields"]:
        words, text = field_words(case, field["fraction"]), case["lens"]
        if words is None:
            height = case["field"]["value"] * float(field["fraction"])
            text, words = re.sub(r"field height .*", f"field height {height!r}", text), []
        table = program.rows("field", "-", "--focus", case["plane"], *words, text=text)
        if not checks.check(isinstance(table, list) and len(table) == 1, f"{name}: {table}"):
            continue
        row, where = table[0], f"{name} at {field['fraction']}"
        for section, key in (("tangential", "zt"), ("sagittal", "zs")):
            z = float(field[key])
            allowed = allowed_of(case, z, 1 / 40)
            checks.against("field", where, f"{section} focus", row[f"{section}_z_mm"], field[key],
                           allowed, "mm")
            checks.against("field", where, f"{section} focus from the image plane",
                           row[f"{section}_mm"], z - float(case["plane"]), allowed, "mm")
        checks.against("field", where, "image height", row["image_height_mm"], field["y"],
                       1e-13 * (abs(float(field["y"])) + 10), "mm")
        checks.check(row["section_turn_deg"] == "0", f"{where}: turned {row['section_turn_deg']}")


def check_shared(checks, cases):
    """The values here are those of the reference."""
    known = {case["name"]: case for case in cases}
    for path in sorted(glob.glob(os.path.join(SHARED, "reference", "truth", "*.json"))):
        with open(path, encoding="utf-8") as file:
            reference = json.load(file)["cases"]
        for case in reference:
            fields = case.get("expected", {}).get("fields", {}) if "system" in case else {}
            for fraction, values in fields.items():
                if "coddington" not in values:
                    continue
                here = [field for field in known.get(case["name"], {}).get("fields", [])
                        if field["fraction"] == fraction]
                checks.check(len(here) == 1 and here[0]["zt"] == values["coddington"]["zt"] and
                             here[0]["zs"] == values["coddington"]["zs"],
                             f"{case['name']} at {fraction}: not as in the reference")


def main():
    program, checks = Program(sys.argv[1]), Checks()
    with open("tests/truth/check.json", encoding="utf-8") as file:
        lenses = {case["name"]: case for case in json.load(file)["cases"]}
    with open("tests/truth/field.json", encoding="utf-8") as file:
        cases = json.load(file)["cases"]
    for truth in cases:
        check_case(checks, program, lenses[truth["name"]], truth)
    if os.path.isdir(SHARED):
        check_shared(checks, cases)
    else:
        print("skipped: ../shared is not here, the values of tests/truth stand alone")
    checks.finish()


if __name__ == "__main__":
    main()
