#!/usr/bin/env python3
"""tests/documents/check_lettering.py - drawings have room for their words: ... BUILD_DIR

Draws a picture or more by every option of every command that writes SVG (their help says which do),
and measures its texts with the metrics of DejaVu Sans, see lettering.py: none reaches beyond the
page, none lies on another, none is cut. The same in the dark theme, with another title and another
subtitle, which then stand there; and of a lens with a very long name, whose title may be cut.
"""
# SPDX-License-Identifier: MIT

import os
import re
import sys
import xml.etree.ElementTree as tree
from concurrent.futures import ThreadPoolExecutor

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import NEED_SOLVER, Checks, Program
from lettering import Font, Lettering

# what is asked, with the option that draws last; {} is its file
PICTURES = """
bench double-gauss --degree 3 --rays 12 --plot {}
check double-gauss --plot {}
check fisheye-16 --plot {}
color double-gauss --plot {}
color double-gauss -w 400..700:10 --plot {}
conjugate double-gauss --object 0.5m..3m:0.5m --plot {}
conjugate -f 10cm --object 5cm..50cm:1cm --plot {}
conjugate -f 100 --object 150 --diagram {}
conjugate --mirror convex -f 100 --object 150 --diagram {}
diffraction -N 4,8,16 --frequency 0..200:10 --plot {}
diffraction -N 1.4..32 --plot {}
distortion double-gauss --grid {}
distortion fisheye-16 --plot {}
dof -f 50mm -N 4,8,16 -s 0.5..20#40 --plot {}
dof -f 50mm -N 2.8..16 -s 3m --plot {}
dof --lens double-gauss-50 -N 4,8 -s 0.5..20#30 --plot {}
dof -f 50mm -N 5.6 -s 3m --scale {}
dof -f 24mm -N 11 -s 1m --scale {}
dof -f 24,50,85 -N 2.8,5.6,11 -s 1,2,5 --card {}
dof -f 50mm -N 5.6 -s 3m --disc {}
draw double-gauss -o {}
draw fisheye-16 -o {}
draw canon-nfd-70-210 --position all -o {}
draw questar-35 --planes -o {}
draw phone-80deg -o {}
draw double-gauss --construction -o {}
energy double-gauss -N 8 --plot {}
equivalent -f 14..200#20 -N 2.8 --sensor aps-c --plot {}
exposure -N 1.4..22 --ev 12 --iso 100,400 --plot {}
exposure -t 1/1000..1/2 -N 5.6 --plot {}
exposure -N 1.4..22/third --ev 8..16:1 --iso 100 --plot {}
fan double-gauss --plot {}
fan double-gauss -w d,F,C --field 0,14 --show opd --plot {}
fan double-gauss --show pupil --plot {}
field double-gauss --plot {}
field double-gauss --field 0..14#15 -w d,F,C --plot {}
field double-gauss --show fnumbers --plot {}
field double-gauss questar-35 --over-field {}
fit double-gauss -N 2,4,8 --plot {}
fit double-gauss --map {}
flash --guide-number 40m -N 1.4..22 --plot {}
flash --guide-number 40m -s 1..20 --plot {}
focus -f 50 -s 0.3..5:0.1 --plot {}
focus -f 50 -s 0.03..0.3#10 --plot {}
fov -f 14..200 --plot {}
glass N-BK7,N-SF6,SCHOTT:F2 -w 400..700#31 --plot {}
glass --catalog SCHOTT --status current --abbe {}
glass --status current --abbe {}
glass --catalog OHARA --label S-BSL7,S-TIH6 --abbe {}
hyperfocal -f 24,50 -N 2.8..16 --plot {}
hyperfocal -f 50 -N 1.4..22/third --plot {}
illumination double-gauss --height 0..20#41 -N 2,4 --plot {}
illumination double-gauss --plot {}
lens double-gauss -w 400..700#31 --plot {}
lens double-gauss wide-35 -N 2..16 -w d --plot {}
lensmaker --r1 20..200:5 --r2 -100 --thickness 5 --index 1.5 --plot {}
microscope --na 0.1..1.4:0.1 --plot {}
motion -f 50 -s 5m --speed 1..100kmh#20 --plot {}
mtf double-gauss -N 5.6 -w d --plot {}
mtf double-gauss -N 8 -w d --square --plot {}
mtf double-gauss -N 5.6 -w d --field 0..14#15 --frequency 10,30 --plot {}
mtf double-gauss -N 5.6 -w d --field 0,7,14 --frequency 30 --defocus -0.1..0.1#21 --plot {}
mtf double-gauss -N 8 --frequency 40 --over-field {}
optimize edmund-achromat-120 --goals spot --vary R1,R2 --iterations 3 --plot {}
optimize edmund-achromat-120 --goals spot --vary R1,R2 --iterations 3 --report {}
panorama -f 14..200#20 --plot {}
pinhole -f 20..300:10 --plot {}
projector --throw 1.5 -s 2m..10m:0.5 --plot {}
psf double-gauss -N 8 --plot {}
psf double-gauss -N 8 --log --plot {}
pupil double-gauss --plot {}
pupil fisheye-16 --field 0..75:5 --plot {}
refract --after 1.5 -R 50 -y 1..40 --plot {}
report double-gauss -o {}
seidel double-gauss --plot {}
seidel nikkor-z-14-24 --position wide --plot {}
seidel double-gauss --order 5 --plot {}
sag double-gauss --plot {}
spot double-gauss --plot {}
spot double-gauss --defocus -0.1..0.1#3 --plot {}
spot double-gauss -w d --field 0,14 --defocus -0.1..0.1#11 --plot {}
spot questar-35 --to 2 --plot {}
spot double-gauss cooke-triplet-50 --sensor 35mm --over-field {}
spot fisheye-16 --sensor 35mm --over-field {}
spread double-gauss -N 8 --plot {}
spread double-gauss -N 8 --draw edge --plot {}
stars -f 14..200#20 -N 2.8 --plot {}
surfaces double-gauss --plot {}
surfaces canon-nfd-70-210 --position all --plot {}
surfaces double-gauss --show footprints --plot {}
survey Mavic 3 --altitude 50m..200m:10 --plot {}
tilt -f 24 -N 8 --tilt 1..8 --angle 90deg --plot {}
tilt -f 150 -N 22 --tilt 5 --angle 90 --sensor 4x5 --wedge {}
tilt -f 90 -N 8 --tilt 5deg -s 0.6m --wedge {}
timelapse --interval 2s..60s:2 --clip 20s --plot {}
tolerance double-gauss --trials 200 --limit 57um --plot {}
tolerance double-gauss --trials 200 --limit 57um --show yield --plot {}
tolerance double-gauss --show offenders --plot {}
tone frame-1.png frame-2.png --response debevec --curves {}
trace double-gauss --no-clip --field 0..14deg:1 --pupil-point 0:0.5 --plot {}
visual --telescope 1200 --diameter 200 --eyepiece 5..40:1 --plot {}
wavefront double-gauss -N 5.6 --plot {}
wavefront double-gauss -N 8 --field 0..14:1 --curve {}
wavefront double-gauss -N 5.6,8 --field 0,14 --defocus -0.1..0.1#11 --curve {}
wavefront questar-35 hubble-rc --field 0 --size 32 --plot {}
wavefront double-gauss -N 8 --mapped strehl --over-field {}
""".strip().split("\n")

LONG = ("spot", "mtf -N 8 -w d", "seidel", "fan -w d", "field", "distortion", "color", "pupil",
        "illumination", "draw", "psf -N 8 -w d --size 16", "wavefront -N 8 -w d --size 16",
        "lens -w 400..700#7", "check")  # asked of a lens of a long name

TITLE, SUBTITLE = "A title & no other", "a subtitle, 5 um"


def drawing_options(program):
    """(command, option) of all that write SVG, as their help says."""
    commands = re.findall(r"^  +([a-z]+)  ", program.run("help").stdout.decode(), re.M)
    found = set()
    for command in sorted(set(commands)):
        text = program.run(command, "--help").stdout.decode()
        for entry in re.split(r"\n(?= {2,6}-)", text):
            option = re.match(r" *(?:-(\w), )?--([a-z-]+) FILE ", entry)
            if option and re.search(r"\(\.svg\b|\.svg\)", " ".join(entry.split("\n\n")[0].split())):
                found.add((command, option[2]))
    return found


class Drawer:
    """Draws and measures."""

    def __init__(self, program, checks):
        self.program, self.checks = program, checks
        self.fonts = {False: Font("DejaVuSans.ttf"), True: Font("DejaVuSans-Bold.ttf")}
        self.folder = program.holder.name
        self.texts = self.pictures = 0

    def draw(self, number, words, *more):
        """The SVG of a question; null: it failed, and that is told."""
        path = os.path.join(self.folder, f"{number}.svg")
        result = self.program.run(*[path if word == "{}" else word for word in words.split()],
                                  *more, cwd=self.folder)
        if result.returncode not in (0, 3) or not os.path.exists(path):
            return words, f"is not drawn: {result.stderr.decode()[:200]}"
        with open(path, encoding="utf-8") as file:
            content = file.read()
        os.remove(path)
        return words, tree.fromstring(content) is not None and content

    def measure(self, name, content, cut=False):
        if not content.startswith("<"):
            self.checks.check(False, f"{name}: {content}")
            return []
        lettering = Lettering(self.fonts, content)
        self.pictures += 1
        self.texts += len(lettering.texts)
        outside, over = lettering.outside(0.5), lettering.overlapping(0.5)
        self.checks.check(not outside, f"{name}: beyond the page: {outside[:3]}")
        self.checks.check(not over, f"{name}: on each other: {over[:3]}")
        clipped = [words for words, _ in lettering.texts if words.endswith("…")]
        self.checks.check(cut or not clipped, f"{name}: cut: {clipped[:3]}")
        self.checks.check(len(lettering.texts) > 3, f"{name}: {len(lettering.texts)} texts")
        return [words for words, _ in lettering.texts]


def asked(words):
    """(command, option) of a question."""
    option = words.split()[-2].lstrip("-")
    return words.split()[0], "output" if option == "o" else option


def main():
    checks, program = Checks(), Program(sys.argv[1])
    drawer = Drawer(program, checks)
    has_solver = os.path.exists(os.path.join(program.build, "lenscalc-ceres"))
    pictures = [words for words in PICTURES
                if has_solver or words.split()[0] not in (*NEED_SOLVER, "optimize")]
    missing = drawing_options(program) - {asked(words) for words in PICTURES}
    checks.check(not missing, f"no picture here of {sorted(missing)}")
    program.run(*"render chart:checker --lens double-gauss-50 -s 1 -N 8 --size 48x32 --samples 4 "
                "-t 1/500,1/125 -o frame.png".split(), cwd=drawer.folder)
    lens = program.run("convert", "double-gauss", cwd=drawer.folder).stdout.decode()
    name = "Double Gauss of a very long name " * 4
    with open(os.path.join(drawer.folder, "long.lens"), "w") as file:
        file.write(re.sub(r"(?m)^lens .*$", f"lens {name.strip()}", lens, count=1))
    with ThreadPoolExecutor(int(os.environ.get("LENSCALC_JOBS", "2"))) as pool:
        for words, content in pool.map(drawer.draw, range(1000), pictures):
            drawer.measure(words, content)
        dressed = [words for words in pictures if not re.search(r"^report|--report", words)]
        for words, content in pool.map(
                lambda pair: drawer.draw(pair[0], pair[1], "--theme", "dark", "--title", TITLE,
                                         "--subtitle", SUBTITLE), enumerate(dressed[::3])):
            texts = drawer.measure("dressed " + words, content)
            checks.check(TITLE in texts and "a subtitle, 5 µm" in texts,
                         f"{words}: --title and --subtitle do not stand there")
            checks.check('fill="#17191d"' in content and 'fill="#fff"/' not in content,
                         f"{words}: the page is not dark")
        long = [f"{words.split()[0]} ./long.lens {' '.join(words.split()[1:])} "
                f"{'-o' if words == 'draw' else '--plot'} {{}}" for words in LONG]
        for words, content in pool.map(drawer.draw, range(1000), long):
            drawer.measure(words, content, cut=True)
    print(f"{drawer.texts} texts in {drawer.pictures} pictures")
    checks.finish()


main()
