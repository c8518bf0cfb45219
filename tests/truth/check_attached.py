#!/usr/bin/env python3
"""tests/truth/check_attached.py - depth of field through attachments: check_attached.py BUILD_DIR

dof with --tube, --close-up and --converter on real lenses against paraxial rays in exact rationals
(check_photo_lens.py), which know nothing of equivalent lenses: the close-up lens is two surfaces
without thickness before the first vertex, the tube moves the sensor, and the stop keeps its size.
The subject must be imaged on the sensor, and the beams from near and far limit be as wide there as
the circle of confusion. A converter only enlarges what the lens does alone: seen from the front of
the lens, the limits are those of the lens alone with a circle of confusion that much smaller.
"""
# SPDX-License-Identifier: MIT

import math
import os
import sys
import tempfile
from fractions import Fraction

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from check_photo_lens import C, LENSES, Fixture, Lens, write
from harness import Checks


def with_close_up(lens, dioptres):
    """The lens with a thin one of that power at its first vertex, of index 1.5."""
    power = Fraction(dioptres) / 1000
    both = Lens(lens.name, LENSES[lens.name])
    both.surfaces = [(power / Fraction("0.5"), Fraction(0), Fraction("1.5")),
                     (Fraction(0), Fraction(0), Fraction(1))] + lens.surfaces
    both.stop = lens.stop + 2
    return both


def check_limits(fixture, name, row, lens, radius, sensor):
    """The subject is sharp, and what lies at the limits is C wide."""
    subject = sensor - Fraction(row["distance_sensor_m"]) * 1000
    fixture.near(f"{name}: image of the subject", float(lens.image(subject)), sensor,
                 Fraction(1, 10**11))
    E, scale = lens.entrance_pupil()
    beam = radius * abs(scale)
    for key in ("near", "far"):
        place = sensor - Fraction(row[key + "_sensor_m"]) * 1000
        width = abs(2 * lens.to_sensor(E, beam, beam / (E - place), sensor))
        fixture.near(f"{name}: blur at the {key} limit", float(width), C, Fraction(1, 10**9))
    slope = lens.trace(beam - E * (beam / (E - subject)), beam / (E - subject))[1]
    fixture.near(f"{name}: working f-number", row["working_fnumber"], abs(1 / (2 * slope)),
                 Fraction(1, 10**11))


def check_extended(fixture, lens, N, tube, dioptres):
    """The lens itself at infinity, its sensor moved by the tube."""
    words = ["--tube", tube] if tube != "0" else []
    words += ["--close-up", dioptres] if dioptres != "0" else []
    name = f"dof {lens.name} f/{N} tube {tube} mm, close-up {dioptres}"
    row, assumed, result = fixture.ask("dof", "--lens", lens.name + ".lens", "-N", N, "-c", "0.03mm",
                                       *words)
    if not fixture.checks.check(row is not None, f"{name}: {result.stderr}"):
        return
    y, u = lens.trace(Fraction(1), Fraction(0))
    sensor = lens.length - y / u + Fraction(tube)
    f = lens.focal()[0]
    stop_radius = f / Fraction(N) / 2 / abs(lens.entrance_pupil()[1])
    both = with_close_up(lens, dioptres) if dioptres != "0" else lens
    fixture.near(f"{name}: focal length", row["combined_focal_mm"], both.focal()[0],
                 Fraction(1, 10**13))
    fixture.checks.check(assumed["lens_focus"] == "infinity", f"{name}: {assumed}")
    check_limits(fixture, name, row, both, stop_radius, sensor)
    # any nearer subject is reached, a farther one is not
    s = row["distance_m"] * 1000
    near, _, _ = fixture.ask("dof", "--lens", lens.name + ".lens", "-N", N, "-s", f"{0.99 * s}mm",
                             *words)
    far, _, refused = fixture.ask("dof", "--lens", lens.name + ".lens", "-N", N, "-s",
                                  f"{1.01 * s}mm", *words)
    fixture.checks.check(near is not None and far is None and "out of reach" in refused.stderr,
                         f"{name}: reach {refused.stderr}")


def check_converter(fixture, lens, N, factor, s):
    """From the front of the lens, with the circle of confusion as it is before the converter."""
    name = f"dof {lens.name} f/{N} {s} mm with {factor}x"
    front = repr(float(s)) + "mm"
    row, _, result = fixture.ask("dof", "--lens", lens.name + ".lens", "-N", N, "-c", "0.03mm",
                                 "--from", "front", "-s", front, "--converter", factor)
    if not fixture.checks.check(row is not None, f"{name}: {result.stderr}"):
        return
    z = -Fraction(front[:-2])
    sensor = lens.image(z)
    E, _ = lens.entrance_pupil()
    radius = lens.focal()[0] / Fraction(N) / 2
    for key in ("near_m", "far_m"):
        if row[key] is not None:
            place = -Fraction(row[key]) * 1000
            width = abs(2 * lens.to_sensor(E, radius, radius / (E - place), sensor))
            fixture.near(f"{name}: blur at {key}", float(width * Fraction(factor)), C,
                         Fraction(1, 10**9))
    alone = abs(lens.to_sensor(z, Fraction(1), -1 / (E - z), sensor))
    fixture.near(f"{name}: magnification", row["magnification"], alone * Fraction(factor),
                 Fraction(1, 10**12))
    fixture.checks.check(row["distance_sensor_m"] is None, f"{name}: sensor unknown")
    fixture.checks.check(math.isclose(row["combined_fnumber"], float(N) * float(factor)),
                         f"{name}: f-number")


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory(prefix="lenscalc-attached-") as folder:
        fixture = Fixture(sys.argv[1], checks, folder)
        for name, spec in LENSES.items():
            if "medium" in spec:
                continue  # a close-up lens has its power in air
            lens = Lens(name, spec)
            write(fixture, name + ".lens", lens.text())
            for N, tube, dioptres in (("4", "12", "0"), ("8", "0", "3"), ("5.6", "25", "2")):
                check_extended(fixture, lens, N, tube, dioptres)
            for factor, s in (("2", "3000"), ("1.4", "600")):
                check_converter(fixture, lens, "8", factor, s)
    checks.finish()


if __name__ == "__main__":
    main()
