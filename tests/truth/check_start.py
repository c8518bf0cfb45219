#!/usr/bin/env python3
"""tests/truth/check_start.py - lenses that optimize --start makes from nothing, judged by rays of
this script: check_start.py BUILD_DIR

What is asked for has to be there: the focal length, the f-number, the field, thick glass and edges,
room between elements, the track; and spots that a designer of that kind of lens would keep. The
limits are those of published lenses of the same elements, at the same focal length: of a triplet
the Zemax sample, f/5 and 20 deg, 24 um in its corner, here at f/4.

A search without an end is killed: the file of its best lens is there, whole, with a note; and it is
interrupted, or its time is up, and answers with the best.
"""
# SPDX-License-Identifier: MIT

import math
import os
import signal
import subprocess
import sys
import time

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import EVERYTHING, Checks, Program

# words, further options, rms spot in um that no field exceeds
CASES = [("elements=3,efl=50mm,fnumber=4,field=20deg", "--global 8 --escapes 0 --seed 1", 12)]
if EVERYTHING:
    CASES += [("elements=4,efl=50mm,fnumber=2.8,field=22deg", "--global 30 --relocate 1", 15),
              ("elements=5,efl=50mm,fnumber=2,field=22deg", "--global 100", 15),
              ("elements=4,efl=200mm,fnumber=4,field=6deg,track=160mm", "--global 60", 10),
              ("elements=3,efl=100mm,fnumber=20,field=20deg,stop=0", "--global 40", 15)]



def read_lens(path):
    """Surfaces (curvature, thickness, medium, is stop), and the lines with other words."""
    surfaces, words = [], {}
    for line in open(path, encoding="utf-8"):
        cells = line.split("#")[0].split()
        if cells and cells[0] in ("surface", "stop"):
            c = [x[2:] for x in cells if x.startswith("c=")]
            thickness = float(cells[1 if cells[0] == "stop" and len(cells) < 5 else 2])
            radius = 0.0 if cells[1] == "-" else 1 / float(cells[1])
            surfaces.append((float(c[0]) if c else radius, thickness, cells[3],
                             cells[0] == "stop"))
        elif cells:
            words.setdefault(cells[0], []).append(" ".join(cells[1:]))
    return surfaces, words


def trace(surfaces, x, y, cosines):
    """From the plane of the first vertex to the image plane: x, y there and in the stop."""
    L, M, N = cosines
    z, n, stop = 0.0, 1.0, None
    for c, thickness, medium, is_stop in surfaces:
        after = 1.0 if medium == "air" else float(medium.split("/")[0])
        s = -z / N
        x, y, z = x + s * L, y + s * M, 0.0
        f = c * (x * x + y * y)
        g = N - c * (x * L + y * M)
        inside = g * g - c * f
        if inside < 0:
            return None
        s = f / (g + math.sqrt(inside))
        x, y, z = x + s * L, y + s * M, s * N
        if is_stop:
            stop = (x, y)
        normal = (-c * x, -c * y, 1 - c * z)
        cosine = L * normal[0] + M * normal[1] + N * normal[2]
        squared = 1 - (n / after) ** 2 * (1 - cosine * cosine)
        if squared < 0:
            return None
        turn = math.sqrt(squared) - n / after * cosine
        L, M, N = (n / after * a + turn * b for a, b in zip((L, M, N), normal))
        n, z = after, z - thickness
    s = -z / N
    return x + s * L, y + s * M, stop


def paraxial(surfaces):
    """Focal length, and the radius of the stop of a beam of radius 1."""
    y, u, n, stop = 1.0, 0.0, 1.0, None
    for c, thickness, medium, is_stop in surfaces:
        after = 1.0 if medium == "air" else float(medium.split("/")[0])
        u = (n * u - y * c * (after - n)) / after
        stop = y if is_stop else stop
        y, n = y + u * thickness, after
    return -1 / u, abs(stop)


def aimed(surfaces, angle, target):
    """Newton's steps to a point of the stop, from differences."""
    cosines = (0.0, math.sin(angle), math.cos(angle))
    before = 0.0
    for c, thickness, _, is_stop in surfaces:
        if is_stop:
            break
        before += thickness
    at = [target[0], target[1] - before * math.tan(angle) * 0.7]
    for _ in range(30):
        here = trace(surfaces, *at, cosines)
        if here is None:
            at = [0.8 * at[0], 0.8 * at[1]]
            continue
        wrong = [here[2][i] - target[i] for i in (0, 1)]
        if max(map(abs, wrong)) < 1e-7:
            return here
        d, columns = 1e-5, []
        for i in (0, 1):
            moved = list(at)
            moved[i] += d
            there = trace(surfaces, *moved, cosines)
            if there is None:
                return None
            columns.append([(there[2][k] - here[2][k]) / d for k in (0, 1)])
        (a, b), (c, e) = columns
        det = a * e - b * c
        at[0] -= (wrong[0] * e - wrong[1] * c) / det
        at[1] -= (a * wrong[1] - b * wrong[0]) / det
    return None


def spot(surfaces, angle, radius):
    """RMS spot in um of equal areas of the stop, at d."""
    points = []
    for ring in range(4):
        r = radius * math.sqrt((ring + 0.5) / 4)
        for k in range(12):
            turn = 2 * math.pi * (k + 0.5 * (ring % 2)) / 12
            there = aimed(surfaces, angle, (r * math.cos(turn), r * math.sin(turn)))
            if there is None:
                return math.inf
            points.append(there[:2])
    mean = [sum(p[i] for p in points) / len(points) for i in (0, 1)]
    return 1e3 * math.sqrt(sum((p[0] - mean[0]) ** 2 + (p[1] - mean[1]) ** 2
                               for p in points) / len(points))


def judge(checks, words, path, most):
    asked = dict(pair.split("=") for pair in words.split(","))
    surfaces, lines = read_lens(path)
    focal, stop = paraxial(surfaces)
    efl = float(asked["efl"].replace("mm", ""))
    checks.check(abs(focal / efl - 1) < 0.005, "%s: focal length %g" % (words, focal))
    glasses = [s for s in surfaces if s[2] != "air"]
    checks.check(len(glasses) == int(asked["elements"]), "%s: elements" % words)
    checks.check(lines["aperture"] == ["f/" + asked["fnumber"]], "%s: aperture" % words)
    checks.check(lines["wavelength"] == ["d F C"] and "lens" in lines and "goal" in lines,
                 "%s: its words %s" % (words, lines))
    field = float(lines["field"][0].split()[-1])
    checks.check(abs(field - float(asked["field"].replace("deg", ""))) < 1e-6, "%s: field" % words)
    checks.check(all(s[1] > (0.5 if s[2] != "air" else -1e-9) for s in surfaces),
                 "%s: thicknesses %s" % (words, [s[1] for s in surfaces]))
    if "track" in asked:
        track = sum(s[1] for s in surfaces)
        checks.check(track < 1.01 * float(asked["track"].replace("mm", "")),
                     "%s: track %g" % (words, track))
    radius = stop * efl / float(asked["fnumber"]) / 2
    for share in (0, 0.3, 0.55, 0.85, 1):
        rms = spot(surfaces, math.radians(field * share), radius)
        checks.check(rms < most, "%s: spot %.3g um at %g of the field" % (words, rms, share))


def check_endless(checks, program):
    """--global many, until it is killed, interrupted, or the time is up."""
    words = "optimize --start elements=2,efl=100mm,fnumber=8,field=2deg --global many --rays 9"
    for name, end in (("killed", signal.SIGKILL), ("ended", signal.SIGINT), ("timed", None)):
        path = os.path.join(program.holder.name, name + ".lens")
        more = " --keep 1 -o " + path + (" --seconds 0.5" if end is None else "")
        process = subprocess.Popen(program.command + (words + more).split(),
                                   env=program.environment(), stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE)
        until = time.monotonic() + 60
        while end is not None and not os.path.exists(path) and time.monotonic() < until:
            time.sleep(0.02)
        if end is not None:
            process.send_signal(end)
        _, said = process.communicate(timeout=60)
        if end is None and b"before any start came to its end" in said:
            continue  # a busy machine
        wanted = {"killed": -signal.SIGKILL, "ended": 1, "timed": 0}[name]
        checks.check(process.returncode == wanted, "%s: status %d: %s" % (name, process.returncode,
                                                                          said))
        text = open(path, encoding="utf-8").read() if os.path.exists(path) else ""
        checks.check(("incomplete" in text) == (end is not None), "%s: note in %s" % (name, text))
        focal = paraxial(read_lens(path)[0])[0] if text else math.nan
        checks.check(abs(focal - 100) < 1, "%s: focal length %g" % (name, focal))


def main():
    program = Program(sys.argv[1])
    checks = Checks()
    for number, (words, options, most) in enumerate(CASES):
        ask = "optimize --start %s %s --keep 2 --rays 16 --force -o " % (words, options)
        text = {}
        for threads in (1, 2):
            name = os.path.join(program.holder.name, "start%d-%d" % (number, threads))
            result = program.run(*(ask + name + ".lens --threads %d" % threads).split())
            checks.check(result.returncode == 0, "%s: %s" % (words, result.stderr))
            path = name + "-1.lens"
            text[threads] = open(path, encoding="utf-8").read()
        checks.check(text[1] == text[2], "%s: threads make another lens" % words)
        judge(checks, words, path, most)
    check_endless(checks, program)
    return checks.finish()


sys.exit(main())
