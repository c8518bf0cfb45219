#!/usr/bin/env python3
"""tests/truth/check_exact.py - lenscalc check and lenscalc pupil against numbers from outside:
check_exact.py BUILD_DIR

check.json: axis crossings, apertures, image heights and relative illumination by an independent
program of 50 digits. Closed forms: the spherical mirror, the ball lens, stigmatic surfaces. The
irradiance over the film of four camera lenses is an independent quadrature on a grid of 3000^2.
"""
# SPDX-License-Identifier: MIT

import json
import math
import os
import subprocess
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program
from photographs import DOUBLE_GAUSS, IRRADIANCE as PHOTOGRAPHED


# film radius in mm: irradiance per unit radiance, good to about 1e-4
IRRADIANCE = {
    DOUBLE_GAUSS: {**PHOTOGRAPHED, 21.633: .031036},
    "cs348b-dgauss-50@4.275": {0: .011921, 10: .011215, 20: .009499, 21.633: .009179},
    "cs348b-wide-22": {0: .101025, 5: .086408, 10: .062632, 13.5: .045164, 17: .029989},
    "cs348b-telephoto-250": {0: .025110, 10: .024934, 20: .024410, 21.633: .024148},
    "cs348b-fisheye-10": {0: .049239, 4: .041914, 8: .027329, 12: .012785},
}


def pick(table, quantity, fraction):
    for row in table:
        if row["quantity"] == quantity and abs(float(row["fraction"]) - fraction) < 1e-9:
            return row
    return None


def check_aperture(checks, program, case):
    table = program.rows("check", "-", text=case["lens"])
    name = case["name"]
    if not checks.check(isinstance(table, list), f"{name}: {table}"):
        return
    for pupil, truth in case["lsa"].items():
        h = float(pupil)
        place = pick(table, "bfl", h) or pick(table, "image", h)
        if place is not None:
            z = float(truth["z_axis"])
            checks.against("exact", f"{name} at {pupil}", "axis crossing", place["exact"],
                           truth["z_axis"],
                           1e-13 * (abs(z) + 100) / min(1, 10 * abs(float(truth["NA"]))), "mm")
        speed = pick(table, "working_fnumber", h)
        if speed is not None:
            expected = 1 / (2 * abs(float(truth["NA"])))
            checks.against("exact", f"{name} at {pupil}", "f-number", speed["exact"], expected,
                           1e-11 * expected)
        height = pick(table, "transverse", h)
        if height is not None and case["focus"] == "paraxial":
            checks.against("exact", f"{name} at {pupil}", "transverse", height["exact"], truth["ty"],
                           2e-12, "mm")


def field_words(case, fraction):
    return ["--field", f"{case['field']['value'] * fraction!r}deg"]


def check_fields(checks, program, case):
    name = case["name"]
    if case["focus"] != "paraxial":
        return
    angle = case["field"]["type"] == "angle_deg"
    for field in case["fields"]:
        fraction = float(field["fraction"])
        words = field_words(case, fraction) if angle else []
        if not angle and fraction != 1:
            continue
        table = program.rows("check", "-", "--steps", "1", *words, text=case["lens"])
        if not checks.check(isinstance(table, list), f"{name}: {table}"):
            continue
        row = pick(table, "image_height", 1)
        if not checks.check(row is not None, f"{name}: no image height"):
            continue
        checks.against("exact", f"{name} at {fraction}", "image height", row["exact"], field["y"],
                       1e-13 * (abs(float(field["y"])) + 10), "mm")
        checks.against("exact", f"{name} at {fraction}", "paraxial height", row["paraxial"],
                       field["y_parax"], 1e-13 * (abs(float(field["y_parax"])) + 10), "mm")


def check_illumination(checks, program, case):
    """Relative illumination at the image of the chief ray; only the stop limits there."""
    name = case["name"]
    lines = [line.split() for line in case["lens"].splitlines()]
    rimless = "".join(" ".join(line[:4] + ["-"] + line[5:] if line[0] == "surface" else line) + "\n"
                      for line in lines)
    for field in case["fields"]:
        if field["rel_illum_point"] is None or float(case["plane"]) < 0:
            continue
        table = program.rows("pupil", "-", "--height", field["y"], "--focus", case["plane"],
                             "--side", "exit", text=rimless)
        if not checks.check(isinstance(table, list), f"{name}: {table}"):
            continue
        checks.against("illumination", f"{name} at {field['fraction']}", "illumination",
                       table[0]["illumination"], field["rel_illum_point"], 1e-12)


def check_irradiance(checks, program):
    for key, truth in IRRADIANCE.items():
        lens, _, stop = key.partition("@")
        words, text = [lens], None
        if stop:
            shown = subprocess.run(program.command + ["convert", lens, "--to", "lens"], text=True,
                                   capture_output=True, env=program.environment())
            lines = [line if not line.startswith("stop") else
                     " ".join(line.split()[:-1] + [stop]) for line in shown.stdout.splitlines()]
            if not checks.check(shown.returncode == 0, f"{lens}: {shown.stderr}"):
                continue
            words, text = ["-"], "\n".join(lines) + "\n"
        heights = ",".join(str(radius) for radius in truth)
        table = program.rows("pupil", *words, "--height", heights, "--focus", "paraxial",
                             "--side", "exit", text=text)
        if not checks.check(isinstance(table, list), f"{key}: {table}"):
            continue
        for row in table:
            expected = truth[float(row["height_mm"])]
            checks.against("irradiance", f"{key} at {row['height_mm']} mm", "pupil: E/L",
                           row["irradiance_per_radiance"], expected, 2e-4 * expected)


def check_mirror(checks, program):
    """R(1 - 1/(2 sqrt(1 - (y/R)^2))) from the vertex; the principal surface is the mirror."""
    R, D = 400.0, 300.0
    text = f"lens mirror\nobject inf\naperture epd {D}\nstop - 0 air {D}\nsurface -{R} -200 mirror {D}\n"
    table = program.rows("check", "-", "--steps", "5", text=text)
    if not checks.check(isinstance(table, list), f"mirror: {table}"):
        return
    for row in table:
        if row["quantity"] != "bfl":
            continue
        y = float(row["fraction"]) * D / 2
        focus = -(R - R / (2 * math.sqrt(1 - (y / R) ** 2)))
        checks.against("algebra", f"mirror at {y} mm", "bfl", row["exact"], focus, 1e-14 * R, "mm")
        checks.against("algebra", "mirror", "paraxial bfl", row["paraxial"], -R / 2, 1e-13 * R, "mm")
        checks.check(abs(float(row["order"]) - 2) < 0.02, f"mirror: order {row['order']}")
    row = pick(table, "transverse", 1)
    checks.check(abs(float(row["order"]) - 3) < 0.02, f"mirror, across: order {row['order']}")


def check_ball(checks, program):
    """By angles: I = asin(y/R), the ray is turned by 2 (I - I'), f = nD/(4(n - 1))."""
    n, R = 1.5, 10.0
    text = (f"lens ball\nobject inf\naperture epd 12\nstop - 0 air 12\nsurface {R} {2 * R} {n} -\n"
            f"surface -{R} 5 air -\n")
    table = program.rows("check", "-", "--steps", "5", text=text)
    if not checks.check(isinstance(table, list), f"ball: {table}"):
        return
    for row in table:
        y = float(row["fraction"]) * 6
        turn = 2 * (math.asin(y / R) - math.asin(y / (n * R)))
        if row["quantity"] == "efl":
            checks.against("algebra", f"ball at {y} mm", "efl", row["exact"], y / math.sin(turn),
                           1e-14 * R, "mm")
            checks.against("algebra", "ball", "paraxial efl", row["paraxial"],
                           n * 2 * R / (4 * (n - 1)), 1e-13 * R, "mm")
        if row["quantity"] == "bfl":
            checks.against("algebra", f"ball at {y} mm", "bfl", row["exact"], y / math.sin(turn) - R,
                           1e-14 * R, "mm")
        if row["quantity"] == "rear_principal":
            # both lines pass the centre at y: they meet on the line that halves their angle
            z = y * math.tan(turn / 2) - R
            checks.against("algebra", f"ball at {y} mm", "principal surface", row["exact"], z,
                           1e-13 * R, "mm")
        if row["quantity"] in ("efl", "bfl", "rear_principal", "ffl", "front_principal"):
            checks.check(abs(float(row["order"]) - 2) < 0.02, f"ball: order {row['order']}")


def check_stigmatic(checks, program):
    """A parabola and a plano-hyperboloid have no spherical aberration at all."""
    for name, text in (
            ("parabola", "lens parabola\nobject inf\naperture epd 150\nstop - 0 air 150\n"
                         "surface -400 -200 mirror 150 k=-1\n"),
            ("hyperboloid", "lens hyperboloid\nobject inf\naperture epd 40\nstop - 0 air 40\n"
                            "surface - 20 1.5 -\nsurface -50 100 air - k=-2.25\n")):
        table = program.rows("check", "-", text=text)
        if not checks.check(isinstance(table, list), f"{name}: {table}"):
            continue
        for row in table:
            if row["quantity"] == "bfl":
                checks.against("algebra", name, "bfl", row["exact"], row["paraxial"], 1e-12, "mm")
                checks.check(row["order"] == "" and "equal to rounding" in row["verdict"],
                             f"{name}: {row['verdict']}")


def check_orders(checks, program):
    """Third-order theory: 2 along the axis, 3 across, for a lens that is not corrected."""
    expected = {"efl": 2, "bfl": 2, "rear_principal": 2, "ffl": 2, "front_principal": 2,
                "working_fnumber": 2, "transverse": 3, "image_height": 3, "entrance_pupil": 2,
                "exit_pupil": 2}
    for lens in ("double-gauss", "cooke-triplet-50", "telephoto-200", "wide-35"):
        for row in program.rows("check", lens, "--steps", "1"):
            checks.check(row["order"] != "" and
                         abs(float(row["order"]) - expected[row["quantity"]]) < 0.06,
                         f"{lens}: order of {row['quantity']} is {row['order']}")


def check_shapes(checks, program):
    """A stop alone: discs, seen at an angle; a second rim cuts a lens of two arcs from it."""
    a = 5.0
    text = "lens stop\nobject inf\naperture stop\nstop - 10 air 10\nsurface - 10 air -\n"
    for t in (0, 30, 60):
        row = program.rows("pupil", "-", "--field", f"{t}deg", text=text)[0]
        disc = math.pi * a * a
        checks.against("algebra", f"disc at {t} deg", "area", row["area_mm2"], disc, 1e-12 * disc,
                       "mm2")
        checks.against("algebra", f"disc at {t} deg", "projected area", row["projected_mm2"],
                       disc * math.cos(math.radians(t)), 1e-12 * disc, "mm2")
        for end in ("x_max", "y_max"):
            checks.against("algebra", f"disc at {t} deg", end, row[f"{end}_mm"], a, 1e-9, "mm")
    text = "lens two rims\nobject inf\naperture stop\nstop - 10 air 10\nsurface - 10 air 10\n"
    t = math.atan(0.4)  # the rims are seen 4 mm apart
    row = program.rows("pupil", "-", "--field", f"{math.degrees(t)!r}deg", text=text)[0]
    d = 4.0
    eye = 2 * a * a * math.acos(d / (2 * a)) - d / 2 * math.sqrt(4 * a * a - d * d)
    checks.against("algebra", "cat's eye", "area", row["area_mm2"], eye, 2e-5 * eye, "mm2")
    checks.against("algebra", "cat's eye", "top", row["y_max_mm"], a - d, 1e-9, "mm")
    checks.against("algebra", "cat's eye", "bottom", row["y_min_mm"], -a, 1e-9, "mm")
    checks.against("algebra", "cat's eye", "side", row["x_max_mm"],
                   math.sqrt(a * a - d * d / 4), 1e-4, "mm")
    checks.against("algebra", "cat's eye", "vignetting", row["vignetting_upper"], d / a, 1e-9)
    checks.check((row["upper_surface"], row["lower_surface"]) == ("2", "1"),
                 f"cat's eye: limits {row['upper_surface']} {row['lower_surface']}")
    row = program.rows("pupil", "-", "--field", "60deg", text=text)[0]
    checks.check(row["status"] == "clipped" and row["surface"] == "2" and
                 float(row["fraction"]) == 0, f"nothing arrives: {row['status']} {row['surface']}")


def check_film(checks, program):
    """One film for all wavelengths: at the primary one's paraxial image, by the program of 50
    digits."""
    for line in ("d", "F", "C"):
        table = program.rows("pupil", "double-gauss", "-w", line, "--height", "5")
        if checks.check(isinstance(table, list), f"film at {line}: {table}"):
            checks.against("first-order", f"double-gauss, film at {line}", "image", table[0]["film_mm"],
                           72.211810477084275, 1e-12, "mm")


def check_symmetry(checks, program):
    """What a lens with an axis lets through is the same on both sides, also without a chief ray."""
    for lens, field in (("fisheye-16", 75), ("double-gauss", 14), ("wide-35", 30)):
        for row in program.rows("pupil", lens, "--field", f"{field}deg"):
            for plane in ("", "vertex_"):
                right = float(row[f"{plane}x_max_mm"])
                checks.near("symmetry", f"{lens}, {row['pupil']}: {plane}x_min",
                            row[f"{plane}x_min_mm"], -right, 1e-12 * right)


def check_sweep(checks, program):
    """Points of a sweep say what they say alone: shapes on the axis that are kept are the right
    ones."""
    names = ("double-gauss", "cs348b-dgauss-50")
    swept = [program.rows("pupil", name, "--height", "0,7,14", "-w", wave, "-N", stop)
             for name in names for wave in ("d", "F") for stop in ("2.8", "4")]
    text = "lens,height,w,N\n" + "".join(
        f"{name},{height},{wave},{stop}\n" for height in (0, 7, 14) for stop in ("2.8", "4")
        for wave in ("d", "F") for name in names)
    mixed = program.rows("pupil", "--batch", "-", text=text)
    if not checks.check(isinstance(mixed, list), f"sweep: {mixed}"):
        return
    keys = ("wavelength_nm", "height_mm", "pupil", "film_mm", "area_mm2", "fraction",
            "projected_fraction", "illumination")
    alone = sorted(tuple(row[key] for key in keys) for table in swept for row in table)
    checks.check(alone == sorted(tuple(row[key] for key in keys) for row in mixed),
                 "sweep: points of a batch differ from those of sweeps")


def main():
    program = Program(sys.argv[1])
    checks = Checks()
    with open("tests/truth/check.json", encoding="utf-8") as file:
        cases = json.load(file)["cases"]
    for case in cases:
        check_aperture(checks, program, case)
        check_fields(checks, program, case)
        check_illumination(checks, program, case)
    check_irradiance(checks, program)
    check_film(checks, program)
    check_symmetry(checks, program)
    check_sweep(checks, program)
    check_mirror(checks, program)
    check_ball(checks, program)
    check_stigmatic(checks, program)
    check_orders(checks, program)
    check_shapes(checks, program)
    checks.finish()


if __name__ == "__main__":
    main()
