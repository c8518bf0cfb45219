#!/usr/bin/env python3
"""tests/truth/check_glass_names.py - every glass of lensdb in files of other programs.

A lens of many surfaces, each of another glass, is written and read again in each format that names
glasses: as the glass of a surface, and as one that the positions change, where the format keeps
these. Behind it stand the same glasses of the same catalogues.
"""
# SPDX-License-Identifier: MIT

import os
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program

AT_ONCE = 200  # glasses of a lens
D = 587.5618  # nm
# names that mean another material in Zemax's catalogue; only nd and Vd beside them tell
ZEMAX_HOMONYMS = ("MISC:PMMA", "MISC:WATER")
# what keeps a glass, and one that the positions change
OF_SURFACES, OF_POSITIONS = ("lens", "zmx", "seq", "len", "json"), ("lens", "zmx", "seq")


def glass_groups(program):
    """(wavelength, glasses) of one catalogue each: homonyms would refuse a file of several."""
    groups = {}
    for row in program.rows("list", "glasses"):
        if not row["from_nm"]:  # without a formula
            continue
        shortest, longest = float(row["from_nm"]), float(row["to_nm"])
        wave = D if shortest <= D <= longest else (shortest + longest) / 2
        groups.setdefault((row["catalog"], wave), []).append(f"{row['catalog']}:{row['glass']}")
    for (_, wave), names in sorted(groups.items()):
        for first in range(0, len(names), AT_ONCE):
            yield wave, names[first:first + AT_ONCE]


def lens_of(wave, glasses):
    lines = [f"wavelength {wave!r}nm", "object inf", "aperture epd 1"]
    lines += [f"surface - 1 {glass} -" for glass in glasses] + ["stop - 1 air -"]
    return "\n".join(lines) + "\n"


def lens_of_positions(wave, glasses):
    lines = [f"wavelength {wave!r}nm", "object inf", "aperture epd 1", "position one two",
             "stop - 1 air -"]
    lines += [f"surface - 1 {glass} -" for glass in glasses]
    seconds = ["air"] + glasses
    lines += [f"set glass{i + 2} {glass} {seconds[i]}" for i, glass in enumerate(glasses)]
    return "\n".join(lines + ["surface - 1 air -"]) + "\n"


def media_of(program, path):
    """The media of a file in its order, as lenscalc has them; what it says where it cannot."""
    result = program.run("convert", path, "--to", "lens")
    if result.returncode != 0:
        return result.stderr.decode()[:400]
    lines = [line.split() for line in result.stdout.decode().splitlines()]
    media = [line[3] for line in lines if line[0] in ("surface", "stop")]
    return media + [" ".join(line[1:]) for line in lines if line[0] == "set"]


def check_file(checks, program, kind, text):
    path = os.path.join(program.holder.name, "glasses.lens")
    other = os.path.join(program.holder.name, "other." + kind)
    with open(path, "w") as file:
        file.write(text)
    written = program.run("convert", path, "-o", other, "--force")
    if not checks.check(written.returncode == 0, f"{kind}: {written.stderr.decode()[:400]}"):
        return
    there, back = media_of(program, path), media_of(program, other)
    if checks.check(isinstance(back, list) and len(back) == len(there), f"{kind}: {back}"):
        for expected, read in zip(there, back):
            checks.check(expected == read, f"{kind}: {expected} is {read}")


def check_refused(checks, program, glass):
    """A configuration has the name of its glass alone."""
    result = program.run("convert", "-", "--to", "zmx", stdin=lens_of_positions(D, [glass]))
    checks.check(result.returncode == 4 and b"would be read with MISC:" in result.stderr,
                 f"{glass} in a configuration: {result.returncode} {result.stderr.decode()[:300]}")


def main():
    checks, program = Checks(), Program(sys.argv[1])
    count = 0
    for wave, glasses in glass_groups(program):
        count += len(glasses)
        for kind in OF_SURFACES:
            check_file(checks, program, kind, lens_of(wave, glasses))
        for kind in OF_POSITIONS:
            some = [glass for glass in glasses if kind != "zmx" or glass not in ZEMAX_HOMONYMS]
            check_file(checks, program, kind, lens_of_positions(wave, some))
    for glass in ZEMAX_HOMONYMS:
        check_refused(checks, program, glass)
    checks.check(count > 2000, f"{count} glasses")
    checks.finish()


if __name__ == "__main__":
    main()
