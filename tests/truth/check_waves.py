#!/usr/bin/env python3
"""tests/truth/check_waves.py - wavefront, psf and mtf together: check_waves.py BUILD_DIR

Images that are perfect by construction; aberrations of known surfaces against integrals over the
pupil, made here; Parseval's theorem; the three ways of adding up waves, of six lenses; and sums of
Zernike's polynomials against the path differences of 50 digits in opd.txt.
"""
# SPDX-License-Identifier: MIT

import array
import cmath
import csv
import functools
import io
import math
import os
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import ROOT, Checks, Program
from integrals import gauss, noll

WAVE = 587.5618e-6  # mm
FOCUS, RADIUS = 1000, 5  # a cone so slow that its pupil is even to 2e-5
# The phone's lens on its axis alone: off it wavelets from a sphere of R = 4 mm differ from plane
# waves by a e x^2/R at a point x of the image, a and e the sines of the pupil and the chief ray
LENSES = (("double-gauss", "11", "10"), ("cooke-triplet-50", "11", "15"),
          ("fisheye-16", "11", "20"), ("phone-80deg", "5.6", "0"),
          ("telephoto-200", "16", "3"), ("zeiss-biotar-100", "16", "8"))

# Steep wave fronts: images as large as their rays spread, whose pixels transforms leave out most
STEEP = (("fisheye-16", "0"), ("cs348b-telephoto-250", "0"), ("cs348b-wide-22", "30"))


def rows(program, words, text=None):
    result = subprocess.run(program.command + words + ["--csv"], input=text, text=True,
                            capture_output=True, env=program.environment())
    table = list(csv.DictReader(io.StringIO(result.stdout)))
    if not table:
        sys.exit(f"{words}: {result.stderr}")
    return table


def image(program, folder, words, text=None):
    """(the row, the map: rows from below)"""
    path = os.path.join(folder, "map.pfm")
    row = rows(program, ["psf"] + words + ["--map", path], text)[0]
    with open(path, "rb") as file:
        size = int([file.readline().split() for _ in range(3)][1][0])
        values = array.array("f", file.read())
    return row, [values[y * size:(y + 1) * size] for y in range(size)]


def near(checks, name, actual, expected, allowed):
    checks.check(abs(float(actual) - expected) <= allowed,
                 f"{name} is {actual}, expected {expected} within {allowed:.3g}")


def bessel(order, x):
    count = 60
    return sum(math.cos(order * t - x * math.sin(t)) for t in
               (math.pi * (i + 0.5) / count for i in range(count))) / count


def dish(radius, focus, terms=""):
    return (f"lens dish\nwavelength d\nobject inf\naperture stop\n"
            f"surface {-2 * focus} {-focus} mirror {2 * radius} k=-1 {terms} stop\n")


def perfect():
    """(name, lens, focus, sine of the cone, index), fast and slow. The ellipsoid of k = -1/n^2 has
    its far focus at n R/(n - 1); a sphere of R with glass 1.5 before it has its aplanatic points
    R + R/n and R + n R before it, the sines of whose rays are as n to 1, by Abbe."""
    for radius in (25, 0.5):
        yield f"paraboloid {radius}", dish(radius, 100), -100, radius / 100 / (
            1 + (radius / 200) ** 2), 1
        sag = (radius ** 2 / 20) / (1 + math.sqrt(1 - 5 / 9 * (radius / 20) ** 2))
        if radius < 20:
            yield (f"ellipsoid {radius}", "lens ellipsoid\nwavelength d\nobject inf\n"
                   f"aperture stop\nsurface 20 0 1.5 {2 * radius} k={-4 / 9!r} stop\n", 60,
                   radius / math.hypot(radius, 60 - sag), 1.5)
    for edge in (9, 0.2):
        sag = 15 - math.sqrt(15 * 15 - edge * edge)
        yield (f"ball {edge}", "lens ball\nwavelength d\nmedium 1.5\nobject 25\naperture stop\n"
               f"surface -15 0 air {2 * edge} stop\n", -37.5,
               edge / math.hypot(edge, 37.5 - sag), 1)


def check_perfect(checks, program, folder):
    for name, lens, focus, sine, index in perfect():
        words = ["-", "--field" if "object inf" in lens else "--height", "0", "--focus", str(focus)]
        row = rows(program, ["wavefront"] + words, lens)[0]
        for column in ("rms_waves", "pv_waves", "mean_waves"):
            near(checks, f"{name}: {column}", row[column], 0, 1e-10)
        near(checks, f"{name}: Strehl ratio", row["strehl"], 1, 1e-12)
        cutoff = 2 * index * sine / WAVE
        row = rows(program, ["mtf"] + words + ["--frequency", repr(0.3 * cutoff)], lens)[0]
        near(checks, f"{name}: cut-off", row["cutoff_tangential_per_mm"], cutoff, 1e-6 * cutoff)
        near(checks, f"{name}: limit", row["limit_tangential"], float(row["tangential"]), 1e-9)
        if sine > 0.02:
            continue
        near(checks, f"{name}: contrast", row["tangential"],
             2 / math.pi * (math.acos(0.3) - 0.3 * math.sqrt(1 - 0.09)), 2e-5)
        row, table = image(program, folder, words + ["--size", "16", "--pitch",
                           f"{0.3 / cutoff!r}mm"], lens)
        near(checks, f"{name}: peak", row["peak"], 1, 1e-6)
        worst = max(abs(table[y][x] - airy(0.3 * math.pi * math.hypot(x - 8, y - 8)))
                    for x in range(0, 16, 3) for y in range(0, 16, 3))
        checks.check(worst <= 2e-5, f"{name}: Airy's disc is off by {worst}")


def check_afocal(checks, program, folder):
    """Two paraboloids with one focus, off each other's axis by nothing: 40 mm become 10 mm."""
    lens = ("lens mersenne\nwavelength d\nobject inf\naperture epd 40\nfield angle 0\nfocus afocal\n"
            "surface -400 -150 mirror 40 k=-1 stop\nsurface -100 200 mirror - k=-1\n")
    resolved = 1e3 * WAVE / 10  # mrad
    for method in ("plane", "fft"):
        row, table = image(program, folder, ["-", "--method", method, "--size", "32",
                                             "--pitch-angle", f"{0.3 * resolved!r}mrad"], lens)
        near(checks, f"afocal, {method}: peak", row["peak"], 1, 1e-5)
        near(checks, f"afocal, {method}: width", row["width_x_mrad"], 1.029 * resolved,
             0.02 * resolved)
        checks.check(row["width_x_um"] == row["pitch_um"] == "", "an afocal image has um")
        worst = max(abs(table[y][x] - airy(0.3 * math.pi * math.hypot(x - 16, y - 16)))
                    for x in range(0, 32, 3) for y in range(0, 32, 3))
        checks.check(worst <= 5e-5, f"afocal, {method}: Airy's disc is off by {worst}")


def airy(x):
    return (2 * bessel(1, x) / x) ** 2 if x else 1.0


def adaptive(function, low, high, allowed=1e-9, coarse=None):
    """Halves until two halves of 12 points are what the whole is."""
    def sum_of(a, b):
        return (b - a) * sum(w * function(a + (b - a) * x) for x, w in gauss(12))
    middle = (low + high) / 2
    left, right = sum_of(low, middle), sum_of(middle, high)
    if abs(left + right - (sum_of(low, high) if coarse is None else coarse)) <= allowed:
        return left + right
    return (adaptive(function, low, middle, allowed / 2, left)
            + adaptive(function, middle, high, allowed / 2, right))


def radial(n):
    """Powers of r^2 of R_n^0."""
    half = n // 2
    powers = [0] * (half + 1)
    for k in range(half + 1):
        powers[half - k] = ((-1) ** k * math.factorial(n - k)
                            // (math.factorial(k) * math.factorial(half - k) ** 2))
    return powers


def value(powers, r2):
    total = 0
    for power in reversed(powers):
        total = total * r2 + power
    return total


def overlap(wave, shift):
    """Of the pupil with itself, moved by `shift` radii: symmetric, so that cosines are enough."""
    def line(turn):
        t = math.sqrt(1 - shift * shift / 4) * math.sin(turn)
        length = math.sqrt(1 - t * t) - shift / 2
        inner = adaptive(lambda s: math.cos(2 * math.pi * (
            wave((s + shift / 2) ** 2 + t * t) - wave((s - shift / 2) ** 2 + t * t))), 0, length,
            1e-8)
        return 4 * inner * math.sqrt(1 - shift * shift / 4) * math.cos(turn)
    return adaptive(line, 0, math.pi / 2, 1e-7) / math.pi


def check_terms(checks, program, folder):
    """The mirror's own shape adds R_n^0 to the wave front: half of it, as light goes there and
    back, over the cosine of next to nothing."""
    sine = RADIUS / FOCUS / (1 + (RADIUS / 2 / FOCUS) ** 2)
    for n in (2, 4, 6, 8):
        powers = radial(n)
        terms = " ".join(f"A{2 * k}={0.4 * WAVE / 2 * power / RADIUS ** (2 * k)!r}"
                         for k, power in enumerate(powers) if k)
        lens, words = dish(RADIUS, FOCUS, terms), ["-", "--field", "0", "--focus", str(-FOCUS)]
        index = n * (n + 1) // 2 + 1  # Noll's of m = 0
        table = rows(program, ["wavefront"] + words + ["--zernike", "noll", "--terms", "45"], lens)
        found = {int(row["index"]): float(row["coefficient_waves"]) for row in table}
        for j, coefficient in found.items():
            size = abs(coefficient) if j == index else coefficient
            if j > 1:
                near(checks, f"R{n}: Z{j}", size, 0.4 / math.sqrt(n + 1) if j == index else 0, 1e-5)

        def wave(r2):
            return 0.4 * value(powers, r2)
        pitch = 0.35 * WAVE / (2 * sine)
        row, picture = image(program, folder, words + ["--size", "64", "--pitch", f"{pitch!r}mm"],
                             lens)
        for x in (0, 1, 3, 6):
            r = 0.35 * math.pi * x
            field = adaptive(lambda u: cmath.exp(2j * math.pi * wave(u)) *
                             bessel(0, r * math.sqrt(u)), 0, 1, 1e-8)
            near(checks, f"R{n}: image at {x}", picture[32 + x][32], abs(field) ** 2, 2e-5)
        light = pitch * pitch * sum(map(sum, picture)) * 100 / float(row["inside_percent"])
        parseval = WAVE * WAVE / (math.pi * sine * sine)
        near(checks, f"R{n}: all light", light, parseval, 1e-4 * parseval)
        for share in (0.1, 0.35, 0.7):
            expected = overlap(wave, 2 * share)
            for error in (1e-4, 1e-6):
                row = rows(program, ["mtf"] + words + ["--error", str(error), "--frequency",
                                                       repr(share * 2 * sine / WAVE)], lens)[0]
                phase = math.radians(float(row["phase_sagittal_deg"]))
                near(checks, f"R{n}: contrast at {share} to {error}",
                     float(row["sagittal"]) * math.cos(phase), expected, min(error, 2e-5) + 1e-5)


def check_methods(checks, program, folder):
    for lens, fnumber, field in LENSES:
        words = [lens, "-N", fnumber, "--field", field, "-w", "d", "--size", "32"]
        row, plane = image(program, folder, words)
        allowed = 1e-4 * max(map(max, plane))
        for method in ("fft", "huygens"):
            table = image(program, folder, words + ["--method", method, "--pitch",
                                                    row["pitch_um"] + "um"])[1]
            worst = max(abs(u - v) for a, b in zip(plane, table) for u, v in zip(a, b))
            checks.check(worst <= allowed, f"{lens}: {method} is off by {worst} of {1e4 * allowed}")
    for lens, field in STEEP:
        words = [lens, "--field", field, "-w", "d", "--size", "64"]
        plane = image(program, folder, words)[1]
        table = image(program, folder, words + ["--method", "fft"])[1]
        worst = max(abs(u - v) for a, b in zip(plane, table) for u, v in zip(a, b))
        checks.check(worst <= 1e-4 * max(map(max, plane)), f"{lens}: steep, fft is off by {worst}")


@functools.cache
def truth_cases():
    """(name, lens, focus, {field: [(x, y, W in mm)]}) of opd.txt"""
    with open(os.path.join(ROOT, "tests", "truth", "opd.txt"), encoding="utf-8") as file:
        name, lens, focus, fields = None, "", None, {}
        for line in list(file) + ["case end"]:
            words = line.split()
            if words[:1] == ["case"]:
                if name:
                    yield name, lens, focus, fields
                name, lens, focus, fields = line[5:].strip(), "", None, {}
            elif words[:1] == ["focus"]:
                focus = words[1]
            elif words[:1] == ["fan"]:
                fields.setdefault(words[1], []).append(tuple(map(float, (words[2], words[3],
                                                                         words[5]))))
            elif words and focus is None and words[0] not in ("#", "end"):
                lens += line


def check_truth(checks, program):
    """Terms that leave next to nothing are an interpolation; of faster lenses 66 are too few."""
    met = 0
    for name, lens, focus, fields in truth_cases():
        for field, points in fields.items():
            words = ["wavefront", "-", "--no-clip", "--focus", focus]
            lens = re.sub("(field .*) .*", rf"\1 {field}", lens)
            table = rows(program, words + ["--zernike", "noll", "--terms", "66", "--columns",
                                           "index,coefficient_waves,residual_waves"], lens)
            residual = float(table[0]["residual_waves"])
            if not residual < 1e-5:
                continue
            for x, y, path in points:
                r, angle = math.hypot(x, y), math.atan2(y, x)
                wave = sum(float(row["coefficient_waves"]) * noll(int(row["index"]), r, angle)
                           for row in table)
                near(checks, f"{name}, {field} deg, ({x}, {y})", wave, path / WAVE,
                     1e-8 + 100 * residual)
            met += 1
    checks.check(met >= 60, f"only {met} wave fronts are as smooth as 66 terms")


def check_missed(checks, program):
    """A parabola images a star perfectly at F. From a reference point D before F a ray at the angle
    t passes D sin t, and misses a sphere of radius R where that is more."""
    sphere, before = 0.01, 0.05
    stop = sphere + before
    for radius, share in ((0.03, 1 - (stop * math.tan(math.asin(sphere / before)) / 0.03) ** 2),
                          (0.012, 0)):
        lens = ("lens Parabola\naperture stop\nfield angle 0\nfocus table\nwavelength d\n"
                f"surface -200 {stop - 100} mirror 200 k=-1\nstop - {-sphere} air {2 * radius}\n")
        for more in ([], ["--zernike", "noll", "--terms", "1"]):
            words = ["wavefront", "-", "--columns", "field_deg,warning"] + more
            warning = rows(program, words, lens)[0]["warning"]
            said = re.search(r"([0-9.]+) % of the light misses the reference sphere", warning)
            near(checks, f"{words}, {radius}: share of the light", said.group(1) if said else 0,
                 100 * share, 4 if more else 0.06)
        for command in ("psf", "mtf"):  # images of what is left alone would be those of another lens
            result = subprocess.run(program.command + [command, "-"], input=lens, text=True,
                                    capture_output=True, env=program.environment())
            checks.check(("miss the reference sphere" in result.stderr) == (share > 0),
                         f"{command}, {radius}: {result.stderr}")


def main():
    program, checks = Program(sys.argv[1]), Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_perfect(checks, program, folder)
        check_afocal(checks, program, folder)
        check_missed(checks, program)
        check_terms(checks, program, folder)
        check_methods(checks, program, folder)
        check_truth(checks, program)
    checks.finish()


if __name__ == "__main__":
    main()
