#!/usr/bin/env python3
"""tests/truth/check_shutter.py - shutters of lenscalc render: check_shutter.py BUILD_DIR

Light and times of rays against closed forms and sums in python: a leaf shutter exposes by the
integral of its open area over time, a slit before the film has a penumbra as wide as the beam is
there, curtains at rest hide what passes beyond them, and lines of a film begin one after the other.
"""
# SPDX-License-Identifier: MIT

import bisect
import csv
import itertools
import math
import os
import re
import struct
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from check_pictures_files import read_exr, read_pfm
from harness import Checks, Program

WHITE = b"Pf\n2 2\n-1.0\n" + struct.pack("<4f", 1, 1, 1, 1)
# the stop first, so that a ray leaves the lens where it passes the stop
FRONT_STOP = """lens        a singlet behind its stop
object      inf
field       angle 0 10
aperture    stop
stop        -     8     air         12.5
surface     -400  5     1.6/50      30
surface     -27.2 50    air         30
"""
# double-gauss-50: f-number by its stop, distance of its image from H', of a card at 1 m
OWN, IMAGE = 2.030153, 50.35817 / (1 - 0.05035817)
HALF = math.sqrt(0.5)
T, OPENING, CLOSING = 1 / 500, 1e-3, 2.5e-3
LEAF = ["-t", "1/500", "--shutter", "leaf", "--opening-time", "1ms", "--closing-time", "2.5ms"]
GLOBAL = ["-t", "1/500"]
CARD = ["white.pfm", "-s", "1m", "--field-width", "30m", "-w", "d"]
THIN = CARD + ["--lens", "double-gauss-50", "--model", "thin"]


class Fixture:
    def __init__(self, build, checks, folder):
        self.program, self.checks, self.folder = Program(build), checks, folder

    def run(self, command, *words):
        result = subprocess.run(self.program.command + [command, *words], text=True,
                                cwd=self.folder, capture_output=True,
                                env=self.program.environment())
        self.checks.check(result.returncode == 0, f"{words}: {result.stderr}")
        return result

    def picture(self, *words, name="out.pfm"):
        """Rows of the green channel."""
        self.run("render", *words, "-o", name)
        return self.rows(name)

    def bytes(self, name):
        with open(os.path.join(self.folder, name), "rb") as file:
            return file.read()

    def rows(self, name):
        return [row[1::3] for row in read_pfm(self.bytes(name))[3]]

    def rays(self, *words):
        self.run("render", *words, "--rays", "rays.csv")
        with open(os.path.join(self.folder, "rays.csv"), newline="", encoding="ascii") as file:
            return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


def mean(rows):
    return sum(map(sum, rows)) / sum(map(len, rows))


def area_over_time(share, falloff):
    """Of a hole that grows and shrinks, over that of the whole stop for T: by rings and moments.
    share: the stop's radius over the shutter's; falloff: weight of a ring by its radius."""
    steps, rings = 1000, 200
    begin, end = -T / 2 - OPENING * HALF, T / 2 + CLOSING * HALF
    weights = [(i + 0.5) * falloff((i + 0.5) / rings) for i in range(rings)]
    total = sum(weights)
    inside = [0]
    for weight in weights:
        inside.append(inside[-1] + weight / total)
    found = 0
    for i in range(steps):
        time = begin + (end - begin) * (i + 0.5) / steps
        hole = min(1, (time - begin) / OPENING, (end - time) / CLOSING) / share
        at = min(1, hole) * rings
        low = min(int(at), rings - 1)
        found += inside[low] + (at - low) * (inside[low + 1] - inside[low])
    return found * (end - begin) / steps / T


def check_leaf(fixture):
    film = ["--sensor", "0.2x0.2mm", "--size", "16x8", "--samples", "256"]
    for fnumber in None, 4, 8:
        own = [] if fnumber is None else ["-N", str(fnumber)]
        share = OWN / (fnumber or OWN)
        slope = share * 50.35817 / OWN / 2 / IMAGE  # of the marginal ray
        expected = area_over_time(share, lambda r: (1 + (r * slope) ** 2) ** -2)
        found = (mean(fixture.picture(*THIN, *film, *own, *LEAF, "--no-skip", "all")) /
                 mean(fixture.picture(*THIN, *film, *own, *GLOBAL, "--no-skip", "all")))
        fixture.checks.near("leaf", f"leaf at f/{fnumber}", found, expected, 5e-4)
        said = fixture.run("render", *THIN, *film, *own, *LEAF, "-o", "said.pfm").stderr
        effective = 1 / float(re.search(r"full light in 1/([0-9.]+) s", said).group(1))
        fixture.checks.near("said", f"said of it at f/{fnumber}", effective / T, expected, 5e-4)
        # without the falloff of a beam so wide, as the page has it
        closed = 1 + (OPENING + CLOSING) / T * (HALF - 2 * share / 3)
        fixture.checks.near("closed", f"closed form at f/{fnumber}", expected, closed, 0.03 * share)


def check_stop(fixture):
    """Of each ray of a real lens by where it passes the stop."""
    words = ["--lens", "front.lens", "--samples", "4096", "--sensor", "24x16mm"]
    both = zip(fixture.rays(*words), fixture.rays(*words, *LEAF))
    worst_weight = worst_time = 0
    places, moved = [], 0
    for plain, leaf in both:
        r = math.hypot(plain["x_mm"], plain["y_mm"]) / 6.25 - HALF
        begin, end = -T / 2 + OPENING * r, T / 2 - CLOSING * r
        worst_weight = max(worst_weight, abs(leaf["weight"] / plain["weight"] - (end - begin) / T))
        place = ((leaf["time"] - 0.5) * T - begin) / (end - begin)
        worst_time = max(worst_time, abs(place - plain["time"]))
        places.append(place)
        moved += any(plain[key] != leaf[key] for key in plain if key not in ("weight", "time"))
    fixture.checks.check(moved == 0, f"{moved} rays go another way with a shutter")
    fixture.checks.check(worst_weight < 1e-9, f"weights by the stop: off by {worst_weight}")
    fixture.checks.check(worst_time < 1e-9, f"times by the stop: off by {worst_time}")
    spread = [abs(place - (i + 0.5) / len(places)) for i, place in enumerate(sorted(places))]
    fixture.checks.check(max(spread) < 0.02, "times lie evenly in their intervals")


def check_blur(fixture):
    """Light that is out of focus: the disc of a point is the time of each place of the pupil."""
    point = bytearray(4 * 51 * 51)
    point[4 * (51 * 25 + 25):4 * (51 * 25 + 26)] = struct.pack("<f", 1)
    with open(os.path.join(fixture.folder, "point.pfm"), "wb") as file:
        file.write(b"Pf\n51 51\n-1.0\n" + point)
    words = ["point.pfm", "--lens", "double-gauss-50", "--model", "thin", "-s", "1m", "-w", "d",
             "--field-width", "51mm", "--defocus", "0.6mm", "--sensor", "0.4x0.4mm", "--size",
             "32x32", "--samples", "256"]

    def spread(*shutter):
        """Mean square of the distance from the middle."""
        rows = fixture.picture(*words, *shutter)
        all_light = sum(map(sum, rows))
        return sum(value * ((x - 15.5) ** 2 + (y - 15.5) ** 2)
                   for y, row in enumerate(rows) for x, value in enumerate(row)) / all_light

    plain = spread(*GLOBAL)
    size = (IMAGE + 0.6) / 1000 * 32 / 0.4  # of the point, in pixels
    sharp = size * size / 3 + 1 / 6  # of the point, linear between pixels of the card, and a pixel
    for opening, time in (1e-3, 1 / 500), (1e-3, 1 / 1600), (1e-3, 1 / 100):
        ramps = 2 * opening / time  # over the exposure time
        middle = 1 + ramps * HALF
        share = (middle / 2 - ramps * 2 / 5) / (middle - ramps * 2 / 3) / (1 / 2)
        found = spread("-t", repr(time), "--shutter", "leaf", "--opening-time", f"{opening}s")
        fixture.checks.near("blur", f"disc of a point in {time} s", (found - sharp) / (plain - sharp),
                            share, 0.004)


def open_share(at, width, weight):
    """Share of a round beam, of such a width, below a straight edge: by slices."""
    slices = 400
    below = total = 0
    for i in range(slices):
        x = width / 2 * (2 * (i + 0.5) / slices - 1)
        half = math.sqrt(width * width / 4 - x * x)
        light = sum(weight(math.hypot(x, half * (k + 0.5) / 8)) for k in range(8)) * half
        total += light
        below += light if x < at else 0
    return below / total


def check_penumbra(fixture):
    """Times of the light of one point: the slit's edges pass a beam of d/N."""
    speed, distance = 6000, 4  # mm/s, mm
    beam = distance * 50.35817 / OWN / IMAGE
    rays = fixture.rays("--lens", "double-gauss-50", "--model", "thin", "-s", "1m", "-w", "d",
                        "-t", "0.2ms", "--shutter", "focal", "--travel-time", f"{0.02 / speed}s",
                        "--curtain-distance", f"{distance}mm", "--sensor", "0.02x0.02mm",
                        "--samples", "8192")
    times = sorted(((ray["time"] - 0.5) * 0.2e-3, ray["weight"]) for ray in rays)
    until = list(itertools.accumulate(weight for _, weight in times))
    steps = 200
    span = 0.2e-3 + beam / speed
    edges = [open_share(-beam / 2 + beam * i / steps, beam,
                        lambda r: (1 + (r / distance) ** 2) ** -2) for i in range(steps + 1)]

    def share(at):
        place = max(0, min(1, at / beam + 0.5)) * steps
        low = min(int(place), steps - 1)
        return edges[low] + (place - low) * (edges[low + 1] - edges[low])

    light = [share((span * (i + 0.5) / 2000 - span / 2 + 0.1e-3) * speed) -
             share((span * (i + 0.5) / 2000 - span / 2 - 0.1e-3) * speed) for i in range(2000)]
    before, worst = 0, 0
    for i, one in enumerate(light):
        before += one / sum(light)
        time = span * (i + 1) / 2000 - span / 2
        arrived = bisect.bisect(times, (time, 0))
        worst = max(worst, abs(before - (until[arrived - 1] / until[-1] if arrived > 0 else 0)))
    fixture.checks.check(worst < 0.006, f"light over time behind a slit: off by {worst}")
    total = times[-1][0] - times[0][0]
    fixture.checks.near("penumbra", "slit and beam over the speed", total, span, 0.04 * span)


def check_curtains(fixture):
    """Even light as long as the curtains run far enough; dark edges where they do not."""
    film = ["--sensor", "2x24mm", "--size", "16x96", "--samples", "64", "--no-skip", "all"]
    focal = ["-t", "1/500", "--shutter", "focal", "--travel-time", "4ms", "--curtain-distance",
             "6mm"]
    plain = fixture.picture(*THIN, *film, *GLOBAL)
    width = 50.35817 / OWN  # of the pupil
    for overrun in None, 0, 0.7:
        cut = [] if overrun is None else ["--curtain-overrun", f"{overrun}mm"]
        shut = fixture.picture(*THIN, *film, *focal, *cut)
        for row in (0, 1, 2, 3, 4, 5, 8, 40, 91, 93, 94, 95):
            y = abs(-12 + (row + 0.5) / 4)
            edge = 99 if overrun is None else y + (12 + overrun - y) * IMAGE / 6
            expected = 1 if edge > width / 2 else open_share(edge, width, lambda r: 1)
            fixture.checks.near("ends", f"row {row} at {overrun}", sum(shut[row]) / sum(plain[row]),
                                expected, 1e-6 if overrun is None else 0.02)


def check_lines(fixture):
    """Each line's times, by its place on the film: the picture's top is that of -y."""
    words = ["--lens", "double-gauss-50", "--samples", "2048", "--sensor", "36x24mm", "-t", "1/100"]
    for way, axis, sign, extent in (("down", "film_y_mm", 1, 24), ("up", "film_y_mm", -1, 24),
                                    ("right", "film_x_mm", -1, 36), ("left", "film_x_mm", 1, 36)):
        rays = fixture.rays(*words, "--shutter", "rolling", "--readout", "20ms",
                            "--shutter-direction", way)
        apart = [ray["time"] - sign * ray[axis] / extent * 20e-3 * 100 for ray in rays]
        fixture.checks.check(-1e-9 < min(apart) < 0.01 and 0.99 < max(apart) < 1 + 1e-9,
                             f"{way}: lines' times {min(apart)} to {max(apart)}")


def check_files(fixture):
    """Several times, parts and skips give what one picture alone gives; files say the shutter."""
    chart = ["chart:checker", "--lens", "double-gauss-50", "-s", "1m", "--size", "40x24",
             "--samples", "4", "--shutter", "leaf", "--opening-time", "1ms"]
    fixture.run("render", *chart, "-t", "1/100,1/900", "-o", "many.exr")
    for number, time in (1, "1/100"), (2, "1/900"):
        fixture.run("render", *chart, "-t", time, "-o", "one.exr")
        fixture.checks.check(fixture.bytes("one.exr") == fixture.bytes(f"many-{number}.exr"),
                             f"{time} of several")
    note = read_exr(fixture.bytes("one.exr"))[4]["Shutter"][1]
    fixture.checks.check(note.rstrip(b"\0") == b"leaf, opens in 0.001 s, closes in 0.001 s",
                         f"note: {note}")
    for more, expected in ([], b""), (["--curtain-overrun", "1mm"], b", to 1 mm beyond its edges"):
        fixture.run("render", *chart[:9], "-t", "1/100", "--shutter", "focal", "--travel-time",
                    "4ms", "--curtain-distance", "2mm", *more, "-o", "focal.exr")
        note = read_exr(fixture.bytes("focal.exr"))[4]["Shutter"][1]
        fixture.checks.check(note.rstrip(b"\0") == b"focal, down in 0.004 s, 2 mm before the film" +
                             expected, f"note: {note}")
    for part in "1/2", "2/2":
        fixture.run("render", *chart, "-t", "1/900", "--part", part, "-o", f"{part[0]}.part")
    fixture.run("merge", "1.part", "2.part", "-o", "merged.exr")
    fixture.checks.check(fixture.bytes("merged.exr") == fixture.bytes("one.exr"), "merged parts")


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory(prefix="lenscalc-shutter-") as folder:
        fixture = Fixture(sys.argv[1], checks, folder)
        with open(os.path.join(folder, "white.pfm"), "wb") as file:
            file.write(WHITE)
        with open(os.path.join(folder, "front.lens"), "w", encoding="ascii") as file:
            file.write(FRONT_STOP)
        for check in (check_leaf, check_stop, check_blur, check_penumbra, check_curtains, check_lines,
                      check_files):
            check(fixture)
    return checks.finish()


if __name__ == "__main__":
    main()
