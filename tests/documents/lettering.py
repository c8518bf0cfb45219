"""tests/documents/lettering.py - where the texts of an SVG drawing lie, by the metrics of a font.

Reads what of TrueType is wanted (tables cmap, hmtx, loca, glyf, head) of DejaVu Sans, which is
wider than Helvetica, Arial and Liberation Sans: what fits in it fits in those.
"""
# SPDX-License-Identifier: MIT

import math
import os
import re
import struct
import xml.etree.ElementTree as tree

FOLDERS = ("/usr/share/fonts/truetype/dejavu", "/usr/share/fonts/dejavu",
           "/usr/share/fonts/dejavu-sans-fonts", "/usr/share/fonts/TTF", "/usr/local/share/fonts")
SVG = "{http://www.w3.org/2000/svg}"


class Font:
    """Advance widths and ink boxes of a TrueType font, in ems."""

    def __init__(self, name):
        paths = [os.path.join(folder, name) for folder in FOLDERS]
        path = next((p for p in paths if os.path.exists(p)), None)
        if path is None:
            raise SystemExit(f"FAILED no font {name}: install fonts-dejavu-core\n"
                             "0 passed, 1 failed")
        with open(path, "rb") as file:
            self.data = file.read()
        count = struct.unpack_from(">H", self.data, 4)[0]
        self.tables = {}
        for i in range(count):
            tag, _, offset, length = struct.unpack_from(">4sIII", self.data, 12 + 16 * i)
            self.tables[tag.decode()] = (offset, length)
        head, hhea = self.tables["head"][0], self.tables["hhea"][0]
        self.em = struct.unpack_from(">H", self.data, head + 18)[0]
        self.long_loca = struct.unpack_from(">h", self.data, head + 50)[0] == 1
        self.metrics = struct.unpack_from(">H", self.data, hhea + 34)[0]
        self.glyphs = self.read_cmap()

    def read_cmap(self):
        """Glyph by character: the table of format 4 for Unicode's first plane."""
        base = self.tables["cmap"][0]
        for i in range(struct.unpack_from(">H", self.data, base + 2)[0]):
            offset = base + struct.unpack_from(">HHI", self.data, base + 4 + 8 * i)[2]
            if struct.unpack_from(">H", self.data, offset)[0] == 4:
                return self.read_segments(offset)
        raise SystemExit("FAILED the font has no cmap of format 4\n0 passed, 1 failed")

    def read_segments(self, offset):
        segments = struct.unpack_from(">H", self.data, offset + 6)[0] // 2
        ends, starts = offset + 14, offset + 16 + 2 * segments
        deltas, ranges = starts + 2 * segments, starts + 4 * segments
        glyphs = {}
        for i in range(segments):
            end, start, delta, step = (struct.unpack_from(">H", self.data, at + 2 * i)[0]
                                       for at in (ends, starts, deltas, ranges))
            for code in range(start, min(end, 0xfffe) + 1):
                glyph = code
                if step != 0:
                    at = ranges + 2 * i + step + 2 * (code - start)
                    glyph = struct.unpack_from(">H", self.data, at)[0]
                glyphs[code] = (glyph + delta) % 65536 if glyph or not step else 0
        return glyphs

    def advance(self, character):
        glyph = min(self.glyphs.get(ord(character), 0), self.metrics - 1)
        return struct.unpack_from(">H", self.data, self.tables["hmtx"][0] + 4 * glyph)[0] / self.em

    def ink(self, character):
        """Lowest and highest of its outline; null where it has none."""
        glyph, loca = self.glyphs.get(ord(character), 0), self.tables["loca"][0]
        if self.long_loca:
            start, end = struct.unpack_from(">II", self.data, loca + 4 * glyph)
        else:
            start, end = (2 * n for n in struct.unpack_from(">HH", self.data, loca + 2 * glyph))
        if start == end:
            return None
        _, low, _, high = struct.unpack_from(">hhhh", self.data, self.tables["glyf"][0] + start + 2)
        return low / self.em, high / self.em


def transformed(matrix, words):
    """A matrix a b c d e f with what a transform attribute adds to it."""
    for name, numbers in re.findall(r"(\w+)\(([^)]*)\)", words or ""):
        values = [float(n) for n in re.findall(r"-?[\d.]+(?:e-?\d+)?", numbers)]
        if name == "translate":
            step = (1, 0, 0, 1, values[0], values[1] if len(values) > 1 else 0)
        elif name == "rotate":
            angle = math.radians(values[0])
            c, s = math.cos(angle), math.sin(angle)
            x, y = values[1:] if len(values) > 1 else (0, 0)
            step = (c, s, -s, c, x - c * x + s * y, y - s * x - c * y)
        elif name == "scale":
            step = (values[0], 0, 0, values[-1], 0, 0)
        else:
            step = tuple(values)
        a, b, c, d, e, f = matrix
        g, h, i, j, k, m = step
        matrix = (a * g + c * h, b * g + d * h, a * i + c * j, b * i + d * j,
                  a * k + c * m + e, b * k + d * m + f)
    return matrix


class Lettering:
    """The texts of a drawing: each its words and the corners of its ink, px."""

    def __init__(self, fonts, content):
        self.fonts, self.texts = fonts, []
        root = tree.fromstring(content)
        self.page = [float(n) for n in root.get("viewBox").split()]
        for child in root:
            self.walk(child, (1, 0, 0, 1, 0, 0), 16)

    def walk(self, element, matrix, size):
        matrix = transformed(matrix, element.get("transform"))
        size = float(element.get("font-size", size))
        if element.tag == SVG + "text":
            self.add(element, matrix, size)
            return
        if element.tag == SVG + "svg":  # a drawing in a page
            left, top, wide, _ = (float(n) for n in element.get("viewBox").split())
            scale = float(element.get("width")) / wide
            matrix = transformed(matrix, f"translate({element.get('x', 0)} {element.get('y', 0)}) "
                                         f"scale({scale}) translate({-left} {-top})")
        for child in element:
            self.walk(child, matrix, size)

    def add(self, element, matrix, size):
        font = self.fonts[element.get("font-weight") == "bold"]
        runs = [(element.text or "", size, 0.0)]
        rise = 0.0
        for part in element:
            rise -= float(part.get("dy", 0))
            runs.append((part.text or "", float(part.get("font-size", size)), rise))
            runs.append((part.tail or "", size, rise))
        width, low, high = 0.0, math.inf, -math.inf
        for words, height, up in runs:
            for character in words:
                width += font.advance(character) * height
                ink = font.ink(character)
                if ink is not None:
                    low, high = min(low, up + ink[0] * height), max(high, up + ink[1] * height)
        words = "".join(run[0] for run in runs)
        if not words.strip():
            return
        x, y = float(element.get("x")), float(element.get("y"))
        x -= {"middle": 0.5, "end": 1}.get(element.get("text-anchor"), 0) * width
        corners = [(x, y - high), (x + width, y - high), (x + width, y - low), (x, y - low)]
        a, b, c, d, e, f = matrix
        self.texts.append((words, [(a * u + c * v + e, b * u + d * v + f) for u, v in corners]))

    def outside(self, slack):
        """Texts that reach beyond the page."""
        left, top, width, height = self.page
        return [words for words, corners in self.texts
                if any(not (left - slack <= x <= left + width + slack and
                            top - slack <= y <= top + height + slack) for x, y in corners)]

    def overlapping(self, slack):
        """Pairs of texts that lie on each other."""
        pairs = []
        for i, (words, corners) in enumerate(self.texts):
            for other, others in self.texts[i + 1:]:
                if not are_apart(corners, others, slack):
                    pairs.append((words, other))
        return pairs


def are_apart(one, other, slack):
    """Does a line between two rectangles part them, but for `slack` px? (separating axes)"""
    for corners in (one, other):
        for i in (0, 1):
            x, y = corners[i + 1][0] - corners[i][0], corners[i + 1][1] - corners[i][1]
            length = math.hypot(x, y) or 1
            places = [[(u * x + v * y) / length for u, v in c] for c in (one, other)]
            if min(places[0]) > max(places[1]) - slack or min(places[1]) > max(places[0]) - slack:
                return True
    return False
