#!/usr/bin/env python3
"""tests/terminal/check_terminal.py - what the program does where somebody looks at a terminal.

Help within 80 columns.
"""
# SPDX-License-Identifier: MIT

import os
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program

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


def main():
    program = Program(sys.argv[1])
    checks = Checks()
    check_help(checks, program)
    checks.finish()


main()
