#!/usr/bin/env python3
"""tests/truth/check_studio.py - what OpticStudio printed of one lens: check_studio.py BUILD_DIR

../shared/reference/opticstudio/figures.json says of each figure how lenscalc is asked, and how near
it must be: half a unit of the last digit, and what its definition or sampling allows. The lens is
somebody's design, which this project does not carry: skipped where it is not here.
"""
# SPDX-License-Identifier: MIT

import json
import math
import os
import re
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import SHARED, Checks, Program

FOLDER = os.path.join(SHARED, "reference/opticstudio")
# the term n = 12, m = 0 is the 37th here too; figures.json has it as the 49th
MOVED = {"Z37 of OpticStudio: n = 12, m = 0": {"index": 37}}


def is_near(cell, wanted):
    try:
        return abs(float(cell) - float(wanted)) <= 1e-9 * max(1, abs(float(wanted)))
    except ValueError:
        return cell == wanted


def product(row, columns):
    """Of the row's numbers in columns such as a*b."""
    return math.prod(float(row[column]) for column in columns.split("*"))


def value_of(figure, table):
    """The figure from the rows of its command; NaN where there is none."""
    def of_row(wanted):
        rows = [row for row in table
                if all(is_near(row[name], value) for name, value in wanted.items())]
        values = [product(row, figure["column"]) for row in rows]
        if figure.get("agg") == "rms":
            return math.sqrt(sum(value ** 2 for value in values) / len(values))
        return values[0] if values else math.nan
    value = of_row(MOVED.get(figure["quantity"], figure["row"]))
    value -= of_row(figure["minus"]) if "minus" in figure else 0
    value = value * figure.get("scale", 1) + figure.get("offset", 0)
    value = 1 / value if "invert" in figure else value
    return math.degrees(math.asin(value)) if "asin_deg" in figure else value


def unit_of(figure):
    column = figure["column"]
    word = column.rpartition("_")[2]
    if "asin_deg" in figure:
        return "deg"
    if "invert" in figure or column.startswith("cos"):
        return ""
    if word in ("mm", "um", "deg", "waves"):
        return word
    if re.match(r"[SC]\d", column):
        return "mm"
    return "waves" if column[0] == "W" else ""


def main():
    checks, program = Checks(), Program(sys.argv[1])
    if not os.path.isdir(FOLDER):
        print("skipped: figures of OpticStudio (no ../shared/reference/opticstudio)")
        checks.finish()
    with open(os.path.join(FOLDER, "figures.json"), encoding="utf-8") as file:
        figures = json.load(file)["figures"]
    checks.check(len(figures) == 631, f"{len(figures)} figures of OpticStudio")
    tables = {}
    for figure in figures:
        words = tuple(figure["args"])
        if words not in tables:
            tables[words] = program.rows(*(os.path.join(FOLDER, "studio.lens") if word == "LENS"
                                           else word for word in words))
            checks.check(isinstance(tables[words], list), f"{words}: {tables[words]}")
        if isinstance(tables[words], list):
            checks.against("opticstudio", figure["group"], figure["quantity"],
                           value_of(figure, tables[words]), figure["opticstudio"],
                           figure["tolerance"], unit_of(figure))
    checks.finish()


if __name__ == "__main__":
    main()
