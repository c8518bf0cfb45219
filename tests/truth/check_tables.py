#!/usr/bin/env python3
"""tests/truth/check_tables.py - tables of numbers in the sources, by what is known of them:
check_tables.py BUILD_DIR

Sums that the CIE prints; what was joined by straight lines; sums of other people's copies of the
CIE's lamps, by which a change of one figure shows, and where; powers that rules of quadrature
integrate exactly.
"""
# SPDX-License-Identifier: MIT

import os
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks
from source_tables import table

# Of f2, f7 and f11, CIE 15:2004 table T.6: sums of the values, in hundredths, and of their products
# with the place from 0 on. Two copies that are not of one hand have the same.
LAMPS = {"f2": (59450, 1939458), "f7": (78890, 2539669), "f11": (59408, 2029130)}


def check_observer(checks):
    """CIE 15:2004 table T.4: sums from 380 to 780 nm of its millionths, as printed there."""
    observer = table("src/light/observer.c", "functions", 3)
    for c, total in enumerate((21.371524, 21.371327, 21.371540)):
        checks.against("cie", "the observer", f"sum of column {c}",
                       sum(round(row[c], 6) for row in observer[4:85]), total, 1e-9)


def check_daylight(checks):
    """The components of daylight were measured each 10 nm."""
    daylight = table("src/light/spectrum.c", "components", 3)
    for i in range(1, len(daylight) - 1, 2):
        for c in range(3):
            checks.near("lines", f"daylight at {300 + 5 * i} nm, component {c}", daylight[i][c],
                        (daylight[i - 1][c] + daylight[i + 1][c]) / 2, 1e-9)


def check_lamps(checks):
    for name, sums in LAMPS.items():
        values = [round(100 * value) for value in table("src/light/illuminant.c", name)]
        got = sum(values), sum(i * value for i, value in enumerate(values))
        checks.check(len(values) == 81 and got == sums, f"{name}: sums {got}, expected {sums}")
    wavelengths = table("src/light/illuminant.c", "lamp_wavelengths")
    checks.check([round(1000 * w) for w in wavelengths] == list(range(380, 781, 5)),
                 f"wavelengths of lamps: {wavelengths}")


def check_rules(checks):
    """A rule of Gauss and Legendre of n points on 0..1 is right for powers up to 2 n - 1."""
    for name in "across_rule", "along_rule":
        rule = table("src/scene/microfacets.c", name, 2)
        for power in range(2 * len(rule)):
            got = sum(weight * at ** power for at, weight in rule)
            checks.near("rules", f"{name}: the integral of x^{power}", got, 1 / (power + 1), 4e-16)


def main():
    checks = Checks()
    check_observer(checks)
    check_daylight(checks)
    check_lamps(checks)
    check_rules(checks)
    checks.finish()


if __name__ == "__main__":
    main()
