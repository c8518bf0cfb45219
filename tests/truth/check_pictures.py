#!/usr/bin/env python3
"""tests/truth/check_pictures.py - every kind of drawing as a picture: check_pictures.py BUILD_DIR

Rendered by librsvg and read as pixels: there is ink, not too little and not a page full of it, and
a white margin all round, so that nothing is cut at the page's border. Lenses: a choice of every
kind of drawing; with LENSCALC_ALL set all of lensdb,
and all analyses of six lenses. The demo's pictures too, if they are there.
Without rsvg-convert nothing is checked, and that is said.
"""
# SPDX-License-Identifier: MIT

import glob
import os
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import pictures
from harness import NEED_SOLVER, ROOT, Checks

WIDTH = 300       # px: what touches the border of the page does so at any size
INK = 200         # darker pixels are ink: hairlines count, the tints of glass do not
LEAST, MOST = 0.002, 0.5  # share of the page that is ink: nine dark maps are 0.452
# `draw` with these words
DRAWINGS = ("double-gauss", "double-gauss --planes", "double-gauss --construction",
            "double-gauss --no-rays", "fisheye-16", "canon-nfd-70-210 --position tele",
            "questar-35", "phone-80deg", "schneider-anamorphic-31 --section x")
# other commands that draw, {} is the file
OTHERS = ("dof -f 50mm -N 5.6 -s 3m --scale {}", "dof -f 50mm -N 2.8,5.6,11 -s 0.5..20#50 --plot {}",
          "tilt -f 150 -N 22 --hinge 1.6m --angle 90deg --sensor 4x5 --wedge {}",
          "glass --abbe {} --catalog SCHOTT", "lens double-gauss -w 400..700#31 --plot {}",
          "conjugate double-gauss --object 0.5m..3m:0.1m --plot {}",
          "seidel double-gauss --plot {}", "fan double-gauss --plot {}",
          "spot double-gauss --defocus -0.1..0.1#3 --plot {}", "field double-gauss --plot {}",
          "distortion double-gauss -w d,F,C --plot {}", "distortion double-gauss --grid {}",
          "color double-gauss --plot {}", "illumination double-gauss --plot {}",
          "wavefront double-gauss -N 5.6 --plot {}", "mtf double-gauss -N 8 --plot {}",
          "psf questar-35 --size 64 --plot {}", "psf edmund-49-847 -N 22 --size 64 --plot {}",
          "bench double-gauss --degree 3 --rays 12 --plot {}", "report fisheye-16 -o {}")
# the analyses of other lenses: a fisheye, a zoom, of a phone, an obstructed mirror, with one field
MORE = ("bench fisheye-16 --quantity spot --plot {}", "bench phone-80deg --plot {}",
        "bench double-gauss --quantity photograph --plot {}", "field fisheye-16 --plot {}",
        "field canon-nfd-70-210 --position all --plot {}", "field phone-80deg --plot {}",
        "field questar-35 --plot {}", "field edmund-49-847 --plot {}",
        "illumination fisheye-16 --plot {}",
        "illumination canon-nfd-70-210 --position all --plot {}",
        "illumination phone-80deg --plot {}", "illumination questar-35 --plot {}",
        "illumination edmund-49-847 --plot {}",
        "fan fisheye-16 --field 0,50deg --plot {}",
        "fan canon-nfd-70-210 --position all --plot {}", "fan phone-80deg --show opd --plot {}",
        "fan questar-35 --plot {}", "fan edmund-49-847 --show opd --plot {}",
        "spot fisheye-16 --field 0,50deg --plot {}",
        "spot canon-nfd-70-210 --position all --plot {}", "spot phone-80deg --plot {}",
        "spot questar-35 --defocus -0.1,0,0.1 --plot {}", "spot edmund-49-847 --plot {}",
        "spot double-gauss -w d --field 0,14 --defocus -0.1..0.1#11 --plot {}",
        "seidel fisheye-16 --plot {}", "seidel canon-nfd-70-210 --position tele --plot {}",
        "seidel phone-80deg --plot {}", "seidel questar-35 --plot {}",
        "seidel edmund-49-847 --plot {}",
        "color fisheye-16 --spectrum F,d,C --plot {}",
        "color canon-nfd-70-210 --position tele --plot {}", "color phone-80deg --plot {}",
        "color questar-35 --plot {}", "color edmund-49-847 --spectrum F,d,C --plot {}",
        "distortion fisheye-16 --projection equidistant --calibrated --plot {}",
        "distortion fisheye-16 --projection equisolid --grid {}",
        "distortion canon-nfd-70-210 --position all --plot {}",
        "distortion canon-nfd-70-210 --position tele --field 5 --grid {}",
        "distortion phone-80deg --plot {}", "distortion phone-80deg --grid {}",
        "distortion questar-35 --defocus 0,1 --plot {}", "distortion questar-35 --grid {}",
        "distortion edmund-49-847 --field 10 --plot {}", "distortion edmund-49-847 --grid {}",
        "distortion double-gauss --object 1500 --height 20 --plot {}",
        "wavefront fisheye-16 --field 0,50deg --plot {}",
        "wavefront canon-nfd-70-210 --position all --plot {}", "wavefront phone-80deg --plot {}",
        "wavefront questar-35 --plot {}", "wavefront edmund-49-847 --plot {}",
        "mtf double-gauss -N 8 --field 0,14 --frequency 30 --defocus -0.1..0.1#11 --plot {}",
        "mtf double-gauss -N 8 --field 0..14#5 --frequency 30 --plot {}",
        "mtf fisheye-16 --field 0,50deg --plot {}",
        "mtf canon-nfd-70-210 --position all --plot {}", "mtf phone-80deg --plot {}",
        "mtf questar-35 --plot {}", "mtf edmund-49-847 -N 8 --plot {}",
        "psf double-gauss --plot {}", "psf double-gauss -N 8 --log --plot {}",
        "psf fisheye-16 --field 0,50deg --plot {}",
        "psf canon-nfd-70-210 --position all --plot {}", "psf phone-80deg --plot {}",
        "psf edmund-49-847 -N 8 --plot {}",
        "report double-gauss -o {}", "report canon-nfd-70-210 -o {}",
        "report phone-80deg -o {}", "report questar-35 -o {}", "report edmund-49-847 -o {}")


def check_picture(checks, name, svg):
    lines = pictures.read(pictures.render(svg, WIDTH))
    high, wide = len(lines), len(lines[0])
    ink = sum(pixel < INK for line in lines for pixel in line) / (high * wide)
    checks.check(LEAST < ink < MOST, f"{name}: {100 * ink:.2f} % of the page is ink")
    border = [lines[0], lines[-1], bytes(line[0] for line in lines),
              bytes(line[-1] for line in lines)]
    sides = [side for side, edge in zip(("top", "bottom", "left", "right"), border)
             if min(edge) < 250]
    checks.check(not sides, f"{name}: drawn up to the border: {' '.join(sides)}")


def check_draw(checks, program, words):
    answer = subprocess.run([program, "draw", *words], capture_output=True, text=True)
    if answer.returncode == 1 and "has no diameter, and no ray" in answer.stderr:
        answer = subprocess.run([program, "draw", *words, "-N", "8"], capture_output=True,
                                text=True)
    if checks.check(answer.returncode == 0, f"draw {' '.join(words)}: {answer.stderr}"):
        check_picture(checks, f"draw {' '.join(words)}", answer.stdout)


def check_others(checks, program, lines):
    with tempfile.TemporaryDirectory(prefix="lenscalc-pictures-") as folder:
        path = os.path.join(folder, "x.svg")
        for line in lines:
            if line.startswith(NEED_SOLVER) and not os.path.exists(program + "-ceres"):
                continue
            words = [word.replace("{}", path) for word in line.split()]
            answer = subprocess.run([program, *words], capture_output=True, text=True)
            if checks.check(answer.returncode == 0, f"{line}: {answer.stderr}"):
                with open(path, encoding="utf-8") as file:
                    check_picture(checks, line, file.read())


def check_reader(checks):
    """A picture of known pixels, so that a blank page could not pass for a drawing."""
    svg = ('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 40 20" width="40" height="20">'
           '<rect x="10" y="5" width="20" height="10" fill="#000000"/></svg>')
    lines = pictures.read(pictures.render(svg, 40))
    checks.check([len(lines), len(lines[0])] == [20, 40], "the page is 40 x 20")
    wrong = [(x, y) for y in range(20) for x in range(40)
             if (lines[y][x] < 128) != (10 <= x < 30 and 5 <= y < 15)]
    checks.check(not wrong, f"pixels of a rectangle: {wrong[:5]}")


def main():
    os.chdir(ROOT)
    checks = Checks()
    build = os.path.abspath(sys.argv[1])
    program = os.path.join(build, "lenscalc")
    if not pictures.can_render():
        print("skipped: no rsvg-convert to render drawings with (Debian: librsvg2-bin)")
        checks.finish()
    check_reader(checks)
    for line in DRAWINGS:
        check_draw(checks, program, line.split())
    check_others(checks, program, OTHERS)
    for path in sorted(glob.glob(os.path.join(build, "demo", "*.svg"))):
        with open(path, encoding="utf-8") as file:
            check_picture(checks, os.path.basename(path), file.read())
    if os.environ.get("LENSCALC_ALL"):
        lenses = subprocess.run([program, "list", "lenses", "--csv", "--columns", "lens"],
                                capture_output=True, text=True).stdout.split()[1:]
        checks.check(len(lenses) > 50, f"only {len(lenses)} lenses")
        check_others(checks, program, MORE)
        for name in lenses:
            check_draw(checks, program, [name, "--planes"])
    checks.finish()


main()
