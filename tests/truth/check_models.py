#!/usr/bin/env python3
"""tests/truth/check_models.py - models of lenses in lenscalc render: check_models.py BUILD_DIR

Rays of a thin lens, of a thick one and of a pinhole have the weights, the irradiance and the
circles of confusion of closed forms; those of paraxial and thick lenses are those of y and n u
worked out here, point by point, and of the 4x4 matrix. A fitted lens is that of `fit -o`. Focusing
on the sharpest image differs from the thick lens's focus by longitudinal aberration alone. The
error that a picture says is not less than its own, and not much more.
"""
# SPDX-License-Identifier: MIT

import csv
import math
import os
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program
from photographs import read_pfm, write_pfm

# A thick lens: f 50, H 20 mm behind the first plane, H' 5 mm behind H and 15 mm before the last,
# and its entrance pupil, of 20 mm, 8 mm before H.
HAND = """lens hand
unit mm
wavelength d
object inf
field angle 0 10
aperture stop
focus paraxial
surface - 12 air -
stop - 8 air 20
thick 50 15 air - hiatus=5
surface - 0 air -
"""
F, H, LENGTH, PUPIL, D = 50, 20, 40, 12, 20

# Glass, whose y and n u are worked out below: radius (0 = plane), gap and index behind.
GLASS = [(60, 8, 1.6), (-80, 5, 1), (0, 5, 1), (50, 3, 1.7), (40, 0, 1)]
DIAMETERS = (34, 34, 15, 24, 24)
# A Cassegrain's mirrors with a lens behind; nothing is in the way of the light.
MIRRORS = """lens mirrors
unit mm
wavelength d
object inf
field angle 0 1
aperture stop
focus paraxial
stop - 75 air 40
surface -200 -75 mirror 60
surface -80 20 mirror 30
surface 300 4 1.5 30
surface - 0 air 30
"""


def glass_lens(rows, diameters):
    lines = ["lens glass", "unit mm", "wavelength d", "object inf", "field angle 0 10",
             "aperture stop", "focus paraxial"]
    for i, ((radius, gap, index), diameter) in enumerate(zip(rows, diameters)):
        medium = "air" if index == 1 else index
        kind = "stop" if i == 2 else "surface"
        lines.append(f"{kind} {radius or '-'} {gap} {medium} {diameter}")
    return "\n".join(lines) + "\n"


class Render:
    def __init__(self, program, checks, folder):
        self.program, self.checks, self.folder = program, checks, folder

    def run(self, *words):
        return subprocess.run(self.program.command + [*words], text=True, cwd=self.folder,
                              capture_output=True, env=self.program.environment())

    def write(self, name, text):
        with open(os.path.join(self.folder, name), "w", encoding="utf-8") as file:
            file.write(text)

    def rays(self, *words):
        result = self.run("render", *words, "--rays", "-")
        self.checks.check(result.returncode == 0, f"{words}: {result.stderr}")
        return [{key: float(value) for key, value in row.items()}
                for row in csv.DictReader(result.stdout.splitlines())]

    def plane_of(self, *words):
        """Where the film stands, as the picture says."""
        result = self.run("render", "chart:edge", "--size", "8x8", "--samples", "1", "-o",
                          "plane.png", *words)
        self.checks.check(result.returncode == 0, f"{words}: {result.stderr}")
        with open(os.path.join(self.folder, "plane.png"), "rb") as file:
            return float(re.search(rb"Image plane\0([-.0-9]+) mm", file.read()).group(1))


def at(ray, z):
    """Where a ray crosses a plane."""
    way = (z - ray["z_mm"]) / ray["cos_z"]
    return ray["x_mm"] + way * ray["cos_x"], ray["y_mm"] + way * ray["cos_y"]


def disc(t, a):
    """E/L of a disc of half angle a, seen from off the axis by the field angle t."""
    t2, a2 = math.tan(t) ** 2, math.tan(a) ** 2
    return math.pi / 2 * (1 - (1 + t2 - a2) / math.sqrt(t2 * t2 + 2 * t2 * (1 - a2) +
                                                        (1 + a2) ** 2))


def mean_over(width, height, function):
    """By Gauss's eight points in each direction of a quarter."""
    points = [(.9602898564975363, .1012285362903763), (.7966664774136267, .2223810344533745),
              (.5255324099163290, .3137066458778873), (.1834346424956498, .3626837833783620)]
    nodes = [((1 + sign * x) / 2, w / 2) for x, w in points for sign in (1, -1)]
    return sum(u * v * function(math.hypot(x * width / 2, y * height / 2))
               for x, u in nodes for y, v in nodes)


def check_light(render):
    """The mean of E/L over 36 x 24 mm, and the weights of a pinhole, one by one."""
    s, checks = 1000, render.checks
    v = F * s / (s - F)
    exit_place = 1 / (1 / F - 1 / (H - PUPIL))  # behind H', mm; below 0 before it
    exit_radius = D / 2 * exit_place / -(H - PUPIL)
    expected = {"thin": (v, D / 2), "thick": (v - exit_place, abs(exit_radius))}
    for model, (distance, radius) in expected.items():
        rays = render.rays("--lens", "hand.lens", "-s", "1m", "--model", model)
        mean = mean_over(36, 24, lambda h, d=distance, r=radius: disc(math.atan(h / d),
                                                                     math.atan(r / d)))
        found = sum(ray["weight"] for ray in rays)
        checks.check(abs(found / mean - 1) < 2e-4, f"{model}: E/L {found}, expected {mean}")
    # far aside, where the film sees the pupil at 83 degrees from the axis
    render.write("short.lens", "lens short\nunit mm\nwavelength d\nobject inf\nfield angle 0 1\n"
                 "aperture stop\nfocus paraxial\nsurface - 0 air -\nstop - 0 air 0.3\n"
                 "thick 2.5 0 air - hiatus=0\nsurface - 0 air -\n")
    for model in "thin", "thick":
        rays = render.rays("--lens", "short.lens", "--model", model)
        found = sum(ray["weight"] for ray in rays)
        mean = sum(disc(math.atan(math.hypot(0.03 * i + 0.015, 0.03 * j + 0.015) / 2.5),
                        math.atan(0.15 / 2.5)) for i in range(600) for j in range(400)) / 240000
        checks.check(abs(found / mean - 1) < 2e-3, f"{model}: E/L {found}, expected {mean}")
    rays = render.rays("--lens", "hand.lens", "-s", "1m", "--model", "pinhole", "--samples",
                       "512")
    checks.check(len(rays) == 512, f"{len(rays)} rays of 512 pass a pinhole")
    for ray in rays:
        h = math.hypot(ray["film_x_mm"], ray["film_y_mm"])
        cosine = math.cos(math.atan(h / v))
        light = math.pi * D * D / 4 * cosine ** 4 / v ** 2 / 512
        x, y = at(ray, H)
        checks.check(abs(ray["weight"] / light - 1) < 1e-12, f"pinhole: weight {ray}")
        # all through the hole, and straight on
        checks.check(math.hypot(x, y) < 1e-12 and
                     abs(ray["cos_x"] / ray["cos_z"] - ray["film_x_mm"] / v) < 1e-14,
                     f"pinhole: {ray}")


def check_confusion(render):
    """The axial point's circle: of the object space at s2, seen where the lens is focused, s1."""
    s1, s2, checks = 1000, 1700, render.checks
    m = F / (s1 - F)
    circles = {"thin": D * F * abs(s2 - s1) / (s2 * (s1 - F)),
               # from the entrance pupil, 8 mm before H
               "thick": D * m * abs(s2 - s1) / (s2 - 8), "pinhole": 0}
    for model, expected in circles.items():
        rays = render.rays("--lens", "hand.lens", "-s", f"{s1}mm", "--model", model, "--sensor",
                           "1e-9x1e-9mm", "--samples", "16384")
        place = {"thick": PUPIL}.get(model, H)  # of the pupil
        largest = max(math.hypot(*at(ray, H - s2)) for ray in rays)
        found = 2 * largest * (s1 - H + place) / (s2 - H + place) * m
        checks.check(abs(found - expected) <= 3e-4 * expected + 1e-8,
                     f"{model}: circle {found}, expected {expected}")


def check_blur(render):
    """A small square, 0.6 mm out of focus: spread by a uniform disc, in the picture."""
    card = [[float(80 <= i <= 120 and 80 <= j <= 120) for i in range(201)] for j in range(201)]
    write_pfm(os.path.join(render.folder, "spot.pfm"), card)
    path, s, shift = os.path.join(render.folder, "blur.pfm"), 1000, 0.6
    v = F * s / (s - F)
    for model, radius in ("thin", shift * D / 2 / v), ("pinhole", 0):
        result = render.run("render", "spot.pfm", "--lens", "hand.lens", "-s", f"{s}mm",
                            "--field-width", "20.1mm", "--defocus", f"{shift}", "--model", model,
                            "--sensor", "0.8x0.8mm", "--size", "80x80", "--samples", "64", "-o",
                            path)
        if not render.checks.check(result.returncode == 0, result.stderr):
            continue
        rows = read_pfm(path)
        light = sum(pixel[1] for row in rows for pixel in row)
        spread = sum(pixel[1] * ((0.01 * (i - 39.5)) ** 2) for row in rows
                     for i, pixel in enumerate(row)) / light
        # a box of 41 pixels, with one more for what is interpolated, and one of the film's
        own = (0.1 * (v + shift) / s) ** 2 * (41 ** 2 + 1) / 12 + 0.01 ** 2 / 12
        expected = radius ** 2 / 4 + own
        render.checks.check(abs(spread / expected - 1) < 5e-3,
                            f"{model}: spread {spread}, expected {expected}")


def through(rows, y, u):
    """y and the slope behind the last vertex, of a ray before the first."""
    n = 1
    for radius, gap, index in rows:
        power = (index - n) / radius if radius else 0
        u = (n * u - power * y) / index
        n = index
        y += gap * u
    return y, u


def check_paraxial(render):
    """Rays of the renderer, taken forwards again by y and n u in x and y."""
    checks, lens = render.checks, ("--lens", "glass.lens", "-s", "800mm")
    plane = render.plane_of(*lens, "--model", "paraxial")
    a, c = through(GLASS, 1, 0)
    b, d = through(GLASS, 0, 1)
    checks.check(abs(render.plane_of(*lens) - plane) < 1e-9, "the models are focused elsewhere")
    front, rear = (d - 1) / c, (1 - a) / c  # H, H'
    z = 800 - front  # the object from the first vertex
    expected = -(a * z + b) / (c * z + d)
    checks.check(abs(expected - plane) < 1e-7, f"the film stands at {plane}, not {expected}")
    plane = expected
    matrix = [[1, 0], [-c, 1]]  # w = 1 - c z and z' = z + t w, both z from H
    for model in "paraxial", "thick":
        rays = render.rays(*lens, "--model", model, "--samples", "256")
        worst = image = 0
        for ray in rays:
            ends = []
            for axis in "xy":
                slope = ray[f"cos_{axis}"] / ray["cos_z"]
                y, u = through(GLASS, ray[f"{axis}_mm"] - ray["z_mm"] * slope, slope)
                ends.append(abs(y + plane * u - ray[f"film_{axis}_mm"]))
            worst = max(worst, *ends)
            # a point of the ray, somewhere before the lens: its image lies on the ray behind
            where = -500 - front
            x = at(ray, -500)[0]
            w = matrix[1][0] * where + matrix[1][1]
            slope = ray["cos_x"] / ray["cos_z"]
            y, u = through(GLASS, ray["x_mm"] - ray["z_mm"] * slope, slope)
            image = max(image, abs(y + u * (rear + where / w) - x / w))
        checks.check(worst < 1e-12 * 40, f"{model}: {worst} mm off y and n u")
        checks.check(image < 1e-11, f"{model}: {image} mm off the 4x4 matrix")
    # y and n u of two mirrors: as the exact rays near the axis
    near = ("--lens", "mirrors.lens", "-N", "100", "--sensor", "0.02x0.02mm", "--samples", "64")
    pairs = zip(render.rays(*near), render.rays(*near, "--model", "paraxial"))
    off = max(abs(one[key] - other[key]) for one, other in pairs for key in ("cos_x", "cos_y"))
    checks.check(off < 1e-6, f"mirrors: {off} off the exact rays near the axis")


def check_fitted(render):
    if not render.program.has_solver():
        result = render.run("render", "--lens", "glass.lens", "--model", "fitted", "--rays", "-")
        render.checks.check(result.returncode == 1 and "Ceres" in result.stderr, result.stderr)
        return
    result = render.run("fit", "glass.lens", "--distortion", "0", "-o", "equal.lens")
    render.checks.check(result.returncode == 0, result.stderr)
    common = ("--samples", "4096", "-w", "d")
    fitted = render.rays("--lens", "glass.lens", "--model", "fitted", *common)
    rays = render.rays("--lens", "equal.lens", "--model", "fitted", *common)
    off = max((abs(one[key] - other[key]) for one, other in zip(fitted, rays) for key in one),
              default=1)
    render.checks.check(off < 1e-8 and len(rays) == len(fitted), f"the same lens is {off} off")
    # traced as any lens, whose pupils are looked for: by other rays
    light = [sum(ray["weight"] for ray in some)
             for some in (fitted, render.rays("--lens", "equal.lens", *common))]
    render.checks.check(abs(light[0] / light[1] - 1) < 1e-3, f"E/L {light}")


def refract_exactly(y, z0):
    """The axial crossing of a ray from z0 at height y on a sphere and a plane of n = 1.5."""
    radius, index, gap = 50, 1.5, 4
    sag = radius - math.sqrt(radius ** 2 - y ** 2)
    before = math.atan2(y, sag - z0)
    normal = math.asin(y / radius)
    inside = math.asin(math.sin(before + normal) / index) - normal
    height = y + (gap - sag) * math.tan(inside)
    return -height / math.tan(math.asin(index * math.sin(inside)))


def check_focus(render):
    """A slow planoconvex lens: rms of y^3 and defocus is least at 2/3 of the marginal crossing."""
    render.write("plano.lens", "lens plano\nunit mm\nwavelength d\nobject inf\nfield angle 0 1\n"
                 "aperture stop\nfocus paraxial\nstop - 0 air 10\nsurface 50 4 1.5 20\n"
                 "surface - 0 air 20\n")
    checks, lens = render.checks, ("--lens", "plano.lens", "-s", "500mm", "--from", "front")
    thick = render.plane_of(*lens, "--focus-at", "thick")
    sharp = render.plane_of(*lens, "--focus-at", "sharpest")
    paraxial = refract_exactly(1e-3, -500)
    marginal = refract_exactly(5 * 500 / 500.25, -500)
    checks.check(abs(thick - paraxial) < 1e-4, f"thick {thick}, expected {paraxial}")
    wanted = 2 / 3 * (marginal - paraxial)
    checks.check(abs((sharp - thick) / wanted - 1) < 0.01,
                 f"sharpest {sharp - thick} from it, expected {wanted}")
    # by its last gap the lens moves before a film that stands still: at the same two places
    own = 100 - 4 / 1.5  # of an object at infinity
    for focus, place in ("thick", thick), ("sharpest", sharp):
        moved = render.plane_of(*lens, "--gap", "last", "--focus-at", focus)
        checks.check(abs(moved - place) < 1e-7, f"--gap last: {moved}, expected {place}")
    # sharpest: rays back from the film come closest to each other at the card
    for gaps in "last", "2":
        off = []
        for focus in "thick", "sharpest":
            rays = render.rays(*lens, "--gap", gaps, "--sensor", "1e-9x1e-9mm", "--samples",
                               "1024", "--focus-at", focus)
            crossing = [(at(ray, 0), ray["cos_x"] / ray["cos_z"], ray["cos_y"] / ray["cos_z"])
                        for ray in rays]
            off.append(500 - sum(x * u + y * v for (x, y), u, v in crossing) /
                       sum(u * u + v * v for _, u, v in crossing))
        checks.check(abs(off[1]) < 0.02 * abs(off[0]), f"--gap {gaps}: {off} mm off the card")
    # models focus on the card themselves, whatever was moved for the exact rays
    for words in ("thick", "--focus-at", "sharpest"), ("thin",), ("paraxial",):
        rays = render.rays(*lens, "--gap", "2", "--sensor", "1e-9x1e-9mm", "--samples", "64",
                           "--model", *words)
        off = max(math.hypot(*at(ray, -500)) for ray in rays)
        checks.check(len(rays) > 50 and off < 1e-7, f"{words}: {off} mm off the card")
    # by the gap before the last surface: the film stays where it was
    moved = render.plane_of(*lens[:3], "10m", "--from", "front", "--gap", "2")
    checks.check(abs(moved - own) < 1e-7, f"--gap 2: the film stands at {moved}, not {own}")


def check_autofocus(render):
    """Four distances in the corners of a map, one far out at its right, which the film cuts off."""
    rows = [[1.0, 1.0, 2.0, 2.0, 9.0], [1.0, 1.0, 2.0, 2.0, 9.0], [3.0, 3.0, 4.0, 4.0, 9.0]]
    cells = {"0.1:0.1": 1, "0.9:0.1": 9, "0.82:0.5": 2, "0.5:0.4": 2, "0.2:0.9": 3, "0.7:0.9": 4,
             "0:0": 1, "1:1": 9}
    # as wide as 5:3 of the film's 3:2: 3/5 x 3/2 = 0.9 of the width is seen
    checks = render.checks
    write_pfm(os.path.join(render.folder, "map.pfm"), rows)
    for place, metres in cells.items():
        x, y = map(float, place.split(":"))
        expected = rows[min(int(3 * y), 2)][min(int(5 * (0.5 + 0.9 * (x - 0.5))), 4)]
        checks.check(expected == metres, f"the table says {metres} m at {place}, not {expected}")
        result = render.run("render", "chart:edge", "--lens", "hand.lens", "--depth-map",
                            "map.pfm", "--autofocus", place, "--size", "8x8", "--samples", "1",
                            "-o", "auto.png")
        found = re.search(r"focused on ([0-9.]+) mm before the first vertex", result.stderr)
        between = 1000 * metres - 5  # to H, and from H'
        s = (between + math.sqrt(between * (between - 4 * F))) / 2
        checks.check(found is not None and abs(float(found.group(1)) / (s - H) - 1) < 1e-5,
                     f"{place}: {result.stderr}, expected {s - H}")


def check_error(render):
    """The error that is said, against 4096 rays of another seed; tiles as with fixed samples."""
    checks = render.checks
    common = ["render", "chart:checker", "--lens", "cs348b-dgauss-50", "-s", "1m", "--defocus",
              "0.3", "-t", "0.01", "--size", "48x32", "-w", "d", "--no-skip", "blur,uniform"]

    def take(name, *words):
        result = render.run(*common, *words, "-o", name)
        checks.check(result.returncode == 0, result.stderr)
        return read_pfm(os.path.join(render.folder, name)), result.stderr

    best, _ = take("best.pfm", "--samples", "4096", "--seed", "7")
    white = 0.19251 * 10  # lx s in the middle: an independent program's E/L, 1000 cd/m2, 1/100 s
    pictures = {}
    for asked in 0.02, 0.005:
        rows, words = take("error.pfm", "--error", f"{asked}")
        said = re.search(r"error ([0-9.]+) % of white, by ([0-9.]+) rays", words)
        true = math.sqrt(sum((a[1] - b[1]) ** 2 for row, other in zip(rows, best)
                             for a, b in zip(row, other)) / (48 * 32)) / white
        stated = float(said.group(1)) / 100
        checks.check(stated <= asked and true < 1.05 * stated and true > stated / 5,
                     f"--error {asked}: it says {stated}, it is {true}")
        pictures[asked] = rows
    # every tile is one of those with fixed samples
    fixed = {n: take("fixed.pfm", "--samples", f"{n}")[0] for n in (16, 32, 64, 128, 256, 512)}
    for top in range(0, 32, 8):
        for left in range(0, 48, 16):
            tile = [row[left:left + 16] for row in pictures[0.005][top:top + 8]]
            same = [n for n, rows in fixed.items()
                    if [row[left:left + 16] for row in rows[top:top + 8]] == tile]
            checks.check(len(same) == 1, f"tile {left}, {top} is as with {same} samples")
    crop, _ = take("crop.pfm", "--error", "0.005", "--crop", "10:5:30x20")
    checks.check(crop == [row[10:40] for row in pictures[0.005][5:25]], "a crop is another")
    for part in "1/2", "2/2":
        take_part = render.run(*common, "--error", "0.005", "--part", part, "-o",
                               f"{part[0]}.part")
        checks.check(take_part.returncode == 0, take_part.stderr)
    merged = render.run("merge", "1.part", "2.part", "-o", "merged.pfm")
    checks.check(merged.returncode == 0 and
                 read_pfm(os.path.join(render.folder, "merged.pfm")) == pictures[0.005] and
                 re.search(r"error [0-9.]+ % of white", merged.stderr) is not None, merged.stderr)
    _, words = take("few.pfm", "--error", "0.0001", "--samples", "32")
    missed = re.search(r"warning: 12 of 12 tiles have not reached the error: they have ([0-9.]+) %",
                       words)
    checks.check(missed is not None and float(missed.group(1)) > 0.2, words)


def main():
    program, checks = Program(sys.argv[1]), Checks()
    with tempfile.TemporaryDirectory(prefix="lenscalc-models-") as folder:
        render = Render(program, checks, folder)
        render.write("hand.lens", HAND)
        render.write("glass.lens", glass_lens(GLASS, DIAMETERS))
        render.write("mirrors.lens", MIRRORS)
        for check in (check_light, check_confusion, check_blur, check_paraxial, check_fitted,
                      check_focus, check_autofocus, check_error):
            check(render)
    return checks.finish()


if __name__ == "__main__":
    sys.exit(main())
