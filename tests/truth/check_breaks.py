#!/usr/bin/env python3
"""tests/truth/check_breaks.py - coordinate breaks of .zmx files: check_breaks.py BUILD_DIR

The axis of the .lens file that lenscalc makes is followed here, by what lenscalc-lens.5 says of a
bend, and compared with that of the .zmx file, followed by what OpticStudio says of its rotation
matrix R = Rx Ry Rz, local to global, right-handed (shift first; order 1: the other way round), and
with numbers worked out by hand. A ray along the axis is reflected from mirror to mirror.
"""
# SPDX-License-Identifier: MIT

import csv
import math
import os
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import SHARED, Checks, Program

HEAD = "MODE SEQ\nUNIT MM\nSURF 0\n  DISZ INFINITY\nSURF 1\n  DISZ 30\n"
FOLD = ("SURF 2\n  TYPE COORDBRK\n{0}  DISZ 0\nSURF 3\n  GLAS MIRROR 0 0\n  DISZ 0\n"
        "SURF 4\n  TYPE COORDBRK\n{0}  DISZ -40\nSURF 5\n  DISZ -10\nSURF 6\n")


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def turn(axis, degrees):
    """Right-handed about x, y or z: the columns are the new axes."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    i, j = (axis + 1) % 3, (axis + 2) % 3
    matrix = [[float(a == b) for b in range(3)] for a in range(3)]
    matrix[i][i] = matrix[j][j] = c
    matrix[i][j], matrix[j][i] = -s, s
    return matrix


class Frame:
    def __init__(self):
        self.at, self.axes = [0., 0., 0.], turn(0, 0)

    def shift(self, x, y, z):
        self.at = [self.at[i] + sum(self.axes[i][k] * (x, y, z)[k] for k in range(3))
                   for i in range(3)]

    def turn(self, axis, degrees):
        self.axes = product(self.axes, turn(axis, degrees))

    def plane(self):
        return list(self.at), [self.axes[i][2] for i in range(3)]


def of_zmx(text):
    """(vertex, normal, is a mirror) of each surface that is no break."""
    surfaces, frame, planes = [], Frame(), []
    for line in text.splitlines():
        words = line.split()
        if words[:1] == ["SURF"]:
            surfaces.append({"PARM": {}, "DISZ": 0., "GLAS": "", "SCBD": {}})
        elif words and surfaces and words[0] == "PARM":
            surfaces[-1]["PARM"][int(words[1])] = float(words[2])
        elif words and surfaces and words[0] == "DISZ" and words[1] != "INFINITY":
            surfaces[-1]["DISZ"] = float(words[1])
        elif words and surfaces and words[0] == "SCBD":
            surfaces[-1]["SCBD"][int(words[1])] = [float(word) for word in words[2:]]
        elif words and surfaces and words[0] in ("GLAS", "TYPE"):
            surfaces[-1][words[0]] = words[1]
    for surface in surfaces[1:-1]:
        value = lambda i: surface["PARM"].get(i, 0.)
        before, behind = (surface["SCBD"].get(i, [0] * 7) for i in (1, 2))
        follow(frame, before)
        if surface.get("TYPE") == "COORDBRK":
            steps = [lambda: frame.shift(value(1), value(2), 0), lambda: frame.turn(0, value(3)),
                     lambda: frame.turn(1, value(4)), lambda: frame.turn(2, value(5))]
            for step in reversed(steps) if value(6) else steps:
                step()
        else:
            planes.append(frame.plane() + (surface["GLAS"] == "MIRROR",))
        if behind[1] == 0:
            follow(frame, behind)
        else:
            follow(frame, before, undone=behind[1] == 2)
        frame.shift(0, 0, surface["DISZ"])
    return planes


def follow(frame, shift, undone=False):
    """SCBD order status dx dy tx ty tz: as a coordinate break; undone step by step."""
    sign = -1 if undone else 1
    dx, dy, *turns = (sign * number for number in shift[2:])
    steps = [lambda: frame.shift(dx, dy, 0)]
    steps += [lambda axis=axis: frame.turn(axis, turns[axis]) for axis in range(3)]
    for step in reversed(steps) if (shift[0] != 0) != undone else steps:
        step()


def of_lens(text):
    """The same of a .lens file, planes that only carry a bend among them."""
    frame, planes = Frame(), []
    for line in text.splitlines():
        words = line.split()
        if words[:1] == ["bend"]:
            parts = dict(word.split("=") for word in words[1:])
            shift = [float(x) for x in parts.get("decenter", "0,0").split(",")]
            frame.shift(shift[0], shift[1], 0)
            for axis, degrees in enumerate(parts.get("tilt", "0").split(",")):
                frame.turn(axis, float(degrees))
        elif words[:1] in (["surface"], ["stop"]):
            planes.append(frame.plane() + (words[3] == "mirror",))
            frame.shift(0, 0, 0 if words[2] == "-" else float(words[2]))
    return planes


def near(a, b):
    return all(abs(x - y) < 1e-9 for x, y in zip(a, b))


def convert(program, path):
    result = program.run("convert", path, "--lossy", "--to", "lens")
    return result.stdout.decode()


def check_same(checks, name, zmx, lens):
    """Every surface of the file stands in the lens, in order, at its place."""
    rest = iter(lens)
    for at, normal, mirror in zmx:
        found = any(near(at, b) and near(normal, n) and mirror == m for b, n, m in rest)
        checks.check(found, f"{name}: no surface at {at} along {normal}")


def check_folded(checks, name, planes, radii):
    """A ray from the left along the axis meets every mirror, at most so far from its vertex."""
    point, direction, mirrors = [0., 0., -1.], [0., 0., 1.], [plane for plane in planes if plane[2]]
    checks.check(len(mirrors) == len(radii), f"{name}: {len(mirrors)} mirrors")
    for (at, normal, _), radius in zip(mirrors, radii):
        cosine = sum(n * d for n, d in zip(normal, direction))
        along = sum(n * (a - p) for n, a, p in zip(normal, at, point)) / cosine
        point = [p + along * d for p, d in zip(point, direction)]
        checks.check(along > 0 and math.dist(point, at) <= radius + 1e-9,
                     f"{name}: the ray misses {at} by {math.dist(point, at)}")
        direction = [d - 2 * cosine * n for d, n in zip(direction, normal)]


def main():
    checks, program = Checks(), Program(sys.argv[1])
    path = os.path.join(program.holder.name, "fold.zmx")
    cases = [  # parameters, where the next vertex lies: by hand
        ("  PARM 3 45\n", [0, 40, 30]), ("  PARM 3 -45\n", [0, -40, 30]),
        ("  PARM 4 45\n", [-40, 0, 30]), ("  PARM 4 -45\n", [40, 0, 30]),
        ("  PARM 3 45\n  PARM 5 0\n  PARM 6 1\n", [0, 40, 30])]
    for parameters, vertex in cases:
        text = HEAD + FOLD.format(parameters)
        with open(path, "w") as file:
            file.write(text)
        planes = of_lens(convert(program, path))
        checks.check(any(near(at, vertex) for at, _, _ in planes), f"{parameters}: {planes}")
        check_same(checks, parameters, of_zmx(text), planes)
        check_folded(checks, parameters, planes, [0])
    # all at once, in both orders: shift, x, y, z or z, y, x, shift
    for order in (0, 1):
        numbers = "".join(f"  PARM {i + 1} {x}\n" for i, x in enumerate((1.5, -2, 10, 20, 30, order)))
        text = HEAD + "SURF 2\n  TYPE COORDBRK\n" + numbers + "  DISZ 5\nSURF 3\n  DISZ 7\nSURF 4\n" \
            "  DISZ 1\nSURF 5\n"
        with open(path, "w") as file:
            file.write(text)
        check_same(checks, f"order {order}", of_zmx(text), of_lens(convert(program, path)))
    # before and behind a surface: its own numbers, those before it again, those before it undone
    tilts = ("1.5 -2 10 20 30", "0 0 45 0 0", "-1 0.5 -7 3 11")
    for order in (0, 1):
        for status, behind in ((0, tilts[2]), (1, "0 0 0 0 0"), (2, "0 0 0 0 0")):
            for tilt in tilts:
                text = (HEAD + f"SURF 2\n  SCBD 1 {order} 0 {tilt}\n"
                        f"  SCBD 2 {1 - order} {status} {behind}\n  GLAS MIRROR 0 0\n  DISZ -7\n"
                        "SURF 3\n  DISZ -5\nSURF 4\n  DISZ 1\nSURF 5\n")
                with open(path, "w") as file:
                    file.write(text)
                check_same(checks, f"SCBD {order} {status} {tilt}", of_zmx(text),
                           of_lens(convert(program, path)))
    # a fold by one surface: light goes on along the axis behind it
    text = HEAD + ("SURF 2\n  SCBD 1 0 0 0 0 45 0 0\n  SCBD 2 0 1 0 0 0 0 0\n  GLAS MIRROR 0 0\n"
                   "  DISZ -40\nSURF 3\n  DISZ -10\nSURF 4\n")
    with open(path, "w") as file:
        file.write(text)
    planes = of_lens(convert(program, path))
    checks.check(any(near(at, [0, 40, 30]) for at, _, _ in planes), f"SCBD: {planes}")
    check_folded(checks, "SCBD", planes, [0])
    # a parabola off its axis by twice its focal length turns light by 90 degrees; all of it goes
    # through the focus, on a plane turned either way that stands across it
    for tilt in (90, -90, 60, -60):
        text = ("MODE SEQ\nUNIT MM\nENPD 50\nYFLN 0\nSURF 0\n  DISZ INFINITY\nSURF 1\n  STOP\n"
                "  DISZ 200\nSURF 2\n  TYPE COORDBRK\n  PARM 2 -190.6\n  DISZ 0\nSURF 3\n"
                "  CURV -5.246589716684155885E-03\n  CONI -1\n  DISZ -95.3\n  GLAS MIRROR 0 0\n"
                f"SURF 4\n  SCBD 1 0 0 0 0 {tilt} 0 0\n")
        with open(path, "w") as file:
            file.write(text)
        answer = program.run("trace", path, "--csv").stdout.decode()
        rows = list(csv.DictReader(answer.splitlines()))
        checks.check(len(rows) > 3 and all(row["status"] == "ok" for row in rows) and
                     all(abs(float(row["y_out_mm"])) < 1e-9 for row in rows),
                     f"parabola, image at {tilt}: {rows}")
    real = os.path.join(SHARED, "data/import/complicated_fold_mirrors_setup_v2.zmx")
    if os.path.exists(real):
        with open(real, "rb") as file:
            text = file.read().decode("latin-1")
        text = text.replace("\0", "").replace("\r", "")
        planes = of_lens(convert(program, real))
        check_same(checks, "real file", of_zmx(text), planes)
        # three mirrors centred on the axis, two shifted by 6 and 5 within their DIAM of 35 and 25
        check_folded(checks, "real file", planes, [0, 0, 0, 35, 25])
    else:
        print("skipped: no ../shared/data/import here")
    checks.finish()


if __name__ == "__main__":
    main()
