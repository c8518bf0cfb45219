"""tests/bench/common.py - the programs under test, their input, and how they are timed."""
# SPDX-License-Identifier: MIT

import os
import random
import subprocess
import sys
import time
from collections import namedtuple

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
SPAWNS = 300
ROWS = 1_000_000
YARD = 37  # M ray-surfaces a second of plain.c where the goals of times and rates were set
TURNS = 5  # of each pipe, interleaved; the fastest counts: others only ever slow one down

# what was measured; its goal, if it has one, stands in goals.tsv by its name
Entry = namedtuple("Entry", "name value unit figures")


# a section that could not be measured to its end, and why
Broken = namedtuple("Broken", "section trouble")


def entry(name, value, unit="", figures=""):
    return Entry(name, value, unit, figures)


class Bench:
    """The programs under test and their input."""

    def __init__(self, build, scratch, goals):
        self.lenscalc = os.path.join(os.path.abspath(build), "lenscalc")
        self.tools = os.path.join(os.path.abspath(build), "bench")
        self.scratch = scratch
        self.goals = goals
        os.makedirs(self.tools, exist_ok=True)

    def tool(self, name, *objects):
        """Build a C program of this folder; return its path."""
        program = os.path.join(self.tools, name)
        subprocess.run([os.environ.get("CC", "cc"), "-std=c17", "-D_POSIX_C_SOURCE=200809L", "-O2",
                        "-ffp-contract=off", "-Isrc", "-o", program,
                        os.path.join(HERE, name + ".c"), *objects, "-lm"],
                       check=True, cwd=ROOT)
        return program

    def objects(self, ceres=False):
        """Those of the program without its main function."""
        build = os.path.dirname(self.lenscalc)
        with open(os.path.join(build, "objects"), encoding="utf-8") as file:
            objects = [os.path.join(build, path) for path in file.read().split()]
        solvers = ["solver_engines_ceres.o", "solver_ceres.o"] if ceres else ["solver_engines.o"]
        return [*objects, *(os.path.join(build, "design", "solver", name) for name in solvers)]

    def linked(self, name, ceres=False):
        """The same for a program that uses the objects of the build, perhaps with the solver."""
        program, objects = os.path.join(self.tools, name), self.objects(ceres)
        compiled = program + ".o"
        subprocess.run([os.environ.get("CC", "cc"), "-std=c17", "-D_POSIX_C_SOURCE=200809L", "-O2",
                        "-ffp-contract=off", "-fno-math-errno", "-fno-trapping-math", "-Isrc",
                        "-c", "-o", compiled, os.path.join(HERE, name + ".c")], check=True,
                       cwd=ROOT)
        linker = [os.environ.get("CXX", "c++")] if ceres else [os.environ.get("CC", "cc")]
        libraries = ["-lceres", "-lglog"] if ceres else []
        subprocess.run([*linker, "-o", program, compiled, *objects, *libraries, "-lm"], check=True)
        return program

    def speed(self):
        """Of this processor, now: over that of the one where the goals were set."""
        program = os.path.join(self.tools, "plain")
        program = program if os.path.exists(program) else self.tool("plain")
        return float(subprocess.run([program], check=True, capture_output=True).stdout) / YARD

    def path(self, name):
        return os.path.join(self.scratch, name)

    def rows(self, count):
        """A file of that many photographic situations, the same every time."""
        path = self.path(f"{count}.csv")
        if not os.path.exists(path):
            draw = random.Random(2)
            focal, fnumbers = (24, 35, 50, 85, 100, 135, 200), (1.4, 2, 2.8, 4, 5.6, 8, 11, 16)
            cocs = (0.015, 0.02, 0.025, 0.03)
            block = "".join(f"{draw.choice(focal)},{draw.choice(fnumbers)},"
                            f"{draw.uniform(0.5, 50):.3f},{draw.choice(cocs)}\n"
                            for _ in range(ROWS // 10))
            with open(path, "w", encoding="ascii") as file:
                file.write("f_mm,N,s_m,c_mm\n")
                for _ in range(count * 10 // ROWS):
                    file.write(block)
        return path

    def is_ceiling(self, name):
        """Is less of it better?"""
        return self.goals.get(name, (">=",))[0] == "<="

    def words(self, arguments):
        return [self.lenscalc, *arguments.split()]

    def batch(self, *options):
        return [self.lenscalc, "dof", "--batch", "-", "--columns", "hyperfocal_m,near_m,far_m",
                *options]


def measured(bench, sections):
    """What each of {name: section} yields; of one that stops a Broken, then the next one's."""
    for name, section in sections.items():
        try:
            yield from section(bench)
        except (Exception, SystemExit) as trouble:
            yield Broken(name, f"{type(trouble).__name__}: {trouble}")


def run(words, source, target=os.devnull):
    """Seconds that a program takes."""
    with open(source, "rb") as stdin, open(target, "wb") as stdout:
        start = time.perf_counter()
        child = subprocess.Popen(words, stdin=stdin, stdout=stdout)
        status = child.wait()
        seconds = time.perf_counter() - start
    if status != 0:
        sys.exit(f"bench: {words[0]} ended with {status}")
    return seconds


def fastest(commands, source):
    """The best seconds of each of the named commands, run in turns."""
    best = {}
    for _ in range(TURNS):
        for name, words in commands.items():
            seconds = run(words, source)
            best[name] = min(seconds, best.get(name, seconds))
    return best


def rate(seconds):
    return f"{ROWS / seconds / 1e6:.2f} M rows/s"


def starts(bench, answers):
    """Median start of each answer against /bin/true; answers: {name: arguments}."""
    words = [bench.tool("spawn"), str(SPAWNS), "/bin/true"]
    for arguments in answers.values():
        words += ["--", *bench.words(arguments)]
    output = subprocess.run(words, check=True, capture_output=True, text=True).stdout
    true, *times = map(float, output.split())
    for name, spent in zip(answers, times):
        yield entry(f"start: {name} / true", spent / true, "x", f"{spent:.0f} us / {true:.0f} us")


def printed(program, names):
    """The numbers that a program prints as NAME VALUE; names: {NAME: (entry's name, unit)}."""
    output = subprocess.run([program], check=True, capture_output=True, text=True).stdout
    for line in output.splitlines():
        name, value = line.split()
        yield entry(names[name][0], float(value), names[name][1])
