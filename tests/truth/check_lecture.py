#!/usr/bin/env python3
"""tests/truth/check_lecture.py - the numbers of lenscalc-lecture(7): check_lecture.py BUILD_DIR

Every number that the page prints is worked out here from the formulas of the slides, put right, and
from the slides' table of the double Gauss; those of exact rays from Snell's law.
"""
# SPDX-License-Identifier: MIT

import math
import os
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import ROOT, Checks
from meridional import (DOUBLE_GAUSS, SLIDE, first_order, irradiance_on_axis, lens_of, paraxial,
                        rms_on_axis, through_stop, trace)
from page_numbers import Page

DIAGONAL = math.hypot(36, 24)
FIRST_ZERO = 3.8317059702075123 / math.pi  # of J1, in Airy's 1.22
STOPS = [math.sqrt(2) ** k for k in range(9)]
LABELS = [1, 1.4, 2, 2.8, 4, 5.6, 8, 11, 16]
TIMES = [30, 15, 8, 4, 2, 1, 0.5, *(1 / t for t in (4, 8, 15, 30, 60, 125, 250, 500, 1000))]


def refracted(h, before=200.0, radius=50.0, n=1.5):
    """U, phi, I, I', U' in rad and where the ray crosses the axis, from a point on the axis."""
    sag = radius - math.sqrt(radius * radius - h * h)
    slope, normal = math.atan(h / (before + sag)), math.asin(h / radius)
    refraction = math.asin(math.sin(slope + normal) / n)
    after = refraction - normal
    return slope, normal, slope + normal, refraction, after, sag - h / math.tan(after)


def numbered(rows):
    return [value for i, row in enumerate(rows) for value in (i + 1, *row)]


def check_rays(page):
    slope, normal, incidence, refraction, after, _ = map(math.degrees, refracted(5))
    page.holds("--columns slope", slope, normal, incidence, refraction, after)
    u, phi = math.degrees(5 / 200), math.degrees(5 / 50)
    page.holds("--columns paraxial_slope", u, u + phi, (u + phi) / 1.5)
    image = 1.5 / (-1 / 200 + 0.5 / 50)
    page.holds("--columns height,image", *(value for h in (0.5, 5, 20) for value in (
        h, image, refracted(h)[5], refracted(h)[5] - image)))
    page.holds("object_vergence", 1000 * 0.5 / 50, -1000 / 200, 1000 * 1.5 / image)
    half = [(r / 2, t / 2, n, d / 2, stop) for r, t, n, d, stop in DOUBLE_GAUSS]
    rows = [(1000 * (before - v) / y, -1000 * before / y, -1000 * v / y)
            for y, before, v in paraxial(half)]
    page.holds("vergence_before_diopter", *numbered(rows))
    page.holds("lensmaker", 10, 10, 20, 50)
    rows = []
    for s in (math.inf, 10, 2, 0.5):
        m = 50 / (1000 * s - 50)
        rows += [s, 50 * (1 + m), 50 * m, m]
    page.holds("focus -f 50mm -s inf", *rows)
    page.holds("focus -f 50mm -s 120mm", 50 * 2.4 / 1.4, 1 / 1.4)
    lens = lens_of("double-gauss-50")
    page.checks.check(half[:-1] == lens[:-1], "double-gauss-50 is half of the slide's lens")
    focus = first_order(lens)[1]
    page.holds("illumination double-gauss-50", irradiance_on_axis(lens, focus))
    page.holds("spot double-gauss-50", 1000 * rms_on_axis(lens, focus, through_stop(lens)))
    page.holds("surfaces double-gauss --digits", *numbered((r, t, d) for r, t, _, d in SLIDE))
    focus = first_order(DOUBLE_GAUSS)[1]
    rays = trace(DOUBLE_GAUSS[:-1] + [(*DOUBLE_GAUSS[-1][:1], focus, *DOUBLE_GAUSS[-1][2:]),
                                      (math.inf, 0.0, 1.0, math.inf, False)], 10.0, 0.0)[0]
    page.holds("trace double-gauss", *numbered(
        (y, *(math.degrees(abs(angle)) for angle in angles)) for y, *angles, _ in rays))
    page.holds("lens telephoto-200", *(value for name in (
        "telephoto-200", "wide-35", "double-gauss-50", "fisheye-16")
        for value in first_order(lens_of(name))[:2]))


def check_thick(page):
    efl, bfl, front = first_order(DOUBLE_GAUSS)
    length = sum(row[1] for row in SLIDE[:-1])
    gap = length + bfl - efl - (front + efl)  # from H to H'
    page.holds("front_principal", efl, front + efl, bfl - efl)
    page.holds("--perspective", 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 + gap / efl, gap, 0, 0, 1 / efl, 1)
    last, other = paraxial(DOUBLE_GAUSS)[-1], paraxial(DOUBLE_GAUSS, 0.0, 1.0)[-1]
    page.holds("matrix double-gauss -w d --csv", 1, 0, -0.67 / 58.95, 1, 1, 7.52 / 1.67, 0, 1,
               last[0], other[0], last[2], other[2])


def check_photography(page):
    page.holds("fov -f 14", *(value for f in (14, 20, 24, 28, 35, 43.2666, 85, 200)
                              for value in (f, 2 * math.degrees(math.atan(DIAGONAL / 2 / f)))))
    f, N, s, c = 50.0, 8.0, 3000.0, 0.03
    m = f / (s - f)
    near, far = (s * f * f / (f * f + sign * N * c * (s - f)) for sign in (1, -1))
    for limit in (near, far):
        blur = f / N * m * abs(limit - s) / limit
        page.checks.check(abs(blur - c) < 1e-12, f"the blur at {limit} mm is {blur} mm")
    page.holds("blur_at_infinity", near / 1000, far / 1000, m, f * m / N)
    images = [f * x / (x - f) for x in (near, s, far)]
    page.holds("image_near", *images, 2 * N * c * (1 + m))
    page.holds("near_diopter", *(1000 * (1 / s + sign * N * c * (1 - f / s) / f ** 2)
                                 for sign in (1, -1)))
    hyperfocal = f * f / (N * c) + f
    page.holds("hyperfocal -f 50mm", hyperfocal / 1000, hyperfocal / 2000)
    page.holds("hyperfocal -f 25,50,100", *(value for f in (25, 50, 100) for value in (
        f, *((f * f / (N * c) + f) / 1000 for N in (4, 8)))))
    radius = FIRST_ZERO * 64 * 0.5
    page.holds("airy_radius", radius, 2 * radius, 11.6, 1000 / (FIRST_ZERO * 0.5 * 50),
               11.6 / (FIRST_ZERO * 0.5))
    page.holds("list stops", *(value for pair in zip(LABELS, STOPS) for value in pair))
    page.holds("exposure -N 16", *(value for k in range(2, 9) for value in (
        STOPS[k], 2.0 ** (k - 11), TIMES[16 - k])))
    page.holds("motion", *(value for t in (8, 125, 500) for value in (
        1 / t, 1e6 * 5 / 3.6 / t * 50 / 9950)))
    page.holds("bracket", *numbered((30 / 2 ** k, TIMES[k]) for k in range(16)))


def main():
    checks = Checks()
    page = Page(checks, os.path.join(ROOT, "man", "lenscalc-lecture.7"))
    check_rays(page)
    check_thick(page)
    check_photography(page)
    lens = lens_of("double-gauss-50")
    page.holds("tail -c 8 sky.pfm", 1000 * irradiance_on_axis(lens, first_order(lens)[1]))
    page.holds("--model no-f", 50 * 50 / (8 * 0.03) / 1000, (50 * 50 / (8 * 0.03) + 50) / 1000)
    efl, bfl, _ = first_order(DOUBLE_GAUSS)
    stop = paraxial(DOUBLE_GAUSS)[5][0]  # of a ray at the height 1
    page.holds("efl,bfl,fnumber", efl, bfl, efl * stop / 34.2)
    page.finish()
    return checks.finish()


if __name__ == "__main__":
    sys.exit(main())
