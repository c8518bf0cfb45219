"""tests/truth/meridional.py - rays in a plane with the axis through spheres, by Snell's law.

A lens is a list of surfaces (radius, inf = plane; distance to the next; index behind; clear
diameter; is it the stop), in air, read from the tables of lensdb or typed in.
"""
# SPDX-License-Identifier: MIT

import math
import os

from harness import ROOT

# W. Smith, Modern Lens Design, p. 312, as the lecture's slide has it: radius, thickness, index,
# clear diameter
SLIDE = [(58.950, 7.520, 1.670, 50.4), (169.660, 0.240, 1.0, 50.4), (38.550, 8.050, 1.670, 46.0),
         (81.540, 6.550, 1.699, 46.0), (25.500, 11.410, 1.0, 36.0), (math.inf, 9.000, 1.0, 34.2),
         (-28.990, 2.360, 1.603, 34.0), (81.540, 12.130, 1.658, 40.0), (-40.770, 0.380, 1.0, 40.0),
         (874.130, 6.440, 1.717, 40.0), (-79.460, 72.228, 1.0, 40.0)]
DOUBLE_GAUSS = [(*row, math.isinf(row[0])) for row in SLIDE]

# Gauss-Legendre on 0..1, 8 points: 15 degrees of a polynomial in r^2
HALF = [(0.1834346424956498, 0.3626837833783620), (0.5255324099163290, 0.3137066458778873),
        (0.7966664774136267, 0.2223810344533745), (0.9602898564975363, 0.1012285362903763)]
GAUSS = [(0.5 + s * x / 2, w / 2) for x, w in HALF for s in (1, -1)]


def lens_of(name):
    """Of lensdb, at its d line."""
    surfaces = []
    with open(os.path.join(ROOT, "lensdb", "lenses", f"{name}.lens"), encoding="utf-8") as file:
        for words in (line.split() for line in file):
            if words and words[0] in ("surface", "stop"):
                radius, thickness, medium, diameter = words[1:5]
                surfaces.append((math.inf if radius == "-" else float(radius), float(thickness),
                                 1.0 if medium == "air" else float(medium.split("/")[0]),
                                 float(diameter), words[0] == "stop"))
    return surfaces


def paraxial(lens, y=1.0, v=0.0):
    """(y, v) before and after each surface, v = n u."""
    rows, n = [], 1.0
    for radius, thickness, behind, _, _ in lens:
        after = v - y * (behind - n) / radius
        rows.append((y, v, after))
        y, v, n = y + thickness * after / behind, after, behind
    return rows


def first_order(lens):
    """(efl, back focal length, front focal point from the first vertex)."""
    y, _, v = paraxial(lens)[-1]
    back = paraxial(reverse(lens))[-1]
    return -1 / v, -y / v, back[0] / back[2]


def reverse(lens):
    """The same lens, the other way round; its first surface sees the air behind it."""
    count = len(lens)
    return [(-lens[i][0], lens[i - 1][1] if i > 0 else 0.0, lens[i - 1][2] if i > 0 else 1.0,
             *lens[i][3:]) for i in range(count - 1, -1, -1)]


def trace(lens, y, angle, start=0.0):
    """A ray from the height y at `start` before the first vertex: (height there, angles of
    incidence and refraction in rad, optical path up to there) at each surface, its slope angle
    behind and the sag of the last point. Of a ray that meets all surfaces."""
    rows, z, n, path = [], -start, 1.0, 0.0
    for radius, thickness, behind, _, _ in lens:
        before = z
        if math.isinf(radius):
            y, z, normal = y - z * math.tan(angle), 0.0, 0.0
        else:
            # the distance of the centre from the ray is R sin I
            incidence = math.asin(((radius - z) * math.sin(angle) + y * math.cos(angle)) / radius)
            normal = incidence - angle
            y, z = radius * math.sin(normal), radius * (1 - math.cos(normal))
        incidence = angle + normal
        refraction = math.asin(n * math.sin(incidence) / behind)
        path += n * (z - before) / math.cos(angle)
        rows.append((y, incidence, refraction, path))
        angle, n, z = refraction - normal, behind, z - thickness
    return rows, angle, z + lens[-1][1]


def at_image(lens, y, image):
    """Height in a plane `image` behind the last vertex of a ray that comes parallel to the axis."""
    rows, angle, sag = trace(lens, y, 0.0)
    return rows[-1][0] + (image - sag) * math.tan(angle)


def solve(function, low, high):
    """Where an increasing function is 0."""
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if function(middle) < 0 else (low, middle)
    return (low + high) / 2


def tightness(lens, y, angle, start=0.0):
    """The largest share of a clear radius that a ray takes; more than 1: it does not get there."""
    try:
        return max(row[0] / (surface[3] / 2)
                   for row, surface in zip(trace(lens, y, angle, start)[0], lens))
    except ValueError:
        return math.inf


def stop_of(lens):
    return next(i for i, surface in enumerate(lens) if surface[4])


def through_stop(lens, radius=None):
    """[(height before the lens, weight)] of rays parallel to the axis, which stand for equal areas
    of the stop up to a radius there; without one up to where clear diameters end the beam."""
    stop = stop_of(lens)

    def at_stop(y):
        return trace(lens[:stop + 1], y, 0.0)[0][stop][0]

    edge = 0.6 * lens[0][3]
    if radius is None:
        edge = solve(lambda y: tightness(lens, y, 0.0) - 1, 0.0, edge)
        radius = at_stop(edge)
    return [(solve(lambda y, q=q: at_stop(y) - math.sqrt(q) * radius, 0.0, edge), w)
            for q, w in GAUSS]


def rms_on_axis(lens, image, rays):
    """Of a distant point: rays as (height before the lens, weight), of the weights' sum 1."""
    return math.sqrt(sum(w * at_image(lens, y, image) ** 2 for y, w in rays))


def irradiance_on_axis(lens, image):
    """E/L = pi sin^2 of the steepest ray from the axial point of the film that passes."""
    back = reverse(lens)
    steepest = solve(lambda u: tightness(back, 0.0, u, image) - 1, 0.0,
                     math.atan(back[0][3] / 2 / image))
    return math.pi * math.sin(steepest) ** 2
