"""tests/photographs.py - pictures of lenscalc render as numbers: PFM and PNG, read and written.

Only the standard library; rows go from the top.
"""
# SPDX-License-Identifier: MIT

import os
import struct
import subprocess

from pictures import lines_of


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
