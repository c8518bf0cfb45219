#!/usr/bin/env python3
"""tests/truth/check_fields.py - fields as points x, y, and real image heights: check_fields.py BUILD

Skew chief rays of the double Gauss, by angles in x and y and by the height of the real image, are
found here with 50 digits: Snell's law in vectors, Newton's method on the centre of the stop, and on
the image. Round lenses of lensdb: the rays of (x, y) are those of the y field as far out, turned.
Real heights: the chief ray that the program finds meets the image plane there, to 1e-12 of it, and
an angle, also beyond 90 degrees, comes back from the height that it has. Lenses that are not round.
Telecentric object spaces: the rays by Snell's law, paraxial figures by hand. Telescopes of two thin
lenses.
"""
# SPDX-License-Identifier: MIT

import csv
import io
import math
import os
import sys
import tempfile
from decimal import Decimal as D, getcontext

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import ROOT, Checks, Program

getcontext().prec = 50
BFL = "72.211810477084275"  # of the double Gauss; three programs agree on it

# radius (0 = plane), thickness, index behind at the d line
DOUBLE_GAUSS = [(D(r), D(t), D(n)) for r, t, n in (
    ("58.950", "7.520", "1.670"), ("169.660", "0.240", "1"), ("38.550", "8.050", "1.670"),
    ("81.540", "6.550", "1.699"), ("25.500", "11.410", "1"), ("0", "9.000", "1"),
    ("-28.990", "2.360", "1.603"), ("81.540", "12.130", "1.658"), ("-40.770", "0.380", "1"),
    ("874.130", "6.440", "1.717"), ("-79.460", BFL, "1"))]
STOP = 5


def tangent(degrees):
    """tan by its series, 50 digits; below 45 degrees."""
    pi = D("3.14159265358979323846264338327950288419716939937510582097494459")
    x = D(degrees) * pi / 180
    sine = cosine = D(0)
    term, n = D(1), 0
    while abs(term) > D(10) ** -55 or n < 4:
        if n % 2 == 0:
            cosine += term if n % 4 == 0 else -term
        else:
            sine += term if n % 4 == 1 else -term
        n += 1
        term = term * x / n
    return sine / cosine


def follow(point, cosine, surfaces, upto):
    """Through surfaces 0 .. upto - 1, to the plane or sphere `upto` (the image: a plane)."""
    x, y, z = point
    p, q, r = cosine
    index = D(1)
    for i, (radius, thickness, behind) in enumerate(surfaces + [(D(0), D(0), D(1))]):
        if radius == 0:
            t = -z / r
        else:
            b = x * p + y * q + (z - radius) * r
            c = x * x + y * y + z * z - 2 * z * radius
            root = (b * b - c).sqrt()
            t = min(-b - root, -b + root, key=lambda s: abs(z + s * r))
        x, y, z = x + t * p, y + t * q, z + t * r
        if i == upto:
            return (x, y, z), (p, q, r)
        if radius != 0:
            normal = (x / radius, y / radius, z / radius - 1)
            cosine_in = p * normal[0] + q * normal[1] + r * normal[2]
            if cosine_in < 0:
                normal, cosine_in = tuple(-k for k in normal), -cosine_in
            ratio = index / behind
            cosine_out = (1 - ratio * ratio * (1 - cosine_in * cosine_in)).sqrt()
            k = cosine_out - ratio * cosine_in
            p, q, r = (ratio * d + k * m for d, m in zip((p, q, r), normal))
        index = behind
        z -= thickness
    return None


def newton(function, start):
    """A zero of two functions of two numbers, the slopes by differences of 25 digits."""
    at, h = list(start), D(10) ** -25
    for _ in range(60):
        here = function(at)
        if max(map(abs, here)) < D(10) ** -35:
            return at
        beside = [function([at[0] + h, at[1]]), function([at[0], at[1] + h])]
        a, c = ((beside[0][i] - here[i]) / h for i in range(2))
        b, d = ((beside[1][i] - here[i]) / h for i in range(2))
        det = a * d - b * c
        at[0] -= (d * here[0] - b * here[1]) / det
        at[1] -= (a * here[1] - c * here[0]) / det
    raise ArithmeticError("no zero")


def chief(tangents):
    """Cosines at the start; point and cosines in the image."""
    length = (1 + tangents[0] ** 2 + tangents[1] ** 2).sqrt()
    cosine = (tangents[0] / length, tangents[1] / length, 1 / length)

    def in_stop(at):
        return follow((at[0], at[1], D(0)), cosine, DOUBLE_GAUSS, STOP)[0][:2]

    at = newton(in_stop, (-40 * tangents[0], -40 * tangents[1]))
    point, out = follow((at[0], at[1], D(0)), cosine, DOUBLE_GAUSS, len(DOUBLE_GAUSS))
    return cosine, point, out


class Fields:
    def __init__(self, checks, program):
        self.checks, self.program = checks, program
        self.folder = tempfile.TemporaryDirectory(prefix="lenscalc-fields-")

    def rows(self, command, *words):
        result = self.program.run(command, *words, "--csv")
        if not self.checks.check(result.returncode == 0,
                                 f"{command} {' '.join(map(str, words))}: {result.stderr.decode()}"):
            return []
        return list(csv.DictReader(io.StringIO(result.stdout.decode())))

    def chief(self, *words):
        rows = self.rows("trace", *words, "--pupil-point", "0:0", "--no-clip")
        return rows[0] if rows else None

    def near(self, row, name, expected, allowed, what):
        if row is not None:
            self.checks.check(row[name] != "" and abs(float(row[name]) - float(expected)) <= allowed,
                              f"{what}: {name} {row[name]}, expected {float(expected)!r}")

    def same(self, row, expected, what):
        cosine, point, out = expected
        for axis, name in enumerate("xyz"):
            self.near(row, f"cos_{name}", cosine[axis], 1e-14, what)
            self.near(row, f"cos_{name}_out", out[axis], 1e-13, what)
        for axis, name in enumerate("xy"):
            self.near(row, f"{name}_out_mm", point[axis], 2e-12, what)

    def lens(self, text):
        path = os.path.join(self.folder.name, "case.lens")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path


def check_skew(fields):
    for x, y in ((5, 12), (-3, 14), (8, 0), (0, 10), (11, -7)):
        expected = chief((tangent(x), tangent(y)))
        row = fields.chief("double-gauss", "--field-x", x, "--field", y)
        fields.same(row, expected, f"double Gauss at {x}, {y} deg")
        path = fields.lens(with_field(f"angle {x},{y}:0.5"))
        fields.same(fields.chief(path), expected, f"a file's field {x},{y}")


def with_field(words, name="double-gauss", more=""):
    with open(os.path.join(ROOT, "lensdb", "lenses", name + ".lens"), encoding="utf-8") as file:
        lines = [line for line in file if not line.startswith(("field", "aperture"))]
    at = next(i for i, line in enumerate(lines) if line.startswith("object"))
    return "".join(lines[:at + 1]) + f"field {words}\naperture stop\n{more}" + "".join(lines[at + 1:])


def check_real_height(fields):
    for x, y in ((5, 12), (0, 21.6), (-14.4, 10.8), (18, 0)):
        def miss(tangents):
            point = chief(tangents)[1]
            return point[0] - D(x), point[1] - D(y)
        expected = chief(newton(miss, (D(x) / 100, D(y) / 100)))
        row = fields.chief("double-gauss", "--real", "--height-x", x, "--height", y)
        fields.same(row, expected, f"double Gauss, image at {x}, {y} mm")
        row = fields.chief(fields.lens(with_field(f"real {x},{y}")))
        fields.same(row, expected, f"a file's real height {x},{y}")


ROUND = ["tessar-100", "cooke-triplet-50", "cs348b-wide-22", "fisheye-16", "biogon-38", "double-gauss"]


def check_turned(fields):
    """x_out, y_out of (x, y) are those of the y field, turned by its azimuth."""
    known = {name[:-5] for name in os.listdir(os.path.join(ROOT, "lensdb", "lenses"))}
    for name in sorted(known & set(ROUND)):
        for x, y in ((6, 8), (-9, 4)):
            tangents = math.tan(math.radians(x)), math.tan(math.radians(y))
            size = math.hypot(*tangents)
            turned = fields.chief(name, "--field-x", x, "--field", y)
            plain = fields.chief(name, "--field", repr(math.degrees(math.atan(size))))
            if turned is None or plain is None:
                continue
            height = float(plain["y_out_mm"])
            for axis in range(2):
                fields.near(turned, "xy"[axis] + "_out_mm", height * tangents[axis] / size,
                            1e-12 * max(abs(height), 1), f"{name} turned, {x}, {y} deg")


def check_there_and_back(fields):
    for name, angles in (("double-gauss", (3, 14)), ("fisheye-16", (20, 60, 85)),
                         ("cs348b-fisheye-10", (30, 70, 88)), ("fisheye-270", (45, 89, 100, 130)),
                         ("cs348b-wide-22", (10, 40))):
        for angle in angles:
            there = fields.chief(name, "--field", angle)
            if there is None:
                continue
            height = there["y_out_mm"]
            back = fields.chief(name, "--real", "--height", height)
            what = f"{name}, {angle} deg, back from {height} mm"
            fields.near(back, "y_out_mm", height, 1e-12 * abs(float(height)), what)
            fields.near(back, "cos_y", math.sin(math.radians(angle)), 1e-11, what)
            fields.near(back, "cos_z", math.cos(math.radians(angle)), 1e-11, what)
            # and beside the y axis, beyond 90 degrees too
            h = float(height)
            skew = fields.chief(name, "--real", "--height-x", repr(0.6 * h), "--height",
                                repr(0.8 * h))
            fields.near(skew, "x_out_mm", 0.6 * h, 2e-12 * abs(h), what + ", skew")
            fields.near(skew, "y_out_mm", 0.8 * h, 2e-12 * abs(h), what + ", skew")
            fields.near(skew, "cos_x", 0.6 * math.sin(math.radians(angle)), 1e-11, what + ", skew")


def check_not_round(fields):
    lens = """lens        Tilted singlet and a mirror image of nothing
wavelength  d
object      {object}
field       real 0,0 2,3 -4,1
aperture    stop
focus       table
surface     60   5  1.5168 30 decenter=0.5,-0.3 tilt=2,1
surface     -80  2  air    30
stop        -    90 air    8
"""
    for distance in ("inf", "400"):
        rows = fields.rows("trace", fields.lens(lens.format(object=distance)), "--pupil-point",
                           "0:0")
        fields.checks.check(len(rows) == 3, f"tilted, object {distance}: {len(rows)} rows of 3")
        for row, goal in zip(rows, ((0, 0), (2, 3), (-4, 1))):
            for axis in range(2):
                fields.near(row, "xy"[axis] + "_out_mm", goal[axis], 1e-12, f"tilted, {distance}")
            fields.checks.check([float(row["height_x_mm"] or 0), float(row["height_mm"])] ==
                                list(map(float, goal)), f"tilted, {distance}: the field in its row")


TELECENTRIC = """lens        telecentric
wavelength  d
object      100 telecentric
field       {field}
aperture    {aperture}
focus       table
surface     60   5  1.5168 40
surface     -60  50 air    40
stop        -    30 air    30
"""
SINGLET = [(D(60), D(5), D("1.5168")), (D(-60), D(50), D(1)), (D(0), D(30), D(1))]


def check_telecentric(fields):
    """Chief rays along the axis, wherever the stop is; marginal rays of the numerical aperture."""
    na, distance = D("0.1"), D(100)
    slope = na / (1 - na * na).sqrt()
    path = fields.lens(TELECENTRIC.format(field="height 0 5 3,4:0.5", aperture="na 0.1"))
    rows = fields.rows("trace", path)
    fields.checks.check(len(rows) == 12, f"telecentric: {len(rows)} rows of 12")
    points = {"chief": (0, 0), "upper": (0, 1), "lower": (0, -1), "sagittal": (1, 0)}
    for row in rows:
        # the pupil's axes are those of its point: sagittal, and away from the axis
        x, y = float(row["height_x_mm"]), float(row["height_mm"])
        if row["ray"] != "chief" and x != 0:
            continue
        a, b = points[row["ray"]]
        cosines = [D(a) * slope, D(b) * slope, D(1)]
        length = sum(c * c for c in cosines).sqrt()
        cosines = tuple(c / length for c in cosines)
        start = (D(x) + D(a) * slope * distance, D(y) + D(b) * slope * distance, D(0))
        point, out = follow(start, cosines, SINGLET, 3)
        what = f"telecentric, {row['ray']} of {x}, {y} mm"
        for axis, name in enumerate("xy"):
            fields.near(row, f"cos_{name}", cosines[axis], 1e-15, what)
            fields.near(row, f"{name}_out_mm", point[axis], 2e-13, what)
            fields.near(row, f"cos_{name}_out", out[axis], 1e-14, what)
    # paraxially, of two surfaces by hand
    n, r, t = D("1.5168"), D(60), D(5)
    power = (n - 1) / r
    whole = 2 * power - t / n * power * power
    bfl = (1 - t / n * power) / whole - 50  # from the stop
    v = slope
    y = slope * distance
    v1 = v - y * power
    y2 = y + t / n * v1
    v2 = v1 - y2 * power
    row = fields.rows("lens", path, "--columns", "entrance_pupil,exit_pupil,exit_pupil_diameter,"
                      "working_fnumber,magnification,lagrange,fnumber")[0]
    fields.checks.check(row["entrance_pupil_mm"] == "inf" and row["fnumber"] == "",
                        f"telecentric: entrance pupil {row['entrance_pupil_mm']}")
    for name, expected in (("exit_pupil_mm", bfl), ("exit_pupil_diameter_mm", 2 * v / whole),
                           ("working_fnumber", 1 / (2 * abs(v2))), ("magnification", v / v2),
                           ("lagrange_mm", -v * 5)):
        fields.near(row, name, expected, 1e-13 * abs(float(expected)), "telecentric, paraxially")
    # a real image height: back to the object height that had it
    height = next(row["y_out_mm"] for row in rows if row["ray"] == "chief" and
                  row["height_mm"] == "5" and row["height_x_mm"] == "0")
    path = fields.lens(TELECENTRIC.format(field=f"real {height}", aperture="na 0.1"))
    row = fields.chief(path)
    fields.near(row, "y_mm", 5, 1e-11, "telecentric, real height")
    fields.near(row, "y_out_mm", height, 1e-12 * abs(float(height)), "telecentric, real height")
    commands = [("check",), ("pupil",), ("draw",), ("conjugate",), ("dof", "-s", "3m", "--lens")]
    for command in commands + ([("fit",)] if fields.program.has_solver() else []):
        result = fields.program.run(*command, path)
        fields.checks.check(result.returncode == 1 and b"telecentric" in result.stderr,
                            f"{command[0]} of a telecentric lens: {result.stderr.decode()}")
    for field, aperture, message in (("height 5", "epd 10", "numerical"),
                                     ("height 5", "stop", "numerical")):
        path = fields.lens(TELECENTRIC.format(field=field, aperture=aperture))
        result = fields.program.run("trace", path)
        fields.checks.check(result.returncode == 1 and message in result.stderr.decode(),
                            f"telecentric, aperture {aperture}: {result.stderr.decode()}")
    path = fields.lens(TELECENTRIC.format(field="height 5", aperture="na 0.1")
                       .replace("100 telecentric", "inf telecentric"))
    result = fields.program.run("lens", path)
    fields.checks.check(result.returncode == 4, f"telecentric from infinity: {result.stderr}")


def check_afocal(fields):
    """Two thin lenses of 100 and -20 mm: 5 times; a little out of adjustment it still is a telescope."""
    for gap, powerless in (("80", True), ("80.001", True), ("60", False)):
        path = fields.lens("lens telescope\nwavelength d\nobject inf\nfield angle 0 1\n"
                           "aperture epd 10\nfocus afocal\n"
                           f"thick 100 {gap} air 20 stop\nthick -20 50 air 10\n")
        row = fields.rows("lens", path)[0]
        fields.checks.check((row["power_per_m"] == "0") == powerless and
                            (row["efl_mm"] == "inf") == powerless,
                            f"telescope of {gap} mm: power {row['power_per_m']}")
        expected = 1 + float(gap) / 20
        if powerless:
            fields.near(row, "angular_magnification", expected, 1e-14 * expected, f"gap {gap}")
        fields.checks.check(row["track_mm"] == "inf", f"gap {gap}: track {row['track_mm']}")
        rows = fields.rows("trace", path, "--pupil-point", "0:0", "--no-clip")
        fields.checks.check(len(rows) == 2 and "last surface" in rows[0]["warning"],
                            "an afocal image is at infinity: rays end at the last surface")


def check_refused(fields):
    for words, message in (
            (("trace", "double-gauss", "--real", "--height", "90"), "no chief ray meets"),
            (("trace", "double-gauss", "--field", "95", "--field-x", "1"), "below 90"),
            (("lens", "double-gauss", "--field", "5", "--field-x", "100"), "below 90"),
            (("trace", "double-gauss", "--real"), "--height"),
            (("trace", "double-gauss", "--field-x", "1", "--height", "1"), "exclude"),
            (("trace", "galilean", "--real", "--height", "1"), "")):
        result = fields.program.run(*words)
        fields.checks.check(result.returncode in (1, 2) and message in result.stderr.decode(),
                            f"{' '.join(words)}: {result.stderr.decode()}")


def main():
    checks = Checks()
    fields = Fields(checks, Program(sys.argv[1]))
    for check in (check_skew, check_real_height, check_turned, check_there_and_back,
                  check_not_round, check_telecentric, check_afocal, check_refused):
        check(fields)
    checks.finish()


main()
