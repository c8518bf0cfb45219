#!/usr/bin/env python3
"""tests/truth/check_errors.py - errors as they are printed against true ones: check_errors.py BUILD

The truth of a row is the same answer by ten to a hundred times as many rays, whose own error counts
too; that integrals converge to the right value is judged in check_spots.py and check_illumination.py
by numbers from outside. Largest radii: closed forms, and plain patterns that never come farther.
A few lenses; with LENSCALC_ALL set all of lensdb.
"""
# SPDX-License-Identifier: MIT

import csv
import io
import math
import os
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program

LENSES = ("double-gauss", "fisheye-16", "laikin45-achromat", "mld65-gauss-telescope-100",
          "nikkor-z-58-f095", "phone-80deg", "questar-35")
RMS = ("rms", "rms_x", "rms_y", "rms_chief")
MOST = 100  # times the true error
MIRROR = ("lens paraboloid\nwavelength d\nobject inf\naperture stop\n"
          "surface -200 -100 mirror 80 k=-1 stop\n")
worst = {"spot": (0, ""), "illumination": (0, "")}


def rows_of(program, *words, stdin=b""):
    result = program.run(*words, "--csv", stdin=stdin)
    return list(csv.DictReader(io.StringIO(result.stdout.decode(), newline="")))


def compare(checks, name, kind, error, true, doubt, most=None):
    checks.check(error >= true - doubt, f"{name}: off by {true:.3g}, the error printed is {error:.3g}")
    if most is not None and max(true, doubt) > 0:
        ratio = error / max(true, doubt)
        worst[kind] = max(worst[kind], (ratio, name))
        checks.check(ratio <= most, f"{name}: the error printed is {ratio:.0f} times the true one")


def check_spot(checks, program, lens):
    columns = ["field", "height", *(f"{name}_{unit}" for unit in ("um", "mrad")
                                    for name in (*RMS, "error", "radius", "radius_error"))]
    words = ["spot", lens, "--columns", ",".join(columns)]
    for row, better in zip(rows_of(program, *words), rows_of(program, *words, "--error", "1e-9")):
        unit = "_um" if row["rms_um"] else "_mrad"
        if not row["rms" + unit]:
            continue
        name = f"spot {lens} {row['field_deg'] or row['height_mm']}"
        true = max(abs(float(row[one + unit]) - float(better[one + unit]))
                   for one in RMS if row[one + unit])
        compare(checks, name, "spot", float(row["error" + unit]), true,
                float(better["error" + unit]), MOST)
        true = abs(float(row["radius" + unit]) - float(better["radius" + unit]))
        compare(checks, name + ": radius", "spot", float(row["radius_error" + unit]), true,
                float(better["radius_error" + unit]))


def check_plain(checks, program, lens):
    """One wavelength, about the chief ray, so that the samples' centroids do not matter."""
    words = ["spot", lens, "-w", "d", "--reference", "chief", "--columns",
             "field,radius,radius_error,warning"]
    plain = rows_of(program, *words, "--pattern", "hexapolar", "--rays", "3000")
    for row, sample in zip(rows_of(program, *words), plain):
        if not row["radius_um"] or not sample["radius_um"] or "gap" in row["warning"]:
            continue  # plain patterns have rays beyond gaps too
        largest, least = float(row["radius_um"]), float(sample["radius_um"])
        name = f"spot {lens} {row['field_deg']}"
        checks.check(least <= largest + float(row["radius_error_um"]),
                     f"{name}: radius {largest}, but a ray of a plain pattern is at {least}")


def check_illumination(checks, program, lens):
    words = ["illumination", lens, "--columns", "height,irradiance_per_radiance,irradiance_error"]
    for row, better in zip(rows_of(program, *words), rows_of(program, *words, "--error", "1e-11")):
        if row["irradiance_per_radiance"]:
            true = abs(float(row["irradiance_per_radiance"])
                       - float(better["irradiance_per_radiance"]))
            compare(checks, f"illumination {lens} {row['height_mm']}", "illumination",
                    float(row["irradiance_error"]), true, float(better["irradiance_error"]))


def check_mirror(checks, program):
    """Behind the focus of a paraboloid the ray of the height h runs at tan t = 2u/(1 - u^2), u =
    h/2f; the mirror is 80 mm wide, f = 100."""
    row = rows_of(program, "spot", "-", "--defocus", "1", "--columns", "radius,radius_error",
                  stdin=MIRROR)[0]
    expected = 1000 * (2 * 0.2 / (1 - 0.2 ** 2))
    checks.check(math.isclose(float(row["radius_um"]), expected, rel_tol=1e-9),
                 f"radius behind a paraboloid's focus: {row['radius_um']}, expected {expected}")
    # equal areas: a share s of the light lies within the height 40 sqrt(s) of the mirror
    for row in rows_of(program, "spot", "-", "--defocus", "1", "--energy", "20%,50%,80%,99%",
                       "--columns", "energy,energy_radius,energy_error", stdin=MIRROR):
        u = 40 * math.sqrt(float(row["energy_percent"]) / 100) / 200
        expected = 1000 * 2 * u / (1 - u * u)
        off, error = abs(float(row["energy_radius_um"]) - expected), float(row["energy_error_um"])
        checks.check(off <= error <= 1e-3 * expected,
                     f"{row['energy_percent']} % behind a paraboloid's focus: "
                     f"{row['energy_radius_um']} +- {error}, expected {expected}")


def check_energy(checks, program, lens):
    """Against a plain pattern of many rays, which is right to about 1e-3."""
    words = ["spot", lens, "--energy", "50%,80%", "--columns",
             "field,energy,energy_radius,energy_error"]
    plain = rows_of(program, *words, "--pattern", "sobol", "--rays", "60000")
    for row, sample in zip(rows_of(program, *words), plain):
        if row["energy_radius_um"] and sample["energy_radius_um"]:
            here, there = float(row["energy_radius_um"]), float(sample["energy_radius_um"])
            checks.check(abs(here - there) <= float(row["energy_error_um"]) + 2e-3 * here,
                         f"spot {lens} {row['field_deg']}: {row['energy_percent']} % within {here}"
                         f" +- {row['energy_error_um']}, of a plain pattern within {there}")


def main():
    checks, program = Checks(), Program(sys.argv[1])
    lenses = LENSES
    if os.environ.get("LENSCALC_ALL"):
        lenses = [row["lens"] for row in rows_of(program, "list", "lenses")]
    check_mirror(checks, program)
    for lens in lenses:
        check_spot(checks, program, lens)
        check_plain(checks, program, lens)
        if lens in ("questar-35", "phone-80deg"):
            check_energy(checks, program, lens)
        check_illumination(checks, program, lens)
    if "-v" in sys.argv:
        print(worst)
    checks.finish()


if __name__ == "__main__":
    main()
