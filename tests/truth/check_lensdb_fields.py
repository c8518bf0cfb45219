#!/usr/bin/env python3
"""tests/truth/check_lensdb_fields.py BUILD - every lens of lensdb can be asked by its name alone:
it has a field and an aperture, its chief rays pass, and the analyses answer.

Psf, mtf and report take seconds: of every so many lenses, and of those named behind BUILD, which
then are all that is looked at, as make survey has it. Every day each lens is asked by two or three
of the quick commands, by all with LENSCALC_ALL set.
"""
# SPDX-License-Identifier: MIT

import glob
import os
import re
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import EVERYTHING, ROOT, Checks, Program

QUICK = ("fan", "spot", "wavefront", "field", "distortion", "illumination", "seidel")
SLOW = ("psf", "mtf", "report")
EVERY, FIRST = 17, 5
MOST = 600  # s; a strongly aberrated lens takes a minute to report, on a busy machine more
# known to be bad, here to show warnings: its image lies before its last vertex
REFUSED = {("cooke-anamorphic-bad", "illumination"): "no light gets there"}


def header(text, word):
    found = re.search(rf"(?m)^{word}\s+(.*)$", text)
    return found[1].split() if found else None


def stated(text):
    """What a lens file lacks of a field off the axis and an aperture: texts."""
    field, aperture = header(text, "field"), header(text, "aperture")
    stop = re.search(r"(?m)^stop\s+\S+\s+\S+\s+\S+\s+([\d.]+\w*|[a-z]\w*)", text) or \
        re.search(r"(?m)^surface\s+\S+\s+\S+\s+\S+\s+[\d.]+\s.*\bstop\b", text)
    wrong = []
    if field is None or not any(float(word) > 0 for word in field[1:]):
        wrong.append("has no field off the axis")
    if aperture is None or (aperture == ["stop"] and not stop):
        wrong.append("has no aperture")
    if not re.search(r"(?m)^(stop\s|surface.*\sstop\b)", text):
        wrong.append("has no stop")
    return wrong


def lost_chiefs(program, name, text):
    """Fields whose chief ray does not pass; of a lens with a block in its middle it need not."""
    lines = ",".join(word.split(":")[0] for word in header(text, "wavelength"))
    rows = program.rows("field", name, "--position", "all", "-w", lines)
    if isinstance(rows, str) or not rows:
        return [f"field -w {lines}: {rows}"]
    return [] if re.search(r"(?m)^block\s", text) else [
        f"{row.get('field_deg') or row.get('height_mm')} at {row['wavelength_nm']} nm is stopped at "
        f"surface {row['surface']}" for row in rows if row.get("surface")]


def complaint(case, result):
    """What is wrong with an answer; none: null."""
    said, refusal = result.stderr.decode(), REFUSED.get(case)
    if refusal is not None:
        return None if result.returncode == 1 and refusal in said else f"not refused: {said}"
    return None if result.returncode == 0 and b"lenscalc: " not in result.stderr else said


def main():
    checks, program = Checks(), Program(sys.argv[1])
    paths = sorted(glob.glob(os.path.join(ROOT, "lensdb", "lenses", "*.lens")))
    texts = {os.path.basename(path)[:-5]: open(path, encoding="utf-8").read() for path in paths}
    checks.check(len(texts) > 60, f"lensdb has {len(texts)} lenses")
    named = [word for word in sys.argv[2:] if word != "-v"]
    every, first = (1, 0) if named else (EVERY, FIRST)
    turns = 1 if EVERYTHING or named else 3
    texts = {name: text for name, text in texts.items() if name in named or not named}
    asked = [(name, command) for place, name in enumerate(texts)
             for command in [*QUICK[place % turns::turns], *(SLOW if place % every == first else ())]]
    for name, text in texts.items():
        for wrong in stated(text):
            checks.check(False, f"{name} {wrong}")
        lost = lost_chiefs(program, name, text)
        checks.check(not lost, f"{name}: chief rays are lost: {'; '.join(lost)}")

    def answer(case):
        name, command = case
        words = ["-o", os.path.join(room, name + ".html")] if command == "report" else ["--csv"]
        return complaint(case, program.run(command, name, *words, timeout=MOST))

    with tempfile.TemporaryDirectory() as room, \
            ThreadPoolExecutor(int(os.environ.get("LENSCALC_JOBS", "2"))) as pool:
        for (name, command), wrong in zip(asked, pool.map(answer, asked)):
            checks.check(wrong is None, f"{command} {name}: {wrong}")
    checks.finish()


main()
