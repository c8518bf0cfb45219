"""tests/bench/optimize.py - what an optimisation is made of."""
# SPDX-License-Identifier: MIT

import csv
import io
import os
import subprocess
import sys
import time

from common import entry, printed
from lenses import GAUSS, STARTS

# Names that tests/bench/merit.c prints: what they are, and the unit.
MERIT = {
    "merit": ("optimize: nine spots", "us"),
    "normal": ("optimize: and normal equations", "us"),
    "normal/trace": ("optimize: the same / trace", "x"),
    "aimed": ("optimize: aimed at the stop", "us"),
    "aimed/trace": ("optimize: that / trace", "x"),
    "contrast": ("optimize: contrast of three fields in both directions", "us"),
}


def parts(bench):
    """Of one step, the least of three runs."""
    program, best = bench.linked("merit"), {}
    for _ in range(3):
        for item in printed(program, MERIT):
            kept = best.get(item.name, item)
            best[item.name] = min(item, kept, key=lambda one: one.value)
    yield from best.values()


SPOTS = "--vary R1..R11,t11 --goals spot,efl=100 --aim entrance"
RINGS = SPOTS + " --pattern hexapolar --rays 127"
# ten curvatures and nine thicknesses, the latter within bounds
BOUNDED = ("--vary all-R,t1[2,12],t2[0.2,5],t3[2,12],t4[2,12],t5[5,20],t7[2,12],t8[2,15],"
           "t9[0.2,5],t10[2,12] --goals spot,efl=100 --rays 12 --aim entrance --iterations 1000")


def solved(bench, lens, question, turns=1):
    """The rows of a question, and the least seconds that it took."""
    if "\n" in lens:
        with open(bench.path("start.lens"), "w", encoding="ascii") as file:
            file.write(lens)
        lens = bench.path("start.lens")
    least = float("inf")
    for _ in range(turns):
        began = time.perf_counter()
        result = subprocess.run([bench.lenscalc, "optimize", lens, *question.split(), "--csv"],
                                capture_output=True, text=True, check=False)
        least = min(least, time.perf_counter() - began)
        if result.returncode != 0:
            sys.exit(f"bench: {question}: {result.stderr}")
    return list(csv.DictReader(io.StringIO(result.stdout))), least


def lecture(bench):
    """The double Gauss by its radii and image plane, whole processes."""
    for name, question in (("127 rays in rings", RINGS), ("36 of Gauss", SPOTS)):
        rows, seconds = solved(bench, GAUSS, question, 5)
        spots, _ = solved(bench, GAUSS, question + " --show spots")
        converged = sum(float(row["rms_after_um"]) ** 2 for row in spots) * 1e-6
        before, after = (float(rows[0][f"merit_{when}"]) for when in ("before", "after"))
        yield entry(f"optimize: double Gauss, {name}: merit", after, "mm2",
                    f"{before:.6g} to {after:.6g} in {rows[0]['iterations']} iterations, spots that "
                    f"converged {converged:.5f}")
        yield entry(f"optimize: double Gauss, {name}: time", seconds * 1e3, "ms")


def bounded(bench, solvers):
    """Nineteen variables: no worse than the other solver."""
    found = {}
    for solver in solvers:
        rows, seconds = solved(bench, GAUSS, f"{BOUNDED} --solver {solver}", 10)
        found[solver] = float(rows[0]["merit_after"])
        yield entry(f"optimize: 19 variables, {solver}: time", seconds * 1e3, "ms",
                    f"merit {found[solver]:.6g}, {rows[0]['iterations']} iterations")
    if "ceres" in found:
        yield entry("optimize: 19 variables, dls / ceres", found["dls"] / found["ceres"], "x")


def starts(bench, solvers):
    """Ten starts by each solver; a tie is a merit alike to a thousandth."""
    best = 0
    for name, (lens, question) in STARTS.items():
        merits = []
        for solver in solvers:
            rows, seconds = solved(bench, lens,
                                   f"{question} --iterations 1000 --solver {solver}")
            merits.append(float(rows[0]["merit_after"]))
            yield entry(f"optimize: {name}, {solver}", seconds * 1e3, "ms",
                        f"merit {merits[-1]:.6g}, {rows[0]['evaluations']} evaluations")
        best += merits[0] <= 1.001 * min(merits)
    if len(solvers) > 1:
        yield entry("optimize: starts that dls wins or ties", best, f"of {len(STARTS)}")


# starts within 0.006 /mm and 6 mm, 0.6 natural scales, of the lens
WIDE = " --global 400 --seed 7 --spread 0.6 --keep 2"


def searched(bench):
    """The same double Gauss from 400 starts, on one thread."""
    for name, question in (("127 rays in rings", RINGS), ("36 of Gauss", SPOTS)):
        rows, seconds = solved(bench, GAUSS, question + WIDE)
        yield entry(f"optimize: 400 starts, {name}: merit", float(rows[0]["merit_after"]), "mm2",
                    f"{float(rows[0]['merit_after']):.6g} by {rows[0]['starts']} of them, "
                    f"{rows[0]['evaluations']} evaluations; next {float(rows[1]['merit_after']):.6g}")
        yield entry(f"optimize: 400 starts, {name}: time", seconds, "s")


def optimize(bench):
    solvers = ("dls", "ceres") if os.path.exists(bench.lenscalc + "-ceres") else ("dls",)
    yield from parts(bench)
    yield from lecture(bench)
    yield from searched(bench)
    yield from bounded(bench, solvers)
    yield from starts(bench, solvers)


SECTIONS = {"optimize": optimize}
