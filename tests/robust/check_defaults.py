#!/usr/bin/env python3
"""tests/robust/check_defaults.py - defaults of a configuration spoil no question that is typed.

The examples of every command that answers in rows are asked with defaults of what photographers have
at hand: a sensor, a lens, f-number, distance and the like. Each has its answer as without them, if
perhaps another one: a default gives way to what is typed, and where a question solves for it.
"""
# SPDX-License-Identifier: MIT

import os
import re
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program

DEFAULTS = {
    "usual": "sensor = Fuji X-T5\nunits = imperial\ndigits = 5\nthreads = 1\ncoc = 20um\n"
             "[exposure]\niso = 400\n",
    "solved": "aperture = 8\ndistance = 3m\nlens = double-gauss\nwavelength = d\n",
}
GROUPS = ("photography", "one surface, one lens", "a lens", "data")


def main():
    program, checks = Program(sys.argv[1]), Checks()
    rows = program.rows("list", "commands")
    with tempfile.TemporaryDirectory(prefix="lenscalc-defaults-") as folder:
        for name, text in DEFAULTS.items():
            with open(os.path.join(folder, name + ".conf"), "w", encoding="utf-8") as file:
                file.write(text)
        for command in (row["command"] for row in rows if row["group"] in GROUPS):
            shown = re.sub(r"\\\n *", "", program.run(command, "--help").stdout.decode())
            questions = re.findall(rf"^  lenscalc ({command} .*)$", shown, re.M)
            checks.check(questions, f"{command} --help has no examples")
            for question in questions:
                for name in DEFAULTS:
                    own = tempfile.mkdtemp(dir=folder)
                    result = program.shell(f"export LENSCALC_CONFIG=../{name}.conf\n"
                                           f"lenscalc {question}", own)
                    # 3: a flash is too weak for some rows of a sweep at the distance of the default
                    checks.check(result.returncode in (0, 3), f"lenscalc {question}, {name}: status "
                                 f"{result.returncode}, {result.stderr.decode()[:300]!r}")
    checks.finish()


main()
