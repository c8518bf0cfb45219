#!/usr/bin/env python3
"""tests/truth/check_scene.py - scenes photographed by lenscalc render: check_scene.py BUILD_DIR

Small pictures against closed forms: a sky of one luminance gives an independent program's
irradiance (the course's double Gauss), and the same picture as a white card whatever is asked for;
an unvignetted pupil the exact formula of a disc; sun, sky and lamps on surfaces, a furnace, the
light of the sun through the pupil; what lies behind one another seen from the entrance pupil, in a
mirror too; colours in bands of wavelengths; how errors fall and what they are.
"""
# SPDX-License-Identifier: MIT

import math
import os
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program
from photographs import (DOUBLE_GAUSS, IRRADIANCE, MEAN, Studio, centroid, mean_of, on_diagonal,
                         take, write_pfm)

EFL = 50.358167  # mm, of the double Gauss in golden figures
UP = "camera at=0,1,0 look=0,2,0 up=0,0,-1\n"
AHEAD = "camera at=0,0,0 look=0,0,-1\n"
SKY = "light sky uniform luminance=1000\n"


def check_uniform(studio):
    """Irradiance of every film radius, with 1000 cd/m2 and 1/100 s: H = 10 E/L."""
    rows = studio.take(UP + SKY, "-t", "0.01", "--focus", "36.105905", "--size", "90x60",
                       "--samples", "512", "--bounces", "0")
    if rows is None:
        return
    for radius, expected in IRRADIANCE.items():
        studio.near(on_diagonal(rows, 36, radius) / 10, expected, 5e-3, f"E/L at {radius} mm")
    rows = studio.take(UP + SKY, "-t", "0.01", "--focus", "36.3612", "--size", "45x30",
                       "--samples", "256")
    if rows is not None:
        studio.near(mean_of(rows) / 10, MEAN, 1e-3, "mean E/L")


def check_furnace(studio):
    """A white card is photographed through the same pupils: as much light in every pixel."""
    write_pfm(os.path.join(studio.folder, "white.pfm"), [[1.0, 1.0], [1.0, 1.0]])
    moving = "material grey lambert colour=0.5\n" + \
             "sphere material=grey radius=1 at=0,-9,0 move=30,0,0 spin=1\n"
    common = ["-t", "0.01", "--size", "24x16", "--samples", "256"]
    for scene, words in (("", ["-s", "10m"]), ("", ["-s", "1m", "-N", "4"]),
                         (moving, ["-s", "10m", "--no-skip", "time"]),
                         ("", ["-s", "10m", "--no-skip", "all"]),
                         ("", ["-s", "10m", "--model", "thick"])):
        white = take(studio.program, studio.checks, studio.folder, "white.pfm", "--lens",
                     DOUBLE_GAUSS, "--field-width", "60m", *words[:4], *common)
        rows = studio.take(UP + SKY + scene, *words, *common)
        if white is None or rows is None:
            return
        limit = 0.06 if "all" in words else 0.006  # many rays are lost if pupils are taken whole
        pairs = [(a[k], b[k]) for one, other in zip(white, rows) for a, b in zip(one, other)
                 for k in range(3)]
        off = math.sqrt(sum((a - b) ** 2 for a, b in pairs) / len(pairs)) / mean_of(white)
        worst = max(abs(a - b) for a, b in pairs) / mean_of(white)
        studio.checks.check(off < limit and worst < 4.5 * limit,
                            f"{words}: pixels of the sky are {off:.4f} off, one {worst:.4f}")
        studio.near(mean_of(rows), mean_of(white), limit / 10, f"{words}: the sky")


def check_disc(studio):
    """A pupil that is a disc, of half angle a from the axis, at the field angle t."""
    rows = studio.take(UP + SKY, "-t", "0.01", "-s", "inf", "-N", "2", "--model", "thin", "--size",
                       "36x24", "--samples", "256", "--bounces", "0")
    if rows is None:
        return
    tan_a2 = 1 / 16
    for column, row in ((18, 12), (35, 12), (35, 23), (0, 0), (26, 4)):
        tan_t2 = ((column - 17.5) ** 2 + (row - 11.5) ** 2) / EFL ** 2
        expected = math.pi / 2 * (1 - (1 + tan_t2 - tan_a2) / math.sqrt(
            tan_t2 ** 2 + 2 * tan_t2 * (1 - tan_a2) + (1 + tan_a2) ** 2))
        studio.near(rows[row][column][1] / 10, expected, 5e-3, f"a disc seen from {column}, {row}")


def check_reciprocity(studio):
    """N and T against sqrt 2 N and 2 T: by sin^2 of the pupil's half angle."""
    light = []
    for number, time in ((2, 0.01), (2 * math.sqrt(2), 0.02)):
        rows = studio.take(UP + SKY, "-t", str(time), "-s", "inf", "-N", repr(number), "--model",
                           "thin", "--sensor", "0.2x0.1mm", "--size", "16x8", "--samples", "256")
        if rows is None:
            return
        light.append(mean_of(rows))
    expected = 2 * (1 + 4 * 4) / (1 + 4 * 8)
    studio.near(light[1] / light[0], expected, 1e-4, "an exposure by half the pupil, twice as long")


def check_lit(studio):
    """A wall in the sun, and half of the sky: rho (E cos + pi L/2)/pi."""
    wall = "material wall lambert colour=0.6\nplane material=wall at=0,0,-3 normal=0,0,1\n"
    sun = "light sun illuminance=50000 towards=0,0.6,0.8\n"
    common = ["-t", "0.01", "--focus", "36.105905", "--sensor", "1.6x0.8mm", "--size", "16x8",
              "--samples", "1024", "--bounces", "1"]
    for lights, expected in ((sun, 40000), (SKY, 500 * math.pi),
                             (sun + SKY, 40000 + 500 * math.pi),
                             ("light point at=1.5,0,-1 intensity=1000\n",
                              1000 * 2 / (1.5 ** 2 + 4) ** 1.5),
                             ("material lamp black luminance=9000\n"
                              "sphere material=lamp radius=0.5 at=1.5,0,-1\n",
                              9000 * math.pi * 0.25 * 2 / (1.5 ** 2 + 4) ** 1.5)):
        rows = studio.take(AHEAD + wall + lights, *common)
        if rows is not None:
            studio.near(mean_of(rows), 0.01 * IRRADIANCE[0] * 0.6 * expected / math.pi, 5e-3,
                        f"a wall in {lights.split()[1]}")


def check_room(studio):
    """Six walls that shine and reflect half: 1 + 1/2 + 1/4 .. of their light."""
    walls = "material wall lambert colour=0.5 luminance=100\n" + "".join(
        f"plane material=wall at={3 * x},{3 * y},{3 * z} normal={-x},{-y},{-z}\n"
        for x, y, z in ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)))
    for bounces, expected in ((0, 100), (1, 150), (4, 193.75), (100, 200)):
        rows = studio.take(AHEAD + walls, "-t", "0.01", "--focus", "36.105905", "--sensor",
                           "1.6x0.8mm", "--size", "16x8", "--samples", "256", "--bounces",
                           str(bounces))
        if rows is not None:
            studio.near(mean_of(rows), 0.01 * IRRADIANCE[0] * expected, 5e-3,
                        f"a room, {bounces} bounces")


def check_sun(studio):
    """All light of the sun that the pupil takes: E times its area."""
    rows = studio.take("camera at=0,1,0 look=0,1.6,0.8\nlight sun illuminance=1000 "
                       "towards=0,0.6,0.8 diameter=2deg\n", "-t", "0.01", "-s", "inf", "-N", "8",
                       "--sensor", "3.2x1.92mm", "--size", "32x20", "--samples", "256")
    if rows is not None:
        flux = mean_of(rows) / 0.01 * 3.2 * 1.92
        studio.near(flux, 1000 * math.pi / 4 * (EFL / 8) ** 2, 5e-3, "lx mm2 of the sun")


def check_places(studio):
    """Lamps behind one another, and one behind a mirror: in one place through a small stop."""
    lamp = "material lamp black luminance=1000\n"
    common = ["-t", "0.01", "-s", "4m", "-N", "22", "--sensor", "18x12mm", "--size", "180x120",
              "--samples", "16", "--bounces", "1"]
    mirror = "material glass mirror colour=0.5\nplane material=glass at=0,0,-6 normal=0,0,1\n"
    found = []
    for where, radius, more in (("0.2,0.1,-2", 0.02, ""), ("0.8,0.4,-8", 0.08, ""),
                                ("1.2,0.6,0", 0.12, mirror)):
        rows = studio.take(AHEAD + lamp + f"sphere material=lamp radius={radius} at={where}\n" +
                           more, *common)
        if rows is None:
            return
        found.append((*centroid(rows, 0.1), sum(pixel[1] for row in rows for pixel in row)))
    for (x, y, light), share, what in zip(found, (1, 1, 0.5), ("near", "far", "in the mirror")):
        scale = EFL * 4000 / (4000 - EFL)  # to a plane that is sharp, from the entrance pupil
        studio.checks.check(math.hypot(x - found[0][0], y - found[0][1]) < 0.02,
                            f"a lamp {what} is at {x:.4f} {y:.4f}, expected as {found[0]}")
        studio.checks.check(abs(y / x - 0.5) < 2e-3, f"a lamp {what} lies in another direction")
        studio.checks.check(abs(x - 0.1 * scale) < 0.01 * 0.1 * scale,
                            f"a lamp {what} is {x:.4f} mm to the right, about {0.1 * scale:.4f}")
        studio.near(light, share * found[0][2], 0.02, f"light of a lamp {what}")


def check_colours(studio):
    """A colour of sRGB under daylight comes back, from three bands and from wavelengths."""
    colour = (0.8, 0.3, 0.05)
    scene = AHEAD + SKY + f"colour brick rgb={','.join(map(str, colour))}\n" \
        "material wall lambert colour=brick\nplane material=wall at=0,0,-3 normal=0,0,1\n"
    common = ["-t", "0.01", "--focus", "36.105905", "--sensor", "1.6x0.8mm", "--size", "16x8",
              "--samples", "256", "--bounces", "1"]
    for words in (["--spectral"], ["--spectral", "--bands", "8"], ["--spectral", "--bands", "57"],
                  []):
        rows = studio.take(scene, *words, *common)
        for k in range(3 if rows is not None else 0):
            studio.near(mean_of(rows, k), 0.01 * IRRADIANCE[0] * 500 * colour[k], 0.01,
                        f"{' '.join(words)}: {'red green blue'.split()[k]}")


def luminance(pixel):
    return 0.2126 * pixel[0] + 0.7152 * pixel[1] + 0.0722 * pixel[2]


def check_line(studio):
    """Light of one wavelength: as many rays as there are sets of bands meet it as often as others,
    of whose bands the most have none. A thin lens at f/16 is of L pi/(4 N^2 + 1)."""
    with open(os.path.join(studio.folder, "line.csv"), "w", encoding="utf-8") as file:
        file.write("wavelength_nm,power\n544,0\n545,1\n546,0\n")
    scene = AHEAD + "colour green table=line.csv\n" \
        "material lamp black luminance=1000 emission=green\n" \
        "plane material=lamp at=0,0,-3 normal=0,0,1\n"
    common = ["-t", "1", "-s", "inf", "--model", "thin", "-N", "16", "--sensor", "1.6x0.8mm",
              "--size", "64x32", "--bounces", "0", "--spectral"]
    light = 1000 * math.pi / (4 * 16 ** 2 + 1)
    # 32 bands are 8 sets of four; of 57, which are none, each is met by chance
    for bands, samples, error in (32, 8, 4e-3), (64, 16, 4e-3), (57, 512, 0.1):
        rows = studio.take(scene, *common, "--bands", str(bands), "--samples", str(samples))
        if rows is not None:
            most = max(abs(luminance(pixel) / light - 1) for row in rows for pixel in row)
            studio.checks.check(most < error, f"a line in {bands} bands, {samples} rays: a pixel "
                                              f"is off by {100 * most:.3g} %")
            mean = sum(luminance(pixel) for row in rows for pixel in row) / (64 * 32)
            studio.near(mean, light, 4e-3, f"a line in {bands} bands")


def check_filter(studio):
    """A filter of M mired before wavelengths: the light that it makes of another; 1 at 555 nm."""
    waves = [390 + 2 * i for i in range(161)]
    shift, second = 112e-6, 14387.77  # of Wratten 85, 2/3 of a stop; um K
    tables = {"plain": [1 + 0.5 * math.sin(nm / 40) for nm in waves],
              "line": [1.0 if 550 <= nm <= 560 else 0 for nm in waves]}
    tables["behind"] = [value * math.exp(-shift * second * (1000 / nm - 1 / 0.555))
                        for nm, value in zip(waves, tables["plain"])]
    for name, values in tables.items():
        with open(os.path.join(studio.folder, name + ".tsv"), "w", encoding="utf-8") as file:
            file.write("wavelength_nm\tvalue\n" +
                       "".join(f"{nm}\t{value:.9g}\n" for nm, value in zip(waves, values)))
    common = ["-t", "0.01", "--focus", "36.105905", "--sensor", "1.6x0.8mm", "--size", "16x8",
              "--samples", "64", "--bounces", "0", "--spectral", "--bands", "64"]
    filtered = ["--filter", "wratten-85"]
    found = []
    for name, words in (("plain", filtered), ("behind", []), ("line", filtered), ("line", [])):
        rows = studio.take(AHEAD + f"colour light table={name}.tsv\nmaterial lamp black "
                           "luminance=500 emission=light\n"
                           "plane material=lamp at=0,0,-3 normal=0,0,1\n", *words, *common)
        if rows is None:
            return
        found.append([mean_of(rows, k) for k in range(3)])
    for k, name in (0, "red"), (2, "blue"):
        studio.near(found[0][k] / found[0][1], found[1][k] / found[1][1], 2e-3,
                    f"{name} over green behind a filter")
    studio.near(found[2][1] / found[3][1], 2 ** -0.667, 5e-3, "a line at 555 nm")


def check_errors(studio):
    """How the error of a smooth picture falls, and how often it is what differs says it is."""
    scene = AHEAD + "material wall lambert colour=0.6\nplane material=wall at=0,0,-3 " \
            "normal=0,0,1\nmaterial lamp black luminance=9000\n" \
            "sphere material=lamp radius=0.5 at=1.5,0,-1\n" + SKY
    common = ["-t", "0.01", "-s", "3m", "-N", "4", "--size", "16x8", "--bounces", "2"]
    best = studio.take(scene, *common, "--samples", "4096", "--seed", "99")
    if best is None:
        return
    errors = []
    for samples in "8", "128":
        rows = studio.take(scene, *common, "--samples", samples)
        errors.append(math.sqrt(sum((a[1] - b[1]) ** 2 for row, other in zip(rows, best)
                                    for a, b in zip(row, other))))
    slope = math.log(errors[1] / errors[0]) / math.log(16)
    studio.checks.check(slope <= -0.7, f"the error falls with the power {slope:.2f} of the samples")
    several = [studio.take(scene, *common, "--samples", "16", "--seed", str(seed))
               for seed in range(10)]
    within = 0
    for j, row in enumerate(best):
        for i, truth in enumerate(row):
            values = [rows[j][i][1] for rows in several]
            middle = sum(values) / len(values)
            sigma = math.sqrt(sum((v - middle) ** 2 for v in values) / (len(values) - 1) /
                              len(values))
            within += abs(middle - truth[1]) < 2.262 * sigma  # Student's, 9 degrees of freedom
    share = within / (16 * 8)
    studio.checks.check(0.89 <= share <= 1, f"{share:.3f} of the pixels are as near as they say")


def check_threads(studio):
    scene = AHEAD + "material wall glossy colour=0.6 roughness=0.2\nplane material=wall at=0,0,-3 " \
            "normal=0,0,1\nsphere material=wall radius=0.4 at=0,0,-2\n" + SKY
    common = ["-t", "0.01", "-s", "3m", "--size", "40x24", "--samples", "4", "--bounces", "6"]
    one = studio.take(scene, *common)
    studio.checks.check(studio.take(scene, *common, "--threads", "2") == one,
                        "two threads take another picture than one")
    crop = studio.take(scene, *common, "--crop", "17:5:9x12")
    studio.checks.check(crop == [row[17:26] for row in one[5:17]], "a crop is another picture")
    studio.checks.check(studio.take(scene, *common, "--seed", "1") != one,
                        "another seed takes the same picture")


def main():
    program, checks = Program(sys.argv[1]), Checks()
    with tempfile.TemporaryDirectory(prefix="lenscalc-scene-") as folder:
        studio = Studio(program, checks, folder, "--lens", DOUBLE_GAUSS)
        for check in (check_uniform, check_furnace, check_disc, check_reciprocity, check_lit,
                      check_room, check_sun, check_places, check_colours, check_line,
                      check_filter, check_errors, check_threads):
            check(studio)
    return checks.finish()


main()
