#!/usr/bin/env python3
"""tests/truth/check_course.py - four lenses as render sees through them: check_course.py BUILD_DIR

A sky of one luminance gives the irradiance over the film that an independent program's quadrature
has, of a double Gauss, wide open and at f/8, a wide-angle, a telephoto lens and a fisheye; and far
lamps lie where another program's chief rays meet the film, whatever way they lie from the axis.
"""
# SPDX-License-Identifier: MIT

import math
import os
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program
from photographs import Studio, centroid

SKY = "camera at=0,1,0 look=0,2,0 up=0,0,-1\nlight sky uniform luminance=1000\n"
# of each lens: its film, mm; {radius, mm: E/L to about 1e-4}; {angle, deg: height of the chief ray,
# mm}
LENSES = {
    "cs348b-dgauss-50": (36.105905, {0: .192512, 5: .167216, 10: .125716, 15: .082428, 18: .057826,
                                     20: .042577, 21.633: .031036},
                         {5: 4.403447, 10: 8.859872, 15: 13.420694, 20: 18.131997, 22: 20.066464}),
    "cs348b-wide-22": (14.318263, {0: .101025, 5: .086408, 10: .062632, 13.5: .045164,
                                   17: .029989},
                       {10: 3.877559, 20: 7.970849, 30: 12.579561, 38: 17.020002}),
    "cs348b-telephoto-250": (105.070394, {0: .025110, 10: .024934, 20: .024410, 21.633: .024148},
                             {1: 4.357002, 2: 8.721482, 4: 17.503348, 5: 21.936563}),
    "cs348b-fisheye-10": (23.160539, {0: .049239, 4: .041914, 8: .027329, 12: .012785},
                          {10: 1.744306, 20: 3.491381, 40: 7.002125, 60: 10.528418,
                           70: 12.272904}),
}
STOPPED = {0: .011921, 10: .011215, 20: .009499, 21.633: .009179}  # of the first, by a quarter
OWN = 2.030153  # its f-number
COLUMNS, PITCH = 111, 0.4  # pixels of a strip through the middle of the film, mm
FINE, SIDE = 0.01, 32  # mm, pixels of a picture of one lamp


def check_light(studio, lens, film, expected, *words):
    """Of seven seeds, along a strip of pixels."""
    rows = studio.seeds(7, SKY, "--lens", lens, "--focus", str(film), "-w", "d", "-t", "0.01",
                        "--sensor", f"{COLUMNS * PITCH}x{PITCH}mm", "--size", f"{COLUMNS}x1",
                        "--samples", "256", "--bounces", "0", "--no-skip", "uniform", *words)
    for radius, value in expected.items() if rows is not None else ():
        at = radius / PITCH + COLUMNS / 2 - 0.5
        left = int(at)
        found = [((1 - at + left) * (row[0][left][1] + row[0][-1 - left][1]) +
                  (at - left) * (row[0][left + 1][1] + row[0][-2 - left][1])) / 20 for row in rows]
        studio.unbiased(found, value, f"{lens}: E/L at {radius} mm", known=3e-4)


def check_places(studio, lens, film, heights):
    """Lamps 1 km away, through a small stop, at other azimuths."""
    for angle, height in heights.items():
        azimuth = math.radians(37 * angle)
        t = math.radians(angle)
        way = (math.sin(t) * math.cos(azimuth), math.sin(t) * math.sin(azimuth), -math.cos(t))
        # as large as some 10 pixels
        scene = "camera at=0,0,0 look=0,0,-1\nmaterial lamp black luminance=1000\n" \
            "sphere material=lamp at=" + ",".join(f"{1000 * a:.12g}" for a in way) + \
            f" radius={1000 * t * 0.05 / height:.6g}\n"
        count = 2 * round(height / FINE + 20)
        place = height * math.cos(azimuth), height * math.sin(azimuth)
        corner = [round(count / 2 + s * a / FINE) - SIDE // 2 for s, a in zip((1, -1), place)]
        rows = studio.take(scene, "--lens", lens, "--focus", str(film), "-N", "45",
                           "-w", "d", "-t", "1", "--sensor", f"{count * FINE}x{count * FINE}mm",
                           "--size", f"{count}x{count}", "--samples", "32", "--bounces", "0",
                           "--crop", f"{corner[0]}:{corner[1]}:{SIDE}x{SIDE}")
        if rows is None or not studio.checks.check(max(p[1] for row in rows for p in row) > 0,
                                                   f"{lens}: no lamp where {angle} deg lies"):
            continue
        x, y = centroid(rows, FINE)
        x += (corner[0] + SIDE / 2 - count / 2) * FINE
        y -= (corner[1] + SIDE / 2 - count / 2) * FINE
        studio.checks.check(math.hypot(x - place[0], y - place[1]) < 0.15 * FINE,
                            f"{lens}: a lamp at {angle} deg lies at {x:.5f} {y:.5f} mm, its chief "
                            f"ray at {place[0]:.5f} {place[1]:.5f}")


def main():
    program, checks = Program(sys.argv[1]), Checks()
    with tempfile.TemporaryDirectory(prefix="lenscalc-course-") as folder:
        studio = Studio(program, checks, folder)
        for lens, (film, light, heights) in LENSES.items():
            check_light(studio, lens, film, light)
            check_places(studio, lens, film, heights)
        check_light(studio, "cs348b-dgauss-50", 36.105905, STOPPED, "-N", str(4 * OWN))
    return checks.finish()


if __name__ == "__main__":
    sys.exit(main())
