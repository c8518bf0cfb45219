#!/usr/bin/env python3
"""tests/truth/check_filters.py - filters to put on, against all stacks of three: BUILD_DIR

A filter ND8 makes the time 8 times as long. Of all filters alone, by twos and by threes the product
nearest below and nearest above the wanted time must be among the rows, and each row must be a product.
"""
# SPDX-License-Identifier: MIT

import itertools
import math
import os
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program

USUAL = (2, 4, 8, 16, 32, 64, 128, 256, 500, 1000, 64000)  # as lenscalc-exposure(1) lists them
HP5 = 1.31  # Ilford: corrected time = metered time to this power, from 1 s on


def check_rows(checks, rows, there, metered, wanted, power, what):
    products = [math.prod(filters) for count in (1, 2, 3) for filters in itertools.combinations(there, count)]
    times = [metered * product for product in products]
    times = [time ** power if time > 1 else time for time in times]
    below = max((time for time in times if time <= wanted * (1 + 1e-9)), default=None)
    above = min((time for time in times if time > wanted * (1 + 1e-9)), default=None)
    said = []
    for row in rows:
        time = metered * math.prod(int(name[2:]) for name in row["filters"].split("+"))
        time = time ** power if time > 1 else time
        said.append(time)
        case = f"{what}: {row['filters']}"
        checks.against("filters", case, "time_to_set_s", row["time_to_set_s"], time, 1e-12 * time,
                       "s")
        checks.against("filters", case, "longer_stops", row["longer_stops"],
                       math.log2(time / wanted), 1e-11, "stops")
    for time in (below, above):
        checks.check(time is None or any(math.isclose(time, one, rel_tol=1e-9) for one in said),
                     f"{what}: {time} s is missing among {said}")


def main():
    checks, program = Checks(), Program(sys.argv[1])
    for metered, wanted in ((1 / 125, 30), (1 / 1000, 1 / 30), (1 / 60, 240), (2, 1000), (1 / 8, 0.5)):
        for own in (USUAL, (8, 64, 1000), (2, 4, 8, 16), (32,)):
            for film, power in ((None, 1), ("HP5 Plus", HP5)):
                words = ["exposure", "--metered", repr(metered), "-t", repr(wanted), "--propose"]
                words += [] if own is USUAL else ["--own", ",".join(f"ND{factor}" for factor in own)]
                words += [] if film is None else ["--film", film]
                rows = program.rows(*words)
                what = f"{metered:.4g} s to {wanted:.4g} s, {film or 'no film'}"
                if checks.check(not isinstance(rows, str), f"{words}: {rows}"):
                    check_rows(checks, rows, own, metered, wanted, power, what)
    checks.finish()


if __name__ == "__main__":
    main()
