#!/usr/bin/env python3
"""tests/truth/check_depths.py - pictures with depth maps: check_depths.py BUILD_DIR

A map of one distance is the flat card there, to the bit. Points of light in two distances before
and behind the focus become discs as large as similar triangles have it, D |d - d0|/d in the plane
in focus, through a lens so thin that its formula needs no more. A near edge before a far wall
covers it by as much of the pupil as lies on its side. A PNG means what its range says.
"""
# SPDX-License-Identifier: MIT

import math
import os
import struct
import subprocess
import sys
import tempfile
import zlib

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program
from photographs import read_pfm, write_pfm

# a lens of 100 mm and f/40, its stop in front: 1/f = (n - 1) 2/R, of no thickness to speak of, and
# with a spherical aberration of 0.03 mm
THIN = """lens thin
wavelength d
aperture stop
stop - 0 air 2.5
surface 100 0.0001 1.5 -
surface -100 0 air -
"""
F, PUPIL = 100, 2.5


def write_png(path, rows):
    """Grey, 16 bits."""
    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data +
                struct.pack(">I", zlib.crc32(kind + data)))
    lines = b"".join(b"\0" + struct.pack(f">{len(row)}H", *row) for row in rows)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" +
                   chunk(b"IHDR", struct.pack(">IIBBBBB", len(rows[0]), len(rows), 16, 0, 0, 0, 0)) +
                   chunk(b"IDAT", zlib.compress(lines)) + chunk(b"IEND", b""))


def filled(width, height, value):
    return [[value] * width for _ in range(height)]


class Fixture:
    def __init__(self, build, checks, folder):
        self.program, self.checks, self.folder = Program(build), checks, folder

    def path(self, name):
        return os.path.join(self.folder, name)

    def take(self, *words):
        out = self.path("out.pfm")
        result = subprocess.run(self.program.command + ["render", *words, "-o", out], text=True,
                                cwd=self.folder, capture_output=True,
                                env=self.program.environment())
        good = self.checks.check(result.returncode == 0, f"{words}: {result.stderr}")
        return [[pixel[0] for pixel in row] for row in read_pfm(out)] if good else None


def check_flat(fixture):
    """One distance: the card at it; twice that distance, with a frame that grows with it."""
    picture = [[((7 * x + 13 * y) % 11) / 10 for x in range(40)] for y in range(30)]
    write_pfm(fixture.path("card.pfm"), picture)
    film = 110.0
    common = ["card.pfm", "--lens", "thin.lens", "--focus", str(film), "--from", "front", "-t",
              "0.01", "-w", "d", "--size", "60x40", "--samples", "16", "--no-skip", "blur"]
    near = ["-s", "1100mm", "--field-width", "200mm"]
    far = ["-s", "2200mm", "--field-width", "400mm"]
    thickness = 0.0001
    for distance, flat, tolerance in ((1100, near, 0), (2200, far, 1e-5)):
        depth = (distance + thickness + film) / 1000
        write_pfm(fixture.path("flat.pfm"), filled(40, 30, depth))
        one = fixture.take(*common, *flat)
        two = fixture.take(*common, *near, "--depth-map", "flat.pfm")
        most = max(map(max, one))
        off = max(abs(a - b) for r, s in zip(one, two) for a, b in zip(r, s)) / most
        # depths are floats: 6e-8 of them move the picture by 1e-5 pixels
        fixture.checks.check(off <= max(tolerance, 1e-5),
                             f"a map of {distance} mm is off the flat card by {off:.2g}")


def moments(rows, x0, x1):
    """Centre and mean square of the distance from it, pixels, of columns x0 .. x1 - 1."""
    light = [(x + 0.5, y + 0.5, v) for y, row in enumerate(rows) for x, v in enumerate(row)
             if x0 <= x < x1]
    total = sum(v for _, _, v in light)
    cx, cy = (sum(point[k] * point[2] for point in light) / total for k in (0, 1))
    return cx, cy, sum(v * ((x - cx) ** 2 + (y - cy) ** 2) for x, y, v in light) / total


def check_discs(fixture):
    """Focus at 1000 mm, points at 700 and 2500 mm: D |d - d0|/d times m = f/(d0 - f) on film."""
    d0, sensor = 1000, 2.25
    film = 1 / (1 / F - 1 / d0)
    m = F / (d0 - F)
    picture = filled(90, 30, 0.0)
    depths = filled(90, 30, 0.0)
    near, far = 700, 2500
    for row in range(30):
        for column in range(90):
            depths[row][column] = ((near if column < 45 else far) + film) / 1000
    picture[15][22] = picture[15][67] = 1.0
    write_pfm(fixture.path("points.pfm"), picture)
    write_pfm(fixture.path("depths.pfm"), depths)
    rows = fixture.take("points.pfm", "--lens", "thin.lens", "--from", "front", "-s", f"{d0}mm",
                        "--field-width", f"{sensor / m}mm", "--sensor", f"{sensor}x{sensor / 3}mm", "-w", "d",
                        "--size", "180x60", "--samples", "64", "-t", "1", "--depth-map",
                        "depths.pfm")
    if rows is None:
        return
    pixel = sensor / 180  # mm; those of the picture are twice as large
    for name, d, x0, x1, column in (("near", near, 0, 90, 22.5), ("far", far, 90, 180, 67.5)):
        disc = PUPIL * abs(d - d0) / d * m / pixel
        # a disc's mean square is c^2/8, that of a pixel's light, a tent over two each way, 4/6 in
        # both directions, that of a pixel of the film 1/12
        expected = disc ** 2 / 8 + 2 * 4 / 6 + 2 / 12
        cx, cy, found = moments(rows, x0, x1)
        fixture.checks.check(abs(found - expected) < 0.02 * expected,
                             f"{name} point: mean square {found:.3f}, expected {expected:.3f}")
        fixture.checks.check(abs(cx - 2 * column) < 0.1 and abs(cy - 31) < 0.1,
                             f"{name} point lies at {cx:.2f}, {cy:.2f}")


def check_cover(fixture):
    """
    A black half plane at 500 mm before a white one in focus at 1000 mm: of a point of the film
    that looks at X of the white one, right of the edge's line of sight, rays are kept that pass
    the near plane right of its edge: (x + X)/2 > 0 of pupil points x. The share of a disc.
    """
    d0, film = 1000, 1 / (1 / F - 1 / 1000)
    m = F / (d0 - F)
    half = [[0.0 if x < 45 else 1.0 for x in range(90)] for _ in range(90)]
    depths = [[((500 if x < 45 else d0) + film) / 1000 for x in range(90)] for _ in range(90)]
    write_pfm(fixture.path("half.pfm"), half)
    write_pfm(fixture.path("depths.pfm"), depths)
    for hidden in ("nearby", "black"):
        rows = fixture.take("half.pfm", "--lens", "thin.lens", "--from", "front", "-s", f"{d0}mm",
                            "--field-width", "4.5mm", "--sensor", f"{4.5 * m}x{0.5 * m}mm", "-w",
                            "d", "--size", "90x10", "--samples", "256", "-t", "1", "--depth-map",
                            "depths.pfm", *(["--hidden", hidden] if hidden == "nearby" else []))
        if rows is None:
            return
        full = sum(row[89] for row in rows) / 10
        for column in range(20, 70):
            X, R = (column + 0.5 - 45) * 0.05, PUPIL / 2
            a = min(1, max(-1, X / R))
            # the part of the unit disc with x > -a; what the edge hides is not known, so black
            share = (math.acos(-a) + a * math.sqrt(1 - a * a)) / math.pi
            share = 0 if hidden == "black" and X < 0 else share
            found = sum(row[column] for row in rows) / 10 / full
            fixture.checks.check(abs(found - share) < 0.02 or (hidden == "black" and abs(X) < 0.1),
                                 f"{hidden}: {X:.1f} mm from the edge {found:.3f} of the light, "
                                 f"not {share:.3f}")


def check_png(fixture):
    """1/d = 1/4 + v (1/1 - 1/4): the same as the distances themselves, rounded to floats."""
    levels = [[(4099 * x + 257 * y) % 65536 for x in range(30)] for y in range(20)]
    write_png(fixture.path("map.png"), levels)
    write_pfm(fixture.path("map.pfm"),
              [[1 / (0.25 + v / 65535 * 0.75) for v in row] for row in levels])
    common = ["chart:wedge", "--lens", "thin.lens", "-s", "2m", "--size", "30x20", "--samples", "4",
              "--depth-map"]
    one = fixture.take(*common, "map.png", "--depth", "1..4m")
    two = fixture.take(*common, "map.pfm")
    most = max(map(max, one))
    off = sum(abs(a - b) > 1e-3 * most for r, s in zip(one, two) for a, b in zip(r, s))
    fixture.checks.check(off <= 6, f"{off} pixels of a PNG's depths are others than of the same PFM")


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory(prefix="lenscalc-depths-") as folder:
        fixture = Fixture(sys.argv[1], checks, folder)
        with open(fixture.path("thin.lens"), "w", encoding="ascii") as file:
            file.write(THIN)
        check_flat(fixture)
        check_discs(fixture)
        check_cover(fixture)
        check_png(fixture)
    return checks.finish()


if __name__ == "__main__":
    sys.exit(main())
