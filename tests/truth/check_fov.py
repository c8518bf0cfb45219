#!/usr/bin/env python3
"""tests/truth/check_fov.py - angles of view of real lenses by rays traced here: check_fov.py BUILD_DIR

Rays start in the centre of the stop and are traced both ways, by the sphere's equation and Snell's
law in vectors: to the sensor, where they have an image height, and to the subject, where they have
a field angle. The start angle is bisected for the height of half the sensor. The program has to say
the same angle, and the same width in the plane of focus.
"""
# SPDX-License-Identifier: MIT

import json
import math
import os
import subprocess
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import ROOT, Checks, Program

# spherical lenses of lensdb whose media are numbers at the d line
NAMES = ("fisheye-16", "cs348b-dgauss-50", "cs348b-wide-22", "cs348b-telephoto-250",
         "cs348b-fisheye-10", "double-gauss", "wide-35", "telephoto-200")
SENSORS = {"fisheye-16": (35, 24), "cs348b-fisheye-10": (16, 12)}


def read(name):
    """(curvature, thickness, index behind) of each surface, and which is the stop."""
    surfaces, stop = [], None
    with open(os.path.join(ROOT, "lensdb", "lenses", name + ".lens")) as file:
        for line in file:
            words = line.split("#")[0].split()
            if words and words[0] in ("surface", "stop"):
                if words[0] == "stop":
                    stop = len(surfaces)
                index = 1.0 if words[3] == "air" else float(words[3].split("/")[0])
                curvature = 0.0 if words[1] == "-" else 1 / float(words[1])
                surfaces.append((curvature, 0.0 if words[2] == "-" else float(words[2]), index))
    return surfaces, stop


def cross(curvature, before, after, point, way):
    """A ray in the frame of a vertex, z along the light, to the surface and through it."""
    z, y = point
    n, m = way
    # to the vertex plane, then c (y^2 + z^2) = 2 z along the ray
    y, z = y - z * m / n, 0.0
    b = n - curvature * y * m
    root = b * b - curvature * (curvature * y * y)
    if root < 0:
        return None
    t = curvature * y * y / (b + math.sqrt(root))
    z, y = t * n, y + t * m
    normal = (1 - curvature * z, -curvature * y)
    cosine = n * normal[0] + m * normal[1]
    ratio = before / after
    inside = 1 - ratio * ratio * (1 - cosine * cosine)
    if inside < 0 or cosine < 0:
        return None
    g = math.sqrt(inside) - ratio * cosine
    return (z, y), (ratio * n + g * normal[0], ratio * m + g * normal[1])


def forward(surfaces, stop, slope):
    """From the centre of the stop: y at the last vertex plane and direction."""
    point, way = (0.0, 0.0), (math.cos(slope), math.sin(slope))
    for i in range(stop + 1, len(surfaces)):
        point = (point[0] - surfaces[i - 1][1], point[1])
        crossed = cross(surfaces[i][0], surfaces[i - 1][2], surfaces[i][2], point, way)
        if crossed is None:
            return None
        point, way = crossed
    return point, way


def backward(surfaces, stop, slope):
    """The same ray to the subject, z counted against the light from the first vertex."""
    point, way = (0.0, 0.0), (math.cos(slope), -math.sin(slope))
    for i in range(stop - 1, -1, -1):
        point = (point[0] - surfaces[i][1], point[1])
        before = surfaces[i][2]
        after = surfaces[i - 1][2] if i > 0 else 1.0
        crossed = cross(-surfaces[i][0], before, after, point, way)
        if crossed is None:
            return None
        point, way = crossed
    return point, way


def paraxial(surfaces):
    """Focal length; H from the first, H' from the last vertex."""
    def trace(rows, y, v, n):
        for i, (curvature, thickness, after) in enumerate(rows):
            v -= y * (after - n) * curvature
            n = after
            if i + 1 < len(rows):
                y += thickness / n * v
        return y, v
    y, v = trace(surfaces, 1.0, 0.0, 1.0)
    f = -1 / v
    back = [(-c, surfaces[i - 1][1] if i else 0.0, surfaces[i - 1][2] if i else 1.0)
            for i, (c, _, _) in reversed(list(enumerate(surfaces)))]
    z, w = trace(back, 1.0, 0.0, surfaces[-1][2])
    return f, f + z / w, -y / v - f


def view(surfaces, stop, film, half):
    """Angle, and start, of the chief ray that lands `half` from the axis."""
    def height(slope):
        ray = forward(surfaces, stop, slope)
        if ray is None:
            return math.inf
        (z, y), (n, m) = ray
        return y + (film - z) * m / n
    low, high = 0.0, 1.5
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if height(middle) < half else (low, middle)
    return backward(surfaces, stop, low)


def check_lens(checks, program, name, distance):
    surfaces, stop = read(name)
    f, front, rear = paraxial(surfaces)
    film = rear + (f if math.isinf(distance) else f * distance / (distance - f))
    width, height = SENSORS.get(name, (36, 24))
    words = ["fov", "--lens", name, "--sensor", f"{width}x{height}mm", "-s", f"{distance}mm",
             "--json"]
    result = subprocess.run([*program, *words], capture_output=True, text=True)
    what = " ".join(words)
    if not checks.check(result.returncode == 0, f"{what}: {result.stderr}"):
        return
    answer = json.loads(result.stdout)
    checks.check(answer["assumptions"]["projection"] == "chief-rays",
                 f"{what}: angles by {answer['assumptions']['projection']}")
    row = answer["rows"][0]
    for key, length in (("horizontal", width), ("vertical", height),
                        ("diagonal", math.hypot(width, height))):
        (z, y), (n, m) = view(surfaces, stop, film, length / 2)
        angle = 2 * math.degrees(math.atan2(-m, n))
        said = row[key + "_deg"]
        checks.against("by-rays", what, key, said, angle, 1e-9 * angle, "deg")
        field = {"horizontal": "field_width", "vertical": "field_height"}.get(key)
        if field and not math.isinf(distance):
            # the plane lies `distance` before H; z grows towards the subject
            wide = -2 * (y + (distance - front - z) * m / n) / 1000
            said = row[field + "_m"]
            checks.against("by-rays", what, field, said, wide, 1e-9 * wide, "m")


def main():
    checks = Checks()
    program = [Program(sys.argv[1]).binary]
    for name in NAMES:
        for distance in (math.inf, 800.0):
            check_lens(checks, program, name, distance)
    checks.finish()


if __name__ == "__main__":
    main()
