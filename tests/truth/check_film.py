#!/usr/bin/env python3
"""tests/truth/check_film.py - pictures on film: check_film.py BUILD_DIR

The light of a picture, as lenscalc render writes it, becomes the densities of a curve through the
two points of ISO 6, solved elsewhere to twelve digits; a print puts 18 % grey where the meter does.
Long exposures lose what the maker says. Grain has the deviation of Selwyn's law.
"""
# SPDX-License-Identifier: MIT

import math
import os
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program
from photographs import take, write_pfm

SPEED, BASE, MOST, TOE = 400, 0.25, 2.5, 0.2
# gamma and where the toe ends after the speed point, both conditions solved with mpmath
GAMMA, TOE_AT = 0.684435578392, math.log10(0.8 / SPEED) - 0.0146832979409
LUMINOUS = (0.2126, 0.7152, 0.0722)
FILM = ["chart:wedge", "--lens", "double-gauss-50", "-s", "1m", "--size", "42x4", "--samples", "4"]


def soft(u):
    return max(u, 0) + math.log1p(math.exp(-abs(u)))


def density(exposure):
    if exposure == 0:
        return BASE
    toe = (math.log10(exposure) - TOE_AT) / TOE
    shoulder = toe - (MOST - BASE) / GAMMA / TOE
    return BASE + GAMMA * TOE * (soft(toe) - soft(shoulder))


def srgb(light):
    light = min(max(light, 0), 1)
    return 12.92 * light if light <= 0.0031308 else 1.055 * light ** (1 / 2.4) - 0.055


def check_curve(checks, program, folder):
    """Toe, straight part and shoulder: 21 greys, each at three times that lie far apart."""
    grey = density(10 / SPEED)
    seen = []
    for time in "1/4000", "0.1", "1":
        words = FILM + ["-t", time]
        light = take(program, checks, folder, *words, "--iso", str(SPEED))
        negative = take(program, checks, folder, *words, "--film", "HP5 Plus", name="film.pfm")
        printed = take(program, checks, folder, *words, "--film", "HP5 Plus", "--bits", "16",
                       name="film.png")
        if None in (light, negative, printed):
            return
        for row, densities, prints in zip(light, negative, printed):
            for pixel, found, (number,) in zip(row, densities, prints):
                exposure = sum(a * b for a, b in zip(LUMINOUS, pixel))
                expected = density(exposure)
                seen.append(expected)
                checks.check(abs(found - expected) < 2e-6,
                             f"density {found} of {exposure} lx s, expected {expected}")
                bright = 65535 * srgb(0.18 * 10 ** ((expected - grey) / GAMMA))
                checks.check(abs(number - bright) < 0.6, f"{number} in print, expected {bright}")
    checks.check(min(seen) < BASE + 0.01 and max(seen) > MOST - 0.15, "the wedge spans the curve")


def check_reciprocity(checks, program, folder):
    """Ilford: metered Tm takes Tm^1.31, so that 30 s count as 30^(1/1.31)."""
    words = FILM + ["--luminance", "0.01"]
    light = take(program, checks, folder, *words, "-t", repr(30 ** (1 / 1.31)), "--iso", str(SPEED))
    film = take(program, checks, folder, *words, "-t", "30", "--film", "HP5 Plus", name="film.pfm")
    for row, densities in zip(light or [], film or []):
        for pixel, found in zip(row, densities):
            expected = density(sum(a * b for a, b in zip(LUMINOUS, pixel)))
            checks.check(abs(found - expected) < 1e-5, f"density {found} of 30 s, not {expected}")


def check_grain(checks, program, folder):
    """Deviation 17/1000 in a circle of 0.048 mm at density 1, as the roots of area and density."""
    write_pfm(os.path.join(folder, "white.pfm"), [[1.0, 1.0], [1.0, 1.0]])
    for film, area in ("0.6x0.6mm", 0.01 ** 2), ("0.6x1.8mm", 0.01 * 0.03):
        check_grain_of(checks, program, folder, film, area)


def check_grain_of(checks, program, folder, film, area):
    words = ["white.pfm", "--lens", "double-gauss-50", "-s", "1m", "--size", "60x60", "--samples",
             "4", "-t", "1/500", "--sensor", film, "--film", "HP5 Plus"]
    plain = take(program, checks, folder, *words, name="plain.pfm")
    grains = [take(program, checks, folder, *words, "--grain", "17", "--seed", str(seed),
                   "--threads", str(threads), name="grain.pfm")
              for seed, threads in ((0, 1), (0, 2), (1, 2))]
    if None in [plain] + grains:
        return
    checks.check(grains[0] == grains[1], "two threads make another grain than one")
    checks.check(grains[0] != grains[2], "another seed makes the same grain")
    score = [(found - mean) / (0.017 * math.sqrt(math.pi * 0.024 ** 2 / area * (mean - BASE)))
             for row, means in zip(grains[0], plain) for found, mean in zip(row, means)]
    count = len(score)
    mean, square = sum(score) / count, sum(z * z for z in score) / count
    checks.check(abs(mean) < 4 / math.sqrt(count), f"grain has the mean {mean}")
    checks.check(abs(square - 1) < 4 * math.sqrt(2 / count), f"grain has the variance {square}")


def main():
    program, checks = Program(sys.argv[1]), Checks()
    with tempfile.TemporaryDirectory(prefix="lenscalc-film-") as folder:
        check_curve(checks, program, folder)
        check_reciprocity(checks, program, folder)
        check_grain(checks, program, folder)
    return checks.finish()


if __name__ == "__main__":
    sys.exit(main())
