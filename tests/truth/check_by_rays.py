#!/usr/bin/env python3
"""tests/truth/check_by_rays.py - what photographic commands say by rays: check_by_rays.py BUILD_DIR

Ideal thick lenses have closed forms: near and far by similar triangles from the entrance pupil.
Real lenses are traced anew here, by the sphere's equation and Snell's law in vectors (cross of
check_fov.py): rays of equal areas of the stop, the film where their mean square is smallest, limits
by bisection, light by the widest ray that reaches the middle of the film, losses by Fresnel's
formulas.
"""
# SPDX-License-Identifier: MIT

import json
import math
import os
import re
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program
from integrals import gauss
from check_fov import cross, paraxial, read

C = math.hypot(36, 24) / 1500
REAL = (("double-gauss", 4, 2000), ("double-gauss", 8, 2000), ("double-gauss", 8, 300),
        ("cs348b-dgauss-50", 2.8, 1500), ("wide-35", 4, 1000), ("telephoto-200", 5.6, 20000))


RULE = gauss(20)


def row(checks, program, words):
    result = program.run(*words.split(), "--json")
    if not checks.check(result.returncode == 0, f"{words}: {result.stderr.decode()}"):
        return None
    return json.loads(result.stdout)["rows"][0]


def near(checks, words, name, said, true, tolerance):
    words = re.sub(r"/\S*/", "", words)  # of files
    checks.against_relative("by-rays", words, name, said, true, tolerance)


# -------- ideal lenses --------

def check_ideal(checks, program, folder, before, diameter, s):
    """A lens of 80 mm, H to H' 5 mm, its stop so far before it; all about the entrance pupil."""
    f = 80.0
    path = os.path.join(folder, "ideal.lens")
    with open(path, "w") as file:
        file.write(f"object inf\naperture f/{f / diameter!r}\nstop - {before!r} air -\nthick {f!r} 5 air -\n")
    words = f"dof --lens {path} -s {s!r}mm --exact"
    said = row(checks, program, words)
    m, X = f / (s - f), s - before
    e = C / (m * diameter)
    near(checks, words, "near", said["near_m"], (X / (1 + e) + before) / 1000, 1e-9)
    if e < 1:
        near(checks, words, "far", said["far_m"], (X / (1 - e) + before) / 1000, 1e-9)
    near(checks, words, "hyperfocal", said["hyperfocal_m"], (f * diameter / C + f) / 1000, 1e-9)
    near(checks, words, "blur", said["blur_at_infinity_mm"], m * diameter, 1e-9)
    near(checks, words, "image", said["image_mm"], f * (1 + m), 1e-12)
    checks.check(abs(said["least_blur_um"]) < 1e-9, f"{words}: an ideal lens blurs {said['least_blur_um']} um")
    # behind the lens the cone stands on the exit pupil, f/(f - before) as wide
    exit, place = diameter * f / (f - before), -before * f / (f - before)
    depth = 2 * C * (f * (1 + m) - place) / exit
    near(checks, words, "depth of focus", said["depth_of_focus_mm"], depth, 1e-9)
    # a disc is a disc by every rule; contrast comes back beyond its first zeros, sharpness does not
    for rule, tolerance, zero in (("energy80", 2e-3, math.inf), ("mtf@20/mm", 1e-5, 1.2197 / 20),
                                  ("mtf@40/mm", 1e-5, 1.2197 / 40)):
        words = f"dof --lens {path} -s {s!r}mm --exact --criterion {rule}"
        said = row(checks, program, words)
        near(checks, words, "near", said["near_m"], (X / (1 + e) + before) / 1000, tolerance)
        far = (X / (1 - e) + before) / 1000 if e < 1 else None
        checks.check((said["far_m"] is None) == (far is None), f"{words}: far is {said['far_m']}")
        if far and said["far_m"]:
            near(checks, words, "far", said["far_m"], far, tolerance / (1 - e))
        blur = said["blur_at_infinity_mm"]
        # a disc has no contrast at 3.8317/(pi f); rules of contrast measure none that is larger
        checks.check(m * diameter > zero if blur is None else abs(blur / (m * diameter) - 1) <= 2e-3,
                     f"{words}: infinity is blurred by {blur} mm")
    words = f"fov --lens {path} -s {s!r}mm --exact"
    said = row(checks, program, words)
    angle = 2 * math.atan(math.hypot(18, 12) / (f * (1 + m) - place) * f / (f - before))
    near(checks, words, "diagonal", math.radians(said["diagonal_deg"]), angle, 1e-9)
    far = 2 * math.atan(math.hypot(18, 12) / (f - place) * f / (f - before))
    near(checks, words, "breathing", said["breathing_percent"] / 100, angle / far - 1, 1e-8)
    words = f"hyperfocal --lens {path} --exact"
    said = row(checks, program, words)
    H = f * diameter / C + f
    near(checks, words, "hyperfocal", said["hyperfocal_m"], H / 1000, 1e-9)
    near(checks, words, "near", said["near_m"], ((H - before) / 2 + before) / 1000, 1e-8)


# -------- real lenses --------

def through(surfaces, point, way, stop=None):
    """A ray to the plane of the stop and to behind the last surface: y there, place and way."""
    index, at_stop = 1.0, None
    for i, (curvature, thickness, after) in enumerate(surfaces):
        if i == stop:
            at_stop = point[1] - point[0] * way[1] / way[0]
        point, way = cross(curvature, index, after, point, way)
        index = after
        if i + 1 < len(surfaces):
            point = (point[0] - thickness, point[1])
    return at_stop, point, way


def ray_to(surfaces, stop, distance, height):
    """The line behind the lens of the ray from the axis to this height in the stop: y, slope."""
    def trace(y):
        if math.isinf(distance):
            return through(surfaces, (0.0, y), (1.0, 0.0), stop)
        norm = math.hypot(distance, y)
        return through(surfaces, (0.0, y), (distance / norm, y / norm), stop)
    a, b = 0.0, height
    fa, fb = -height, trace(b)[0] - height
    for _ in range(60):
        if fb == fa or abs(fb) < 1e-15:
            break
        a, b, fa = b, b - fb * (b - a) / (fb - fa), fb
        fb = trace(b)[0] - height
    _, (z, y), (n, m) = trace(b)
    return y - z * m / n, m / n


class Point:
    """The rays of a point on the axis."""

    def __init__(self, lens, distance):
        self.rays = [ray_to(lens.surfaces, lens.stop, distance, lens.radius * math.sqrt(t))
                     for t, _ in RULE]
        self.weights = [w for _, w in RULE]
        a = sum(w * y * u for w, (y, u) in zip(self.weights, self.rays))
        b = sum(w * u * u for w, (_, u) in zip(self.weights, self.rays))
        self.film = -a / b

    def blur(self, film):
        square = sum(w * (y + film * u) ** 2 for w, (y, u) in zip(self.weights, self.rays))
        return math.sqrt(8 * square)


class Lens:
    def __init__(self, name, N):
        self.surfaces, self.stop = read(name)
        self.f, self.front, self.rear = paraxial(self.surfaces)
        y, v, n = self.f / (2 * N), 0.0, 1.0
        for i, (curvature, thickness, after) in enumerate(self.surfaces[:self.stop]):
            v -= y * (after - n) * curvature
            n = after
            y += thickness / n * v
        self.radius = y

    def point(self, s):
        return Point(self, s - self.front if math.isfinite(s) else s)


def bisect(value, low, high):
    """The root of a function that changes its sign."""
    rising = value(high) > 0
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (low, middle) if (value(middle) > 0) == rising else (middle, high)
    return (low + high) / 2


def check_real(checks, program, name, N, s):
    lens = Lens(name, N)
    film = lens.point(s).film
    words = f"dof --lens {name} -w d -N {N} -s {s}mm --exact"
    said = row(checks, program, words)
    if said is None:
        return
    near(checks, words, "image", said["image_mm"], film - lens.rear, 1e-10)
    near(checks, words, "blur", said["least_blur_um"], 1000 * lens.point(s).blur(film), 1e-7)

    def excess(v):
        return lens.point(1 / v).blur(film) - C
    v = 1 / s
    near(checks, words, "near", said["near_m"], 1e-3 / bisect(excess, v, 3 * v), 1e-8)
    if said["far_m"] is not None:
        near(checks, words, "far", said["far_m"], 1e-3 / bisect(excess, v, 1e-9), 1e-8)
    far = lens.point(math.inf)
    plane = bisect(lambda z: far.blur(z) - C, far.film, far.film + 5)
    H = 1 / bisect(lambda v: lens.point(1 / v).film - plane, 1e-7, 1 / (4 * lens.f))
    near(checks, words, "hyperfocal", said["hyperfocal_m"], H / 1000, 1e-7)
    words = f"focus --lens {name} -w d -N {N} -s {s}mm --exact"
    said = row(checks, program, words)
    near(checks, words, "image", said["image_mm"], film - lens.rear, 1e-10)
    near(checks, words, "extension", said["extension_mm"], film - far.film, 1e-8)
    total = s + 3 * lens.f
    words = f"focus --lens {name} -w d -N {N} -s {total}mm --from sensor --exact --columns sensor_distance_m,principal_distance_m"
    said = row(checks, program, words)
    near(checks, words, "sensor", said["sensor_distance_m"], total / 1000, 1e-12)
    there = 1000 * said["principal_distance_m"]
    length = sum(t for _, t, _ in lens.surfaces[:-1])
    true = there - lens.front + length + lens.point(there).film
    near(checks, words, "subject to film", total, true, 1e-10)


def check_light(checks, program, name, N):
    """From the middle of the film backwards to the edge of the stop."""
    lens = Lens(name, N)
    film = lens.point(math.inf).film
    back = [(-c, lens.surfaces[i - 1][1] if i else 0.0, lens.surfaces[i - 1][2] if i else 1.0)
            for i, (c, _, _) in reversed(list(enumerate(lens.surfaces)))]
    stop = len(back) - 1 - lens.stop

    def trace(sine):
        """Height in the stop, and what faces let pass."""
        way = (math.sqrt(1 - sine * sine), sine)
        point, index, height, across, along = (-film, 0.0), 1.0, None, 1.0, 1.0
        for i, (curvature, thickness, after) in enumerate(back):
            if i == stop:
                height = point[1] - point[0] * way[1] / way[0]
            point, new = cross(curvature, index, after, point, way)
            normal = (1 - curvature * point[0], -curvature * point[1])
            a = sum(p * q for p, q in zip(way, normal))
            b = sum(p * q for p, q in zip(new, normal))
            across *= 1 - ((index * a - after * b) / (index * a + after * b)) ** 2
            along *= 1 - ((after * a - index * b) / (after * a + index * b)) ** 2
            way, index = new, after
            point = (point[0] - thickness, point[1])
        return height, (across + along) / 2
    sine = bisect(lambda x: abs(trace(x)[0]) - lens.radius, 0.01 / N, 0.6 / N)
    passed = sum(w * trace(sine * math.sqrt(t))[1] for t, w in RULE)
    words = f"exposure --lens {name} -w d -N {N} -t 1/60 --exact"
    near(checks, words, "T-stop", row(checks, program, words)["t_stop"], 1 / (2 * sine), 1e-9)
    words += " --fresnel"
    true = 1 / (2 * sine * math.sqrt(passed))
    near(checks, words, "T-stop", row(checks, program, words)["t_stop"], true, 1e-9)


def main():
    checks, program = Checks(), Program(sys.argv[1])
    with tempfile.TemporaryDirectory(prefix="lenscalc-test-") as folder:
        for before in (0.0, 12.0, -30.0):
            for s in (240.0, 3000.0, 60000.0):
                check_ideal(checks, program, folder, before, 20.0, s)
    for name, N, s in REAL:
        check_real(checks, program, name, N, s)
        check_light(checks, program, name, N)
    checks.finish()


if __name__ == "__main__":
    main()
