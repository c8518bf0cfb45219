#!/usr/bin/env python3
"""tests/truth/check_exercises.py - exercises of a textbook, typed as they are read:
check_exercises.py BUILD_DIR

Questions and printed answers of University Physics (exercises.tsv); allowed is half a unit of the
last printed digit, a little more where the book rounds on its way.
"""
# SPDX-License-Identifier: MIT

import os
import shlex
import subprocess
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import ROOT, Checks


def answer(program, words, column):
    """The column of the last row, as it is printed."""
    wrapper = shlex.split(os.environ.get("LENSCALC_WRAPPER", ""))
    result = subprocess.run([*wrapper, program, *shlex.split(words), "--value", column],
                            capture_output=True, text=True)
    lines = result.stdout.split("\n")
    return lines[-2] if result.returncode == 0 and len(lines) > 1 else None


def main():
    program = os.path.join(os.path.abspath(sys.argv[1]), "lenscalc")
    checks = Checks()
    with open(os.path.join(ROOT, "tests/truth/exercises.tsv"), encoding="utf-8") as file:
        lines = [line.rstrip("\n").split("\t") for line in file if not line.startswith("#")]
    for module, words, column, expected, allowed in lines[1:]:
        actual, case = answer(program, words, column), f"{module}: {words}"
        if allowed == "0":
            checks.check(actual == expected, f"{case}: {column} is {actual}, expected {expected}")
        else:
            checks.against("openstax", case, column, actual, expected, float(allowed))
    checks.finish()


main()
