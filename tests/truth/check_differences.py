#!/usr/bin/env python3
"""tests/truth/check_differences.py - the numbers of lenscalc-differences(7): with BUILD_DIR

What the page has of lenscalc is worked out here from closed forms and Snell's law; what it has of
other programs from their formulas. PRINTED are numbers that such programs printed themselves.
"""
# SPDX-License-Identifier: MIT

import math
import os
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import ROOT, Checks
from meridional import (DOUBLE_GAUSS, GAUSS, at_image, first_order, lens_of, paraxial, reverse,
                        rms_on_axis, solve, stop_of, through_stop, trace)
from page_numbers import Page

PRINTED = {"entrance pupil": 39.89296410310463, "exit pupil": -35.542713830886655}  # ray-optics
SEIDEL = 0.089035983027252720  # SI at f/2, by an independent program in 50 digits
DIAGONAL = math.hypot(36, 24)
WAVE = 0.5875618e-3  # mm
# 1/l^2 of d, F and C in 1/um^2, by which (nd, Vd) glass disperses
D, F, C = (1 / l ** 2 for l in (0.5875618, 0.4861327, 0.6562725))
ABBE = {1.670: 47.1, 1.699: 30.1, 1.603: 38.4, 1.658: 57.0, 1.717: 48.1}


def rings(count, radius):
    """A centre and rings of 6, 12, 18 .. rays with equal weights: (height, weight)."""
    total = 1 + 3 * count * (count + 1)
    return [(0.0, 1 / total)] + [(radius * k / count, 6 * k / total) for k in range(1, count + 1)]


def quadrature(radius):
    return [(radius * math.sqrt(q), w) for q, w in GAUSS]


def opd(lens, y, image, pupil):
    """Waves, on the sphere about the image point on the axis through the middle of the exit pupil,
    against the ray along the axis."""
    rows, angle, sag = trace(lens, y, 0.0)
    x, z = rows[-1][0], sag - image
    across = z * math.cos(angle) + x * math.sin(angle)  # along the ray from the point next to it
    reach = (image - pupil) ** 2 - (x * math.cos(angle) - z * math.sin(angle)) ** 2
    path = rows[-1][3] - across - math.sqrt(reach)
    axis = sum(row[1] * n for row, n in zip(lens[:-1], (row[2] for row in lens[:-1])))
    return (axis + pupil - path) / WAVE


def check_design(page):
    lens = DOUBLE_GAUSS
    efl, focus, _ = first_order(lens)
    radius = efl / 4  # of the paraxial entrance pupil at f/2
    converged = 1000 * rms_on_axis(lens, focus, quadrature(radius))
    by_rings = [1000 * rms_on_axis(lens, focus, rings(count, radius)) for count in (6, 32, 128)]
    for count, value in zip((6, 32, 128), by_rings):
        page.says(f"optiland, {count} rings", value)
    page.says("converged", converged)
    page.holds("--aim entrance \\ --columns rms", converged)
    page.holds("--pattern hexapolar", *(value for n, rms in zip((6, 32, 128), by_rings)
                                        for value in (*[1 + 3 * n * (n + 1)] * 2, rms)))
    stop = stop_of(lens)
    at_stop = radius * paraxial(lens)[stop][0]
    page.holds("--aim stop,entrance",
               1000 * rms_on_axis(lens, focus, through_stop(lens, at_stop)), converged)
    behind = lens[stop + 1:]  # from the middle of the stop, in air, 9 mm before them
    y, _, v = paraxial(behind, lens[stop][1], 1.0)[-1]
    exit_pupil = -y / v
    ahead = reverse(lens[:stop])
    y, _, v = paraxial(ahead, lens[stop - 1][1], 1.0)[-1]
    entrance = y / v
    waves = [(opd(lens, y, focus, exit_pupil), w) for y, w in quadrature(radius)]
    mean = sum(w * value for value, w in waves)
    page.holds("wavefront", math.sqrt(sum(w * (value - mean) ** 2 for value, w in waves)))
    zero = math.sqrt(sum(w * opd(lens, y, focus, exit_pupil) ** 2 for y, w in rings(128, radius)))
    page.says("optiland, 128 rings, OPD", zero)
    for name, value in PRINTED.items():
        page.says(f"ray-optics, {name}", value)
    page.holds("entrance_pupil,exit_pupil", entrance, exit_pupil)
    page.says("optiland, S1", -SEIDEL)
    page.holds("seidel", SEIDEL)


def bfl_at(lens, line):
    """Of glass n(l) = A + B/l^2 with n(d) and n(F) - n(C) = (n(d) - 1)/V."""
    other = [(*row[:2], row[2] if row[2] == 1 else
              row[2] + (row[2] - 1) / ABBE[row[2]] * (line - D) / (F - C), *row[3:])
             for row in lens]
    return first_order(other)[1]


def check_renderer(page):
    lens = lens_of("double-gauss-50")
    focus, rays = first_order(lens)[1], through_stop(lens)
    page.holds("double-gauss-50 -w d --field 0 --columns", 1000 * rms_on_axis(lens, focus, rays))
    whole = through_stop(lens, lens[stop_of(lens)][3] / 2)  # no other edge counts for the focus
    slopes = [(at_image(lens, y, focus), at_image(lens, y, focus + 1) - at_image(lens, y, focus), w)
              for y, w in whole]
    best = -sum(w * y * t for y, t, w in slopes) / sum(w * t * t for y, t, w in slopes)
    page.holds("--focus best", 1000 * rms_on_axis(lens, focus + best, rays))
    page.holds("-w F,C", 486.1327, bfl_at(lens, F), 656.2725, bfl_at(lens, C))


def limits(f, N, s, c):
    """Exactly, for P = 1, mm."""
    near, far = (s * f * f / (f * f + sign * N * c * (s - f)) for sign in (1, -1))
    return near, far if far > 0 else math.inf


def check_depth(page):
    c = DIAGONAL / 1440
    page.says("ExifTool, c = d/1440", 2.5 / (8 * c))
    page.says("FieldTools, c = 0.03 mm", 2.5 / (8 * 0.03))
    page.says("dof, c = 0.03 mm", 2.5 / (8 * 0.03) + 0.05)
    hyperfocal = 50 + 100000 * 50 ** 2 // (80 * 290)  # in whole mm
    page.says("Magic Lantern, c = 0.029 mm", (hyperfocal + 50) / 1000)
    page.holds("hyperfocal -f 50mm", *(value for one in (c, 0.03, 0.029)
                                       for value in (one, 2.5 / (8 * one) + 0.05)))
    page.holds("-s 10.42m", 2.5 / (8 * c) + 0.05, limits(50, 8, 10420, c)[1] / 1000)
    H, s = 100 ** 2 / (8 * 0.03), 200
    popular = H * s / (H + s), H * s / (H - s)
    near, far = limits(100, 8, 200, 0.03)
    page.says("FieldTools", *popular, popular[1] - popular[0])
    page.holds("--model popular,exact", *popular, popular[1] - popular[0], near, far, far - near)
    for f, N, s, c, name in ((50, 2.8, 2000, 0.018, "50 mm f/2.8, 2 m"),
                             (24, 8, 4000, 0.029, "24 mm f/8, 4 m"),
                             (100, 8, 200, 0.029, "100 mm f/8, 0.2 m")):
        page.says(f"Qalculate, {name}", 2 * N * c * s * s / f ** 2 / 1000)
        near, far = limits(f, N, s, c)
        page.holds(f"-f {f}mm -N {N} -s", (far - near) / 1000)
    page.says("dof, f/1.78", *(value / 1000 for value in limits(50, 2, 3000, 0.03)))
    page.holds("-N 1.78", *(value / 1000 for value in limits(50, 1.78, 3000, 0.03)))
    s, H = 3050 - 50, hyperfocal
    page.says("Magic Lantern", (50 + (s * H - 2500) // (H + s - 100)) / 1000,
              (50 + (s * H - 2 * 50 * s + 2500) // (H - s)) / 1000)
    s = solve(lambda s: s + 50 * s / (s - 50) - 3050, 200, 3050)
    page.holds("--from sensor", *((value + 3050 - s) / 1000 for value in limits(50, 8, s, 0.029)))
    rows = []
    for P in (0.5, 1, 2):
        eps = 8 * 0.03 / 100
        rows += [P, 2 * 100 * (1 + 1 / P) * eps / (1 - eps ** 2), 8 * (1 + 1 / P)]
    page.holds("-P 0.5,1,2", *rows)
    for name, value in (("ExifTool", DIAGONAL / 1440), ("dof", 0.03), ("Qalculate", 0.029),
                        ("Magic Lantern", 0.029)):
        page.says(f"{name}, circle of confusion", value)
    page.holds("--columns coc", DIAGONAL / 1500)


def main():
    checks = Checks()
    page = Page(checks, os.path.join(ROOT, "man", "lenscalc-differences.7"))
    check_design(page)
    check_renderer(page)
    check_depth(page)
    page.finish()
    return checks.finish()


if __name__ == "__main__":
    sys.exit(main())
