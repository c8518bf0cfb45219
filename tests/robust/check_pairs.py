#!/usr/bin/env python3
"""tests/robust/check_pairs.py - all pairs of options of every command: check_pairs.py BUILD_DIR

An option more is another answer, or a refusal, as pairs.py has it, which holds the questions. They
take minutes: in make check-all.
"""
# SPDX-License-Identifier: MIT

import os
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import NEED_SOLVER, Checks, Program
import pairs


def main():
    checks, program = Checks(), Program(sys.argv[1])
    groups = {row["command"]: row["group"] for row in program.rows("list", "commands")}
    photographic = {command for command, group in groups.items() if group == "photography"}
    checks.check(photographic == set(pairs.PHOTOGRAPHIC), f"photography: {photographic}")
    bases = {**pairs.PHOTOGRAPHIC, **pairs.OTHERS}
    missing = set(groups) - set(bases) - pairs.WITHOUT
    checks.check(not missing, f"no questions for the pairs of {missing}")
    for command, questions in pairs.EXACT.items():
        bases[command] += questions
    for command in bases:
        if command not in groups or (command in NEED_SOLVER and not program.has_solver()):
            continue
        options = [(row["option"][2:], row["value"] != "")
                   for row in program.rows("list", "options", command) if row["command"] == command]
        without = pairs.without_value(command, options)
        checks.check(not without, f"{command}: no value to try for {without}")
        silent, asked = pairs.silent_pairs(program, command, bases[command], options)
        checks.passed += asked - len(silent)
        for question, beside, option in silent:
            checks.check(False, f"{command} {question} {beside}: {option} says nothing")
    checks.finish()


main()
