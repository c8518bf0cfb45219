#!/usr/bin/env python3
"""tests/truth/check_begun.py - designs that begin where there is no lens yet: check_begun.py BUILD

Two plane plates have no power: no image, and at an f-number no beam. The achromat that they become
has the powers V1/(V1 - V2) and -V2/(V1 - V2) of thin lenses, the focal length that the file states
and, by rays traced here, small spots on the axis. A number outside of its bounds begins at the
nearest one.
"""
# SPDX-License-Identifier: MIT

import csv
import io
import json
import math
import os
import re
import sys
import tempfile
import xml.etree.ElementTree

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program
from meridional import first_order, rms_on_axis, GAUSS

EFL, FNUMBER = 150.0, 6.0
GLASSES = ((1.56883, 55.98), (1.72828, 28.53))
THICKNESSES = (7.0, 3.5)
WIDE = 1000.0  # a clear diameter that ends nothing
PLATES = """lens plates
wavelength d F C
field angle 0 1.2
aperture f/6
{stated}
focus {focus}
surface - 7 1.56883/55.98 - c~ {stop}
surface - 3.5 1.72828/28.53 - c~
surface - 145 air - c~{more}
"""


def plates(folder, **what):
    """A file of plane plates."""
    words = {"stated": "stated efl 150", "focus": "paraxial", "stop": "stop", "more": "", **what}
    path = os.path.join(folder, "plates.lens")
    with open(path, "w", encoding="utf-8") as file:
        file.write(PLATES.format(**words))
    return path


def radii(program, path, *words):
    """Of the lens that it ends at; a message where it fails."""
    rows = program.rows("optimize", path, *words, "--show", "variables")
    if isinstance(rows, str):
        return rows
    return [1 / float(row["after"]) for row in rows if row["variable"].startswith("c")]


def check_achromat(program, checks, folder):
    """By both image planes, with the focal length stated, or a goal."""
    goal = "poly,efl=150"
    cases = (({}, ()), ({"focus": "table", "more": " t~"}, ()), ({"stated": ""}, ("--goals", goal)),
             ({"stated": "", "focus": "table", "more": " t~"}, ("--goals", goal)))
    for what, words in cases:
        name = f"{what} {words}"
        found = radii(program, plates(folder, **what), *words)
        checks.check(not isinstance(found, str), f"{name}: {found}")
        if isinstance(found, str):
            continue
        behind = [glass[0] for glass in GLASSES] + [1.0]
        lens = [(radius, thickness, index, WIDE, i == 0) for i, (radius, thickness, index)
                in enumerate(zip(found, (*THICKNESSES, 0.0), behind))]
        efl, bfl, _ = first_order(lens)
        checks.near("focal length", name, efl, EFL, 0.005 * EFL)
        first, second = (v for _, v in GLASSES)
        for i, share in enumerate((first / (first - second), -second / (first - second))):
            power = (GLASSES[i][0] - 1) * (1 / found[i] - 1 / found[i + 1])
            checks.near("thin achromat", f"{name}: element {i + 1}", power * EFL, share, 0.05)
        edge = EFL / FNUMBER / 2
        image = bfl if what.get("focus") != "table" else None
        if image is not None:
            rays = [(edge * math.sqrt(q), w) for q, w in GAUSS]
            checks.near("spot, um", name, 1000 * rms_on_axis(lens, image, rays), 0, 6)


def check_powerless(program, checks, folder):
    """Nothing says what the focal length is to be."""
    for focus in ("paraxial", "table"):
        said = radii(program, plates(folder, stated="", focus=focus))
        checks.check("the lens has no power" in said and "efl = 100" in said, f"{focus}: {said}")


def check_numbers(program, checks, folder):
    """What no solver can begin with is named: the goal, how far it is off, or the variable."""
    path = os.path.join(folder, "tiny.lens")
    with open(path, "w", encoding="utf-8") as file:
        file.write("wavelength d\nfield angle 0 3\naperture epd 1e-205\nfocus table\n"
                   "surface 1e-40 3 1.5 - stop\nsurface - 80 air -\n")
    result = program.run("optimize", path, "--vary", "c1,t1", "--goals", "fnumber=5")
    checks.check(b"the goal fnumber = 5 is off by 2e+165 deviations" in result.stderr,
                 f"tiny: {result.stderr}")


def check_moved(program, checks, folder):
    """Begun at the bound that is nearest, in curvature for radii, and said."""
    path = os.path.join(folder, "singlet.lens")
    with open(path, "w", encoding="utf-8") as file:
        file.write("wavelength d\naperture epd 5\nfocus table\nsurface 50 3 1.5 - stop\n"
                   "surface - 80 air -\n")
    # what is varied, what is said, the bound, and the focal length there
    cases = (("R1[60,70]", "R1 is 50 mm, outside of its bounds 60 to 70 mm", 60, 120),
             ("R1[70,-70]", "R1 is 50 mm, outside of its bounds 70 to -70 mm", 70, 140),
             ("R1[20,40]", "R1 is 50 mm, outside of its bounds 20 to 40 mm", 40, 80),
             ("c1[0.03,0.05]", "c1 is 0.02 /mm, outside of its bounds 0.03 to 0.05 /mm", 0.03,
              200 / 3))
    for vary, said, bound, efl in cases:
        goal = f"efl={efl:.17g}:1e-3"
        rows = program.rows("optimize", path, "--vary", vary, "--goals", goal, "--show",
                            "variables")
        rows = [{"warning": rows}] if isinstance(rows, str) else rows
        checks.check(said in (rows[0]["warning"] or ""), f"{vary}: {rows}")
        checks.near("moved", vary, float(rows[0].get("after") or math.nan), bound,
                    1e-6 * bound)
        merit = program.rows("optimize", path, "--vary", vary, "--goals", "efl=100", "--columns",
                             "merit_before")
        checks.near("merit as it was", vary, float(merit[0]["merit_before"]), 0, 1e-20)


def check_assumed(program, checks, folder):
    """What it is optimised for is said by every kind of rows, of a lens that states nothing too."""
    path = os.path.join(folder, "bare.lens")
    with open(path, "w", encoding="utf-8") as file:
        file.write("aperture epd 5\nfocus table\nsurface 50 3 1.5 - stop\nsurface - 80 air -\n")
    cases = ((), "the axis alone, as the lens states none", "587.5618 nm alone, as the lens "
             "states none"), (("--field", "0,3", "-w", "550,C:0.5"), "0, 3 deg",
                              "550, 656.2725 x 0.5 nm")
    for show in ("answer", "merit", "variables", "spots"):
        for words, fields, wavelengths in cases:
            result = program.run("optimize", path, "--vary", "R1", "--goals", "poly", "--show",
                                 show, "--rays", "20", "--json", *words)
            said = json.loads(result.stdout)["assumptions"]
            checks.check(said["fields"] == fields and said["wavelengths"] == wavelengths and
                         said["rays"].startswith("20 gauss"), f"{show} {words}: {said}")


def check_names(program, checks, folder):
    """A gap has the same names wherever gaps are named: of optimize --vary, of tolerance --adjust,
    of --gap; two that mean one gap give the same bytes."""
    path = os.path.join(folder, "named.lens")
    with open(path, "w", encoding="utf-8") as file:
        file.write("wavelength d\nfield angle 0 5\naperture epd 10\nfocus table\n"
                   "position near far\nlet d4 3 5\nsurface 60 4 1.6 30\n"
                   'surface -80 3 air 30 name="gap"\nsurface -50 2 1.7 30\nsurface 90 d4 air 30\n'
                   "surface 70 3 1.6 30\nsurface -70 60 air 30\ntolerance R1..R6 0.2%\n")
    for same in (("2", "t2", "gap"), ("4", "t4", "d4"), ("6", "t6", "last")):
        answers = {"vary": [], "adjust": [], "gap": []}
        for name in same:
            answers["vary"].append(program.run("optimize", path, "--vary", name, "--goals",
                                               "efl=60", "--show", "variables", "--csv").stdout)
            for option in ("adjust", "gap"):
                rows = program.rows("tolerance", path, f"--{option}", name, "--trials", "3",
                                    "--rays", "6", "--refocus", "none")
                if not isinstance(rows, str):
                    rows[0]["compensation"] = None  # it is called as it was typed
                answers[option].append(rows)
        for option, said in answers.items():
            checks.check(all(one == said[0] for one in said) and said[0] and
                         not isinstance(said[0], str), f"{option} {same}: {said}")
    for name in ("99", "t99"):
        result = program.run("optimize", path, "--vary", name, "--goals", "efl=60")
        checks.check(b"there is no thickness 99 to vary" in result.stderr, f"{name}: {result}")


def stop_share(path):
    """Of a written lens in air: the paraxial radius of its stop over the largest height of the
    marginal ray."""
    y, v, n, heights, stop = 1.0, 0.0, 1.0, [], None
    with open(path, encoding="utf-8") as file:
        for words in (line.split() for line in file):
            if not words or words[0] not in ("surface", "stop"):
                continue
            behind = 1.0 if words[3] == "air" else float(words[3])
            v -= 0 if words[1] == "-" else y * (behind - n) / float(words[1])
            heights.append(abs(y))
            stop = abs(y) if words[0] == "stop" else stop
            y, n = y + float(words[2]) * v / behind, behind
    return stop / max(heights)


def check_degenerate(program, checks, folder):
    """A stop between two lenses that may lie at the image within: such minima are none, others are
    kept, and what is lost is named."""
    path = os.path.join(folder, "relay.lens")
    with open(path, "w", encoding="utf-8") as file:
        file.write("wavelength d\nfield angle 0 2\naperture f/5\nfocus table\n"
                   "goal poly, efl = 50\nsurface 60 5 1.6 - R~\nsurface -60 40 air - R~ t~[5,120]\n"
                   "stop - 40 air - t~[5,120]\nsurface 40 5 1.6 - R~\n"
                   "surface -40 60 air - R~ t~[10,200]\n")
    result = program.run("optimize", path, "--global", "12", "--keep", "4", "--seed", "3",
                         "--csv", "-o", os.path.join(folder, "found.lens"))
    rows = list(csv.DictReader(io.StringIO(result.stdout.decode(), newline="")))
    shares = [stop_share(os.path.join(folder, f"found-{row['rank']}.lens")) for row in rows]
    checks.check(len(rows) > 1 and min(shares) > 1e-3, f"degenerate: {shares} {result.stderr}")
    said = re.search(r"(\d+) of 12 starts (?:was|were) lost: (.*?)(;|$)", rows[0]["warning"])
    checks.check(said and int(said[1]) == sum(int(count) for count in re.findall(
        r"(?:^|, )(\d+) as ", said[2])), rows[0]["warning"])


def check_page(program, checks, folder):
    """The page of a design has the figures of the rows, start and end, whole drawings of both, and
    what binds; HTML and SVG are well formed."""
    path = os.path.join(folder, "page.lens")
    with open(path, "w", encoding="utf-8") as file:
        file.write("lens a & b\nwavelength d F C\nfield angle 0 3\naperture f/8\nfocus table\n"
                   "surface 60 4 1.6/50 - R~ stop\nsurface -60 50 air - R~ t~[20,47]\n")
    goals = ("--goals", "poly, efl=50, center > 4, edge > 1")
    texts = {}
    for kind in ("html", "svg"):
        name = os.path.join(folder, f"page.{kind}")
        result = program.run("optimize", path, *goals, "--report", name)
        checks.check(result.returncode == 0, f"page: {result.stderr}")
        with open(name, encoding="utf-8") as file:
            texts[kind] = file.read()
    for kind, text in texts.items():
        tree = xml.etree.ElementTree.fromstring(
            text.replace('<meta charset="utf-8">', "").split("<!DOCTYPE html>\n")[-1])
        words = " ".join(tree.itertext())
        checks.check(tree is not None and "a & b" in words, f"page, {kind}: its title")
        for row in program.rows("optimize", path, *goals, "--show", "variables"):
            for end in ("before", "after"):
                checks.check(f"{float(row[end]):.5g}" in words, f"page, {kind}: {row}")
        for row in program.rows("optimize", path, *goals, "--show", "merit"):
            for part in ("value_before", "value_after", "merit_before", "merit_after"):
                checks.check(f"{float(row[part]):.5g}" in words, f"page, {kind}: {row}")
        binds = words[words.index("What binds"):]
        checks.check(re.search(r"t2 +upper bound, 47", binds) and "center > 4 " in binds and
                     "edge > 1 " not in binds.split("Doubts")[0], f"page, {kind}: {binds[:300]}")
        for part in ("Cross-section, start", "Cross-section, end", "Spots, start and end"):
            checks.check(part in words, f"page, {kind}: {part}")
        checks.check(text.count("<svg") >= 3, f"page, {kind}: {text.count('<svg')} drawings")


def main():
    """All of it."""
    program, checks = Program(sys.argv[1]), Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_achromat(program, checks, folder)
        check_powerless(program, checks, folder)
        check_numbers(program, checks, folder)
        check_moved(program, checks, folder)
        check_assumed(program, checks, folder)
        check_degenerate(program, checks, folder)
        check_names(program, checks, folder)
        check_page(program, checks, folder)
    for kind, (share, where) in sorted(checks.worst.items()):
        print(f"{kind}: at worst {share:.2g} of what is allowed, {where}")
    checks.finish()


if __name__ == "__main__":
    main()
