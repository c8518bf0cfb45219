#!/usr/bin/env python3
"""tests/truth/check_over_field.py - maps over the image by their symmetries: check_over_field.py BUILD

A round lens is sampled along a radius, another one over the whole format: both must say what the
rows of a field say; a lens whose last surface is turned by nothing but rounding must have the map
of the round one; one turned by a quarter has its map turned; an ideal lens has no astigmatism.
"""
# SPDX-License-Identifier: MIT

import os
import re
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program
from photographs import read_pfm

ROUND = ("lens round\nwavelength d\nobject inf\naperture epd 8\nfield angle 10\nstop - 1 air -\n"
         "surface 60 4 1.6 -\nsurface -80 {gap} air - {last}\n")
WIDE = {"x": "cyl=x", "y": "cyl=y"}  # a weak cylinder behind it, curved along one axis
SIZE = 256


def map_of(program, checks, folder, command, text, *words):
    """Values by row from the top, as written; None: there are none."""
    path = os.path.join(folder, "map.pfm")
    result = program.run(command, "-", "--over-field", path, *words, stdin=text)
    if not checks.check(result.returncode == 0, f"{command} {words}: {result.stderr.decode()}"):
        return None
    return read_pfm(path)


def lens(last="", gap="60", cylinder=None):
    text = ROUND.format(gap=gap if cylinder is None else "5", last=last)
    if cylinder is not None:
        text += f"surface 400 2 1.5 - {cylinder}\nsurface - 53 air -\n"
    return text + "focus table\n"


def place(i, half):
    return half * ((2 * i + 1) / SIZE - 1)


def check_rows(checks, program, folder, command, column, text, *words):
    """The map along y is what rows of heights in the image say, to 1/200 of its range."""
    found = map_of(program, checks, folder, command, text, "--sensor", "12x12mm", *words)
    if found is None:
        return
    half, values = 6, [value for row in found for value in row]
    span = max(values) - min(values)
    for i in (130, 190, 240, 255):
        table = program.rows(command, "-", "--height", f"{place(i, half)!r}", "--height-x",
                             f"{place(128, half)!r}", "--real", text=text)
        if checks.check(isinstance(table, list), f"{command}: {table}"):
            checks.near(f"{command} by its rows", f"at {place(i, half)}", found[SIZE - 1 - i][128],
                        float(table[0][column]), 0.008 * span)


def check_turned(checks, program, folder, command, *words):
    """A quarter about the axis: (x, y) becomes (-y, x), and the cylinder is even in both."""
    one, other = (map_of(program, checks, folder, command, lens(cylinder=WIDE[axis]),
                         "--sensor", "12x12mm", *words) for axis in "xy")
    if one is None or other is None:
        return
    most = max(map(max, one))
    span = most - min(map(min, one))
    checks.check(span > 0.1 * most, f"{command}: the map of a cylinder is flat")
    for i in range(0, SIZE, 51):
        for k in range(0, SIZE, 51):
            checks.near(f"{command} turned", f"{i}, {k}", other[k][i], one[SIZE - 1 - i][k],
                        3e-4 * most)


def check_alike(checks, program, folder, command, *words):
    """The grid of a lens that is hardly not round, and the radius of the round one."""
    one = map_of(program, checks, folder, command, lens(), "--sensor", "12x8mm", *words)
    other = map_of(program, checks, folder, command, lens("decenter=0,1e-9"), "--sensor",
                   "12x8mm", *words)
    if one is None or other is None:
        return
    span = max(map(max, one))
    for i in range(0, SIZE, 15):
        for k in range(0, SIZE, 15):
            checks.near(f"{command} radius and grid", f"{i}, {k}", other[i][k], one[i][k],
                        0.01 * span)
    checks.check(one[0][128] == 0 and one[255][128] == 0, "beyond the format there is nothing")


def check_ideal(checks, program, folder):
    """Both foci of an ideal lens lie in its image plane: bars without length."""
    path = os.path.join(folder, "bars.svg")
    result = program.run("field", "-", "--over-field", path,
                         stdin="lens ideal\nobject inf\naperture stop\nfield angle 15\n"
                               "stop - 0 air 10\nthin 50 50 air\n")
    checks.check(result.returncode == 0, result.stderr.decode())
    with open(path, encoding="utf-8") as file:
        drawing = file.read()
    groups = re.findall(r'<g [^>]*stroke="#(?:d55e00|0072b2)"[^>]*>(.*?)</g>', drawing, re.S)
    lines = [line for group in groups for line in
             re.findall(r'<line x1="([^"]*)" y1="([^"]*)" x2="([^"]*)" y2="([^"]*)"/>', group)]
    checks.check(len(lines) > 200, f"{len(lines)} bars")
    for line in lines[2:]:  # behind those of the legend
        x1, y1, x2, y2 = map(float, line)
        checks.near("ideal bars", str(line), abs(x2 - x1) + abs(y2 - y1), 0, 1e-6)


def main():
    checks, program = Checks(), Program(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        for text in (lens(), lens(cylinder=WIDE["y"])):
            check_rows(checks, program, folder, "spot", "rms_um", text)
            check_rows(checks, program, folder, "wavefront", "rms_waves", text)
        check_rows(checks, program, folder, "wavefront", "strehl", lens(), "--mapped", "strehl")
        check_turned(checks, program, folder, "spot")
        check_turned(checks, program, folder, "wavefront")
        check_alike(checks, program, folder, "spot")
        check_ideal(checks, program, folder)
    checks.finish()


main()
