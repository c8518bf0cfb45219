"""tests/bench/tolerance.py - lenses as they may be made, a second."""
# SPDX-License-Identifier: MIT

import subprocess
import time

from common import entry
from lenses import GAUSS

ROUND = "tolerance R1..R11 0.1%\ntolerance t1..t10 0.02\ntolerance n1 5e-4\ntolerance n3..n4 5e-4\n"
SKEW = "tolerance surface 1..11 tilt 1arcmin\ntolerance surface 1..11 decenter 0.01\n"
ELEMENTS = ("tolerance elements 1..11 tilt 1arcmin\ntolerance elements 1..11 decenter 0.02\n")
# name, lines, options, trials of the shorter and the longer run
QUESTIONS = (
    ("the default command", None, "", 2000, 20000),
    ("one wavelength, paraxial refocus", ROUND, "-w d --refocus paraxial", 2000, 60000),
    ("three wavelengths, paraxial refocus", ROUND, "--refocus paraxial", 2000, 40000),
    ("one wavelength, best focus", ROUND, "-w d", 2000, 60000),
    ("three wavelengths, best focus", ROUND, "", 2000, 40000),
    ("all elements tilted and decentred, one wavelength", ROUND + ELEMENTS, "-w d", 2000, 40000),
    ("all surfaces tilted and decentred, one wavelength", SKEW, "-w d", 2000, 40000),
    ("one wavelength, re-aimed", ROUND, "-w d --aim stop", 500, 10000),
    ("three wavelengths, re-aimed", ROUND, "--aim stop", 500, 5000),
    ("wave front of one wavelength", ROUND, "-w d --criterion wavefront", 200, 2000),
    ("contrast of one wavelength, three fields", ROUND, "-w d --criterion mtf@20", 200, 2000),
    ("focal length", ROUND, "--criterion efl", 2000, 100000),
    ("to second order", ROUND, "--method differential", 2000, 1000000),
    ("to second order, the default command", None, "--method differential", 2000, 500000),
)


def seconds(bench, words):
    began = time.perf_counter()
    subprocess.run([bench.lenscalc, "tolerance", *words, "--csv"], check=True,
                   stdout=subprocess.DEVNULL)
    return time.perf_counter() - began


def rate(bench, lens, lines, options, few, many):
    """Trials a second: of a longer run less a shorter one, the best of three."""
    words = [lens, "--rays", "21", "--no-clip", *options.split()]
    if lines is not None:
        with open(bench.path("tolerances.txt"), "w", encoding="ascii") as file:
            file.write(lines)
        words += ["--tolerances", bench.path("tolerances.txt")]
    least = {count: min(seconds(bench, words + ["--trials", str(count)]) for _ in range(3))
             for count in (few, many)}
    return (many - few) / (least[many] - least[few])


def tolerance(bench):
    lens = bench.path("gauss.lens")
    with open(lens, "w", encoding="ascii") as file:
        file.write(GAUSS)
    for name, lines, options, few, many in QUESTIONS:
        yield entry(f"tolerance: {name}", rate(bench, lens, lines, options, few, many), "trials/s")
    one = rate(bench, lens, ROUND, "", 2000, 60000)
    two = rate(bench, lens, ROUND, "--threads 2", 2000, 60000)
    yield entry("tolerance: two threads / one", two / one, "x")


SECTIONS = {"tolerance": tolerance}
