#!/usr/bin/env python3
"""tests/truth/check_psf.py - lenscalc psf against closed forms: check_psf.py BUILD_DIR

Airy's disc and the axis through focus of a slow paraboloid; the three ways of adding up waves
against each other; contrasts from the transform of an image against lenscalc mtf; a disc by rays.
Lenses that are named behind BUILD: radii of 80 % of the light at all their fields, and no more.
"""
# SPDX-License-Identifier: MIT

import array
import cmath
import csv
import io
import math
import os
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program

WAVE = 587.5618e-6  # mm
FOCUS, RADIUS = 1000, 5
DISH = (f"lens dish\nwavelength d\nobject inf\naperture stop\n"
        f"surface {-2 * FOCUS} {-FOCUS} mirror {2 * RADIUS} k=-1 stop\n")


def image(program, folder, words, text=None, sizes=()):
    """(the row, the map: rows from below), of the first of the sizes that is not refused"""
    if sizes:
        words = [*words, "--size", str(sizes[0])]
    path = os.path.join(folder, "map.pfm")
    result = subprocess.run(program.command + ["psf"] + words + ["--csv", "--map", path],
                            input=text, text=True, capture_output=True,
                            env=program.environment())
    if result.returncode == 1 and len(sizes) > 1:
        return image(program, folder, words[:-2], text, sizes[1:])
    if result.returncode != 0:
        sys.exit(result.stderr)
    with open(path, "rb") as file:
        kind, size, scale = (file.readline().split() for _ in range(3))
        values = array.array("f", file.read())
    width = int(size[0])
    return (list(csv.DictReader(io.StringIO(result.stdout)))[0],
            [values[y * width:(y + 1) * width] for y in range(width)])


def bessel(x):
    """J1 by its integral."""
    count = 400
    return sum(math.cos(t - x * math.sin(t)) for t in
               (math.pi * (i + 0.5) / count for i in range(count))) / count


def check_airy(checks, program, folder):
    """The cone is so slow that its pupil is even to 1e-5."""
    for method, allowed in (("plane", 5e-6), ("fft", 2e-5), ("huygens", 5e-6)):
        pitch = 0.3 * WAVE * FOCUS / (2 * RADIUS)
        row, table = image(program, folder, ["-", "--field", "0", "--focus", str(-FOCUS), "--size",
                                             "48", "--method", method, "--pitch",
                                             f"{pitch!r}mm"], DISH)
        worst = 0
        for y in range(0, 48, 3):
            for x in range(0, 48, 3):
                r = math.hypot(x - 24, y - 24) * 0.3 * math.pi
                exact = 1 if r == 0 else (2 * bessel(r) / r) ** 2
                worst = max(worst, abs(table[y][x] - exact))
        checks.check(worst <= allowed, f"Airy, {method}: off by {worst}")
        checks.check(abs(float(row["width_x_um"]) / (1000 * WAVE * FOCUS / (2 * RADIUS)) - 1.029)
                     < 0.02, f"Airy, {method}: width {row['width_x_um']}")


def bessel0(x):
    count = 400
    return sum(math.cos(x * math.sin(t)) for t in
               (math.pi * (i + 0.5) / count for i in range(count))) / count


def check_radius(checks, program, folder):
    """The light of Airy's disc within x is 1 - J0^2 - J1^2."""
    low, high = 0.0, 6.0
    for _ in range(60):
        x = (low + high) / 2
        low, high = ((x, high) if 1 - bessel0(x) ** 2 - bessel(x) ** 2 < 0.8 else (low, x))
    expected = 1000 * low * WAVE * FOCUS / (2 * math.pi * RADIUS)
    airy = 1000 * WAVE * FOCUS / (2 * RADIUS)
    for words in ([], ["--size", "64"], ["--pitch", f"{0.45 * airy!r}um"],
                  ["--pitch", f"{0.8 * airy!r}um"]):
        row = image(program, folder, ["-", "--field", "0", "--focus", str(-FOCUS), *words], DISH)[0]
        off, error = abs(float(row["radius80_um"]) - expected), float(row["radius80_error_um"])
        checks.check(off <= error, f"Airy, 80 % {words}: {row['radius80_um']} +- {error}, "
                                   f"expected {expected}")
        checks.check(bool(words) or error < 5e-3 * expected,
                     f"Airy, 80 %: the error printed is {error} of {expected}")


def light_within(table, radius, pitch, centre):
    """A pixel on the rim counts by its share along the radius; lengths in um."""
    middle, sum_ = len(table) // 2, 0.0
    for y, line in enumerate(table):
        for x, value in enumerate(line):
            r = math.hypot((x - middle) * pitch - centre[0], (y - middle) * pitch - centre[1])
            sum_ += value * max(0, min(1, (radius - r) / pitch + 0.5))
    return sum_


def check_radii(checks, program, folder, lenses):
    """Counted over pixels so fine that 64 make the radius, about the centroid of four times the
    image."""
    for words in lenses:
        row = image(program, folder, words)[0]
        if not row["radius80_um"]:
            continue
        error, radius = float(row["radius80_error_um"]), float(row["radius80_um"])
        wide = image(program, folder, words + ["--pitch", row["pitch_um"] + "um"],
                     sizes=(1024, 768, 512))[0]
        centre = float(wide["centroid_x_um"]), float(wide["centroid_y_um"])
        reach = radius + error + max(map(abs, centre))  # from the middle, that the circle needs
        finer = max(2, min(16, math.ceil(64 * float(row["pitch_um"]) / radius)))
        pitch = max(float(row["pitch_um"]) / finer, 2.2 * reach / 2048)
        size = 2 * math.ceil(1.1 * reach / pitch)
        fine, table = image(program, folder,
                            words + ["--size", str(size), "--pitch", f"{pitch!r}um"])
        total = sum(map(sum, table)) / (float(fine["inside_percent"]) / 100)
        shares = [light_within(table, radius + side * error, pitch, centre) / total
                  for side in (-1, 1)]
        checks.check(shares[0] - 2e-5 <= 0.8 <= shares[1] + 2e-5,
                     f"{words}: 80 % within {radius} +- {error} um, of finer pixels {shares}")


def check_focus(checks, program, folder):
    for waves in (0.25, 0.7, 1.0, 1.6):
        off = waves * WAVE * 2 * FOCUS ** 2 / RADIUS ** 2
        row, table = image(program, folder, ["-", "--field", "0", "--size", "16", "--pitch", "20um",
                                             "--focus", repr(-FOCUS - off)], DISH)
        x = math.pi * waves * FOCUS / (FOCUS + off)
        checks.check(abs(table[8][8] - (math.sin(x) / x) ** 2) < 2e-5,
                     f"{waves} waves of defocus: {table[8][8]}, expected {(math.sin(x) / x) ** 2}")


def check_methods(checks, program, folder):
    for words in (["double-gauss", "-N", "5.6", "--field", "14", "-w", "d"],
                  ["questar-35", "--field", "0.25", "-w", "d"],
                  ["double-gauss", "-N", "4", "--field", "10", "-w", "d"]):
        row, plane = image(program, folder, words + ["--size", "32"])
        for method in ("fft", "huygens"):
            table = image(program, folder, words + ["--size", "32", "--method", method, "--pitch",
                                                    row["pitch_um"] + "um"])[1]
            worst = max(abs(u - v) for a, b in zip(plane, table) for u, v in zip(a, b))
            checks.check(worst <= 1e-4, f"{words}: {method} is off by {worst}")


def crest_of(line, top):
    """The top of the parabola through three values, and where it is."""
    before, here, after = line[top - 1:top + 2]
    at = (before - after) / (2 * (before - 2 * here + after))
    return here - (before - after) * at / 4, top + at


def half_width(line, top):
    """From where a line falls below half its crest to where it does on the other side, pixels."""
    half, width = crest_of(line, top)[0] / 2, 0
    for side in (-1, 1):
        i = top
        while line[i + side] >= half:
            i += side
        width += abs(i - top) + (line[i] - half) / (line[i] - line[i + side])
    return width


def check_peak(checks, words, row, table):
    """About the brightest pixel of the map, of 1 um, by its row and column."""
    y = max(range(len(table)), key=lambda i: max(table[i]))
    x = max(range(len(table)), key=lambda i: table[y][i])
    peak, middle = table[y][x], len(table) // 2
    for name, top, line in ("x", x, table[y]), ("y", y, [line[x] for line in table]):
        crest, at = crest_of(line, top)
        peak += crest - table[y][x]
        checks.near("peak", f"{words}: peak_{name}", row[f"peak_{name}_um"], at - middle, 1e-3)
        checks.near("width", f"{words}: width_{name}", row[f"width_{name}_um"],
                    half_width(line, top), 1e-4)
    checks.near("height", f"{words}: peak", row["peak"], peak, 1e-6)


def check_skew(checks, program, folder):
    """Coma of a paraboloid, to one side and up: nothing in the image is symmetric."""
    words = ["-", "--size", "128", "--pitch", "1um"]
    row, table = image(program, folder, words, "lens bowl\nwavelength d\nobject inf\n"
                       "field angle 0.3,0.2\naperture stop\n"
                       "surface -2000 -1000 mirror 100 k=-1 stop\n")
    check_peak(checks, words, row, table)


def check_contrast(checks, program, folder):
    words = ["double-gauss", "-N", "5.6", "--field", "10", "-w", "d"]
    row, table = image(program, folder, words + ["--size", "256", "--pitch", "1um"])
    check_peak(checks, words, row, table)
    light = 1e-6 * sum(map(sum, table)) / (float(row["inside_percent"]) / 100)
    for frequency in (20, 40, 80):
        result = subprocess.run(program.command + ["mtf"] + words + ["--frequency", str(frequency),
                                "--csv"], text=True, capture_output=True,
                                env=program.environment())
        expected = next(csv.DictReader(io.StringIO(result.stdout)))
        wave = [cmath.exp(-2j * math.pi * frequency * 1e-3 * i) for i in range(256)]
        for column, found in (("tangential", sum(sum(line) * w for line, w in zip(table, wave))),
                              ("sagittal", sum(sum(v * w for v, w in zip(line, wave))
                                               for line in table))):
            checks.check(abs(1e-6 * abs(found) / light - float(expected[column])) < 2e-3,
                         f"{frequency}/mm {column}: {1e-6 * abs(found) / light}, mtf has "
                         f"{expected[column]}")


def questions_of(program, lens):
    """All fields of a lens."""
    result = subprocess.run(program.command + ["psf", lens, "-w", "d", "--csv", "--method", "plane",
                                               "--columns", "field,radius80"], text=True,
                            capture_output=True, env=program.environment()).stdout
    return [[lens, "-w", "d", "--field", row["field_deg"]]
            for row in csv.DictReader(io.StringIO(result))
            if row["field_deg"] and row["radius80_um"]]


def check_rays(checks, program, folder):
    """A parabola of 100 mm at f/5, 1 mm beside its focus: a disc whose rays meet the plane at
    tan t, tan t = h/(f - h^2/4f); where waves turn too often, and nothing says how, it is by rays."""
    focus, radius = 100, 10
    text = (f"lens parabola\nwavelength d\nobject inf\naperture epd {2 * radius}\nfocus table\n"
            f"surface {-2 * focus} {-focus} mirror 22 k=-1 stop\n")
    height = math.sqrt(0.8) * radius  # 80 % of the light pass within
    expected = 1000 * height / (focus - height * height / (4 * focus))  # um
    edge = radius / (focus - radius * radius / (4 * focus))  # mm
    density = (WAVE * focus / (math.pi * radius * edge)) ** 2  # of a disc, over Airy's peak
    for words, pixels in ((["--method", "rays"], 128), (["--method", "rays", "--size", "64"], 64)):
        row, _ = image(program, folder, ["-", *words, "--defocus", "1"], text)
        checks.check(abs(float(row["radius80_um"]) - expected) < 0.5 * float(row["pitch_um"]),
                     f"radius80 by rays {row['radius80_um']}, expected {expected}")
        checks.check(float(row["inside_percent"]) > 99.999, f"inside {row['inside_percent']}")
        checks.check(abs(float(row["peak"]) / density - 1) < 0.25,
                     f"density by rays {row['peak']}, expected {density}, of {pixels} pixels")
    far, _ = image(program, folder, ["-", "--defocus", "20"], text)
    checks.check(far["method"].startswith("rays") and "by rays" in far["warning"],
                 f"a disc of 4 mm: {far['method']}, {far['warning']}")
    near, _ = image(program, folder, ["-", "--defocus", "0.1"], text)
    checks.check(near["method"].startswith("plane"), f"a disc of 20 um: {near['method']}")


def main():
    program, checks = Program(sys.argv[1]), Checks()
    with tempfile.TemporaryDirectory() as folder:
        named = [word for word in sys.argv[2:] if word != "-v"]
        for lens in named:
            check_radii(checks, program, folder, questions_of(program, lens))
        if named:
            checks.finish()
        check_airy(checks, program, folder)
        check_radius(checks, program, folder)
        check_radii(checks, program, folder, [["double-gauss", "-N", "8", "--field", field, "-w", "d"]
                                              for field in ("0", "14")])
        check_focus(checks, program, folder)
        check_methods(checks, program, folder)
        check_contrast(checks, program, folder)
        check_skew(checks, program, folder)
        check_rays(checks, program, folder)
    checks.finish()


if __name__ == "__main__":
    main()
