#!/usr/bin/env python3
"""tests/truth/check_said.py - errors that pictures of scenes say they have: check_said.py BUILD_DIR

Scenes whose light goes many ways, to an asked error: what is said is not above it, and the true
error, against pictures of far more samples, is within a factor of 1.5 of what is said, over several
seeds; a smooth scene has the error fall faster than random numbers let it, fitted to logarithms.
"""
# SPDX-License-Identifier: MIT

import math
import os
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program
from photographs import Studio, read_pfm

AHEAD = "camera at=0,0,0 look=0,0,-1\n"
SCENES = {
    "wall": AHEAD + "material wall lambert colour=0.6\nplane material=wall at=0,0,-3 normal=0,0,1\n"
            "light sky uniform luminance=1000\nmaterial lamp black luminance=9000\n"
            "sphere material=lamp radius=0.5 at=1.5,0,-1\n",
    "room": AHEAD + "material wall lambert colour=0.5\nmaterial coat glossy colour=0.3,0.5,0.7 "
            "roughness=0.2\nmaterial lamp black luminance=20000\nbox material=wall size=6,4,9\n"
            "sphere material=coat radius=0.7 at=-0.6,-0.8,-3\nbox material=coat size=0.6,1,0.6 "
            "at=1,-0.9,-3 turn=0,30,0\ncard material=lamp size=1,1 at=0.5,1.9,-2.5 "
            "normal=0,-1,0\n",
    "balls": AHEAD + "material wall lambert colour=0.3\nmaterial glass mirror colour=0.8\n"
             "plane material=wall at=0,-1,0 normal=0,1,0\nsphere material=glass radius=1 "
             "at=-0.8,0,-4\nsphere material=wall radius=0.7 at=1,-0.3,-3\nlight sky clear "
             "luminance=2000 elevation=40 azimuth=60\n",
}
WORDS = ["--lens", "double-gauss-50", "-s", "3m", "-N", "4", "-t", "0.01", "--iso", "100", "--size",
         "16x8"]
SEEDS = 3
WHITE = 0.78  # lx s at ISO 100


class Asked:
    """Pictures of a scene, and what is said of them."""

    def __init__(self, studio, scene, *words):
        self.studio, self.name, self.words = studio, studio.write(scene), words

    def take(self, *words):
        program = self.studio.program
        result = subprocess.run(program.command + ["render", self.name, *self.words, *words, "-o",
                                                   "said.pfm"], cwd=self.studio.folder, text=True,
                                capture_output=True, env=program.environment())
        self.studio.checks.check(result.returncode == 0, f"{words}: {result.stderr}")
        return read_pfm(os.path.join(self.studio.folder, "said.pfm")), result.stderr


def grey_level(light):
    """lx s from one code of 8 bits to the next, at this light."""
    y = light / WHITE
    slope = 12.92 if y <= 0.0031308 else 1.055 / 2.4 * y ** (1 / 2.4 - 1)
    return WHITE / (255 * slope)


def multiple(rows, best, asked):
    """Root mean square over pixels and colours of the error, over the one that it may be."""
    squares = [((a[k] - b[k]) / max(asked * b[k], grey_level(b[k]))) ** 2
               for row, other in zip(rows, best) for a, b in zip(row, other) for k in range(3)]
    return math.sqrt(sum(squares) / len(squares))


def check_said(studio, name, asked, bounces):
    """Of all seeds together; what is said has two digits."""
    scene = Asked(studio, SCENES[name], *WORDS, "--bounces", str(bounces))
    best = scene.take("--samples", "512", "--seed", "77")[0]
    true, stated = [], []
    for seed in range(SEEDS):
        rows, words = scene.take("--error", str(asked), "--seed", str(seed))
        said = re.search(r"error ([0-9.]+) % of each pixel's light, or ([0-9.]+) of a grey", words)
        if not studio.checks.check(said is not None, f"{name}: {words}"):
            return
        stated.append(float(said.group(1)) / 100 / asked)
        true.append(multiple(rows, best, asked))
    true, stated = (math.sqrt(sum(v * v for v in of) / SEEDS) for of in (true, stated))
    studio.checks.check(stated <= 1.01, f"{name}, {asked}: it says {stated:.2f} of it")
    studio.checks.check(1 / 1.5 < true / stated < 1.5,
                        f"{name}, {asked}: it says {stated:.3f} of it and has {true:.3f}")


def check_slope(studio):
    """A wall in lamp and sky, by four counts of samples; the light itself from very many."""
    scene = Asked(studio, SCENES["wall"], *WORDS, "--bounces", "1")
    best = scene.take("--samples", "2048", "--seed", "77")[0]
    points = []
    for samples in 2, 8, 32, 128:
        square = sum(multiple(scene.take("--samples", str(samples), "--seed", str(seed))[0], best,
                              0.01) ** 2 for seed in (1, 2))
        points.append((math.log(samples), math.log(square) / 2))
    x, y = (sum(p[i] for p in points) / 4 for i in (0, 1))
    slope = sum((a - x) * (b - y) for a, b in points) / sum((a - x) ** 2 for a, _ in points)
    studio.checks.check(slope <= -0.7, f"the error falls with the power {slope:.3f}: {points}")


def main():
    program, checks = Program(sys.argv[1]), Checks()
    with tempfile.TemporaryDirectory(prefix="lenscalc-said-") as folder:
        studio = Studio(program, checks, folder)
        for name, asked, bounces in ("wall", 0.05, 2), ("room", 0.2, 3), ("balls", 0.1, 3):
            check_said(studio, name, asked, bounces)
        check_slope(studio)
    return checks.finish()


if __name__ == "__main__":
    sys.exit(main())
