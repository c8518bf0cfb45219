#!/usr/bin/env python3
"""tests/truth/check_metered.py - the mean light on a film, of small lights: BUILD_DIR

A thin lens of the aperture A sends E A cos(theta) lumens of what has the illuminance E across its
direction onto the film, if its image is there: stars by their illuminance, spheres of the radius r
by pi L r^2/d^2. The time that is metered is 10/ISO lx s over that mean.

Of lenses that are not round, of mirrors, and before a shutter that is not open to all the film at
once it is the mean of the picture, all of whose rays come from the film.
"""
# SPDX-License-Identifier: MIT

import math
import os
import re
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from check_pictures_files import read_pfm
from harness import Checks, Program

FOCAL = 50.3582
STOP = FOCAL / 16  # mm
LENS = ["--lens", "double-gauss-50", "--model", "thin", "-N", "16"]
CAMERA = "camera at=0,0,0 look=0,0,-1 focus=inf\n"
# not the same all around one axis
TILTED = """lens        a singlet behind its stop, tilted
object      inf
aperture    stop
stop        -    1   air  10
surface     60   6   1.5  30  tilt=12,0
surface     -60  55  air  30
"""
CYLINDRICAL = """lens        a singlet and a cylinder behind their stop
object      inf
aperture    stop
stop        -    1   air  10
surface     60   6   1.5  30
surface     -60  1   air  30
surface     80   2   1.5  30  cyl=x
surface     -    55  air  30
"""
MIRRORS = ["--lens", "hoo-cassegrain-ex03", "--sensor", "3.6x2.4mm"]
RIM = 20.06177  # mm, the diameter of their stop


class Meter:
    def __init__(self, program, checks, folder):
        self.program, self.checks, self.folder = program, checks, folder
        self.said = ""

    def mean(self, scene, *words, size="12x8", samples=16):
        """Lux on the film on average, as it is said; NaN: nothing is."""
        with open(os.path.join(self.folder, "a.scene"), "w", encoding="utf-8") as file:
            file.write(CAMERA + scene)
        result = self.program.run("render", "a.scene", "--size", size, "--samples", samples,
                                  *words, "-o", "a.pfm", cwd=self.folder)
        self.said = said = result.stderr.decode()
        found = re.match(r"(\S+) lx on the film on average", said)
        self.checks.check(result.returncode == 0 and found, f"{scene}: {said}")
        return float(found.group(1)) if found else math.nan

    def check(self, what, scene, expected, *words, share=0.01):
        for seed in range(3):
            mean = self.mean(scene, "--seed", str(seed), *words)
            self.checks.check(abs(mean - expected) <= share * expected,
                              f"{what}, seed {seed}: {mean} lx, expected {expected:.4g}")

    def shown(self, width, height):
        """Lux s on the pixels on average, of what is grey but for fringes."""
        with open(os.path.join(self.folder, "a.pfm"), "rb") as file:
            rows = read_pfm(file.read())[3]
        return sum(sum(row[1::3]) for row in rows) / (width * height)

    def compare(self, what, scene, *words, share):
        """What is metered with the mean of a picture of 1 s, or of 1/100 s if it moves."""
        time = 0.01 if "move=" in scene else 1
        metered = self.mean(scene, *words, "-t", str(time), size="24x16", samples=256)
        shown = self.shown(24, 16) / time
        self.checks.check(abs(metered - shown) <= share * shown,
                          f"{what}: metered {metered} lx, the picture has {shown:.4g}")


def not_alike(meter, folder):
    """Lenses and shutters to which not all directions from the axis, or times, are alike."""
    sphere = "material l black luminance=1000\nsphere material=l radius=0.6 at=0.5,0.2,-10"
    for name, text in ("tilted", TILTED), ("cylindrical", CYLINDRICAL):
        path = os.path.join(folder, name + ".lens")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        meter.compare(name, sphere + "\n", "--lens", path, share=0.04)
    # what falls as its image is read grows; what rises shrinks
    fast = sphere + " move=0,8,0\n"
    lens = ["--lens", "double-gauss-50"]
    meter.compare("global shutter", fast, *lens, share=0.04)
    meter.compare("rolling shutter", fast, *lens, "--shutter", "rolling", "--readout", "400ms",
                  share=0.04)
    meter.compare("focal shutter", fast, *lens, "--shutter", "focal", "--travel-time", "400ms",
                  "--curtain-distance", "2mm", share=0.04)
    # mirrors: all that comes through the rim, small as the sun may be
    lit = 1000 * math.pi * RIM ** 2 / 4 / (3.6 * 2.4)
    for towards in "0.003,0,-1", "0.006,0.004,-1", "-0.002,-0.005,-1":
        for size in 0.05, 1:
            sun = f"light sun illuminance=1000 diameter={size} towards={towards}\n"
            meter.check(f"mirrors, a sun of {size} degrees at {towards}", sun, lit, *MIRRORS)


def in_a_line(meter, folder):
    """A wall that shines at one wavelength, in many bands: it is as well known as one in white."""
    with open(os.path.join(folder, "line.csv"), "w", encoding="utf-8") as file:
        file.write("wavelength_nm,power\n444,0\n445,1\n446,0\n")
    wall = "colour c table=line.csv\nmaterial l black luminance=1000 emission=c\n" \
        "plane material=l at=0,0,-3 normal=0,0,1\n"
    steps = [(i + 0.5) / 64 - 0.5 for i in range(64)]
    fourths = [(1 + ((36 * x) ** 2 + (24 * y) ** 2) / FOCAL ** 2) ** -2
               for x in steps for y in steps]
    expected = 1000 * math.pi / (4 * 16 ** 2 + 1) * sum(fourths) / len(fourths)
    for bands in 32, 64:
        meter.check(f"a line in {bands} bands", wall, expected, *LENS, "--spectral", "--bands",
                    str(bands), share=2e-3)
        meter.checks.check("known to" not in meter.said, f"a line in {bands} bands: {meter.said}")


def missed(meter):
    """Lamps far smaller than a pixel: what rays miss of them is said of whole pictures, and an error
    is not believed before rays have met them."""
    places = [(x, y, -10) for x in (-2, -1, 0, 1, 2) for y in (-1, -0.5, 0, 0.5, 1)]
    lamps = "material l black luminance=1000\n" + "".join(
        f"sphere material=l radius=0.005 at={x},{y},{z}\n" for x, y, z in places)
    expected = sum(thin(math.pi * 1000 * 0.005 ** 2 / sum(v * v for v in place), place)
                   for place in places)
    words, said = [*LENS, "-t", "1"], r"pixels have (\S+) lx .* shines find (\S+) lx: small lights"
    warned = 0
    meter.mean(lamps, *words, size="96x64")
    meter.checks.check(abs(meter.shown(96, 64) / expected - 1) < 0.01 and
                       re.search(said, meter.said) is None,
                       f"lamps that send their light show {meter.shown(96, 64)} of {expected} lx: "
                       f"{meter.said}")
    for seed in range(6):
        meter.mean(lamps, *words, "--seed", str(seed), "--no-skip", "lamps", size="96x64")
        found, shown = re.search(said, meter.said), meter.shown(96, 64)
        warned += found is not None
        meter.checks.check((shown < 0.95 * expected) == (found is not None),
                           f"{shown} of {expected} lx are shown: {meter.said}")
        if found:
            meter.checks.check(abs(float(found.group(1)) / shown - 1) < 1e-3,
                               f"{shown} lx are shown: {meter.said}")
            meter.checks.check(abs(float(found.group(2)) / expected - 1) < 0.01,
                               f"{found.group(2)} lx of lamps, expected {expected}")
    meter.checks.check(warned > 1, f"few rays miss lamps in {warned} of 6 pictures")
    meter.mean(lamps, *words, "--crop", "0:0:48x64", size="96x64")
    meter.checks.check("small lights" not in meter.said, f"a crop: {meter.said}")
    for seed in range(3):
        meter.mean(lamps, *words, "--error", "5%", "--seed", str(seed), size="96x64", samples=1024)
        shown = meter.shown(96, 64)
        meter.checks.check(abs(shown / expected - 1) < 0.1 and "small lights" not in meter.said,
                           f"an error: {shown} of {expected} lx are shown: {meter.said}")


def thin(illuminance, direction):
    """Mean of the film."""
    cosine = abs(direction[2]) / math.hypot(*direction)
    return illuminance * math.pi * (STOP / 2) ** 2 * cosine / (36 * 24)


def main():
    program, checks = Program(sys.argv[1]), Checks()
    with tempfile.TemporaryDirectory(prefix="lenscalc-metered-") as folder:
        meter = Meter(program, checks, folder)
        stars = [(0.01, 0.01, -1), (-0.3, 0.1, -1), (0.2, -0.2, -1)]
        lines = "".join(f"light star illuminance=1e-6 towards={x},{y},{z}\n" for x, y, z in stars)
        away = "light star illuminance=1e-3 towards=0.5,0,-1\nlight star illuminance=1 towards=0,0,1\n"
        expected = sum(thin(1e-6, star) for star in stars)
        meter.check("stars", lines + away, expected, *LENS)
        meter.check("stars in bands", lines, expected, *LENS, "--spectral")
        in_a_line(meter, folder)
        lamp = "material l black luminance=5e6\nsphere material=l radius=0.01 at=0.5,-0.3,-5\n"
        square = 0.5 ** 2 + 0.3 ** 2 + 5 ** 2
        lit = thin(math.pi * 5e6 * 0.01 ** 2 / square, (0.5, -0.3, -5))
        meter.check("a lamp", lamp, lit, *LENS)
        hidden = "material b black\ncard material=b size=0.1,0.1 at=0.25,-0.15,-2.5\n"
        meter.check("a star beside a lamp behind a card", lamp + hidden + lines, expected, *LENS)
        # where all shines both kinds of rays find it
        sky = "light sky uniform luminance=1000\n"
        alone, both = meter.mean(sky, *LENS), meter.mean(sky + lamp, *LENS)
        checks.check(abs(both - alone - lit) < 2e-3 * both, f"a lamp before a sky adds {both - alone}")
        # a lamp and the floor that it lights, by a lens of glass: whatever the seed
        floor = lamp + "material w lambert colour=0.5\nplane material=w normal=0,1,0 at=0,-1.3,0\n"
        means = [meter.mean(floor, "--lens", "double-gauss-50", "--seed", str(seed))
                 for seed in range(4)]
        checks.check(max(means) < 1.01 * min(means), f"a lamp above a floor: {means} lx")
        missed(meter)
        not_alike(meter, folder)
        # the same, however many samples the picture has
        ball = sky + "material w lambert colour=0.5\nsphere material=w radius=2 at=0,0,-10\n"
        means = {meter.mean(ball, "--lens", "double-gauss-50", samples=n) for n in (1, 2, 64)}
        checks.check(len(means) == 1, f"by 1, 2 and 64 samples: {means} lx")
    checks.finish()


if __name__ == "__main__":
    main()
