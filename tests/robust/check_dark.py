#!/usr/bin/env python3
"""tests/robust/check_dark.py - lenses through which little light passes, or none.

The commands that look for rays and the analyses answer or refuse, in every format and in a short
time, and no answer holds a nan or a control character.
"""
# SPDX-License-Identifier: MIT

import json
import os
import re
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import EVERYTHING, Checks, Program

NAN = re.compile(rb"(?i)(?<![a-z])-?nan(?![a-z])")
CONTROL = re.compile(rb"[\x00-\x08\x0b-\x1f\x7f]")
COMMANDS = (["check"], ["draw"], ["trace"], ["pupil"], ["pupil", "--height", "5"],
            ["trace", "--pattern", "gauss", "--rays", "18"],
            ["trace", "--pupil-point", "0.3:0.5", "--field", "60deg"],
            ["spot"], ["fan"], ["seidel"], ["field"], ["color"], ["distortion"], ["illumination"],
            ["lens"], ["surfaces"], ["convert"], ["conjugate", "--object", "1m"],
            ["optimize", "--vary", "all-R", "--rays", "12", "--iterations", "3"])
HEAD = "lens x\nwavelength d\nobject inf\nfield angle {field}\naperture epd 5\n"


def dark_lenses():
    """name -> text of a lens."""
    def lens(field, *rows):
        return HEAD.format(field=field) + "".join(row + "\n" for row in rows)

    singlet = ("surface 50 5 1.5 20", "surface -50 50 air 20", "stop - 1 air 20")
    yield "the edge of the field does not arrive", lens("0 90", *singlet)
    yield "nor does 179 deg", lens("0 179", *singlet)
    yield "crossed cylinders", lens("0 10", "surface 50 5 1.5 20 cyl=x",
                                    "surface -50 50 air 20 cyl=y", "stop - 1 air 20")
    yield "two holes aside", lens("0 5", "surface - 50 air 4 decenter=0,9", "stop - 10 air 4",
                                  "surface - 10 air -")
    yield "total reflection", lens("0 60", "surface - 5 1.9 20", "surface -4 2 air 20",
                                   "stop - 1 air 20")
    pairs = [f"surface {1000 + i} 0.5 1.5 20\nsurface {-1000 - i} 0.5 air 20" for i in range(250)]
    yield "120 surfaces", lens("0 60 80", *pairs[:60], "stop - 1 air 20")
    if EVERYTHING:
        yield "500 surfaces", lens("0 60 80", *pairs, "stop - 1 air 20")
    fields = " ".join(f"{i / 1000:.3f}" for i in range(300))
    yield "300 fields", lens(fields, "surface 100 1 1.5 20", "surface -100 1 air 20",
                              "stop - 50 air 10")


# the name of a glass with what turns a terminal red
ESCAPE = b"""VERS 1
MODE SEQ
UNIT MM
ENPD 5
WAVM 1 0.58 1
SURF 0
 CURV 0
 DISZ INFINITY
SURF 1
 STOP
 CURV 0.02
 DISZ 3
 GLAS foo\x1b[31m 0 0 1.5 60
 DIAM 5
SURF 2
 CURV -0.02
 DISZ 50
 DIAM 5
SURF 3
 CURV 0
 DISZ 0
"""


def check_escape(checks, program):
    path = os.path.join(program.holder.name, "escape.zmx")
    with open(path, "wb") as file:
        file.write(ESCAPE)
    for words in (["spot"], ["fan", "--points", "3"], ["pupil"], ["lens"]):
        result = program.run(*words, path, "--lossy", "--csv")
        said = (result.stdout + result.stderr).replace(b"\r\n", b"\n")
        checks.check(b"foo" in said and not CONTROL.search(said),
                     f"{words[0]} of a glass with an escape in its name: {said[-200:]!r}")


def main():
    checks, program = Checks(), Program(sys.argv[1])
    most = 6  # s of processor time: work that grows out of proportion with what is asked
    paths = []
    for number, (name, text) in enumerate(dark_lenses()):
        paths.append((name, os.path.join(program.holder.name, f"dark{number}.lens")))
        with open(paths[-1][1], "w", encoding="ascii") as file:
            file.write(text)
    _, took = program.run_within(most, "distortion", "fisheye-16", "--field", "0..80#1500",
                                 "--calibrated", "--csv")
    checks.check(took < program.allowed(most),
                 f"a sweep of calibrated distortions: took {took:.1f} s")
    check_escape(checks, program)
    for name, path in paths:
        for words in COMMANDS:
            if name == "500 surfaces" and words[0] == "optimize":
                continue  # 120 radii are many: the time grows by their cube
            # one look of each: with sanitizers at a form that holds every number
            is_text = words[0] == "draw" or not program.is_instrumented
            form = [] if is_text else ["--json"]
            what = f"{name}: {' '.join(words + form)}"
            result, took = program.run_within(most, *words, path, *form)
            checks.check(took < program.allowed(most), f"{what}: took {took:.1f} s")
            said = result.stdout + result.stderr.replace(path.encode(), b"")
            checks.check(result.returncode in (0, 1, 2, 3, 4), f"{what}: {result.returncode}")
            checks.check(not NAN.search(said), f"{what}: {said[-300:]!r}")
            checks.check(not CONTROL.search(said), f"{what}: control characters")
            if form and result.returncode == 0:
                try:
                    json.loads(result.stdout)
                except ValueError as trouble:
                    checks.check(False, f"{what}: {trouble}")
    checks.finish()


if __name__ == "__main__":
    main()
