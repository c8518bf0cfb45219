#!/usr/bin/env python3
"""tests/truth/check_equivalent.py - equivalent focal lengths as values: check_equivalent.py BUILD_DIR

A length of E mm-eq has on a sensor of diagonal d the real length E d/hypot(36, 24): the same diagonal
angle as E has on 36 x 24 mm.
"""
# SPDX-License-Identifier: MIT

import math
import os
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program

FULL = math.hypot(36, 24)
PHONE, DRONE = ("iphone 15 pro", 9.76, 7.32), ("DJI Mini 4 Pro", 9.83, 7.37)
# every photographic command with a focal length and a sensor -> what else it is asked
COMMANDS = {
    "dof": "-N 2 -s 2", "hyperfocal": "-N 2", "fov": "-s 10m", "motion": "-s 10 --speed 5km/h",
    "stars": "-N 2", "equivalent": "-N 2", "tilt": "-N 8 --tilt 2 -s 1",
    "panorama": "--distance 3", "diffraction": "-N 2",
}


def real(equivalent, width, height):
    return equivalent * math.hypot(width, height) / FULL


def is_same(said, value):
    try:
        return math.isclose(float(said), float(value), rel_tol=1e-11)
    except ValueError:
        return said == value


def check_commands(checks, program):
    name, width, height = PHONE
    for command, more in COMMANDS.items():
        words = [command, *more.split(), "--sensor", name]
        rows = program.rows(*words, "-f", "26mm-eq")
        plain = program.rows(*words, "-f", repr(real(26, width, height)) + "mm")
        if checks.check(not isinstance(rows, str) and not isinstance(plain, str), f"{command}: {rows}"):
            for column, value in plain[0].items():
                checks.check(is_same(rows[0][column], value), f"{command} {column}: {rows[0][column]} {value}")
        said = program.run(*words, "-f", "26mm-eq").stdout.decode().replace("\n", " ")
        checks.check("equivalent focal length 26 mm" in said, f"{command} does not state it: {said}")


def check_angles(checks, program):
    """The diagonal angle is that of the length on 36 x 24 mm."""
    for sensor in ("35mm", "aps-c", "4/3", "1in", "645", PHONE[0], DRONE[0], "10x8mm"):
        for equivalent in (13, 24, 85):
            row = program.rows("fov", "-f", f"{equivalent}mm-eq", "--sensor", sensor)[0]
            checks.near("angle", f"{equivalent}mm-eq on {sensor}", row["diagonal_deg"],
                        2 * math.degrees(math.atan(FULL / 2 / equivalent)), 1e-12 * 180)


def check_many(checks, program):
    """Lists, ranges and the cells of batches."""
    name, width, height = DRONE
    for values, expected in (("24,48,70mm-eq", (24, 48, 70)), ("24..28mm-eq:2", (24, 26, 28)), ("24..70mm-eq#3", (24, 47, 70))):
        rows = program.rows("dof", "-N", "4", "-s", "2", "-f", values, "--sensor", name)
        lengths = [real(mm, width, height) for mm in expected]
        if checks.check(len(rows) == len(lengths), f"{values}: {rows}"):
            for row, length in zip(rows, lengths):
                checks.near("f", values, row["focal_mm"], length, 1e-14 * 26)
    text = f"f,s,sensor\n26mm-eq,2,{PHONE[0]}\n24mm-eq,3,{name}\n7,2,{name}\n"
    rows = program.rows("dof", "-N", "2", "--batch", "-", text=text)
    for row, length in zip(rows, (real(26, *PHONE[1:]), real(24, width, height), 7)):
        checks.near("f", "cell", row["focal_mm"], length, 1e-14 * 26)
    text = "f\n26mm-eq\n7\n26mm-eq\n8\n"  # nothing is left over from the row before
    rows = program.rows("dof", "-N", "2", "-s", "2", "--sensor", name, "--batch", "-", text=text)
    for row, length in zip(rows, (real(26, width, height), 7, real(26, width, height), 8)):
        checks.near("f", "cell", row["focal_mm"], length, 1e-14 * 26)


def check_refused(checks, program):
    for words, said in (("dof -f 26mm-eq -N 2 -s 2", "needs --sensor"),
                        ("focus -f 26mm-eq -s 2", "needs --sensor"),
                        ("dof -f -26mm-eq -N 2 -s 2 --sensor 1in", "above 0"),
                        ("dof -f 0mm-eq -N 2 -s 2 --sensor 1in", "above 0"),
                        ("dof -f 24mm-eq,7mm -N 2 -s 2 --sensor 1in", "or none"),
                        ("dof -f 24mm..70mm-eq -N 2 -s 2 --sensor 1in", "bad range"),
                        ("dof -f 50 -N 2 -s 26mm-eq", "unexpected text")):
        result = program.run(*words.split())
        checks.check(result.returncode in (1, 2) and said in result.stderr.decode(),
                     f"{words}: {result.returncode} {result.stderr.decode()[:120]}")


def check_doubts(checks, program):
    """What a phone or drone cannot have is answered, with both readings beside it."""
    for words, reading in (("dof -f 26mm -N 2 -s 2", "26mm-eq (7.331 mm)"),
                           ("fov -f 24mm", "24mm-eq (6.767 mm)"), ("fov -f 13mm", "13mm-eq"),
                           ("dof -f 6.9 -N 2 -s 2", None), ("fov -f 9", None)):
        result = program.run(*words.split(), "--sensor", PHONE[0])
        said = result.stdout.decode().replace("\n", " ")
        checks.check(result.returncode == 0 and ("-eq" in said) == (reading is not None) and
                     (reading or "") in said, f"{words}: {said}")
    for sensor in ("35mm", "1in", "Zenmuse X7", "Sony RX100"):
        said = program.run("fov", "-f", "50", "--sensor", sensor).stdout.decode()
        checks.check("-eq" not in said, f"50 mm on {sensor} is doubted: {said}")


def main():
    checks, program = Checks(), Program(sys.argv[1])
    check_commands(checks, program)
    check_angles(checks, program)
    check_many(checks, program)
    check_refused(checks, program)
    check_doubts(checks, program)
    checks.finish()


if __name__ == "__main__":
    main()
