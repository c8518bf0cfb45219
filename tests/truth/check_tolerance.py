#!/usr/bin/env python3
"""tests/truth/check_tolerance.py - lenses of trials against what was written of them:
check_tolerance.py BUILD_DIR

200 lenses as they may be made, of ten designs, are written as files, read again, and looked at by
spot; of some also by wavefront, lens and distortion. The figures are those of the trials.
"""
# SPDX-License-Identifier: MIT

import csv
import glob
import io
import os
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program

# with aspheres, catalogue glasses, model glasses, positions, a cemented triplet
LENSES = ("double-gauss", "double-gauss-50", "cooke-triplet-50", "brendel-tessar-100",
          "phone-80deg", "canon-ef50-f18", "itoh-zoom-100-146", "laikin91-telephoto",
          "rudolph-planar-100", "cs348b-wide-22")
TRIALS = 20
# of the lens, mm: what is left of doubles after a dozen surfaces, whatever size a spot has
ROUNDING = 2e-12
RAYS = ["--no-clip", "--pattern", "gauss", "--rays", "12"]


def rows_of(program, folder, *words):
    result = subprocess.run([*program.command, *words], cwd=folder, text=True, check=False,
                            capture_output=True, env=program.environment())
    if result.returncode != 0:
        return None, result.stderr
    return list(csv.DictReader(io.StringIO(result.stdout))), ""


def marks(count, media):
    """Every kind of error that a file can hold."""
    glasses = "".join(f"tolerance n{i} 0.001\n" for i in media)
    return (f"tolerance R1..R{count} 0.2%\ntolerance t1..t{count - 1} 0.02\n{glasses}"
            f"tolerance elements 1..{count} tilt 2arcmin\n"
            f"tolerance elements 1..{count} decenter 0.02\n"
            f"tolerance surface 1..{count} tilt 1arcmin normal\n")


def check_lens(program, checks, folder, name):
    surfaces, message = rows_of(program, folder, "surfaces", name, "--csv")
    if not checks.check(surfaces, f"{name}: {message}"):
        return
    count = max(int(row["surface"]) for row in surfaces)
    media = sorted({int(row["surface"]) for row in surfaces
                    if row["medium"] not in ("air", "mirror", "1")})
    with open(os.path.join(folder, "marks.txt"), "w", encoding="ascii") as file:
        file.write(marks(count, media))
    words = [name, "--tolerances", "marks.txt", "--trials", str(TRIALS), "--aim", "stop", "--of",
             "each", "--show", "trials", "--save", f"worst:{TRIALS}", "-o", "made.lens", "--force",
             "--csv", *RAYS]
    trials, message = rows_of(program, folder, "tolerance", *words)
    if not checks.check(trials, f"{name}: {message}"):
        return
    files = sorted(glob.glob(os.path.join(folder, "made-*.lens")))
    checks.check(len(files) == TRIALS, f"{name}: {len(files)} lenses were written")
    for path in files:
        with open(path, encoding="utf-8") as file:
            number = next(line.split()[5] for line in file if line.startswith("note        as made"))
        wanted = [row for row in trials if row["trial"] == number]
        position = ["--position", "all"] if wanted[0]["position"] else []
        found, message = rows_of(program, folder, "spot", path, *position, "--csv",
                                 *RAYS)
        if not checks.check(found and len(found) == len(wanted),
                            f"{name}, trial {number}: {message}"):
            continue
        for row, spot in zip(wanted, found):
            allowed = 1e-12 * float(spot["rms_um"]) + 1e3 * ROUNDING
            checks.near("spot", f"{name}, trial {number}, {row['of']} {row['position']}",
                        row["figure"], spot["rms_um"], allowed)


def main():
    program, checks = Program(sys.argv[1]), Checks()
    for name in LENSES:
        with tempfile.TemporaryDirectory(prefix="lenscalc-tolerance-") as folder:
            check_lens(program, checks, folder, name)
    for kind, (share, where) in checks.worst.items():
        print(f"{kind}: {share:.2g} of what is allowed at {where}")
    checks.finish()


if __name__ == "__main__":
    main()
