#!/usr/bin/env python3
"""tests/truth/check_exercises.py - exercises of a textbook, typed as they are read:
check_exercises.py BUILD_DIR

Questions and printed answers of University Physics (exercises.tsv); allowed is half a unit of the
last printed digit, a little more where the book rounds on its way.
"""
# SPDX-License-Identifier: MIT

import os
import re
import shlex
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import ROOT, Checks


def answer(program, words, column):
    """The column of the last row, as it is printed."""
    wrapper = shlex.split(os.environ.get("LENSCALC_WRAPPER", ""))
    result = subprocess.run([*wrapper, program, *shlex.split(words), "--value", column],
                            capture_output=True, text=True)
    lines = result.stdout.split("\n")
    return lines[-2] if result.returncode == 0 and len(lines) > 1 else None


def check_diagram(checks, program, words, image):
    """The rays behind the lens meet, by similar triangles with the object, where the image is."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "rays.svg")
        subprocess.run([program, "conjugate", *words.split(), "--diagram", path],
                       stdout=subprocess.DEVNULL, check=True)
        with open(path, encoding="utf-8") as file:
            text = file.read()
    line = r'<line x1="(\S+)" y1="(\S+)" x2="(\S+)" y2="(\S+)"/>'
    axis = float(re.search(line, text)[2])
    lines = [tuple(map(float, found))
             for found in re.findall(r'stroke-width="1.7"[^>]*>\s*' + line, text)]
    tip, lens = lines[0][:2], lines[0][2]
    behind = [line for line in lines if line[0] == lens]
    s, *place = image
    x = lens + (lens - tip[0]) * place[0] / s
    y = axis - (axis - tip[1]) * place[1]
    checks.check(len(behind) == 3, f"{words}: {len(behind)} rays behind the lens")
    for x0, y0, x1, y1 in behind:
        at = y0 + (y1 - y0) * (x - x0) / (x1 - x0)
        checks.check(abs(at - y) < 0.05, f"{words}: a ray passes the image at {at}, {y} expected")


def check_ideal(checks, program):
    """Newton's x x' = f^2 of a mirror, where the light goes; no magnifier diverges."""
    words = "conjugate --mirror concave -R 50cm --object 100cm"
    for column, expected in (("object_focal_cm", 75), ("image_focal_cm", 25 * 25 / 75)):
        checks.against(None, words, column, answer(program, words, column), expected, 1e-12 * expected)
    words = "conjugate -f -10cm --object 5cm"
    power = answer(program, words, "magnifying_power")
    checks.check(not power, f"{words}: a magnifying power of {power}")


def main():
    program = os.path.join(os.path.abspath(sys.argv[1]), "lenscalc")
    checks = Checks()
    with open(os.path.join(ROOT, "tests/truth/exercises.tsv"), encoding="utf-8") as file:
        lines = [line.rstrip("\n").split("\t") for line in file if not line.startswith("#")]
    for module, words, column, expected, allowed in lines[1:]:
        actual, case = answer(program, words, column), f"{module}: {words}"
        if allowed == "0":
            checks.check(actual == expected, f"{case}: {column} is {actual}, expected {expected}")
        else:
            checks.against("openstax", case, column, actual, expected, float(allowed))
    # s, s', m in cm, of 1/s + 1/s' = 1/f
    check_diagram(checks, program, "-f 10cm --object 15cm", (15, 30, -2))
    check_diagram(checks, program, "-f -15cm --object 10cm", (10, -6, 0.6))
    check_diagram(checks, program, "-f 10cm --object 6cm", (6, -15, 2.5))
    check_ideal(checks, program)
    checks.finish()


main()
