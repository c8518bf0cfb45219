#!/usr/bin/env python3
"""tests/scene/make_files.py - what the scenes show beside them: make_files.py FOLDER

Writes three meshes, vase, roof and spire.obj, and four pictures, chart, wood, wheel and
clock.png, the same bytes each time; the stars of
night.scene are printed. The files are kept beside the scenes; this is how they were made.
"""
# SPDX-License-Identifier: MIT

import math
import os
import struct
import sys
import zlib


def write_png(path, width, height, palette, pixel):
    """A picture of at most 256 colours; pixel(x, y) is the number of one."""
    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))
    rows = b"".join(b"\0" + bytes(pixel(x, y) for x in range(width)) for y in range(height))
    head = struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0)
    alphas = bytes(colour[3] if len(colour) > 3 else 255 for colour in palette)
    transparency = chunk(b"tRNS", alphas) if min(alphas) < 255 else b""
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) +
                   chunk(b"PLTE", b"".join(bytes(colour[:3]) for colour in palette)) +
                   transparency + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def chance(*numbers):
    """A number from 0 to 1 that belongs to these."""
    return zlib.crc32(struct.pack(f"<{len(numbers)}i", *numbers)) / 2.0 ** 32


def smooth(x, y, seed):
    """Noise with bumps of size 1."""
    i, j = math.floor(x), math.floor(y)
    u, v = x - i, y - j
    u, v = u * u * (3 - 2 * u), v * v * (3 - 2 * v)
    low = chance(i, j, seed) * (1 - u) + chance(i + 1, j, seed) * u
    high = chance(i, j + 1, seed) * (1 - u) + chance(i + 1, j + 1, seed) * u
    return low * (1 - v) + high * v


def make_vase(path):
    """A pot with a lip, turned about y, as high as 12.6 and 9.2 wide; outside, lip and inside."""
    profile = [(0, 0), (2.4, 0), (2.8, 0.12), (3.3, 1.1), (4.2, 3.1), (4.6, 5.1), (4.2, 7.1),
               (3.0, 8.8), (2.15, 9.9), (1.9, 10.8), (2.15, 11.7), (2.85, 12.4), (3.05, 12.6),
               (2.85, 12.6), (1.95, 11.7), (1.65, 10.8), (1.9, 9.8), (2.8, 8.5), (3.95, 6.9),
               (4.3, 5.1), (3.9, 3.2), (3.0, 1.4), (0, 0.8)]
    around, between = 32, 2
    points = []
    for i in range(len(profile) - 1):
        ends = [profile[max(0, i - 1)], profile[i], profile[i + 1],
                profile[min(len(profile) - 1, i + 2)]]
        for k in range(between):  # Catmull and Rom's curve
            t = k / between
            points.append([((-t + 2 * t ** 2 - t ** 3) * a + (2 - 5 * t ** 2 + 3 * t ** 3) * b +
                            (t + 4 * t ** 2 - 3 * t ** 3) * c + (t ** 3 - t ** 2) * d) / 2
                           for a, b, c, d in zip(*ends)])
    points.append(profile[-1])
    lines = ["# a pot, turned about y; tests/scene/make_files.py made it"]
    for i, (r, y) in enumerate(points):
        before, behind = points[max(0, i - 1)], points[min(len(points) - 1, i + 1)]
        along = (behind[0] - before[0], behind[1] - before[1])
        length = math.hypot(*along)
        out, up = along[1] / length, -along[0] / length
        for k in range(around):
            c, s = math.cos(2 * math.pi * k / around), math.sin(2 * math.pi * k / around)
            lines.append(f"v {max(0, r) * c:.4g} {y:.4g} {max(0, r) * s:.4g}")
            lines.append(f"vn {out * c:.3f} {up:.3f} {out * s:.3f}")
    for i in range(len(points) - 1):
        for k in range(around):
            a, b = i * around + k + 1, i * around + (k + 1) % around + 1
            corners = [a, a + around, b + around, b]
            if points[i + 1][0] <= 0:  # in the middle the sides meet
                corners.remove(b + around)
            if points[i][0] <= 0:
                corners.remove(b)
            lines.append("f " + " ".join(f"{n}//{n}" for n in corners))
    with open(path, "w", encoding="ascii") as file:
        file.write("\n".join(lines) + "\n")


def make_roof(path):
    """A gable roof, 1 wide and 0.6 high, its ridge 1 long along z."""
    lines = ["# a gable roof; tests/scene/make_files.py made it"]
    lines += [f"v {x} {y} {z}" for z in (0.5, -0.5) for x, y in ((-0.5, 0), (0.5, 0), (0, 0.6))]
    lines += ["f 1 2 3", "f 5 4 6", "f 2 5 6 3", "f 4 1 3 6", "f 4 5 2 1"]
    with open(path, "w", encoding="ascii") as file:
        file.write("\n".join(lines) + "\n")


def make_spire(path):
    """A spire of eight sides, 1 wide and 2.4 high."""
    lines = ["# a spire; tests/scene/make_files.py made it", "v 0 2.4 0"]
    for k in range(8):
        turn, r = math.pi * (2 * k + 1) / 8, 0.5 / math.cos(math.pi / 8)
        lines.append(f"v {r * math.cos(turn):.4g} 0 {r * math.sin(turn):.4g}")
    lines += [f"f 1 {(k + 1) % 8 + 2} {k + 2}" for k in range(8)]
    with open(path, "w", encoding="ascii") as file:
        file.write("\n".join(lines) + "\n")


def make_chart(path):
    """A star, an edge, greys, colours and lines on paper."""
    palette = [(236, 234, 228), (20, 20, 22)] + [(v, v, v) for v in range(30, 246, 24)] + \
        [(196, 44, 36), (46, 128, 60), (38, 66, 150), (232, 200, 40), (190, 80, 150), (20, 140, 170)]

    def pixel(x, y):
        across, down = x - 150.5, y - 150.5
        r = math.hypot(across, down)
        if r < 120:
            return int(math.floor(36 * (math.atan2(down, across) / math.pi + 1))) % 2
        if r < 124 or x < 6 or y < 6 or x >= 474 or y >= 314:
            return 1
        if 300 <= x < 450 and 30 <= y < 150:  # an edge, 5 degrees from upright
            return 1 if x - 375 > (y - 90) * math.tan(math.radians(5)) else 0
        if 300 <= x < 450 and 165 <= y < 195:
            return 11 + (x - 300) // 25
        if 300 <= x < 450 and 200 <= y < 230:
            return 2 + (x - 300) * 9 // 150
        if 300 <= x < 450 and 245 <= y < 290:
            period = (24, 16, 12, 8, 4, 2)[(x - 300) // 25]
            return 1 if (x - 300) % 25 % period < period / 2 else 0
        return 0
    write_png(path, 480, 320, palette, pixel)


def make_wood(path):
    """Four boards side by side, the grain along x; it goes on from its right to its left edge."""
    shades = 48
    palette = [tuple(int(c * (0.45 + 0.75 * k / shades)) for c in (150, 98, 56))
               for k in range(shades)]
    width, height = 384, 192

    def pixel(x, y):
        board, inside = divmod(y, height // 4)
        if inside == 0:
            return 0
        turn = 2 * math.pi * x / width  # noise about a cylinder has no seam
        u, v = 0.7 * math.cos(turn), 0.7 * math.sin(turn)
        bend = smooth(u + 20 + 7 * board, v + 20 + inside / 60, 1)
        rings = math.sin(2 * math.pi * (inside / 11 + 2.4 * bend + chance(board, 5)))
        fibre = smooth(16 * u + 90, 0.9 * y + 9 * v + 90, 2)
        light = 0.55 + 0.16 * rings + 0.22 * (fibre - 0.5) + 0.22 * (chance(board, 9) - 0.5)
        return max(1, min(shades - 1, int(shades * light)))
    write_png(path, width, height, palette, pixel)


def make_wheel(path):
    """A wheel with a tyre and five spokes; nothing beside it."""
    palette = [(0, 0, 0, 0), (24, 24, 26), (150, 152, 156), (60, 62, 66), (205, 206, 210)]

    def pixel(x, y):
        across, down = (x - 63.5) / 64, (y - 63.5) / 64
        r, turn = math.hypot(across, down), math.atan2(down, across)
        if r > 0.99:
            return 0
        if r > 0.68:
            return 1
        if r > 0.60 or r < 0.16:
            return 4 if r > 0.08 else 3
        spoke = abs((turn / (2 * math.pi) * 5) % 1 - 0.5) * 2 * math.pi / 5 * r
        return 2 if spoke < 0.085 else 3
    write_png(path, 128, 128, palette, pixel)


def make_clock(path):
    """The face of a clock at ten past ten, gilt on blue; nothing beside it."""
    palette = [(0, 0, 0, 0), (28, 40, 74), (214, 170, 72)]

    def along(across, down, hour):
        turn = math.pi * hour / 6
        return across * math.sin(turn) - down * math.cos(turn), \
            abs(across * math.cos(turn) + down * math.sin(turn))

    def pixel(x, y):
        across, down = (x - 127.5) / 128, (y - 127.5) / 128
        r = math.hypot(across, down)
        if r > 0.99:
            return 0
        if r > 0.93 or r < 0.06 or 0.6 < r < 0.615:
            return 2
        for hour in range(12):
            far, beside = along(across, down, hour)
            if 0.66 < far < 0.88 and beside < (0.05 if hour % 3 == 0 else 0.03):
                return 2
        for hour, length, wide in ((10.17, 0.45, 0.045), (2, 0.72, 0.03)):
            far, beside = along(across, down, hour)
            if 0 < far < length and beside < wide:
                return 2
        return 1
    write_png(path, 256, 256, palette, pixel)


def print_stars(latitude=65, hour=5.6):
    """Orion and Sirius in the south, which is -z: azimuths grow to the right, to the west."""
    stars = [("Betelgeuse", 5.919, 7.407, 0.50, "3600K"), ("Rigel", 5.242, -8.202, 0.13, "12000K"),
             ("Bellatrix", 5.419, 6.350, 1.64, "20000K"), ("Mintaka", 5.533, -0.299, 2.23, "20000K"),
             ("Alnilam", 5.604, -1.202, 1.69, "20000K"), ("Alnitak", 5.679, -1.943, 1.77, "20000K"),
             ("Saiph", 5.796, -9.670, 2.06, "20000K"), ("Meissa", 5.585, 9.934, 3.33, "20000K"),
             ("Hatysa", 5.590, -5.910, 2.77, "20000K"), ("Sirius", 6.752, -16.716, -1.46, "10000K"),
             ("Procyon", 7.655, 5.225, 0.34, "6500K"), ("Aldebaran", 4.599, 16.509, 0.86, "3900K"),
             ("Cursa", 5.131, -5.086, 2.79, "8500K"), ("Arneb", 5.545, -17.822, 2.58, "7000K"),
             ("Mirzam", 6.378, -17.956, 1.98, "20000K"), ("Alhena", 6.628, 16.399, 1.92, "9000K")]
    phi = math.radians(latitude)
    for name, right, declination, magnitude, kelvin in stars:
        h, d = math.radians(15 * (hour - right)), math.radians(declination)
        up = math.sin(phi) * math.sin(d) + math.cos(phi) * math.cos(d) * math.cos(h)
        south = math.sin(phi) * math.cos(d) * math.cos(h) - math.cos(phi) * math.sin(d)
        west = math.cos(d) * math.sin(h)
        print(f"light star  magnitude={magnitude:<5} elevation={math.degrees(math.asin(up)):.2f} "
              f"azimuth={math.degrees(math.atan2(west, south)):.2f} diameter=4arcmin spectrum={kelvin} "
              f"# {name}")


def main():
    folder = sys.argv[1]
    make_vase(os.path.join(folder, "vase.obj"))
    make_roof(os.path.join(folder, "roof.obj"))
    make_spire(os.path.join(folder, "spire.obj"))
    make_chart(os.path.join(folder, "chart.png"))
    make_wood(os.path.join(folder, "wood.png"))
    make_wheel(os.path.join(folder, "wheel.png"))
    make_clock(os.path.join(folder, "clock.png"))
    print_stars()


if __name__ == "__main__":
    main()
