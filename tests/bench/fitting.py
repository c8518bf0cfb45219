"""tests/bench/fitting.py - a thick lens fitted in process, and what a ray costs by each model."""
# SPDX-License-Identifier: MIT

import os

from common import printed

# Names that tests/bench/fit.c prints: what they are, and the unit.
FIT = {
    "count": ("fit: rays", ""),
    "iterations": ("fit: iterations", ""),
    "fit": ("fit: a thick lens to them", "us"),
    "rays": ("fit: aiming and tracing them", "us"),
    "exact": ("a ray, exact", "ns"),
    "thick": ("a ray, thick lens", "ns"),
    "thin": ("a ray, thin lens", "ns"),
}


def fitting(bench):
    if os.path.exists(bench.lenscalc + "-ceres"):
        yield from printed(bench.linked("fit", ceres=True), FIT)


SECTIONS = {"fit": fitting}
