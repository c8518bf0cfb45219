#!/usr/bin/env python3
"""tests/truth/check_rendered.py - where light comes, and how much: check_rendered.py BUILD_DIR

Through one lens behind its stop, traced by a program of its own: discs of a chart lie where the
chief rays of their middles do, red, green and blue ones apart by their dispersion; on the axis the
exposure is pi L sin^2(theta'), so that f-numbers and times exchange by the exact ratio. Behind a
lens whose stop comes last a white scene is a disc seen from the side, in closed form, whatever the
focus, the time and the wavelengths. Errors shrink as normal ones: 95 % of the pixels within 1.96
deviations of the integral, no bias.
"""
# SPDX-License-Identifier: MIT

import math
import os
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program
from photographs import take, write_pfm
from singlet import LINES, Singlet

TRACED = (611, 549, 464)  # red, green, blue
DISTANCE = 1000


def centroid(rows, channel):
    """Of the light, in pixels from the upper left."""
    total = across = down = 0
    for j, row in enumerate(rows):
        for i, pixel in enumerate(row):
            light = pixel[channel]
            total, across, down = (total + light, across + (i + 0.5) * light,
                                   down + (j + 0.5) * light)
    return across / total, down / total


class Discs:
    """Pictures of chart:points through a flint far behind a small stop, disc by disc."""

    columns, pitch, width, side = 1200, 0.03, 360, 24

    def __init__(self, checks, program, folder):
        self.of = program, checks, folder
        self.lens = Singlet((90, -200), 6, (1.728, 28.5), 25, 1)
        self.lens.write(os.path.join(folder, "far.lens"))
        self.film = self.lens.paraxial(DISTANCE)[0]
        size = f"{self.columns * self.pitch}x{self.columns * self.pitch}mm"
        self.common = ["chart:points", "--lens", "far.lens", "-s", f"{DISTANCE}mm", "--from",
                       "front", "--focus", repr(self.film), "-t", "1", "--sensor", size, "--size",
                       f"{self.columns}x{self.columns}", "--field-width", f"{self.width}mm"]

    def card(self, i, k):
        return i * self.width / 12, k * self.width / 12

    def chief(self, i, k, nm):
        """Of the middle of disc i, k, in pixels from the middle of the picture."""
        x, y, _ = self.lens.forward(self.card(i, k), (0, 0), nm, self.film, DISTANCE)
        return -x / self.pitch, -y / self.pitch

    def take(self, i, k, *more):
        """The middles of its red, green and blue light."""
        x, y = self.chief(i, k, TRACED[1])
        middle = self.columns / 2
        left, top = (round(middle + at) - self.side // 2 for at in (x, -y))
        rows = take(*self.of, *self.common, *more, "--crop",
                    f"{left}:{top}:{self.side}x{self.side}")
        found = [centroid(rows, channel) for channel in range(3)] if rows is not None else []
        return [(left + a - middle, middle - top - b) for a, b in found]


def check_places(checks, discs):
    """Barrel distortion and lateral colour."""
    scale = discs.chief(1e-5, 0, TRACED[1])[0] * 1e5
    bends, spreads = [], []
    for i, k in (0, 0), (1, 0), (4, 0), (0, 4), (-4, 2), (-3, -4):
        found = discs.take(i, k, "--samples", "256")
        chiefs = [discs.chief(i, k, nm) for nm in TRACED]
        if not found:
            return
        for nm, (a, b), (x, y) in zip(TRACED, found, chiefs):
            checks.check(abs(a - x) < 0.02 and abs(b - y) < 0.02,
                         f"disc {i}, {k} at {nm} nm lies at {a:.3f}, {b:.3f}: its chief ray at "
                         f"{x:.3f}, {y:.3f}")
        spread, expected = (math.hypot(*at[0]) - math.hypot(*at[2]) for at in (found, chiefs))
        checks.check(abs(spread - expected) < 0.02,
                     f"disc {i}, {k}: blue and red are {spread:.3f} pixels apart, not {expected:.3f}")
        spreads.append(expected)
        bends.append(abs(math.hypot(*chiefs[1]) - scale * math.hypot(i, k)))
    checks.check(max(bends) > 2 and max(spreads) > 0.5, f"{max(bends)} {max(spreads)}: a real test")


def check_colours(checks, discs):
    """Several wavelengths a colour: the means of their chief rays."""
    waves = [[nm + 80 * ((n + 0.5) / 8 - 0.5) for n in range(8)] for nm in TRACED]
    means = [sum(discs.chief(4, 0, nm)[0] for nm in band) / 8 for band in waves]
    lines = (1 * discs.chief(4, 0, LINES["d"])[0] + 2 * discs.chief(4, 0, LINES["F"])[0] +
             1 * discs.chief(4, 0, LINES["C"])[0]) / 4
    for more, expected in (["--band", "80"], means), (["--spectrum", "d:1,F:2,C:1"], [lines] * 3):
        for (a, _), x in zip(discs.take(4, 0, "--samples", "256", *more), expected):
            checks.check(abs(a - x) < 0.03, f"{more}: a disc at {a:.3f}, its chief rays at {x:.3f}")


def check_blur(checks, program, folder):
    """A point out of focus: the spread of its rays through a round stop, and through blades."""
    lens = Singlet((100, -100), 5, (1.5168, 64.17), 2, 10)
    lens.write(os.path.join(folder, "blurred.lens"))
    film, pitch, side, disc = lens.paraxial(DISTANCE)[0] + 4, 0.02, 40, 2
    common = ["chart:points", "--lens", "blurred.lens", "-s", f"{DISTANCE}mm", "--from", "front",
              "--focus", repr(film), "-w", "d", "-t", "0.01", "--sensor",
              f"{side * pitch}x{side * pitch}mm", "--size", f"{side}x{side}", "--samples", "256",
              "--field-width", f"{200 * disc}mm"]
    light = {}
    for blades in 0, 5, 8:
        more = ["--blades", str(blades)] if blades else []
        rows = take(program, checks, folder, *common, *more)
        if rows is None:
            return
        light[blades] = sum(pixel[1] for row in rows for pixel in row)
        a, b = centroid(rows, 1)
        found = sum(pixel[1] * ((i + 0.5 - a) ** 2 + (j + 0.5 - b) ** 2)
                    for j, row in enumerate(rows) for i, pixel in enumerate(row)) / light[blades]
        # of the rays, of the disc, and of the pixel
        moment, steps, count = 0, 40, 0
        for n in range(steps ** 2):
            x, y = (((2 * k + 1) / steps - 1) * lens.diameter / 2 for k in (n % steps, n // steps))
            turn = 2 * math.pi / blades if blades else 0
            apothem = math.cos(turn / 2) * lens.diameter / 2
            inside = (all(x * math.cos((k + 0.5) * turn) + y * math.sin((k + 0.5) * turn) < apothem
                          for k in range(blades)) if blades else math.hypot(x, y) < apothem)
            if inside:
                u, v, _ = lens.forward((0, 0), (x, y), LINES["d"], film, DISTANCE)
                moment, count = moment + (u * u + v * v) / pitch ** 2, count + 1
        scale = lens.forward((1e-3, 0), (0, 0), LINES["d"], film, DISTANCE)[0] * 1e3 / pitch
        expected = moment / count + (scale * disc / 2) ** 2 / 2 + 2 / 12
        checks.check(abs(found - expected) < 0.01 * expected,
                     f"{blades} blades: a blur of {found} square pixels, expected {expected}")
        if blades:
            area = blades / (2 * math.pi) * math.sin(2 * math.pi / blades)
            share = light[blades] / light[0]
            checks.check(abs(share - area) < 5e-3, f"{blades} blades let {share} pass, not {area}")


def marginal_sine(lens, film, edge):
    """Of the ray from the middle of the film that meets the edge of the stop."""
    low, high = 0.0, 0.5
    for _ in range(60):
        sine = (low + high) / 2
        x = lens.trace((0, 0, lens.last() + film), (sine, 0, -math.sqrt(1 - sine * sine)),
                       LINES["d"], 0)[0]
        low, high = (sine, high) if x < edge else (low, sine)
    return (low + high) / 2


def check_exchange(checks, program, folder):
    """pi L t sin^2(theta') in the middle, at (N, t) and (N sqrt(2), 2 t)."""
    write_pfm(os.path.join(folder, "white.pfm"), [[1.0, 1.0], [1.0, 1.0]])
    lens = Singlet((100, -100), 5, (1.5168, 64.17), 2, 20)
    lens.write(os.path.join(folder, "fast.lens"))
    film, focal = lens.paraxial(DISTANCE)
    exposures = []
    for number, time in (5.6, 0.01), (5.6 * math.sqrt(2), 0.02):
        rows = take(program, checks, folder, "white.pfm", "--lens", "fast.lens", "-s",
                    f"{DISTANCE}mm", "--from", "front", "--focus", repr(film), "-w", "d", "-N",
                    repr(number), "-t", repr(time), "--sensor", "0.1x0.1mm", "--size", "8x8",
                    "--samples", "256", "--luminance", "500", "--field-width", "2m")
        if rows is None:
            return
        edge = focal / number / 2
        sine = marginal_sine(lens, film, edge)
        found = sum(pixel[1] for row in rows for pixel in row) / 64
        expected = math.pi * 500 * time * sine ** 2
        checks.check(abs(found - expected) < 1e-3 * expected,
                     f"{found} lx s at f/{number:.3g}, expected {expected}")
        exposures.append((found, time * sine ** 2))
    ratio = exposures[0][0] / exposures[1][0]
    exact = exposures[0][1] / exposures[1][1]
    checks.check(abs(ratio - exact) < 1e-3 and abs(exact - 1) > 1e-4, f"{ratio}, not {exact}")


def check_furnace(checks, program, folder):
    """E of a disc of half angle a seen t beside its axis, at all films, times, wavelengths."""
    with open(os.path.join(folder, "last.lens"), "w", encoding="utf-8") as file:
        file.write("lens stop behind\naperture stop\nsurface 100 5 1.6/40 60\n"
                   "surface -100 5 air 60\nstop - 30 air 12\n")
    for film, time, more in (30, 1, ["-w", "d"]), (45, 0.004, []), (90, 30, ["--seed", "3"]):
        rows = take(program, checks, folder, "white.pfm", "--lens", "last.lens", "-s", "3m",
                    "--focus", str(film), "-t", str(time), "--size", "12x8", "--samples", "8192",
                    "--field-width", "100m", *more)
        if rows is None:
            return
        tan2a = (6 / film) ** 2
        for j, i in (3, 5), (0, 5), (3, 0), (0, 0):
            # over the pixel: the mean of 4 x 4 points
            expected = 0
            for k in range(16):
                x, y = 3 * (i - 6 + (k % 4 + 0.5) / 4), 3 * (j - 4 + (k // 4 + 0.5) / 4)
                tan2 = (x * x + y * y) / film ** 2
                root = math.sqrt(tan2 ** 2 + 2 * tan2 * (1 - tan2a) + (1 + tan2a) ** 2)
                expected += math.pi / 2 * (1 - (1 + tan2 - tan2a) / root) / 16 * 1000 * time
            for found in rows[j][i]:
                checks.check(abs(found - expected) < 1.5e-3 * expected,
                             f"{found} lx s of white at pixel {i}, {j}, film {film}: {expected}")


def check_errors(checks, program, folder):
    """Twenty-four seeds of 4 rays a pixel, against 4096 rays."""
    common = ["chart:checker", "--lens", "double-gauss-50", "-s", "1m", "--defocus", "0.5", "-t",
              "0.01", "--size", "24x16", "-w", "d"]
    best = take(program, checks, folder, *common, "--samples", "4096", "--seed", "99")
    runs = [take(program, checks, folder, *common, "--samples", "4", "--seed", str(seed))
            for seed in range(1, 25)]
    if best is None or None in runs:
        return
    within = count = biased = pixels = 0
    for j, row in enumerate(best):
        for i, pixel in enumerate(row):
            values = [run[j][i][1] for run in runs]
            mean = sum(values) / len(values)
            variance = sum((v - mean) ** 2 for v in values) / (len(values) - 1)
            if variance == 0:
                continue
            biased, pixels = biased + (mean - pixel[1]) / math.sqrt(variance / len(values)), pixels + 1
            within += sum(abs(v - pixel[1]) < 1.959964 * math.sqrt(variance) for v in values)
            count += len(values)
    share = within / count
    checks.check(0.93 < share < 0.97, f"{share} of the values lie within 1.96 sigma")
    checks.check(abs(biased) / math.sqrt(pixels) < 4, f"bias of {biased / math.sqrt(pixels)} sigma")


def main():
    program, checks = Program(sys.argv[1]), Checks()
    with tempfile.TemporaryDirectory(prefix="lenscalc-rendered-") as folder:
        discs = Discs(checks, program, folder)
        check_places(checks, discs)
        check_colours(checks, discs)
        check_blur(checks, program, folder)
        check_exchange(checks, program, folder)
        check_furnace(checks, program, folder)
        check_errors(checks, program, folder)
    return checks.finish()


if __name__ == "__main__":
    sys.exit(main())
