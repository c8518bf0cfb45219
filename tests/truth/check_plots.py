#!/usr/bin/env python3
"""tests/truth/check_plots.py - curves of swept plots against closed forms: check_plots.py BUILD_DIR

The axes are read from the dots of the samples, whose values are known; curves, arrows and areas are
parsed from the SVG. A thin lens is sharp to infinity from s = H = f^2/(N c) + f on, where its far
limit has its asymptote; its magnification is f/(s - f), its image through focus has a pole at s = f.
"""
# SPDX-License-Identifier: MIT

import math
import os
import re
import sys
import tempfile
import xml.etree.ElementTree as tree

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program

SVG = "{http://www.w3.org/2000/svg}"
C = math.hypot(36, 24) / 1500  # mm
F = 50
PIXEL = 0.02  # coordinates have two decimals, and the axes are read from such
SEEN = 0.4  # px that a curve may be off


def hyperfocal(f, N, c=C):
    return f * f / (N * c) + f


def near(s, f, N, c=C):
    m = f / (s - f)
    return f * (1 + m) / (m + N * c / f)


def far(s, f, N, c=C):
    m, e = f / (s - f), N * c / f
    return f * (1 + m) / (m - e) if m > e else math.inf


def paths_of(element):
    """The broken lines of a path, lists of points in px."""
    lines = []
    for part in re.findall(r"M([^M]*)", element.get("d")):
        numbers = [float(n) for n in re.findall(r"-?\d*\.?\d+", part)]
        lines.append(list(zip(numbers[::2], numbers[1::2])))
    return lines


def tint(colour):
    """What an area is filled with between curves of this colour: 14 % of it on white."""
    parts = [int(colour[i:i + 2], 16) for i in (1, 3, 5)]
    return "#" + "".join(f"{math.floor(255.5 - 0.14 * (255 - part)):02x}" for part in parts)


class Picture:
    """Curves by stroke, areas by fill, arrows by x, dots by fill in the order of their samples."""

    def __init__(self, text):
        self.curves, self.areas, self.dots, self.arrows = {}, {}, {}, []
        for group in tree.fromstring(text).iter(f"{SVG}g"):
            fill, stroke = group.get("fill"), group.get("stroke")
            for path in group.findall(f"{SVG}path"):
                moved = re.match(r"translate\(([\d.]+)", path.get("transform") or "")
                if moved:
                    self.arrows.append(float(moved[1]))
                elif fill == "none":
                    self.curves.setdefault(stroke, []).append(paths_of(path))
                elif path.get("d").endswith("z"):
                    self.areas.setdefault(fill, []).extend(paths_of(path))
            for circle in group.findall(f"{SVG}circle"):
                self.dots.setdefault(fill, []).append(
                    (float(circle.get("cx")), float(circle.get("cy"))))
        clip = next(tree.fromstring(text).iter(f"{SVG}clipPath"))[0]
        self.top = float(clip.get("y")) + 1
        self.bottom = self.top + float(clip.get("height")) - 2


class Axis:
    """From values to px by two that are known."""

    def __init__(self, first, second, log=False):
        self.scale = math.log if log else (lambda v: v)
        (v, p), (w, q) = first, second
        self.slope = (q - p) / (self.scale(w) - self.scale(v))
        self.base = p - self.slope * self.scale(v)

    def page(self, value):
        return self.base + self.slope * self.scale(value)

    def value(self, page):
        v = (page - self.base) / self.slope
        return math.exp(v) if self.scale is math.log else v


def plot(program, words):
    with tempfile.TemporaryDirectory(prefix="lenscalc-plot-") as folder:
        path = os.path.join(folder, "plot.svg")
        result = program.run(*words.split(), "--plot", path)
        if result.returncode not in (0, 3):
            return result.stderr.decode()
        with open(path) as file:
            return Picture(file.read())


def height_at(line, x):
    for (a, ya), (b, yb) in zip(line, line[1:]):
        if min(a, b) <= x <= max(a, b) and a != b:
            return ya + (yb - ya) * (x - a) / (b - a)
    return None


def check_curve(checks, name, picture, lines, x_axis, y_axis, function, ends):
    """A curve lies where the function does, between its samples too, as far as it is on the page."""
    low, high = ends
    for i in range(401):
        value = low + (high - low) * (i + 0.37) / 401
        y, x = function(value), x_axis.page(value)
        true = y_axis.page(y) if math.isfinite(y) and y > 0 else None
        if true is None or not picture.top + 2 < true < picture.bottom - 2:
            continue
        drawn = [height for height in (height_at(line, x) for line in lines) if height is not None]
        # what is steep is off up and down by its way within the width that is seen
        step = (high - low) / 1e6
        slope = (y_axis.page(function(value - step)) - true) / (x_axis.page(value - step) - x)
        allowed = SEEN * math.hypot(1, slope) if math.isfinite(slope) else SEEN
        checks.check(drawn and min(abs(height - true) for height in drawn) < allowed,
                     f"{name} at {value}: drawn at {drawn}, is at {true}")


def check_dof(checks, program):
    numbers = (4, 8, 16)
    picture = plot(program, "dof -f 50 -N 4,8,16 -s 1..20")
    if not checks.check(isinstance(picture, Picture), picture):
        return
    colours = list(picture.dots)
    dots = {N: picture.dots[colour] for N, colour in zip(numbers, colours)}
    x_axis = Axis((1, dots[4][0][0]), (20, dots[4][19][0]))
    y_axis = Axis((near(1000, F, 4), dots[4][0][1]), (near(20000, F, 4), dots[4][19][1]), log=True)
    arrows = sorted(picture.arrows)
    true = sorted(x_axis.page(hyperfocal(F, N) / 1000) for N in (8, 16))
    checks.check(len(arrows) == 2 and all(abs(a - b) < PIXEL for a, b in zip(arrows, true)),
                 f"asymptotes drawn at {arrows}, they are at {true}")
    for N, colour in zip(numbers, colours):
        limits = picture.curves[colour]
        check_curve(checks, f"near f/{N}", picture, limits[0], x_axis, y_axis,
                    lambda s, N=N: near(1000 * s, F, N), (1, 20))
        end = min(20, hyperfocal(F, N) / 1000)
        check_curve(checks, f"far f/{N}", picture, limits[1], x_axis, y_axis,
                    lambda s, N=N: far(1000 * s, F, N), (1, end))
        checks.check(all(x < x_axis.page(end) + PIXEL for line in limits[1] for x, _ in line),
                     f"f/{N}: the far limit is drawn beyond its asymptote")
        area = picture.areas[tint(colour)][0]
        upper = area[:max(range(len(area)), key=lambda i: area[i][0]) + 1]
        for x, y in upper:
            limit = far(1000 * x_axis.value(x), F, N)
            if abs(x_axis.value(x) - hyperfocal(F, N) / 1000) < 0.005:
                continue
            shown = picture.top if math.isinf(limit) else y_axis.page(limit)
            checks.check(abs(max(y, picture.top) - max(shown, picture.top)) < 1,
                         f"f/{N}: sharp up to {y} px at {x_axis.value(x)} m, but far is {limit}")


def check_hyperfocal(checks, program):
    """What is sharp lies beyond the near limit, half of H, without an end."""
    picture = plot(program, "hyperfocal -f 24..85#12 -N 8")
    if not checks.check(isinstance(picture, Picture), picture):
        return
    first, second = list(picture.dots)[:2]
    x_axis = Axis((24, picture.dots[first][0][0]), (85, picture.dots[first][-1][0]))
    y_axis = Axis((hyperfocal(24, 8), picture.dots[first][0][1]),
                  (hyperfocal(85, 8), picture.dots[first][-1][1]))
    check_curve(checks, "hyperfocal", picture, picture.curves[first][0], x_axis, y_axis,
                lambda f: hyperfocal(f, 8), (24, 85))
    areas = [area for fill in picture.areas.values() for area in fill]
    if not checks.check(len(areas) == 1, f"{len(areas)} areas"):
        return
    for x, y in areas[0]:
        limit = y_axis.page(hyperfocal(x_axis.value(x), 8) / 2)
        checks.check(abs(y - picture.top) < PIXEL or abs(y - limit) < SEEN,
                     f"the sharp zone of hyperfocal has a corner at {x} {y}")
    checks.check(any(abs(y - picture.top) < PIXEL for _, y in areas[0]), "it has an upper end")
    checks.check(not plot(program, "lensmaker --r1 40..60 --r2 -50 -n 1.5168 -d 5").areas,
                 "focal lengths have no zone between them")


def check_ends(checks, program):
    """A curve that ends between samples is drawn up to there; at a pole it is broken."""
    picture = plot(program, "focus -f 50 -s 0.03..0.3#10")
    dots = list(picture.dots.values())[0]
    x_axis = Axis((0.06, dots[0][0]), (0.3, dots[-1][0]))
    y_axis = Axis((50 / 10, dots[0][1]), (50 / 250, dots[-1][1]))
    lines = list(picture.curves.values())[0][0]
    check_curve(checks, "magnification", picture, lines, x_axis, y_axis,
                lambda s: 50 / (1000 * s - 50), (0.0501, 0.3))
    start = min(x for line in lines for x, _ in line)
    checks.check(abs(start - x_axis.page(0.05)) < 0.05, f"it begins at {start}")
    picture = plot(program, "conjugate double-gauss --object 50mm..500mm#10")
    lines = list(picture.curves.values())[0][0]
    checks.check(len(lines) == 2, f"a pole breaks a curve in two: {len(lines)}")


def main():
    checks, program = Checks(), Program(sys.argv[1])
    check_dof(checks, program)
    check_hyperfocal(checks, program)
    check_ends(checks, program)
    checks.finish()


if __name__ == "__main__":
    main()
