#!/usr/bin/env python3
"""tests/truth/check_sensor.py - what a sensor makes of pictures: check_sensor.py BUILD_DIR

The numbers of a sensor follow from the light of the same picture, as lenscalc render writes it, by
EMVA 1288: electrons of a lux second from the constants of physics, gain, black level, the channels'
responses; noise has the variance K^2 (sigma^2 + mu) + 1/12; white saturates. Pixels that accept a
power of the cosine, or what a table says, darken the corners behind a small stop as an integral
over that stop has it.
"""
# SPDX-License-Identifier: MIT

import math
import os
import struct
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program
from photographs import read_pfm, read_png, take, write_pfm

PLANCK, LIGHT, LUMENS = 6.62607015e-34, 299792458, 683.002
XYZ = ((0.4124, 0.3576, 0.1805), (0.2126, 0.7152, 0.0722), (0.0193, 0.1192, 0.9505))
# wavelengths of red, green and blue, nm, and CIE's V of them
TRACED = ((611, 0.4904688), (549, 0.9928116), (464, 0.07091109))
PLAIN = ["--lens", "double-gauss-50", "-s", "1m", "--samples", "16", "--size"]


def photons(pitch_um, wavelength_nm, v):
    """Of 1 lx s on a pixel."""
    area = (pitch_um * 1e-6) ** 2
    return area / (LUMENS * v) / (PLANCK * LIGHT / (wavelength_nm * 1e-9))


def interpolate(rows, x):
    for (x0, *y0), (x1, *y1) in zip(rows, rows[1:]):
        if x0 <= x <= x1:
            return [a + (x - x0) / (x1 - x0) * (b - a) for a, b in zip(y0, y1)]
    return [0] * (len(rows[0]) - 1)


def colours(folder):
    """A card of two colours and white."""
    path = os.path.join(folder, "colours.pfm")
    pixels = [(0.9, 0.2, 0.1), (1, 1, 1), (0.1, 0.5, 0.9)]
    with open(path, "wb") as file:
        file.write(b"PF\n3 1\n-1.0\n" + b"".join(struct.pack("<3f", *pixel) for pixel in pixels))
    return ["colours.pfm"] + PLAIN + ["24x16", "-t", "1/400"]


def check_numbers(checks, program, folder):
    """Noiseless numbers: red, green and blue; luminance; X, Y, Z; a table of efficiencies."""
    table = [(400, 0.01, 0.02, 0.3), (500, 0.04, 0.4, 0.5), (560, 0.05, 0.5, 0.05),
             (700, 0.5, 0.02, 0.01)]
    with open(os.path.join(folder, "qe.csv"), "w", encoding="utf-8") as file:
        file.write("wavelength_nm,R,G,B\n" + "".join(",".join(map(str, row)) + "\n" for row in table))
    card = colours(folder)
    light = take(program, checks, folder, *card)
    green = 0.4 * 0.6 * photons(5, 555, 1)
    of_table = [[interpolate(table, nm)[k] * XYZ[1][j] * 0.4 * photons(5, nm, v)
                 for j, (nm, v) in enumerate(TRACED)] for k in range(3)]
    cases = {"rgb": [[green * (i == j) for j in range(3)] for i in range(3)],
             "mono": [[green * y for y in XYZ[1]]],
             "xyz": [[green * y for y in row] for row in XYZ],
             "qe.csv": of_table}
    for response, seen in cases.items():
        more = [] if response == "qe.csv" else ["--efficiency", "0.6"]
        raw = take(program, checks, folder, *card, "--raw", "--response", response, "--fill", "0.4",
                   "--pitch", "5um", "--gain", "0.3", "--black", "100", "--adc", "12", *more,
                   name="raw.png")
        if light is None or raw is None:
            return
        for pixel, numbers in zip(sum(light, []), sum(raw, [])):
            for row, number in zip(seen, numbers):
                expected = min(4095, 100 + 0.3 * sum(a * b for a, b in zip(row, pixel)))
                checks.check(abs(number - expected) < 0.51, f"{response}: {number}, not {expected}")


def check_table(checks, program, folder):
    """Colours of a table are those of the light, but for the steps of 14 bits."""
    card = colours(folder)
    plain = take(program, checks, folder, *card, "--bits", "16", name="plain.png")
    table = take(program, checks, folder, *card, "--bits", "16", "--response", "qe.csv",
                 name="table.png")
    if plain is None or table is None:
        return
    worst = max(abs(a - b) for row, other in zip(plain, table)
                for pixel, found in zip(row, other) for a, b in zip(pixel, found))
    checks.check(worst < 65535 * 0.004, f"a table changes the colours by {worst} of 65535")


def linear(number):
    """Of sRGB's 16 bits."""
    v = number / 65535
    return v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4


def check_white(checks, program, folder):
    """Light of a tungsten lamp, and of daylight of 5000 K, becomes grey; or what is given does."""
    to_rgb = ((3.2406, -1.5372, -0.4986), (-0.9689, 1.8758, 0.0415), (0.0557, -0.2040, 1.0570))
    for white, x, y in ("tungsten", 0.44757, 0.40745), ("5000K", 0.34567, 0.35850), ("auto", 0.4, 0.4):
        xyz = x / y, 1, (1 - x - y) / y
        pixel = [0.4 * sum(a * b for a, b in zip(row, xyz)) for row in to_rgb]
        with open(os.path.join(folder, "lamp.pfm"), "wb") as file:
            file.write(b"PF\n1 1\n-1.0\n" + struct.pack("<3f", *pixel))
        found = take(program, checks, folder, "lamp.pfm", *PLAIN, "12x8", "--white", white, "--bits",
                     "16", name="lamp.png")
        # rays are lost at the edges of pupils, which differ: their mean over the picture
        sums = [sum(linear(pixel[k]) for row in found or [] for pixel in row) for k in range(3)]
        checks.check(max(sums) - min(sums) < 0.006 * max(sums) > 0, f"{white}: {sums} are not grey")


def check_noise(checks, program, folder):
    """Scores of a white card: their variance is 1; saturation; threads; seeds."""
    write_pfm(os.path.join(folder, "white.pfm"), [[1.0, 1.0], [1.0, 1.0]])
    card = ["white.pfm"] + PLAIN + ["60x40"]
    gain, read_noise, black = 0.8, 6, 200
    per_lux = 0.5 * photons(3, 555, 1)
    sensor = ["--noise", "--read-noise", str(read_noise), "--gain", str(gain), "--black", str(black),
              "--pitch", "3um", "--response", "mono", "--raw"]
    for time in "1/400", "1/4000", "1/40000":
        light = take(program, checks, folder, *card, "-t", time)
        raw = take(program, checks, folder, *card, "-t", time, *sensor, name="raw.png")
        if light is None or raw is None:
            return
        score = []
        for pixel, (number,) in zip(sum(light, []), sum(raw, [])):
            mu = per_lux * sum(a * b for a, b in zip(XYZ[1], pixel))
            variance = gain ** 2 * (read_noise ** 2 + mu) + 1 / 12
            score.append((number - black - gain * mu) / math.sqrt(variance))
        count = len(score)
        mean, square = sum(score) / count, sum(z * z for z in score) / count
        checks.check(abs(mean) < 4 / math.sqrt(count), f"{time}: scores have the mean {mean}")
        checks.check(abs(square - 1) < 4 * math.sqrt(2 / count), f"{time}: the variance {square}")
        near = sum(abs(z) < 1.959964 for z in score) / count
        checks.check(abs(near - 0.95) < 4 * math.sqrt(0.95 * 0.05 / count),
                     f"{time}: {near} lie within 1.96 sigma")
    again = take(program, checks, folder, *card, "-t", time, *sensor, "--threads", "3",
                 name="again.png")
    checks.check(again == raw, "three threads make other noise than one")
    full = take(program, checks, folder, *card, "-t", "1", *sensor, name="full.png")
    checks.check(full is not None and {n for (n,) in sum(full, [])} == {16383}, "white saturates")


def check_series(checks, program, folder):
    """Exposures of one run are equal and their noise is not: merged it falls; the first is as alone."""
    write_pfm(os.path.join(folder, "white.pfm"), [[1.0, 1.0], [1.0, 1.0]])
    words = ["white.pfm"] + PLAIN + ["60x40"]
    cases = {".png": (["--pitch", "3um", "--response", "mono", "--raw"], ["--noise", "--read-noise", "6"]),
             ".pfm": (["--film", "HP5 Plus"], ["--grain", "17"])}
    for ending, (common, noise) in cases.items():
        own = words + common
        clean = take(program, checks, folder, *own, "-t", "1/400", name="clean" + ending)
        alone = take(program, checks, folder, *own, *noise, "-t", "1/400", name="alone" + ending)
        result = program.run("render", *own, *noise, "-t", "1/400,1/400", "-o", "one" + ending,
                             cwd=folder)
        if not checks.check(result.returncode == 0, f"{common}: {result.stderr}"):
            return
        read = read_pfm if ending == ".pfm" else read_png
        both = [read(os.path.join(folder, f"one-{i}{ending}")) for i in (1, 2)]
        checks.check(both[0] == alone, f"{common}: the first of two exposures is not as it is alone")
        off = [[(a[0] if isinstance(a, tuple) else a) - (b[0] if isinstance(b, tuple) else b)
                for p, q in zip(rows, clean) for a, b in zip(p, q)] for rows in both]
        product = sum(a * b for a, b in zip(*off))
        correlation = product / math.sqrt(sum(a * a for a in off[0]) * sum(b * b for b in off[1]))
        checks.check(abs(correlation) < 4 / math.sqrt(len(off[0])),
                     f"{common}: noise of two exposures has a correlation of {correlation:.3f}")


def behind_stop(radius, power, taken):
    """The integral of cos^power taken(theta) over a stop of 2 mm, 30 mm from the film."""
    steps, total = 40, 0
    for i in range(steps):
        r = 2 * math.sqrt((i + 0.5) / steps)
        for k in range(steps):
            x, y = r * math.cos(2 * math.pi * (k + 0.5) / steps), r * math.sin(
                2 * math.pi * (k + 0.5) / steps)
            cosine = 30 / math.sqrt(900 + (x - radius) ** 2 + y * y)
            total += cosine ** power * taken(math.acos(cosine))
    return total


def check_acceptance(checks, program, folder):
    """The stop lies behind the glass, so that all light comes from it."""
    with open(os.path.join(folder, "last.lens"), "w", encoding="utf-8") as file:
        file.write("lens stop behind\naperture stop\nsurface 100 5 1.5 30\nsurface -100 5 air 30\n"
                   "stop - 30 air 4\n")
    with open(os.path.join(folder, "accepted.tsv"), "w", encoding="utf-8") as file:
        file.write("angle_deg\tshare\n0\t1\n20\t0.8\n40\t0.2\n")
    write_pfm(os.path.join(folder, "white.pfm"), [[1.0, 1.0], [1.0, 1.0]])
    common = ["white.pfm", "--lens", "last.lens", "-s", "1m", "--focus", "30", "-t", "0.01", "-w", "d",
              "--field-width", "100m", "--size", "36x24", "--samples", "2048"]
    rows = [(0, 1), (math.radians(20), 0.8), (math.radians(40), 0.2)]
    cases = {"4": lambda theta: math.cos(theta) ** 4, "1.5": lambda theta: math.cos(theta) ** 1.5,
             "accepted.tsv": lambda theta: interpolate(rows, theta)[0]}
    plain = take(program, checks, folder, *common)
    for name, taken in cases.items():
        found = take(program, checks, folder, *common, "--acceptance", name)
        if plain is None or found is None:
            return
        for column in 18, 24, 30, 35:
            radius = math.hypot(column + 0.5 - 18, 0.5)
            expected = behind_stop(radius, 4, taken) / behind_stop(radius, 4, lambda theta: 1)
            ratio = found[12][column][1] / plain[12][column][1]
            checks.check(abs(ratio - expected) < 2e-3 * expected,
                         f"{name}: {ratio} of the light at {radius} mm, expected {expected}")
        fall = plain[12][35][1] / plain[12][18][1]
        cosines = behind_stop(17.507, 4, lambda theta: 1) / behind_stop(0.707, 4, lambda theta: 1)
        checks.check(abs(fall - cosines) < 5e-3 * cosines, f"{fall} at the edge, not {cosines}")


def main():
    program, checks = Program(sys.argv[1]), Checks()
    with tempfile.TemporaryDirectory(prefix="lenscalc-sensor-") as folder:
        check_numbers(checks, program, folder)
        check_table(checks, program, folder)
        check_white(checks, program, folder)
        check_noise(checks, program, folder)
        check_series(checks, program, folder)
        check_acceptance(checks, program, folder)
    return checks.finish()


if __name__ == "__main__":
    sys.exit(main())
