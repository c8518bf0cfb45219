"""tests/bench/tolerance.py - lenses as they may be made, a second."""
# SPDX-License-Identifier: MIT

import os
import subprocess
import time

from common import entry, printed
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

TOGETHER, TURNS = 120_000, 6


def seconds(bench, words):
    """Those of the processor, of one thread: others who are at work do not stretch them."""
    with subprocess.Popen([bench.lenscalc, "tolerance", *words, "--csv"],
                          stdout=subprocess.DEVNULL) as child:
        _, status, used = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode:
        raise RuntimeError(f"trials ended with {child.returncode}")
    return used.ru_utime + used.ru_stime


def rate(bench, lens, lines, options, few, many):
    """Trials a second of processor: of a longer run less a shorter one, the best of three."""
    words = [lens, "--rays", "21", "--no-clip", *options.split()]
    if lines is not None:
        with open(bench.path("tolerances.txt"), "w", encoding="ascii") as file:
            file.write(lines)
        words += ["--tolerances", bench.path("tolerances.txt")]
    least = {count: min(seconds(bench, words + ["--trials", str(count)]) for _ in range(3))
             for count in (few, many)}
    return (many - few) / (least[many] - least[few])


# Names that tests/bench/grade.c prints.
GRADE = {
    "opening": ("tolerance: to make a lens ready", "ms"),
    "sensitivities": ("tolerance: all sensitivities of a grade", "ms"),
    "clipped-opening": ("tolerance: to make a clipped lens ready", "ms"),
    "clipped-sensitivities": ("tolerance: all sensitivities of a grade, clipped", "ms"),
}


def at_once(bench, words, runs):
    """Seconds until all of these runs, (trials, threads), have ended."""
    began = time.perf_counter()
    children = [subprocess.Popen([bench.lenscalc, "tolerance", *words, "--csv", "--trials",
                                  str(trials), "--threads", str(threads)],
                                 stdout=subprocess.DEVNULL) for trials, threads in runs]
    if any([child.wait() for child in children]):
        raise RuntimeError("a run of trials failed")
    return time.perf_counter() - began


def two_threads(bench, lens):
    """What a trial costs on two threads and on one, in time of the processor: pieces are small, so
    that no thread waits for the other. The clock says it only where two cores have nothing else to
    do, which two processes of half of the trials each tell."""
    one, two = (rate(bench, lens, ROUND, f"--threads {threads}", 2000, 60000)
                for threads in (1, 2))
    words = [lens, "--rays", "21", "--no-clip", "--tolerances", bench.path("tolerances.txt")]
    kinds = {"one": [(TOGETHER, 1)], "processes": [(TOGETHER // 2, 1)] * 2,
             "threads": [(TOGETHER, 2)]}
    turns = [{kind: at_once(bench, words, runs) for kind, runs in kinds.items()}
             for _ in range(TURNS)]
    least = {kind: min(turn[kind] for turn in turns) for kind in kinds}
    yield entry("tolerance: two threads / one", 2 * two / one, "x",
                f"by the clock {least['one'] / least['threads']:.2f}, where two processes are "
                f"{least['one'] / least['processes']:.2f} as fast as one")


def tolerance(bench):
    lens = bench.path("gauss.lens")
    with open(lens, "w", encoding="ascii") as file:
        file.write(GAUSS)
    for name, lines, options, few, many in QUESTIONS:
        yield entry(f"tolerance: {name}", rate(bench, lens, lines, options, few, many), "trials/s")
    yield from printed(bench.linked("grade"), GRADE)
    yield from two_threads(bench, lens)


SECTIONS = {"tolerance": tolerance}
