"""tests/pictures.py - drawings as pixels: renders SVG with librsvg and reads the PNG.

Only the standard library; pixels are grey, 0 black to 255 white, on a white page.
"""
# SPDX-License-Identifier: MIT

import shutil
import struct
import subprocess
import zlib


def can_render():
    return shutil.which("rsvg-convert") is not None


def render(svg, width):
    """PNG of an SVG text, `width` pixels wide, on white."""
    return subprocess.run(["rsvg-convert", "-w", str(width), "-b", "white"], input=svg.encode(),
                          stdout=subprocess.PIPE, check=True).stdout


def unfilter(kind, line, above, step):
    """One line of a PNG as it was before its filter, in place."""
    if kind == 1:
        for i in range(step, len(line)):
            line[i] = line[i] + line[i - step] & 255
    elif kind == 2:
        for i, up in enumerate(above):
            line[i] = line[i] + up & 255
    elif kind == 3:
        for i, up in enumerate(above):
            left = line[i - step] if i >= step else 0
            line[i] = line[i] + (left + up) // 2 & 255
    elif kind == 4:
        for i, up in enumerate(above):
            left, corner = (line[i - step], above[i - step]) if i >= step else (0, 0)
            a, b, c = abs(up - corner), abs(left - corner), abs(left + up - 2 * corner)
            line[i] = line[i] + (left if a <= b and a <= c else up if b <= c else corner) & 255


def lines_of(png):
    """Lines of bytes of a picture as they were before its filter, and bytes a pixel."""
    at, data = 8, b""
    while at < len(png):
        length, name = struct.unpack(">I4s", png[at:at + 8])
        if name == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", png[at + 8:at + 18])
        elif name == b"IDAT":
            data += png[at + 8:at + 8 + length]
        at += length + 12
    data = zlib.decompress(data)
    step = {0: 1, 2: 3, 4: 2, 6: 4}[colour] * depth // 8
    size = width * step
    above, lines = bytearray(size), []
    for y in range(height):
        start = y * (size + 1)
        line = bytearray(data[start + 1:start + 1 + size])
        unfilter(data[start], line, above, step)
        lines.append(line)
        above = line
    return lines, step


def read(png):
    """Lines of grey pixels of an 8-bit RGB or RGBA picture."""
    lines, step = lines_of(png)
    assert step in (3, 4)
    return [bytes(min(line[x:x + 3]) for x in range(0, len(line), step)) for line in lines]
