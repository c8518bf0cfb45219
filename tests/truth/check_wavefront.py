#!/usr/bin/env python3
"""tests/truth/check_wavefront.py - lenscalc wavefront against a tracer of its own here:
check_wavefront.py BUILD_DIR

The double Gauss of the lecture at f/5.6, unvignetted: spheres by the textbook, rays aimed at the
stop by Newton's method, paths to the reference sphere, and projections on Zernike's polynomials as
sums of powers over a polar quadrature. Paraxial data are those of 50 digits in reference/golden.md.
"""
# SPDX-License-Identifier: MIT

import csv
import io
import math
import os
import subprocess
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program
from integrals import gauss, noll

WAVE = 587.5618e-6  # mm
SURFACES = [  # radius, thickness, index behind at the d line; None: the stop
    (58.95, 7.52, 1.67), (169.66, 0.24, 1), (38.55, 8.05, 1.67), (81.54, 6.55, 1.699),
    (25.5, 11.41, 1), (None, 9, 1), (-28.99, 2.36, 1.603), (81.54, 12.13, 1.658),
    (-40.77, 0.38, 1), (874.13, 6.44, 1.717), (-79.46, 0, 1)]
IMAGE, PUPIL = 72.211810477084275, -35.542713478024463  # from the last vertex
STOP = 34.715623151528464 / 2 * 2 / 5.6


def trace(x, y, angle):
    """From (x, y) on the first vertex plane: (place in the stop, point, direction, path) behind
    the last surface, in the frame of its vertex; the path from the wave front through the vertex."""
    p, d = [x, y, 0.0], [0.0, math.sin(angle), math.cos(angle)]
    path, n, stop = y * math.sin(angle), 1.0, None
    for radius, thickness, behind in SURFACES:
        if radius is None:
            s = -p[2] / d[2]
            p = [a + s * b for a, b in zip(p, d)]
            path += n * s
            stop = p[:2]
        else:
            q = [p[0], p[1], p[2] - radius]
            b = sum(u * v for u, v in zip(q, d))
            c = sum(u * u for u in q) - radius * radius
            s = -b - math.copysign(math.sqrt(b * b - c), radius)
            p = [a + s * e for a, e in zip(p, d)]
            path += n * s
            normal = [p[0] / -radius, p[1] / -radius, (radius - p[2]) / radius]
            cos1 = sum(u * v for u, v in zip(normal, d))
            ratio = n / behind
            cos2 = math.sqrt(1 - ratio * ratio * (1 - cos1 * cos1))
            d = [ratio * e + (cos2 - ratio * cos1) * m for e, m in zip(d, normal)]
            n = behind
        p = [p[0], p[1], p[2] - thickness]
    return stop, p, d, path


def aim(px, py, angle):
    """The ray through a point of the stop."""
    x, y = px * STOP, py * STOP - 40 * math.tan(angle)
    for _ in range(20):
        at, dx, dy = trace(x, y, angle)[0], trace(x + 1e-4, y, angle)[0], trace(x, y + 1e-4, angle)[0]
        a, b = (dx[0] - at[0]) / 1e-4, (dy[0] - at[0]) / 1e-4
        c, e = (dx[1] - at[1]) / 1e-4, (dy[1] - at[1]) / 1e-4
        u, v = px * STOP - at[0], py * STOP - at[1]
        det = a * e - b * c
        x, y = x + (e * u - b * v) / det, y + (a * v - c * u) / det
        if math.hypot(u, v) < 1e-12:
            break
    return trace(x, y, angle)


def to_sphere(ray, centre, radius):
    _, p, d, path = ray
    q = [a - c for a, c in zip(p, centre)]
    b = sum(u * v for u, v in zip(q, d))
    c = sum(u * u for u in q) - radius * radius
    return path - b - math.sqrt(b * b - c)


def wave_front(angle):
    """[(radius, angle in the stop, weight, W in wavelengths)]"""
    chief = aim(0, 0, angle)
    way = [(z - chief[1][2]) / chief[2][2] for z in (IMAGE, PUPIL)]
    centre, crossing = ([p + w * d for p, d in zip(chief[1], chief[2])] for w in way)
    radius = math.dist(centre, crossing)
    zero = to_sphere(chief, centre, radius)
    points = []
    for u, weight in gauss(14):
        for k in range(29):
            r, turn = math.sqrt(u), math.pi / 2 + 2 * math.pi * k / 29
            ray = aim(r * math.cos(turn), r * math.sin(turn), angle)
            points.append((r, turn, weight / 29, (zero - to_sphere(ray, centre, radius)) / WAVE))
    return points


def rows(program, words):
    result = subprocess.run(program.command + words + ["--csv"], text=True, capture_output=True,
                            env=program.environment())
    return list(csv.DictReader(io.StringIO(result.stdout)))


def main():
    program, checks = Program(sys.argv[1]), Checks()
    for field in (0, 10, 14):
        points = wave_front(math.radians(field))
        words = ["wavefront", "double-gauss", "-N", "5.6", "--no-clip", "--focus", "paraxial",
                 "--field", str(field)]
        mean = sum(w * wave for _, _, w, wave in points)
        rms = math.sqrt(sum(w * (wave - mean) ** 2 for _, _, w, wave in points))
        re = sum(w * math.cos(2 * math.pi * wave) for _, _, w, wave in points)
        im = sum(w * math.sin(2 * math.pi * wave) for _, _, w, wave in points)
        row = rows(program, words + ["--error", "1e-9"])[0]
        for name, expected, allowed in (("rms_waves", rms, 1e-8), ("mean_waves", mean, 1e-8),
                                        ("strehl", re * re + im * im, 1e-7)):
            checks.against("by-rays", f"wave front of double-gauss at {field} deg", name, row[name],
                           expected, allowed, "waves" if name.endswith("_waves") else "")
        for row in rows(program, words + ["--zernike", "noll", "--terms", "66"]):
            j = int(row["index"])
            expected = sum(w * wave * noll(j, r, turn) for r, turn, w, wave in points)
            if j <= 28:
                checks.against("by-rays", f"wave front of double-gauss at {field} deg", f"Z{j}",
                               row["coefficient_waves"], expected, 1e-7, "waves")
    checks.finish()


if __name__ == "__main__":
    main()
