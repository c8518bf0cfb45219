#!/usr/bin/env python3
"""tests/truth/check_metered.py - the mean light on a film, of small lights: BUILD_DIR

A thin lens of the aperture A sends E A cos(theta) lumens of what has the illuminance E across its
direction onto the film, if its image is there: stars by their illuminance, spheres of the radius r
by pi L r^2/d^2. The time that is metered is 10/ISO lx s over that mean.
"""
# SPDX-License-Identifier: MIT

import math
import os
import re
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program

STOP = 50.3582 / 16  # mm
LENS = ["--lens", "double-gauss-50", "--model", "thin", "-N", "16"]
CAMERA = "camera at=0,0,0 look=0,0,-1 focus=inf\n"


class Meter:
    def __init__(self, program, checks, folder):
        self.program, self.checks, self.folder = program, checks, folder

    def mean(self, scene, *words):
        """Lux on the film on average, as it is said; NaN: nothing is."""
        with open(os.path.join(self.folder, "a.scene"), "w", encoding="utf-8") as file:
            file.write(CAMERA + scene)
        result = self.program.run("render", "a.scene", "--size", "12x8", "--samples", "16", *words,
                                  "-o", "a.exr", cwd=self.folder)
        said = result.stderr.decode()
        found = re.match(r"(\S+) lx on the film on average", said)
        self.checks.check(result.returncode == 0 and found, f"{scene}: {said}")
        return float(found.group(1)) if found else math.nan

    def check(self, what, scene, expected, *words, share=0.01):
        for seed in range(3):
            mean = self.mean(scene, "--seed", str(seed), *words)
            self.checks.check(abs(mean - expected) <= share * expected,
                              f"{what}, seed {seed}: {mean} lx, expected {expected:.4g}")


def thin(illuminance, direction):
    """Mean of the film."""
    cosine = abs(direction[2]) / math.hypot(*direction)
    return illuminance * math.pi * (STOP / 2) ** 2 * cosine / (36 * 24)


def main():
    program, checks = Program(sys.argv[1]), Checks()
    with tempfile.TemporaryDirectory(prefix="lenscalc-metered-") as folder:
        meter = Meter(program, checks, folder)
        stars = [(0.01, 0.01, -1), (-0.3, 0.1, -1), (0.2, -0.2, -1)]
        lines = "".join(f"light star illuminance=1e-6 towards={x},{y},{z}\n" for x, y, z in stars)
        away = "light star illuminance=1e-3 towards=0.5,0,-1\nlight star illuminance=1 towards=0,0,1\n"
        expected = sum(thin(1e-6, star) for star in stars)
        meter.check("stars", lines + away, expected, *LENS)
        meter.check("stars in bands", lines, expected, *LENS, "--spectral")
        lamp = "material l black luminance=5e6\nsphere material=l radius=0.01 at=0.5,-0.3,-5\n"
        square = 0.5 ** 2 + 0.3 ** 2 + 5 ** 2
        lit = thin(math.pi * 5e6 * 0.01 ** 2 / square, (0.5, -0.3, -5))
        meter.check("a lamp", lamp, lit, *LENS)
        hidden = "material b black\ncard material=b size=0.1,0.1 at=0.25,-0.15,-2.5\n"
        meter.check("a star beside a lamp behind a card", lamp + hidden + lines, expected, *LENS)
        # where all shines both kinds of rays find it
        sky = "light sky uniform luminance=1000\n"
        alone, both = meter.mean(sky, *LENS), meter.mean(sky + lamp, *LENS)
        checks.check(abs(both - alone - lit) < 2e-3 * both, f"a lamp before a sky adds {both - alone}")
        # a lamp and the floor that it lights, by a lens of glass: whatever the seed
        floor = lamp + "material w lambert colour=0.5\nplane material=w normal=0,1,0 at=0,-1.3,0\n"
        means = [meter.mean(floor, "--lens", "double-gauss-50", "--seed", str(seed))
                 for seed in range(4)]
        checks.check(max(means) < 1.01 * min(means), f"a lamp above a floor: {means} lx")
    checks.finish()


if __name__ == "__main__":
    main()
