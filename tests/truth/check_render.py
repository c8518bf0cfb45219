#!/usr/bin/env python3
"""tests/truth/check_render.py - the rays of lenscalc render: check_render.py BUILD_DIR

Turned round and traced forwards each comes back to its point of the film. Their weights add up to
the mean irradiance of a film, for the double Gauss of the course as an independent quadrature and
another renderer have it; ring by ring to that of a disc behind which there is no glass, and with
blades to that of their polygon.
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
from photographs import DOUBLE_GAUSS, MEAN, MEAN_BY_PBRT

LENSES = ("cs348b-dgauss-50", "nikkor-z-58-f095", "fisheye-16", "questar-35", "phone-80deg",
          "human-eye-artal", "nikkor-z-14-24")
MEAN_ERROR = 6e-5  # three others are within


def table(program, *words, text=None):
    result = subprocess.run(program.command + list(words), input=text, text=True,
                            capture_output=True, env=program.environment())
    return list(csv.DictReader(io.StringIO(result.stdout))), result.stderr


def check_back(checks, program, name):
    """Through the lens again, the other way."""
    rays, said = table(program, "render", "--lens", name, "--rays", "-", "--samples", "300", "-w", "d")
    if not checks.check(len(rays) > 200, f"{name}: {len(rays)} rays of 300: {said}"):
        return
    starts = "x_mm,y_mm,z_mm,cos_x,cos_y,cos_z\n" + "".join(
        ",".join([ray["x_mm"], ray["y_mm"], ray["z_mm"]] +
                 [repr(-float(ray[cosine])) for cosine in ("cos_x", "cos_y", "cos_z")]) + "\n"
        for ray in rays)
    ends, said = table(program, "trace", name, "-w", "d", "--to", "image", "--batch", "-", "--csv",
                       text=starts)
    if not checks.check(len(ends) == len(rays), f"{name}: {said}"):
        return
    for ray, end in zip(rays, ends):
        miss = max(abs(float(end[f"{axis}_out_mm"] or "inf") - float(ray[f"film_{axis}_mm"]))
                   for axis in "xy")
        checks.check(miss < 1e-8, f"{name}: a ray comes back {miss} mm from where it left the film")


def check_mean(checks, program):
    rays, _ = table(program, "render", "--lens", "cs348b-dgauss-50", "--rays", "-", "--samples", "262144",
                    "-w", "d", "--focus", "36.3612")
    mean = sum(float(ray["weight"]) for ray in rays)
    checks.against("irradiance", DOUBLE_GAUSS, "render: mean E/L", mean, MEAN, MEAN_ERROR)
    for i, others in enumerate(MEAN_BY_PBRT):
        checks.against("pbrt", f"{DOUBLE_GAUSS}, sampling {i + 1}", "mean E/L", mean, others,
                       MEAN_ERROR)


DISC = "lens disc\nwavelength d\nobject inf\naperture stop\nstop - 0 air 40\n"
STOP, FILM = 20, 50  # mm: its radius, and from it to the film


def disc(height):
    """E/L of the stop, exact, not cos^4."""
    a2, t2 = (STOP / FILM) ** 2, (height / FILM) ** 2
    return math.pi / 2 * (1 - (1 + t2 - a2) /
                          math.sqrt(t2 * t2 + 2 * t2 * (1 - a2) + (1 + a2) ** 2))


def rays_of_disc(checks, program, *words):
    rays, said = table(program, "render", "--lens", "-", "--rays", "-", "--focus", str(FILM), *words,
                       text=DISC)
    checks.check(len(rays) > 0, f"{words}: {said}")
    return [{name: float(value) for name, value in ray.items()} for ray in rays]


def check_disc(checks, program):
    """In rings 2 mm wide of a square film, by four seeds: no bias, and little noise."""
    rings, seeds, side = 5, 4, 20
    found = [[0] * rings for _ in range(seeds)]
    for seed in range(seeds):
        for ray in rays_of_disc(checks, program, "--sensor", f"{side}x{side}mm", "--samples", "16384",
                                "--seed", str(seed)):
            ring = int(math.hypot(ray["film_x_mm"], ray["film_y_mm"]) / 2)
            if ring < rings:
                found[seed][ring] += ray["weight"]
    for ring in range(rings):
        # what lies in it, by the middles of 100 thinner ones
        radii = [2 * ring + (k + 0.5) / 50 for k in range(100)]
        expected = sum(disc(r) * 2 * math.pi * r / 50 for r in radii) / side ** 2
        mean = sum(one[ring] for one in found) / seeds
        sigma = math.sqrt(sum((one[ring] - mean) ** 2 for one in found) / (seeds - 1))
        checks.check(abs(mean - expected) < max(4 * sigma / math.sqrt(seeds), 1e-4 * expected),
                     f"ring {ring}: {mean}, expected {expected}, sigma {sigma}")
        checks.check(sigma < 5e-3 * expected, f"ring {ring}: sigma {sigma} of {expected}")


def polygon(corners):
    """E/L of a polygon seen from the axis: Lambert's sum of half angles times cosines."""
    total = 0
    for (x, y), (u, v) in zip(corners, corners[1:] + corners[:1]):
        normal = y * FILM - FILM * v, FILM * u - x * FILM, x * v - y * u
        size = math.hypot(*normal)
        total += math.atan2(size, x * u + y * v + FILM * FILM) * normal[2] / size / 2
    return abs(total)


def check_blades(checks, program):
    """All rays go through the polygon, and bring what it does; it has (n/2) r^2 sin(2 pi/n) mm^2."""
    for count, turn in (3, 20), (5, 0), (8, 7):
        corners = [(STOP * math.cos(math.radians(turn) + 2 * math.pi * k / count),
                    STOP * math.sin(math.radians(turn) + 2 * math.pi * k / count))
                   for k in range(count)]
        rays = rays_of_disc(checks, program, "--blades", str(count), "--blade-turn", str(turn),
                            "--sensor", "1e-6x1e-6mm", "--samples", "32768")
        light = sum(ray["weight"] for ray in rays)
        checks.check(abs(light - polygon(corners)) < 1e-3 * light,
                     f"{count} blades bring {light}, expected {polygon(corners)}")
        beyond = 0
        for (x, y), (u, v) in zip(corners, corners[1:] + corners[:1]):
            beyond = max([beyond] + [(ray["y_mm"] - y) * (u - x) - (ray["x_mm"] - x) * (v - y)
                                     for ray in rays], key=lambda side: -side)
        checks.check(beyond > -1e-9, f"a ray passes {beyond} beside {count} blades")
        # what a ray stands for in the stop: weight/(cos^4/d^2)
        area = sum(ray["weight"] * FILM ** 2 / ray["cos_z"] ** 4 for ray in rays)
        expected = count / 2 * STOP ** 2 * math.sin(2 * math.pi / count)
        checks.check(abs(area - expected) < 1e-3 * expected,
                     f"{count} blades leave {area} mm2, expected {expected}")


def main():
    program, checks = Program(sys.argv[1]), Checks()
    for name in LENSES:
        check_back(checks, program, name)
    check_mean(checks, program)
    check_disc(checks, program)
    check_blades(checks, program)
    return checks.finish()


if __name__ == "__main__":
    sys.exit(main())
