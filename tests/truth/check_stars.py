#!/usr/bin/env python3
"""tests/truth/check_stars.py - stars photographed by lenscalc render: check_stars.py BUILD_DIR

A lens of the aperture A sends E A cos(theta) t of a star that throws E lx across its direction onto
the film, whichever way rays are chosen and however wide a star is taken to be; a thin lens of the
focal length f has it at f tan(theta), and the light of a beam of sin(u) = tan(u) = 1/2N as one of
sin(atan(1/2N)): less by 1 + 1/4N^2. Stars are as wide as a pixel if they do not say how wide:
p/f at the middle of the film, of a pixel whose larger side is p, also in a part of the picture.
"""
# SPDX-License-Identifier: MIT

import math
import os
import re
import statistics
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import EVERYTHING, Checks, Program
from photographs import DOUBLE_GAUSS, read_pfm

CAMERA = "camera at=0,0,0 look=0,0,-1 focus=inf\n"
SKY = [(elevation, azimuth) for azimuth in range(-12, 13, 3) for elevation in range(-6, 7, 3)]
FOCAL, SECONDS, MAGNITUDE = 50.3582, 30, 2
FNUMBER = 4
STOP = FOCAL / FNUMBER  # mm
THIN = 1 / (1 + 1 / (4 * FNUMBER ** 2))
ACROSS, DOWN = 480, 320
PITCH = 36 / ACROSS  # mm
AROUND = 8  # pixels of a star on each side; the next one is 35 away
# those of a magnitude; lx s mm^2 of one on the axis
EACH = 2.54e-6 * 10 ** (-0.4 * MAGNITUDE) * SECONDS * math.pi * STOP ** 2 / 4


def way(elevation, azimuth):
    """To the right, up and ahead."""
    e, a = math.radians(elevation), math.radians(azimuth)
    return math.cos(e) * math.sin(a), math.sin(e), math.cos(e) * math.cos(a)


class Night:
    def __init__(self, program, checks, folder):
        self.program, self.checks, self.folder = program, checks, folder

    def take(self, stars, *words, lens=DOUBLE_GAUSS):
        """Rows of pixels, and what is said."""
        with open(os.path.join(self.folder, "night.scene"), "w", encoding="utf-8") as file:
            file.write(CAMERA + stars)
        result = self.program.run("render", "night.scene", "--lens", lens, "-t", SECONDS, *words,
                                  "-o", "night.pfm", cwd=self.folder)
        said = result.stderr.decode()
        self.checks.check(result.returncode == 0, f"{words}: {said}")
        return read_pfm(os.path.join(self.folder, "night.pfm")), said

    def field(self, *words):
        """The light of each star of a field, as a multiple of what a thin lens sends."""
        stars = "".join(f"light star magnitude={MAGNITUDE} elevation={e} azimuth={a}\n"
                        for e, a in SKY)
        rows = self.take(stars, "-N", FNUMBER, *words)[0]
        found = []
        for x, y, z in (way(*star) for star in SKY):
            column = int(ACROSS / 2 + FOCAL * x / z / PITCH)
            row = int(DOWN / 2 - FOCAL * y / z / PITCH)
            light = sum(pixel[1] for line in rows[row - AROUND:row + AROUND + 1]
                        for pixel in line[column - AROUND:column + AROUND + 1])
            found.append(light * PITCH ** 2 / (EACH * z))
        return found

    def check_field(self, what, scatter, expected, share, *words):
        found = self.field(*words)
        missing = sum(light < 0.3 for light in found)
        mean, sigma = statistics.fmean(found), statistics.pstdev(found)
        self.checks.check(missing == 0, f"{what}: {missing} of {len(found)} stars are missing")
        self.checks.check(abs(mean - expected) < share,
                          f"{what}: stars are {mean:.4g} of what they are, expected {expected:.4g}")
        self.checks.check(sigma < scatter, f"{what}: equal stars differ by {100 * sigma:.3g} %")
    def width(self, what, expected, *words, lens=DOUBLE_GAUSS):
        """How wide stars are said to be, arcmin."""
        star = "light star magnitude=-5 towards=0.01,0.02,-1\n"
        said = self.take(star, *words, lens=lens)[1]
        found = re.search(r"stars are discs of (?:one pixel, )?(\S+) arcmin", said)
        self.checks.check(found and abs(float(found.group(1)) / expected - 1) < 6e-3,
                          f"{what}: expected stars of {expected:.4g} arcmin: {said}")


def arcmin(step, focal=FOCAL):
    return math.degrees(math.atan(step / focal)) * 60


def main():
    program, checks = Program(sys.argv[1]), Checks()
    with tempfile.TemporaryDirectory(prefix="lenscalc-stars-") as folder:
        night = Night(program, checks, folder)
        thin = ["--model", "thin"]
        night.check_field("64 samples", 0.1, THIN, 0.015, *thin)
        night.check_field("an error of 2 %", 0.1, THIN, 0.015, *thin, "--error", "2%")
        # a real lens: its pupil is a little another one off the axis
        night.check_field("64 samples of glass", 0.12, 1, 0.05)
        night.check_field("an error of 2 % of glass", 0.12, 1, 0.05, "--error", "2%")
        if EVERYTHING:
            night.check_field("bands", 0.1, THIN, 0.015, *thin, "--spectral")
        few = ["--samples", 4]
        for model in "exact", "paraxial", "thick", "thin", "pinhole":
            night.width(model, arcmin(PITCH), *few, "--model", model)
        night.width("a part", arcmin(PITCH), *few, "--crop", "0:0:32x16")
        night.width("pixels that are high", arcmin(0.24), *few, "--size", "480x100")
        night.width("pixels that are wide", arcmin(0.36), *few, "--size", "100x100")
        # which the file notes, too
        program.run("render", "night.scene", "--lens", DOUBLE_GAUSS, *few, "--size", "48x32", "-t",
                    "1", "-o", "night.png", cwd=folder)
        with open(os.path.join(folder, "night.png"), "rb") as file:
            noted = re.search(rb"tEXtStars\0discs of one pixel, (51\.\d+) arcmin", file.read())
        checks.check(noted and abs(float(noted.group(1)) / arcmin(0.75) - 1) < 6e-3, "a PNG's note")
        # mirrors with a hole in their pupil, the pixels a little higher than wide
        night.width("mirrors", arcmin(0.036364, 80.09), *few, "--sensor", "3.6x2.4mm", "--size",
                    "100x66", lens="hoo-cassegrain-ex03")
        said = night.take("light star magnitude=0 towards=0,0,-1 diameter=1deg\n", *few)[1]
        checks.check("discs" not in said, f"a star that says how wide it is: {said}")
    checks.finish()


if __name__ == "__main__":
    main()
