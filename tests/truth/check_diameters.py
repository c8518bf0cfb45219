#!/usr/bin/env python3
"""tests/truth/check_diameters.py - diameters from the beams, against rays traced here:
check_diameters.py BUILD_DIR

The rays are Snell's law in vectors through spheres and planes, aimed by secants at points of the
stop, whose radius is that of a paraxial ray. With a margin of none every diameter is the largest of
theirs, rounded up to four digits; so it is when optimize writes them, of the lens that it has found.
"""
# SPDX-License-Identifier: MIT

import math
import os
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program

D, F, C = 0.5875618, 0.4861327, 0.6562725  # um
HEAD = """lens Two menisci
wavelength d F C
field angle 0 9 15
aperture {}
focus paraxial
"""
# radius, thickness, nd, Vd behind
SURFACES = [[22, 3, 1.62, 60.3], [60, 4, 1, 0], [0, 5, 1, 0], [-70, 2.5, 1.7, 30], [-24, 50, 1, 0]]
STOP = 2


def write(name, aperture, surfaces, diameters=None):
    with open(name, "w") as file:
        file.write(HEAD.format(aperture))
        for i, (radius, gap, nd, vd) in enumerate(surfaces):
            medium = f"{nd}/{vd}" if vd else "air"
            diameter = diameters[i] if diameters else "-"
            word = "stop - " if i == STOP else f"surface {radius or '-'} "
            file.write(f"{word} {gap} {medium} {diameter}\n")
    return name


def read(name):
    """radius and diameter of each surface"""
    with open(name) as file:
        lines = [line.split() for line in file if line.startswith(("surface", "stop"))]
    return [[float(words[at]) if words[at] != "-" else None for at in (1, 4)] for words in lines]


def index(nd, vd, wavelength):
    """A + B/l^2 through nd and nF - nC"""
    if not vd:
        return nd
    b = (nd - 1) / vd / (F**-2 - C**-2)
    return nd + b * (wavelength**-2 - D**-2)


def trace(surfaces, wavelength, point, direction):
    """Where a ray meets every surface, in the frame of each vertex."""
    n, met = 1.0, []
    x, d = list(point), list(direction)
    for radius, gap, nd, vd in surfaces:
        c = 1 / radius if radius else 0.0
        # c |x + s d|^2 = 2 (z + s dz)
        b = d[2] - c * sum(x[k] * d[k] for k in range(3))
        q = c * sum(v * v for v in x) - 2 * x[2]
        s = q / (b + math.sqrt(b * b - c * q))
        x = [x[k] + s * d[k] for k in range(3)]
        met.append(math.hypot(x[0], x[1]) if radius or len(met) != STOP else (x[0], x[1]))
        behind = index(nd, vd, wavelength)
        normal = [-c * x[0], -c * x[1], 1 - c * x[2]]
        cosine = sum(d[k] * normal[k] for k in range(3))
        mu = n / behind
        root = math.sqrt(1 - mu * mu * (1 - cosine * cosine))
        d = [mu * d[k] + (root - mu * cosine) * normal[k] for k in range(3)]
        x[2] -= gap
        n = behind
    return met


def paraxial(surfaces, y, u):
    n, heights = 1.0, []
    for radius, gap, nd, vd in surfaces:
        heights.append(y)
        behind = index(nd, vd, D)
        u = (n * u - y * (behind - n) * (1 / radius if radius else 0)) / behind
        n, y = behind, y + gap * u
    return heights, u


def largest(surfaces, fnumber):
    """Of every surface the height of the outermost ray."""
    heights, u = paraxial(surfaces, 1.0, 0.0)
    efl = -1 / u
    stop = efl / fnumber / 2 * heights[STOP]
    most = [0.0] * len(surfaces)
    for degrees in (0, 9, 15):
        t = math.radians(degrees)
        direction = (0, math.sin(t), math.cos(t))
        for wavelength in (D, F, C):
            for k in range(32):
                angle = 2 * math.pi * k / 32
                goal = (stop * math.cos(angle), stop * math.sin(angle))
                x = [goal[0], goal[1] - 8 * math.tan(t)]
                for _ in range(12):  # Newton's method, its slopes by differences
                    at = trace(surfaces, wavelength, (*x, 0), direction)[STOP]
                    beside = [trace(surfaces, wavelength, (x[0] + h, x[1] + 1e-6 - h, 0),
                                    direction)[STOP] for h in (1e-6, 0)]
                    a, b = [(p[0] - at[0]) / 1e-6 for p in beside]
                    c, e = [(p[1] - at[1]) / 1e-6 for p in beside]
                    r, det = [goal[0] - at[0], goal[1] - at[1]], a * e - b * c
                    x[0] += (e * r[0] - b * r[1]) / det
                    x[1] += (a * r[1] - c * r[0]) / det
                for i, height in enumerate(trace(surfaces, wavelength, (*x, 0), direction)):
                    most[i] = max(most[i], height if i != STOP else 0)
    return most


def compare(checks, what, diameters, most, margin):
    for i, half in enumerate(most):
        if i == STOP:
            checks.check(diameters[i] is None, f"{what}: the stop has become {diameters[i]}")
            continue
        true = 2 * half * (1 + margin)
        checks.check(true * (1 - 1e-4) <= diameters[i] <= true * (1 + 1.1e-3),
                     f"{what}: surface {i + 1}: {diameters[i]}, rays have {true}")


def main():
    checks, program = Checks(), Program(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        lens = write("two.lens", "f/5", SURFACES)
        most = largest(SURFACES, 5)
        for words, margin in ((("0",), 0), ((), 0.02), (("10%",), 0.1)):
            program.run("convert", lens, "-o", "sized.lens", "--force", "--set-diameters", *words)
            compare(checks, f"margin {margin}", [one[1] for one in read("sized.lens")], most,
                    margin)
        # diameters that are there give way, the stop's does not
        old = write("old.lens", "stop", SURFACES, [3, 3, 4.25, 3, 300])
        program.run("convert", old, "-o", "new.lens", "--set-diameters=0")
        news = [one[1] for one in read("new.lens")]
        checks.check(news[STOP] == 4.25 and 4 < news[0] < 20 and news[4] < 20, f"anew: {news}")
        # nothing is cut by them
        for field in ("0", "15"):
            spots = [float(program.rows("spot", "sized.lens", "--field", field, word,
                                        "--columns", "rms")[0]["rms_um"])
                     for word in ("--clip", "--no-clip")]
            checks.near("clipped", f"spot of {field} deg", *spots, 1e-4 * spots[1])
        # as optimize writes them
        rows = program.rows("optimize", lens, "--vary", "R1,R2,R4,R5", "--goals", "poly,efl=40",
                            "--set-diameters", "0", "-o", "found.lens")
        checks.check(isinstance(rows, list), rows)
        found = read("found.lens")
        surfaces = [[one[0] or 0, *SURFACES[i][1:]] for i, one in enumerate(found)]
        compare(checks, "optimize", [one[1] for one in found], largest(surfaces, 5), 0)
        graded = program.run("tolerance", "found.lens", "--grade", "commercial", "--trials", "10")
        checks.check(graded.returncode == 0, f"tolerance: {graded.stderr.decode()}")
        # a beam that does not arrive has no size
        with open("lost.lens", "w") as file:
            file.write("aperture epd 20\nsurface - 4 1.9 - stop\nsurface -11 50 air -\n")
        lost = program.run("convert", "lost.lens", "--set-diameters")
        checks.check(lost.returncode != 0 and b"--set-diameters" in lost.stderr and
                     lost.stdout == b"", f"lost: {lost.stderr.decode()}")
    checks.finish()


if __name__ == "__main__":
    main()
