#!/usr/bin/env python3
"""tests/truth/check_conjugates.py - focus, diffraction, equivalent, tilt and panorama against
numbers from outside: closed forms, published rules, and the tables of tests/truth.

Each check names its source. Tolerances are absolute unless a relative one is named.
"""
# SPDX-License-Identifier: MIT

import csv
import io
import math
import os
import random
import sys

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import ROOT, Checks, Program

EXACT = 4 * 2.0**-52  # relative, a handful of roundings


def rows_of(program, *words, stdin=""):
    """The rows of a call as {column: float or text}."""
    result = program.run(*words, "--csv", stdin=stdin)
    rows = list(csv.DictReader(io.StringIO(result.stdout.decode(), newline="")))
    return [{name: number(text) for name, text in row.items()} for row in rows]


def number(text):
    try:
        return float(text)
    except ValueError:
        return text


# sources of tests/truth/sources.tsv by how the words begin; the others are formulas
PRINTED = {"diffraction": "diffraction.tsv", "merklinger": "Merklinger", "hansma": "Hansma",
           "lecture": "lecture"}


def near(checks, actual, expected, tolerance, what, unit=""):
    """`what` is "case: quantity", and of a printed source begins with its name."""
    named = [name for name, start in PRINTED.items() if what.startswith(start)]
    case, _, quantity = what.rpartition(": ")
    checks.against((named + ["algebra"])[0], case, quantity, actual, expected, tolerance, unit)


def relative(checks, actual, expected, tolerance, what, unit=""):
    near(checks, actual, expected, tolerance * abs(expected), what, unit)


def check_focus(program, checks):
    row = rows_of(program, "focus", "-f", "100mm", "-m", "1:1", "-N", "8")[0]
    for column, expected in (("distance_m", 0.2), ("image_mm", 200), ("sensor_distance_m", 0.4),
                             ("working_fnumber", 16), ("exposure_factor", 4),
                             ("exposure_stops", 2)):
        near(checks, row[column], expected, 0, f"1:1, s = v = 2 f, two stops: {column}")
    # any pair of the five gives the other three: T = f (2 + m + 1/m)
    f, m = 85.0, 0.2
    known = {"-f": (f, "focal_mm", "mm"), "-s": (f * (1 + 1 / m), "distance_m", "mm"),
             "--image": (f * (1 + m), "image_mm", "mm"), "-m": (m, "magnification", ""),
             "--sensor-distance": (f * (2 + m + 1 / m), "sensor_distance_m", "mm")}
    options = list(known)
    for i, first in enumerate(options):
        for second in options[i + 1:]:
            words = [word for name in (first, second)
                     for word in (name, f"{known[name][0]!r}{known[name][2]}")]
            row = rows_of(program, "focus", *words)[0]
            for value, column, unit in known.values():
                expected = value / 1000 if column.endswith("_m") else value
                relative(checks, row[column], expected, 1e-13, f"focus {words} {column}")
    # a 25 mm tube on 50 mm at infinity gives 1:2; +2 dioptres on 100 mm 1:5 at 50 cm
    row = rows_of(program, "focus", "-f", "50", "--tube", "25")[0]
    near(checks, row["magnification"], 0.5, 1e-15, "tube: m = e/f")
    row = rows_of(program, "focus", "-f", "100", "--close-up", "2")[0]
    relative(checks, row["magnification"], 0.2, EXACT, "close-up lens: m = f/F")
    relative(checks, row["distance_m"], 0.5, EXACT, "close-up lens: subject in its focus")
    row = rows_of(program, "focus", "-f", "200", "--stacked", "50")[0]
    relative(checks, row["magnification"], 4, EXACT, "stacked lenses: m = f/F")
    row = rows_of(program, "focus", "-f", "100", "-N", "4", "-m", "0.5", "--converter", "2")[1]
    relative(checks, row["magnification"], 1, EXACT, "a 2x converter doubles m")
    relative(checks, row["working_fnumber"], 12, EXACT, "and the working f-number: 2 x 4 x 1.5")


def check_batch(program, checks):
    """The batch gives what the thin-lens equation gives in Python's doubles."""
    random.seed(4)
    table = [(random.choice((20, 50, 105, 300)), random.uniform(400, 50000)) for _ in range(200)]
    text = "f_mm,s_mm\n" + "".join(f"{f},{s!r}\n" for f, s in table)
    rows = rows_of(program, "focus", "--batch", "-", "--columns", "image_mm,magnification",
                   stdin=text)
    checks.check(len(rows) == len(table), f"focus --batch: {len(rows)} rows of {len(table)}")
    for (f, s), row in zip(table, rows):
        relative(checks, row["image_mm"], 1 / (1 / f - 1 / s), 1e-12, f"1/f = 1/s + 1/v: {f} {s}")
        relative(checks, row["magnification"], f / (s - f), 1e-12, f"m = f/(s - f): {f} {s}")


def check_diffraction(program, checks):
    row = rows_of(program, "diffraction", "-N", "64", "-w", "500nm")[0]
    near(checks, row["airy_radius_um"], 39.04, 0.011, "lecture, f/64 and 0.5 um: 1.22 N w", "um")
    near(checks, row["airy_radius_um"], 39.029437, 1e-6, "first zero of J1 3.8317059702/pi")
    near(checks, row["cutoff_per_mm"], 31.25, 1e-13, "1/(w N)")
    with open("tests/truth/diffraction.tsv") as file:
        table = [line for line in file if not line.startswith("#")]
    for case in csv.DictReader(table, delimiter="\t"):
        row = rows_of(program, "diffraction", "-N", case["fnumber"],
                      "-w", case["wavelength_mm"] + "mm", "--frequency",
                      case["frequency_per_mm"])[0]
        what = f"diffraction.tsv f/{case['fnumber']} {case['wavelength_mm']} mm: "
        near(checks, row["mtf_lens"], float(case["mtf"]), 1e-13, what + "mtf")
        relative(checks, row["cutoff_per_mm"], float(case["cutoff_per_mm"]), 1e-14,
                 what + "cut-off", "1/mm")
        row = rows_of(program, "diffraction", "-N", case["fnumber"],
                      "-w", case["wavelength_mm"] + "mm")[0]
        relative(checks, row["airy_radius_um"], 1000 * float(case["airy_radius_mm"]), 1e-14,
                 what + "Airy radius", "um")
    # Hansma 1996: N = sqrt(375 dv) for green light
    row = rows_of(program, "diffraction", "--focus-spread", "3", "-w", "546")[0]
    relative(checks, row["optimum_fnumber"], math.sqrt(375 * 3), 0.002, "Hansma, 3 mm of focus: best f-number")
    # the Nyquist frequency of 5 um pixels is 100 per mm; their MTF there 2/pi
    row = rows_of(program, "diffraction", "-N", "8", "--pitch", "5um", "--frequency", "100")[0]
    relative(checks, row["nyquist_per_mm"], 100, EXACT, "Nyquist")
    relative(checks, row["mtf_pixel"], 2 / math.pi, EXACT, "sinc at Nyquist")
    # Airy disc of two 4 um pixels at 550 nm: 8/(2.43934 x 0.55)
    row = rows_of(program, "diffraction", "--pitch", "4um")[0]
    relative(checks, row["fnumber_pixel"], 8 / (2 * 3.8317059702075123 / math.pi * 0.55), EXACT,
             "f-number of the pixels")


def check_equivalent(program, checks):
    row = rows_of(program, "equivalent", "-f", "50", "-N", "1.8", "--iso", "200", "--sensor",
                  "17.3x13mm")[0]
    k = math.hypot(36, 24) / math.hypot(17.3, 13)
    for column, expected in (("ratio", k), ("equal_focal_mm", 50 * k), ("equal_fnumber", 1.8 * k),
                             ("equal_iso", 200 * k * k)):
        relative(checks, row[column], expected, 2 * EXACT, f"50 f/1.8 on 4/3: {column}")
    near(checks, row["equal_focal_mm"], 100, 0.1, "the usual factor 2")
    near(checks, row["light_stops"], 0, 1e-14, "the same light in all")
    row = rows_of(program, "equivalent", "-f", "100", "-N", "8", "-m", "1", "--to", "18x12mm")[0]
    near(checks, row["equal_magnification"], 0.5, 1e-15, "half the format, half the size")
    # entrance pupil to subject stays: f (1 + 1/m) = 200 = f'(1 + 2)
    relative(checks, row["equal_focal_mm"], 200 / 3, EXACT, "close up: f'(1 + 1/m') = f (1 + 1/m)")


def check_tilt(program, checks):
    # Merklinger, View Camera, July/August 1996: 150 mm lens, J in feet and tilt
    for feet, degrees, tolerance in ((4.2, 7, 0.3), (2.03, 14, 0.2), (7, 4, 0.1)):
        row = rows_of(program, "tilt", "-f", "150", "-N", "11", "--hinge", f"{feet}ft", "--angle",
                      "90deg", "-c", "0.1")[0]
        near(checks, row["tilt_deg"], degrees, tolerance, f"Merklinger, J = {feet} ft: tilt",
             "deg")
    row = rows_of(program, "tilt", "-f", "150", "-N", "11", "--tilt", "7", "--angle", "90", "-c",
                  "0.1")[0]
    near(checks, row["hyperfocal_m"] / 0.3048, 67, 0.5, "Merklinger: about 67 feet", "ft")
    relative(checks, row["half_height"] * row["hyperfocal_m"], row["hinge_m"] * math.cos(
        math.radians(7)), 1e-13, "J on either side at H, times f/v'")
    relative(checks, row["image_mm"], 150 / math.cos(math.radians(7)), EXACT, "v' = f/cos a")
    # Scheimpflug: lens plane and sensor plane meet at v'/tan a below the lens
    relative(checks, 1000 * row["scheimpflug_m"], row["image_mm"] / math.tan(math.radians(7)),
             1e-14, "lens and sensor plane meet")
    # untilted it is an ordinary camera: 1/f = 1/u + 1/v', limits of dof
    row = rows_of(program, "tilt", "-f", "90", "-N", "16", "--tilt", "0", "-s", "3", "-c", "0.03")[0]
    plain = rows_of(program, "dof", "-f", "90", "-N", "16", "-s", "3", "-c", "0.03")[0]
    relative(checks, row["image_mm"], plain["image_mm"], 1e-13, "untilted: image")
    relative(checks, row["near_m"], plain["near_m"], 1e-12, "untilted: near limit")
    relative(checks, row["far_m"], plain["far_m"], 1e-12, "untilted: far limit")
    # through two points: sin a = f (1/u1 - 1/u2)/(y2/u2 - y1/u1)
    row = rows_of(program, "tilt", "-f", "90", "-N", "16", "--through", "2m:-1.5m,30m:0m")[0]
    sine = 90 * (1 / 2000 - 1 / 30000) / 0.75
    relative(checks, row["tilt_deg"], math.degrees(math.asin(sine)), 1e-14, "through two points")
    relative(checks, row["distance_m"], 30, 1e-12, "the second lies straight ahead")


def check_panorama(program, checks):
    row = rows_of(program, "panorama", "-f", "24", "--portrait")[0]
    relative(checks, row["horizontal_deg"], 2 * math.degrees(math.atan(0.5)), EXACT, "3-4-5")
    near(checks, row["columns"], math.ceil(360 / (row["horizontal_deg"] * 0.7)), 0, "a full turn")
    near(checks, row["step_deg"], 36, 1e-13, "ten even steps")
    # arc of 90 degrees, frames of 30, overlap 1/4: (90 - 7.5)/22.5 = 3.67
    row = rows_of(program, "panorama", "--horizontal", "30deg", "--vertical", "20deg", "--arc",
                  "90deg", "--overlap", "25%")[0]
    near(checks, row["columns"], 4, 0, "an arc")
    near(checks, row["step_deg"], 20, 1e-13, "three steps from 15 to 75 degrees")
    # small angles: parallax is about offset x step/near
    row = rows_of(program, "panorama", "--horizontal", "2deg", "--vertical", "2deg", "--arc",
                  "3deg", "--overlap", "50%", "--offset", "10mm", "--near", "10m")[0]
    relative(checks, row["parallax_deg"], 0.01 / 10 * row["step_deg"], 0.002, "parallax, small")


def check_refusals(program, checks):
    for words, said in ((("focus", "-f", "50", "-s", "40mm"), "more than 50 mm"),
                        (("focus", "-f", "50", "--sensor-distance", "19cm"), "200 mm or more"),
                        (("tilt", "-f", "90", "-N", "8", "--tilt", "95deg", "-s", "2"),
                         "-90 to 90"),
                        (("tilt", "-f", "90", "-N", "8", "--hinge", "5cm", "-s", "2"), "above 90"),
                        (("diffraction", "-N", "0"), "above 0"),
                        (("panorama", "-f", "24", "--arc", "400deg"), "360"),
                        (("panorama", "-f", "24", "--per-row", "4"), "at least 5")):
        result = program.run(*words)
        checks.check(result.returncode == 1 and said in result.stderr.decode() and
                     result.stdout == b"",
                     f"{' '.join(words)}: status {result.returncode}, {result.stderr.decode()}")


def main():
    os.chdir(ROOT)
    checks, program = Checks(), Program(sys.argv[1])
    check_focus(program, checks)
    check_batch(program, checks)
    check_diffraction(program, checks)
    check_equivalent(program, checks)
    check_tilt(program, checks)
    check_panorama(program, checks)
    check_refusals(program, checks)
    checks.finish()


main()
