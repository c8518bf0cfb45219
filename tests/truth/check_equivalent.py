#!/usr/bin/env python3
"""tests/truth/check_equivalent.py - equivalent focal lengths as values, converters, crops: check_equivalent.py BUILD_DIR

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


def check_converted(checks, program):
    """Converters multiply focal length and f-number, a crop divides the sides of the sensor."""
    for f, N, k, crop in ((300, 4, 2, 1.5), (50, 1.2, 0.71, 1.6), (70, 2.8, 1.4, 1), (400, 5.6, 1.7, 2.7)):
        row = program.rows("fov", "-f", str(f), "--converter", f"{k}x", "--crop", str(crop))[0]
        checks.near("angle", f"{f} {k}x {crop}", row["diagonal_deg"],
                    2 * math.degrees(math.atan(FULL / crop / 2 / (k * f))), 1e-12 * 180)
        row = program.rows("equivalent", "-f", str(f), "-N", str(N), "--converter", f"{k}x", "--crop", str(crop))[0]
        for column, value in (("combined_focal_mm", k * f), ("combined_fnumber", k * N), ("equal_focal_mm", k * f * crop),
                              ("equal_fnumber", k * N * crop), ("crop_factor", crop), ("focal_mm", f), ("fnumber", N)):
            checks.near(column, f"{f} {k}x {crop}", row[column], value, 1e-12 * abs(value))
    # 1.4 x 300 mm, 1.4 x f/4; four thirds have half the diagonal of 35 mm film: 2 x 420 mm
    row = program.rows("equivalent", "-f", "300", "-N", "4", "--converter", "1.4x", "--sensor", "4/3")[0]
    for column, value, tolerance in (("combined_focal_mm", 420, 1e-9), ("combined_fnumber", 5.6, 1e-9),
                                     ("equal_focal_mm", 840, 1)):
        checks.near(column, "300 mm with 1.4x", row[column], value, tolerance)
    # the part of a named sensor, from near by: the angle is that of a sensor so large
    for words in ("-f 35 -s 40cm", "-f 8 --projection equisolid"):
        part = program.rows("fov", *words.split(), "--sensor", "23.5x15.6mm", "--crop", "1.25")[0]
        small = program.rows("fov", *words.split(), "--sensor", "18.8x12.48mm")[0]
        for column, value in small.items():
            checks.check(is_same(part[column], value), f"{words} {column}: {part[column]} {value}")


def check_refused(checks, program):
    for words, said in (("dof -f 26mm-eq -N 2 -s 2", "needs --sensor"),
                        ("focus -f 26mm-eq -s 2", "needs --sensor"),
                        ("dof -f -26mm-eq -N 2 -s 2 --sensor 1in", "above 0"),
                        ("dof -f 0mm-eq -N 2 -s 2 --sensor 1in", "above 0"),
                        ("dof -f 24mm-eq,7mm -N 2 -s 2 --sensor 1in", "or none"),
                        ("dof -f 24mm..70mm-eq -N 2 -s 2 --sensor 1in", "bad range"),
                        ("fov -f 50 --crop 0.8 --sensor aps-c", "below 1"),
                        ("fov -f 50 --crop 0", "above 0"),
                        ("fov --horizontal 40 --converter 2x", "--converter needs"),
                        ("fov -f 50 -s 2 --from sensor --converter 2x", "without --converter"),
                        ("fov --lens double-gauss --converter 2x --projection chief-rays", "excludes --converter"),
                        ("fov --lens double-gauss --converter 2x --exact", "exclude each other"),
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
    check_converted(checks, program)
    check_refused(checks, program)
    check_doubts(checks, program)
    checks.finish()


if __name__ == "__main__":
    main()
