#!/usr/bin/env python3
"""tests/robust/check_extremes.py - numbers at the edge of what a double holds, to every option.

Whatever comes of them, JSON is JSON: no bare inf or nan, no number that reads back as infinity, no
key twice; csv has no nan, no column twice, and the same cells as JSON has; nothing crashes.
Every option of every command takes all of them, in every format, and many pairs of options do.
"""
# SPDX-License-Identifier: MIT

import csv
import io
import json
import os
import random
import re
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from check_options import ASKED, UNTIMED
from harness import Checks, Program

# metres are millimetres inside: 1e305 of them is the last power of ten that is a number there
EXTREMES = ("1e308", "1e305", "-1e305", "1e300", "1e155", "1e-155", "1e-305", "-1e-305", "1e-308",
            "5e-324", "1e305:1e305:1e305", "1e-305:1e-305:1e-305", "1e305x1e305", "1e305mm,1e-305")
# What takes no number, does the same work in another way, or much of it.
LEFT_OUT = {"--output", "--columns", "--format", "--table", "--batch", "--batch-format", "--lensdb",
            "--plot", "--scale", "--disc", "--card", "--threads", "--size", "--samples", "--seconds", "--agf"}
FORMATS = ("--json", "--csv", "--format=text")
# Beside the questions of check_options.
MORE = {
    "trace": ("double-gauss", "double-gauss --pattern gauss --rays 9"),
    "dof": ("--lens double-gauss -s 3", "-f 100 -N 8 --near 30cm --far 33cm --stack"),
    "hyperfocal": ("--lens double-gauss",),
    "focus": ("--lens double-gauss -s 3", "-f 50 -m 1:2"),
    "fov": ("--lens double-gauss", "-f 50 --altitude 50"),
    "exposure": ("-N 8 --ev 12", "-N 8 --luminance 4000"),
    "flash": ("-g 36 -s 5",),
    "conjugate": ("double-gauss",),
    "glass": ("--nd 1.5168 --vd 64",),
}


def no_constant(word):
    raise ValueError(f"{word} in JSON")


def finite(text):
    value = float(text)
    if value in (float("inf"), float("-inf")):
        raise ValueError(f"{text} is infinite")
    return value


def once(pairs):
    names = [name for name, _ in pairs]
    for name in names:
        if names.count(name) > 1:
            raise ValueError(f"the key {name} twice")
    return dict(pairs)


def read_json(text):
    """The object; ValueError says what is wrong with it."""
    return json.loads(text, parse_constant=no_constant, parse_float=finite, parse_int=finite,
                      object_pairs_hook=once)


def check_csv(checks, name, text):
    lines = list(csv.reader(io.StringIO(text)))
    head = lines[0] if lines else []
    checks.check(len(head) == len(set(head)), f"{name}: a column twice in {head}")
    cells = [cell for line in lines for cell in line]
    checks.check(not any(re.fullmatch(r"[+-]?nan(\(.*\))?", cell, re.I) for cell in cells),
                 f"{name}: nan in {text[-300:]}")
    checks.check(all(len(line) == len(head) for line in lines), f"{name}: rows of other lengths")


def check_answer(checks, name, result, form):
    text = result.stdout.decode("utf-8", "replace")
    checks.check(result.returncode in (0, 1, 2, 3, 4, 5), f"{name}: status {result.returncode}, "
                                                          f"{result.stderr[-300:]}")
    checks.check(not re.search(rb"\b-?nan\b", result.stderr),
                 f"{name}: a message of nan: {result.stderr[-300:]}")
    if form == "--csv":
        check_csv(checks, name, text)
    elif form == "--format=text":
        checks.check(not re.search(r"\bnan\b", text), f"{name}: nan in {text[-500:]}")
    elif text != "":
        try:
            read_json(text)
        except ValueError as trouble:
            checks.check(False, f"{name}: {trouble}: {text[:500]}")


def options_with_values(program, command):
    """--focal-length and the like, from the command's own help."""
    text = program.run(command, "--help").stdout.decode()
    shown = re.findall(r"^ {2}(?:-\w, |    )(--[a-z0-9-]+)[ =][A-Z]", text, re.M)
    return [option for option in shown if option not in LEFT_OUT]


def ask(checks, program, words, form, folder):
    result = program.run(*words, form, cwd=folder, timeout=100)
    check_answer(checks, " ".join([*words, form]), result, form)


def check_question(checks, program, question, folder, some):
    options = options_with_values(program, question[0])
    for option in options:
        for value in EXTREMES:
            for form in FORMATS:
                ask(checks, program, [*question, f"{option}={value}"], form, folder)
    for _ in range(3 * len(options)):
        pair = some.sample(options, min(2, len(options)))
        more = [f"{option}={some.choice(EXTREMES)}" for option in pair]
        ask(checks, program, [*question, *more], some.choice(FORMATS), folder)


def main():
    checks, program = Checks(), Program(sys.argv[1])
    some = random.Random(1)
    rows = program.run("list", "commands", "--columns", "command", "--csv").stdout.decode()
    for command in rows.split("\n")[1:-1]:
        with tempfile.TemporaryDirectory(prefix="lenscalc-extremes-") as folder:
            if command in ("merge", "tone"):
                program.run("render", *ASKED["render"][0].split(), "-o",
                            "one.part" if command == "merge" else "one.png", cwd=folder)
            for asked in (ASKED[command][0], *MORE.get(command, ())):
                untimed = UNTIMED if command == "bench" else ()
                check_question(checks, program, [command, *asked.split(), *untimed], folder, some)
    checks.finish()


if __name__ == "__main__":
    main()
