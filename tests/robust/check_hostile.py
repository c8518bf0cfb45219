#!/usr/bin/env python3
"""tests/robust/check_hostile.py - files that showed faults, under every command that takes a file.

Each is answered or refused in a second, with a status of its own; no answer and no message holds a
nan or, but for CSV and files, a control character, and JSON is whole. The files are those of
tests/robust/hostile and, where there is one, of the shared folder: each by every so many commands,
by all of them with LENSCALC_EVERY=1 (ten minutes), by fewer if the program is instrumented.
LENSCALC_EVERY sets another number.
"""
# SPDX-License-Identifier: MIT

import glob
import json
import os
import re
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from check_options import ASKED
from harness import ROOT, SHARED, Checks, Program

NAN = re.compile(rb"(?i)(?<![a-z])-?nan(?![a-z])")
CONTROL = re.compile(rb"[\x00-\x08\x0b-\x1f\x7f]|\xc2[\x80-\x9f]|\xe2\x80[\xaa-\xae]|\xe2\x81[\xa6-\xa9]")
MOST = 1.0  # s of processor time
CARD = "render chart:edge -s 1 --size 8x6 --samples 1 --threads 1"
# What is asked of the file @: as a lens, and as every other kind of file.
QUESTIONS = (
    "lens @ --json", "lens @ --position all --lossy", "surfaces @ --json", "sag @ --height 0.1 --json", "matrix @ --json",
    "conjugate @ --object 1m --json", "trace @ --json", "trace @ --pattern gauss --rays 18 --csv",
    "trace @ --pupil-point 0.3:0.5 --field 60deg --json", "check @ --json", "check @ --plot p.svg",
    "pupil @ --json", "pupil @ --height 5 --json", "draw @", "draw @ --lossy",
    "seidel @ --json", "spot @ --json", "spot @ --plot p.svg", "field @ --json", "illumination @ --json",
    "color @ --json", "wavefront @ --field 0 --rays 100 --json", "mtf @ --field 0 --frequency 20 --json",
    "psf @ --field 0 --size 32 --json", "psf @ --field 0 --size 32 --map p.png", "fan @ --json",
    "energy @ --field 0 --json", "spread @ --field 0 --json",
    "distortion @ --json", "distortion @ --fit opencv --json", "report @ -o p.html",
    "bench @ --rays 12 --degree 3 --columns model,rms_error,warning --json",
    "fit @ --json --rays 12", "fit @ --prescription efl=50 --vary all-R --json",
    "optimize @ --vary all-R --rays 12 --iterations 3 --json",
    "optimize @ --vary R1 --rays 4 --global 1 --escapes 0 --seconds 0.3 --json",
    "tolerance @ --grade high --trials 3 --json",
    CARD + " --lens @ -o p.png", "render --lens @ --samples 1 -w d --rays p.csv",
    "dof --lens @ -N 8 -s 3 --json", "hyperfocal --lens @ -N 8 --json", "fov --lens @ --json",
    "visual --telescope 900 --diameter 100 --lens @ --json",
    "focus --lens @ -N 8 -s 3 --json", "exposure --lens @ -N 8 -t 1/60 --json",
    "equivalent --lens @ -N 8 --sensor 4/3 --json", "diffraction --lens @ -N 8 --json",
    "convert @", "convert @ --to zmx --lossy", "convert @ --to seq --lossy", "convert @ --to len --lossy",
    "convert @ --to dat --lossy", "convert @ --to json --lossy", "convert @ --reverse --scale 2",
    "convert --check --files @ --json",
    "dof --batch @ -N 8 --json", "trace double-gauss --batch @ --csv", "fit --glass @ --json",
    "glass N-BK7 --agf @ --json", "merge @", "tone @ -o p.png", "tone @=1 @=2 -o p.hdr",
    "render @ -s 1 -N 8 --size 8x6 --samples 1 --lens double-gauss -o p.png",
    CARD + " -N 8 --lens double-gauss --response @ --pitch 4um -o p.png",
    CARD + " -N 8 --lens double-gauss --acceptance @ -o p.png",
    CARD + " -N 8 --lens double-gauss --part 1/2 --resume -o @copy",
    "tolerance double-gauss --trials 3 --tolerances @ --json",
    "optimize double-gauss --vary R1 --goals efl=100 --rays 4 --global 1 --escapes 0 --iterations 2"
    " --state @copy",
)
# What crashed, or took many seconds, is asked every time.
ALWAYS = (("spans.lens", "mtf @ --plot p.svg"), ("bead.lens", "mtf @ --plot p.svg"),
          ("bead.lens", "wavefront @ --plot p.svg"))
# Commands that read no file of the user's but tables of --lensdb, which check_input tries.
WITHOUT = {"flash", "bracket", "motion", "stars", "tilt", "panorama", "timelapse", "survey", "pinhole",
           "projector", "microscope", "refract", "lensmaker",
           "list", "help", "completion"}


def questions_in(path, words):
    """Seconds that an answer may take, where it is no single question. Of what was counted:
    - a report is 18 questions, contrast at 61 frequencies of three fields among them;
    - a drawing asks anew what its rows have asked; a map of wave fronts aims 50,000 rays at each
      field, of which a lens like a bead loses most after a search;
    - a fisheye of which a radius is too small by ten searches for most rays of its wide fields, in
      each iteration of optimize and in the closer look at the end;
    - each of 5000 fields takes 0.2 ms to spot, each of 5000 positions 1 ms to tolerance, as linear
      as it can be; of 500 surfaces every ray takes 40 times that of twelve;
    - 500 radii of 500 surfaces take 0.05 s an iteration to optimize, by surfaces times variables,
      and 0.15 s where rays go astray, of which 80 come before a lens is given up that cannot be
      judged; to fit they take 0.03 s, by the cube of the radii, 200 times. Both end when they are
      interrupted (tests/terminal)."""
    if "_500_" in path and words[0] in ("optimize", "fit"):
        return 24
    if "_500_" in path or "_5000_" in path:
        return 8
    if words[0] == "wavefront" and "--plot" in words:
        return 7
    if words[0] == "optimize":
        return 4
    return 6 if words[0] == "report" else 2 if "--plot" in words or "--map" in words else 1


def ask(program, path, question, room):
    """What is wrong with one answer: texts."""
    with tempfile.TemporaryDirectory(dir=room) as folder:
        copy = os.path.join(folder, "copy")  # where the file may be written
        with open(path, "rb") as file, open(copy, "wb") as to:
            content = file.read()
            to.write(content)
        words = [copy if word == "@copy" else word.replace("@", path) for word in question.split()]
        most = MOST * questions_in(path, words)
        result, took = program.run_within(most, *words, cwd=folder)
    wrong = [f"took {took:.1f} s"] if took > program.allowed(most) else []
    return wrong + judge(question, result.returncode, result.stdout.replace(path.encode(), b""),
                         result.stderr.replace(path.encode(), b""), NAN.search(content))


def judge(question, status, printed, complaint, may_say_nan):
    """What is wrong with what was answered; what the file says may be repeated."""
    wrong = []
    if status not in (0, 1, 2, 3, 4):
        wrong.append(f"status {status}: {complaint[-700:]!r}")
    if NAN.search(printed + complaint) and not may_say_nan:
        wrong.append(f"nan: {(printed + complaint)[-300:]!r}")
    # what is printed in place of a file is that file, and cells of CSV are those that were given,
    # whatever stands in them
    is_data = question.startswith("convert") or "--csv" in question
    if CONTROL.search(complaint) or (not is_data and CONTROL.search(printed)):
        wrong.append(f"control characters: {(printed + complaint)[-300:]!r}")
    if "--json" in question and printed:
        try:
            json.loads(printed)
        except ValueError as trouble:
            wrong.append(f"{trouble}: {printed[-200:]!r}")
    return wrong


def main():
    checks, program = Checks(), Program(sys.argv[1])
    own = sorted(glob.glob(os.path.join(ROOT, "tests", "robust", "hostile", "*.*")))
    known = [path for path in sorted(glob.glob(os.path.join(SHARED, "data", "hostile", "*.*")))
             if not path.endswith(".md")]
    checks.check(len(own) >= 10, f"tests/robust/hostile holds {own}")
    if not known:
        print("skipped: files that showed faults before, there is no shared folder")
    asked = {command for question in QUESTIONS for command in ASKED if command == question.split()[0]}
    checks.check(asked | WITHOUT == set(ASKED), f"asked of no file: {set(ASKED) - asked - WITHOUT}")
    every = int(os.environ.get("LENSCALC_EVERY", 0)) or (
        200 if program.is_instrumented else 60)
    cases = [(path, question) for number, path in enumerate(own + known)
             for place, question in enumerate(QUESTIONS) if (number + place) % every == 0]
    cases += [(path, question) for name, question in ALWAYS for path in own
              if os.path.basename(path) == name]
    with tempfile.TemporaryDirectory() as room, \
            ThreadPoolExecutor(int(os.environ.get("LENSCALC_JOBS", "2"))) as pool:
        for (path, question), wrong in zip(cases, pool.map(
                lambda case: ask(program, *case, room), cases)):
            checks.check(not wrong, f"{question} of {os.path.basename(path)}: {'; '.join(wrong)}")
    print(f"{len(cases)} questions of {len(own) + len(known)} files")
    checks.finish()


if __name__ == "__main__":
    main()
