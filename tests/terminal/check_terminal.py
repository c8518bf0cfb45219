#!/usr/bin/env python3
"""tests/terminal/check_terminal.py - what the program does where somebody looks at a terminal.

Help within 80 columns; tables within the width of the terminal, of which they say what is left out;
colours; and nothing that comes from outside makes the terminal do what it should not.
"""
# SPDX-License-Identifier: MIT

import json
import os
import re
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program, on_terminal

HELP_WIDTH = 80


def words_of(program, *words):
    return program.run(*words).stdout.decode().split("\n")


def check_help(checks, program):
    """Every command's help, every topic, and the list of both; nothing of the texts is lost."""
    commands = words_of(program, "list", "commands", "--columns", "command", "--csv")[1:-1]
    overview = program.run("help").stdout.decode()
    topics = [line.split()[0] for line in
              overview.split("topics (lenscalc help TOPIC):\n")[1].split("\n\n")[0].split("\n")]
    checks.check(len(commands) > 30 and {"units", "version", "ranges"} <= set(topics),
                 f"help: commands {commands}, topics {topics}")
    for question in [["help"], []] + [["help", name] for name in commands + topics]:
        result = program.run(*question)
        text = (result.stdout or result.stderr).decode()
        for line in text.split("\n"):
            checks.check(len(line) <= HELP_WIDTH, f"{question}: {len(line)} columns: {line}")
    # an example broken into lines is one line to the shell
    long = [line for name in commands for line in words_of(program, "help", name)
            if line.endswith("\\")]
    checks.check(all(line.endswith(" \\") for line in long) and len(long) > 3,
                 f"examples are broken at {long}")


# Questions whose tables are wide: sweeps, lenses, lists, cross-tables, one answer with long words.
QUESTIONS = [
    ["lens", "double-gauss"], ["lens", "nikkor-z-14-24", "--position", "all"],
    ["surfaces", "double-gauss"], ["seidel", "double-gauss"], ["spot", "double-gauss"],
    ["dof", "-f", "50", "-N", "2.8..8", "-s", "1,2,3"], ["dof", "-f", "50", "-N", "4", "-s", "3"],
    ["dof", "-f", "50", "-N", "2.8..22/third", "-s", "1,2,3", "--table", "s,N"],
    ["exposure", "-N", "8", "-t", "1/60", "--iso", "100..6400"], ["flash", "-g", "36", "-N", "4"],
    ["equivalent", "-f", "50", "-N", "2", "--sensor", "35mm"],
    ["list", "films"], ["list", "cameras", "nikon"], ["list", "lenses"], ["list", "units"],
    ["list", "options"], ["list", "commands"], ["list", "glasses", "N-BK"],
    ["glass", "N-BK7", "-w", "d,F,C"], ["check", "double-gauss"], ["motion", "-f", "50",
     "-s", "5,10", "--speed", "2,5"], ["matrix", "double-gauss"], ["help", "units"],
]
LEFT_OUT = re.compile(r"\nnot shown, for want of room in (\d+) columns: (.*?); --columns NAMES", re.S)


def check_width(checks, program):
    """Lines keep within 60, 80 and 120 columns, and what is left out is named."""
    some_left_out = 0
    for words in QUESTIONS:
        name = " ".join(words)
        whole, _, status = on_terminal(program, words, 9999)
        piped = program.run(*words).stdout.decode()
        checks.check(status == 0 and len(whole) > 60, f"{name}: status {status}")
        # no table is wrapped where there is room; the lines below it are filled
        if words != ["list", "options"]:  # so many rows that later ones are wider
            checks.check(whole.split("\n\n")[0] == piped.split("\n\n")[0], f"{name}: wide")
        for width in (60, 80, 120):
            shown, _, _ = on_terminal(program, words, width)
            for line in shown.split("\n"):
                checks.check(len(line) <= width, f"{name}: {len(line)} of {width} columns: {line}")
            note = LEFT_OUT.search(shown)
            if note is None:
                continue
            some_left_out += 1
            checks.check(int(note[1]) == width, f"{name}: {note[0]}")
            left_out = re.sub(r"\s+", "", note[2])
            # these are names that --columns takes, and shows whatever the width
            asked, _, status = on_terminal(program, words + ["--columns", left_out], width)
            checks.check(status == 0 and "not shown" not in asked,
                         f"{name} --columns {left_out}: status {status}, {asked[:200]}")
    checks.check(some_left_out > 7, f"only {some_left_out} tables leave columns out")
    lens = ["lens", "double-gauss"]
    at_60, _, _ = on_terminal(program, lens, 60)
    checks.check(on_terminal(program, lens, 120, COLUMNS="60")[0] == at_60, "COLUMNS=60")
    for columns in ("", "0", "-5", "60x", "1e9"):
        checks.check(on_terminal(program, lens, 60, COLUMNS=columns)[0] == at_60,
                     f"COLUMNS='{columns}' is no width")
    checks.check(max(map(len, on_terminal(program, lens, 0)[0].split("\n"))) in range(61, 81),
                 "a terminal that does not know its width has 80 columns")
    # a pipe knows no width, and neither does a file
    plain = program.run(*lens).stdout
    checks.check(program.run(*lens, variables={"COLUMNS": "40"}).stdout == plain, "COLUMNS, pipe")
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "x.txt")
        on_terminal(program, lens + ["-o", path], 60)
        with open(path, "rb") as file:
            checks.check(file.read() == plain, "a file on a terminal of 60 columns")
    # rows that come later keep the layout of the first
    late, _, _ = on_terminal(program, ["dof", "-f", "50", "-N", "2.8", "-s", "1..700"], 40)
    table = late.split("\n\n")[0].split("\n")
    checks.check(len(table) > 700 and {len(line) for line in table[2:]} == {len(table[2])},
                 f"rows of {sorted({len(line) for line in table[2:]})} columns")


def check_blocks(checks, program):
    """A cross-table goes on below: each column once, the first one in each block."""
    words = ["dof", "-f", "50", "-N", "2.8..22/third", "-s", "1,2,3", "--table", "s,N"]
    def cells(text):
        blocks = [block.split("\n") for block in text.split("\n\n")[1:-1]]
        return [sum((re.split(r"  +", line[14:].strip()) for line in column), [])
                for column in zip(*blocks)]
    # heads hold blanks, so that the cells below them are compared
    narrow, _, _ = on_terminal(program, words, 60)
    heads = [block.split("\n")[0] for block in narrow.split("\n\n")[1:-1]]
    checks.check(len(heads) > 2 and all("distance (m)" in head for head in heads), f"{heads}")
    checks.check(cells(narrow)[1:] == cells(program.run(*words).stdout.decode())[1:],
                 "blocks hold other cells than the table")


def check_color(checks, program):
    """Colours on a terminal, unless it or somebody says no; in a pipe only if asked for."""
    table, wrong = ["lens", "double-gauss"], ["dof", "-f", "50nn"]
    warned = ["stars", "-f", "24", "-N", "2.8"]
    for words, mark in ((table, "\033[1m"), (wrong, "\033[1;31mlenscalc: dof:\033[0m bad unit"),
                        (warned, "\033[33mwarning:\033[0m the NPF rule")):
        name = " ".join(words)
        shown = "".join(on_terminal(program, words, 80, TERM="xterm")[:2])
        checks.check(mark in shown, f"{name}: no {mark!r} in {shown[:200]!r}")
        checks.check(shown.count("\033[0m") == len(re.findall("\033\\[(?!0m)", shown)),
                     f"{name}: a colour has no end")
        bare = "".join(on_terminal(program, words, 80, TERM="dumb")[:2])
        checks.check(re.sub("\033\\[[0-9;]*m", "", shown) == bare, f"{name}: colour alone differs")
        for more, variables in (([], {"NO_COLOR": "1", "TERM": "xterm"}), ([], {"TERM": "dumb"}),
                                (["--color", "never"], {"TERM": "xterm"}),
                                (["--csv"], {"TERM": "xterm"})):
            shown = on_terminal(program, words + more, 80, **variables)
            text = shown[0] if more == ["--csv"] else "".join(shown[:2])
            checks.check("\033" not in text, f"{name} {more} {variables}: {text[:200]!r}")
        checks.check("\033" in "".join(on_terminal(program, words, 80, TERM="xterm", NO_COLOR="")[:2]),
                     f"{name}: an empty NO_COLOR says nothing")
        piped = program.run(*words)
        checks.check(b"\033" not in piped.stdout + piped.stderr, f"{name}: colour in a pipe")
        always = program.run(*words, "--color=always", variables={"NO_COLOR": "1"})
        checks.check(mark in (always.stdout + always.stderr).decode(), f"{name} --color=always")
    for form in ("csv", "tsv", "json", "jsonl", "markdown", "html"):
        result = program.run(*table, "--format", form, "--color", "always")
        checks.check(result.returncode == 0 and b"\033" not in result.stdout, f"colour in {form}")
    with tempfile.TemporaryDirectory() as folder:
        for words, option in ((table, "-o"), (["draw", "double-gauss"], "-o")):
            path = os.path.join(folder, "x.svg")
            program.run(*words, option, path, "--color", "always")
            with open(path, "rb") as file:
                checks.check(b"\033" not in file.read(), f"{words} {option}: colour in a file")
    checks.check(b"'auto', 'always' or 'never'" in program.run(*table, "--color", "x").stderr or
                 program.run(*table, "--color", "x").returncode == 2, "--color x")


# What a terminal obeys: CSI in 7 and 8 bits, OSC, backspace, DEL, and marks that turn the writing.
EVIL = ["\033[31m", "\u009b31m", "\033]0;x\007", "\010", "\177", "\u202e", "\u2066", "\u200f",
        "\u061c", "\u2028"]
OBEYED = re.compile("[\0-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069]")


def check_escapes(checks, program):
    """What comes from files and words reaches no terminal raw: answers in text, all messages."""
    with tempfile.TemporaryDirectory() as folder:
        for number, evil in enumerate(EVIL):
            name = repr(evil)
            rows = f"f,N,s,note{evil}\n50,4,3,a{evil}b\n50,x{evil},3,c\n".encode()
            path = os.path.join(folder, f"rows{number}{evil}.csv")
            with open(path, "wb") as file:
                file.write(rows)
            for form in ("text", "markdown", "html"):
                result = program.run("dof", "--batch", path, "--format", form)
                for what, text in (("answer", result.stdout), ("message", result.stderr)):
                    found = OBEYED.findall(text.decode())
                    checks.check(not found, f"{form} {what} with {name} has {found}")
                checks.check(result.returncode == 3 and b"a" in result.stdout, f"{form} {name}")
            result = program.run("dof", "--batch", path, "--json")
            rows = json.loads(result.stdout)["rows"]
            checks.check(not OBEYED.findall(result.stdout.decode()) and
                         rows[0][f"note{evil}"] == f"a{evil}b", f"json with {name}")
            csv = program.run("dof", "--batch", path, "--csv").stdout.decode()
            checks.check(f"a{evil}b" in csv, f"csv changes {name}")
            for words in (["dof", "-f", f"50{evil}"], [f"dof{evil}"], ["help", evil],
                          ["dof", f"--f{evil}"], ["lens", f"x{evil}"], ["dof", "-o", f"no/{evil}"],
                          ["dof", "-f", "50", "-N", "4", "-s", "3", "-o", f"no{evil}/x"],
                          ["list", "films", f"x{evil}"], ["glass", f"N{evil}"]):
                result = program.run(*words)
                found = OBEYED.findall(result.stderr.decode())
                checks.check(result.returncode > 0 and not found, f"{words}: {found}")
    # a stray byte of that range, which terminals of 8 bits obey
    result = program.run("dof", "--batch", "-", stdin=b"f,N,s,n\n50,4,3,a\x9b31mb\n50,\x9b,3,x\n")
    checks.check(b"\x9b" not in result.stdout + result.stderr, "a stray byte 9b")
    result = program.run("dof", "--batch", "-", "--format", "markdown",
                         stdin=b"f,N,s,n\n50,4,3,<script>x|y\n")
    checks.check(rb"\<script>x\|y" in result.stdout, f"markdown: {result.stdout!r}")


def main():
    program = Program(sys.argv[1])
    checks = Checks()
    for check in (check_help, check_width, check_blocks, check_color, check_escapes):
        check(checks, program)
    checks.finish()


main()
