#!/usr/bin/env python3
"""tests/truth/check_lens.py - first-order data of lenses against numbers from outside:
check_lens.py BUILD_DIR

first_order.json: systems with the values of an independent 50-digit program. Each figure must be
within 16 x 2^-53 x (sensitivity + |value|), where the program states the sensitivity, else within
16 x 2^-53 of the value; Galilean telescopes within 4e-16.
lenses.tsv: what the sources of the lenses in lensdb state, and what an independent program found.
"""
# SPDX-License-Identifier: MIT

import csv
import glob
import json
import math
import os
import re
import shlex
import subprocess
import sys
from fractions import Fraction

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import ROOT, SHARED, Checks

EPS = 2.0 ** -53
# key of the truth -> column of the program, factor from the column to the truth
COLUMNS = {
    "power": ("power_per_m", Fraction(1, 1000)), "efl": ("efl_mm", 1), "bfl": ("bfl_mm", 1),
    "ffl": ("ffl_mm", 1), "H": ("front_principal_mm", 1), "Hp": ("rear_principal_mm", 1),
    "N": ("front_nodal_mm", 1), "Np": ("rear_nodal_mm", 1), "f_front": ("front_focal_mm", 1),
    "f_rear": ("rear_focal_mm", 1), "petzval_radius": ("petzval_radius_mm", 1),
    "mag": ("magnification", 1), "ep_z": ("entrance_pupil_mm", 1), "xp_z": ("exit_pupil_mm", 1),
    "lagrange": ("lagrange_mm", 1), "ep_diameter": ("entrance_pupil_diameter_mm", 1),
    "xp_diameter": ("exit_pupil_diameter_mm", 1), "fno_working_paraxial": ("working_fnumber", 1),
    "na_image_paraxial": ("na_image", 1), "fno_infinity": ("fnumber", 1),
}
UNITS = {"power": "1/mm", "mag": "", "fno_working_paraxial": "", "na_image_paraxial": "",
         "fno_infinity": ""}
BOOKS = {"MLD": "smith", "W. Smith": "smith", "Laikin": "laikin"}


def answer(program, words, lens=None):
    wrapper = shlex.split(os.environ.get("LENSCALC_WRAPPER", ""))
    result = subprocess.run([*wrapper, program, "lens", *words, "--json"], input=lens,
                            capture_output=True, text=True)
    return json.loads(result.stdout)["rows"] if result.returncode == 0 else result.stderr


def check_figure(checks, case, row, key, expected):
    column, factor = COLUMNS[key]
    name = f"{case['lens'].splitlines()[0][5:]}: {key}"
    value = row[column]
    if value is None:
        infinite = row.get(column.rsplit("_mm", 1)[0] + "_is_infinite") is True
        return checks.check(infinite and (expected == "inf" or case.get("afocal", False)),
                            f"{name} is absent, expected {expected}")
    if expected == "inf":
        return checks.check(math.isinf(value), f"{name} is {value!r}, expected inf")
    truth = Fraction(expected)
    sensitivity = Fraction(case.get("sensitivity", {}).get(key, "0"))
    allowed = 16 * Fraction(EPS) * (sensitivity + abs(truth))
    if case["family"] == "galilean" and key in ("power", "efl", "bfl", "ffl", "H", "Hp"):
        allowed = min(allowed, Fraction("4e-16") * abs(truth))
    return checks.against("first-order", name.rpartition(": ")[0], key,
                          Fraction(value) * factor, truth, allowed, UNITS.get(key, "mm"))


def check_first_order(checks, program):
    with open("tests/truth/first_order.json", encoding="utf-8") as file:
        cases = json.load(file)["cases"]
    checks.check(len(cases) > 300, "first_order.json has lost its cases")
    for case in cases:
        rows = answer(program, ["-"], case["lens"])
        if not checks.check(isinstance(rows, list), f"{case['lens']}: {rows}"):
            continue
        for key, expected in case["expected"].items():
            check_figure(checks, case, rows[0], key, expected)


def stated_by(lens, source):
    """(the source of sources.tsv, the name) of what a row of lenses.tsv says of a lens."""
    if not source.startswith(("stated", "last thickness")):
        return "paraxial" if source.startswith("independent") else "first-order", lens
    with open(f"lensdb/lenses/{lens}.lens", encoding="utf-8") as file:
        words = re.search(r"(?m)^source +([^,;\n]+(?:,\d+)*)", file.read())[1]
    book = [name for start, name in BOOKS.items() if words.startswith(start)]
    return (book + ["patents" if re.match(r"(US|JP|DE|GB|WO) ?\d|GB", words) else "makers"])[0], \
        f"{lens} ({words})"


def check_lensdb(checks, program):
    with open("tests/truth/lenses.tsv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader((line for line in file if not line.startswith("#")),
                                   delimiter="\t"))
    checks.check(len(rows) > 250, "lenses.tsv has lost its rows")
    checked = {(row["lens"], row["column"]) for row in rows}
    for path in sorted(glob.glob("lensdb/lenses/*.lens")):
        name = os.path.basename(path)[:-5]
        for column in ("efl_mm", "bfl_mm"):
            checks.check((name, column) in checked, f"lenses.tsv does not check {column} of {name}")
    for row in rows:
        words = [row["lens"]] + (["--position", row["position"]] if row["position"] != "-" else [])
        found = answer(program, words)
        name = f"{row['lens']} {row['position']}: {row['column']}"
        if not checks.check(isinstance(found, list), f"{name}: {found}"):
            continue
        source, case = stated_by(row["lens"], row["source"])
        place = "" if row["position"] == "-" else f" at {row['position']}"
        allowed = Fraction(row["tolerance"].rstrip("%")) / 100 * abs(Fraction(row["expected"]))
        expected = row["expected"] if allowed > 0 else float(row["expected"])
        checks.against(source, case + place, row["column"], found[0][row["column"]], expected,
                       allowed, "mm" if row["column"].endswith("_mm") else "")


# Tables that stay out: the table has not what its source says.
LEFT_OUT = {"us8879901-36", "mangin-500", "panavision-rear-anamorph", "canon-anamorphic-zoom",
            "laikin139-uv53x", "us5831776-litho"}


def check_complete(checks):
    """Every published table whose figures agree with its source is in lensdb."""
    index = os.path.join(SHARED, "data/lenses/index.tsv")
    if not os.path.exists(index):
        print("skipped: no index of the published tables")
        return
    with open(index, encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file, delimiter="\t"):
            sound = row["efl_check"] in ("ok", "near") or \
                (row["efl_check"] == "no f claim" and row["id"] not in LEFT_OUT)
            there = os.path.exists(f"lensdb/lenses/{row['id']}.lens")
            checks.check(there or not sound, f"{row['id']} is not in lensdb")
            known_bad = row["id"].endswith("-bad")
            checks.check(known_bad or there <= sound, f"{row['id']} is doubtful, and in lensdb")


def main():
    os.chdir(ROOT)
    checks = Checks()
    program = os.path.join(os.path.abspath(sys.argv[1]), "lenscalc")
    check_first_order(checks, program)
    check_lensdb(checks, program)
    check_complete(checks)
    checks.finish()


main()
