#!/usr/bin/env python3
"""tests/truth/check_fan.py - lenscalc fan against numbers from outside: check_fan.py BUILD_DIR

opd.txt: where rays through points of the stop arrive and their wave front aberrations, by an
independent program of 50 digits. Best-fitting spheres: a fit of its own here, to the rays of
lenscalc trace, which other tests judge.
"""
# SPDX-License-Identifier: MIT

import csv
import io
import math
import os
import subprocess
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program

EPSILON = 2.0 ** -52
D_LINE = 587.5618e-6  # mm
POINTS = {(0, 1), (0, -1), (1, 0), (0, 0.5), (0, -0.5)}  # those on a fan of five points
worst = {}


def rows(program, words, text=None):
    result = subprocess.run(program.command + words + ["--csv"], input=text, text=True,
                            capture_output=True, env=program.environment())
    if result.returncode != 0:
        return result.stderr
    return list(csv.DictReader(io.StringIO(result.stdout)))


def read_cases(path):
    """(name, lens, focus, [(field, x, y, W, dx, dy)])"""
    cases, lens = [], None
    with open(path, encoding="utf-8") as file:
        for line in file:
            word, _, rest = line.rstrip("\n").partition(" ")
            if word == "case":
                lens = []
                cases.append({"name": rest, "lens": lens, "fans": []})
            elif word == "end":
                lens = None
            elif lens is not None:
                lens.append(line)
            elif word == "focus":
                cases[-1]["focus"] = rest
            elif word == "fan":
                cases[-1]["fans"].append([float(x) for x in rest.replace("=", "").split()])
    return cases


def near(checks, name, actual, expected, allowed):
    kind = name.split(":")[0]
    error = abs(float(actual) - expected) if actual != "" else math.inf
    worst[kind] = max(worst.get(kind, 0), error)
    checks.check(error <= allowed, f"{name} is {actual}, expected {expected} within {allowed:.3g}")


def check_case(checks, program, case):
    text = "".join(case["lens"])
    far = "object inf" in text
    length = sum(abs(float(line.split()[2])) for line in case["lens"]
                 if line.startswith("surface")) + abs(float(case["focus"]))
    for field in sorted({fan[0] for fan in case["fans"]}):
        # the field of a near object by its angle, as the first vertex sees it
        distance = next(line.split()[1] for line in case["lens"] if line.startswith("object"))
        angle = field if far else math.degrees(math.atan(-field / float(distance)))
        table = rows(program, ["fan", "-", "--points", "5", "--no-clip", "-w", "d", "--focus",
                               case["focus"], "--field", f"{angle!r}deg"], text)
        name = f"{case['name']}, {field}"
        if not checks.check(isinstance(table, list), f"{name}: {table}"):
            continue
        found = {(float(row["pupil_x"]), float(row["pupil_y"])): row for row in table}
        # an angle of a near object has the rounding of its height
        allowed = 1e-13 + 4 * EPSILON * (length + (0 if far else 20 * abs(field)))
        for at, x, y, path, dx, dy in case["fans"]:
            if at != field or (x, y) not in POINTS:
                continue
            row = found[(x, y)]
            near(checks, f"W: {name}, ({x}, {y})", str(float(row["opd_waves"]) * D_LINE)
                 if row["opd_waves"] else "", path, allowed)
            for column, expected in (("dx_um", dx), ("dy_um", dy)):
                near(checks, f"place: {name}, ({x}, {y}) {column}",
                     str(float(row[column]) / 1000) if row[column] else "", expected, 10 * allowed)


def solve(a, b):
    """a x = b by Gauss's elimination."""
    n = len(b)
    m = [list(row) + [value] for row, value in zip(a, b)]
    for i in range(n):
        pivot = max(range(i, n), key=lambda k: abs(m[k][i]))
        m[i], m[pivot] = m[pivot], m[i]
        for k in range(i + 1, n):
            factor = m[k][i] / m[i][i]
            m[k] = [u - factor * v for u, v in zip(m[k], m[i])]
    for i in reversed(range(n)):
        m[i][n] = (m[i][n] - sum(m[i][k] * m[k][n] for k in range(i + 1, n))) / m[i][i]
    return [row[n] for row in m]


def to_sphere(ray, centre, crossing):
    """The optical path of a ray to the sphere about a centre that goes through `crossing`."""
    point, e, path, _ = ray
    d = [p - c for p, c in zip(point, centre)]
    along = sum(u * v for u, v in zip(d, e))
    q = sum(u * u for u in d) - along * along
    return path - along - math.sqrt(sum((a - c) ** 2 for a, c in zip(crossing, centre)) - q)


def fit_sphere(rays, crossing):
    """The centre from which the weighted spread of the paths is least, from (0, 0, 0) on."""
    centre, step = [0.0, 0.0, 0.0], 1e-3
    for _ in range(12):
        normal = [[0.0] * 4 for _ in range(4)]
        right = [0.0] * 4
        for ray in rays:
            line = []
            for axis in range(3):
                sides = [to_sphere(ray, [c + (step * sign if i == axis else 0)
                                         for i, c in enumerate(centre)], crossing)
                         for sign in (1, -1)]
                line.append((sides[0] - sides[1]) / (2 * step))
            line.append(1.0)
            way = to_sphere(ray, centre, crossing)
            for i in range(4):
                right[i] -= ray[3] * line[i] * way
                for k in range(4):
                    normal[i][k] += ray[3] * line[i] * line[k]
        centre = [c + s for c, s in zip(centre, solve(normal, right))]
    return centre


def chief_crossing(program, words, mean, image):
    """Where the chief ray crosses the paraxial exit pupil, in the frame of the rays; z of the
    image plane is from the last vertex. The sphere about the chief ray's image point tells how
    far off it is, the rays on which side."""
    chief = rows(program, ["fan", *words, "--reference", "chief", "--points", "3"])[0]
    pupil = rows(program, ["lens", words[0], "-w", "d"])[0]
    z = float(pupil["exit_pupil_mm"]) - image
    y = math.sqrt(max(float(chief["sphere_mm"]) ** 2 - z * z, 0))
    height = float(chief["reference_y_mm"])
    return 0.0, height - math.copysign(y, height) - mean, z


def check_best(checks, program, lens, field):
    words = [lens, "--field", field, "-w", "d", "--no-clip"]
    table = rows(program, ["fan", *words, "--reference", "best", "--points", "3"])
    rays = rows(program, ["trace", *words, "--pattern", "gauss", "--rays", "800", "--columns",
                          "x_out,y_out,z_out,cos_x_out,cos_y_out,cos_z_out,path,weight"])
    if not checks.check(isinstance(table, list) and isinstance(rays, list), f"{lens}: {table}"):
        return
    mean = sum(float(ray["y_out_mm"]) for ray in rays) / len(rays)
    start = float(rays[0]["path_mm"])
    bundle = [((float(ray["x_out_mm"]), float(ray["y_out_mm"]) - mean, 0.0),
               tuple(float(ray[f"cos_{axis}_out"]) for axis in "xyz"),
               float(ray["path_mm"]) - start, float(ray["weight"])) for ray in rays]
    crossing = chief_crossing(program, words, mean, float(rays[0]["z_out_mm"]))
    x, y, z = fit_sphere(bundle, crossing)
    scale = 1e-6 * float(table[0]["sphere_mm"])
    for name, expected in (("reference_x_mm", x), ("reference_y_mm", y + mean),
                           ("reference_z_mm", z)):
        near(checks, f"best: {lens} {field} {name}", table[0][name], expected, scale)


def main():
    program, checks = Program(sys.argv[1]), Checks()
    cases = read_cases("tests/truth/opd.txt")
    checks.check(len(cases) == 24, f"opd.txt: {len(cases)} cases")
    for case in cases:
        check_case(checks, program, case)
    for lens, field in (("double-gauss", "0"), ("double-gauss", "14deg"),
                        ("cooke-triplet-50", "15deg"), ("questar-35", "0.2deg")):
        check_best(checks, program, lens, field)
    if os.environ.get("FAN_SHOW"):
        print(worst)
    checks.finish()


if __name__ == "__main__":
    main()
