"""tests/singlet.py - one lens behind its stop, and exact rays through it, for pictures of it.

Only the standard library. Light goes to +z, the stop lies at z = 0; mm and nm.
"""
# SPDX-License-Identifier: MIT

import math

LINES = {"F": 486.1327, "d": 587.5618, "C": 656.2725}


class Singlet:
    """Two spheres of a glass (nd, Vd), `gap` behind a stop of `diameter`."""

    def __init__(self, radii, thickness, glass, gap, diameter):
        self.radii, self.thickness, self.glass = radii, thickness, glass
        self.gap, self.diameter = gap, diameter

    def write(self, path):
        (first, second), (nd, vd) = self.radii, self.glass
        with open(path, "w", encoding="utf-8") as file:
            file.write("lens singlet behind its stop\naperture stop\n"
                       f"stop - {self.gap} air {self.diameter}\n"
                       f"surface {first} {self.thickness} {nd}/{vd} 60\n"
                       f"surface {second} 100 air 60\n")

    def index(self, nm):
        """A + B/l^2 through nd, with n(F) - n(C) = (nd - 1)/Vd."""
        nd, vd = self.glass
        b = (nd - 1) / vd / (LINES["F"] ** -2 - LINES["C"] ** -2)
        return nd + b * (nm ** -2 - LINES["d"] ** -2)

    def last(self):
        return self.gap + self.thickness

    def trace(self, point, direction, nm, plane):
        """Where a ray meets a plane, by Snell's law in vectors; backwards where it goes to -z."""
        surfaces = [(self.gap, self.radii[0]), (self.last(), self.radii[1])]
        n = [1, self.index(nm), 1]
        if direction[2] < 0:
            surfaces.reverse()
        p, d = list(point), list(direction)
        for (vertex, radius), before, after in zip(surfaces, n, n[1:]):
            q = [p[0], p[1], p[2] - vertex - radius]  # from the centre of the sphere
            half = sum(a * b for a, b in zip(q, d))
            root = math.sqrt(half * half - sum(a * a for a in q) + radius * radius)
            # the crossing nearer to the vertex, which lies at -radius from the centre
            along = -half - root if radius * d[2] > 0 else -half + root
            p = [a + along * b for a, b in zip(p, d)]
            normal = [(p[0]) / radius, (p[1]) / radius, (p[2] - vertex - radius) / radius]
            cosine = sum(a * b for a, b in zip(normal, d))
            if cosine < 0:
                normal, cosine = [-a for a in normal], -cosine
            ratio = before / after
            inside = math.sqrt(1 - ratio * ratio * (1 - cosine * cosine))
            d = [ratio * a + (inside - ratio * cosine) * b for a, b in zip(d, normal)]
        along = (plane - p[2]) / d[2]
        return p[0] + along * d[0], p[1] + along * d[1], d

    def forward(self, card, aim, nm, film, distance):
        """From (x, y) of a card `distance` before the stop through (x, y) of the stop to the film."""
        way = (aim[0] - card[0], aim[1] - card[1], distance)
        length = math.sqrt(sum(a * a for a in way))
        return self.trace((*card, -distance), [a / length for a in way], nm, self.last() + film)

    def paraxial(self, distance, nm=LINES["d"]):
        """The image of the card behind the last vertex, and the focal length."""
        n, (first, second) = self.index(nm), self.radii
        powers = (n - 1) / first, (1 - n) / second

        def image(y, u):
            u = (u - y * powers[0]) / n
            y += self.thickness * u
            return y, n * u - y * powers[1]
        y, u = image(distance + self.gap, 1.0)
        return -y / u, -1 / image(1.0, 0.0)[1]
