#!/usr/bin/env python3
"""tests/truth/check_distortion.py - lenscalc distortion against numbers from outside:
check_distortion.py BUILD_DIR

check.json and, where it exists, ../shared/reference/truth: chief ray heights and distortion by an
independent program of 50 digits. Coefficients: the published formulas of Brown, OpenCV and lensfun,
written out here, over chief rays between the fitted ones; profiles as lensfun and OpenCV read them.
"""
# SPDX-License-Identifier: MIT

import functools
import glob
import json
import math
import os
import re
import sys
import tempfile
import xml.etree.ElementTree as tree
from decimal import Decimal

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import SHARED, Checks, Program

# lens, sensor, model, projection: the picture is covered
FITS = (("double-gauss-50", (36, 24), "brown", None), ("double-gauss-50", (36, 24), "opencv", None),
        ("wide-35", (36, 24), "brown", None), ("wide-35", (36, 24), "opencv", None),
        ("wide-35", (36, 24), "poly3", None), ("wide-35", (36, 24), "poly5", None),
        ("wide-35", (36, 24), "ptlens", None), ("phone-80deg", (6, 4.5), "opencv", None),
        ("phone-80deg", (6, 4.5), "ptlens", None), ("fisheye-16", (34, 24), "fisheye", None),
        ("fisheye-16", (34, 24), "ptlens", "equidistant"),
        ("fisheye-16", (24, 34), "poly5", "stereographic"),
        ("canon-retrofocus-14", (30, 20), "opencv", None),
        ("wide-35", (36, 24), "opencv-rational", None),
        ("phone-80deg", (6, 4.5), "opencv-rational", None),
        ("canon-retrofocus-14", (30, 20), "opencv-rational", None))
PROJECTIONS = {"rectilinear": math.tan, "equidistant": lambda t: t,
               "equisolid": lambda t: 2 * math.sin(t / 2),
               "stereographic": lambda t: 2 * math.tan(t / 2), "orthographic": math.sin}


# -------- chief rays --------

def truth_percents():
    """Distortion in percent by the name of the case and the fraction of the field."""
    found = {}
    for path in glob.glob(os.path.join(SHARED, "reference", "truth", "*.json")):
        with open(path, encoding="utf-8") as file:
            cases = json.load(file)["cases"]
        for case in cases:
            expected = case["expected"]
            fields = expected.get("fields") if isinstance(expected, dict) else None
            for fraction, field in (fields or {}).items():
                if field.get("distortion", {}).get("percent") is not None:
                    found[case["name"], fraction] = field["distortion"]["percent"]
    return found


def ask(program, case, fraction):
    """The row of a field; an object's height is one of the lens file."""
    size = case["field"]["value"] * float(fraction)
    if case["field"]["type"] == "angle_deg":
        return program.rows("distortion", "-", "--projection", "rectilinear", "--field",
                            repr(size), "--focus", case["plane"], text=case["lens"])
    text = re.sub(r"(?m)^field .*$", f"field height {size!r}", case["lens"])
    return program.rows("distortion", "-", "--projection", "rectilinear", "--focus",
                        case["plane"], text=text)


def check_case(checks, program, case, percents):
    for field in case["fields"]:
        name = f"{case['name']} at {field['fraction']}"
        table = ask(program, case, field["fraction"])
        if not checks.check(isinstance(table, list) and len(table) == 1, f"{name}: {table}"):
            continue
        y, ideal = Decimal(field["y"]), Decimal(field["y_parax"])
        percent = 100 * (y - ideal) / ideal
        told = percents.get((case["name"], field["fraction"]))
        if told is not None:
            checks.check(abs(percent - Decimal(told)) <= abs(percent) * Decimal("1e-12") +
                         Decimal("1e-15"), f"{name}: {percent} is not {told}")
        scale = abs(float(y)) + abs(float(ideal)) + 10
        for column, truth, allowed in (
                ("image_height_mm", y, 1e-13 * (abs(float(y)) + 10)),
                ("ideal_height_mm", ideal, 1e-13 * (abs(float(ideal)) + 10)),
                ("distortion_percent", percent,
                 100 * 1e-13 * scale / abs(float(ideal)) * (1 + abs(float(percent)) / 100))):
            checks.against("distortion", name, column, table[0][column], truth, allowed,
                           "mm" if column.endswith("_mm") else "%")


# -------- models --------

def brown(r, k):
    return r * (1 + k["k1"] * r**2 + k["k2"] * r**4 + k["k3"] * r**6)


def rational(r, k):
    return brown(r, k) / (1 + k["k4"] * r**2 + k["k5"] * r**4 + k["k6"] * r**6)


def fisheye(t, k):
    return t * (1 + k["k1"] * t**2 + k["k2"] * t**4 + k["k3"] * t**6 + k["k4"] * t**8)


def poly3(r, k):
    return r * (1 - k["k1"] + k["k1"] * r**2)


def poly5(r, k):
    return r * (1 + k["k1"] * r**2 + k["k2"] * r**4)


def ptlens(r, k):
    return r * (k["a"] * r**3 + k["b"] * r**2 + k["c"] * r + 1 - k["a"] - k["b"] - k["c"])


FORMULAS = {"brown": brown, "opencv": brown, "opencv-rational": rational, "fisheye": fisheye,
            "poly3": poly3, "poly5": poly5, "ptlens": ptlens}
NAMES = {"brown": ("k1", "k2", "k3"), "opencv": ("k1", "k2", "k3"),
         "opencv-rational": ("k1", "k2", "k3", "k4", "k5", "k6"),
         "fisheye": ("k1", "k2", "k3", "k4"), "poly3": ("k1",), "poly5": ("k1", "k2"),
         "ptlens": ("a", "b", "c")}


def shrink(model, k):
    """Factor by which the model makes the middle smaller: the ideal image counts over it."""
    return 1 - (k["k1"] if model == "poly3" else k["a"] + k["b"] + k["c"] if model == "ptlens"
                else 0)


def apply(model, k, unit, r):
    """Height in mm of a height in mm."""
    return unit * FORMULAS[model](r / unit / shrink(model, k), k)


@functools.lru_cache(maxsize=None)
def chief_rays(program, lens, radius, projection):
    """(projection of the field for a focal length of 1, image height) as far as the radius."""
    edge = program.rows("distortion", lens, "--height", repr(radius), "--real",
                        "--projection", projection)
    far = float(edge[0]["angle_deg"])
    table = program.rows("distortion", lens, "--field", f"0..{far!r}#101",
                         "--projection", projection)
    return [(PROJECTIONS[projection](math.radians(float(row["angle_deg"]))),
             float(row["image_height_mm"])) for row in table]


def residual(model, k, unit, focal, rays, undistorts):
    """Root mean square over the radius, and the largest, in mm."""
    errors = []
    for ideal, real in rays:
        source, goal = (real, focal * ideal) if undistorts else (focal * ideal, real)
        errors.append(apply(model, k, unit, source) - goal)
    total = sum((a * a + b * b) / 2 * (after[1] - before[1])
                for a, b, before, after in zip(errors, errors[1:], rays, rays[1:]))
    return math.sqrt(total / (rays[-1][1] - rays[0][1])), max(abs(e) for e in errors)


def check_direction(checks, name, row, rays):
    model, undistorts = row["model"], row["direction"] == "undistort"
    k = {key: float(row[key]) for key in NAMES[model]}
    unit, focal = float(row["unit_mm"]), float(row["focal_mm"])
    rms, most = residual(model, k, unit, focal, rays, undistorts)
    told_rms, told_most = float(row["rms_um"]) / 1000, float(row["max_um"]) / 1000
    checks.check(abs(rms - told_rms) <= 0.05 * told_rms + 1e-9,
                 f"{name}: rms {told_rms} mm, by the published formula {rms}")
    checks.check(abs(most - told_most) <= 0.05 * told_most + 1e-9,
                 f"{name}: at most {told_most} mm, by the published formula {most}")
    pitch = float(row["pitch_um"]) / 1000
    checks.check(abs(float(row["rms_pixels"]) * pitch - told_rms) <= 1e-12 + 1e-12 * told_rms,
                 f"{name}: pixels")
    # no other coefficients do better: the square is a parabola with its vertex here
    for key in NAMES[model]:
        step = 0.02 * abs(k[key]) + 1e-12
        above, below = (residual(model, {**k, key: k[key] + s}, unit, focal, rays, undistorts)[0]
                        for s in (step, -step))
        checks.check(min(above, below) >= rms * (1 - 0.03), f"{name}: {key} could be better")
        vertex = (below**2 - above**2) / (2 * (above**2 + below**2 - 2 * rms**2))
        # six coefficients nearly undo each other: other fields move one along by more
        checks.check(abs(vertex) < (0.3 if len(k) < 6 else 1), f"{name}: {key} off by {vertex:.2g} of its step")


def check_fit(checks, program, lens, sensor, model, projection):
    name = f"{lens} {model}"
    words = ["--projection", projection] if projection else []
    size = f"{sensor[0]}x{sensor[1]}mm"
    table = program.rows("distortion", lens, "--fit", model, "--sensor", size, *words)
    if not checks.check(isinstance(table, list) and len(table) == 2, f"{name}: {table}"):
        return
    projection = table[0]["projection"]
    radius = float(table[0]["radius_mm"])
    checks.check(abs(radius - math.hypot(*sensor) / 2) < 1e-9 * radius, f"{name}: to {radius} mm")
    unit = {"brown": 1, "opencv": float(table[0]["focal_mm"]),
            "opencv-rational": float(table[0]["focal_mm"]),
            "fisheye": float(table[0]["focal_mm"])}.get(model, min(sensor) / 2)
    checks.check(abs(float(table[0]["unit_mm"]) - unit) < 1e-12 * unit, f"{name}: unit")
    forms = [(row["direction"], row["form"]) for row in table]
    first, second = ("undistort", "distort") if model == "brown" else ("distort", "undistort")
    checks.check(forms == [(first, "published"), (second, "inverse")], f"{name}: {forms}")
    rays = chief_rays(program, lens, radius, projection)
    for row in table:
        check_direction(checks, f"{name} {row['direction']}", row, rays)
    check_round_trip(checks, name, table, rays)


def check_round_trip(checks, name, table, rays):
    """Distorted by one, undistorted by the other: as far off as both together at most."""
    model = table[0]["model"]
    unit, focal = float(table[0]["unit_mm"]), float(table[0]["focal_mm"])
    ways = {row["direction"]: {key: float(row[key]) for key in NAMES[model]} for row in table}
    allowed = sum(float(row["max_um"]) for row in table) / 1000
    slope = max(abs((b[0] - a[0]) * focal / (b[1] - a[1])) for a, b in zip(rays, rays[1:]))
    for ideal, _ in rays:
        there = apply(model, ways["distort"], unit, focal * ideal)
        back = apply(model, ways["undistort"], unit, there)
        if not checks.check(abs(back - focal * ideal) <= 1.1 * allowed * max(slope, 1) + 1e-9,
                            f"{name}: {focal * ideal} mm comes back as {back}"):
            return


def check_calibrated(checks, program):
    """The focal length that fits best: none nearby leaves less, with the best coefficients."""
    for lens, model in (("wide-35", "opencv"), ("wide-35", "poly3"), ("double-gauss-50", "brown")):
        plain = program.rows("distortion", lens, "--fit", model)
        best = program.rows("distortion", lens, "--fit", model, "--calibrated")
        if not checks.check(isinstance(best, list), f"{lens} {model}: {best}"):
            continue
        checks.check(float(best[0]["rms_um"]) < float(plain[0]["rms_um"]),
                     f"{lens} {model}: a free focal length fits no better")
        rays = chief_rays(program, lens, float(best[0]["radius_mm"]), "rectilinear")
        check_direction(checks, f"{lens} {model} calibrated", best[0], rays)
    table = program.rows("distortion", "wide-35", "--field", "0.01..38#200", "--calibrated")
    percents = [float(row["distortion_percent"]) for row in table]
    checks.check(abs(max(percents) + min(percents)) < 1e-4 * max(percents),
                 f"calibrated: {max(percents)} and {min(percents)} %")


# -------- files --------

def lensfun_distorted(profile, lens, width, height, crop, x, y):
    """Pixels of the photograph where lensfun looks up a pixel of its corrected picture, both from
    the middle: lfModifier of version 0.3 (NormScale and mod-coord.cpp)."""
    size, aspect = min(width, height), max(width, height) / min(width, height)
    calibrated_crop = float(lens.findtext("cropfactor"))
    calibrated_aspect = float(lens.findtext("aspect-ratio"))
    correction = (1 / math.sqrt(aspect**2 + 1) * calibrated_crop / crop *
                  math.sqrt(calibrated_aspect**2 + 1))
    norm = 2 / size * correction
    r = math.hypot(x, y) * norm
    k = {key: float(profile.get(key)) for key in NAMES[profile.get("model")]}
    d = shrink(profile.get("model"), k)
    # terms over powers of d: the picture keeps its focal length
    if profile.get("model") == "poly3":
        factor = 1 + k["k1"] / d**3 * r**2
    elif profile.get("model") == "poly5":
        factor = 1 + k["k1"] * r**2 + k["k2"] * r**4
    else:
        factor = 1 + k["a"] / d**4 * r**3 + k["b"] / d**3 * r**2 + k["c"] / d**2 * r
    return x * factor, y * factor


def check_lensfun(checks, program, model):
    with tempfile.TemporaryDirectory(prefix="lenscalc-test-") as folder:
        path = os.path.join(folder, "x.xml")
        table = program.rows("distortion", "wide-35", "--fit", model, "-o", path)
        root = tree.parse(path).getroot()
    lens = root.find("lens")
    profile = lens.find("calibration/distortion")
    real = lens.find("calibration/real-focal-length")
    checks.check(root.tag == "lensdatabase" and lens.findtext("type") == "rectilinear" and
                 lens.findtext("model").startswith("Nakamura"), f"{model}: lensfun profile")
    focal = float(real.get("real-focal"))
    checks.check(profile.get("focal") == real.get("focal") and abs(focal - 35.03738) < 1e-4,
                 f"{model}: focal length {focal}")
    # 6000 x 4000 pixels on 36 x 24 mm, and the half of that on half the film, turned
    for width, height, crop, pitch in ((6001, 4001, 1, 0.006), (1001, 1501, 2, 0.012)):
        for ideal, height_mm in chief_rays(program, "wide-35", 10, "rectilinear")[1::10]:
            x, y = lensfun_distorted(profile, lens, width - 1, height - 1, crop,
                                     0.6 * focal * ideal / pitch, 0.8 * focal * ideal / pitch)
            error = abs(math.hypot(x, y) - height_mm / pitch) * pitch
            checks.check(error <= 1.01 * float(table[0]["max_um"]) / 1000 + 1e-7,
                         f"{model}: lensfun would be {error:.3g} mm off at {height_mm:.4g} mm")


def matrix(text, name):
    found = re.search(name + r": !!opencv-matrix\n   rows: (\d)\n   cols: (\d)\n   dt: d\n"
                      r"   data: \[([^\]]*)\]", text)
    numbers = [float(word) for word in found[3].split(",")]
    assert len(numbers) == int(found[1]) * int(found[2])
    return numbers


def check_opencv(checks, program, lens, model, projection):
    with tempfile.TemporaryDirectory(prefix="lenscalc-test-") as folder:
        path = os.path.join(folder, "x.yml")
        table = program.rows("distortion", lens, "--fit", model, "--pitch", "4um", "-o", path)
        with open(path, encoding="utf-8") as file:
            text = file.read()
    checks.check(text.startswith("%YAML:1.0\n---\n") and "image_width: 9000\n" in text and
                 "image_height: 6000\n" in text and
                 f"fisheye_model: {int(model == 'fisheye')}\n" in text, f"{lens}: head of the file")
    camera, k = matrix(text, "camera_matrix"), matrix(text, "distortion_coefficients")
    fx, cx, fy, cy = camera[0], camera[2], camera[4], camera[5]
    checks.check((cx, cy) == (4499.5, 2999.5) and fx == fy and camera[8] == 1 and
                 len(k) == {"fisheye": 4, "opencv": 5, "opencv-rational": 8}[model], f"{lens}: camera matrix {camera}")
    for ideal, height in chief_rays(program, lens, 21, projection)[1::10]:
        t = ideal if projection == "equidistant" else math.atan(ideal)
        a, b = 0.6 * math.tan(t), 0.8 * math.tan(t)  # x/z, y/z of the object
        r = math.hypot(a, b)
        if model == "fisheye":
            theta = math.atan(r)
            factor = theta * (1 + k[0] * theta**2 + k[1] * theta**4 + k[2] * theta**6 +
                              k[3] * theta**8) / r
            x, y = a * factor, b * factor
        else:
            radial = 1 + k[0] * r**2 + k[1] * r**4 + k[4] * r**6
            if len(k) == 8:
                radial /= 1 + k[5] * r**2 + k[6] * r**4 + k[7] * r**6
            x = a * radial + 2 * k[2] * a * b + k[3] * (r**2 + 2 * a**2)
            y = b * radial + k[2] * (r**2 + 2 * b**2) + 2 * k[3] * a * b
        error = math.hypot(fx * x + cx - 4499.5 - 0.6 * height / 0.004,
                           fy * y + cy - 2999.5 - 0.8 * height / 0.004)
        checks.check(error <= 1.01 * float(table[0]["max_pixels"]) + 1e-6,
                     f"{lens}: OpenCV would be {error:.3g} pixels off at {height:.4g} mm")


def main():
    checks = Checks()
    program = Program(sys.argv[1])
    percents = truth_percents()
    if not percents:
        print("skipped: no ../shared/reference/truth; tests/truth/check.json alone")
    with open(os.path.join(os.path.dirname(__file__), "check.json"), encoding="utf-8") as file:
        cases = json.load(file)["cases"]
    checks.check(len(cases) > 20, f"only {len(cases)} cases")
    for case in cases:
        check_case(checks, program, case, percents)
    told = {name for name, _ in percents} - {case["name"] for case in cases}
    checks.check(not told, f"cases that check.json leaves out: {told}")
    for fit in FITS:
        check_fit(checks, program, *fit)
    check_calibrated(checks, program)
    for model in ("poly3", "poly5", "ptlens"):
        check_lensfun(checks, program, model)
    check_opencv(checks, program, "wide-35", "opencv", "rectilinear")
    check_opencv(checks, program, "wide-35", "opencv-rational", "rectilinear")
    check_opencv(checks, program, "fisheye-16", "fisheye", "equidistant")
    checks.finish()


main()
