#!/usr/bin/env python3
"""tests/truth/check_divided.py - pieces of pictures: check_divided.py BUILD_DIR

A crop has the pixels of the whole picture, to the bit, whatever is made of them.
"""
# SPDX-License-Identifier: MIT

import os
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import pictures
from harness import Checks, Program

SIZE = 70, 41
# left, top, width and height: within one tile, over several, at the edges, odd and even
CROPS = [(17, 9, 5, 3), (10, 5, 41, 23), (0, 0, 33, 9), (45, 24, 25, 17), (69, 40, 1, 1)]
COMMON = ["chart:star", "--lens", "double-gauss-50", "-s", "1m", "--size", "70x41", "--samples",
          "2", "-t", "1/400"]
SENSOR = ["--noise", "--read-noise", "3", "--pitch", "4um"]
# options and ending of a file
KINDS = [([], ".pfm"), ([], ".png"), (["--bits", "16", *SENSOR], ".png"),
         ([*SENSOR, "--mosaic", "grbg"], ".png"), ([*SENSOR, "--mosaic", "bggr", "--raw"], ".png"),
         (["--white", "tungsten"], ".png")]


class Folder:
    """Where the program runs, and what came of it."""

    def __init__(self, program, checks, path):
        self.program, self.checks, self.path = program, checks, path

    def run(self, *words):
        return subprocess.run([*self.program.command, *words], cwd=self.path, text=True,
                              capture_output=True, env=self.program.environment())

    def good(self, *words):
        result = self.run(*words)
        self.checks.check(result.returncode == 0, f"{words}: {result.stderr}")
        return result

    def read(self, name):
        with open(os.path.join(self.path, name), "rb") as file:
            return file.read()


def pixels_of(data):
    """Lines of a PFM or PNG from the top, and bytes a pixel."""
    if data[:2] != b"PF":
        return pictures.lines_of(data)
    _, size, _, values = data.split(b"\n", 3)
    width, height = map(int, size.split())
    return [values[12 * width * y:12 * width * (y + 1)] for y in reversed(range(height))], 12


def check_crops(folder):
    for options, ending in KINDS:
        folder.good("render", *COMMON, *options, "-o", "whole" + ending)
        lines, step = pixels_of(folder.read("whole" + ending))
        folder.checks.check((len(lines[0]) // step, len(lines)) == SIZE, f"{options}: its size")
        for left, top, width, height in CROPS:
            crop = f"{left}:{top}:{width}x{height}"
            folder.good("render", *COMMON, *options, "--crop", crop, "-o", "crop" + ending)
            found, _ = pixels_of(folder.read("crop" + ending))
            expected = [line[step * left:step * (left + width)]
                        for line in lines[top:top + height]]
            folder.checks.check(found == expected, f"{options} {ending}: the crop {crop} differs")


def check_pattern(folder):
    """Raw numbers from an odd pixel on begin with another colour of the mosaic."""
    for left, top, pattern in (0, 0, "rggb"), (1, 0, "grbg"), (0, 1, "gbrg"), (1, 1, "bggr"):
        folder.good("render", *COMMON, "--mosaic", "rggb", "--raw", "--crop",
                    f"{left}:{top}:4x4", "-o", "raw.png")
        found = f"CFA pattern\0{pattern}".encode() in folder.read("raw.png")
        folder.checks.check(found, f"the mosaic from {left}:{top} on is not {pattern}")


def main():
    program, checks = Program(sys.argv[1]), Checks()
    with tempfile.TemporaryDirectory(prefix="lenscalc-divided-") as path:
        folder = Folder(program, checks, path)
        check_crops(folder)
        check_pattern(folder)
    return checks.finish()


if __name__ == "__main__":
    sys.exit(main())
