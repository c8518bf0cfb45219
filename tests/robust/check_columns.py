#!/usr/bin/env python3
"""tests/robust/check_columns.py - no machine format has two columns of one name or loses a warning.

Every command is asked for all its columns, alone, swept, with rows that fail, and with its own rows
and those of other commands as a batch; and for one column of a lens that is doubtful.
"""
# SPDX-License-Identifier: MIT

import csv
import io
import os
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from check_extremes import read_json
from check_options import Asked
from harness import EVERYTHING, Checks, Program


FORMS = ("--csv", "--tsv", "--json", "--jsonl")


def check_heads(checks, name, form, result):
    text = result.stdout.decode("utf-8", "replace")
    if form in ("--csv", "--tsv"):
        rows = list(csv.reader(io.StringIO(text), delimiter="\t" if form == "--tsv" else ","))
        head = rows[0] if rows else []
        twice = {cell for cell in head if head.count(cell) > 1}
        checks.check(not twice, f"{name}: {twice} twice")
        return
    try:
        for object_text in [text] if form == "--json" else text.split("\n")[:-1]:
            read_json(object_text or "{}")
    except ValueError as trouble:
        checks.check(False, f"{name}: {trouble}: {text[:300]}")
    checks.check(True, name)


def all_columns(program, command):
    """What --columns of the command knows, and each length in feet too."""
    rows = list(csv.DictReader(io.StringIO(
        program.run(command, "--columns", "?", "--csv").stdout.decode())))
    feet = [row["column"][:-len(row["unit"])] + "ft" for row in rows if row["unit"] in ("m", "mm")]
    return ",".join([row["column"] for row in rows] + feet)


def first_rows(table):
    """Its head and two rows, which are as good as all."""
    return "".join(table.splitlines(keepends=True)[:3])


def check_command(checks, asked):
    program, command = asked.program, asked.command
    names = all_columns(program, command)
    questions = [("", lambda *more: asked.run(*more))]
    if asked.pair is not None:
        questions.append(("swept", lambda *more: asked.swept(*more)))
    if asked.batch is not None:
        header = asked.batch.split("\n")[0]
        own, shown = (first_rows(asked.run("--csv", *more).stdout.decode())
                      for more in ([], ["--columns", names]))
        bad = f"{header},note,error,far_m\nx,1,2,3\n" + asked.batch.split("\n")[1] + ",1,2,3\n"
        questions += [("batch", lambda *more: asked.batched(*more)),
                      ("bad rows", lambda *more: asked.batched(*more, rows=bad)),
                      ("own rows", lambda *more: asked.batched(*more, rows=own)),
                      ("own columns", lambda *more: asked.batched(*more, rows=shown))]
    brief = command == "bench" and not EVERYTHING  # it takes times
    for kind, ask in questions[::len(questions) - 1] if brief else questions:
        # what is written is the same wherever its question was read
        few = brief or kind in ("swept", "own rows", "own columns")
        for form in FORMS[::2] if few else FORMS:
            for more in ([], ["--columns", names])[brief:] if names else ([],):
                name = f"{command} {kind} {form} {' '.join(more)[:40]}"
                check_heads(checks, name, form, ask(form, *more))


# Commands whose rows are questions with the same answer, and options that no column has; a bracket
# is another thing: each of its shots, as a row, begins one.
FED = {"dof": [], "hyperfocal": [], "fov": [], "focus": [], "exposure": [], "flash": [],
       "motion": [], "stars": ["--pitch", "4um"], "diffraction": ["-f", "50"],
       "equivalent": ["--sensor", "4/3"], "panorama": [], "microscope": []}


def check_fed(checks, asked):
    """What is printed is read."""
    own = asked.run("--csv")
    fed = asked.run("--csv", "--batch", "-", question=FED[asked.command],
                    stdin=own.stdout.decode())
    rows, again = (list(csv.DictReader(io.StringIO(found.stdout.decode())))
                   for found in (own, fed))
    checks.check(fed.returncode == 0 and rows, f"{asked.command}: {fed.stderr[:300]!r}")
    for row, other in zip(rows, again):
        for name, cell in row.items():
            checks.check(cell == "" or same_cell(cell, other.get(name, "")),
                         f"{asked.command}: {name} {cell} becomes {other.get(name)}")


def same_cell(one, other):
    try:
        return abs(float(one) - float(other)) <= 1e-9 * max(abs(float(one)), 1e-6)
    except ValueError:
        return one == other


DOUBTFUL = ("lens doubtful\nobject inf\nwavelength d F C\naperture epd 2\nfield angle 0 2\n"
            "surface 10 2 1.5/60 5\nsurface -10 -1 air 5\nstop - 0 air 2\nsurface 20 2 1.5/60 5\n"
            "surface inf 2 air 5\n")
MORE = {"conjugate": ["-s", "1m"], "fov": ["-s", "1m"], "dof": ["-s", "1m"], "focus": ["-s", "1m"],
        "check": ["--field", "3deg"]}
LEAST = 18  # commands whose rows have the warning of their lens


def check_warnings(checks, program):
    """What no column has is said beside the answer, once."""
    rows = program.run("list", "commands", "--columns", "command", "--csv").stdout.decode()
    told = 0
    with tempfile.TemporaryDirectory(prefix="lenscalc-columns-") as folder:
        path = os.path.join(folder, "doubtful.lens")
        with open(path, "w", encoding="ascii") as file:
            file.write(DOUBTFUL)
        for command in rows.split("\n")[1:-1]:
            words = [command, "--lens", path, *MORE.get(command, [])]
            own = program.run(*words, "--csv", "--columns", "warning")
            if own.returncode != 0 or b"negative" not in own.stdout:
                continue
            told += 1
            names = all_columns(program, command).split(",")
            other = next(name for name in names if name != "warning" and
                         program.run(*words, "--csv", "--columns", name).returncode == 0)
            for form in ("--csv", "--tsv", "--jsonl", "--json"):
                found = program.run(*words, form, "--columns", other)
                where = found.stdout if form == "--json" else found.stderr
                checks.check(where.count(b"is negative") == 1 and
                             (form == "--json" or b"negative" not in found.stdout),
                             f"{command} {form} --columns {other}: {where[:300]!r}")
            checks.check(b"negative" not in own.stderr, f"{command}: twice: {own.stderr!r}")
    checks.check(told >= LEAST, f"only {told} commands tell the warning of a lens")


def main():
    checks, program = Checks(), Program(sys.argv[1])
    rows = program.run("list", "commands", "--columns", "command", "--csv").stdout.decode()
    for command in rows.split("\n")[1:-1]:
        with tempfile.TemporaryDirectory(prefix="lenscalc-columns-") as folder:
            asked = Asked(program, command, folder)
            check_command(checks, asked)
            if command in FED:
                check_fed(checks, asked)
    check_warnings(checks, program)
    checks.finish()


if __name__ == "__main__":
    main()
