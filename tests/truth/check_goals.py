#!/usr/bin/env python3
"""tests/truth/check_goals.py - what goals are of, against the analyses and by hand:
check_goals.py BUILD_DIR

The value that optimize --show merit has of each goal before anything changes is the number that
lens, seidel, color, distortion, trace, spot and mtf print of the same lens. Of a thick lens of two
spheres focal length, thickness at the edge and angles of incidence are written out here.
"""
# SPDX-License-Identifier: MIT

import csv
import io
import math
import os
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program

RELATIVE = 1e-9
# lens, a variable, a field of it in deg, two wavelengths: what is shorter, what is longer
LENSES = (("double-gauss", "R1", 10, "F", "C"), ("cooke-triplet-50", "R1", 15, "F", "C"),
          ("brendel-tessar-100", "R1", 5, "F", "C"),
          ("canon-ef35-f2", "R1", 20, "F", "C"), ("edmund-achromat-120", "R1", 1, "F", "C"))
# rays, and what contrasts of wave fronts that are off by up to 4 wavelengths err by
CONTRASTS = (("36", 1e-3), ("210", 1e-6))
# the same of double-gauss at f/2: field in deg, lines in a mm, rays, error
STEEP = ((0, 20, "210", 1e-3), (0, 60, "210", 1e-3), (10, 20, "210", 1e-3),
         (14, 20, "300", 1e-3), (10, 60, "465", 1e-3), (14, 60, "528", 5e-3))
RADII, THICKNESS, INDEX, DIAMETER = (52.0, -97.0), 9.0, 1.6, 24.0


def first(program, *words):
    """The first row of a command."""
    return program.rows(*words)[0]


def values(program, lens, vary, goals, *more):
    """The values that the lens has, goal by goal; it is left before a minimum, which has a status."""
    result = program.run("optimize", lens, "--vary", vary, "--goals", ",".join(goals), "--show",
                         "merit", "--iterations", "1", "--csv", *more)
    rows = list(csv.DictReader(io.StringIO(result.stdout.decode(), newline="")))
    if len(rows) != len(goals):
        sys.exit(f"{lens}: {len(rows)} of {len(goals)} goals: {result.stderr.decode()}")
    return [float(row["value_before"]) for row in rows]


def figures(program, lens, field, short, long):
    """What the analyses have: by goal, with a deviation that lets no goal weigh much."""
    d = first(program, "lens", lens, "-w", "d")
    f = first(program, "lens", lens, "-w", short)
    seidel = program.rows("seidel", lens, "--field", str(field))[-1]
    color = program.rows("color", lens, "-w", f"{short},d,{long}", "--columns", "axial_color")
    bent = first(program, "distortion", lens, "--field", str(field))
    blue = first(program, "distortion", lens, "--field", str(field), "-w", short)
    red = first(program, "distortion", lens, "--field", str(field), "-w", long)
    height, at = float(bent["image_height_mm"]), f"@{field}deg"
    found = {f"efl={d['efl_mm']}": d["efl_mm"], f"efl@{short}={d['efl_mm']}": f["efl_mm"],
             "bfl=1": d["bfl_mm"], f"bfl@{short}<1": f["bfl_mm"], "ffl=1": d["ffl_mm"],
             "fnumber=1": d["fnumber"],
             f"petzval={d['petzval_radius_mm']}": d["petzval_radius_mm"],
             "axial": color[0]["axial_color_mm"],
             f"height{at}=1": height, f"distortion{at}": bent["distortion_percent"],
             f"lateral{at}": float(blue["image_height_mm"]) - float(red["image_height_mm"]),
             f"lateral@{short}{at}": float(blue["image_height_mm"]) - height}
    found.update({f"S{i}{at}": seidel[f"S{i}_mm" if f"S{i}_mm" in seidel else f"S{i}"]
                  for i in range(1, 6)})
    rays = program.rows("trace", lens, "--field", str(field), "--all", "--no-clip")
    chief = [row for row in rays if row["ray"] == "chief"]
    found[f"telecentric{at}"] = math.degrees(math.atan2(float(chief[-1]["cos_y_out"]),
                                                        float(chief[-1]["cos_z_out"])))
    angles = [float(row["incidence_deg"]) for row in rays
              if row["surface"] == "1" and row["ray"] in ("chief", "upper", "lower")]
    found[f"incidence 1{at}=1"] = max(angles)
    return found


def check_analyses(program, checks):
    """Goal by goal, the numbers of the analyses."""
    for lens, vary, field, short, long in LENSES:
        wanted = figures(program, lens, field, short, long)
        for goal, value in zip(wanted, values(program, lens, vary, list(wanted))):
            expected = float(wanted[goal])
            checks.near("analyses", f"{lens}: {goal}", value, expected,
                        RELATIVE * max(1, abs(expected)))


def check_spots(program, checks):
    """The squares of the spots add up to what their goal is the root of."""
    for lens, _, _, _, _ in LENSES:
        words = ("--rays", "36", "--no-clip")
        spots = [first(program, "spot", lens, "--field", str(field), "-w", line, *words)
                 for field in (0, 7) for line in ("d", "F")]
        total = math.sqrt(sum(float(row["rms_um"]) ** 2 for row in spots)) / 1000
        got = values(program, lens, "R1", ["spot"], "--field", "0,7", "-w", "d,F", "--rays", "36")[0]
        checks.near("spots", f"{lens}: spot", got, total, 1e-9)


def check_contrast(program, checks):
    """Both orientations, by waves and by rays, of wavelengths that count unlike: of the 36 usual
    rays, and of as many as make the error that of the analysis, which is told to be 1e-7."""
    for lens, vary, field, _, _ in LENSES:
        light = "d:1,F:0.5,C:0.7"
        goals, expected = [], []
        for frequency in (10, 40):
            for kind, method in (("mtf", "diffraction"), ("gmtf", "geometric")):
                row = first(program, "mtf", lens, "--spectrum", light, "-N", "5.6", "--field",
                            str(field), "--frequency", str(frequency), "--method", method,
                            "--no-clip", "--error", "1e-7")
                for way in ("tangential", "sagittal"):
                    goals.append(f"{kind}@{frequency}/mm@{field}deg {way} = 1")
                    expected.append(float(row[way]))
        for rays, tolerance in CONTRASTS:
            got = values(program, lens, vary, goals, "--rays", rays, "-w", light, "-N",
                         "5.6")
            for goal, value, wanted in zip(goals, got, expected):
                checks.near("contrast", f"{lens}: {goal}, {rays} rays", value, wanted, tolerance)


def check_steep(program, checks):
    """Wide open and off the axis, where the phase turns dozens of times: with many rays."""
    for field, frequency, rays, tolerance in STEEP:
        row = first(program, "mtf", "double-gauss", "-w", "d", "--field", str(field),
                    "--frequency", str(frequency), "--no-clip")
        ways = ("tangential", "sagittal")
        goals = [f"mtf@{frequency}/mm@{field}deg {way} = 1" for way in ways]
        got = values(program, "double-gauss", "R1", goals, "--rays", rays, "-w", "d")
        for goal, way, value in zip(goals, ways, got):
            checks.near("steep", f"double-gauss: {goal}, {rays} rays", value, float(row[way]),
                        tolerance)


def check_sections(program, checks, folder):
    """A cylinder: the figures of each section."""
    path = os.path.join(folder, "cylinder.lens")
    with open(path, "w", encoding="utf-8") as file:
        file.write("object inf\naperture epd 10\nfield angle 0 5\nsurface 50 5 1.5 20 cyl=x\n"
                   "surface -80 3 1.6 20\nsurface -300 60 air 20\nstop - 1 air 10\n")
    for section in ("x", "y"):
        words = ("--section", section)
        lens = first(program, "lens", path, *words)
        sums = program.rows("seidel", path, *words)[-1]
        wanted = {f"efl={lens['efl_mm']}": lens["efl_mm"], "bfl=1": lens["bfl_mm"],
                  "S1": sums["S1"], "S3": sums["S3"]}
        for goal, value in zip(wanted, values(program, path, "R2", list(wanted), *words)):
            expected = float(wanted[goal])
            checks.near("sections", f"section {section}: {goal}", value, expected,
                        RELATIVE * abs(expected))


def check_telecentric(program, checks, folder):
    """Whose exit pupil is its rear focal point, wherever a stop stands."""
    path = os.path.join(folder, "telecentric.lens")
    with open(path, "w", encoding="utf-8") as file:
        file.write("wavelength d F\nobject 80 telecentric\naperture na 0.05\nfield height 0 5\n"
                   "focus paraxial\nsurface 60 6 1.62/45 40\nsurface -80 40 air 40\n"
                   "surface 50 5 1.65 30\nsurface -70 100 air 30\n")
    words = ("--field", "3", "--no-clip")
    waves = first(program, "wavefront", path, "-w", "d", *words)
    row = first(program, "mtf", path, "--frequency", "4", "--error", "1e-7", *words)
    wanted = {"opd@3deg@d": waves["rms_waves"],
              "mtf@4/mm@3deg tangential = 1": row["tangential"],
              "mtf@4/mm@3deg sagittal = 1": row["sagittal"]}
    for goal, value in zip(wanted, values(program, path, "R1", list(wanted), "--rays", "210")):
        checks.near("telecentric", goal, value, float(wanted[goal]), 1e-6)


def sag(radius, height):
    """z of a sphere."""
    return height ** 2 / radius / (1 + math.sqrt(1 - (height / radius) ** 2))


def check_by_hand(program, checks, folder):
    """A thick lens of two spheres; its stop is the first, rays along the axis."""
    first_radius, second_radius = RADII
    path = os.path.join(folder, "thick.lens")
    with open(path, "w", encoding="utf-8") as file:
        file.write(f"wavelength d\nobject inf\naperture epd 20\nfield angle 0\n"
                   f"surface {first_radius} {THICKNESS} {INDEX} {DIAMETER} stop\n"
                   f"surface {second_radius} 80 air {DIAMETER + 2}\n")
    n, c, k = INDEX, 1 / first_radius, 1 / second_radius
    power = (n - 1) * (c - k + (n - 1) * THICKNESS * c * k / n)
    edge = (DIAMETER + 2) / 2
    # the ray at 10 mm: angles by its triangles
    inside = math.asin(10 / first_radius)
    bent = math.asin(10 / first_radius / n)
    slope = bent - inside
    x, y = sag(first_radius, 10), 10
    # from the centre of the second sphere, which lies at THICKNESS + second_radius
    distance = abs((THICKNESS + second_radius - x) * math.sin(slope) + y * math.cos(slope))
    wanted = {"efl=100": 1 / power, "length=1": THICKNESS,
              "bfl=100": (1 - (n - 1) * THICKNESS * c / n) / power,
              "center=1": THICKNESS,
              "edge=1": THICKNESS - sag(first_radius, edge) + sag(second_radius, edge),
              "petzval=-100": -1 / ((n - 1) / n * (c - k)),
              "incidence 1=1": math.degrees(inside),
              "incidence 2=1": math.degrees(math.asin(distance / abs(second_radius)))}
    for goal, value in zip(wanted, values(program, path, "R1", list(wanted))):
        checks.near("by hand", f"a thick lens: {goal}", value, wanted[goal],
                    1e-12 * abs(wanted[goal]))


def check_glass(program, checks, folder):
    """Weight and cost of an equiconvex lens, two spherical caps of 3 r^2 + h^2 and a cylinder, of a
    glass of 3.2 g/cm^3 and 2.5 times the price of a crown; prices that are not known."""
    catalog, path = (os.path.join(folder, name) for name in ("own.agf", "caps.lens"))
    with open(catalog, "w", encoding="utf-8") as file:
        for name, price in (("OWN", "2.5 1 1 1 1 1"), ("UNKNOWN", "-1.0 1 1"), ("DASH", "- - -")):
            file.write(f"NM {name} 1 0 1.6 50 0 0\nED 7 8 3.2 0\nCD 2.56 0 0 0 0 0\n"
                       f"OD {price}\nLD 0.3 2.5\n")
    with open(path, "w", encoding="utf-8") as file:
        file.write("wavelength 600nm\naperture epd 20\nsurface 40 9 OWN 24 stop\n"
                   "surface -40 50 air 24\n")
    height = sag(40, 12)
    caps = 2 * math.pi * height * (3 * 12 ** 2 + height ** 2) / 6
    grams = 3.2e-3 * (caps + math.pi * 12 ** 2 * (9 - 2 * height))
    wanted = {"weight=1": grams, "cost=1": 2.5 * grams, "aspect=2": 24 / 9, "ratio 1=3": 40 / 12,
              "sag 2=1": -height, "slope 1=1": math.degrees(math.asin(12 / 40))}
    for goal, value in zip(wanted, values(program, path, "R1", list(wanted), "--agf", catalog)):
        checks.near("glass", goal, value, wanted[goal], 1e-12 * abs(wanted[goal]))
    for name in ("UNKNOWN", "DASH"):
        with open(path, encoding="utf-8") as file:
            text = file.read().replace("OWN", name)
        result = program.run("optimize", "-", "--vary", "R1", "--goals", "cost<9", "--agf", catalog,
                             stdin=text)
        checks.check(result.returncode == 1 and b"price of " + name.encode() in result.stderr,
                     f"a price of {name}: {result.stderr.decode()}")
    result = program.run("optimize", "double-gauss", "--vary", "R1", "--goals", "weight<9")
    checks.check(result.returncode == 1 and b"density of 1.670/47.1" in result.stderr,
                 f"a model glass: {result.stderr.decode()}")


def main():
    """All of it."""
    program, checks = Program(sys.argv[1]), Checks()
    check_analyses(program, checks)
    check_spots(program, checks)
    check_contrast(program, checks)
    check_steep(program, checks)
    with tempfile.TemporaryDirectory() as folder:
        check_sections(program, checks, folder)
        check_telecentric(program, checks, folder)
        check_by_hand(program, checks, folder)
        check_glass(program, checks, folder)
    for kind, (share, where) in sorted(checks.worst.items()):
        print(f"{kind}: at worst {share:.2g} of what is allowed, {where}")
    checks.finish()


if __name__ == "__main__":
    main()
