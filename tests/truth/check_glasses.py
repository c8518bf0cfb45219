#!/usr/bin/env python3
"""tests/truth/check_glasses.py - the glasses that optimize chooses, by hand and by trying them all:
check_glasses.py BUILD_DIR

A thin achromat of N-BK7 and N-SF5 has the powers V1/(V1 - V2) and -V2/(V1 - V2) of its own, V from
the makers' constants written out here. Of short lists every combination is optimised by itself:
none is better than the one that was chosen. A search with glasses ends where a search and then an
exchange of the glasses of each lens that was kept end. Of a triplet that two glasses together make
better, no single one of the whole catalogue does, each optimised by itself.
"""
# SPDX-License-Identifier: MIT

import itertools
import math
import os
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import EVERYTHING, Checks, Program

# B1 C1 B2 C2 B3 C3 of n^2 = 1 + sum B l^2/(l^2 - C)
SELLMEIER = {
    "N-BK7": (1.03961212, 0.00600069867, 0.231792344, 0.0200179144, 1.01046945, 103.560653),
    "N-SF5": (1.52481889, 0.011254756, 0.187085527, 0.0588995392, 1.42729015, 129.141675)}
D, F, C = 0.5875618, 0.4861327, 0.6562725  # um, in the air that indices are relative to
DOUBLET = """wavelength d F C
field angle 0 1
aperture epd 20
focus table
surface - {t} {0} 22 stop
surface - {half} {1} 22
surface - 96 air 22
"""
TRIPLET = """wavelength d F C
field angle 0 14
aperture epd 10
focus table
surface 21 3.2 {0} 16
surface -436 6 air 16
surface -22 1 {1} 12
surface 20 1 air 10
stop - 3.7 air 9
surface 80 2.9 {2} 12
surface -18.5 42.5 air 12
"""


def index(glass, wavelength):
    constants = SELLMEIER[glass]
    square = wavelength * wavelength
    return math.sqrt(1 + sum(b * square / (square - c)
                             for b, c in zip(constants[::2], constants[1::2])))


def abbe(glass):
    return (index(glass, D) - 1) / (index(glass, F) - index(glass, C))


def write(name, text, glasses, thickness=6):
    with open(name, "w") as file:
        file.write(text.format(*glasses, t=thickness, half=thickness / 2))
    return name


def radii(name):
    with open(name) as file:
        lines = [line.split() for line in file if line.startswith("surface")]
    return [math.inf if words[1] == "-" else float(words[1]) for words in lines]


def check_thin(checks, program):
    """Both glasses end in their places, and the powers are those of thin lenses."""
    plates = write("thin.lens", DOUBLET, ("1.52/60", "1.65/35"), 1e-7)
    rows = program.rows("optimize", plates, "--vary", "c1,c2,c3,t3,glass1,glass2", "--goals",
                        "efl==100,axial==0,poly", "--glasses", "N-BK7,N-SF5", "--show", "glasses",
                        "-o", "achromat.lens")
    if not checks.check(isinstance(rows, list), rows):
        return
    chosen = [row["glass"].split(":")[1] for row in sorted(rows, key=lambda row: row["surface"])]
    if not checks.check(sorted(chosen) == ["N-BK7", "N-SF5"], f"chosen are {chosen}"):
        return  # crown or flint may come first
    v = [abbe(glass) for glass in chosen]
    R = radii("achromat.lens")
    for i in range(2):
        power = (index(chosen[i], D) - 1) * (1 / R[i] - 1 / R[i + 1])
        checks.near("power", chosen[i], power, 0.01 * v[i] / (v[i] - v[1 - i]), 1e-9)


def merit(program, lens, *question):
    """What it comes to; infinite where a condition is missed."""
    rows = program.rows("optimize", lens, *question, "--columns", "merit_before,merit_after,status")
    if not isinstance(rows, list) or rows[0]["status"] != "converged":
        return math.inf
    return float(rows[0]["merit_after"])


def check_best(checks, program, kind, text, models, names, vary, goals):
    """No combination is better, each begun where the search began, and where it ended."""
    question = ("--goals", goals, "--vary")
    start = write(f"{kind}.lens", text, models)
    surfaces = [at + 1 for at, line in enumerate(text.splitlines()[4:]) if "{" in line]
    all_of_it = vary + "".join(f",glass{at}" for at in surfaces)
    search = ("optimize", start, *question, all_of_it, "--glasses", ",".join(names))
    exchanges = program.rows(*search, "--show", "glasses", "-o", f"{kind}-found.lens")
    if not checks.check(isinstance(exchanges, list), f"{kind}: {exchanges}"):
        return
    answer = program.rows(*search)[0]
    found = float(answer["merit_after"])
    checks.check(len(exchanges) == len(models), f"{kind}: {len(exchanges)} exchanges")
    for before, after in zip(exchanges, exchanges[1:]):
        checks.check(before["merit_after"] == after["merit_before"], f"{kind}: rows do not join")
    checks.near("same", f"{kind}: the last row", exchanges[-1]["merit_after"], found, 1e-300)
    loss = sum(float(row["loss"]) for row in exchanges)
    checks.near("loss", f"{kind}: all losses", loss,
                found - float(exchanges[0]["merit_before"]), 1e-12 * found)
    # what is written has that merit as it is
    written = program.rows("optimize", f"{kind}-found.lens", *question, vary)[0]["merit_before"]
    checks.near("written", f"{kind}: the lens", written, found, 1e-7 * found)
    best = min((merit(program, write("one.lens", text, ["SCHOTT:" + name for name in glasses]),
                      *question, vary), glasses)
               for glasses in itertools.product(names, repeat=len(models)))
    checks.check(found <= best[0] * (1 + 1e-4), f"{kind}: {found} was found, {best} is better")
    again = program.rows(*search, "--threads", "3")
    checks.check(again == [answer], f"{kind}: another answer with three threads")


def check_search(checks, program):
    """In one command as in two."""
    plates = write("plates.lens", DOUBLET, ("1.52/60", "1.65/35"))
    b = "[-0.05,0.05]"
    question = ("--vary", f"c1{b},c2{b},c3{b},t3[80,110],glass1,glass2", "--goals",
                "poly,efl=100,axial=0:0.01")
    search = ("optimize", plates, *question, "--rays", "12", "--global", "6", "--keep", "2")
    glasses = ("--glasses", "N-BK7,N-SF5,N-LAK8")
    both = program.rows(*search, *glasses)
    kept = program.rows(*search, "-o", "kept.lens")
    if not checks.check(isinstance(both, list) and isinstance(kept, list), f"{both} {kept}"):
        return
    apart = [float(program.rows("optimize", f"kept-{i + 1}.lens", *question, "--rays", "12",
                                *glasses)[0]["merit_after"]) for i in range(len(kept))]
    for row, wanted in zip(both, sorted(apart)):
        checks.near("search", f"rank {row['rank']}", row["merit_after"], wanted, 1e-6 * wanted)
    checks.check(len(both) == len(apart), f"{len(both)} lenses, not {len(apart)}")


def check_pair(checks, program):
    """None of all exchanges of one glass makes it better, and two at once do."""
    text = program.run("convert", "cooke-triplet-50").stdout.decode()
    write("cooke.lens", text.replace("{", "{{").replace("}", "}}"), ())
    goals = ("--goals", "poly,efl==50,axial==0", "--vary")
    rows = program.rows("optimize", "cooke.lens", *goals, "all-R,t2,t4,glass1,glass3,glass5",
                        "--glasses", "HIKARI", "--show", "glasses", "-o", "found.lens")
    if not checks.check(isinstance(rows, list) and len(rows) == 5, rows):
        return
    checks.check(rows[3]["loss"] == "" and rows[3]["merit_after"] == rows[4]["merit_after"],
                 f"no pair: {rows}")
    before, after = float(rows[4]["merit_before"]), float(rows[4]["merit_after"])
    checks.check(after < 0.9 * before, f"a pair gains from {before} to {after} only")
    glasses = {row["surface"]: row["glass"] for row in rows[:3]}
    with open("found.lens") as file:
        lines = file.read().splitlines()
    first = next(at for at, line in enumerate(lines) if line.startswith("surface"))

    def of(chosen):
        for surface, glass in chosen.items():
            words = lines[first + int(surface) - 1].split()
            lines[first + int(surface) - 1] = " ".join([*words[:3], glass, *words[4:]])
        with open("one.lens", "w") as file:
            file.write("\n".join(lines) + "\n")
        return merit(program, "one.lens", *goals, "all-R,t2,t4")

    for row in program.rows("list", "glasses"):
        if row["catalog"] == "HIKARI" and row["status"] != "obsolete":
            for surface in glasses:
                one = of({**glasses, surface: "HIKARI:" + row["glass"]})
                checks.check(one > after * (1 + 1e-6),
                             f"{row['glass']} alone in {surface}: {one}, the pair {after}")
    two = of({**glasses, rows[3]["surface"]: rows[3]["glass"],
              rows[4]["surface"]: rows[4]["glass"]})
    checks.near("pair", "by itself", two, after, 1e-4 * after)


def main():
    checks, program = Checks(), Program(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        check_thin(checks, program)
        check_best(checks, program, "doublet", DOUBLET, ("1.52/60", "1.65/35"),
                   ("N-BK7", "N-SF5", "N-LAK8", "F2HT"), "c1,c2,c3,t3",
                   "efl==100,axial==0,poly")
        # with the crown free the flint is best behind it, with both given before it
        check_best(checks, program, "reversed", DOUBLET, ("1.52/60", "1.65/35"),
                   ("N-LAK21", "N-LASF46B", "N-FK58"), "c1,c2,c3,t3", "efl==100,axial==0,poly")
        check_best(checks, program, "triplet", TRIPLET, ("1.62/60", "1.62/36", "1.62/60"),
                   ("N-SK16", "F2HT"), "all-R,t2,t7", "efl=50,poly")
        check_search(checks, program)
        if EVERYTHING:
            check_pair(checks, program)
    checks.finish()


if __name__ == "__main__":
    main()
