#!/usr/bin/env python3
"""tests/truth/check_render.py - the rays of lenscalc render: check_render.py BUILD_DIR

Turned round and traced forwards each comes back to its point of the film. Their weights add up to
the mean irradiance of a film, for the double Gauss of the course as an independent quadrature and
another renderer have it.
"""
# SPDX-License-Identifier: MIT

import csv
import io
import os
import subprocess
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program

LENSES = ("cs348b-dgauss-50", "nikkor-z-58-f095", "fisheye-16", "questar-35", "phone-80deg",
          "human-eye-artal", "nikkor-z-14-24")
MEAN = 0.110853  # of the course's double Gauss, 36 x 24 mm, film at 36.3612 mm; three others within
MEAN_ERROR = 6e-5


def table(program, *words, text=None):
    result = subprocess.run(program.command + list(words), input=text, text=True,
                            capture_output=True, env=program.environment())
    return list(csv.DictReader(io.StringIO(result.stdout))), result.stderr


def check_back(checks, program, name):
    """Through the lens again, the other way."""
    rays, said = table(program, "render", "--lens", name, "--rays", "-", "--samples", "300", "-w", "d")
    if not checks.check(len(rays) > 200, f"{name}: {len(rays)} rays of 300: {said}"):
        return
    starts = "x_mm,y_mm,z_mm,cos_x,cos_y,cos_z\n" + "".join(
        ",".join([ray["x_mm"], ray["y_mm"], ray["z_mm"]] +
                 [repr(-float(ray[cosine])) for cosine in ("cos_x", "cos_y", "cos_z")]) + "\n"
        for ray in rays)
    ends, said = table(program, "trace", name, "-w", "d", "--to", "image", "--batch", "-", "--csv",
                       text=starts)
    if not checks.check(len(ends) == len(rays), f"{name}: {said}"):
        return
    for ray, end in zip(rays, ends):
        miss = max(abs(float(end[f"{axis}_out_mm"] or "inf") - float(ray[f"film_{axis}_mm"]))
                   for axis in "xy")
        checks.check(miss < 1e-8, f"{name}: a ray comes back {miss} mm from where it left the film")


def check_mean(checks, program):
    rays, _ = table(program, "render", "--lens", "cs348b-dgauss-50", "--rays", "-", "--samples", "262144",
                    "-w", "d", "--focus", "36.3612")
    mean = sum(float(ray["weight"]) for ray in rays)
    checks.check(abs(mean - MEAN) < MEAN_ERROR, f"mean E/L is {mean}, expected {MEAN}")


def main():
    program, checks = Program(sys.argv[1]), Checks()
    for name in LENSES:
        check_back(checks, program, name)
    check_mean(checks, program)
    return checks.finish()


if __name__ == "__main__":
    sys.exit(main())
