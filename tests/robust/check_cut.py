#!/usr/bin/env python3
"""tests/robust/check_cut.py - lens files that were cut short, as by a download that broke.

Files of every kind are cut behind lines and inside of them. What is left is refused, or read with a
warning that it may be cut short, or it is the same lens. A list of surfaces that ends behind one of
them, with air there, is a list too where the format has no end: .lens, and .dat of other programs.
"""
# SPDX-License-Identifier: MIT

import csv
import io
import os
import random
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program

LENSES = ("double-gauss", "aspheric-singlet", "nikkor-z-14-24", "schmidt-cassegrain")
KINDS = ("zmx", "seq", "len", "dat", "json", "lens")
ENDLESS = ("lens", "dat")  # formats without a last word
INSIDE = 60  # places inside of lines, of each file
NOTES = ("note ", "source ", "kind ", "lens ", "#", "stated ")


def cuts(chance, text):
    """(place, is it behind a line) of a file: behind each line and at random places."""
    behind = [i + 1 for i, byte in enumerate(text) if byte == 10]
    inside = [i for i in range(1, len(text) - 1) if text[i - 1] != 10]
    places = {(place, True) for place in behind[:-1]}
    return sorted(places | {(place, False) for place in chance.sample(inside, min(INSIDE, len(inside)))})


def ends_in_air(kind, text):
    """Is air behind the last surface of a list?"""
    words = text.splitlines()[-1].decode().split()
    return words[2] in ("0", "1") if kind == "dat" else "air" in words


def lens_of(program, path):
    """What the lens is, without what is told about it."""
    result = program.run("convert", path, "--to", "lens")
    lines = result.stdout.decode("utf-8", "replace").splitlines()
    return [line for line in lines if not line.startswith(NOTES)]


def check_file(checks, program, name, kind, text, chance):
    folder = os.path.join(program.holder.name, f"{name}-{kind}")
    os.mkdir(folder)
    whole = os.path.join(program.holder.name, f"whole.{kind}")
    with open(whole, "wb") as file:
        file.write(text)
    there = lens_of(program, whole)
    places = cuts(chance, text)
    for place, _ in places:
        with open(os.path.join(folder, f"{place:06}.{kind}"), "wb") as file:
            file.write(text[:place])
    table = program.run("convert", "--check", "--files", folder, "--csv", timeout=120)
    rows = {row["file"]: row for row in csv.DictReader(io.StringIO(table.stdout.decode()))}
    for place, is_behind in places:
        path = os.path.join(folder, f"{place:06}.{kind}")
        row = rows[path]
        told = row["status"] != "read" or "cut short" in row["reasons"]
        if not told:
            is_list = is_behind and kind in ENDLESS and ends_in_air(kind, text[:place])
            told = is_list or lens_of(program, path) == there
        checks.check(told, f"{name}.{kind}, {place} of {len(text)} bytes, ..."
                           f"{text[max(0, place - 30):place]!r}: {row['reasons']!r}")


def main():
    checks, program = Checks(), Program(sys.argv[1])
    chance = random.Random(16)
    for name in LENSES:
        for kind in KINDS:
            text = program.run("convert", name, "--to", kind, "--lossy").stdout
            if text:
                check_file(checks, program, name, kind, text, chance)
    checks.finish()


if __name__ == "__main__":
    main()
