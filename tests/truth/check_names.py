#!/usr/bin/env python3
"""tests/truth/check_names.py - the names of all glasses through lens files: check_names.py BUILD_DIR

Every glass of every catalogue, written in each format and read again, is the glass of that maker:
all of a catalogue in one lens, and those that several catalogues call the same (but for case,
blanks, '-' and '_') side by side. What a format cannot hold is refused by name, never another glass.
"""
# SPDX-License-Identifier: MIT

import glob
import os
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import EVERYTHING, ROOT, Checks

FORMATS = ("lens", "zmx", "seq", "len", "json")
MOST = 300  # surfaces of one lens
D = 0.5875618


def catalogues():
    """catalogue -> [(name, a wavelength that its formula has)]"""
    found = {}
    for path in sorted(glob.glob(os.path.join(ROOT, "lensdb/glass/*.tsv"))):
        with open(path, encoding="utf-8") as stream:
            rows = [line.rstrip("\n").split("\t") for line in stream if not line.startswith("#")]
        head = rows[0]
        glasses = found[os.path.basename(path)[:-4]] = []
        for row in rows[1:]:
            cells = dict(zip(head, row))
            low, high = (float(cells[key]) if cells[key] != "-" else D for key in ("from_um", "to_um"))
            glasses.append((cells["name"].replace(" ", ""), D if low <= D <= high else high))
    return found


def convert(program, words):
    result = subprocess.run([program, "convert", *words], stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, timeout=120)
    return result.returncode, result.stdout.decode(), result.stderr.decode()


def through(program, folder, form, glasses, wave):
    """What the glasses are after a file of this format; a text where that is refused."""
    lens = "".join(f"surface - 1 {glass} -\n" for glass in glasses)
    source, target = os.path.join(folder, "a.lens"), os.path.join(folder, f"b.{form}")
    with open(source, "w", encoding="utf-8") as file:
        file.write(f"wavelength {wave}um\nfocus table\naperture epd 1\nstop - 1 air -\n{lens}"
                   "surface -50 90 air -\n")
    status, _, error = convert(program, [source, "-o", target])
    if status != 0:
        return error
    status, out, error = convert(program, [target])
    media = [line.split()[3] for line in out.splitlines() if line.startswith("surface")]
    return media[:-1] if status == 0 else error


def check_catalogue(checks, program, folder, catalog, glasses):
    by_wave = {}
    for name, wave in glasses:
        by_wave.setdefault(wave, []).append(f"{catalog}:{name}")
    for form in FORMATS:
        for wave, names in by_wave.items():
            for at in range(0, len(names), MOST):
                part = names[at:at + MOST]
                back = through(program, folder, form, part, wave)
                wrong = back if isinstance(back, str) else [
                    f"{a} is {b}" for a, b in zip(part, back) if a != b]
                checks.check(back == part, f"{catalog} through {form}: {wrong}")


def check_homonyms(checks, program, folder, found):
    by_key = {}
    for catalog, glasses in found.items():
        for name, wave in glasses:
            key = name.lower().replace("-", "").replace("_", "")
            by_key.setdefault(key, []).append((f"{catalog}:{name}", wave))
    several = [group for group in by_key.values() if len(group) > 1]
    checks.check(len(several) > 100, f"{len(several)} names of several glasses")
    refused = asked = 0
    for number, group in enumerate(several):
        names = [name for name, _ in group]
        wave = max(wave for _, wave in group)
        for form in FORMATS if EVERYTHING else FORMATS[number % 3::3]:
            asked += 1
            back = through(program, folder, form, names, wave)
            said = isinstance(back, str) and ("would be read with" in back or "range of" in back)
            refused += said
            checks.check(back == names or said, f"{names} through {form}: {back}")
    print(f"{len(several)} names of several glasses, {refused} files of {asked} refused")


def main():
    program = os.path.join(os.path.abspath(sys.argv[1]), "lenscalc")
    checks, found = Checks(), catalogues()
    checks.check(len(found) == 16 and sum(map(len, found.values())) == 2862, "16 catalogues")
    with tempfile.TemporaryDirectory() as folder:
        # check_glass_names sends them through as lenscalc lists them
        for catalog, glasses in found.items() if EVERYTHING else ():
            check_catalogue(checks, program, folder, catalog, glasses)
        check_homonyms(checks, program, folder, found)
    checks.finish()


if __name__ == "__main__":
    main()
