#!/usr/bin/env python3
"""tests/truth/check_mtf.py - lenscalc mtf against closed forms and integrals of its own here:
check_mtf.py BUILD_DIR

Small round pupils off the axis, whose cut-offs are cos t and cos^3 t of that on it; the closed
form of a round pupil; a fast paraboloid, whose pupil is not even over direction cosines; rings;
and that contrast by waves and by rays fall alike at low frequencies.
"""
# SPDX-License-Identifier: MIT

import cmath
import csv
import io
import math
import os
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program
from integrals import gauss

WAVE = 587.5618e-6  # mm


def rows(program, words, text=None):
    result = subprocess.run(program.command + ["mtf"] + words + ["--csv"], input=text, text=True,
                            capture_output=True, env=program.environment())
    table = list(csv.DictReader(io.StringIO(result.stdout)))
    if not table:
        sys.exit(result.stderr)
    return table


def near(checks, name, actual, expected, allowed):
    try:
        error = abs(float(actual) - expected)
    except ValueError:
        error = math.inf
    checks.check(error <= allowed, f"{name} is {actual}, expected {expected} within {allowed:.3g}")


def closed(s):
    return 0 if s >= 1 else 2 / math.pi * (math.acos(s) - s * math.sqrt(1 - s * s))


def check_obliquity(checks, program):
    """A concave mirror that images what stands beside its centre on the other side of that, all but
    without aberrations, as it is so small."""
    radius, distance = 0.01, 200
    for tangent in (0, 0.3, 0.7):
        lens = (f"lens speck\nwavelength d\nobject {distance}\nfield height {tangent * distance}\n"
                f"aperture stop\nsurface {-distance} {-distance} mirror {2 * radius} stop\n")
        cosine = 1 / math.hypot(1, tangent)
        axis = 2 * radius / distance / WAVE
        for share in (0.2, 0.5, 0.9):
            for power, column in ((3, "tangential"), (1, "sagittal")):
                cutoff = axis * cosine ** power
                words = ["-", "--focus", str(-distance), "--frequency", repr(share * cutoff)]
                row = rows(program, words, lens)[0]
                name = f"speck, tan {tangent}, {column}"
                near(checks, name + " cut-off", row.get(f"cutoff_{column}_per_mm", ""), cutoff,
                     1e-6 * cutoff)
                near(checks, name, row[column], closed(share), 2e-5)


def paraboloid(f, radius, shift):
    """Overlap of the pupil of a paraboloid: y = 2 f tan(u/2), A^2 = y dy/(a da), a = sin u."""
    def square(a):
        u = math.asin(min(a, 1))
        y, slope = 2 * f * math.tan(u / 2), f / math.cos(u / 2) ** 2 / math.cos(u)
        return f * f if a < 1e-9 else y * slope / a

    edge = math.sin(2 * math.atan(radius / (2 * f)))
    reach, count, total = edge * edge - shift * shift / 4, 160, 0.0
    if reach <= 0:
        return 0
    high = math.sqrt(reach)
    for i in range(count):  # Gauss and Chebyshev across, midpoints along
        turn = math.pi * ((i + 0.5) / count - 0.5)
        t = high * math.sin(turn)
        length = math.sqrt(edge * edge - t * t) - shift / 2
        for k in range(count):
            s = length * (2 * (k + 0.5) / count - 1)
            a = math.hypot(s - shift / 2, t), math.hypot(s + shift / 2, t)
            total += (math.sqrt(square(a[0]) * square(a[1])) * 2 * length / count
                      * high * math.cos(turn) * math.pi / count)
    return total / (math.pi * radius * radius)


def check_paraboloid(checks, program):
    for f, radius in ((100, 25), (100, 60)):
        lens = (f"lens dish\nwavelength d\nobject inf\naperture stop\n"
                f"surface {-2 * f} {-f} mirror {2 * radius} k=-1 stop\n")
        edge = math.sin(2 * math.atan(radius / (2 * f)))
        for share in (0.1, 0.4, 0.8):
            words = ["-", "--field", "0", "--focus", str(-f), "--error", "1e-7", "--frequency",
                     repr(share * 2 * edge / WAVE)]
            near(checks, f"paraboloid, {radius} mm, {share}", rows(program, words, lens)[0]["sagittal"],
                 paraboloid(f, radius, share * 2 * edge), 2e-5)


def sphere(radius, height, most):
    """Of a concave sphere that is its own stop, for light along its axis, with the image plane at
    its focus: tables of W in waves and A over the squared sine a^2 at points of the sphere about
    the focus through the vertex, and the largest a."""
    focus, count, rays = radius / 2, 2000, []

    def meet(h):
        turn = 2 * math.asin(h / radius)
        z = -radius + math.sqrt(radius * radius - h * h)  # of the mirror, the light's way is +z
        e = -math.sin(turn), -math.cos(turn)  # across and along behind it
        from_centre = h, z + focus
        along = from_centre[0] * e[0] + from_centre[1] * e[1]
        across2 = from_centre[0] ** 2 + from_centre[1] ** 2 - along * along
        step = -along - math.sqrt(focus * focus - across2)
        return -(from_centre[0] + step * e[0]) / focus, z + step

    for i in range(count + 1):
        h = height * math.sqrt(i / count)
        a, path = meet(h)
        rays.append((a * a, h * h, path))
    edge = math.sqrt(rays[-1][0])
    places = [edge * edge * i / most for i in range(most + 1)]
    waves, amplitudes, k = [], [], 0
    for q in places:
        while k + 4 < count and rays[k + 2][0] < q:
            k += 1
        near = rays[k:k + 4]  # a polynomial through four, and its slope
        value, slope = 0, 0
        for i, (x, squared, path) in enumerate(near):
            others = [y[0] for j, y in enumerate(near) if j != i]
            below = math.prod(x - y for y in others)
            value += path * math.prod(q - y for y in others) / below
            slope += squared * sum((q - others[1 - (j > 0)]) * (q - others[2 - (j > 1)])
                                   for j in range(3)) / below
        waves.append(value / WAVE)
        amplitudes.append(math.sqrt(-slope if slope < 0 else slope))
    return waves, amplitudes, edge


def table(values, place):
    i = min(max(int(place) - 1, 0), len(values) - 4)
    t = place - i
    return (-values[i] * (t - 1) * (t - 2) * (t - 3) / 6 + values[i + 1] * t * (t - 2) * (t - 3) / 2
            - values[i + 2] * t * (t - 1) * (t - 3) / 2 + values[i + 3] * t * (t - 1) * (t - 2) / 6)


def steep(radius, height, shift, points):
    """Overlap of the pupil of a sphere with itself, and the energy of it."""
    most = 1500
    waves, amplitudes, edge = sphere(radius, height, most)
    nodes = [(2 * x - 1, 2 * w) for x, w in gauss(points)]
    high, total, perfect = math.sqrt(edge * edge - shift * shift / 4), 0, 0.0
    for x, w in nodes:
        angle = math.pi / 2 * x
        t = high * math.sin(angle)
        length = math.sqrt(edge * edge - t * t) - shift / 2
        for y, v in nodes:
            a = [((y * length + sign * shift / 2) ** 2 + t * t) / (edge * edge) * most
                 for sign in (-1, 1)]
            weight = (table(amplitudes, a[0]) * table(amplitudes, a[1])
                      * w * v * length * high * math.cos(angle) * math.pi / 2)
            turns = table(waves, a[0]) - table(waves, a[1])
            total += weight * cmath.exp(2j * math.pi * turns)
            perfect += weight
    return abs(total) / (math.pi * height * height), perfect / (math.pi * height * height)


def check_steep(checks, program):
    """A sphere as fast as f/1.4, whose wave front is 86 waves off at the rim: by sums here."""
    radius, height = 200, 36
    lens = (f"lens bowl\nwavelength d\nobject inf\naperture stop\n"
            f"surface {-radius} {-radius / 2} mirror {2 * height} stop\n")
    for frequency, points in ((10, 60), (40, 160)):
        row = rows(program, ["-", "--field", "0", "--focus", str(-radius / 2), "--frequency",
                             str(frequency)], lens)[0]
        expected, limit = steep(radius, height, WAVE * frequency, points)
        for column in ("tangential", "sagittal"):
            near(checks, f"sphere, {frequency}/mm, {column}", row[column], expected, 1e-4)
        near(checks, f"sphere, {frequency}/mm, limit", row["limit"], limit, 1e-4)


def ring(s, hole):
    """O'Neill's overlap of rings is that of discs, less, and more."""
    def lens_area(a, b, d):
        if d >= a + b:
            return 0
        if d <= abs(a - b):
            return math.pi * min(a, b) ** 2
        x = (d * d + a * a - b * b) / (2 * d)
        y = d - x
        return (a * a * math.acos(x / a) - x * math.sqrt(a * a - x * x)
                + b * b * math.acos(y / b) - y * math.sqrt(b * b - y * y))
    d = 2 * s
    whole = lens_area(1, 1, d) - 2 * lens_area(1, hole, d) + lens_area(hole, hole, d)
    return whole / (math.pi * (1 - hole * hole))


def check_ring(checks, program):
    """A disc before a slow paraboloid."""
    radius, hole = 1, 0.4
    lens = (f"lens ring\nwavelength d\nobject inf\naperture stop\n"
            f"surface - 50 air 3\nblock circle {2 * hole * radius}\n"
            f"surface -2000 -1000 mirror {2 * radius} k=-1 stop\n")
    for share in (0.05, 0.25, 0.5, 0.65, 0.9):
        words = ["-", "--field", "0", "--focus", "-1000", "--frequency",
                 repr(share * 2 * radius / 1000 / WAVE)]
        row = rows(program, words, lens)[0]
        for column in ("tangential", "sagittal"):
            near(checks, f"ring, {share}, {column}", row[column], ring(share, hole), 2e-5)


def check_rays(checks, program):
    """Contrast by waves is that of a perfect pupil times that by rays, as long as both are near 1."""
    for lens, words in (("double-gauss", ["-N", "4", "--field", "10"]),
                        ("cooke-triplet-50", ["--field", "15"])):
        for frequency in ("0.5", "1"):
            both = [rows(program, [lens, *words, "-w", "d", "--frequency", frequency, "--method", way])
                    [0] for way in ("diffraction", "geometric")]
            for column in ("tangential", "sagittal"):
                limit = float(both[0]["limit_" + column])
                loss = 1 - float(both[1][column])
                near(checks, f"{lens}, {frequency}/mm, {column}", both[0][column],
                     limit * float(both[1][column]), 0.02 * loss + 1e-5)


def check_disc(checks, program):
    """By rays the blur of an ideal lens off its focus is an even disc of radius h d/f, whose
    contrast is 2 J1(x)/x."""
    lens = "lens ideal\nobject inf\naperture stop\nstop - 0 air 10\nthick 50 0 air 12\n"
    for defocus in (0.1, 0.4):
        for frequency in (20, 70):
            x = 2 * math.pi * frequency * 5 * defocus / 50
            count = 400
            j1 = sum(math.cos(t - x * math.sin(t)) for t in
                     (math.pi * (i + 0.5) / count for i in range(count))) / count
            row = rows(program, ["-", "--method", "geometric", "--defocus", str(defocus),
                                 "--frequency", str(frequency)], lens)[0]
            for column in ("tangential", "sagittal"):
                near(checks, f"ideal, {defocus} mm, {frequency}/mm, {column}", row[column],
                     abs(2 * j1 / x), 1e-4)
            checks.check(row["limit"] == "", "ideal: no limit")


def curves(program, words, error):
    """Points of the curves of --plot, px and contrast, from the drawing."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "mtf.svg")
        subprocess.run(program.command + ["mtf", *words, "--error", error, "--plot", path],
                       stdout=subprocess.DEVNULL, check=True, env=program.environment())
        with open(path, encoding="utf-8") as file:
            lines = re.findall('stroke-width="2"[^>]*>\n<path d="M([-0-9. L]*)"', file.read())
    points = [[float(x) for x in line.replace("L", " ").split()] for line in lines]
    frame = (88, 440)  # y of contrast 1 and 0
    return [[(x, (frame[1] - y) / (frame[1] - frame[0])) for x, y in zip(line[::2], line[1::2])]
            for line in points if len(line) >= 2 * 17]


def between(line, x):
    """A curve's height at x, by its neighbours; None beyond its ends."""
    for (a, y), (b, z) in zip(line, line[1:]):
        if a <= x <= b:
            return y if a == b else y + (z - y) * (x - a) / (b - a)
    return None


def check_curves(checks, program):
    """What is drawn from one sampling of the pupil is what overlaps one by one give."""
    for words in (["cooke-triplet-50", "-w", "d", "--field", "0,20"], ["questar-35", "-w", "d"], ["hubble-rc", "-w", "d"],
                  ["double-gauss", "-N", "8", "--field", "14"],
                  ["rudolph-tessar-100", "-w", "d", "--field", "21"],
                  ["laikin75-petzval", "-w", "d", "--field", "7"],
                  ["laikin48-telescope", "-w", "d", "--field", "0"]):
        drawn, exact = curves(program, words, "1e-4"), curves(program, words, "9e-5")
        checks.check(len(drawn) == len(exact) >= 2, f"{words}: {len(drawn)} curves")
        off = [abs(y - between(other, x)) for line, other in zip(drawn, exact) for x, y in line
               if between(other, x) is not None]
        # those one by one are drawn where they are bent by a fifth of a pixel, of 352
        checks.check(len(off) > 3 * 100 and max(off) < 1e-3 + 0.3 / 352,
                     f"{words}: curves are {max(off, default=None)} off in {len(off)} points")


def main():
    program, checks = Program(sys.argv[1]), Checks()
    check_obliquity(checks, program)
    check_paraboloid(checks, program)
    check_ring(checks, program)
    check_steep(checks, program)
    check_rays(checks, program)
    check_disc(checks, program)
    check_curves(checks, program)
    checks.finish()


if __name__ == "__main__":
    main()
