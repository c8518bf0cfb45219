#!/usr/bin/env python3
"""tests/truth/check_draw.py - drawings of lenses: check_draw.py BUILD_DIR

Every lens of lensdb is drawn (one that states neither diameters nor an aperture is refused, and
drawn with -N 8): well-formed, every coordinate inside the page. The outlines of three lenses are
parsed from the SVG and compared with the sag that the numbers of their .lens files give.
"""
# SPDX-License-Identifier: MIT

import os
import re
import subprocess
import sys
import xml.etree.ElementTree as tree

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import ROOT, Checks

SVG = "{http://www.w3.org/2000/svg}"
COMPARED = {"double-gauss": 6, "fisheye-16": 6, "nikkor-z-14-24": 17}  # lens: its elements
PIXEL = 0.015  # coordinates have two decimals: 0.005 each way, and as much from the fitted origin


def run(program, *words):
    return subprocess.run([program, *words], capture_output=True, text=True)


def points(element):
    """Coordinates of a shape, px."""
    name = element.tag[len(SVG):]
    if name == "path":
        numbers = [float(n) for n in re.findall(r"-?\d*\.?\d+", element.get("d"))]
    elif name in ("polygon", "polyline"):
        numbers = [float(n) for n in re.findall(r"-?\d*\.?\d+", element.get("points"))]
    elif name == "line":
        numbers = [float(element.get(key)) for key in ("x1", "y1", "x2", "y2")]
    elif name == "text":
        numbers = [float(element.get("x")), float(element.get("y"))]
    else:
        return []
    return list(zip(numbers[::2], numbers[1::2]))


def check_page(checks, name, text):
    try:
        root = tree.fromstring(text)
    except tree.ParseError as trouble:
        checks.check(False, f"{name}: not well-formed: {trouble}")
        return None
    width, height = (float(n) for n in root.get("viewBox").split()[2:])
    outside = [p for e in root.iter() for p in points(e)
               if not (0 <= p[0] <= width and 0 <= p[1] <= height)]
    checks.check(not outside, f"{name}: outside the page: {outside[:3]}")
    shapes = sum(1 for e in root.iter() if points(e))
    checks.check(shapes > 8, f"{name}: only {shapes} shapes")
    return root


def read_lens(name):
    """Surfaces of the file in the first position: vertex, sag function's numbers, diameter."""
    surfaces, words, z = [], {}, 0.0
    with open(os.path.join(ROOT, "lensdb/lenses", name + ".lens"), encoding="utf-8") as file:
        for line in file:
            part = line.split("#")[0].split()
            if part[:1] == ["let"]:
                words[part[1]] = part[2]
            elif part and part[0] in ("surface", "stop"):
                value = [words.get(word, word) for word in part[1:]]
                extra = dict(word.split("=") for word in value[4:] if "=" in word)
                radius = 0.0 if value[0] == "-" else float(value[0])
                surfaces.append({"z": z, "c": 1 / radius if radius else 0.0, "glass": value[2],
                                 "semi": float(value[3]) / 2, "k": float(extra.pop("k", 0)),
                                 "A": {int(key[1:]): float(a) for key, a in extra.items()}})
                z += float(value[1])
    cemented = [i for i in range(1, len(surfaces) - 1)
                if surfaces[i - 1]["glass"] != "air" and surfaces[i]["glass"] != "air"]
    widened = {i: max(surfaces[i]["semi"], min(surfaces[i - 1]["semi"], surfaces[i + 1]["semi"]))
               for i in cemented}
    for i, semi in widened.items():
        surfaces[i]["semi"] = semi
    return surfaces


def sag(surface, r):
    c, k = surface["c"], surface["k"]
    return (surface["z"] + c * r * r / (1 + (1 - (1 + k) * c * c * r * r) ** 0.5) +
            sum(a * r ** order for order, a in surface["A"].items()))


def bar_scale(root):
    """px for each mm, from the scale bar: the line that ends 8 px before its label."""
    label = next(e for e in root.iter(SVG + "text") if re.fullmatch(r"[\d.]+ mm", e.text or ""))
    x, y = float(label.get("x")) - 8, float(label.get("y")) - 4
    for element in root.iter():
        p = points(element)
        if len(p) == 2 and abs(p[1][0] - x) < 0.02 and abs(p[0][1] - y) < 0.02 and \
                abs(p[1][1] - y) < 0.02:
            return (p[1][0] - p[0][0]) / float(label.text.split()[0])
    raise ValueError("no scale bar")


def check_outlines(checks, name, root, count):
    """Each vertex of an outline on its surface, on a flat at its edge or on a rim."""
    surfaces = read_lens(name)
    pieces = [i for i, s in enumerate(surfaces[:-1]) if s["glass"] != "air"]
    fills = [g for g in root.iter(SVG + "g") if g.get("fill", "none") not in ("none", None) and
             g.get("stroke") == "#26323d"]
    outlines = [points(e) for g in fills for e in g if len(points(e)) > 20]
    checks.check(len(outlines) == len(pieces) == count,
                 f"{name}: {len(outlines)} outlines, {len(pieces)} elements, expected {count}")
    scale = bar_scale(root)
    axis = (min(y for o in outlines for _, y in o) + max(y for o in outlines for _, y in o)) / 2
    middle = min(outlines[0], key=lambda p: (abs(p[1] - axis) > 0.02, p[0]))
    origin = middle[0] - scale * surfaces[pieces[0]]["z"]
    for piece, outline in zip(pieces, outlines):
        two, worst, hits = surfaces[piece:piece + 2], 0.0, [0, 0]
        reach = max(s["semi"] for s in two)
        for x, y in outline:
            r, z = abs(axis - y) / scale, (x - origin) / scale
            off = []
            for side, s in enumerate(two):
                # the slope of the surface turns an error in y into one in x
                h = min(r, s["semi"]) if r > s["semi"] + 0.02 / scale else r
                step = 1e-4
                slope = abs(sag(s, h) - sag(s, max(h - step, 0))) / step
                off.append(abs(sag(s, h) - z) * scale / (1 + slope))
                hits[side] += off[-1] < PIXEL and r <= s["semi"] + 0.02 / scale
            worst = max(worst, min(off))
            checks.check(r <= reach + 0.02 / scale, f"{name}: beyond the rim of element {piece + 1}")
        checks.check(worst < PIXEL and min(hits) >= 40,
                     f"{name}: surface {piece + 1}: {worst:.3f} px off the sag, points {hits}")


FOLDED = """surface 60 8 1.5168/64.17 30
surface -60 40 air 30
bend tilt=45,0,0
surface - 0 mirror 50
bend tilt=45,0,0
surface - -40 air 10
surface -40 -6 1.62/36 24
surface 80 -30 air 24
"""
TILTED = """surface - 4 1.5168/64.17 30 tilt=20,0
surface - 20 air 30 tilt=20,0
surface 50 6 1.62/36 24 decenter=0,6
surface - 30 air 24 decenter=0,6
"""


def drawn(program, lens):
    """Outlines in mm from the middle of the first, y up."""
    answer = subprocess.run([program, "draw", "-"], input=lens, capture_output=True, text=True)
    root = tree.fromstring(answer.stdout)
    fills = [g for g in root.iter(SVG + "g") if g.get("stroke") == "#26323d"]
    outlines = [points(e) for g in fills for e in g if len(points(e)) > 20]
    scale = bar_scale(root)
    left = min(x for x, _ in outlines[0])
    middle = (min(y for _, y in outlines[0]) + max(y for _, y in outlines[0])) / 2
    return [[((x - left) / scale, (middle - y) / scale) for x, y in o] for o in outlines]


def box(outline):
    return [f(p[k] for p in outline) for k in (0, 1) for f in (min, max)]


def near(found, expected):
    return all(abs(a - b) < 0.01 for a, b in zip(found, expected))


def check_moved(checks, program):
    """A periscope folded upwards by a mirror at 45 degrees; a tilted plate, a decentred lens."""
    first, second = drawn(program, FOLDED)
    # the mirror's vertex is at z = 48, the second lens 40 mm above it, its axis upright
    checks.check(near(box(first)[2:], [-15, 15]), f"folded: first lens {box(first)}")
    rim = 40 - (40 ** 2 - 12 ** 2) ** 0.5, 80 - (80 ** 2 - 12 ** 2) ** 0.5
    checks.check(near(box(second), [36, 60, 40, 46]), f"folded: second lens {box(second)}")
    ends = sorted({round(y, 2) for x, y in second if abs(x - 60) < 0.01})
    checks.check(near([ends[0], ends[-1]], [40 + rim[0], 46 - rim[1]]),
                 f"folded: rims of the second lens {ends}")
    plate, lens = drawn(program, TILTED)
    # each face turns about its own vertex, 4 mm apart along z: right-handed about x, so that the
    # upper edge goes to the right
    sine, cosine = 0.3420201433256687, 0.9396926207859084
    checks.check(near(box(plate), [0, 4 + 30 * sine, -15 * cosine, 15 * cosine]),
                 f"tilted: {box(plate)}")
    # its first vertex is 24 mm behind that of the plate, 15 sin 20 deg from the left edge
    checks.check(near(box(lens), [15 * sine + 24, 15 * sine + 30, -6, 18]),
                 f"decentred: {box(lens)}")


def main():
    program = os.path.join(os.path.abspath(sys.argv[1]), "lenscalc")
    checks = Checks()
    lenses = run(program, "list", "lenses", "--csv", "--columns", "lens").stdout.split()[1:]
    checks.check(len(lenses) > 50, f"only {len(lenses)} lenses")
    for name in lenses:
        answer = run(program, "draw", name, "--planes")
        if answer.returncode == 1 and "has no diameter, and no ray" in answer.stderr:
            answer = run(program, "draw", name, "--planes", "-N", "8")
        checks.check(answer.returncode == 0, f"{name}: {answer.stderr}")
        if answer.returncode == 0:
            check_page(checks, name, answer.stdout)
        plain = run(program, "draw", name, "--construction", "-N", "8")
        refused = "afocal" in plain.stderr or "odd number of mirrors" in plain.stderr
        checks.check(plain.returncode == 0 or refused, f"{name} --construction: {plain.stderr}")
        if plain.returncode == 0:
            check_page(checks, name + " --construction", plain.stdout)
    check_moved(checks, program)
    for name, count in COMPARED.items():
        root = check_page(checks, name, run(program, "draw", name).stdout)
        if root is not None:
            check_outlines(checks, name, root, count)
    checks.finish()


main()
