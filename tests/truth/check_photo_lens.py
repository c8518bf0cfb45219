#!/usr/bin/env python3
"""tests/truth/check_photo_lens.py - photographs through real lenses: check_photo_lens.py BUILD_DIR

The photographic commands with --lens against rays through the surfaces of the lens. The rays are
paraxial, traced here in exact rationals from the decimals of the prescription: nothing is known of
principal planes, pupil magnification or depth of field, only heights and slopes. So the blur of a
point at the near limit is the width of its traced beam on the sensor, and must be the circle of
confusion; the working f-number is the slope of the traced marginal ray; the angle of view is the
slope of the traced chief ray.
"""
# SPDX-License-Identifier: MIT

import json
import math
import os
import subprocess
import sys
import tempfile
from fractions import Fraction

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import ROOT, Checks, Program

C = Fraction("0.03")  # circle of confusion, mm

# 50-digit values of an independent program for the double Gauss of W. Smith, Modern Lens Design,
# p. 312, in the d line: ../shared/reference/golden.md, section 1
GOLDEN = {"f": "100.71633391662729", "H": "46.471442674350058", "H'": "-28.504523439543020",
          "E": "39.892965297570099", "E'": "-35.542713478024463"}

# radius (None = plane), distance to the next vertex, index behind; `stop` is the surface that
# limits, `diameter` its clear diameter
LENSES = {
    "double-gauss": {
        "surfaces": [("58.950", "7.520", "1.670"), ("169.660", "0.240", "1"),
                     ("38.550", "8.050", "1.670"), ("81.540", "6.550", "1.699"),
                     ("25.500", "11.410", "1"), (None, "9.000", "1"),
                     ("-28.990", "2.360", "1.603"), ("81.540", "12.130", "1.658"),
                     ("-40.770", "0.380", "1"), ("874.130", "6.440", "1.717"),
                     ("-79.460", "0", "1")],
        "stop": 5, "diameter": "34.2"},
    # invented: a telephoto with a far hiatus, a retrofocus, a stop before and one behind a singlet
    "tele": {
        "surfaces": [("60", "8", "1.6"), ("-150", "55", "1"), (None, "3", "1"),
                     ("-40", "2", "1.7"), ("90", "0", "1")], "stop": 2, "diameter": "12"},
    "retrofocus": {
        "surfaces": [("80", "3", "1.5"), ("20", "30", "1"), (None, "2", "1"),
                     ("45", "9", "1.65"), ("-32", "0", "1")], "stop": 2, "diameter": "9"},
    "landscape": {
        "surfaces": [(None, "12", "1"), ("-60", "4", "1.52"), ("-25", "0", "1")],
        "stop": 0, "diameter": "7"},
    "rear-stop": {
        "surfaces": [("50", "5", "1.5168"), ("-300", "9", "1"), (None, "0", "1")],
        "stop": 2, "diameter": "10"},
    # the same medium before and behind, denser than air
    "diver": {
        "medium": "1.333",
        "surfaces": [("30", "6", "1.75"), ("-80", "2", "1.333"), (None, "4", "1.333"),
                     ("-200", "3", "1.6"), ("-60", "0", "1.333")], "stop": 2, "diameter": "14"},
}


class Lens:
    """A prescription in rationals: rays by height and slope (y, u) at z from the first vertex."""

    def __init__(self, name, spec):
        self.name = name
        self.n0 = Fraction(spec.get("medium", "1"))
        self.surfaces = [(Fraction(1) / Fraction(r) if r else Fraction(0), Fraction(t), Fraction(n))
                         for r, t, n in spec["surfaces"]]
        self.stop, self.diameter = spec["stop"], Fraction(spec["diameter"])
        self.length = sum(t for _, t, _ in self.surfaces[:-1])

    def trace(self, y, u, last=None):
        """From the first vertex to behind surface `last`, all of them without it."""
        n = self.n0
        for i, (curvature, thickness, index) in enumerate(self.surfaces):
            u = (n * u - y * (index - n) * curvature) / index
            n = index
            if i == last:
                break
            if i + 1 < len(self.surfaces):
                y += thickness * u
        return y, u

    def to_sensor(self, z, y, u, sensor):
        """Height where a ray from (z, y) with slope u before the lens meets the plane `sensor`."""
        y, u = self.trace(y - z * u, u)
        return y + (sensor - self.length) * u

    def entrance_pupil(self):
        """Where rays that meet the stop's centre cross the axis before the lens."""
        a, _ = self.trace(Fraction(1), Fraction(0), self.stop - 1) if self.stop else (1, 0)
        b, _ = self.trace(Fraction(0), Fraction(1), self.stop - 1) if self.stop else (0, 1)
        if self.stop:
            step = self.surfaces[self.stop - 1][1]
            a += step * self.trace(Fraction(1), Fraction(0), self.stop - 1)[1]
            b += step * self.trace(Fraction(0), Fraction(1), self.stop - 1)[1]
        return Fraction(b) / Fraction(a), Fraction(1) / Fraction(a)

    def focal(self):
        """Focal length and H, H' from the first vertex, of a ray parallel to the axis."""
        y, u = self.trace(Fraction(1), Fraction(0))
        f = -1 / u
        y2, u2 = self.trace(Fraction(0), Fraction(1))
        # a ray through the front focal point leaves parallel
        front_focus = u2 / u
        return f, front_focus + f, self.length - y / u - f

    def image(self, z):
        """Where the point z of the axis is imaged, from the first vertex."""
        y, u = self.trace(-z, Fraction(1))
        return self.length - y / u

    def text(self):
        lines = [f"lens {self.name}"]
        if self.n0 != 1:
            lines.append(f"medium {float(self.n0)!r}")
        lines += ["wavelength d", "aperture stop"]
        for i, (c, t, n) in enumerate(self.surfaces):
            radius = "-" if c == 0 else str(float(1 / c))
            medium = "air" if n == 1 else str(float(n))
            if i == self.stop:
                lines.append(f"stop - {float(t)} {medium} {float(self.diameter)}")
            else:
                lines.append(f"surface {radius} {float(t)} {medium} -")
        return "\n".join(lines) + "\n"


class Fixture:
    def __init__(self, build, checks, folder):
        self.program = Program(build)
        self.checks = checks
        self.folder = folder

    def ask(self, *words):
        result = subprocess.run([os.path.join(self.program.path, "lenscalc"), *words, "--json"],
                                capture_output=True, text=True, cwd=self.folder)
        if result.returncode != 0:
            return None, None, result
        answer = json.loads(result.stdout)
        return answer["rows"][0], answer["assumptions"], result

    def near(self, what, got, expected, tolerance):
        case, _, quantity = what.rpartition(": ")
        if expected == 0:
            self.checks.check(got == 0, f"{what} is {got!r}, expected 0")
        else:
            self.checks.against_relative("photo-lens", case, quantity, got, expected, tolerance)


def sensor_place(H, row_s, row_Ds):
    """The plane of the sensor, from the first vertex: the subject is at H - s, the sensor Ds on."""
    return H - Fraction(row_s) + Fraction(row_Ds)


def check_dof(fixture, lens, N, s):
    """Near, far and subject are where the traced beams are c, c and nothing wide on the sensor."""
    f, H, H2 = lens.focal()
    E, _ = lens.entrance_pupil()
    row, assumed, result = fixture.ask("dof", "--lens", lens.name + ".lens", "-N", N, "-s", s + "mm",
                                     "-c", "0.03mm")
    name = f"dof {lens.name} f/{N} {s} mm"
    if not fixture.checks.check(row is not None, f"{name}: {result.stderr}"):
        return
    fixture.checks.check(assumed["lens"] == lens.name, f"{name}: lens is {assumed['lens']!r}")
    fixture.near(f"{name}: focal length", row["focal_mm"], f, Fraction(1, 10**14))
    fixture.near(f"{name}: assumed focal length", assumed["lens_focal_mm"], f, Fraction(1, 10**14))
    subject, distance = Fraction(s), Fraction(s)
    z = H - distance
    sensor = lens.image(z)
    fixture.near(f"{name}: sensor distance", row["distance_sensor_m"] * 1000, sensor - z,
               Fraction(1, 10**13))
    fixture.near(f"{name}: hiatus", row["hiatus_mm"] or 0, H2 - H, Fraction(1, 10**12))
    radius = f / Fraction(N) / 2
    for limit, key in ((row["near_m"], "near"), (row["far_m"], "far")):
        if limit is None:
            # infinity is sharp: a parallel beam is not wider than c
            width = abs(2 * lens.to_sensor(E, radius, Fraction(0), sensor))
            fixture.checks.check(width <= C * (1 + Fraction(1, 10**12)),
                               f"{name}: infinity is {float(width)!r} wide")
            continue
        # from the first vertex, with the sensor's distance for the place: two columns in one test
        for place, how in ((H - Fraction(limit) * 1000, "principal"),
                           (sensor - Fraction(row[key + "_sensor_m"]) * 1000, "sensor")):
            width = abs(2 * lens.to_sensor(E, radius, radius / (E - place), sensor))
            slack = max(row["magnification"], 1e-3)
            fixture.near(f"{name}: blur at the {key} limit from the {how}", float(width), C,
                       Fraction(2e-11 / slack * float(Fraction(N))))
    y = radius
    marginal = lens.trace(y - E * (radius / (E - z)), radius / (E - z))
    fixture.near(f"{name}: working f-number", row["working_fnumber"], abs(1 / (2 * marginal[1])),
               Fraction(1, 10**13))
    # one mm at the subject, by a ray through the pupil's centre
    height = lens.to_sensor(z, Fraction(1), -1 / (E - z), sensor)
    fixture.near(f"{name}: magnification", row["magnification"], abs(height), Fraction(1, 10**13))
    for place, offset in (("sensor", sensor - H), ("entrance", E - H), ("front", -H)):
        other, _, result = fixture.ask("dof", "--lens", lens.name + ".lens", "-N", N, "-c", "0.03mm",
                                     "--from", place, "-s", repr(float(distance + offset)) + "mm")
        if not fixture.checks.check(other is not None, f"{name} --from {place}: {result.stderr}"):
            continue
        for key in ("near_m", "far_m"):
            if row[key] is None or other[key] is None:
                fixture.checks.check(row[key] == other[key], f"{name} --from {place}: {key}")
                continue
            # where T(s) is flat, near 1:1, the distance from the sensor tells s badly
            flat = 1e-9 if place == "sensor" and row["magnification"] > 0.3 else 1e-12
            fixture.near(f"{name} --from {place}: {key}", other[key],
                       Fraction(row[key]) + offset / 1000, Fraction(flat))
        fixture.near(f"{name} --from {place}: m", other["magnification"], row["magnification"],
                   Fraction(flat * 10))


def check_hyperfocal(fixture, lens, N):
    f, H, _ = lens.focal()
    E, _ = lens.entrance_pupil()
    row, _, result = fixture.ask("hyperfocal", "--lens", lens.name + ".lens", "-N", N, "-c", "0.03mm")
    name = f"hyperfocal {lens.name} f/{N}"
    if not fixture.checks.check(row is not None, f"{name}: {result.stderr}"):
        return
    z = H - Fraction(row["hyperfocal_m"]) * 1000
    sensor = lens.image(z)
    radius = f / Fraction(N) / 2
    width = abs(2 * lens.to_sensor(E, radius, Fraction(0), sensor))
    fixture.near(f"{name}: blur of infinity", float(width), C, Fraction(1, 10**12))
    fixture.near(f"{name}: from the sensor", row["hyperfocal_sensor_m"] * 1000, sensor - z,
               Fraction(1, 10**13))
    place = sensor - Fraction(row["near_sensor_m"]) * 1000
    width = abs(2 * lens.to_sensor(E, radius, radius / (E - place), sensor))
    fixture.near(f"{name}: blur at the near limit", float(width), C, Fraction(1, 10**11))


def check_fov(fixture, lens, s):
    """The paraxial chief ray from the edge of the sensor, by tracing two rays forward."""
    _, H, _ = lens.focal()
    E, _ = lens.entrance_pupil()
    far = s == "inf"
    row, _, result = fixture.ask("fov", "--lens", lens.name + ".lens", "-s", s + ("" if far else "mm"),
                               "--sensor", "36x24mm", "--projection", "rectilinear")
    name = f"fov {lens.name} {s}"
    if not fixture.checks.check(row is not None, f"{name}: {result.stderr}"):
        return
    y, u = lens.trace(Fraction(1), Fraction(0))
    sensor = lens.length - y / u if far else lens.image(H - Fraction(s))
    per_slope = abs(lens.to_sensor(E, Fraction(0), Fraction(1), sensor))
    half = Fraction(math.tan(math.radians(row["horizontal_deg"]) / 2))
    fixture.near(f"{name}: chief ray", float(half), 18 / per_slope, Fraction(1, 10**14) * 4)
    if not far:
        z = H - Fraction(s)
        fixture.near(f"{name}: from the sensor", row["distance_sensor_m"] * 1000, sensor - z,
                   Fraction(1, 10**13))
        width = 36 / abs(lens.to_sensor(z, Fraction(1), -1 / (E - z), sensor))
        fixture.near(f"{name}: field width", row["field_width_m"] * 1000, width, Fraction(1, 10**13))


def check_focus(fixture, lens, m):
    f, H, H2 = lens.focal()
    row, _, result = fixture.ask("focus", "--lens", lens.name + ".lens", "-m", m)
    name = f"focus {lens.name} {m}"
    if not fixture.checks.check(row is not None, f"{name}: {result.stderr}"):
        return
    z = H - Fraction(row["distance_m"]) * 1000
    sensor = lens.image(z)
    height = abs(lens.to_sensor(z, Fraction(1), Fraction(0), sensor))
    fixture.near(f"{name}: magnification", float(height), Fraction(m), Fraction(1, 10**12))
    fixture.near(f"{name}: from the sensor", row["sensor_distance_m"] * 1000, sensor - z,
               Fraction(1, 10**13))
    fixture.near(f"{name}: working distance", row["working_distance_m"] * 1000, -z,
               Fraction(1, 10**12))
    fixture.near(f"{name}: extension", row["extension_mm"], sensor - H2 - f, Fraction(1, 10**11))
    E, scale = lens.entrance_pupil()
    radius = abs(scale) * lens.diameter / 2
    slope = lens.trace(radius - E * (radius / (E - z)), radius / (E - z))[1]
    own = abs(1 / (2 * slope))
    fixture.near(f"{name}: own f-number", row["fnumber"], f / (2 * radius), Fraction(1, 10**14))
    fixture.near(f"{name}: working f-number", row["working_fnumber"], own, Fraction(1, 10**12))
    airy, assumed, _ = fixture.ask("diffraction", "--lens", lens.name + ".lens", "-m", m)
    fixture.near(f"{name}: diffraction", airy["working_fnumber"], own, Fraction(1, 10**12))
    fixture.near(f"{name}: wavelength", assumed["wavelength_nm"], Fraction("587.5618"),
               Fraction(1, 10**15))
    # 2 x 3.8317059702075123/pi: [BornWolf99] 8.5.2, first zero of J1
    fixture.near(f"{name}: Airy disc", airy["airy_diameter_um"],
               Fraction(2 * 3.8317059702075123 / math.pi) * Fraction("0.5875618") * own,
               Fraction(1, 10**12))
    light, _, _ = fixture.ask("exposure", "--lens", lens.name + ".lens", "-m", m, "--ev", "12")
    infinity = f / (2 * radius)
    fixture.near(f"{name}: light lost", light["loss_stops"], Fraction(2 * math.log2(own / infinity)),
               Fraction(1, 10**11))
    equal, _, _ = fixture.ask("equivalent", "--lens", lens.name + ".lens", "-m", m,
                            "--sensor", "36x24mm", "--to", "18x12mm")
    fixture.near(f"{name}: equal working f-number", equal["equal_working_fnumber"], own / 2,
               Fraction(1, 10**12))


def check_reversed(fixture, lens):
    """The lens turned round: the prescription from its end, 120 mm from the sensor."""
    surfaces = lens.surfaces
    turned = Lens("turned", {"surfaces": [("1", "0", "1")], "stop": 0, "diameter": "1"})
    count = len(surfaces)
    turned.surfaces = [(-surfaces[count - 1 - i][0], surfaces[count - 2 - i][1] if i < count - 1
                        else Fraction(0), surfaces[count - 2 - i][2] if i < count - 1
                        else lens.n0) for i in range(count)]
    turned.n0, turned.length = surfaces[-1][2], lens.length
    f, H, H2 = turned.focal()
    v = f * Fraction(5, 2)
    row, _, result = fixture.ask("focus", "--lens", lens.name + ".lens", "--reversed", "--image",
                               repr(float(v)) + "mm")
    name = f"focus {lens.name} --reversed"
    if not fixture.checks.check(row is not None, f"{name}: {result.stderr}"):
        return
    z = -Fraction(row["working_distance_m"]) * 1000
    sensor = turned.image(z)
    fixture.near(f"{name}: image distance", float(sensor - H2), v, Fraction(1, 10**12))
    fixture.near(f"{name}: from the sensor", row["sensor_distance_m"] * 1000, sensor - z,
               Fraction(1, 10**13))


def check_golden(fixture):
    """The rationals of this file against the 50 digits, so that both can be believed."""
    lens = Lens("double-gauss", LENSES["double-gauss"])
    f, H, H2 = lens.focal()
    E, _ = lens.entrance_pupil()
    for key, value in (("f", f), ("H", H), ("H'", H2 - lens.length), ("E", E)):
        fixture.near(f"golden: {key}", float(value), Fraction(GOLDEN[key]), Fraction(1, 10**15))
    for words, key, expected in (
            (("dof", "-s", "3m"), "pupil_magnification", None),
            (("dof", "-s", "3m"), "lens_focal_mm", Fraction(GOLDEN["f"]))):
        _, assumed, result = fixture.ask(*words, "--lens", "double-gauss")
        if expected is None:
            expected = Fraction("53.877261977554369") / Fraction("50.358166958313647")
        fixture.near(f"lensdb double-gauss: {key}", assumed[key], expected, Fraction(5, 10**16))
    for command in ("hyperfocal", "fov", "focus", "exposure", "diffraction", "equivalent"):
        more = {"focus": ["-m", "1:3"], "exposure": ["--ev", "10"]}.get(command, [])
        _, assumed, result = fixture.ask(command, "--lens", "double-gauss", *more)
        if fixture.checks.check(assumed is not None, f"{command}: {result.stderr}"):
            fixture.checks.check(assumed["lens"] == "Double Gauss 100 mm f/2", f"{command}: lens")
            fixture.near(f"{command}: lens_focal", assumed["lens_focal_mm"], Fraction(GOLDEN["f"]),
                       Fraction(1, 10**15))


def check_thin_limit(fixture):
    """A lens as thin as 1 nm with its stop on it is the thin lens of -f."""
    write(fixture, "thin.lens", "lens thin\naperture f/4\nstop - 0 air -\n"
                              "surface 100 0.000001 1.5 -\nsurface -100 0 air -\n")
    for s in ("0.25m", "1m", "10m", "200m"):
        real, _, result = fixture.ask("dof", "--lens", "thin.lens", "-s", s)
        thin, _, _ = fixture.ask("dof", "-f", "100mm", "-N", "4", "-s", s, "--columns",
                               "near_m,far_m,front_m,distance_sensor_m,near_sensor_m")
        if not fixture.checks.check(real is not None, f"thin: {result.stderr}"):
            continue
        for key in ("near_m", "far_m", "front_m", "distance_sensor_m", "near_sensor_m"):
            if real[key] is None or thin[key] is None:
                fixture.checks.check(real[key] == thin[key], f"thin {s}: {key}")
            else:
                fixture.near(f"thin {s}: {key}", real[key], Fraction(thin[key]), Fraction(1, 10**6))


def write(fixture, name, text):
    with open(os.path.join(fixture.folder, name), "w", encoding="ascii") as file:
        file.write(text)


def check_refusals(fixture):
    """What cannot be answered is refused with its reason and the right exit status."""
    write(fixture, "stopless.lens", "lens a\nsurface 50 5 1.5 -\nsurface -50 0 air -\n")
    write(fixture, "negative.lens", "lens b\nstop - 1 air 5\nsurface -50 2 1.5 -\nsurface 50 0 air -\n")
    write(fixture, "afocal.lens", "lens c\nstop - 1 air 5\nsurface - 2 1.5 -\nsurface - 0 air -\n")
    write(fixture, "eye.lens", "lens d\nstop - 1 air 5\nsurface 8 22 1.336 -\n")
    write(fixture, "mirror.lens", "lens e\nstop - 90 air 5\nsurface -200 -99 mirror -\n")
    for lens, words, status, reason in (
            ("stopless.lens", ["-N", "4"], 2, "no stop"), ("negative.lens", [], 1, "-49"),
            ("afocal.lens", ["-N", "4"], 1, "afocal"), ("eye.lens", [], 1, "1.336"),
            ("mirror.lens", [], 1, "mirror"),
            ("double-gauss", ["-f", "50"], 2, "--focal-length"),
            ("double-gauss", ["--position", "tele"], 2, "tele")):
        _, _, result = fixture.ask("dof", "--lens", lens, "-s", "3m", *words)
        fixture.checks.check(result.returncode == status and reason in result.stderr,
                           f"{lens}: status {result.returncode}, {result.stderr!r}")
    row, _, _ = fixture.ask("dof", "--lens", "stopless.lens", "-s", "3m", "-N", "4", "-P", "1.25")
    fixture.checks.check(row is not None, "a pupil magnification stands in for a stop")
    _, assumed, _ = fixture.ask("dof", "--lens", "double-gauss", "-s", "3m", "-P", "1.25")
    fixture.checks.check(assumed["pupil_magnification"] == 1.25, "-P overrides the lens")


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory(prefix="lenscalc-photo-") as folder:
        fixture = Fixture(sys.argv[1], checks, folder)
        check_golden(fixture)
        for name, spec in LENSES.items():
            lens = Lens(name, spec)
            write(fixture, name + ".lens", lens.text())
            for N, s in (("4", "2000"), ("8", "10000"), ("2.8", "350"), ("16", "500000")):
                check_dof(fixture, lens, N, s)
            check_hyperfocal(fixture, lens, "8")
            for s in ("inf", "3000", "300"):
                check_fov(fixture, lens, s)
            for m in ("0.125", "1"):
                check_focus(fixture, lens, m)
            check_reversed(fixture, lens)
        check_thin_limit(fixture)
        check_refusals(fixture)
    checks.finish()


if __name__ == "__main__":
    main()
