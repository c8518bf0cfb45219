#!/usr/bin/env python3
"""tests/truth/check_peers.py - what optiland and ray-optics print: check_peers.py BUILD_DIR

peers.tsv: first-order figures, Seidel sums and spots on rings of one lens, as far as those programs
have digits.
"""
# SPDX-License-Identifier: MIT

import csv
import os
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import ROOT, Checks, Program


def main():
    os.chdir(ROOT)
    checks, program, tables = Checks(), Program(sys.argv[1]), {}
    with open("tests/truth/peers.tsv", encoding="utf-8") as file:
        figures = list(csv.DictReader((line for line in file if line[0] != "#"), delimiter="\t"))
    checks.check(len(figures) > 40, "peers.tsv has lost its figures")
    for figure in figures:
        words = figure["words"]
        if words not in tables:
            tables[words] = program.rows(*words.split())
        if not checks.check(isinstance(tables[words], list), f"{words}: {tables[words]}"):
            continue
        name, _, wanted = figure["row"].partition("=")
        row = next(row for row in tables[words] if not name or row[name] == wanted)
        checks.against(figure["program"], figure["case"], figure["column"], row[figure["column"]],
                       figure["value"], float(figure["within"]) * abs(float(figure["value"])),
                       figure["unit"])
    checks.finish()


if __name__ == "__main__":
    main()
