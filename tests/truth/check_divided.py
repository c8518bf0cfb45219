#!/usr/bin/env python3
"""tests/truth/check_divided.py - pieces of pictures: check_divided.py BUILD_DIR

A crop has the pixels of the whole picture, to the bit, whatever is made of them. Parts that are
merged are the file of one run, whatever it holds and in any order, with threads, and where one was
killed and run again, also by GNU parallel, or interrupted and resumed; gaps, repeats, strangers, damage, and files that
have changed since are refused by name.
"""
# SPDX-License-Identifier: MIT

import os
import random
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time

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

    def refused(self, message, *words):
        result = self.run(*words)
        written = os.path.exists(os.path.join(self.path, "refused.pfm"))
        self.checks.check(result.returncode in (2, 4, 5) and message in result.stderr and
                          not written, f"{words}: {result.returncode} {result.stderr}")

    def write(self, name, data):
        with open(os.path.join(self.path, name), "wb") as file:
            file.write(data)

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


def check_kinds(folder):
    """All that a file can hold, from five parts in some order."""
    parts = [f"p{i}.part" for i in range(1, 6)]
    for options, ending in [*KINDS, ([], ".exr"), (["--bits", "16"], ".exr"), ([], ".hdr"),
                            (["--radiance"], ".pfm"), (["--crop", "10:5:41x23"], ".png"),
                            (["--seed", "4", *SENSOR, "--crop", "9:9:20x20"], ".png")]:
        folder.good("render", *COMMON, *options, "-o", "whole" + ending)
        for i, part in enumerate(parts):
            folder.good("render", *COMMON, *options, "--part", f"{i + 1}/5", "-o", part,
                        "--threads", str(1 + i % 2))
        shuffled = random.Random(ending).sample(parts, len(parts))
        folder.good("merge", *shuffled, "-o", "merged" + ending)
        folder.checks.check(folder.read("merged" + ending) == folder.read("whole" + ending),
                            f"{options} {ending}: merged parts are not the whole")


def check_many(folder):
    """More parts than tiles; several exposures; a picture with depths; standard output."""
    small = ["chart:star", "--lens", "double-gauss-50", "-s", "1m", "--size", "40x20", "--samples",
             "1"]
    for i in range(1, 13):
        folder.good("render", *small, "-t", "1/100,1/400", "--part", f"{i}/12", "-o", f"m{i}.part")
    names = [f"m{i}.part" for i in range(1, 13)]
    folder.good("merge", *names, "-o", "merged.pfm")
    folder.good("render", *small, "-t", "1/100,1/400", "-o", "whole.pfm")
    for i in 1, 2:
        folder.checks.check(folder.read(f"merged-{i}.pfm") == folder.read(f"whole-{i}.pfm"),
                            f"exposure {i} of merged parts")
    with open(os.path.join(folder.path, "depth.pfm"), "wb") as file:
        file.write(b"Pf\n2 1\n-1\n" + struct.pack("<2f", 1.0, 1.5))
    for options in ["--depth-map", "depth.pfm"], ["--samples", "256", "--error", "0.02"]:
        words = [*small[:-2], "-t", "1/100", *options]
        for i in 1, 2:
            folder.good("render", *words, "--part", f"{i}/2", "-o", f"d{i}.part")
        merged = folder.good("merge", "d2.part", "d1.part", "-o", "merged.pfm")
        whole = folder.good("render", *words, "-o", "whole.pfm")
        folder.checks.check(folder.read("merged.pfm") == folder.read("whole.pfm"), f"{options}")
        folder.checks.check(merged.stderr == whole.stderr,
                            f"{options}: {merged.stderr} {whole.stderr}")


def check_refused(folder):
    """By name, and nothing is written."""
    write = folder.write
    write("lens.lens", subprocess.run([*folder.program.command, "convert", "double-gauss-50"],
                                      capture_output=True, check=True,
                                      env=folder.program.environment()).stdout)
    write("card.pfm", b"Pf\n2 1\n-1\n" + struct.pack("<2f", 1.0, 0.5))
    words = ["card.pfm", "--lens", "lens.lens", "-s", "1m", "--size", "40x20", "--samples", "1"]
    for i in 1, 2, 3:
        folder.good("render", *words, "--part", f"{i}/3", "-o", f"r{i}.part")
    folder.good("render", *words, "--seed", "1", "--part", "2/3", "-o", "seed.part")
    folder.good("render", *words, "--part", "2/4", "-o", "other.part")
    whole = folder.read("r2.part")
    write("cut.part", whole[:-1])
    write("flipped.part", whole[:-9] + bytes([whole[-9] ^ 1]) + whole[-8:])
    write("version.part", whole.replace(b"\nversion ", b"\nversion 9", 1))
    cases = [(["r1.part", "r3.part"], "no part 2/3"),
             (["r1.part", "r2.part", "r3.part", "r2.part"], "r2.part and r2.part are both part"),
             (["r1.part", "seed.part", "r3.part"], "seed.part is not of the run of r1.part"),
             (["r1.part", "other.part", "r3.part"], "other.part is not of the run of r1.part"),
             (["r1.part", "cut.part", "r3.part"], "cut.part: the part is cut off"),
             (["r1.part", "flipped.part", "r3.part"], "flipped.part: the part is damaged"),
             (["r1.part", "version.part", "r3.part"], "version.part is not of the run of r1.part"),
             (["version.part"], "no part 1/3"),
             (["r1.part", "card.pfm", "r3.part"], "card.pfm: no part"),
             (["r1.part", "nowhere.part"], "no file nowhere.part")]
    for names, message in cases:
        folder.refused(message, "merge", *names, "-o", "refused.pfm")
    folder.refused("r2.part is part 2/3, not 1/3", "render", *words, "--part", "1/3", "--resume",
                   "-o", "r2.part")
    folder.refused("r2.part is not of a run of these", "render", *words, "-t", "1", "--part", "2/3",
                   "--resume", "-o", "r2.part")
    folder.checks.check(folder.read("r2.part") == whole, "a part that is refused is written to")
    good = ["merge", "r1.part", "r2.part", "r3.part", "-o"]
    folder.good(*good, "there.pfm")
    for name in "card.pfm", "lens.lens":
        before = folder.read(name)
        write(name, before.replace(b"\x3f", b"\x3e", 1) if name == "card.pfm" else before + b"\n")
        folder.refused("is not of a run of these words and files: input", *good, "refused.pfm")
        write(name, before)
    folder.good(*good, "there.pfm")


def check_stopped(folder):
    """Killed and run again; interrupted, which leaves a part that says so, and resumed."""
    words = ["chart:star", "--lens", "double-gauss-50", "-s", "1m", "--size", "240x160",
             "--samples", "64"]
    folder.good("render", *words, "-o", "whole.png")
    folder.good("render", *words, "--part", "1/2", "-o", "s1.part")
    for number, sign in (2, signal.SIGKILL), (3, signal.SIGINT):
        worker = subprocess.Popen([*folder.program.command, "render", *words, "--part", "2/2",
                                   "-o", "s2.part"], cwd=folder.path, stderr=subprocess.DEVNULL,
                                  env=folder.program.environment())
        time.sleep(0.15)
        worker.send_signal(sign)
        status = worker.wait()
        there = os.path.exists(os.path.join(folder.path, "s2.part"))
        if sign == signal.SIGKILL:
            folder.checks.check(status == -sign and not there, "a worker that is killed")
        elif status != 0:  # else it was too fast
            folder.checks.check(status == 1 and there, f"a worker that is interrupted: {status}")
            result = folder.run("merge", "s1.part", "s2.part", "--incomplete", "-o", "some.png")
            some, other = (pixels_of(folder.read(name))[0] for name in ("some.png", "whole.png"))
            black = bytes(16 * 3)
            wrong = sum(line[x:x + 48] not in (of[x:x + 48], black)
                        for line, of in zip(some, other) for x in range(0, 720, 48))
            folder.checks.check(result.returncode == 1 and some != other and wrong == 0 and
                                some[:72] == other[:72] and b"Incomplete" in
                                folder.read("some.png"), f"what there is: {wrong} {result.stderr}")
            folder.refused("s2.part is incomplete", "merge", "s1.part", "s2.part", "-o", "no.png")
        folder.good("render", *words, "--part", "2/2", "--resume", "-o", "s2.part")
        folder.good("merge", "s2.part", "s1.part", "-o", "merged.png")
        folder.checks.check(folder.read("merged.png") == folder.read("whole.png"),
                            f"part {number}: not the picture of one run")
        os.remove(os.path.join(folder.path, "s2.part"))


# Its first worker of part 2 is killed in the middle of it.
WORKER = """
if [ $1 = 2 ] && mkdir first 2> /dev/null; then
    lenscalc render %s --part $1/4 -o g$1.part &
    sleep 0.1
    kill -9 $!
    wait $!
else
    lenscalc render %s --part $1/4 -o g$1.part
fi
"""


def check_parallel(folder):
    """Under GNU parallel, which runs again what has failed."""
    if shutil.which("parallel") is None:
        print("no GNU parallel here: skipped")
        return
    words = ["chart:star", "--lens", "double-gauss-50", "-s", "1m", "--size", "160x120",
             "--samples", "64", *SENSOR]
    folder.write("worker", (WORKER % (" ".join(words), " ".join(words))).encode())
    environment = {**folder.program.environment(), "HOME": folder.path}
    result = subprocess.run(["parallel", "--will-cite", "--retries", "2", "-j", "2", "--joblog",
                             "jobs", "sh", "worker", ":::", "1", "2", "3", "4"], cwd=folder.path,
                            capture_output=True, text=True, env=environment)
    folder.checks.check(result.returncode == 0, f"parallel: {result.stderr}")
    log = [line.split("\t") for line in folder.read("jobs").decode().split("\n")[1:-1]]
    folder.checks.check(os.path.exists(os.path.join(folder.path, "first")) and
                        sorted(line[6] for line in log) == ["0"] * 4, f"jobs: {log}")
    folder.checks.check("Killed" in result.stderr or result.stderr.count("part 2/4") == 1,
                        f"no worker was killed: {result.stderr}")
    folder.good("merge", *[f"g{i}.part" for i in (4, 2, 3, 1)], "-o", "merged.png")
    folder.good("render", *words, "-o", "whole.png")
    folder.checks.check(folder.read("merged.png") == folder.read("whole.png"),
                        "parallel: not the picture of one run")


def main():
    program, checks = Program(sys.argv[1]), Checks()
    with tempfile.TemporaryDirectory(prefix="lenscalc-divided-") as path:
        folder = Folder(program, checks, path)
        check_crops(folder)
        check_pattern(folder)
        check_kinds(folder)
        check_many(folder)
        check_refused(folder)
        check_stopped(folder)
        check_parallel(folder)
    return checks.finish()


if __name__ == "__main__":
    sys.exit(main())
