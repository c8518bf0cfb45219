#!/usr/bin/env python3
"""tests/terminal/check_interrupt.py - long work ends at once: check_interrupt.py BUILD_DIR

Each command that can be made to run for long is interrupted when it has worked for a while, by
Ctrl-C or by the signal that batch queues send, and has one second of processor time to end: wall
clocks say nothing on a machine that others use too.
"""
# SPDX-License-Identifier: MIT

import json
import os
import signal
import subprocess
import sys
import tempfile
import time
import zlib

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program

WORKED, MOST = 0.1, 1.5  # s of processor time, before the signal and after it
GIVEN_UP = 120           # s

STACK = ("lens stack\nwavelength d\nobject inf\naperture epd 5\n" +
         "".join(f"surface {1000 + i} 0.5 1.5/60 20\nsurface {-1000 - i} 0.5 air 20\n"
                 for i in range(4000)))
BALL = ("camera at=0,0,3 look=0,0,0 focus=3\nmaterial grey lambert colour=0.5\n"
        "light sky uniform luminance=1000\nsphere radius=0.5 material=grey\n"
        "plane at=0,-1,0 normal=0,1,0 material=grey\n")
OPTIMIZE = ["optimize", "double-gauss", "--vary", "R1..R11", "--goals", "poly,efl=100", "--csv"]
TOLERANCE = ["tolerance", "double-gauss", "--grade", "precision", "--csv", "--rays", "100000"]
CARD = ["render", "chart:star", "-s", "1m", "--lens", "double-gauss-50"]

# What would go on for long, on any machine; two threads where threads are asked for. What notices a
# signal late is ended by the watcher after half a second.
CASES = [
    ["psf", "double-gauss", "--size", "2048", "--threads", "2", "--field", "0,3,7", "--csv"],
    ["trace", "double-gauss", "--pattern", "square", "--rays", "9000000", "--csv", "-o", "rays.csv"],
    ["spot", "nikkor-z-14-24", "--rays", "10000000", "--field", "0,10,20", "--threads", "2"],
    ["mtf", "nikkor-z-14-24", "--field", "0..20:0.001", "--force", "--json"],
    ["distortion", "nikkor-z-14-24", "--field", "0..30:0.001", "--csv"],
    ["dof", "-f", "50", "-N", "4", "-s", "1..9000000:0.1", "--csv", "--force"],
    [*OPTIMIZE, "--rays", "600", "--global", "30000"],
    ["optimize", "stack.lens", "--vary", "all-R", "--rays", "1000"],
    TOLERANCE,
    ["report", "stack.lens", "-o", "stack.html"],
    ["render", "ball.scene", *CARD[4:], "--size", "64x64", "-t", "1", "--samples", "1048576", "-o",
     "ball.part"],
    [*CARD, "--size", "640x480", "--samples", "1048576", "--noise", "-o", "star.png"],
    [*CARD, "--size", "6000x4000", "--samples", "1048576", "--bits", "16", "-o", "deep.png"],
    ["render", "--lens", "double-gauss-50", "--rays", "-", "--samples", "1000000000"],
    ["tone", "large.pfm", "--acuity", "--glare", "-o", "tone.png"],
    ["trace", "double-gauss", "--batch", "rays-in.csv", "--json"],
    ["illumination", "nikkor-z-14-24", "--height", "0..20:0.001", "--csv"],
    [*TOLERANCE, "--show", "offenders"],
    ["render", "ball.scene", *CARD[4:], "--size", "64x64", "-t", "1", "--samples", "1048576", "-o",
     "ball.png"],
    [*CARD, "--size", "4000x3000", "--samples", "1048576", "--noise", "-o", "noisy.png"],
    [*CARD, "--size", "6000x4000", "--samples", "1048576", "-o", "large.exr"],
    ["render", "--lens", "double-gauss-50", "--rays", "film.csv", "--samples", "1000000000"],
    ["psf", "double-gauss", "--size", "2048", "--csv"],
    ["psf", "double-gauss", "--size", "2048", "--plot", "psf.svg"],
    ["spot", "nikkor-z-14-24", "--rays", "10000000", "--csv"],
    [*OPTIMIZE, "--rays", "100000", "--iterations", "1000000"],
    ["tolerance", "stack.lens", "--grade", "precision"],
    [*CARD, "--size", "6000x4000", "--samples", "1048576", "-o", "large.png"],
    [*CARD, "--size", "6000x4000", "--samples", "1048576", "-o", "large.hdr"],
]


def worked(pid):
    """Processor time, s, of a process."""
    with open(f"/proc/{pid}/stat", encoding="ascii") as file:
        fields = file.read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def start(program, words, folder):
    """It, when it has worked for a while; how long then, s."""
    process = subprocess.Popen(program.command + words, cwd=folder, stdin=subprocess.DEVNULL,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                               env=program.environment())
    end = time.monotonic() + GIVEN_UP
    os.set_blocking(process.stdout.fileno(), False)
    answer, spent = b"", 0
    while time.monotonic() < end and process.poll() is None and spent < WORKED:
        answer += process.stdout.read() or b""
        spent = worked(process.pid)
        time.sleep(0.01)
    return process, answer, spent


def finish(process, answer):
    """What it answers, what it says, and processor time in all, s; it is killed in the end."""
    end = time.monotonic() + GIVEN_UP
    spent = 0
    os.set_blocking(process.stderr.fileno(), False)
    error = b""
    while time.monotonic() < end:
        answer += process.stdout.read() or b""
        error += process.stderr.read() or b""
        state = os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOHANG | os.WNOWAIT)
        spent = worked(process.pid)
        if state is not None:
            break
        time.sleep(0.01)
    process.kill()
    answer += process.stdout.read() or b""
    error += process.stderr.read() or b""
    process.wait()
    return answer, error, spent


def interrupt(checks, program, words, folder, which=signal.SIGINT):
    """Its status, answer and messages."""
    process, answer, before = start(program, words, folder)
    name = " ".join(words)
    if process.poll() is not None:
        checks.check(False, f"{name}: ends by itself: {process.stderr.read()!r}")
        return process.returncode, answer, b""
    process.send_signal(which)
    answer, error, after = finish(process, answer)
    checks.check(process.returncode in (1, -which), f"{name}: {process.returncode}, {error!r}")
    checks.check(after - before < MOST, f"{name}: {after - before:.1f} s of work after the signal")
    checks.check(process.returncode != 1 or b"interrupted" in error, f"{name}: {error!r}")
    return process.returncode, answer, error


def check_prompt(checks, program, folder):
    """All of them, by both signals in turn."""
    for number, words in enumerate(CASES):
        before = set(os.listdir(folder))
        interrupt(checks, program, words, folder, (signal.SIGINT, signal.SIGTERM)[number % 2])
        new = set(os.listdir(folder)) - before
        # what is left is marked by its name, or is a part that goes on
        checks.check(all("-incomplete." in name or name.endswith(".part") for name in new),
                     f"{' '.join(words)}: leaves {new}")


def check_rows(checks, program, folder):
    """Rows that were there before a slow one are a complete answer that says so."""
    for which in (signal.SIGINT, signal.SIGTERM):
        status, answer, error = interrupt(checks, program, ["psf", "double-gauss", "--size",
                                                            "64,2048", "--field", "0", "--json"],
                                          folder, which)
        rows = json.loads(answer or b'{"rows": [{}]}')["rows"]
        checks.check(status == 1 and len(rows) == 2 and rows[0]["peak_x_um"] is not None and
                     "interrupted" in rows[1]["error"], f"rows so far: {answer!r}, {error!r}")


def check_older(checks, program, folder):
    """A finished picture of that name stays as it is, and the unfinished one is named."""
    path = os.path.join(folder, "old.png")
    words = ["render", "ball.scene", *CARD[4:], "--size", "16x16", "-t", "1", "-o", "old.png"]
    program.run(*words, "--samples", "1", cwd=folder)
    with open(path, "rb") as file:
        finished = file.read()
    for which in (signal.SIGINT, signal.SIGTERM):
        _, _, error = interrupt(checks, program, [*words, "--samples", "1048576"], folder, which)
        with open(path, "rb") as file:
            checks.check(file.read() == finished, "an older picture is another one")
        aside = os.path.join(folder, "old-incomplete.png")
        checks.check(os.path.exists(aside) and b"old-incomplete.png" in error, f"aside: {error!r}")
        with open(aside, "rb") as file:
            unfinished = file.read()
        checks.check(b"Incomplete\0interrupted" in unfinished, "it says that it is incomplete")
        at = unfinished.index(b"IDAT")
        packed = unfinished[at + 4:at + 4 + int.from_bytes(unfinished[at - 4:at], "big")]
        checks.check(len(zlib.decompress(packed)) % 16 == 0, "its rows are there")
        os.remove(aside)


def check_resumed(checks, program, folder):
    """A part that SIGTERM ended goes on, to the bytes of one that went through."""
    words = ["render", "ball.scene", *CARD[4:], "--size", "64x64", "-t", "1", "--samples", "256",
             "--bounces", "8"]
    interrupt(checks, program, [*words, "-o", "resumed.part"], folder, signal.SIGTERM)
    results = [program.run(*words, "-o", "resumed.part", "--resume", cwd=folder),
               program.run(*words, "-o", "through.part", cwd=folder)]
    parts = []
    for name in ("resumed", "through"):
        with open(os.path.join(folder, f"{name}.part"), "rb") as file:
            parts.append(file.read())
    checks.check(all(result.returncode == 0 for result in results) and parts[0] == parts[1],
                 f"resumed: {results}")


def check_ignored(checks, program, folder):
    """Who ignores Ctrl-C, as jobs of a shell in the background do, goes on ignoring it."""
    ignored = Program(sys.argv[1])
    ignored.command = ["sh", "-c", 'trap "" INT; exec "$@"', "sh", *program.command]
    process, answer, _ = start(ignored, ["psf", "double-gauss", "--size", "2048", "--csv"], folder)
    process.send_signal(signal.SIGINT)
    time.sleep(1)
    checks.check(process.poll() is None, "an ignored signal ends it")
    process.send_signal(signal.SIGTERM)
    _, error, _ = finish(process, answer)
    checks.check(process.returncode == 1 and b"interrupted" in error, f"ignored: {error!r}")


def main():
    # jobs in the background of a shell ignore Ctrl-C, and what they start does too
    signal.signal(signal.SIGINT, signal.default_int_handler)
    checks, program = Checks(), Program(sys.argv[1])
    with tempfile.TemporaryDirectory(prefix="lenscalc-interrupt-") as folder:
        for name, text in (("stack.lens", STACK), ("ball.scene", BALL),
                           ("rays-in.csv", "x_mm,y_mm,z_mm,cos_x,cos_y,cos_z\n" +
                            "0,0,-10,0,0,1\n" * 3000000)):
            with open(os.path.join(folder, name), "w", encoding="ascii") as file:
                file.write(text)
        with open(os.path.join(folder, "large.pfm"), "wb") as file:
            file.write(b"PF\n3000 2000\n-1.0\n" + b"\0\0\x80\x3f" * 3 * 6000000)
        for check in (check_prompt, check_rows, check_older, check_resumed, check_ignored):
            check(checks, program, folder)
    checks.finish()


main()
