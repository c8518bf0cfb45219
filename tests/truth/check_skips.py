#!/usr/bin/env python3
"""tests/truth/check_skips.py - what lenscalc render does without: check_skips.py BUILD_DIR

Each picture is taken with a skip, and by --no-skip without it; both are compared with many more
rays without any. The skip must have been used, may change neither the light of the whole nor that
of its parts by more than noise, and may leave about as much noise as all rays do.
"""
# SPDX-License-Identifier: MIT

import math
import os
import re
import struct
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import EVERYTHING, Checks, Program

# skip: what --explain says where it was used, scene
CASES = {
    "uniform": [(r"uniform: [1-9]", "chart:edge --lens double-gauss-50 -s 1m --size 96x64"),
                (r"uniform: [1-9]", "white.pfm --depth-map far.pfm --hidden nearby "
                                    "--lens cs348b-dgauss-50 -s 1m --size 48x32 --acceptance 2"),
                (r"uniform: [1-9]", "sky.scene --lens double-gauss-50 --size 80x56"),
                (r"uniform: [1-9]", "specks.scene --lens double-gauss-50 --size 48x32")],
    "blur": [(r"blur: .* in [1-9]", "chart:star --lens double-gauss-50 -s 1m -N 16 --size 64x48"),
             (r"blur: .* in [1-9]", "grey.pfm --lens double-gauss-50 -s 1m -N 16 --size 480x320 "
                                    "--crop 208:136:64x48 --samples 32"),
             (r"blur: .* in [1-9]", "chart:wedge --lens wide-35 -s 1m -N 16 --size 64x48 --band 20")],
    "pupil": [(r"pupil: .*: 9", "chart:checker --lens double-gauss-50 -s 1m --size 48x32")],
    "colour": [(r"colour: all", "room.scene --lens double-gauss-50 --size 32x24 --model thick"),
               (r"colour: 32 bands, .*: one pass", "room.scene --lens double-gauss-50 --size 32x24 "
                                                   "--model thick --spectral"),
               # colours that the lens sends nearly the same way: all, in the corner, of what moves
               (r"one for all in 12 of 12", "room.scene --lens double-gauss-50 --size 48x32"),
               (r"one for all in [1-9]", "cards.scene --lens canon-ef35-f2 -N 11 --size 720x480 "
                                         "--crop 640:16:64x48 --bounces 0"),
               (r"one for all in 12 of 12", "field.scene --lens double-gauss-50 --size 48x32")],
    "time": [(r"time: all rays", "room.scene --lens double-gauss-50 --size 32x24")],
    "secondary": [(r"secondary: light that shines alone", "lamps.scene --lens double-gauss-50 "
                                                          "--size 32x24")],
    # out of focus, one moves; through a slit and blades; of many colours
    "lamps": [(r"lamps: [23] by [1-9]", "bulbs.scene --lens double-gauss-50 --size 48x32"),
              (r"lamps: [23] by [1-9]", "bulbs.scene --lens double-gauss-50 --size 48x32 --blades 5 "
                                     "--shutter focal --travel-time 12ms --curtain-distance 2mm"),
              (r"lamps: [23] by [1-9]", "bulbs.scene --lens double-gauss-50 --size 48x32 --spectral "
                                     "--acceptance 9")],
}
# the same skips elsewhere, too long for every day
MORE = {
    "uniform": [(r"uniform: [1-9]", "chart:points --lens double-gauss-50 -s 1m --size 96x64 "
                                    "--blades 7 --samples 16 --field-width 200mm"),
                (r"uniform: [1-9]", "chart:edge --lens double-gauss-50 -s 1m --size 96x64 "
                                    "--shutter leaf --opening-time 9ms --samples 16"),
                (r"uniform: [1-9]", "field.scene --lens double-gauss-50 --size 80x56 --bounces 0"),
                (r"uniform: [1-9]", "around.scene --lens double-gauss-50 --size 80x56 --bounces 0")],
    "blur": [(r"blur: .* in [1-9]", "grey.pfm --depth-map far.pfm --lens double-gauss-50 -s 1m -N 32 "
                                    "--size 64x48"),
             (r"blur: .* in [1-9]", "chart:star --lens double-gauss-50 -s 1m -N 16 --size 64x48 "
                                    "--shutter leaf --opening-time 9ms")],
    "colour": [(r"colour: all", "chart:checker --lens double-gauss-50 -s 1m --size 48x32 "
                                "--model thick"),
               # in a mirror and a near wire, of few rays until an error, to a shutter
               (r"one for all in 12 of 12", "mirror.scene --lens double-gauss-50 --size 48x32"),
               (r"one for all in 12 of 12", "mirror.scene --lens canon-ef35-f2 --size 48x32 "
                                            "--error 5% --samples 128"),
               (r"one for all in 12 of 12", "lamps.scene --lens double-gauss-50 --size 48x32 "
                                            "--shutter leaf --opening-time 9ms --band 20")],
}


def write_pfm(path, rows):
    with open(path, "wb") as file:
        file.write(f"Pf\n{len(rows[0])} {len(rows)}\n-1.0\n".encode())
        for row in reversed(rows):
            file.write(struct.pack(f"<{len(row)}f", *row))


CAMERA = """camera at=0,0,3 look=0,0,0 focus=3
material lamp black emission=1 luminance=1000
material grey lambert colour=0.5
material red black emission=1,0.1,0.1 luminance=500
"""
SCENES = {
    "lamps.scene": "card size=2,2 at=0,0,0 material=red\nsphere radius=0.5 at=0,0,1 material=lamp\n",
    "room.scene": "card size=4,4 at=0,0,0 material=grey\nsphere radius=0.3 at=0.3,0.5,1 "
                  "material=lamp\n",
    # above the horizon; below it, a ball before it; all around
    "sky.scene": "light sky uniform luminance=1000 spectrum=5000K\n",
    "field.scene": "light sky uniform luminance=1000\nplane at=0,-1,0 normal=0,1,0 material=grey\n"
                   "sphere radius=0.1 at=0,0.2,0 material=red move=5,0,0\n"
                   "light sun illuminance=90000 elevation=30 azimuth=90\n",
    "around.scene": "light environment file=all.pfm luminance=800\n"
                    "sphere radius=0.2 at=0,0,0 material=grey\n",
    "mirror.scene": "card size=4,4 at=0,0,-1 material=grey\nmaterial silver mirror colour=0.9\n"
                    "sphere radius=0.6 at=-0.3,0,0 material=silver\n"
                    "box size=0.004,1,0.004 at=0.1,0,1.8 turn=0,0,8 material=red\n"
                    "sphere radius=0.3 at=1,0.5,0.5 material=lamp\n",
    "cards.scene": "".join(f"card size=0.1,0.1 at={1 + i / 7},{0.6 + k / 7},0 turn=0,0,13 "
                           "material=lamp\n" for i in range(4) for k in range(3)),
    "dot.scene": "card size=0.06,0.06 at=1.32,0.87,0 turn=0,0,13 material=lamp\n",
    "bulbs.scene": "sphere radius=0.08 at=0.6,0.3,-9 material=red\ndisc radius=0.06 at=-0.8,0.2,-8 "
                   "material=lamp move=90,30,0\ncard size=0.1,0.1 at=0.2,-0.9,-10 "
                   "material=lamp\nsphere radius=0.4 at=-0.3,-0.2,0 material=grey\n",
    "specks.scene": "sphere radius=0.1 at=0.3,0.2,0 material=red\n"
                    "card size=0.2,0.3 at=-0.5,0,0 material=lamp\n",
}


class Fixture:
    def __init__(self, build, checks, folder):
        self.program, self.checks, self.folder = Program(build), checks, folder

    def take(self, words):
        """All numbers of a picture, and what was said."""
        out = os.path.join(self.folder, "out.pfm")
        result = subprocess.run(self.program.command + ["render", *words.split(), "-t", "0.01",
                                                        "--explain", "-o", out], text=True,
                                cwd=self.folder, capture_output=True,
                                env=self.program.environment())
        if not self.checks.check(result.returncode == 0, f"{words}: {result.stderr}"):
            return None, ""
        with open(out, "rb") as file:
            _, size, _, data = file.read().split(b"\n", 3)
        width, height = map(int, size.split())
        return struct.unpack(f"<{3 * width * height}f", data), result.stderr


def rms(a, b):
    return math.sqrt(sum((x - y) ** 2 for x, y in zip(a, b)) / len(a))


def check(fixture, skip, said, words):
    best, _ = fixture.take(re.sub(r"--samples \d+", "", words) +
                           " --no-skip blur,uniform --samples 256 --seed 7")
    with_it, text = fixture.take(words)
    without, none = fixture.take(words + f" --no-skip {skip}")
    if best is None or with_it is None or without is None:
        return
    name = f"{skip}: {words}"
    fixture.checks.check(re.search(said, text) is not None, f"{name}: not used: {text}")
    fixture.checks.check("as --no-skip asks" in none, f"{name}: not said to be kept: {none}")
    white, noise = max(best), rms(without, best)
    fixture.checks.check(rms(with_it, best) <= 1.3 * noise + 1e-3 * white,
                         f"{name}: noise {rms(with_it, best):.3g} with it, {noise:.3g} without")
    for part in range(8):
        begin, end = part * len(best) // 8, (part + 1) * len(best) // 8
        mean = sum(best[begin:end]) / (end - begin)
        off = abs(sum(with_it[begin:end]) / (end - begin) - mean)
        # the noise of so many numbers, and of the table of light
        limit = 4 * noise / math.sqrt(end - begin) + 1e-3 * mean
        fixture.checks.check(off <= limit, f"{name}: part {part} is off by {off:.3g} of {mean:.3g}")
    if skip in ("colour", "time", "secondary") and "for all" not in said:  # the same rays
        fixture.checks.check(with_it == without, f"{name}: another picture")


def middle_of(picture, channel, width):
    """Of the light of one colour, in pixels from the left and the top."""
    light = picture[channel::3]
    return [sum(value * of(i) for i, value in enumerate(light)) / sum(light)
            for of in (lambda i: i % width, lambda i: i // width)]


def check_colours(fixture):
    """
    Lateral colour stays as it is. Where pixels are small, or there is nothing to gain, each colour
    keeps its rays.
    """
    words = ("dot.scene --lens canon-ef35-f2 -N 11 --size 720x480 --crop 656:16:32x32 --bounces 0 "
             "--samples 256")
    shared, text = fixture.take(words)
    own, _ = fixture.take(words + " --no-skip colour")
    places = [[middle_of(picture, channel, 32) for channel in range(3)] for picture in (shared, own)]
    spreads = [math.dist(red, blue) for red, _, blue in places]
    fixture.checks.check("one for all in 8 of 8" in text and spreads[1] > 0.15 and
                         all(math.dist(a, b) < 0.01 for a, b in zip(*places)),
                         f"colour: the middles of a dot are {places}, {spreads} apart: {text}")
    scene = "room.scene --lens double-gauss-50 "
    for words in ("--size 3840x2560 --crop 16:16:32x16 --samples 16", "--size 48x32 --samples 4"):
        with_it, text = fixture.take(scene + words)
        without, _ = fixture.take(scene + words + " --no-skip colour")
        fixture.checks.check("one for all in 0 of" in text and with_it == without,
                             f"colour: {words}: not each by itself: {text}")


def check_exposures(fixture):
    """A sweep of exposures, shot once or each by itself: the same files."""
    pictures = []
    for more in "", " --no-skip exposures":
        result = subprocess.run(
            fixture.program.command +
            ["render", "chart:star", "--lens", "double-gauss-50", "-s", "1m", "--size", "24x16",
             "-t", "0.01,0.02", *more.split(), "--explain", "-o", "sweep.pfm"],
            cwd=fixture.folder, text=True, capture_output=True, env=fixture.program.environment())
        fixture.checks.check(result.returncode == 0, f"exposures{more}: {result.stderr}")
        fixture.checks.check(("exposures: 2 of one picture, as --no-skip asks" in result.stderr) ==
                             (more != "") and "exposures: 2 of one picture" in result.stderr,
                             f"exposures{more}: not said: {result.stderr}")
        for i in 1, 2:
            with open(os.path.join(fixture.folder, f"sweep-{i}.pfm"), "rb") as file:
                pictures.append(file.read())
    fixture.checks.check(pictures[:2] == pictures[2:], "exposures: other pictures")
    fixture.checks.check(pictures[0] != pictures[1], "exposures: twice the light is the same")


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory(prefix="lenscalc-skips-") as folder:
        write_pfm(os.path.join(folder, "white.pfm"), [[1.0] * 90 for _ in range(60)])
        write_pfm(os.path.join(folder, "all.pfm"), [[0.5] * 4 for _ in range(2)])
        write_pfm(os.path.join(folder, "grey.pfm"),
                  [[0.5 + 0.4 * math.sin(x / 5) * math.cos(y / 7) for x in range(90)]
                   for y in range(60)])
        write_pfm(os.path.join(folder, "far.pfm"),
                  [[1.07 + 0.002 * (x // 30) for x in range(90)] for _ in range(60)])
        for name, things in SCENES.items():
            with open(os.path.join(folder, name), "w", encoding="ascii") as file:
                file.write((CAMERA.replace("look=0,0,0", "look=0,3,0") if name == "sky.scene" else
                            CAMERA) + things)
        fixture = Fixture(sys.argv[1], checks, folder)
        for skip, cases in CASES.items():
            for said, words in cases + MORE.get(skip, []) * EVERYTHING:
                check(fixture, skip, said, words)
        check_colours(fixture)
        check_exposures(fixture)
    return checks.finish()


if __name__ == "__main__":
    sys.exit(main())
