#!/usr/bin/env python3
"""tests/truth/check_errors.py - errors as they are printed against true ones: check_errors.py BUILD

The truth is what clear_sums.c finds, which traces and sums by other means than lenscalc: an error
that is printed must not be less than the true one, nor more than a hundred times it; light beyond a
gap is as much as is said. Largest radii: closed forms, and plain patterns that never come farther.
A few rows of a few lenses, or all rows of those that are named behind BUILD, as far as clear_sums.c
takes them (make survey does all of lensdb); -v says what it left out.
"""
# SPDX-License-Identifier: MIT

import csv
import io
import json
import math
import os
import re
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program
from outside import Lens, Outside

# of each lens a field to spot, and which of the eleven heights of `illumination`
QUICK = {"double-gauss": (2, (1, 3, 10)), "questar-35": (2, (5,)), "fisheye-16": (1, (10,)),
         "phone-80deg": (1, (9,)), "asahi-takumar-100": (0, ()), "schneider-anamorphic-31": (0, ())}
LENSES = ("double-gauss", "fisheye-16", "laikin45-achromat", "mld65-gauss-telescope-100",
          "nikkor-z-58-f095", "phone-80deg", "questar-35")
# f-numbers of lenses that state no aperture
UNSTATED = {"aspheric-singlet": 4, "erfle-eyepiece": 4, "micro60x-na09": 4, "phone-6p": 2.4}
RMS = ("rms", "rms_x", "rms_y", "rms_chief")
MOST = 100  # times the true error
KNOWN = 1e-11  # to what share of itself a truth is known at best
ROUNDING = 1e-8  # um
MIRROR = ("lens paraboloid\nwavelength d\nobject inf\naperture stop\n"
          "surface -200 -100 mirror 80 k=-1 stop\n")
worst = {"spot": (0, ""), "illumination": (0, "")}
skipped = []


def rows_of(program, *words, stdin=b""):
    result = program.run(*words, "--csv", stdin=stdin)
    return list(csv.DictReader(io.StringIO(result.stdout.decode(), newline="")))


def compare(checks, name, kind, error, true, doubt):
    """doubt: what the truth itself may be off."""
    checks.check(error >= true - doubt, f"{name}: off by {true:.3g}, the error printed is {error:.3g}")
    if max(true, doubt) > 0:
        ratio = error / max(true, doubt)
        worst[kind] = max(worst[kind], (ratio, name))
        checks.check(ratio <= MOST, f"{name}: the error printed is {ratio:.0f} times the true one")


def pick(rows, places):
    return [row for i, row in enumerate(rows) if places is None or i in places]


def asked(lens):
    return [lens, "-N", str(UNSTATED[lens])] if lens in UNSTATED else [lens]


def image_of(program, lens):
    """Where its image plane is, to be asked for by number; None: infinitely far."""
    result = program.run("spot", *asked(lens), "--json", "--columns", "rms").stdout
    return json.loads(result)["assumptions"].get("image_mm") if result else None


def check_spot(checks, program, outside, prescription, words, field):
    rows = pick(rows_of(program, "spot", *words, "--columns", "field,rms,rms_x,rms_y,rms_chief,"
                        "error_um"), field)
    rows = [row for row in rows if row["field_deg"]]  # heights are not asked for by other means
    answers = outside.ask(prescription, [f"spot 1e-12 {row['field_deg']}" for row in rows])
    for row, truth in zip(rows, answers):
        name = f"spot {words[0]} {row['field_deg']}"
        if not row["rms_um"] or truth is None:
            checks.check(not row["rms_um"] and truth is None,
                         f"{name}: {row['rms_um'] or 'no'} light, by other means {truth}")
            continue
        true = max(abs(float(row[one + "_um"]) - 1000 * value) for one, value in zip(RMS, truth)
                   if row[one + "_um"])
        compare(checks, name, "spot", float(row["error_um"]), true,
                (KNOWN + truth[4]) * float(row["rms_um"]) + ROUNDING)


def check_illumination(checks, program, outside, prescription, words, places):
    rows = pick(rows_of(program, "illumination", *words, "--columns",
                        "height,irradiance_per_radiance,irradiance_error,warning"), places)
    answers = outside.ask(prescription, [f"film 1e-12 {row['height_mm']}" for row in rows], 0)
    for row, truth in zip(rows, answers):
        name = f"illumination {words[0]} {row['height_mm']}"
        value = float(row["irradiance_per_radiance"] or "nan")
        if truth is None or not value > 0:
            checks.check(truth is None and value == 0,
                         f"{name}: {value}, by other means {truth}")
            continue
        named = re.search(r"beyond a gap too, about ([0-9.]+) %", row["warning"])
        if not named:
            compare(checks, name, "illumination", float(row["irradiance_error"]),
                    abs(value - truth[0]), (KNOWN + truth[1]) * truth[0])
        if "--no-clip" in words:
            continue  # nobody looks for gaps
        share = 1 - value * (1 - truth[2]) / truth[0]
        percent = float(named.group(1)) if named else 0
        # areas of the beam against light: less comes in the same area from farther off; what is far
        # outside of the pupil, of a lens without apertures, is not looked for
        low, high = (70 * share - 0.6, 400 * share + 2) if named else (100 * share - 2, 0)
        checks.check(low <= percent <= max(high, 0),
                     f"{name}: {percent} % beyond a gap, by other means {100 * share:.3g} %")


def check_sums(checks, program, outside, lens, places):
    image = image_of(program, lens)
    prescription = Lens(program, lens, "", image, UNSTATED.get(lens)) if image is not None else None
    if prescription is None or prescription.refused:
        skipped.append(f"{lens} ({prescription.refused if prescription else 'no image'})")
        return
    words = [*asked(lens), "--focus", repr(image)]
    field, heights = ((places[0],), places[1]) if places else (None, None)
    check_spot(checks, program, outside, prescription, words, field)
    check_illumination(checks, program, outside, prescription, words, heights)


def check_gap(checks, program, outside):
    """Beside this pupil, a seventh of it away, lies a crescent as thin as a hair."""
    lens = "phone-80deg"
    image = image_of(program, lens)
    prescription = Lens(program, lens, "", image)
    prescription.open()
    check_illumination(checks, program, outside, prescription,
                       [lens, "--focus", repr(image), "--no-clip", "--height", "3.61"], None)


def check_plain(checks, program, lens):
    """One wavelength, about the chief ray, so that the samples' centroids do not matter."""
    words = ["spot", lens, "-w", "d", "--reference", "chief", "--columns",
             "field,radius,radius_error,warning"]
    plain = rows_of(program, *words, "--pattern", "hexapolar", "--rays", "3000")
    for row, sample in zip(rows_of(program, *words), plain):
        if not row["radius_um"] or not sample["radius_um"] or "gap" in row["warning"]:
            continue  # plain patterns have rays beyond gaps too
        largest, least = float(row["radius_um"]), float(sample["radius_um"])
        name = f"spot {lens} {row['field_deg']}"
        checks.check(least <= largest + float(row["radius_error_um"]),
                     f"{name}: radius {largest}, but a ray of a plain pattern is at {least}")


def turned(program, command, lens, field, *words):
    """The same field in other directions, of a lens that is round."""
    tangent, rows = math.tan(math.radians(field)), []
    for turn in 90, 63, 45, 37, 22, 0:
        angles = [math.degrees(math.atan(tangent * of(math.radians(turn))))
                  for of in (math.sin, math.cos)]
        rows += rows_of(program, command, lens, "-w", "d", "--field", repr(angles[0]), "--field-x",
                        repr(angles[1]), *words)
    return rows


def check_turned_spot(checks, program, lens, field):
    """Spots turn with their fields."""
    rows = turned(program, "spot", lens, field, "--columns", "radius,radius_error")
    low, high = (choose(rows, key=lambda row: float(row["radius_um"])) for choose in (min, max))
    between = float(high["radius_um"]) - float(low["radius_um"])
    errors = float(high["radius_error_um"]) + float(low["radius_error_um"])
    checks.check(between <= errors <= 1e-4 * float(low["radius_um"]),
                 f"spot {lens} {field}: radii of {low['radius_um']} to {high['radius_um']} as the "
                 f"field turns, with errors of {errors} together")


def check_turned_wave(checks, program, lens, field):
    """Wave fronts turn, too."""
    rows = turned(program, "wavefront", lens, field, "--defocus", "0.1", "--columns", "pv_waves")
    waves = [float(row["pv_waves"]) for row in rows]
    checks.check(max(waves) - min(waves) <= 1e-6 * min(waves),
                 f"wavefront {lens} {field}: from {min(waves)} to {max(waves)} waves as the field "
                 "turns")


def check_mirror(checks, program):
    """Behind the focus of a paraboloid the ray of the height h runs at tan t = 2u/(1 - u^2), u =
    h/2f; the mirror is 80 mm wide, f = 100."""
    row = rows_of(program, "spot", "-", "--defocus", "1", "--columns", "radius,radius_error",
                  stdin=MIRROR)[0]
    expected = 1000 * (2 * 0.2 / (1 - 0.2 ** 2))
    checks.check(math.isclose(float(row["radius_um"]), expected, rel_tol=1e-9),
                 f"radius behind a paraboloid's focus: {row['radius_um']}, expected {expected}")
    # equal areas: a share s of the light lies within the height 40 sqrt(s) of the mirror
    for row in rows_of(program, "spot", "-", "--defocus", "1", "--energy", "20%,50%,80%,99%",
                       "--columns", "energy,energy_radius,energy_error", stdin=MIRROR):
        u = 40 * math.sqrt(float(row["energy_percent"]) / 100) / 200
        expected = 1000 * 2 * u / (1 - u * u)
        off, error = abs(float(row["energy_radius_um"]) - expected), float(row["energy_error_um"])
        checks.check(off <= error <= 1e-3 * expected,
                     f"{row['energy_percent']} % behind a paraboloid's focus: "
                     f"{row['energy_radius_um']} +- {error}, expected {expected}")


def check_grazing(checks, program):
    """From glass onto a sphere: rays up to the height R/n leave it, the last along its tangent."""
    radius, index, plane = 15, 1.5, 30
    text = ("lens ball\nwavelength d\nobject inf\naperture stop\n"
            f"surface - 20 {index}/60 24 stop\nsurface {-radius} {plane} air -\n")
    row = rows_of(program, "spot", "-", "--focus", str(plane), "--columns", "radius,radius_error",
                  stdin=text.encode())[0]
    height = radius / index
    across = math.sqrt(radius ** 2 - height ** 2)
    expected = 1000 * abs(height - (plane + radius - across) * across / height)
    off, error = abs(float(row["radius_um"]) - expected), float(row["radius_error_um"])
    checks.check(off <= error <= 1e-4 * expected and off <= 1e-7 * expected,
                 f"radius of rays that graze: {row['radius_um']} +- {error}, expected {expected}")


def check_energy(checks, program, lens):
    """Against a plain pattern of many rays, which is right to about 1e-3."""
    words = ["spot", lens, "--energy", "80%", "--columns",
             "field,energy,energy_radius,energy_error"]
    plain = rows_of(program, *words, "--pattern", "sobol", "--rays", "20000")
    for row, sample in zip(rows_of(program, *words), plain):
        if row["energy_radius_um"] and sample["energy_radius_um"]:
            here, there = float(row["energy_radius_um"]), float(sample["energy_radius_um"])
            checks.check(abs(here - there) <= float(row["energy_error_um"]) + 2e-3 * here,
                         f"spot {lens} {row['field_deg']}: {row['energy_percent']} % within {here}"
                         f" +- {row['energy_error_um']}, of a plain pattern within {there}")


def main():
    checks, program = Checks(), Program(sys.argv[1])
    outside = Outside(program)
    named = [word for word in sys.argv[2:] if word != "-v"]
    for lens in named or QUICK:
        check_sums(checks, program, outside, lens, None if named else QUICK[lens])
    for lens in named or LENSES:
        check_plain(checks, program, lens)
        if lens == "phone-80deg" and not named:
            check_energy(checks, program, lens)
    if not named:
        check_mirror(checks, program)
        check_grazing(checks, program)
        for lens, field in ("wide-35", 4.56), ("laikin75-petzval", 4.48), ("cs348b-fisheye-10", 2.59):
            check_turned_spot(checks, program, lens, field)
        for lens, field in ("fisheye-16", 14.3), ("canon-rf50-f18", 12.8):
            check_turned_wave(checks, program, lens, field)
        check_gap(checks, program, outside)
    if "-v" in sys.argv:
        print(worst, "printed / true")
        print("left out:", *skipped, sep="\n  ")
    checks.finish()


if __name__ == "__main__":
    main()
