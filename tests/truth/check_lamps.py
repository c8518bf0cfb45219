#!/usr/bin/env python3
"""tests/truth/check_lamps.py - lamps photographed by lenscalc render: check_lamps.py BUILD_DIR

What is out of focus, in closed form: the circle of confusion of a thin lens, of a thick one and of
a real one by its marginal ray, with the Fourier transform of a disc; blades of the stop, upright
behind the focus and upside down before it. Foci of two colours. Where a thick lens sees lamps in
space, with their cross-ratio; the distance on which a lens is focused, and the least.
"""
# SPDX-License-Identifier: MIT

import cmath
import math
import os
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program
from photographs import Studio, centroid
from singlet import LINES, Singlet

AHEAD = "unit mm\ncamera at=0,0,0 look=0,0,-1\n"
LAMP = "material lamp black luminance=1000\n"
# a thick lens: f 50, H 20 mm behind the first vertex, H' 5 mm behind H; the entrance pupil, 8 mm
# before H, is 12.5 mm wide
HAND = ("lens hand\naperture stop\nfocus paraxial\nsurface - 12 air -\nstop - 8 air 12.5\n"
        "thick 50 15 air - hiatus=5\nsurface - 0 air -\n")
F, PUPIL, BEFORE = 50, 12.5, 8
SIDE = 64  # pixels of a picture


def bessel(n, x):
    """J_n, by its integral."""
    steps = 200
    return sum(math.cos(n * t - x * math.sin(t))
               for t in (math.pi * (k + 0.5) / steps for k in range(steps))) / steps


def disc_transfer(diameter, frequency, fall=0):
    """Of a disc whose light falls towards its edge, as the square of the radius, by this share."""
    x = math.pi * diameter * frequency
    return 1 if x == 0 else (2 * (1 - fall) * bessel(1, x) / x + 4 * fall * bessel(2, x) / x ** 2) \
        / (1 - fall / 2)


def second(rows, pitch):
    """Mean square of the distance from the centroid, mm^2."""
    a, b = centroid(rows, pitch)
    light = [((i + 0.5 - SIDE / 2) * pitch, (SIDE / 2 - j - 0.5) * pitch, pixel[1])
             for j, row in enumerate(rows) for i, pixel in enumerate(row)]
    return sum(v * ((x - a) ** 2 + (y - b) ** 2) for x, y, v in light) / sum(p[2] for p in light)


def square(pitch, line="d"):
    """Words for a square film."""
    return ["--sensor", f"{SIDE * pitch}x{SIDE * pitch}mm", "--size", f"{SIDE}x{SIDE}", "-w", line,
            "-t", "1", "--bounces", "0"]


def transfer(rows, frequency, pitch):
    """Of what is across the picture, with the pixels' own taken out."""
    columns = [sum(row[i][1] for row in rows) for i in range(len(rows[0]))]
    x = math.pi * frequency * pitch
    return abs(sum(v * cmath.exp(2j * x * i) for i, v in enumerate(columns))) / sum(columns) / (
        math.sin(x) / x if x > 0 else 1)


def check_confusion(studio):
    """A disc of known size, focused at s1, s2 away from H: A f|s2 - s1|/(s2 (s1 - f))."""
    cases = (("thin", 1000, 700), ("thin", 1000, 2500), ("thick", 1000, 700), ("thick", 600, 1500))
    for model, s1, s2 in cases:
        pupil = PUPIL
        away = 0 if model == "thin" else BEFORE  # of the entrance pupil before the plane H
        if model == "thin":
            blur = pupil * F * abs(s2 - s1) / (s2 * (s1 - F))
        else:  # the beam from the entrance pupil, where it is in focus; then on the film
            blur = pupil * abs(s2 - s1) / (s2 - away) * F / (s1 - F)
        scale = F / (s1 - F) * (s1 - away) / (s2 - away)  # of the chief ray
        radius = blur / 10 / scale
        pitch = blur * 1.3 / SIDE
        rows = studio.take(AHEAD + LAMP + f"disc material=lamp radius={radius} "
                           f"at=0,0,{away - s2}\n", "--lens", "hand.lens", "--model", model, "-s",
                           f"{s1}mm", "-N", "4", "--samples", "512", *square(pitch))
        if rows is None:
            continue
        # the fourth power of the cosine over the beam from the exit pupil, to its first order
        wider = F / (F - away)
        fall = 2 * (pupil / 2 * wider / (F * s2 / (s2 - F) + away * wider)) ** 2
        expected = blur ** 2 / 8 * (1 - 2 * fall / 3) / (1 - fall / 2) + (blur / 10) ** 2 / 2 \
            + pitch ** 2 / 6
        studio.near(second(rows, pitch), expected, 5e-3, f"{model} {s1} {s2}: mean square")
        for k in range(1, 8):
            frequency = k * 0.3 / blur
            known = disc_transfer(blur, frequency, fall) * disc_transfer(blur / 5, frequency)
            found = transfer(rows, frequency, pitch)
            studio.checks.check(abs(found - abs(known)) < 3e-3, f"{model} {s1} {s2}: contrast "
                                f"{found:.4f} at {k * 0.3} of the blur's, expected {known:.4f}")


def check_flux(studio):
    """
    All light of a sphere through a stop in front of a real lens, in focus and out of it: the
    sphere's view of a coaxial disc, (1 - d/sqrt(d^2 + a^2))/2, exact for any radius; and by the
    noise of few samples that blurs are even.
    """
    distance, radius, a = 1000, 0.1, PUPIL / 2
    with open(os.path.join(studio.folder, "before.lens"), "w", encoding="utf-8") as file:
        file.write("lens before\naperture stop\nfocus paraxial\nstop - 3 air 12.5\n"
                   "surface 120 5 N-BK7 30\nsurface -60 0 air 30\n")
    flux = 2 * math.pi ** 2 * radius ** 2 * 1000 * (1 - distance / math.hypot(distance, a))
    for focus in 1000, 600, 3000:
        pitch = 0.1
        rows = studio.take(AHEAD + LAMP + f"sphere material=lamp radius={radius} "
                           f"at=0,0,{-distance}\n", "--lens", "before.lens", "-s", f"{focus}mm",
                           *square(pitch), "--samples", "64")
        if rows is not None:
            found = pitch ** 2 * sum(pixel[1] for row in rows for pixel in row)
            studio.near(found, flux, 1e-3, f"flux of a sphere, focused on {focus} mm")
    blur = PUPIL * F * 2000 / (3000 * (1000 - F))
    pitch = blur * 1.5 / SIDE
    rows = studio.take(AHEAD + LAMP + "sphere material=lamp radius=2 at=0,0,-3000\n", "--lens",
                       "hand.lens", "--model", "thin", "-s", "1000mm", "-N", "4", "--samples",
                       "64", *square(pitch))
    if rows is not None:
        # well within it: flux over area, and the cosine's fourth power is 1 to 1e-4
        inside = [pixel[1] for j, row in enumerate(rows) for i, pixel in enumerate(row)
                  if math.hypot(i + 0.5 - SIDE / 2, j + 0.5 - SIDE / 2) * pitch < 0.4 * blur]
        mean = sum(inside) / len(inside)
        noise = math.sqrt(sum((v / mean - 1) ** 2 for v in inside) / (len(inside) - 1))
        studio.checks.check(noise < 0.03, f"noise within a blur: {noise:.4f}, at most 0.03")


def check_marginal(studio):
    """Far behind its focus a real lens leaves a disc as wide as its marginal rays are apart."""
    lens = Singlet((80, -300), 6, (1.62, 50), 3, 16)
    lens.write(os.path.join(studio.folder, "single.lens"))
    for distance, defocus in (1000, -3), (2000, 4):
        film = lens.paraxial(distance)[0] + defocus
        edge = abs(lens.forward((0, 0), (8, 0), LINES["d"], film, distance)[0])
        lamp = edge / 30 * distance / film
        pitch = 2.6 * edge / SIDE
        rows = studio.take(AHEAD + LAMP + f"disc material=lamp radius={lamp} "
                           f"at=0,0,{-distance}\n", "--lens", "single.lens", "--focus", repr(film),
                           "--samples", "256", *square(pitch))
        if rows is None:
            continue
        reach = max(math.hypot(i + 0.5 - SIDE / 2, j + 0.5 - SIDE / 2) * pitch
                    for j, row in enumerate(rows) for i, pixel in enumerate(row) if pixel[1] > 0)
        studio.checks.check(abs(reach - edge) < edge / 30 + pitch,
                            f"light reaches {reach:.4f} mm, its marginal ray {edge:.4f} mm")


def check_blades(studio):
    """Light falls on the scaled polygon alone, and as much as its area has of the circle's."""
    for s2, sign in (2500, 1), (700, -1):
        blur = PUPIL * F * abs(s2 - 1000) / (s2 * 950)
        pitch, lamp = blur * 1.3 / SIDE, blur / 8
        scene = AHEAD + LAMP + f"disc material=lamp radius={lamp * s2 / F * 0.95} at=0,0,{-s2}\n"
        common = ["--lens", "hand.lens", "--model", "thin", "-s", "1000mm", "-N", "4", "--samples",
                  "256", *square(pitch)]
        whole = studio.take(scene, *common)
        for count, turn in (3, 20), (5, 7):
            rows = studio.take(scene, *common, "--blades", str(count), "--blade-turn", str(turn))
            if rows is None or whole is None:
                return
            light, beyond = 0, 0
            for j, row in enumerate(rows):
                for i, pixel in enumerate(row):
                    x, y = (i + 0.5 - SIDE / 2) * pitch * sign, (SIDE / 2 - j - 0.5) * pitch * sign
                    side = max(x * math.cos(a) + y * math.sin(a) for a in
                               (math.radians(turn) + (2 * k + 1) * math.pi / count
                                for k in range(count)))
                    light += pixel[1]
                    if side > math.cos(math.pi / count) * blur / 2 + lamp + pitch:
                        beyond += pixel[1]
            share = light / sum(pixel[1] for row in whole for pixel in row)
            area = count / (2 * math.pi) * math.sin(2 * math.pi / count)
            # the fourth power of the cosine, to its first order, is greater nearer to the axis
            inner = 1 / 2 - (2 + math.cos(2 * math.pi / count)) / 6
            area *= 1 + 2 * (PUPIL / 2 * (1000 - F) / (1000 * F)) ** 2 * inner
            studio.near(share, area, 0.012, f"{count} blades, lamp at {s2} mm: their share")
            studio.checks.check(beyond == 0, f"{count} blades, lamp at {s2} mm: "
                                             f"{beyond / light:.4f} of the light beside them")


def check_axial(studio):
    """Focal lengths of F and C, by the light far behind them: f_C - f_F = f_C f_F/(f_d V)."""
    lens = Singlet((100, -100), 1e-3, (1.5168, 64.17), 1e-3, 5)
    lens.write(os.path.join(studio.folder, "thin.lens"))
    film, distance = 140, 2000
    focal = {}
    for line in "FdC":
        radius = 8.0
        pitch = 4 / SIDE
        rows = studio.take(AHEAD + LAMP + f"disc material=lamp radius={radius} "
                           f"at=0,0,{-distance}\n", "--lens", "thin.lens", "--focus", str(film),
                           "--samples", "256", *square(pitch, line))
        if rows is None:
            return
        image = radius * film / distance
        blur = math.sqrt(8 * (second(rows, pitch) - image ** 2 / 2 - pitch ** 2 / 6))
        behind = film / (1 + blur / lens.diameter)
        focal[line] = 1 / (1 / behind + 1 / distance)
    expected = focal["C"] * focal["F"] / (focal["d"] * 64.17)
    studio.near(focal["C"] - focal["F"], expected, 0.03, "axial colour of a thin lens")
    studio.near(focal["d"], lens.paraxial(distance)[1], 2e-3, "its focal length")


def cross_ratio(places):
    a, b, c, d = (math.hypot(x - places[0][0], y - places[0][1]) for x, y in places)
    return (c - a) * (d - b) / ((c - b) * (d - a))


def check_perspective(studio):
    """Lamps on a line in space, by a thick lens: in perspective about its pupils, on a line."""
    s1, pitch = 800, 0.02
    found = []
    for k in range(4):
        x, y, z = -60 + 70 * k, 40 - 45 * k, -500 - 400 * k
        rows = studio.take(AHEAD + LAMP + f"sphere material=lamp at={x},{y},{z} "
                           f"radius={-z / 400}\n", "--lens", "hand.lens", "--model", "thick", "-s",
                           f"{s1}mm", "-N", "32", "-w", "d", "-t", "1", "--bounces", "0",
                           "--samples", "128", "--sensor", "24x24mm", "--size", "1200x1200",
                           "--crop",
                           f"{600 + round(50 / pitch * x / -z) - 50}:"
                           f"{600 - round(50 / pitch * y / -z) - 50}:100x100")
        if rows is None:
            return
        a, b = centroid(rows, pitch)
        a += pitch * round(50 / pitch * x / -z)
        b += pitch * round(50 / pitch * y / -z)
        # the plane in focus, s1 before H, seen from the entrance pupil; then its image
        scale = F / (s1 - F) * (s1 - BEFORE) / -z
        found.append((a, b))
        studio.checks.check(math.hypot(a - x * scale, b - y * scale) < 0.1 * pitch,
                            f"a lamp at {x} {y} {z} lies at {a:.4f} {b:.4f} mm, expected "
                            f"{x * scale:.4f} {y * scale:.4f}")
    (x0, y0), (x1, y1) = found[0], found[3]
    for x, y in found[1:3]:
        off = ((x - x0) * (y1 - y0) - (y - y0) * (x1 - x0)) / math.hypot(x1 - x0, y1 - y0)
        studio.checks.check(abs(off) < 0.1 * pitch, f"a line bends by {off:.5f} mm")
    # of points evenly on a line
    studio.near(cross_ratio(found), (2 * 2) / (1 * 3), 3e-3, "cross-ratio")


def check_focus(studio):
    """Of lamps at several distances the one on which the lens is focused is sharpest."""
    common = ["--lens", "double-gauss-50", "-N", "2.8", "--samples", "256", *square(0.004)]
    for s, *others in (900, 830, 980), (2000, 1700, 2400):
        spread = []
        for distance in s, *others:
            # from H, which lies before the entrance pupil or behind it
            z = distance - studio.pupil_from_h
            rows = studio.take(AHEAD + LAMP + f"sphere material=lamp at=0,0,{-z} "
                               f"radius={distance / 5000}\n", "-s", f"{s}mm", *common)
            if rows is None:
                return
            spread.append(math.sqrt(second(rows, 0.004)))
        studio.checks.check(spread[0] < 0.7 * min(spread[1:]),
                            f"focused on {s} mm: rms {spread} at {s} {others}")
    scene = studio.write(AHEAD + LAMP + "disc material=lamp radius=9 at=0,0,-500\n")
    for words in ("-s", "40mm"), ("-s", "49.9mm", "--model", "thick"):
        result = studio.program.run("render", scene, "--lens", "hand.lens",
                                    *words, "-t", "1", "-o", "near.pfm", cwd=studio.folder)
        studio.checks.check(result.returncode == 1 and
                            b"more than the focal length" in result.stderr and
                            not os.path.exists(os.path.join(studio.folder, "near.pfm")),
                            f"{words}: {result.stderr}")


def main():
    program, checks = Program(sys.argv[1]), Checks()
    with tempfile.TemporaryDirectory(prefix="lenscalc-lamps-") as folder:
        studio = Studio(program, checks, folder)
        with open(os.path.join(folder, "hand.lens"), "w", encoding="utf-8") as file:
            file.write(HAND)
        row = program.rows("lens", "double-gauss-50")[0]
        studio.pupil_from_h = float(row["front_principal_mm"]) - float(row["entrance_pupil_mm"])
        for check in (check_confusion, check_flux, check_marginal, check_blades, check_axial,
                      check_perspective, check_focus):
            check(studio)
    return checks.finish()


if __name__ == "__main__":
    sys.exit(main())
