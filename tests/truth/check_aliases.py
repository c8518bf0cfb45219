#!/usr/bin/env python3
"""tests/truth/check_aliases.py - optimised aspheres between the rays and fields of their merit:
check_aliases.py BUILD_DIR

Lenses behind or at their stop are optimised with the usual rays and fields, and written. Their rays
are traced here, by Newton's method and the law of refraction in vectors: hundreds of points of the
pupil, and fields between those of the lens, have what the merit promises. Where the command says
how many rays or fields there are, they have not, and a warning says so.
"""
# SPDX-License-Identifier: MIT

import math
import os
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program

FAST = """lens       singlet of two aspheres, f/1.2
wavelength 850nm
field      angle 0
aperture   epd 6.667
focus      table
goal       opd, efl = 8 : 0.01, center > 2 : 0.05
stop    - 0.5 air -
surface 6 3.5 1.51 - R~ k~ A4~ A6~ A8~ A10~
surface - 5 air -    c~ t~[1,10]
"""
WIDE = """lens       two aspheres behind a stop
wavelength d
field      angle 0 8 16
aperture   epd 2
focus      table
goal       poly, efl = 10 : 0.01, center > 1 : 0.05
stop    -  4 air -
surface -20 2 1.53 - R~ k~ A4~ A6~ A8~ A10~
surface -5 2 air - R~ k~ A4~ A6~ A8~ A10~
surface 20 2 1.6 - R~ k~ A4~ A6~ A8~ A10~
surface -40 7 air - R~ k~ A4~ A6~ A8~ A10~ t~[3,12]
"""
WAVE = 850e-6  # mm


def read(path):
    """The surfaces behind the stop, and its distance from them: (c, k, coefficients, thickness,
    index behind)."""
    surfaces, gap = [], 0.0
    for line in open(path, encoding="utf-8"):
        words = line.split()
        if words[:1] == ["stop"]:
            gap = float(words[2])
        elif words[:1] == ["surface"]:
            named = dict(word.split("=") for word in words[5:] if "=" in word)
            curvature = float(named.get("c", 0)) if words[1] == "-" else 1 / float(words[1])
            terms = [(int(name[1:]), float(value)) for name, value in named.items()
                     if name[0] == "A"]
            surfaces.append((curvature, float(named.get("k", 0)), terms, float(words[2]),
                             1.0 if words[3] == "air" else float(words[3])))
    return surfaces, gap


def sag(surface, square):
    """z and dz/d(r^2) at r^2."""
    c, k, terms = surface[:3]
    root = math.sqrt(1 - (1 + k) * c * c * square)
    z, slope = c * square / (1 + root), c / (2 * root)
    for power, a in terms:
        z += a * square ** (power / 2)
        slope += a * power / 2 * square ** (power / 2 - 1)
    return z, slope


def trace(lens, x, y, angle):
    """From (x, y) in the stop to the image plane: the point there, and the optical path from the
    wave front through the centre of the stop to the last surface and on to (0, 0) of the image."""
    surfaces, gap = lens
    p, d, n = [x, y, -gap], [0.0, math.sin(angle), math.cos(angle)], 1.0
    path = y * math.sin(angle)
    for surface in surfaces:
        s = -p[2] / d[2]
        for _ in range(50):
            at = [a + s * b for a, b in zip(p, d)]
            z, slope = sag(surface, at[0] ** 2 + at[1] ** 2)
            normal = [-2 * slope * at[0], -2 * slope * at[1], 1.0]
            step = (z - at[2]) / sum(a * b for a, b in zip(normal, d))
            s += step
            if abs(step) < 1e-14:
                break
        p = [a + s * b for a, b in zip(p, d)]
        path += n * s
        size = math.sqrt(sum(a * a for a in normal))
        normal = [a / size for a in normal]
        ratio = n / surface[4]
        cosine = sum(a * b for a, b in zip(normal, d))
        bent = math.sqrt(1 - ratio * ratio * (1 - cosine * cosine)) - ratio * cosine
        d = [ratio * a + bent * b for a, b in zip(d, normal)]
        n = surface[4]
        last, p = p, [p[0], p[1], p[2] - surface[3]]
    image = surfaces[-1][3]
    s = -p[2] / d[2]
    path += math.hypot(last[0], last[1], image - last[2])
    return p[0] + s * d[0], p[1] + s * d[1], path


def rings(radius, count, arms):
    """Points of equal areas."""
    return [(radius * math.sqrt((i + 0.5) / count) * math.cos(2 * math.pi * (k + 0.5) / arms),
             radius * math.sqrt((i + 0.5) / count) * math.sin(2 * math.pi * (k + 0.5) / arms))
            for i in range(count) for k in range(arms)]


def wave_front(lens):
    """Root mean square on the axis, wavelengths, by 400 rays of a radius."""
    paths = [trace(lens, 0, y, 0)[2] for _, y in
             ((0, 6.667 / 2 * math.sqrt((i + 0.5) / 400)) for i in range(400))]
    mean = sum(paths) / len(paths)
    return math.sqrt(sum((a - mean) ** 2 for a in paths) / len(paths)) / WAVE


def spot(lens, field):
    """Root mean square about the centroid, um, by 168 rays."""
    at = [trace(lens, x, y, math.radians(field))[:2] for x, y in rings(1.0, 12, 14)]
    mean = [sum(a[i] for a in at) / len(at) for i in (0, 1)]
    return 1e3 * math.sqrt(sum((a[0] - mean[0]) ** 2 + (a[1] - mean[1]) ** 2 for a in at) / len(at))


def optimised(program, text, *more):
    """The lens that is written, and what was said."""
    with tempfile.TemporaryDirectory() as folder:
        start, found = (os.path.join(folder, name) for name in ("start.lens", "found.lens"))
        with open(start, "w", encoding="utf-8") as file:
            file.write(text)
        result = program.run("optimize", start, "-o", found, *more)
        return read(found), " ".join((result.stdout + result.stderr).decode().split())


def main():
    program, checks = Program(sys.argv[1]), Checks()
    lens, said = optimised(program, FAST)
    found = wave_front(lens)
    checks.check(found < 0.02, f"f/1.2: the wave front has {found:.3g} wavelengths")
    checks.check("it went on with 144" in said, f"f/1.2: said: {said}")
    lens, said = optimised(program, FAST, "--rays", "36")
    found = wave_front(lens)
    checks.check(found > 0.5 and "more --rays are wanted" in said,
                 f"f/1.2 by 36 rays: {found:.3g} wavelengths, said: {said}")
    lens, said = optimised(program, WIDE)
    given, between = (max(spot(lens, field) for field in fields)
                      for fields in ((0, 8, 16), (2, 4, 6, 10, 12, 14, 15)))
    checks.check(between < 2 * given and between < 0.5,
                 f"16 deg: {between:.3g} um between the fields, {given:.3g} um at them")
    checks.check("it went on with fields between" in said, f"16 deg: said: {said}")
    lens, said = optimised(program, WIDE, "--field", "0,8,16")
    given, between = (max(spot(lens, field) for field in fields)
                      for fields in ((0, 8, 16), (12,)))
    checks.check(between > 1.5 * given and "field 12 deg" in said and "with --field" in said,
                 f"16 deg by three fields: {between:.3g} um and {given:.3g} um, said: {said}")
    checks.finish()


main()
