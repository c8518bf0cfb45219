#!/usr/bin/env python3
"""tests/truth/check_sums.py - errors of waves, energies and light by field: check_sums.py BUILD

Strehl ratios and RMS wave fronts, about the chief ray and the best sphere, in focus and far out of
it; radii that hold a share of the light; light by field over that on the axis. The truth is what
clear_sums.c finds, which traces, finds spheres and sums by other means than lenscalc, as densely as
phases want. No true error may be larger than the printed one. A few
fields of a few lenses, or all of those that are named behind BUILD through focus, as far as
clear_sums.c takes them (make survey does all of lensdb); -v says what was left out.
"""
# SPDX-License-Identifier: MIT

import csv
import io
import json
import os
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import EVERYTHING, Checks, Program
from outside import Lens, Outside

# f-numbers of lenses that state no aperture
UNSTATED = {"aspheric-singlet": 4, "erfle-eyepiece": 4, "micro60x-na09": 4, "phone-6p": 2.4}
# of each lens a field to ask, and how far out of focus, mm
QUICK = {"laikin75-petzval": (("7", "0"),), "double-gauss": (("14", "0"),),
         "cooke-triplet-50": (("0", "0.1"),)}
QUICK_ENERGY = {"cooke-triplet-50": ("20",), "reverse-telephoto-2": ("0",)}
QUICK_FIELD = {"double-gauss": (3,), "fisheye-16": (5,)}
if EVERYTHING:  # corners of its edges take clear_sums 5 s
    QUICK_FIELD["merte-biotar-14-100"] = (4,)
DEFOCUS = (0.1, 0.5)  # mm
MOST_WAVES = 150  # from lowest to highest, which clear_sums.c follows within a minute
KNOWN = 1e-9  # rounding of paths over wavelengths; areas are differences, to 1e-8
SHARES, QUICK_SHARES = "50%,80%,95%", "80%"
worst = {}
skipped = []


def rows_of(program, *words):
    result = program.run(*words, "--csv")
    return list(csv.DictReader(io.StringIO(result.stdout.decode(), newline="")))


def asked(lens):
    return [lens, "-N", str(UNSTATED[lens])] if lens in UNSTATED else [lens]


def compare(checks, name, kind, value, error, true, doubt):
    off = abs(value - true)
    ratio = off / (error + doubt)
    worst[kind] = max(worst.get(kind, (0, "")), (ratio, name))
    unit = "waves" if kind.startswith("RMS") else ""
    checks.against("sums", name, kind, value, true, error + doubt, unit)


class Open:
    """A lens, where its image and its exit pupil are from its last vertex."""

    def __init__(self, program, lens):
        self.lens = lens
        result = program.run("spot", *asked(lens), "--json", "--columns", "rms").stdout
        self.image = json.loads(result)["assumptions"].get("image_mm") if result else None
        self.refused = "no image" if self.image is None else ""
        if not self.refused:
            rows = rows_of(program, "lens", *asked(lens))
            self.pupil = float(rows[0]["exit_pupil_mm"] or "inf") if rows else float("inf")
            self.prescription = Lens(program, lens, "", self.image, UNSTATED.get(lens))
            self.refused = self.prescription.refused

    def at(self, defocus):
        self.prescription.image = self.image + defocus
        return [*asked(self.lens), "--focus", repr(self.image + defocus)]


def check_waves(checks, program, outside, one, field, defocus):
    """field: None for all of the lens."""
    words = one.at(defocus) + (["--field", field] if field else [])
    for about, best in (("chief", 0), ("best", 1)):
        rows = rows_of(program, "wavefront", *words, "--reference", about, "--columns",
                       "field,wavelength,rms_waves,error_waves,pv_waves,strehl,strehl_error")
        rows = [row for row in rows if row["field_deg"]]  # heights are not asked for
        steep = [row for row in rows if row["rms_waves"] and float(row["pv_waves"]) > MOST_WAVES]
        skipped.extend(f"wavefront {' '.join(words)} {row['field_deg']} deg, {about}: too steep"
                       for row in steep)
        rows = [row for row in rows if row["rms_waves"] and row not in steep]
        pupil = one.prescription.last + one.pupil
        questions = [f"wave 1e-7 {row['field_deg']} {float(row['wavelength_nm']) * 1e-6!r} "
                     f"{pupil!r} {best}" for row in rows]
        for row, truth in zip(rows, outside.ask(one.prescription, questions, 0)):
            name = f"wavefront {' '.join(words)} {row['field_deg']} deg, {about}"
            if truth is None:
                skipped.append(name)
                continue
            # a share of what is clear that is off moves what both are means over
            doubt = KNOWN + (1e-8 + truth[2]) * truth[0]
            compare(checks, name, "RMS " + about, float(row["rms_waves"]),
                    float(row["error_waves"]), truth[0], doubt)
            compare(checks, name, "Strehl " + about, float(row["strehl"]),
                    float(row["strehl_error"]), truth[1],
                    KNOWN + 4 * truth[2] + 1e-8 * truth[1])


def check_energy(checks, program, outside, one, fields, defocus, shares=SHARES):
    words = one.at(defocus)
    for field in fields:
        rows = rows_of(program, "spot", *words, "--field", field, "--energy",
                       shares, "--columns",
                       "energy,energy_radius,energy_error")
        rows = [row for row in rows if row["energy_radius_um"]]
        radii = [(float(row["energy_radius_um"]), float(row["energy_error_um"])) for row in rows]
        ends = [end / 1000 for radius, error in radii for end in (radius - error, radius + error)]
        answer = outside.ask(one.prescription, [f"energy 1e-5 {field} {len(ends)} "
                                                f"{' '.join(map(repr, ends))}"],
                             None)[0] if rows else None
        for i, row in enumerate(rows if answer is not None else []):
            (radius, error), (low, high), doubt = radii[i], answer[2 * i:2 * i + 2], answer[-1]
            share = float(row["energy_percent"]) / 100
            name = f"spot {' '.join(words)} {field} deg, {row['energy_percent']} %"
            checks.check(low - KNOWN - 2 * doubt <= share <= high + KNOWN + 2 * doubt,
                         f"{name}: within {radius} +- {error} um, by other means {low} .. {high} "
                         f"+- {doubt:.2g} of the light")
            off = abs(2 * share - low - high) / max(high - low, 1e-12)
            worst["energy"] = max(worst.get("energy", (0, "")), (off, name))


def check_light(checks, program, outside, one, places):
    words = one.at(0)
    rows = rows_of(program, "illumination", *words, "--columns",
                   "field,relative_field,relative_field_error")
    rows = [row for i, row in enumerate(rows)
            if (places is None or i in places) and row["relative_field"] and row["field_deg"]]
    if not rows:
        return
    # where rays graze edges in a maze of corners it takes long to know more than is of use
    errors = [float(row["relative_field_error"]) / (float(row["relative_field"]) or 1)
              for row in rows]
    answers = outside.ask(one.prescription, ["field 1e-10 0"] + [
        f"field {min(max(1e-10, error / 20), 1e-2)!r} {row['field_deg']}"
        for row, error in zip(rows, errors)], 0)
    axis = answers[0]
    for row, truth in zip(rows, answers[1:]):
        name = f"illumination {' '.join(words)} {row['field_deg']} deg"
        value = float(row["relative_field"])
        if axis is None or truth is None:
            checks.check(not value > 0, f"{name}: light by field {value}, by other means none")
            continue
        true = truth[0] / axis[0]
        compare(checks, name, "light by field", value, float(row["relative_field_error"]), true,
                (KNOWN + truth[1] + axis[1]) * true)


def fields_of(program, lens):
    return [row["field_deg"] for row in rows_of(program, "spot", *asked(lens), "--columns", "field")
            if row["field_deg"]]


def check_lens(checks, program, outside, one):
    """All fields in focus, the last out of it."""
    fields = fields_of(program, one.lens)
    check_waves(checks, program, outside, one, None, 0)
    check_energy(checks, program, outside, one, fields, 0)
    for defocus in DEFOCUS if fields else ():
        check_waves(checks, program, outside, one, fields[-1], defocus)
    check_energy(checks, program, outside, one, fields[-1:], DEFOCUS[0], QUICK_SHARES)
    check_light(checks, program, outside, one, None)


def check_few(checks, program, outside):
    for lens, cases in QUICK.items():
        one = Open(program, lens)
        for field, defocus in cases:
            check_waves(checks, program, outside, one, field, float(defocus))
    for lens, fields in QUICK_ENERGY.items():
        check_energy(checks, program, outside, Open(program, lens), fields, 0, QUICK_SHARES)
    for lens, places in QUICK_FIELD.items():
        check_light(checks, program, outside, Open(program, lens), places)


def main():
    checks, program = Checks(), Program(sys.argv[1])
    outside = Outside(program)
    named = [word for word in sys.argv[2:] if word != "-v"]
    for lens in named:
        one = Open(program, lens)
        if one.refused:
            skipped.append(f"{lens} ({one.refused})")
        else:
            check_lens(checks, program, outside, one)
    if not named:
        check_few(checks, program, outside)
    if "-v" in sys.argv:
        for kind, (ratio, name) in worst.items():
            print(f"{kind}: at most {ratio:.3g} of what is printed: {name}")
        print(f"left out: {', '.join(skipped) or 'none'}")
    checks.finish()


if __name__ == "__main__":
    main()
