"""tests/photographs.py - pictures of lenscalc render as numbers: PFM and PNG, read and written.

Only the standard library; rows go from the top.
"""
# SPDX-License-Identifier: MIT

import math
import os
import struct
import subprocess

from pictures import lines_of

# the course's double Gauss; film radius, mm: E/L with the film at 36.105905 mm, to about 1e-4; and
# the mean over 36 x 24 mm with the film at 36.3612 mm
DOUBLE_GAUSS = "cs348b-dgauss-50"
IRRADIANCE = {0: .192512, 5: .167216, 10: .125716, 15: .082428, 18: .057826, 20: .042577}
MEAN = 0.110853
MEAN_BY_PBRT = (0.110878, 0.110802, 0.110805)  # by its own code, three samplings


def read_pfm(path):
    """Rows of pixels: triples, or numbers of a grey picture."""
    with open(path, "rb") as file:
        kind, size, scale, data = file.read().split(b"\n", 3)
    width, height = map(int, size.split())
    assert kind in (b"PF", b"Pf") and float(scale) < 0
    count = 3 if kind == b"PF" else 1
    values = struct.unpack(f"<{count * width * height}f", data)
    pixels = list(zip(*[iter(values)] * 3)) if count == 3 else values
    return [pixels[y * width:(y + 1) * width] for y in range(height)][::-1]


def write_pfm(path, rows):
    """Grey pixels."""
    with open(path, "wb") as file:
        file.write(f"Pf\n{len(rows[0])} {len(rows)}\n-1.0\n".encode())
        for row in reversed(rows):
            file.write(struct.pack(f"<{len(row)}f", *row))


def read_png(path):
    """Rows of pixels: tuples of whole numbers, of as many bits as the file has."""
    with open(path, "rb") as file:
        png = file.read()
    lines, step = lines_of(png)
    size, letter = (2, "H") if png[24] == 16 else (1, "B")
    return [list(zip(*[iter(struct.unpack(f">{len(line) // size}{letter}", line))] * (step // size)))
            for line in lines]


def take(program, checks, folder, *words, name="out.pfm"):
    """Rows of a picture; None where none was taken."""
    path = os.path.join(folder, name)
    result = subprocess.run(program.command + ["render", *words, "-o", path], text=True, cwd=folder,
                            capture_output=True, env=program.environment())
    if not checks.check(result.returncode == 0, f"{words}: {result.stderr}"):
        return None
    return (read_pfm if name.endswith(".pfm") else read_png)(path)


def mean_of(rows, channel=1):
    return sum(pixel[channel] for row in rows for pixel in row) / (len(rows) * len(rows[0]))


def on_diagonal(rows, width, radius, channel=1):
    """Of a film so wide, at a radius from its middle to its corners: between the middles of four
    pixels, of one channel, the mean of the four corners."""
    columns, lines = len(rows[0]), len(rows)
    share = radius * columns / width / math.hypot(columns, lines)
    column, line = columns * (0.5 + share) - 0.5, lines * (0.5 + share) - 0.5
    left, above = int(column), int(line)
    right, down = column - left, line - above
    return sum(rows[v][h][channel] / 4 * (right if i else 1 - right) * (down if j else 1 - down)
               for i in (0, 1) for j in (0, 1)
               for h in (left + i, columns - 1 - left - i)
               for v in (above + j, lines - 1 - above - j))


def centroid(rows, pitch, channel=1):
    """Of the light, to the right and up from the middle, in units of the pitch."""
    total = sum(pixel[channel] for row in rows for pixel in row)
    x = sum(pixel[channel] * (i + 0.5) for row in rows for i, pixel in enumerate(row)) / total
    y = sum(pixel[channel] * (j + 0.5) for j, row in enumerate(rows) for pixel in row) / total
    return (x - len(rows[0]) / 2) * pitch, (len(rows) / 2 - y) * pitch


class Studio:
    """Scenes are written into a folder and photographed there, with some words always."""

    def __init__(self, program, checks, folder, *common):
        self.program, self.checks, self.folder, self.common = program, checks, folder, common
        self.count = 0

    def write(self, scene):
        """Name of a new file."""
        self.count += 1
        name = f"{self.count}.scene"
        with open(os.path.join(self.folder, name), "w", encoding="utf-8") as file:
            file.write(scene)
        return name

    def take(self, scene, *words):
        """Rows of pixels, lx s; None where no picture was taken."""
        return take(self.program, self.checks, self.folder, self.write(scene), *self.common, *words)

    def seeds(self, count, scene, *words):
        """Pictures of as many seeds; None where one was not taken."""
        name = self.write(scene)
        rows = [take(self.program, self.checks, self.folder, name, *self.common, *words, "--seed",
                     str(seed)) for seed in range(1, count + 1)]
        return None if None in rows else rows

    def near(self, found, expected, share, what):
        self.checks.check(abs(found - expected) <= share * abs(expected),
                          f"{what} is {found:.6g}, expected {expected:.6g}")

    def unbiased(self, values, expected, what, known=0):
        """
        The mean of several seeds is within 4 sigma of what is expected, and sigma below 0.5 %;
        `known` is the share to which what is expected is known.
        """
        mean = sum(values) / len(values)
        sigma = math.sqrt(sum((v - mean) ** 2 for v in values) / (len(values) - 1) / len(values))
        self.checks.check(abs(mean - expected) <= 4 * sigma + known * abs(expected),
                          f"{what} is {mean:.6g} +- {sigma:.2g}, expected {expected:.6g}")
        self.checks.check(sigma <= 5e-3 * abs(expected), f"{what}: sigma {sigma:.2g} of {mean:.6g}")
