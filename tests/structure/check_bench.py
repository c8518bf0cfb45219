#!/usr/bin/env python3
"""tests/structure/check_bench.py - a section of the bench that stops is told of, and stops no other;
README says of speed what was measured.

Prints a line for each failure and, last, "N passed, N failed".
"""
# SPDX-License-Identifier: MIT

import os
import subprocess
import sys

sys.dont_write_bytecode = True
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "tests"))
sys.path.insert(0, os.path.join(ROOT, "tests", "bench"))
import readme
from common import Broken, entry, measured
from harness import Checks


def good(_):
    yield entry("good", 1)


def halfway(_):
    """A program that ends with a status, as a compiler does that refuses a source."""
    yield entry("halfway", 1)
    subprocess.run([sys.executable, "-c", "raise SystemExit(1)"], check=True)


def leaving(_):
    yield entry("leaving", 1)
    sys.exit("bench: gone")


def main():
    checks = Checks()
    sections = {"halfway": halfway, "leaving": leaving, "good": good}
    items = list(measured(None, sections))
    checks.check([item.name for item in items if not isinstance(item, Broken)] == list(sections),
                 f"not every section was measured: {items}")
    broken = [item for item in items if isinstance(item, Broken)]
    checks.check([item.section for item in broken] == ["halfway", "leaving"],
                 f"not those that stopped are told: {broken}")
    checks.check("status 1" in broken[0].trouble and "gone" in broken[1].trouble,
                 f"why they stopped is not told: {broken}")
    checks.check(readme.committed() == readme.section(),
                 "README's section of speed is not what tests/bench/measured.tsv says")
    checks.finish()


main()
