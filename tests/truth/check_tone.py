#!/usr/bin/env python3
"""tests/truth/check_tone.py - brackets merged and shown, against their scenes: BUILD_DIR

Frames are made here, with the noise of EMVA 1288, of scenes whose light is known; responses,
shifts, histogram adjustment, glare, acuity and colours follow the published equations in
arithmetic of their own (Debevec and Malik 1997; Ward 2003; Ward Larson, Rushmeier and Piatko 1997).
"""
# SPDX-License-Identifier: MIT

import math
import os
import random
import struct
import subprocess
import sys
import tempfile
import zlib
from operator import mul

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from check_pictures_files import jpeg
from harness import Checks, Program
from photographs import read_pfm, read_png

FULL, READ = 20000, 5
LUMINANCE = (0.2126, 0.7152, 0.0722)


def chunk(name, data):
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


def write_png(path, rows, bits, gamma=None):
    """Rows of triples of whole numbers."""
    letter = "H" if bits == 16 else "B"
    lines = b"".join(b"\0" + struct.pack(f">{3 * len(row)}{letter}", *(c for p in row for c in p))
                     for row in rows)
    head = struct.pack(">IIBBBBB", len(rows[0]), len(rows), bits, 2, 0, 0, 0)
    middle = chunk(b"gAMA", struct.pack(">I", round(100000 * gamma))) if gamma else b""
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + middle +
                   chunk(b"IDAT", zlib.compress(lines, 1)) + chunk(b"IEND", b""))


def write_pfm(path, rows):
    """Rows of triples of floats."""
    with open(path, "wb") as file:
        file.write(f"PF\n{len(rows[0])} {len(rows)}\n-1.0\n".encode())
        for row in reversed(rows):
            file.write(struct.pack(f"<{3 * len(row)}f", *(c for p in row for c in p)))


class Tone:
    """lenscalc tone in a folder."""

    def __init__(self, program, checks, folder):
        self.program, self.checks, self.folder = program, checks, folder

    def path(self, name):
        return os.path.join(self.folder, name)

    def run(self, *words, name="out.pfm"):
        """Rows of the picture, and what is said of it."""
        result = subprocess.run(self.program.command + ["tone", *words, "-o", name], text=True,
                                cwd=self.folder, capture_output=True,
                                env=self.program.environment())
        if not self.checks.check(result.returncode == 0, f"tone {words}: {result.stderr}"):
            return None, result.stderr
        read = read_pfm if name.endswith(".pfm") else read_png
        return read(self.path(name)), result.stderr

    def scene(self, rows, name="scene.pfm"):
        write_pfm(self.path(name), rows)
        return name


def luminance(pixel):
    return sum(a * b for a, b in zip(LUMINANCE, pixel))


# -------- a bracket with its noise --------

def check_merge(tone, checks):
    """Merged, each value lies within the noise that the weights give it, and there is no bias."""
    draw = random.Random(1)
    times = (1, 1 / 4, 1 / 16, 1 / 64)
    scene = [[tuple(0.004 * 2 ** (14 * x / 119) * shade for shade in (1, 0.8, 0.6))
              for x in range(120)] for _ in range(50)]
    for number, time in enumerate(times):
        rows = []
        for line in scene:
            row = []
            for pixel in line:
                codes = []
                for light in pixel:
                    mean = FULL * light * time
                    electrons = draw.gauss(mean, math.sqrt(mean)) + draw.gauss(0, READ)
                    codes.append(min(65535, max(0, round(65535 * electrons / FULL))))
                row.append(codes)
            rows.append(row)
        write_png(tone.path(f"noisy-{number}.png"), rows, 16, gamma=1)
    merged, said = tone.run(*(f"noisy-{i}.png={time}" for i, time in enumerate(times)),
                            "--full-well", str(FULL), "--read-noise", str(READ), "--calibrate", "1")
    if merged is None:
        return
    checks.check("2e+04 electrons at white, read noise 5" in said, f"merge: {said}")
    checks.check("differ by more than noise" not in said, f"merge: {said}")
    offs = []
    for line, truth in zip(merged, scene):
        for pixel, lights in zip(line, truth):
            for value, light in zip(pixel, lights):
                above = below = 0
                for time in times:
                    v = light * time
                    keep = 0 if v >= 1 else min(1, (1 - v) / 0.1)
                    weight = keep * time ** 2 / ((1 / 65535) ** 2 / 12 + (READ / FULL) ** 2 + v / FULL)
                    above += keep * weight
                    below += weight
                if below > 0:
                    offs.append((value - light) * below / math.sqrt(above))
    count = len(offs)
    mean = sum(offs) / count
    spread = sum((x - mean) ** 2 for x in offs) / count
    checks.check(count > 17000 and abs(mean) < 0.05, f"merge: {count} values are off by {mean:.3f} of noise")
    checks.check(0.95 < spread < 1.05, f"merge: their variance is {spread:.3f} of what it should be")


def check_rendered(tone, checks):
    """What lenscalc render has exposed, with its noise, is the luminance that it writes itself."""
    card = "render chart:wedge --lens double-gauss-50 -s 2m -N 8 --size 84x28 --samples 4".split()
    for words in (["--radiance", "-t", "1/8", "-o", "truth.pfm"],
                  ["--noise", "--pitch", "6um", "--read-noise", "3", "-t", "2,1/2,1/8,1/30", "-o",
                   "shot.png"]):
        result = tone.program.run(*card, *words, cwd=tone.folder)
        checks.check(result.returncode == 0, f"render: {result.stderr}")
    merged, said = tone.run(*(f"shot-{i}.png" for i in range(1, 5)))
    checks.check("read noise 3" in said and "assumed" not in said, f"render: {said}")
    truth = read_pfm(tone.path("truth.pfm"))
    offs = [a[1] / b[1] - 1 for p, q in zip(merged or [], truth) for a, b in zip(p, q) if b[1] > 1]
    mean = sum(offs) / max(len(offs), 1)
    spread = math.sqrt(sum((x - mean) ** 2 for x in offs) / max(len(offs), 1))
    # steps of 8 bits: half of one is 2 % at code 40
    checks.check(len(offs) > 1500 and abs(mean) < 0.002 and spread < 0.02,
                 f"render: {len(offs)} pixels are off by {mean:.4f} +- {spread:.4f}")


def without_note(path, key):
    """A PNG that does not say so."""
    with open(path, "rb") as file:
        data = file.read()
    kept, at = data[:8], 8
    while at < len(data):
        end = at + 12 + struct.unpack(">I", data[at:at + 4])[0]
        if not data[at + 8:end].startswith(key.encode() + b"\0"):
            kept += data[at:end]
        at = end
    with open(path, "wb") as file:
        file.write(kept)


def check_saturated(tone, checks):
    """A sensor that is full below the file's highest number loses no light of a bracket."""
    card = ["render", "chart:wedge", "--lens", "double-gauss-50", "-s", "2m", "--size", "60x40",
            "--samples", "4"]
    result = tone.program.run(*card, "--radiance", "-t", "1/8", "-o", "truth.pfm", cwd=tone.folder)
    checks.check(result.returncode == 0, f"saturated: {result.stderr}")
    truth = read_pfm(tone.path("truth.pfm"))
    well = ["--noise", "--pitch", "6um", "--full-well", "40000"]
    for words in ([], ["--bits", "16"], ["--black", "500"], ["--response", "mono"],
                  ["--response", "xyz"], ["--response", "xyz", "--bits", "16"],
                  ["--read-noise", "50"], ["--full-well", "30000"], "silent"):
        silent = words == "silent"
        asked = ["--noise", "--pitch", "6um", "--adc", "12"] + (well[3:] if silent else
                 (well[3:] if "--full-well" not in words else []) + words)
        result = tone.program.run(*card, *asked, "-t", "1/2,1/8,1/30,1/125,1/500", "-o", "full.png",
                                  cwd=tone.folder)
        checks.check(result.returncode == 0, f"saturated: {result.stderr}")
        names = [f"full-{i}.png" for i in range(1, 6)]
        for name in names if silent else []:
            without_note(tone.path(name), "Saturation")
        merged, said = tone.run(*names)
        checks.check(("do not say" in said) == silent and "differ by more" not in said,
                     f"saturated {words}: {said}")
        offs = [a[1] / b[1] - 1 for p, q in zip(merged or [], truth) for a, b in zip(p, q) if b[1] > 3]
        mean, worst = sum(offs) / max(1, len(offs)), max(map(abs, offs), default=1)
        checks.check(len(offs) > 500 and abs(mean) < 0.01 and worst < 0.2,
                     f"saturated {words}: {len(offs)} pixels off by {mean:.4f}, {worst:.3f} at most")
    # a patch that nothing saturates is no sensor that is full
    result = tone.program.run(*card, "-t", "1/500,1/2000", "-o", "even.png", cwd=tone.folder)
    _, said = tone.run("even-1.png", "even-2.png")
    checks.check("highest value" not in said, f"saturated, where nothing is: {said}")


def check_whites(tone, checks):
    """
    Frames whose exposures are not as their times: a leaf shutter's, and those behind filters; and
    pictures of light by themselves. All become the luminance that render writes itself.
    """
    card = ("render chart:wedge --lens double-gauss-50 -s 2m -N 4 --size 42x14 --samples 64 --bits 16 "
            "-o").split()
    leaf = ["-t", "1/8,1/125,1/500", "--shutter", "leaf", "--opening-time", "1/800"]
    for words in (["leaf.png"] + leaf, ["plain.png", "-t", "1/30"],
                  ["nd8.png", "-t", "1/30", "--filter", "ND8"],
                  ["nd64.png", "-t", "1/30", "--filter", "ND64"],
                  ["nd8.exr", "-t", "1/30", "--filter", "ND8"],
                  ["nd64.exr", "-t", "1/60", "--filter", "ND64"],
                  ["truth.exr", "--radiance", "-t", "1/8"]):
        result = tone.program.run(*card, *words, cwd=tone.folder)
        checks.check(result.returncode == 0, f"render: {result.stderr}")
    truth, _ = tone.run("truth.exr")
    for names in (["leaf-1.png", "leaf-2.png", "leaf-3.png"], ["plain.png", "nd8.png", "nd64.png"],
                  ["nd8.exr"], ["nd8.exr", "nd64.exr"]):
        merged, said = tone.run(*names)
        checks.check("moved" not in said, f"{names}: {said}")
        offs = [a[1] / b[1] - 1 for p, q in zip(merged or [], truth or []) for a, b in zip(p, q)
                if b[1] > 5]
        worst = max(map(abs, offs), default=1)
        mean = sum(offs) / max(len(offs), 1)
        # a .exr of 16 bits rounds to 2^-11; a leaf shutter that opens lets more into the corners
        limit = 0.02 if names[0] == "leaf-1.png" else 1.5e-3
        checks.check(len(offs) > 200 and worst < limit and abs(mean) < 1e-3,
                     f"{names}: {worst:.4f} off the luminance, {mean:.4f} in the mean")
    _, said = tone.run("nd8.png", "-N", "4")
    checks.check("warning: the f-number knows nothing of the filter" in said, f"filter: {said}")
    timed, _ = tone.run("plain.png", "nd8.png", "--times", "1/30,1/240")
    noted, _ = tone.run("plain.png", "nd8.png")
    same = timed is not None and all(abs(a[1] - b[1]) <= 1e-4 * a[1] for p, q in zip(timed, noted)
                                     for a, b in zip(p, q))
    checks.check(same, "times by the command line are others than the same ones by notes")


# -------- a response --------

def shoulder(light):
    """A camera's response, 0..1 to 0..1: a gamma with a shoulder."""
    return 1.15 * light ** (1 / 1.9) / (1 + 0.15 * light ** (1 / 1.9))


def contrasty(light):
    """A gamma, steeper in the middle."""
    value = light ** (1 / 2.2)
    return value - 0.07 * math.sin(2 * math.pi * value)


def light_of(response, code):
    low, high = 0.0, 1.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if response(middle) < code else (low, middle)
    return low


def check_response(tone, checks):
    """Frames a stop apart, without noise and with that of 10000 electrons."""
    draw = random.Random(5)
    times = [2.0 ** -i for i in range(7)]
    scene = [[tuple(0.01 * 2 ** (10 * (x + y / 60) / 120) * shade for shade in (1, 0.9, 1.1))
              for x in range(120)] for y in range(40)]
    for response, noise in ((shoulder, 0), (contrasty, 0), (shoulder, 1e-4)):
        for number, time in enumerate(times):
            write_png(tone.path(f"camera-{number}.png"),
                      [[tuple(round(255 * response(min(1, max(0, draw.gauss(
                          c * time, math.sqrt(noise * c * time)))))) for c in p) for p in row]
                       for row in scene], 8)
        words = [f"camera-{i}.png={time}" for i, time in enumerate(times)]
        _, said = tone.run(*words, "--response", "debevec", "--curves", "curve.csv", "--calibrate", "1")
        with open(tone.path("curve.csv"), encoding="ascii") as file:
            rows = [list(map(float, line.split(","))) for line in file.read().splitlines()[1:]]
        checks.check(len(rows) == 256, "response: 256 codes")
        middle = ((128 / 255 + 0.055) / 1.055) ** 2.4 / light_of(response, 128 / 255)
        for code, *lights in rows[16 if noise else 10:251]:
            truth = light_of(response, code / 255) * middle
            checks.check(all(abs(light / truth - 1) < 0.01 for light in lights),
                         f"response {response.__name__} {noise}: code {code} is {lights}, not {truth}")
        checks.check("warning: the response" not in said, f"response: {said}")


# -------- a camera that moves --------

def check_shift(tone, checks):
    draw = random.Random(3)
    blobs = [(draw.uniform(0, 220), draw.uniform(0, 160), draw.uniform(4, 16), draw.uniform(0.02, 4))
             for _ in range(40)]

    def light(x, y):
        return 0.02 + sum(b * math.exp(-((x - u) ** 2 + (y - v) ** 2) / r ** 2) for u, v, r, b in blobs)

    for number, (time, right, down) in enumerate(((1 / 4, 0, 0), (1, 7, -5), (1 / 16, -12, 9))):
        write_png(tone.path(f"hand-{number}.png"),
                  [[(round(255 * min(1, light(x - right, y - down) * time) ** 0.5),) * 3
                    for x in range(220)] for y in range(160)], 8, gamma=0.5)
    words = ["hand-0.png=1/4", "hand-1.png=1", "hand-2.png=1/16", "--calibrate", "1"]
    still, said = tone.run(*words)
    checks.check("the camera has moved: hand-1.png lies 7 pixels to the right of hand-0.png and -5 "
                 "below" in said and "hand-2.png lies -12 pixels" in said, f"shift: {said}")
    checks.check("frames differ by more than noise" in said, f"shift: {said}")
    moved, said = tone.run(*words, "--align")
    checks.check("has moved" not in said and "by more than noise" not in said, f"shift: {said}")
    if moved is None or still is None:
        return
    off = [abs(moved[y][x][1] / light(x, y) - 1) for y in range(160) for x in range(220)]
    off.sort()
    checks.check(off[len(off) * 98 // 100] < 0.05, f"shift: {off[len(off) * 98 // 100]:.3f} off")


# -------- what a camera says --------

def with_exif(picture, order, time, fnumber=(28, 10), iso=200):
    """A JPEG that says how it was exposed, as Exif 2.3 has it."""
    def entry(tag, kind, value):
        packed = struct.pack(order + "H", value) + b"\0\0" if kind == 3 else struct.pack(order + "I", value)
        return struct.pack(order + "HHI", tag, kind, 1) + packed

    # the header, a folder of one entry, one of three, two fractions
    mark = b"II*\0" if order == "<" else b"MM\0*"
    tiff = (mark + struct.pack(order + "I", 8) +
            struct.pack(order + "H", 1) + entry(34665, 4, 26) + b"\0\0\0\0" +
            struct.pack(order + "H", 3) + entry(33434, 5, 68) + entry(33437, 5, 76) +
            entry(34855, 3, iso) + b"\0\0\0\0" + struct.pack(order + "4I", *time, *fnumber))
    body = b"Exif\0\0" + tiff
    return picture[:2] + b"\xff\xe1" + struct.pack(">H", len(body) + 2) + body + picture[2:]


def check_exif(tone, checks):
    """Times of both orders of bytes; luminance by them; damaged ones are no times."""
    def light(code):
        value = code / 255
        return value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4

    def write(name, data):
        with open(tone.path(name), "wb") as file:
            file.write(data)

    plain = jpeg([100, 180])
    write("a.jpg", with_exif(plain, "<", (1, 60)))
    write("b.jpg", with_exif(plain, ">", (1, 60)))
    for name in ("a.jpg", "b.jpg"):
        made, said = tone.run(name)
        checks.check("f/2.8, ISO 200" in said, f"Exif: {said}")
        wanted = light(180) * 78 / 200 / math.sqrt(2) * 2.8 ** 2 / (0.65 / 60)
        checks.check(made is not None and abs(luminance(made[4][12]) / wanted - 1) < 1e-5,
                     f"Exif: {made and made[4][12]}, not {wanted}")
    # a frame of twice the ISO speed and half the time has the same light: so has the merged one
    write("b.jpg", with_exif(plain, ">", (1, 120), iso=400))
    made, _ = tone.run("a.jpg", "b.jpg")
    checks.check(made is not None and abs(luminance(made[4][12]) / wanted - 1) < 1e-5,
                 f"Exif: {made and made[4][12]}, not {wanted}")
    whole = with_exif(plain, "<", (1, 60))
    end = whole.index(b"\xff\xdb")
    for cut in range(12, end - 4, 3):  # the segment ends early
        body = whole[6:6 + cut]
        write("cut.jpg", whole[:4] + struct.pack(">H", len(body) + 2) + body + whole[end:])
        made, said = tone.run("cut.jpg", "--calibrate", "1")
        checks.check(made is not None, f"Exif cut to {cut}: {said}")
    write("cut.jpg", with_exif(plain, "<", (1, 0)))
    result = tone.program.run("tone", "cut.jpg", "a.jpg", "-o", "lost.png", cwd=tone.folder)
    checks.check(result.returncode == 2 and b"nothing says how long cut.jpg was exposed" in result.stderr,
                 f"Exif without a time: {result.stderr}")


# -------- histogram adjustment --------

def foveal(rows, degrees):
    """Means of one degree, and how large they are on the plane at distance 1."""
    height, width = len(rows), len(rows[0])
    wide = 2 * math.tan(math.radians(degrees) / 2)
    across = round(wide / math.radians(1))
    down = round(wide * height / width / math.radians(1))
    cells = []
    for r in range(down):
        for c in range(across):
            part = [rows[y][x] for y in range(r * height // down, (r + 1) * height // down)
                    for x in range(c * width // across, (c + 1) * width // across)]
            cells.append(tuple(sum(p[k] for p in part) / len(part) for k in range(3)))
    return cells, across, down, (wide / across, wide * height / width / down)


def threshold(light):
    """Ferwerda and others 1996."""
    x = math.log10(light)
    if x < -3.94:
        power = -2.86
    elif x < -1.44:
        power = (0.405 * x + 1.6) ** 2.18 - 2.86
    elif x < -0.0184:
        power = x - 0.395
    elif x < 1.9:
        power = (0.249 * x + 0.65) ** 2.7 - 0.72
    else:
        power = x - 1.255
    return 10 ** power


class Adjusted:
    """The histogram adjustment of Ward Larson, Rushmeier and Piatko, bin by bin."""

    def __init__(self, samples, least, most, human):
        self.logs = [math.log(max(s, 1e-4)) for s in samples]
        self.low, self.high = min(self.logs), max(self.logs)
        self.least, self.most = least, most
        self.bins = [0.0] * 100
        for b in self.logs:
            self.bins[min(99, int(100 * (b - self.low) / (self.high - self.low)))] += 1
        self.total = len(samples)
        step, span = (self.high - self.low) / 100, math.log(most / least)
        trimmed = math.inf
        while trimmed > 0.025 * self.total:
            whole = sum(self.bins)
            if whole < 0.025 * self.total:
                return  # linear
            trimmed, ceilings = 0, []
            for i in range(100):
                ceiling = whole * step / span
                if human:
                    world = math.exp(self.low + (i + 0.5) * step)
                    display = self.shown(world)
                    ceiling *= threshold(display) / threshold(world) * world / display
                ceilings.append(ceiling)
            for i, ceiling in enumerate(ceilings):
                trimmed += max(0, self.bins[i] - ceiling)
                self.bins[i] = min(self.bins[i], ceiling)

    def shown(self, light):
        place = 100 * (math.log(light) - self.low) / (self.high - self.low)
        if place <= 0:
            return self.least
        if place >= 100:
            return self.most
        i = min(99, int(place))
        share = (sum(self.bins[:i]) + (place - i) * self.bins[i]) / sum(self.bins)
        return self.least * (self.most / self.least) ** share


def uneven_scene(scale):
    """Five decades: dark walls, a lit table, a window, a lamp."""
    rows = []
    for y in range(96):
        row = []
        for x in range(144):
            light = 0.002 + 0.001 * math.sin(x / 5) * math.cos(y / 7) + 0.00002 * x
            if y > 60:
                light *= 40
            if 90 < x < 130 and 10 < y < 45:
                light = 30 + 10 * math.sin(x / 3)
            if (x - 40) ** 2 + (y - 30) ** 2 < 30:
                light = 400
            row.append(tuple(scale * light * shade for shade in (1, 0.95, 0.8)))
        rows.append(row)
    return rows


def check_ward(tone, checks):
    for scale, human in ((10, False), (10, True), (2, True)):
        scene = uneven_scene(scale)
        tone.scene(scene)
        words = ["scene.pfm", "--operator", "ward", "--fov", "60", "--display", "0.5,200"]
        shown, said = tone.run(*words, "--ceiling", "human" if human else "linear")
        if shown is None:
            return
        cells = [luminance(c) for c in foveal(scene, 60)[0]]
        truth = Adjusted(cells, 0.5, 200, human)
        # single precision rounds what lies at the edge of a bin: one sample of 69 x 46
        worst = max(abs(math.log(luminance(a) / truth.shown(luminance(b))))
                    for p, q in zip(shown, scene) for a, b in zip(p, q))
        checks.check(worst < 0.01, f"ward {scale} {human}: off by {worst:.4f}")
        checks.check("ward: " in said, f"ward: {said}")
        pairs = sorted({(luminance(b), luminance(a)) for p, q in zip(shown, scene)
                        for a, b in zip(p, q)})
        checks.check(all(b[1] >= a[1] * (1 - 1e-5) for a, b in zip(pairs, pairs[1:])),
                     "ward: not monotone")
        if not human:
            steps = [(a, b) for a in pairs[::40] for b in pairs[::40] if b[0] > 1.2 * a[0]]
            steepest = max(math.log(b[1] / a[1]) / math.log(b[0] / a[0]) for a, b in steps)
            most = 1 / (1 - 0.025 * truth.total / sum(truth.bins))  # what the last pass may cut
            checks.check(0.9 < steepest < most, f"ward: slope {steepest:.3f}, at most {most:.3f}")
        checks.check(abs(pairs[0][1] - 0.5) < 1e-3 and abs(pairs[-1][1] - 200) < 0.2,
                     f"ward: ends {pairs[0][1]} {pairs[-1][1]}")
    # all luminances alike often: the ceiling holds everywhere, and most of the area is kept
    tone.scene([[(0.01 * 10 ** (5 * (x + y / 40) / 121),) * 3 for x in range(120)] for y in range(40)])
    shown, _ = tone.run("scene.pfm", "--operator", "ward", "--display", "1,100")
    row = [p[1] for p in shown[20]]
    slopes = [math.log(b / a) / math.log(10 ** (25 / 121)) for a, b in zip(row, row[5:])]
    checks.check(max(slopes) < 1.01 and min(slopes) > 0.25, f"ward: slopes {min(slopes)} to {max(slopes)}")
    tone.scene([[(3.0, 3.0, 3.0)] * 60] * 40)
    shown, said = tone.run("scene.pfm", "--operator", "ward", "--display", "1,100")
    checks.check(shown is not None and "linear" in said and
                 all(abs(c - 10) < 1e-4 for row in shown for p in row for c in p),
                 f"ward: one luminance does not fall back to linear: {said}")


# -------- the eye --------

def weights_of(across, down, cell):
    """cos t/t^2 for t between the middles of each two cells."""
    directions = []
    for i in range(across * down):
        x = cell[0] * (i % across + 0.5 - across / 2)
        y = cell[1] * (i // across + 0.5 - down / 2)
        n = math.sqrt(x * x + y * y + 1)
        directions.append((x / n, y / n, 1 / n))
    rows = []
    for i, (x, y, z) in enumerate(directions):
        cosines = [x * u + y * v + z * w for u, v, w in directions]
        cosines[i] = 0
        rows.append([cosine / math.acos(min(1, cosine)) ** 2 if cosine > 0 else 0
                     for cosine in cosines])
    return rows


def times(row, numbers):
    return sum(map(mul, row, numbers))


def balance_of(weights):
    """d of each cell, so that d_i d_j w_ij sum up to 1."""
    d = [1.0] * len(weights)
    for _ in range(12):
        d = [math.sqrt(here / times(row, d)) for here, row in zip(d, weights)]
    return d


def check_glare(tone, checks):
    """Light is kept; the veil is the balanced one, and about what the paper's equation gives."""
    scene = uneven_scene(10)
    tone.scene(scene)
    veiled, _ = tone.run("scene.pfm", "--glare", "--fov", "30")
    if veiled is None:
        return
    for k in range(3):
        before = sum(p[k] for row in scene for p in row)
        after = sum(p[k] for row in veiled for p in row)
        checks.check(abs(after / before - 1) < 1e-5, f"glare: {after / before - 1:.1e} of channel {k}")
    cells, across, down, cell = foveal(scene, 30)
    weights, light = weights_of(across, down, cell), [c[1] for c in cells]
    d = balance_of(weights)
    balanced = [0.087 * here * times(row, map(mul, d, light))
                for here, row in zip(d, weights)]
    # divided by the sum at the receiver, where light gets lost at the edges
    published = [0.087 * times(row, light) / sum(row) for row in weights]
    width, height = len(scene[0]), len(scene)
    near, far = [], []
    for r in range(3, down - 3):
        for c in range(3, across - 3):
            x, y = int((c + 0.5) * width / across), int((r + 0.5) * height / down)
            mine = veiled[y][x][1] - 0.913 * scene[y][x][1]
            # between the middles of cells in straight lines
            u, v = (x + 0.5) * across / width - 0.5, (y + 0.5) * down / height - 0.5
            i, u, v = int(v) * across + int(u), u - int(u), v - int(v)
            near.append(mine / sum(share * balanced[i + at] for share, at in (
                ((1 - u) * (1 - v), 0), (u * (1 - v), 1), ((1 - u) * v, across),
                (u * v, across + 1))))
            far.append(mine / published[r * across + c])
    # as a whole it has the light of the pixels, not of the cells
    near.sort()
    middle = near[len(near) // 2]
    checks.check(abs(middle - 1) < 0.02, f"glare: {middle:.4f} of the balanced veil")
    checks.check(near[0] > 0.998 * middle and near[-1] < 1.002 * middle,
                 f"glare: {near[0]:.4f} to {near[-1]:.4f} of the balanced veil")
    far.sort()
    for share, low, high in ((0.05, 0.9, 1), (0.5, 0.93, 1.07), (0.95, 0.96, 1.03)):
        found = far[int(share * len(far))]
        checks.check(low < found < high, f"glare: {found:.3f} of the published veil at {share}")
    tone.scene([[(5.0, 4.0, 3.0)] * 90] * 60)
    even, _ = tone.run("scene.pfm", "--glare")
    worst = max(abs(c / d - 1) for row in even for p in row for c, d in zip(p, (5, 4, 3)))
    checks.check(worst < 0.002, f"glare: an even picture changes by {worst:.4f}")


XYZ = ((0.4124, 0.3576, 0.1805), (0.2126, 0.7152, 0.0722), (0.0193, 0.1192, 0.9505))


def scotopic(pixel):
    x, y, z = (sum(a * b for a, b in zip(row, pixel)) for row in XYZ)
    return y * (1.33 * (1 + (y + z) / x) - 1.68)


def check_colours(tone, checks):
    """Of rods alone below 0.0056 cd/m2, of cones above 5.6, in between by the luminance."""
    pixels = [tuple(light * c for c in colour) for light in (1e-4, 0.003, 0.1, 2, 5, 7, 100)
              for colour in ((1, 1, 1), (1, 0.2, 0.1), (0.1, 0.3, 1), (0.2, 1, 0.3))]
    tone.scene([pixels] * 2)
    faded, _ = tone.run("scene.pfm", "--color-loss")
    for pixel, made in zip(pixels, faded[0] if faded else []):
        share = min(1, max(0, (luminance(pixel) - 0.0056) / (5.6 - 0.0056)))
        grey = scotopic(pixel) / scotopic((1, 1, 1))
        for a, b in zip(made, pixel):
            wanted = share * b + (1 - share) * grey
            checks.check(abs(a - wanted) <= 1e-5 * wanted, f"color loss of {pixel}: {made}")


def check_acuity(tone, checks):
    """A grating that the eye resolves stays, one that is far too fine for it becomes grey."""
    for light in (0.001, 0.01, 1000):
        finest = 17.25 * math.atan(1.4 * math.log10(light) + 0.35) + 25.72
        for relative in (0.2, 4):
            degree = 16 * finest * relative if relative > 1 else 4 * finest  # pixels
            period = max(4, round(degree / (finest * relative)))
            degree = period * finest * relative
            width = 256
            angle = 2 * math.degrees(math.atan(width / degree * math.radians(1) / 2))
            row = [(light * (1 + 0.5 * math.sin(2 * math.pi * (x + 0.5) / period)),) * 3
                   for x in range(width)]
            tone.scene([row] * 64)
            made, _ = tone.run("scene.pfm", "--acuity", "--fov", f"{angle:.6f}")
            if made is None:
                return
            values = [p[1] for p in made[32][64:192]]
            contrast = (max(values) - min(values)) / light
            checks.check(contrast > 0.8 if relative < 1 else contrast < 0.2,
                         f"acuity: {light} cd/m2, {relative} of the finest grating: {contrast:.3f}")


def check_blur(tone, checks):
    """
    A cycle of the finest grating becomes two samples: of waves four times as long, of 32 pixels,
    means of 4 pixels, whose middles lie 22.5 degrees beside the crests; straight lines between.
    """
    light, period, width = 1000, 32, 256
    finest = 17.25 * math.atan(1.4 * math.log10(light) + 0.35) + 25.72
    degree = period * finest / 4  # pixels
    angle = 2 * math.degrees(math.atan(width / degree * math.radians(1) / 2))
    row = [(light * (1 + 0.5 * math.sin(2 * math.pi * (x + 0.5) / period)),) * 3 for x in range(width)]
    tone.scene([row] * 64)
    made, _ = tone.run("scene.pfm", "--acuity", "--fov", f"{angle:.9f}")
    if made is None:
        return
    turn = math.pi / period  # half a pixel
    mean = math.sin(4 * turn) / (4 * math.sin(turn))
    worst = 0
    for x in range(width // 4 + 2, 3 * width // 4, 4):
        waves = [math.sin(2 * math.pi * at / period) * mean for at in (x, x + 4)]
        for i in range(4):
            expected = light * (1 + 0.5 * (waves[0] + (i + 0.5) / 4 * (waves[1] - waves[0])))
            worst = max(worst, abs(made[32][x + i][1] / expected - 1))
    values = [p[1] for p in made[32][64:192]]
    contrast = (max(values) - min(values)) / light
    checks.check(abs(contrast - mean * math.cos(math.radians(22.5))) < 0.01, f"blur: {contrast:.4f}")
    checks.check(worst < 1e-4, f"blur: off by {worst:.2e}")


RAMP = ((10, 8, 36), (62, 18, 106), (142, 36, 106), (214, 78, 62), (248, 154, 34), (253, 247, 190))


def check_falsecolour(tone, checks):
    """The nearest place on the scale is the luminance's, to half a step of the scale."""
    scene = [[(10 ** (-1 + 4 * (x + 0.3 * y) / 106),) * 3 for x in range(100)] for y in range(20)]
    tone.scene(scene)
    shown, said = tone.run("scene.pfm", "--falsecolor", "--scale", "0.1,1000", name="out.png")
    if shown is None:
        return
    checks.check("from 0.1 to 1000 cd/m2" in said, f"falsecolor: {said}")
    scale = []
    for i in range(2001):
        place = min(4.9999, 5 * i / 2000)
        a, b = RAMP[int(place)], RAMP[int(place) + 1]
        scale.append(tuple(p + (place - int(place)) * (q - p) for p, q in zip(a, b)))
    worst = 0
    for row, truth in zip(shown, scene):
        for pixel, light in zip(row[:100:7], truth[::7]):
            best = min(range(2001), key=lambda i: sum((a - b) ** 2 for a, b in zip(scale[i], pixel)))
            worst = max(worst, abs(-1 + 4 * best / 2000 - math.log10(light[0])))
    checks.check(worst < 0.02, f"falsecolor: reads back {worst:.3f} decades off")
    checks.check(len(shown[0]) > 110, "falsecolor: a scale stands beside it")


# -------- simple operators --------

def hable(x):
    a, b, c, d, e, f = 0.15, 0.5, 0.1, 0.2, 0.02, 0.3
    return (x * (a * x + c * b) + d * e) / (x * (a * x + b) + d * f) - e / f


def check_operators(tone, checks):
    scene = [[(0.01 * 1.06 ** x,) * 3 for x in range(200)] for _ in range(20)]
    tone.scene(scene)
    for operator, white, curve in (("linear", 50, lambda s: s), ("gamma", 300, lambda s: s ** (1 / 2.2)),
                                   ("filmic", 80, lambda s: hable(11.2 * s) / hable(11.2))):
        shown, _ = tone.run("scene.pfm", "--operator", operator, "--white", str(white), "--display",
                            "0.5,100")
        for made, pixel in zip(shown[7] if shown else [], scene[7]):
            wanted = min(100, max(0.5, 100 * curve(pixel[0] / white)))
            checks.check(abs(made[0] - wanted) < 1e-4 * wanted, f"{operator}: {pixel} {made} {wanted}")
    # white by itself: even light becomes a middle grey, 18 % of the display's
    tone.scene([[(37.0,) * 3 for _ in range(20)] for _ in range(20)])
    for operator, white in (("linear", 37 / 0.18), ("gamma", 37 / 0.18 ** 2.2), ("filmic", 37 * 5.6 / 0.18)):
        shown, said = tone.run("scene.pfm", "--operator", operator)
        checks.check(f"{operator}: {white:.4g} cd/m2 become white" in said, f"{operator}: {said}")
        if operator != "filmic" and shown:
            checks.check(abs(shown[3][3][1] - 18) < 0.02, f"{operator}: {shown[3][3]}, not 18")


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory(prefix="lenscalc-tone-") as folder:
        tone = Tone(Program(sys.argv[1]), checks, folder)
        for check in (check_merge, check_rendered, check_saturated, check_whites, check_response, check_shift, check_exif,
                      check_ward, check_glare, check_colours, check_acuity, check_blur,
                      check_falsecolour, check_operators):
            check(tone, checks)
    checks.finish()


if __name__ == "__main__":
    main()
