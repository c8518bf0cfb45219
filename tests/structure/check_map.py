#!/usr/bin/env python3
"""tests/structure/check_map.py - is src/README, the map of the house, true of the house?

Its table of folders is the table of layers that check_structure.py holds; every path it names
exists; every folder of src stands in it; a room includes only rooms above its line; a folder of
more than MANY files has a file to open first.
"""
# SPDX-License-Identifier: MIT

import glob
import os
import re
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from check_structure import LAYERS
from harness import ROOT, Checks

MANY = 10  # files in a folder
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.M)


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def tables_of(text):
    """The rows of each table, as lists of cells, without its head."""
    tables = []
    for block in re.findall(r"(?:^\|.*\n)+", text, re.M):
        rows = [[cell.strip(" `") for cell in line.strip("|").split(" | ")]
                for line in block.splitlines()]
        tables.append(rows[2:])
    return tables


def check_layers(checks, folders):
    listed = {row[0]: row[3] for row in folders}
    expected = {folder: "all" if may is None else " ".join(may) or "-"
                for folder, may in LAYERS.items() if folder}
    for folder in sorted(listed | expected):
        checks.check(listed.get(folder) == expected.get(folder),
                     f"src/README: {folder} may include {listed.get(folder)}, by the table of "
                     f"layers {expected.get(folder)}")


def check_paths(checks, text):
    for path in sorted(set(re.findall(r"`([\w/]+(?:\.\w+)?)`", text))):
        if "/" in path or path.endswith((".c", ".h")):
            checks.check(os.path.exists(os.path.join("src", path)) or os.path.exists(path) or
                         "NAME" in path, f"src/README: there is no {path}")


def check_rooms(checks, rooms):
    order = {row[0]: i for i, row in enumerate(rooms)}
    for path in sorted(glob.glob("src/**/*.[ch]", recursive=True)):
        room = os.path.dirname(path)[4:]
        if room not in order:
            continue
        for target in INCLUDE.findall(read(path)):
            other = os.path.dirname(target)
            if other.split("/")[0] == room.split("/")[0] and other != room:
                checks.check(order.get(other, len(order)) < order[room],
                             f"{path}: {room} may not include {target}: its room is above")


def main():
    os.chdir(ROOT)
    checks = Checks()
    text = read("src/README")
    folders, rooms, others = tables_of(text)
    check_layers(checks, folders)
    check_paths(checks, text)
    check_rooms(checks, rooms)
    first = {row[0]: row[2] for row in folders + rooms + others}
    for folder in sorted({os.path.dirname(path)[4:]
                          for path in glob.glob("src/**/*.c", recursive=True)} - {""}):
        checks.check(folder in first, f"src/README does not tell what {folder} is")
        files = glob.glob(f"src/{folder}/*.[ch]*")
        opened = first.get(folder, "")
        checks.check(len(files) <= MANY or opened.startswith(folder.split("/")[0] + "/"),
                     f"src/README does not tell which file of {folder} to open first")
    checks.finish()


if __name__ == "__main__":
    main()
