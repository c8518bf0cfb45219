#!/usr/bin/env python3
"""tests/truth/check_illumination.py - lenscalc illumination against numbers from outside:
check_illumination.py BUILD_DIR

field.json: relative illumination in the image point of a chief ray and by the rays of its object
point, where the stop alone limits, by an independent program of 50 digits. Irradiance over the
film of four camera lenses by an independent quadrature (check_exact.py has the numbers). Closed
form of a disc, off its axis.
"""
# SPDX-License-Identifier: MIT

import csv
import io
import json
import math
import os
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from check_exact import IRRADIANCE
from harness import Checks, Program



def check_relative(checks, program, case, truth):
    fields = [field for field in truth["fields"]
              if field.get("rel_illum_point") and float(field["fraction"]) > 0]
    if not fields or float(case["plane"]) < 0:
        return
    name = case["name"]
    heights = ",".join(field["y"] for field in fields)
    table = program.rows("illumination", "-", "--height=" + heights, "--focus", case["plane"],
                         "--no-clip", "--error", "1e-12", text=case["lens"])
    if not checks.check(isinstance(table, list) and len(table) == len(fields), f"{name}: {table}"):
        return
    for row, field in zip(table, fields):
        where = f"{name} at {field['fraction']}"
        checks.against("illumination", where, "relative_point", row["relative_point"],
                       field["rel_illum_point"], 1e-12)
        checks.against("illumination", where, "relative_field", row["relative_field"],
                       field["rel_illum_field"], 1e-12)
        checks.check(row["vignetted_fraction"] == "0", f"{where}: vignetted without clip")


def check_irradiance(checks, program):
    for key, truth in IRRADIANCE.items():
        lens, _, stop = key.partition("@")
        heights = ",".join(str(radius) for radius in truth)
        table = program.rows("illumination", lens, "--height", heights, "--focus", "paraxial",
                             *(["--stop-diameter", stop] if stop else []))
        if not checks.check(isinstance(table, list), f"{key}: {table}"):
            continue
        for row in table:
            expected = truth[float(row["height_mm"])]
            checks.against("irradiance", f"{key} at {row['height_mm']} mm", "illumination: E/L",
                           row["irradiance_per_radiance"], expected, 2e-4 * expected)
            checks.check(float(row["irradiance_error"]) <= 1e-4 * expected,
                         f"{key}: error {row['irradiance_error']} at {row['height_mm']}")


def disc(tan_a, tan_t):
    """E/L of a disc of the half angle a on its axis, at the angle t from it."""
    a2, t2 = tan_a ** 2, tan_t ** 2
    return math.pi / 2 * (1 - (1 + t2 - a2) /
                          math.sqrt(t2 ** 2 + 2 * t2 * (1 - a2) + (1 + a2) ** 2))


def check_disc(checks, program):
    lens = "lens disc\nobject inf\naperture stop\nstop - 0 air 50\n"
    table = program.rows("illumination", "-", "--focus", "50", "--height", "0,10,40,100",
                         "--error", "1e-13",
                         text=lens)
    if checks.check(isinstance(table, list), f"disc: {table}"):
        for row in table:
            expected = disc(0.5, float(row["height_mm"]) / 50)
            checks.against("algebra", f"disc at {row['height_mm']} mm", "E/L",
                           row["irradiance_per_radiance"], expected, 1e-13 * expected)
    # the film 1 mm behind a window of no power: it sees the disc far beside the last vertex
    near_film = "lens disc\nobject inf\naperture stop\nstop - 49 air 50\nsurface - 0 air -\n"
    for command in ("illumination", "pupil"):
        words = ["--focus", "1", "--height", "0,10,40,100"]
        result = program.run(command, "-", *words, "--csv", "--columns",
                             "height,irradiance_per_radiance", stdin=near_film)
        table = list(csv.DictReader(io.StringIO(result.stdout.decode())))
        checks.check(len(table) >= 4, f"{command}, a film close by: {result.stderr.decode()}")
        for row in table:
            expected = disc(0.5, float(row["height_mm"]) / 50)
            checks.against("algebra", f"{command}, a film close by, at {row['height_mm']} mm", "E/L",
                           row["irradiance_per_radiance"], expected, 1e-7 * expected)
    half = program.rows("illumination", "-", "--focus", "50", "--height", "10",
                        "--stop-diameter", "25", text=lens)
    if checks.check(isinstance(half, list), f"half a disc: {half}"):
        checks.against("algebra", "a disc of half the diameter", "E/L",
                       half[0]["irradiance_per_radiance"], disc(0.25, 0.2), 1e-12)


def check_lune(checks, program):
    """
    A stop of radius 5 and an opening of radius 4.1, 20 mm behind it and 80 mm before the image:
    from a point h beside the axis a circle of radius 4 about 0.2 h looks through one about 0. What
    is lost grows from 0 at h = 0.5, and what is less than the rounding of two integrals is 0.
    """
    lens = ("lens two circles\nobject inf\nfield angle 0 1\naperture stop\n"
            "stop - 20 air 10\nsurface - 80 air 8.2\n")
    table = program.rows("illumination", "-", "--focus", "table", "--error", "1e-9", "--height",
                         "0,0.3,0.499,0.5,1,2", text=lens)
    if checks.check(isinstance(table, list), f"two circles: {table}"):
        for row in table[:4]:
            checks.check(row["vignetted_fraction"] == "0",
                         f"two circles: {row['vignetted_fraction']} at {row['height_mm']}")
        for row in table[4:]:
            checks.check(float(row["vignetted_fraction"]) > 0.01,
                         f"two circles: {row['vignetted_fraction']} at {row['height_mm']}")
    for name in ("canon-rf50-f12", "nikkor-z-58-f095", "zeiss-biotar-100", "phone-80deg"):
        axis = program.rows("illumination", name, "--height", "0")
        checks.check(isinstance(axis, list) and axis[0]["vignetted_fraction"] == "0",
                     f"{name}: something is vignetted on the axis: {axis}")


def main():
    program, checks = Program(sys.argv[1]), Checks()
    with open("tests/truth/check.json", encoding="utf-8") as file:
        lenses = {case["name"]: case for case in json.load(file)["cases"]}
    with open("tests/truth/field.json", encoding="utf-8") as file:
        cases = json.load(file)["cases"]
    for truth in cases:
        check_relative(checks, program, lenses[truth["name"]], truth)
    check_irradiance(checks, program)
    check_disc(checks, program)
    check_lune(checks, program)
    checks.finish()


if __name__ == "__main__":
    main()
