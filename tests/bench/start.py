"""tests/bench/start.py - how long one answer takes, against /bin/true."""
# SPDX-License-Identifier: MIT

import os
import subprocess

from common import SPAWNS, entry, starts


def starting(bench):
    yield from starts(bench, {"lenscalc --version": "--version",
                              "a dof answer": "dof -f 50mm -N 2.8 -s 3m"})
    program = bench.lenscalc + "-ceres"
    if not os.path.exists(program):
        return
    words = [bench.tool("spawn"), str(SPAWNS), "/bin/true", "--", program, "--version"]
    output = subprocess.run(words, check=True, capture_output=True, text=True).stdout
    true, spent = map(float, output.split())
    yield entry("start: lenscalc-ceres --version / true", spent / true, "x",
                f"{spent:.0f} us / {true:.0f} us")


def lenses(bench):
    """Real lenses and glasses: one answer each, and the whole catalogue."""
    yield from starts(bench, {"lens double-gauss": "lens double-gauss",
                              "trace double-gauss": "trace double-gauss",
                              "list glasses": "list glasses",
                              "glass --like N-BK7": "glass --like N-BK7"})


def analyses(bench):
    """Whole commands on the double Gauss, as they are asked without options."""
    names = ("seidel", "color", "distortion", "field", "fan", "spot", "illumination", "pupil")
    yield from starts(bench, {f"{name} double-gauss": f"{name} double-gauss" for name in names})


SECTIONS = {"start": starting, "lenses": lenses, "analyses": analyses}
