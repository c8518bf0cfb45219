#!/usr/bin/env python3
"""tests/truth/check_edge.py - the sharpness of rendered pictures: check_edge.py BUILD_DIR

The contrast of a slanted edge, analysed as ISO 12233 does (the edge found row by row, pixels in
quarters of a pixel across it, differences, Fourier transform), is that of the rays: those of a
tracer of its own through a singlet, times the known transfer functions of the pixel, the quarters
and the differences; and what lenscalc mtf says by rays, of an edge in a scene and a double Gauss
too.
"""
# SPDX-License-Identifier: MIT

import cmath
import math
import os
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program
from photographs import Studio, take
from singlet import LINES, Singlet

SIDE, PITCH, DISTANCE = 96, 0.005, 1000  # pixels, mm, mm
SLANT = math.radians(5)
PARTS = 4  # of a pixel


def sinc(x):
    return 1 if x == 0 else math.sin(math.pi * x) / (math.pi * x)


def fit(points):
    """x = a + b y by least squares."""
    count = len(points)
    sx, sy = sum(x for x, _ in points), sum(y for _, y in points)
    sxy, syy = sum(x * y for x, y in points), sum(y * y for _, y in points)
    b = (count * sxy - sx * sy) / (count * syy - sy * sy)
    return (sx - b * sy) / count, b


def edge_spread(rows):
    """Means of the pixels in steps of a quarter of a pixel across the edge; and its angle."""
    centres = []
    for y, row in enumerate(rows):
        steps = [row[x] - row[x + 1] for x in range(len(row) - 1)]
        centres.append((sum((x + 1) * s for x, s in enumerate(steps)) / sum(steps), y + 0.5))
    a, b = fit(centres)
    angle = math.atan(-b)  # rows go down
    sums, counts = {}, {}
    for y, row in enumerate(rows):
        for x, value in enumerate(row):
            k = math.floor((x + 0.5 - a - b * (y + 0.5)) * math.cos(angle) * PARTS)
            sums[k], counts[k] = sums.get(k, 0) + value, counts.get(k, 0) + 1
    most = min(max(sums), -min(sums)) - 2 * PARTS
    return [sums[k] / counts[k] for k in range(-most, most)], angle


def measured(rows, frequencies):
    spread, angle = edge_spread(rows)
    line = [b - a for a, b in zip(spread, spread[1:])]
    found = []
    for frequency in frequencies:
        f = frequency * PITCH
        total = sum(s * cmath.exp(-2j * math.pi * f * k / PARTS) for k, s in enumerate(line))
        known = sinc(f * math.cos(angle)) * sinc(f * math.sin(angle)) * sinc(f / PARTS) ** 2
        found.append(abs(total / sum(line)) / known)
    return found, angle


def of_rays(lens, film, frequencies):
    """Backwards from the middle of the film: even in direction cosines is even in irradiance."""
    plane = lens.last() + film
    side = 1.3 * lens.diameter / 2 / film
    steps, offsets = 160, []
    for i in range(steps):
        for k in range(steps):
            p, q = ((2 * j + 1) / steps - 1 for j in (i, k))
            p, q = p * side, q * side
            direction = (p, q, -math.sqrt(1 - p * p - q * q))
            x, y, out = lens.trace((0, 0, plane), direction, LINES["d"], 0)
            if math.hypot(x, y) <= lens.diameter / 2:
                along = -DISTANCE / out[2]
                offsets.append((x + along * out[0], y + along * out[1]))
    chief = lens.forward((1.0, 0), (0, 0), LINES["d"], film, DISTANCE)[0]
    across = [(x * math.cos(SLANT) + y * math.sin(SLANT)) * chief for x, y in offsets]
    return [abs(sum(cmath.exp(-2j * math.pi * f * u) for u in across)) / len(across)
            for f in frequencies]


def check_lens(checks, program, folder, lens, defocus):
    lens.write(os.path.join(folder, "singlet.lens"))
    film = lens.paraxial(DISTANCE)[0] + defocus
    width = SIDE * PITCH
    rows = take(program, checks, folder, "chart:edge", "--lens", "singlet.lens", "-s",
                f"{DISTANCE}mm", "--from", "front", "--focus", repr(film), "-w", "d", "-t", "0.01",
                "--sensor", f"{width}x{width}mm", "--size", f"{SIDE}x{SIDE}", "--samples", "256",
                "--field-width", "40mm")
    if rows is None:
        return
    frequencies = [5, 10, 15, 20, 30, 40, 60]
    found, angle = measured([[pixel[1] for pixel in row] for row in rows], frequencies)
    checks.check(abs(math.degrees(angle) - 5) < 0.02, f"the edge leans {math.degrees(angle)} deg")
    expected = of_rays(lens, film, frequencies)
    for frequency, a, b in zip(frequencies, found, expected):
        checks.check(abs(a - b) < 0.01,
                     f"{defocus} mm: contrast {a:.4f} at {frequency}/mm, of the rays {b:.4f}")
    check_said(checks, program, found, frequencies, os.path.join(folder, "singlet.lens"),
               "--object", str(DISTANCE), "--focus", repr(film))


def check_said(checks, program, found, frequencies, *words):
    """By lenscalc mtf, of the middle of the film."""
    rows = program.rows("mtf", *words, "--method", "geometric", "-w", "d", "--field", "0",
                        "--frequency", ",".join(map(str, frequencies)))
    if not checks.check(isinstance(rows, list) and len(rows) == len(found), f"{words}: {rows}"):
        return
    for a, row, frequency in zip(found, rows, frequencies):
        said = float(row["tangential"])
        checks.check(abs(a - said) < 0.01, f"{words}: contrast {a:.4f} at {frequency}/mm, "
                                           f"lenscalc mtf says {said:.4f}")


def check_scene(checks, program, folder):
    """Half a wall that shines, 3 m away; the distance in the middle of the film."""
    lens = "double-gauss-50"
    first = program.rows("lens", lens, "-w", "d")[0]
    pupil = float(first["entrance_pupil_mm"])
    width = SIDE * PITCH
    studio = Studio(program, checks, folder)
    for number, film in (2.8, 36.98), (4, 36.9):
        rows = studio.take(f"unit mm\ncamera at=0,0,0 look=0,0,-1\nmaterial lamp black "
                           f"luminance=500\ncard material=lamp size=2000,4000 turn=0,0,5 at="
                           f"{-1000 * math.cos(SLANT)},{-1000 * math.sin(SLANT)},{-3000 - pupil}\n",
                           "--lens", lens, "-N", str(number), "--focus", str(film),
                           "-w", "d", "-t", "0.01", "--sensor", f"{width}x{width}mm", "--size",
                           f"{SIDE}x{SIDE}", "--samples", "256", "--bounces", "0")
        if rows is not None:
            frequencies = [5, 10, 15, 20, 30, 40, 60]
            found, _ = measured([[pixel[1] for pixel in row] for row in rows], frequencies)
            check_said(checks, program, found, frequencies, lens, "-N", str(number), "--object",
                       "3000", "--focus", str(film))


def main():
    program, checks = Program(sys.argv[1]), Checks()
    with tempfile.TemporaryDirectory(prefix="lenscalc-edge-") as folder:
        lens = Singlet((100, -100), 5, (1.5168, 64.17), 2, 12)
        for defocus in 0.0, -0.15, -0.4:
            check_lens(checks, program, folder, lens, defocus)
        check_scene(checks, program, folder)
    return checks.finish()


if __name__ == "__main__":
    sys.exit(main())
