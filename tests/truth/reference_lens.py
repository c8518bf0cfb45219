"""tests/truth/reference_lens.py - systems of ../shared/reference/truth as .lens files.

Numbers are read as strings, so that every digit reaches the program.
"""
# SPDX-License-Identifier: MIT

import glob
import json
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import SHARED


def systems():
    """All cases of the truth files with a lens and its values; none without ../shared."""
    for path in sorted(glob.glob(os.path.join(SHARED, "reference/truth/*.json"))):
        with open(path, encoding="utf-8") as file:
            cases = json.load(file, parse_float=str, parse_int=str)["cases"]
        yield from (case for case in cases if isinstance(case["expected"], dict) and
                    isinstance(case.get("system"), dict) and "surfaces" in case["system"])


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


def lens_text(system, wavelengths=None, number=None):
    """One of the reference's systems; its primary wavelength, and its field, if no others."""
    aperture, field, thing = system["aperture"], system["field"], system["object"]
    kinds = {"EPD": "epd ", "fno": "f/", "NAobj": "na "}
    lines = ["lens " + system["name"], "wavelength " + " ".join(wavelengths or [system["primary"]]),
             "object " + thing["distance"],
             "aperture " + (kinds[aperture["type"]] + aperture["value"]
                            if aperture["type"] in kinds else "stop"),
             f"field {'height' if field['type'] == 'height' else 'angle'} "
             f"{number or field['value']}"]
    if thing.get("medium", "air") != "air":
        lines.append("medium " + medium(thing["medium"]))
    return "\n".join(lines + [surface_line(one, aperture) for one in system["surfaces"]]) + "\n"
