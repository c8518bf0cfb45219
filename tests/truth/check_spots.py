#!/usr/bin/env python3
"""tests/truth/check_spots.py - spots against numbers from outside:
check_spots.py BUILD_DIR [--write]

spots.json: systems as .lens files, with the spots on grids of 8 x 8 of the stop and of the paraxial
entrance pupil of an independent 50-digit program; where ../shared is here too, spots.json must hold
every case of its truth (--write makes it anew). INTEGRALS: converged spots of another independent
program, over the clear pupil and over the whole one.

The statistics of a spot are made again from the rays of `trace` by this script: in --pattern sobol
over the pupils of lenses of lensdb, where an error that is printed must not be less than the true
one.
"""
# SPDX-License-Identifier: MIT

import csv
import io
import math
import os
import sys
from fractions import Fraction

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program
import reference

OWN = "tests/truth/spots.json"
NUMBERS = ("rms", "rms_x", "rms_y", "rms_chief")
GRIDS = {"spot_stop_grid_8": "stop", "spot_ep_grid_8": "entrance"}

# what follows `lenscalc spot`: RMS radius in um, and its tolerance in um
WHOLE = "double-gauss -w d -N 2 --focus paraxial --aim entrance --no-clip --field "
CLEAR = " -w d --focus paraxial --weight beam --error 1e-8"
INTEGRALS = {
    WHOLE + "0": (31.500230, 1e-6),
    WHOLE + "10": (206.056176, 1e-6),
    WHOLE + "14": (374.155069, 1e-6),
    "double-gauss --field 14" + CLEAR: (74.843921, 1e-6),
    "cs348b-dgauss-50 --field 22" + CLEAR: (48.428111, 1e-6),
    "nikkor-z-58-f095 --field 18" + CLEAR: (8.701232, 1e-6),
    "fisheye-16 --field 60" + CLEAR: (16.821149, 1e-6),
    "double-gauss --field 14 -w d --focus paraxial --error 1e-8": (74.5987, 1e-4),
    # plain patterns say the same as far as they are right: 0.25 um tell it from equal areas
    "double-gauss --field 14 -w d --focus paraxial --weight beam --pattern square --rays 100000":
        (74.843921, 0.06),
    "fisheye-16 --field 60 -w d --focus paraxial --weight beam --pattern sobol --rays 100000":
        (16.821149, 0.02),
}
# the same whole pupil by rings of equal weights, as other programs fill it
RINGS = {127: (54.764, 306.046, 546.030), 3169: (36.078, 225.665, 407.778),
         49537: (32.643, 210.963, 382.562)}
CONVERGED = (31.500230, 206.056176, 374.155069)


def reference_cases():
    """All cases with spots of ../shared/reference/truth."""
    found = []
    for case in reference.systems():
        fields = case["expected"].get("fields", {})
        spots = {name: one for name, one in fields.items() if "rms" in one.get("spot_stop_grid_8", {})}
        if not spots:
            continue
        focus = case["system"].get("focus", "paraxial")
        words = ["--focus", "paraxial"]
        if isinstance(focus, dict):
            words = ["--focus", focus["from_last"] + "mm"]
        elif focus != "paraxial":
            words += ["--defocus", focus + "mm"]
        found.append({
            "lens": reference.lens_text(case["system"], fractions=list(spots)), "words": words,
            "grids": {grid: [{name: one[grid][name] for name in NUMBERS}
                             if "rms" in one[grid] else None for one in spots.values()]
                      for grid in GRIDS}})  # null: a ray of the grid is lost
    return found


def rows_of(checks, program, name, *words, stdin=None, partly=False):
    result = program.run("spot", *words, "--csv", stdin=stdin)
    if not checks.check(result.returncode == 0 or partly, f"{name}: {result.stderr.decode().strip()}"):
        return []
    return list(csv.DictReader(io.StringIO(result.stdout.decode(), newline="")))


def check_grids(checks, program, case):
    """Rays are right to 1e-13 mm; the numbers are sums of them, and of plain doubles in um."""
    name = case["lens"].splitlines()[0][5:]
    for grid, aim in GRIDS.items():
        rows = rows_of(checks, program, f"{name}, {aim}", "-", "--no-clip", "--aim", aim,
                       "--pattern", "square", "--rays", "52", *case["words"], stdin=case["lens"],
                       partly=None in case["grids"][grid])
        checks.check(len(rows) in (0, len(case["grids"][grid])), f"{name}: {len(rows)} rows")
        for row, expected in zip(rows, case["grids"][grid]):
            for number in NUMBERS if expected is not None else ():
                truth = 1000 * Fraction(expected[number])
                field = row["field_deg"] or f"{row['height_mm']} mm"
                checks.against("spots", f"{name}, {aim}, field {field}", number,
                               row[number + "_um"], truth, 1e-10 + 1e-12 * abs(float(truth)), "um")


def check_integrals(checks, program):
    for words, (expected, allowed) in INTEGRALS.items():
        for row in rows_of(checks, program, words, *words.split()):
            checks.against("spot-integrals", f"spot {words}", "rms", row["rms_um"], expected,
                           allowed, "um")


# -------- the printed error against the true one --------

def check_samples(checks, program):
    """Of defaults, few rays and rings: their values, and errors that reach to the truth, but not
    over a hundred times farther."""
    samples = [""] + [f" --rays {rays}" for rays in (18, 72)]
    samples += [f" --pattern hexapolar --rays {rays}" for rays in RINGS]
    for sample in samples:
        rings = RINGS.get(int(sample.split()[-1])) if "hexapolar" in sample else None
        rows = rows_of(checks, program, WHOLE + sample, *(WHOLE + "0,10,14" + sample).split())
        for i, row in enumerate(rows):
            value, error, name = float(row["rms_um"]), float(row["error_um"]), row["field_deg"] + sample
            true = abs(value - CONVERGED[i])
            if rings is not None:
                checks.against("spot-integrals", f"spot {WHOLE}{name}", "rms", value, rings[i], 6e-4,
                               "um")
            checks.check(true - 6e-7 <= error <= 100 * (true + 6e-7),
                         f"{name}: off by {true} um, the error printed is {error}")



def sobol_rms(program, lens, field):
    """(RMS radius in um, its standard error) of 2^15 rays of the stop, by their places."""
    squares = []
    for seed in range(4):
        result = program.run("trace", lens, "-w", "d", "--field", field + "deg", "--pattern",
                             "sobol", "--rays", "8192", "--seed", str(seed), "--csv", "--columns",
                             "x_out,y_out,status")
        rows = [line.split(",") for line in result.stdout.decode().splitlines()[1:]]
        at = [(float(row[0]), float(row[1])) for row in rows if len(row) > 2 and row[2] == "ok"]
        if len(at) < 1000:
            return None
        x, y = (sum(one[i] for one in at) / len(at) for i in (0, 1))
        squares.append(sum((a - x) ** 2 + (b - y) ** 2 for a, b in at) / len(at))
    mean = sum(squares) / len(squares)
    spread = math.sqrt(sum((one - mean) ** 2 for one in squares) / 12)
    return 1000 * math.sqrt(mean), 1000 * spread / (2 * math.sqrt(mean))


def check_error(checks, program, lens, field):
    rows = rows_of(checks, program, f"{lens} {field}", lens, "-w", "d", "--field", field + "deg")
    truth = sobol_rms(program, lens, field)
    if not rows or truth is None:
        return
    value, error = float(rows[0]["rms_um"]), float(rows[0]["error_um"])
    checks.check(abs(value - truth[0]) <= error + 5 * truth[1],
                 f"spot {lens} --field {field}: {value} um and its error {error}, by rays of sobol "
                 f"{truth[0]} +- {truth[1]}")


def check_dark(checks, program):
    """A stop 30 mm behind a ball of air of 5 mm, seen at 40 degrees: 25 mm beside the ball."""
    lens = ("lens hidden\nobject inf\naperture stop\nsurface 5 30 air 9\nstop - 10 air 2\n"
            "thick 50 50 air -\n")
    result = program.run("spot", "-", "--field", "40", stdin=lens)
    checks.check(result.returncode == 1 and b"ends at surface 1 (miss)" in result.stderr,
                 f"a hidden stop: {result.stderr.decode()}")


def main():
    words = [word for word in sys.argv[1:] if not word.startswith("--")]
    checks, program = Checks(), Program(words[0])
    own = reference.own_cases(checks, OWN, reference_cases(),
                              "spots on grids, mm, by an independent 50-digit program; systems as "
                              ".lens files")
    for case in own:
        check_grids(checks, program, case)
    check_integrals(checks, program)
    check_dark(checks, program)
    check_samples(checks, program)
    for lens, field in (("double-gauss", "14"), ("nikkor-z-58-f095", "18"), ("fisheye-16", "60"),
                        ("phone-80deg", "28"), ("mirror-tele-us5331467", "0.3")):
        check_error(checks, program, lens, field)
    checks.finish()


main()
