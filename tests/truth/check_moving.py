#!/usr/bin/env python3
"""tests/truth/check_moving.py - moving scenes through shutters: check_moving.py BUILD_DIR

A bright card with an upright edge runs across the picture of a thin lens: its edge becomes the sum
over time of what the shutter lets through, in closed form; a point out of focus leaves a trail as
wide as the hole of a leaf shutter is at each place of it.
"""
# SPDX-License-Identifier: MIT

import math
import os
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from check_pictures_files import read_pfm
from check_shutter import HALF, OWN, Fixture
from harness import EVERYTHING, Checks

FOCAL = 50.35817  # double-gauss-50, d line
M = FOCAL / (2000 - FOCAL)  # of what is 2 m away
SPEED = 3000.0  # mm/s, of the subject
ACROSS, WIDTH = 64, 0.4  # pixels and mm of the film, which is as high
EDGE = f"""scene     an edge that moves
camera    at=0,0,2 focus=2m
material  light black luminance=1000
card      material=light size=1,1 at=-0.5,0,0 move={SPEED / 1000},0,0
"""
FAST = 60000.0  # mm/s, of a small disc
POINT = f"""scene     a point that moves
camera    at=0,0,2 focus=2m
material  light black luminance=100000
disc      material=light radius=0.002 move={FAST / 1000},0,0
"""
LENS = ["--lens", "double-gauss-50", "--model", "thin", "-w", "d", "--bounces", "0", "--sensor",
        f"{WIDTH}x{WIDTH}mm", "--size", f"{ACROSS}x{ACROSS}"]


def edges(fixture, *shutter, samples=64):
    """Of each row: where the light ends, from the middle, mm, and the mean square beside that."""
    found = []
    pitch = WIDTH / ACROSS
    picture = fixture.picture("edge.scene", *LENS, "--samples", str(samples), *shutter)
    full = sum(sum(row[:8]) for row in picture) / 8 / ACROSS
    for row in picture:
        falls = [before - after for before, after in zip([full] + row[8:], row[8:])]
        places = [i * pitch - WIDTH / 2 for i in range(8, ACROSS)]
        mean = sum(fall * place for fall, place in zip(falls, places)) / sum(falls)
        found.append((mean, sum(fall * (place - mean) ** 2 for fall, place in zip(falls, places)) /
                      sum(falls) - pitch ** 2 / 6, row))
    return found


def check_ramp(fixture):
    """A straight ramp, |m| v T wide, about the edge's place in the middle of the exposure."""
    time = 0.002
    width = M * SPEED * time
    for mean, square, row in edges(fixture, "-t", str(time)):
        fixture.checks.near("ramp", "middle of the ramp", mean, 0, 0.02 * width)
        fixture.checks.near("ramp", "its width", math.sqrt(max(0, 12 * square)), width, 0.03 * width)
        for i, light in enumerate(row):
            x = (i + 0.5) * WIDTH / ACROSS - WIDTH / 2
            if abs(abs(x) - width / 2) > WIDTH / ACROSS:
                fixture.checks.near("light", f"light at {x} mm", light / row[0],
                                    max(0, min(1, 0.5 - x / width)), 0.06)


def slope_of(places):
    """How much a place grows from row to row, of a straight line through all."""
    n = len(places)
    middle = (n - 1) / 2
    return sum((i - middle) * place for i, place in enumerate(places)) / sum(
        (i - middle) ** 2 for i in range(n))


def check_skew(fixture):
    """Lines one after the other: v times the time of a line from one to the next."""
    readout = 0.003
    for way, sign in ("down", 1), ("up", -1):
        found = edges(fixture, "-t", "1/2000", "--shutter", "rolling", "--readout", f"{readout}s",
                      "--shutter-direction", way)
        lean = slope_of([mean for mean, _, _ in found])
        fixture.checks.near("skew", f"{way}: v t_row", lean,
                            sign * M * SPEED * readout / ACROSS, 0.01 * M * SPEED * readout / ACROSS)


def check_slit(fixture):
    """The same lean, and an edge that is as unsharp as slit and beam together."""
    travel, time, distance = 0.003, 1 / 2000, 0.1
    found = edges(fixture, "-t", str(time), "--shutter", "focal", "--travel-time", f"{travel}s",
                  "--curtain-distance", f"{distance}mm", samples=256)
    fixture.checks.near("slit", "lean", slope_of([mean for mean, _, _ in found]),
                        M * SPEED * travel / ACROSS, 0.01 * M * SPEED * travel / ACROSS)
    beam = distance / OWN / (1 + M) / (WIDTH / travel)  # s that a curtain takes over it
    lean = (M * SPEED * travel / ACROSS) ** 2 / 12  # within a row of pixels
    square = sum(square for _, square, _ in found) / len(found)
    expected = (M * SPEED) ** 2 * (time ** 2 / 12 + beam ** 2 / 16) + lean
    fixture.checks.near("slit", "unsharpness", square, expected, 0.02 * expected)


def check_leaf(fixture):
    """Light over time is the hole's area; a blurred point's trail is as wide as the hole."""
    time, opening = 0.002, 0.0015
    begin = -time / 2 - opening * HALF
    found = edges(fixture, "-t", str(time), "--shutter", "leaf", "--opening-time", f"{opening}s",
                  samples=256)
    steps = 2000
    open_area = []
    for i in range(steps):
        at = begin * (1 - 2 * (i + 0.5) / steps)
        open_area.append((at, min(1, (at - begin) / opening, (-begin - at) / opening) ** 2))
    expected = (M * SPEED) ** 2 * (sum(at ** 2 * area for at, area in open_area) /
                                   sum(area for _, area in open_area))
    square = sum(square for _, square, _ in found) / len(found)
    fixture.checks.near("leaf", "edge", square, expected, 0.02 * expected)


def check_trail(fixture):
    """What is out of focus is as wide as the hole when it passed: half of it, all of it, half."""
    time, opening, speed = 0.002, 0.0015, M * FAST  # mm/s on the film
    begin = -time / 2 - opening * HALF
    blur = 0.5 / OWN / (1 + M) / 2  # its radius, fully open, 0.5 mm behind the focus
    rows = fixture.picture("point.scene", *LENS[:-4], "--sensor", "8x0.4mm", "--size", "160x16",
                           "--samples", "8192", "--defocus", "0.5mm", "-t", str(time), "--shutter",
                           "leaf", "--opening-time", f"{opening}s")
    size = 2 * (1 + 0.5 / FOCAL) * M  # radius of the point, mm
    for hole in 1, 0.5:
        edge = hole * opening + begin  # when it is so wide
        low, high = (edge + 0.0001, 0) if hole == 1 else (edge - 0.0002, edge + 0.0002)
        light = square = 0
        for y, row in enumerate(rows):
            for x, value in enumerate(row):
                when = abs((x + 0.5) / 160 * 8 - 4) / speed
                if low <= -when <= high:
                    light += value
                    square += value * ((y + 0.5) / 16 * 0.4 - 0.2) ** 2
        # of a hole that opens meanwhile, each by its light; and within a pixel
        holes = [min(1, (when - begin) / opening) for when in
                 (low + (high - low) * (k + 0.5) / 100 for k in range(100))]
        square_hole = sum(h ** 4 for h in holes) / sum(h ** 2 for h in holes)
        expected = blur ** 2 * square_hole / 4 + size ** 2 / 4 + 0.025 ** 2 / 12
        fixture.checks.near("trail", f"trail at {hole}", square / light, expected, 0.06 * expected)


def check_bands(fixture):
    """Bands are chosen whatever the time: a moving edge's colours are as exact as their time is."""
    more = ["-t", "0.002", "--spectral", "--samples", "1024"]
    fixture.run("render", "edge.scene", *[word for word in LENS if word not in ("-w", "d")], *more,
                "-o", "bands.pfm")
    width = M * SPEED * 0.002
    for channel in range(3):
        rows = [row[channel::3] for row in read_pfm(fixture.bytes("bands.pfm"))[3]]
        full = sum(sum(row[:8]) for row in rows) / 8 / ACROSS
        square = count = 0
        for row in rows:
            for i, light in enumerate(row):
                x = (i + 0.5) * WIDTH / ACROSS - WIDTH / 2
                if abs(x) < width / 2 - WIDTH / ACROSS:
                    square += (light / full - 0.5 + x / width) ** 2
                    count += 1
        fixture.checks.near("bands", f"channel {channel} in the ramp", math.sqrt(square / count), 0,
                            0.012)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory(prefix="lenscalc-moving-") as folder:
        fixture = Fixture(sys.argv[1], checks, folder)
        for name, words in ("edge.scene", EDGE), ("point.scene", POINT):
            with open(os.path.join(folder, name), "w", encoding="ascii") as file:
                file.write(words)
        for check in check_ramp, check_skew, check_slit, check_leaf, check_bands:
            check(fixture)
        if EVERYTHING:  # it needs many rays
            check_trail(fixture)
    return checks.finish()


if __name__ == "__main__":
    main()
