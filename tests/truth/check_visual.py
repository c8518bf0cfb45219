#!/usr/bin/env python3
"""tests/truth/check_visual.py - instruments for the eye: check_visual.py BUILD_DIR

Worked examples of makers and of pages on telescopes, binoculars and microscopes, as they print
them, and the eye relief of a real eyepiece by a paraxial ray of its own, through the prescription
that is written down here, from the telescope's side.
"""
# SPDX-License-Identifier: MIT

import json
import os
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program

# question, column, as printed there, half a unit of its last digit (one where it is cut), where
EXAMPLES = (
    ("visual 8x42 8.8deg", "apparent_field_deg", 63.2, 0.05, "imaging.nikon.com: ISO 14132-1"),
    ("visual 8x42 7.0deg", "field_width_m", 122, 0.5, "Nikon: 2 x 1000 m tan 3.5 deg"),
    ("visual 10x30 5deg", "apparent_field_ratio_deg", 50, 1e-9, "Canon 10x30 IS: 10 x 5 deg"),
    ("visual 10x50", "twilight_factor", 22.36, 0.005, "heritagedestination.com"),
    ("visual 30x80", "twilight_factor", 48.98, 0.01, "heritagedestination.com"),
    ("visual 8x56", "twilight_factor", 21.16, 0.01, "thegunzone.com"),
    ("visual 8x42", "relative_brightness", 27.6, 0.05, "backcountrychronicles.com"),
    ("visual 10x42", "relative_brightness", 17.6, 0.05, "backcountrychronicles.com"),
    ("visual 10x32", "exit_pupil_mm", 3.2, 1e-9, "backcountrychronicles.com"),
    ("microscope --na 0.14 --pitch 1e-9 -m 1", "depth_camera_um", 28.1, 0.05,
     "photomacrography.net: lambda/NA^2"),
    ("microscope 50x/0.55 --pitch 1e-9", "depth_camera_um", 1.82, 0.005,
     "photomacrography.net: lambda/NA^2"),
    ("microscope 4x/0.1 --pitch 14um", "depth_camera_um", 90, 1e-9,
     "microscopyu.com: lambda n/NA^2 + n e/(M NA)"),
    ("microscope 40x/0.65 --eyepiece 10x/22", "field_mm", 0.55, 1e-9, "definition: FN/M"),
    ("fov -f 1000 --pitch 3.76um", "pixel_scale_arcsec", 206.265 * 3.76 / 1000, 1e-6,
     "206.265 p/f"),
    ("fov --pixel-scale 1arcsec --pitch 3.76um", "focal_mm", 206.265 * 3.76, 1e-3, "206.265 p/f"),
    ("fov -f 1000 --subject jupiter", "subject_angle_arcmin", 2 * 98.44 / 4.202603 / 60, 0.1 / 60,
     "Meeus, semidiameter 98.44 arcsec at 1 au"),
)

# Erfle's eyepiece, US 1,479,229, from the eye; its stop lies 15.224 mm before the glass
RADII = (269, -125.9, 93.6, -93.6, 2550, 93.6, -93.6, 2550)
GAPS = (25.1, 36.5, 18.5, 4.1, 0.19, 18.5, 4.1)
MEDIA = (1, 1.51633, 1, 1.53996, 1.620053, 1, 1.53996, 1.620053, 1)


def eyepiece_trace(height, slope):
    """A paraxial ray from the telescope's side: height and slope behind the last surface."""
    radii, gaps, media = [-r for r in RADII[::-1]], GAPS[::-1], MEDIA[::-1]
    bent = slope * media[0]
    for i, radius in enumerate(radii):
        bent -= height * (media[i + 1] - media[i]) / radius
        if i < len(gaps):
            height += gaps[i] * bent / media[i + 1]
    return height, bent


def eye_relief(telescope):
    (y1, u1), (y2, u2) = eyepiece_trace(1, 0), eyepiece_trace(0, 1)
    distance = telescope - u2 / u1  # of the aperture from the first vertex; its focus at -u2/u1
    return -(distance * y1 + y2) / (distance * u1 + u2)


def main():
    checks, program = Checks(), Program(sys.argv[1])

    def answer(question, column):
        found = program.run(*question.split(), "--json", "--columns", column)
        return json.loads(found.stdout)["rows"][0][column]

    for question, column, printed, allowed, where in EXAMPLES:
        checks.against("instruments", f"{question} ({where})", column, answer(question, column),
                       printed, allowed)
    for telescope in (400, 1000, 2500):
        question = f"visual -f {telescope} --diameter 40 --lens erfle-eyepiece"
        checks.against("instruments", question, "eye_relief_mm", answer(question, "eye_relief_mm"),
                       eye_relief(telescope), 1e-4, "mm")
    checks.finish()


main()
