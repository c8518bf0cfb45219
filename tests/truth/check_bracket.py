#!/usr/bin/env python3
"""tests/truth/check_bracket.py - luminances through sensor and bracket: check_bracket.py BUILD_DIR

Strips that shine, each five times as bright as the last: sixteen exposures with their noise,
merged, give back their luminances, which are numbers in the scene; the variance of a sensor's
numbers grows with their mean by the gain, from that of reading and of rounding on; and grey scenes
give the same light by wavelengths as by red, green and blue.
"""
# SPDX-License-Identifier: MIT

import math
import os
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program
from photographs import Studio, mean_of, read_pfm, take

F, S = 50.358167, 2000  # mm, of double-gauss-50, and away from it
WIDTH, COUNT = 4.0, 8  # mm of film, strips
LEAST, STEP = 0.3, 5
TIMES = "30,15,8,4,2,1,1/2,1/4,1/8,1/15,1/30,1/60,1/125,1/250,1/500,1/1000"
THIN = ["--lens", "double-gauss-50", "--model", "thin", "-s", f"{S}mm", "-N", "8", "--sensor",
        f"{WIDTH}x{WIDTH / 4}mm", "--bounces", "0"]
AHEAD = "camera at=0,0,0 look=0,0,-1\n"


def strips(ratio):
    """A scene, and its luminances from the left."""
    light = [LEAST * ratio ** k for k in range(COUNT)]
    wide = WIDTH / COUNT * (S / F - 1)
    return "unit mm\n" + AHEAD + "".join(
        f"material lamp{k} black luminance={value}\n"
        f"card material=lamp{k} size={wide},999 at={(k - (COUNT - 1) / 2) * wide},0,{-S}\n"
        for k, value in enumerate(light)), light


def inner(rows, k):
    """Pixels of a strip that no edge is near."""
    wide = len(rows[0]) // COUNT
    return [pixel for row in rows for pixel in row[k * wide + 1:(k + 1) * wide - 1]]


def check_bracket(studio):
    """With the slides' times; towards the edges of the film cos^4 is left."""
    scene, light = strips(STEP)
    result = studio.program.run("render", studio.write(scene), *THIN, "--size", "64x16",
                                "--samples", "16", "--noise", "--pitch", "6um", "--read-noise", "3",
                                "--bits", "16", "-t", TIMES, "-o", "shot.png", cwd=studio.folder)
    studio.checks.check(result.returncode == 0, f"render: {result.stderr}")
    result = studio.program.run("tone", *(f"shot-{k:02}.png" for k in range(1, 17)), "-o",
                                "merged.pfm", cwd=studio.folder)
    if not studio.checks.check(result.returncode == 0, f"tone: {result.stderr}"):
        return
    rows = read_pfm(os.path.join(studio.folder, "merged.pfm"))
    image = F * S / (S - F)
    for k, value in enumerate(light):
        for channel in range(3):
            values = [pixel[channel] for pixel in inner(rows, k)]
            x = (k - (COUNT - 1) / 2) * WIDTH / COUNT
            studio.unbiased(values, value / (1 + (x / image) ** 2) ** 2,
                            f"luminance {value} merged, channel {channel}", known=1e-3)


def check_noise(studio):
    """sigma^2 = K^2 (sigma_r^2 + mu) + 1/12, against the same picture without noise."""
    scene, light = strips(1.6)
    gain, read_noise, black = 0.7, 5, 100
    words = [*THIN, "--size", "160x120", "--samples", "16", "-t", "1/20", "--raw", "--gain",
             str(gain), "--black", str(black), "--pitch", "5um", "--response", "mono"]
    name = studio.write(scene)
    plain, noisy = (take(studio.program, studio.checks, studio.folder, name, *words, *more,
                         name="raw.png") for more in ([], ["--noise", "--read-noise",
                                                           str(read_noise)]))
    if plain is None or noisy is None:
        return
    points = []
    for k in range(COUNT):
        off = [a - b for (a,), (b,) in zip(inner(noisy, k), inner(plain, k))]
        level = sum(a for (a,) in inner(plain, k)) / len(off) - black
        mean = sum(off) / len(off)
        variance = sum((d - mean) ** 2 for d in off) / (len(off) - 1)
        # without noise numbers are rounded too
        expected = gain * level + (gain * read_noise) ** 2 + 2 / 12
        studio.checks.check(abs(variance / expected - 1) < 4 * math.sqrt(2 / len(off)),
                            f"{level:.0f} numbers: a variance of {variance:.4g}, not "
                            f"{expected:.4g}")
        # those without noise are off by half a number at most
        studio.checks.check(abs(mean) < 4 * math.sqrt(variance / len(off)) + 0.5,
                            f"{level:.0f} numbers: off by {mean:.3g}")
        points.append((level, variance, expected))
    weight = [1 / expected ** 2 for _, _, expected in points]
    total = sum(weight)
    x, y = (sum(w * p[i] for w, p in zip(weight, points)) / total for i in (0, 1))
    square = sum(w * (p[0] - x) ** 2 for w, p in zip(weight, points))
    slope = sum(w * (p[0] - x) * (p[1] - y) for w, p in zip(weight, points)) / square
    sigma = math.sqrt(2 / len(off) / square)
    studio.checks.check(abs(slope - gain) < 4 * sigma and sigma < 0.03 * gain,
                        f"variance over mean: {slope:.4f} +- {sigma:.4f}, the gain is {gain}")
    studio.checks.check(points[-1][0] > 8 * points[0][0] > 0, f"numbers from {points[0][0]}")


def check_grey(studio):
    """Walls and lamps without colour, of light that is D65: by wavelengths as by three colours."""
    scene = AHEAD + "material wall lambert colour=0.4\nmaterial coat glossy colour=0.7 " \
        "roughness=0.3\nplane material=wall at=0,-1,0 normal=0,1,0\nplane material=wall " \
        "at=0,0,-5 normal=0,0,1\nsphere material=coat radius=0.6 at=-0.5,0,-3\nlight sky uniform " \
        "luminance=900\nlight point at=1,1,-1 intensity=2000\nmaterial lamp black " \
        "luminance=5000\nsphere material=lamp radius=0.3 at=1.2,0.5,-3\n"
    words = ["--lens", "cs348b-dgauss-50", "-s", "3m", "-N", "4", "-t", "0.01", "--size", "12x8",
             "--samples", "128"]
    three = studio.seeds(5, scene, *words)
    for more in [], ["--bands", "13"]:
        many = studio.seeds(5, scene, *words, "--spectral", *more)
        if three is None or many is None:
            return
        for channel in range(3):
            a, b = ([mean_of(rows, channel) for rows in of] for of in (three, many))
            means = [sum(v) / len(v) for v in (a, b)]
            sigma = math.sqrt(sum((v - m) ** 2 for of, m in zip((a, b), means) for v in of) / 20)
            studio.checks.check(abs(means[0] - means[1]) <= 4 * sigma + 1e-4 * means[0],
                                f"grey, channel {channel}: {means} +- {sigma:.2g}")
            studio.checks.check(sigma < 5e-3 * means[0], f"grey: sigma {sigma} of {means[0]}")
        worst = 0
        for j in range(8):
            for i in range(12):
                a, b = ([rows[j][i][1] for rows in of] for of in (three, many))
                means = [sum(v) / 5 for v in (a, b)]
                square = sum((v - m) ** 2 for of, m in zip((a, b), means) for v in of) / 20
                worst = max(worst, abs(means[0] - means[1]) /
                            math.sqrt(square + (1e-4 * means[0]) ** 2))
        # the 96th of its kind, Student's with 8 degrees of freedom
        studio.checks.check(worst < 8, f"grey: a pixel is {worst:.2f} sigma off")


def main():
    program, checks = Program(sys.argv[1]), Checks()
    with tempfile.TemporaryDirectory(prefix="lenscalc-bracket-") as folder:
        studio = Studio(program, checks, folder)
        for check in check_bracket, check_noise, check_grey:
            check(studio)
    return checks.finish()


if __name__ == "__main__":
    sys.exit(main())
