"""tests/truth/reference.py - systems of an independent 50-digit program as .lens files.

The program's files are JSON, ../shared/reference/truth; numbers are read as strings, so that what a
.lens file says has the same digits.
"""
# SPDX-License-Identifier: MIT

import glob
import json
import os
import sys
from decimal import Decimal

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import ROOT, SHARED


def systems():
    """All cases with a lens and its values; none where ../shared is not there."""
    for path in sorted(glob.glob(os.path.join(SHARED, "reference/truth/*.json"))):
        with open(path, encoding="utf-8") as file:
            cases = json.load(file, parse_float=str, parse_int=str)["cases"]
        yield from (case for case in cases if isinstance(case["expected"], dict) and
                    isinstance(case.get("system"), dict) and "surfaces" in case["system"])


def own_cases(checks, path, found, note):
    """
    The project's own copy of what was found of the reference, so that a plain clone has it too:
    it must be the same where the reference is here, and is written anew with --write.
    """
    path = os.path.join(ROOT, path)
    if "--write" in sys.argv and found:
        with open(path, "w", encoding="utf-8") as file:
            lines = ",\n".join(json.dumps(case) for case in found)
            file.write(f'{{"note": "{note}",\n"cases": [\n{lines}\n]}}\n')
    with open(path, encoding="utf-8") as file:
        cases = json.load(file)["cases"]
    if found:
        checks.check(cases == found, f"{path} is not what the reference has: --write")
    else:
        print("skipped: no ../shared, its own cases are not compared with the reference")
    return cases


def medium(words):
    if isinstance(words, str):
        return words
    if "glass" in words:
        return words["glass"]
    return words["n"] if "n" in words else f"{words['nd']}/{words['Vd']}"


def surface_line(surface, aperture):
    radius, more = surface.get("R", "inf"), []
    if "c" in surface:
        radius, more = "inf", ["c=" + surface["c"]]
    if float(surface.get("k", 0)) != 0:
        more.append("k=" + surface["k"])
    more += [f"A{2 * i + 4}={number}" for i, number in enumerate(surface.get("A", []))
             if float(number) != 0]
    diameter = surface.get("ap", "-")
    if surface.get("stop"):
        more.append("stop")
        if aperture["type"] == "stop":
            diameter = repr(2 * float(aperture["value"]))
    following = "mirror" if surface.get("mirror") else medium(surface.get("m", "air"))
    return " ".join(["surface", "-" if radius == "inf" else radius, surface.get("t", "0"),
                     following, diameter] + more)


def lens_text(system, wavelengths=None, fractions=("1",)):
    """One system: its primary wavelength, if no others; fields are shares of the largest."""
    aperture, field, thing = system["aperture"], system["field"], system["object"]
    kinds = {"EPD": "epd ", "fno": "f/", "NAobj": "na "}
    fields = [f"{Decimal(field['value']) * Decimal(one):f}" for one in fractions]
    lines = ["lens " + system["name"], "wavelength " + " ".join(wavelengths or [system["primary"]]),
             "object " + thing["distance"],
             "aperture " + (kinds[aperture["type"]] + aperture["value"]
                            if aperture["type"] in kinds else "stop"),
             f"field {'height' if field['type'] == 'height' else 'angle'} {' '.join(fields)}"]
    if thing.get("medium", "air") != "air":
        lines.append("medium " + medium(thing["medium"]))
    return "\n".join(lines + [surface_line(one, aperture) for one in system["surfaces"]]) + "\n"
