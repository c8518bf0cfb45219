#!/usr/bin/env python3
"""tests/truth/check_conjugate.py - object, image and focusing against an independent computation:
check_conjugate.py BUILD_DIR

Random lenses in random media, traced by y-nu in 60 digits: what the program says of object and
image must agree within 8 units of the last place of the largest length it is a difference of.
Focusing is put back in: the moved gaps must bring the image to its plane. Closed forms: Newton's
equation of a thin lens, a ball, a plate, a mirror, a telescope.
"""
# SPDX-License-Identifier: MIT

import json
import math
import os
import random
import shlex
import subprocess
import sys
from decimal import Decimal, getcontext

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import ROOT, Checks

getcontext().prec = 60
UNIT = Decimal(2) ** -53


def answer(program, words, lens=None):
    """The rows, or what was said instead."""
    wrapper = shlex.split(os.environ.get("LENSCALC_WRAPPER", ""))
    result = subprocess.run([*wrapper, program, "conjugate", *words, "--json"], input=lens,
                            capture_output=True, text=True)
    return json.loads(result.stdout)["rows"] if result.returncode == 0 else result.stderr


def trace(surfaces, before, y, v):
    """y, v behind the last of (curvature, thickness, index); v = n u."""
    n = before
    for i, (curvature, thickness, after) in enumerate(surfaces):
        v -= y * (after - n) * curvature
        n = after
        if i + 1 < len(surfaces):
            y += thickness / n * v
    return y, v


class System:
    """A lens in 60 digits: stop None or the number of the surface it lies on, from 0."""

    def __init__(self, surfaces, before, stop):
        self.surfaces, self.n, self.stop = surfaces, before, stop
        self.n_image = surfaces[-1][2]
        self.a, self.c = trace(surfaces, before, Decimal(1), Decimal(0))
        self.b, self.d = trace(surfaces, before, Decimal(0), Decimal(1))
        self.length = sum(surface[1] for surface in surfaces[:-1])

    def places(self):
        """H, F, entrance pupil from the first vertex; H', F', exit pupil from the last."""
        n, n_image, a, c, d = self.n, self.n_image, self.a, self.c, self.d
        front = self.surfaces[:self.stop + 1]
        a1, b1 = trace(front, n, Decimal(1), Decimal(0))[0], trace(front, n, Decimal(0),
                                                                   Decimal(1))[0]
        # the chief ray starts at the entrance pupil: y = -b1/a1 v
        y, v = trace(self.surfaces, n, -b1 / a1, Decimal(1))
        return {"principal": (n * (d - 1) / c, n_image * (1 - a) / c),
                "focal": (n * d / c, -n_image * a / c), "front": (Decimal(0), Decimal(0)),
                "entrance": (n * b1 / a1, -n_image * y / v)}

    def image(self, distance):
        """Image from the last vertex and magnification of an object left of the first."""
        y, v = trace(self.surfaces, self.n, distance / self.n, Decimal(1))
        return -self.n_image * y / v, 1 / v

    def text(self, extra=()):
        lines = [f"medium {self.n}"]
        for i, (curvature, thickness, n) in enumerate(self.surfaces):
            stop = " stop" if i == self.stop else ""
            lines.append(f"surface - {thickness} {n} 10 c={curvature}{stop}")
        return "\n".join([*extra, *lines]) + "\n"


def random_system(rng):
    def number(low, high):
        return Decimal(f"{rng.uniform(low, high):.4f}")
    surfaces = [(Decimal(f"{rng.uniform(-0.03, 0.03):.5f}"), number(0.5, 12),
                 number(1.4, 1.9) if i % 2 == 0 else Decimal(1)) for i in range(rng.randint(2, 8))]
    last = surfaces[-1]
    surfaces[-1] = (last[0], Decimal(0), rng.choice([Decimal(1), Decimal("1.333")]))
    before = rng.choice([Decimal(1), Decimal("1.333"), Decimal("1.5")])
    return System(surfaces, before, rng.randrange(len(surfaces)))


def close(checks, name, value, expected, size):
    """Within 8 units of the last place of `size`."""
    case, _, quantity = name.rpartition(": ")
    checks.against("conjugates", case, quantity, value, expected, 8 * UNIT * (size + abs(expected)),
                   "" if "agnification" in quantity or quantity in ("angular", "longitudinal") else "mm")


def check_row(checks, name, system, row, distance):
    """All of a row against the object that lies `distance` left of the first vertex."""
    image, m = system.image(distance)
    places = system.places()
    ratio = system.n / system.n_image
    # an image that is far away moves with the last digit of the object's distance
    swing = 1 + abs(ratio * m * m)
    for word, key in (("front", "front"), ("principal", "principal"), ("focal", "focal"),
                      ("entrance", "pupil")):
        left, right = places[word]
        size = abs(distance) + abs(left)
        close(checks, f"{name}: object_{key}", row[f"object_{key}_mm"], distance + left, size)
        key = "rear" if key == "front" else key
        close(checks, f"{name}: image_{key}", row[f"image_{key}_mm"], image - right,
              abs(image) + abs(right) + swing * size)
    spread = 1 + abs(distance) * abs(system.c * m)
    close(checks, f"{name}: magnification", row["magnification"], m, abs(m) * spread)
    close(checks, f"{name}: angular", row["angular_magnification"], ratio / m,
          abs(ratio / m) * spread)
    close(checks, f"{name}: longitudinal", row["longitudinal_magnification"], m * m / ratio,
          m * m / ratio * spread)
    close(checks, f"{name}: total", row["total_mm"], distance + system.length + image,
          abs(distance) + system.length + abs(image) + swing * abs(distance))
    checks.check(row["object_kind"] == ("virtual" if distance < 0 else "real") and
                 row["image_kind"] == ("virtual" if image < 0 else "real") and
                 row["orientation"] == ("upright" if m > 0 else "inverted"),
                 f"{name}: {row['object_kind']}, {row['image_kind']}, {row['orientation']}")


def check_random(checks, program):
    rng = random.Random(20261121)
    for case in range(60):
        system = random_system(rng)
        places = system.places()
        for word, (left, right) in places.items():
            typed = Decimal(f"{rng.choice([1, -1]) * 10 ** rng.uniform(0, 4):.3f}")
            name = f"lens {case}, {typed} from {word}"
            rows = answer(program, ["-", "--object", str(typed), "--from", word], system.text())
            if checks.check(isinstance(rows, list) and len(rows) == 1, f"{name}: {rows}"):
                # it lies `typed` left of a point at `left`
                check_row(checks, name, system, rows[0], typed - left)
            rows = answer(program, ["-", "--image", str(typed), "--from", word], system.text())
            x = (typed + right) / system.n_image
            distance = -system.n * (system.b + x * system.d) / (system.a + x * system.c)
            if checks.check(isinstance(rows, list) and len(rows) == 1, f"{name}: {rows}"):
                # here the image is given, and the object has its swing
                got = Decimal(rows[0]["object_front_mm"])
                m = system.a + x * system.c
                size = abs(distance) + (abs(typed) + abs(right)) * system.n / (system.n_image *
                                                                               m * m)
                close(checks, f"{name} (image): object", got, distance, size)
        m = Decimal(f"{rng.choice([1, -1]) * 10 ** rng.uniform(-3, 2):.4f}")
        rows = answer(program, ["-", "-m", str(m)], system.text())
        distance = system.n * (1 / m - system.d) / system.c
        if checks.check(isinstance(rows, list), f"lens {case}, -m {m}: {rows}"):
            close(checks, f"lens {case}, -m {m}: object", rows[0]["object_front_mm"], distance,
                  abs(system.n / system.c) * (abs(1 / m) + abs(system.d)))
            close(checks, f"lens {case}, -m {m}: magnification", rows[0]["magnification"], m,
                  abs(m))


def check_total(checks, program):
    """Both solutions of object to image, put back in."""
    rng = random.Random(7)
    found = 0
    for case in range(40):
        system = random_system(rng)
        total = Decimal(f"{rng.choice([1, -1]) * 10 ** rng.uniform(1.5, 4):.3f}")
        k = system.n_image * system.a + system.n * system.d + system.c * (total - system.length)
        inside = k * k - 4 * system.n * system.n_image
        rows = answer(program, ["-", "--object", str(total), "--from", "sensor"], system.text())
        name = f"lens {case}, {total} from object to image"
        if inside < 0:
            checks.check(isinstance(rows, str) and "the distance must be" in rows, f"{name}: {rows}")
            continue
        roots = sorted(((k + sign * inside.sqrt()) / (2 * system.n_image) for sign in (1, -1)),
                       key=abs)
        if not checks.check(isinstance(rows, list) and len(rows) == 2, f"{name}: {rows}"):
            continue
        found += 1
        for row, m in zip(rows, roots):
            steep = 1 + abs(system.c) * (abs(total) + system.length) / inside.sqrt()
            close(checks, f"{name}: magnification", row["magnification"], m, abs(m) * steep)
    checks.check(found > 15, "too few of the lenses have two solutions")


def check_focusing(checks, program):
    """The movement, put back in: the image must lie in its plane, every gap stay above 0."""
    rng = random.Random(11)
    answered = rows_seen = 0
    for case in range(100):
        system = random_system(rng)
        count = len(system.surfaces)
        plane = Decimal(f"{rng.uniform(20, 90):.2f}")
        thickness = [surface[1] for surface in system.surfaces[:-1]] + [plane]
        weights = {gap: Decimal(rng.choice(["1", "-1", "0.5", "2"]))
                   for gap in rng.sample(range(count), rng.randint(1, min(3, count)))}
        typed = Decimal(f"{10 ** rng.uniform(2.3, 4):.2f}")
        word = rng.choice(["front", "principal", "focal", "entrance", "sensor"])
        shape = system.surfaces[:-1] + [(system.surfaces[-1][0], plane, system.n_image)]
        text = System(shape, system.n, system.stop).text(("focus table",))
        words = ["-", "--object", str(typed), "--from", word, "--gap",
                 ",".join(f"{gap + 1}:{weight}" for gap, weight in weights.items())]
        rows = answer(program, words, text)
        name = f"lens {case}, {' '.join(words[1:])}"
        limits = [-thickness[gap] / weight for gap, weight in weights.items()]

        def defocus(e):
            """Image less plane; infinite beyond all bounds is far from 0."""
            t = [thickness[i] + weights.get(i, 0) * e for i in range(count)]
            moved = System([(s[0], t[i], s[2]) for i, s in enumerate(system.surfaces)], system.n,
                           system.stop)
            if word == "sensor":
                distance = typed - moved.length - t[-1]
            else:
                distance = typed - moved.places()[word][0]
            image, m = moved.image(distance)
            return image - t[-1], m, t

        if isinstance(rows, str):
            # then no sample within the limits may change its sign without a pole
            low = max([e for e, w in zip(limits, weights.values()) if w > 0] or [Decimal(-300)])
            high = min([e for e, w in zip(limits, weights.values()) if w < 0] or [Decimal(300)])
            samples = [low + (high - low) * i / 200 for i in range(1, 200)]
            values = [defocus(e) for e in samples] if low < high else []
            crossed = [1 for one, two in zip(values, values[1:])
                       if one[0] * two[0] < 0 and abs(one[0]) + abs(two[0]) < 20 and
                       (word != "sensor" or typed > sum(two[2]))]
            checks.check("no movement brings" in rows or "no image is" in rows or
                         "no object before" in rows, f"{name}: {rows}")
            checks.check(not crossed, f"{name} is refused, and there is a focus: {rows}")
            continue
        answered += 1
        moves = [abs(row["movement_mm"]) for row in rows]
        checks.check(moves == sorted(moves), f"{name}: the smallest movement is not first")
        for row in rows:
            rows_seen += 1
            e = Decimal(row["movement_mm"])
            off, m, t = defocus(e)
            slope = (defocus(e + Decimal("1e-12"))[0] - off) / Decimal("1e-12")
            allowed = abs(slope) * abs(e) * 4 * UNIT + abs(t[-1]) * 8 * UNIT
            checks.check(abs(off) <= allowed, f"{name}: after {e} mm the image is {off:.3g} mm off, "
                                              f"allowed {allowed:.3g}")
            checks.check(all(gap >= -1e-12 for gap in t), f"{name}: a gap is negative: {t}")
    checks.check(answered > 25 and rows_seen > answered, f"only {answered} lenses were focused")


def number(row, key):
    return math.inf if row[key] is None else row[key]


def check_closed_forms(checks, program):
    thin = "surface 50 0 1.5 -\nsurface -50 0 air -\n"  # f = 50
    for object_distance in (75, 100, 150, 500, 25, 10, -20, -200):
        row = answer(program, ["-", "--object", str(object_distance)], thin)[0]
        x = object_distance - 50
        close(checks, f"thin lens {object_distance}: Newton x x' = f^2", row["image_focal_mm"],
              Decimal(2500) / x, Decimal(2500) / abs(x))
        close(checks, f"thin lens {object_distance}: m", row["magnification"], Decimal(-50) / x,
              Decimal(50) / abs(x))
    row = answer(program, ["-", "--object", "50"], thin)[0]
    checks.check(row["image_rear_mm"] is None and
                 row["image_rear_is_infinite"] and row["image_kind"] == "at infinity" and
                 row["magnification_is_infinite"] and row["angular_magnification"] == 0,
                 f"thin lens, object at F: {row}")
    row = answer(program, ["-", "--object", "inf"], thin)[0]
    checks.check(row["image_rear_mm"] == 50 and row["magnification"] == 0 and
                 row["orientation"] == "inverted" and row["object_kind"] == "at infinity",
                 f"thin lens, object at infinity: {row}")
    # the least distance from object to image is 4 f, at m = -1
    rows = answer(program, ["-", "--object", "200", "--from", "sensor"], thin)
    checks.check(len(rows) == 1 and rows[0]["magnification"] == -1, f"4 f: {rows}")
    rows = answer(program, ["-", "--object", "199", "--from", "sensor"], thin)
    checks.check("0 mm or less, or 200 mm or more" in rows, f"less than 4 f: {rows}")
    # focusing by the lens: s = (T +- sqrt(T (T - 4 f)))/2 with T = 250: s' = 125 -+ 55.9...
    rows = answer(program, ["-", "--object", "250", "--from", "sensor", "--focus-by", "lens"], thin)
    for row, sign in zip(rows, (-1, 1)):
        close(checks, "focusing by the lens: s'", row["image_rear_mm"],
              (Decimal(250) + sign * (Decimal(250) * 50).sqrt()) / 2, Decimal(250))
    checks.check(len(rows) == 2, "focusing by the lens has two solutions")
    # a ball in water images its aplanatic points with m = n^2: an object at R/n behind its centre
    ball = "surface 10 20 1.6 -\nsurface -10 - air -\n"
    row = answer(program, ["-", "--object", "inf"], ball)[0]
    close(checks, "ball: n D/(4 (n - 1)) - R", row["image_rear_mm"], Decimal(10) / 3, Decimal(10))
    single = "surface -10 - air -\n"
    row = answer(program, ["-", "--object-medium", "1.6", "--object", "16.25", "--from", "front"],
                 "medium 1.6\nsurface -10 - air -\n")[0]
    # aplanatic: 16.25 = R + R/n before the vertex, the image R + n R before it, m = n^2
    close(checks, "aplanatic point: image", row["image_rear_mm"], Decimal(-26), Decimal(26))
    close(checks, "aplanatic point: m", row["magnification"], Decimal("2.56"), Decimal(3))
    checks.check(row["image_kind"] == "virtual" and row["orientation"] == "upright",
                 f"aplanatic point: {row}")
    same = answer(program, ["-", "--object-medium", "1.6", "--object", "16.25", "--from", "front"],
                  single)[0]
    checks.check(same == row, "--object-medium differs from the file's medium")
    # a plate of 15 mm, n = 1.5, shifts by t (1 - 1/n) = 5; afocal, m = 1
    row = answer(program, ["-", "--object", "20", "--from", "front"],
                 "surface - 15 1.5 -\nsurface - 0 air -\n")[0]
    checks.check(row["magnification"] == 1 and abs(row["image_rear_mm"] + 30) < 1e-13 and
                 row["object_principal_is_infinite"], f"plate: {row}")
    # a concave mirror, R = -200: at its centre m = -1, the image where the object is
    row = answer(program, ["-", "--object", "200", "--from", "front"], "surface -200 - mirror -\n")[0]
    checks.check(row["magnification"] == -1 and row["image_rear_mm"] == -200 and
                 row["image_kind"] == "real" and row["total_mm"] == 0, f"mirror: {row}")
    # Galilean telescope f1 = 150, f2 = -50: m = 1/3 everywhere, angular 3
    scope = ("surface 75 0 1.5 -\nsurface - 100 air -\nsurface -25 0 1.5 -\n"
             "surface - 0 air -\n")
    for distance in ("900", "inf"):
        row = answer(program, ["-", "--object", distance, "--from", "front"], scope)[0]
        close(checks, f"telescope {distance}: m", row["magnification"], Decimal(1) / 3, Decimal(1))
        close(checks, f"telescope {distance}: angular", row["angular_magnification"], Decimal(3),
              Decimal(3))
    checks.check(math.isinf(number(row, "image_rear_mm")), "telescope: image of infinity")
    refused = answer(program, ["-", "--object", "900"], scope)
    checks.check(isinstance(refused, str) and "afocal" in refused, f"telescope from H: {refused}")


def main():
    os.chdir(ROOT)
    checks = Checks()
    program = os.path.join(os.path.abspath(sys.argv[1]), "lenscalc")
    check_closed_forms(checks, program)
    check_random(checks, program)
    check_total(checks, program)
    check_focusing(checks, program)
    checks.finish()


main()
