#!/usr/bin/env python3
"""tests/truth/check_pictures_files.py - files of pictures against a reader and a writer of their own:
check_pictures_files.py BUILD_DIR

What build/unit/test_pictures writes is taken apart here with zlib and struct alone and must hold
the pixels that are known; files of all kinds made here must be read to their pixels.
"""
# SPDX-License-Identifier: MIT

import os
import struct
import subprocess
import sys
import tempfile
import zlib

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks

WIDTH, HEIGHT = 37, 21
NOTES = {"Lens": "double-gauss", "Place": "fünf"}


def known(width, height, channels):
    """Rows of values, as test_pictures makes them."""
    return [[(x // 5 * 7 + y * 13 + k * 29) % 101 / 100 for x in range(width)
             for k in range(channels)] for y in range(height)]


def srgb(light):
    return 12.92 * light if light <= 0.0031308 else 1.055 * light ** (1 / 2.4) - 0.055


def light(value):
    return value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4


# -------- PNG --------

def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def paeth(left, above, corner):
    estimate = left + above - corner
    return min((abs(estimate - left), 0, left), (abs(estimate - above), 1, above),
               (abs(estimate - corner), 2, corner))[2]


def foretold(kind, left, above, corner):
    return (0, left, above, (left + above) // 2, paeth(left, above, corner))[kind]


def unfilter(data, height, row, pixel):
    rows, before = [], bytes(row)
    for y in range(height):
        kind, line = data[y * (row + 1)], bytearray(data[y * (row + 1) + 1:(y + 1) * (row + 1)])
        for i in range(row):
            left, corner = (line[i - pixel], before[i - pixel]) if i >= pixel else (0, 0)
            line[i] = (line[i] + foretold(kind, left, before[i], corner)) & 255
        rows.append(bytes(line))
        before = bytes(line)
    return rows


def filtered(rows, pixel, kinds):
    """The rows with filter kinds[y % n]."""
    out, before = bytearray(), None
    for y, line in enumerate(rows):
        before = before or bytes(len(line))
        kind = kinds[y % len(kinds)]
        out.append(kind)
        for i, byte in enumerate(line):
            left, corner = (line[i - pixel], before[i - pixel]) if i >= pixel else (0, 0)
            out.append((byte - foretold(kind, left, before[i], corner)) & 255)
        before = line
    return bytes(out)


def read_png(data):
    """(width, height, bits, colour type, rows of codes, chunks by type)"""
    chunks, at = {}, 8
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    while at < len(data):
        count, kind = struct.unpack_from(">I4s", data, at)
        body = data[at + 8:at + 8 + count]
        assert struct.unpack_from(">I", data, at + 8 + count)[0] == zlib.crc32(kind + body)
        chunks.setdefault(kind, []).append(body)
        at += 12 + count
    width, height, bits, color, *rest = struct.unpack(">IIBBBBB", chunks[b"IHDR"][0])
    assert rest == [0, 0, 0] and chunks[b"IEND"] == [b""]
    pixel = {0: 1, 2: 3, 4: 2, 6: 4}[color] * bits // 8
    rows = unfilter(zlib.decompress(b"".join(chunks[b"IDAT"])), height, width * pixel, pixel)
    form = ">%d%s" % (len(rows[0]) * 8 // bits, "H" if bits == 16 else "B")
    return width, height, bits, color, [struct.unpack(form, row) for row in rows], chunks


def check_png(checks, name, data):
    width, height, bits, color, rows, chunks = read_png(data)
    channels = {0: 1, 4: 2, 2: 3, 6: 4}[color]
    is_light = name in ("color8.png", "alpha16.png", "stored8.png")
    most = 2 ** bits - 1
    expected = [[int((srgb(v) if is_light and not (channels % 2 == 0 and i % channels ==
                                                   channels - 1) else v) * most + 0.5)
                 for i, v in enumerate(row)] for row in known(width, height, channels)]
    # the values are floats, so that one in the middle may go either way
    worst = max(abs(a - b) for got, row in zip(rows, expected) for a, b in zip(got, row))
    different = sum(a != b for got, row in zip(rows, expected) for a, b in zip(got, row))
    checks.check((width, height, bits) == (WIDTH, HEIGHT, 16 if "16" in name else 8),
                 f"{name}: {width} x {height}, {bits} bits")
    checks.check(worst <= 1 and different <= 0.02 * width * height * channels,
                 f"{name}: {different} codes differ, by {worst}")
    checks.check((b"sRGB" in chunks) == is_light, f"{name}: sRGB")
    checks.check(chunks[b"gAMA"] == [struct.pack(">I", 45455 if is_light else 100000)],
                 f"{name}: gAMA {chunks[b'gAMA']}")
    texts = [chunks[b"tEXt"][0].split(b"\0"), chunks[b"iTXt"][0].split(b"\0")]
    checks.check(texts == [[b"Lens", b"double-gauss"],
                           [b"Place", b"", b"", b"", b"", "fünf".encode()]],
                 f"{name}: texts {texts}")


def png(width, height, bits, color, data, extra=b"", interlaced=0):
    head = struct.pack(">IIBBBBB", width, height, bits, color, 0, 0, interlaced)
    packed = zlib.compress(data)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + extra + chunk(b"IDAT", packed[:7]) +
            chunk(b"IDAT", packed[7:]) + chunk(b"IEND", b""))


def pack_codes(codes, bits):
    if bits == 16:
        return struct.pack(">%dH" % len(codes), *codes)
    number = "".join(format(code, f"0{bits}b") for code in codes)
    number += "0" * (-len(number) % 8)
    return int(number, 2).to_bytes(len(number) // 8, "big")


SAMPLES = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}


def codes_of(width, height, bits, samples, most=None):
    most = 2 ** bits - 1 if most is None else most
    return [[(x * 31 + y * 57 + k * 91 + x * y) % (most + 1) for x in range(width)
             for k in range(samples)] for y in range(height)]


def adam7(rows, width, height, samples):
    """The seven pictures of an interlaced one."""
    for x0, y0, dx, dy in ((0, 0, 8, 8), (4, 0, 8, 8), (0, 4, 4, 8), (2, 0, 4, 4), (0, 2, 2, 4),
                           (1, 0, 2, 2), (0, 1, 1, 2)):
        part = [[rows[y][x * samples + k] for x in range(x0, width, dx) for k in range(samples)]
                for y in range(y0, height, dy)]
        if part and part[0]:
            yield part


def png_cases():
    """(name, file, how to read, channels, values)"""
    palette = [((i * 37) % 256, (i * 91 + 5) % 256, 255 - i) for i in range(256)]
    for color, depths in ((0, (1, 2, 4, 8, 16)), (2, (8, 16)), (3, (1, 2, 4, 8)), (4, (8, 16)),
                          (6, (8, 16))):
        for bits in depths:
            for interlaced in (0, 1):
                width, height, samples = 13, 9, SAMPLES[color]
                rows = codes_of(width, height, bits, samples)
                pixel = max(1, samples * bits // 8)
                parts = adam7(rows, width, height, samples) if interlaced else [rows]
                data = b"".join(filtered([pack_codes(row, bits) for row in part], pixel,
                                         (0, 1, 2, 3, 4)) for part in parts)
                extra, values = b"", [v / (2 ** bits - 1) for row in rows for v in row]
                if color == 3:
                    count = 2 ** bits
                    extra = chunk(b"PLTE", b"".join(bytes(c) for c in palette[:count]))
                    extra += chunk(b"tRNS", bytes([7, 200]))
                    values = [v / 255 for row in rows for code in row
                              for v in (*palette[code], (7, 200)[code] if code < 2 else 255)]
                name = f"png colour {color}, {bits} bits" + (", interlaced" if interlaced else "")
                yield (name, png(width, height, bits, color, data, extra, interlaced), "codes",
                       {3: 4}.get(color, samples), values)
    rows = codes_of(16, 16, 8, 1)
    data = filtered([bytes(row) for row in rows], 1, (0,))
    flat = [v / 255 for row in rows for v in row]
    yield "png, sRGB is meant", png(16, 16, 8, 0, data), "light", 1, [light(v) for v in flat]
    gamma = chunk(b"gAMA", struct.pack(">I", 50000))
    yield "png, gAMA 1/2", png(16, 16, 8, 0, data, gamma), "light", 1, [v * v for v in flat]
    yield ("png, gAMA beside sRGB", png(16, 16, 8, 0, data, gamma + chunk(b"sRGB", b"\0")),
           "light", 1, [light(v) for v in flat])
    key = chunk(b"tRNS", struct.pack(">H", rows[0][3]))
    yield ("png, one shade is clear", png(16, 16, 8, 0, data, key), "codes", 2,
           [v for row in rows for code in row for v in (code / 255, code != rows[0][3])])
    yield ("png, too few colours", png(16, 16, 8, 3, data, chunk(b"PLTE", bytes(3 * 200))), "codes",
           "PNG: a pixel of colour ", None)


# -------- floats --------

def read_pfm(data):
    kind, size, scale, body = data.split(b"\n", 3)
    width, height = map(int, size.split())
    channels = {b"PF": 3, b"Pf": 1}[kind]
    order = "<" if float(scale) < 0 else ">"
    values = struct.unpack(f"{order}{width * height * channels}f", body)
    rows = [list(values[y * width * channels:(y + 1) * width * channels]) for y in range(height)]
    return width, height, channels, rows[::-1]


def read_radiance(data):
    head, _, rest = data.partition(b"\n\n")
    size, _, body = rest.partition(b"\n")
    assert head.startswith(b"#?RADIANCE\n") and b"FORMAT=32-bit_rle_rgbe" in head
    words = size.split()
    assert words[0] == b"-Y" and words[2] == b"+X"
    height, width, at, rows = int(words[1]), int(words[3]), 0, []
    for _ in range(height):
        assert body[at:at + 4] == bytes([2, 2, width >> 8, width & 255])
        at, planes = at + 4, []
        for _ in range(4):
            plane = bytearray()
            while len(plane) < width:
                count = body[at]
                if count > 128:
                    plane += body[at + 1:at + 2] * (count - 128)
                    at += 2
                else:
                    plane += body[at + 1:at + 1 + count]
                    at += 1 + count
            assert len(plane) == width
            planes.append(plane)
        rows.append([planes[k][x] * 2.0 ** (planes[3][x] - 136) if planes[3][x] else 0.0
                     for x in range(width) for k in range(3)])
    assert at == len(body)
    notes = [line[2:].decode() for line in head.split(b"\n") if line.startswith(b"# ")]
    return width, height, 3, rows, dict(note.split(": ", 1) for note in notes)


FORMS = {0: "I", 1: "e", 2: "f"}


def merged(data):
    """Undo OpenEXR's differences and halves."""
    data = bytearray(data)
    for i in range(1, len(data)):
        data[i] = (data[i] + data[i - 1] - 128) & 255
    half, out = (len(data) + 1) // 2, bytearray(len(data))
    out[0::2], out[1::2] = data[:half], data[half:]
    return bytes(out)


def parted(data):
    out = bytearray(data[0::2] + data[1::2])
    for i in range(len(out) - 1, 0, -1):
        out[i] = (out[i] - out[i - 1] + 128) & 255
    return bytes(out)


def read_exr(data):
    """(width, height, [(name, form)], rows of {name: values}, attributes)"""
    assert struct.unpack_from("<II", data) == (20000630, 2)
    at, attributes = 8, {}
    while data[at]:
        name, kind = data[at:].split(b"\0", 2)[:2]
        at += len(name) + len(kind) + 2
        count = struct.unpack_from("<I", data, at)[0]
        attributes[name.decode()] = (kind.decode(), data[at + 4:at + 4 + count])
        at += 4 + count
    at += 1
    channels, rest = [], attributes["channels"][1]
    while rest[0]:
        name, _, rest = rest.partition(b"\0")
        form, _, across, down = struct.unpack_from("<IIII", rest)
        assert (across, down) == (1, 1)
        channels.append((name.decode(), FORMS[form]))
        rest = rest[16:]
    assert rest == b"\0" and [c[0] for c in channels] == sorted(c[0] for c in channels)
    x0, y0, x1, y1 = struct.unpack("<4i", attributes["dataWindow"][1])
    assert attributes["displayWindow"] == attributes["dataWindow"]
    width, height = x1 - x0 + 1, y1 - y0 + 1
    packing = attributes["compression"][1][0]
    per_block = 16 if packing == 3 else 1
    blocks = (height + per_block - 1) // per_block
    rows, end = [], at + 8 * blocks
    for block in range(blocks):
        place = struct.unpack_from("<Q", data, at + 8 * block)[0]
        assert place == end
        y, count = struct.unpack_from("<iI", data, place)
        assert y == y0 + block * per_block
        body, end = data[place + 8:place + 8 + count], place + 8 + count
        lines = min(per_block, height - block * per_block)
        plain = lines * width * sum(struct.calcsize(form) for _, form in channels)
        if packing and count < plain:
            body = merged(zlib.decompress(body))
        assert len(body) == plain
        for _ in range(lines):
            row = {}
            for name, form in channels:
                size = width * struct.calcsize(form)
                row[name] = struct.unpack(f"<{width}{form}", body[:size])
                body = body[size:]
            rows.append(row)
    assert end == len(data)
    return width, height, channels, rows, attributes


def exr(width, height, channels, packing, turned=False, origin=(0, 0)):
    """A file of [(name, form, value of x and y)], and its values in the order of the names."""
    def attribute(name, kind, body):
        return name + b"\0" + kind + b"\0" + struct.pack("<I", len(body)) + body
    form_numbers = {form: number for number, form in FORMS.items()}
    listing = b"".join(name.encode() + b"\0" + struct.pack("<IIII", form_numbers[form], 0, 1, 1)
                       for name, form, _ in channels) + b"\0"
    window = struct.pack("<4i", *origin, origin[0] + width - 1, origin[1] + height - 1)
    head = (struct.pack("<II", 20000630, 2) + attribute(b"channels", b"chlist", listing) +
            attribute(b"compression", b"compression", bytes([packing])) +
            attribute(b"dataWindow", b"box2i", window) +
            attribute(b"displayWindow", b"box2i", window) +
            attribute(b"lineOrder", b"lineOrder", bytes([turned])) +
            attribute(b"owner", b"string", b"nobody") + b"\0")
    per_block = 16 if packing == 3 else 1
    blocks = []
    for first in range(0, height, per_block):
        body = b"".join(struct.pack(f"<{width}{form}", *(value(x, y) for x in range(width)))
                        for y in range(first, min(first + per_block, height))
                        for _, form, value in channels)
        packed = body
        if packing == 1:
            packed = runs(parted(body))
        elif packing:
            packed = zlib.compress(parted(body))
        packed = min(body, packed, key=len)  # of the same length it counts as plain
        blocks.append(struct.pack("<iI", first + origin[1], len(packed)) + packed)
    order = range(len(blocks))
    places, at = {}, len(head) + 8 * len(blocks)
    for i in (reversed(order) if turned else order):
        places[i] = at
        at += len(blocks[i])
    return (head + b"".join(struct.pack("<Q", places[i]) for i in order) +
            b"".join(blocks[i] for i in sorted(order, key=places.get)))


def runs(data):
    out, at = bytearray(), 0
    while at < len(data):
        count = 1
        while at + count < len(data) and count < 127 and data[at + count] == data[at]:
            count += 1
        if count > 2:
            out += bytes([count - 1, data[at]])
        else:
            count = min(5, len(data) - at)
            out += bytes([256 - count]) + data[at:at + count]
        at += count
    return bytes(out)


def float_cases():
    def ramp(scale):
        return lambda x, y: ((x // 4 * 3 + y * 7) % 64 - 20) * scale
    rgb = [("B", "e", ramp(0.25)), ("G", "f", ramp(1e-3)), ("R", "e", ramp(8.0))]
    def single(value):
        return struct.unpack("<f", struct.pack("<f", value))[0]
    for packing, name in ((0, "none"), (1, "RLE"), (2, "ZIPS"), (3, "ZIP")):
        for turned in (False, True):
            values = [single(rgb[k][2](x, y)) for y in range(19) for x in range(23)
                      for k in (2, 1, 0)]
            yield (f"OpenEXR, {name}" + (", from below" if turned else ""),
                   exr(23, 19, rgb, packing, turned, (-5, 7)), "light", "R G B", values)
    depth = [("Z", "f", lambda x, y: float("inf") if x == y else x + y / 8),
             ("id", "I", lambda x, y: 1000 * x + y)]
    yield ("OpenEXR, depths and numbers", exr(9, 5, depth, 2), "light", "Z id",
           [v for y in range(5) for x in range(9) for v in
            (float("inf") if x == y else x + y / 8, 1000 * x + y)])
    alpha = [("A", "e", lambda x, y: 0.5), ("B", "e", ramp(1.0)), ("G", "e", ramp(2.0)),
             ("R", "e", ramp(4.0))]
    yield ("OpenEXR, with A", exr(5, 3, alpha, 0), "light", "R G B A",
           [v for y in range(3) for x in range(5) for v in
            (ramp(4.0)(x, y), ramp(2.0)(x, y), ramp(1.0)(x, y), 0.5)])
    body = struct.pack(">12f", *range(12))
    yield ("PFM, big-endian, twice", b"PF 2\t2 2.0\n" + body, "light", "R G B",
           [2.0 * v for v in (6, 7, 8, 9, 10, 11, 0, 1, 2, 3, 4, 5)])
    pixels = bytes([128, 64, 32, 129, 200, 100, 0, 120, 9, 9, 9, 0, 255, 1, 2, 136])
    values = [[m * 2.0 ** (pixels[i + 3] - 136) if pixels[i + 3] else 0.0
               for m in pixels[i:i + 3]] for i in range(0, 16, 4)]
    yield ("Radiance, plain", b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 2\n" + pixels,
           "light", "R G B", sum(values, []))
    yield ("Radiance, upside down and exposed twice",
           b"#?RGBE\nEXPOSURE=2\nEXPOSURE=4\nCOLORCORR= 1 2 4\n\n+Y 2 -X 2\n" + pixels, "light",
           "R G B", [v / d / 8 for i in (3, 2, 1, 0) for v, d in zip(values[i], (1, 2, 4))])
    for size, order in ((b"+X 2 -Y 2", (0, 2, 1, 3)), (b"-X 2 -Y 2", (2, 0, 3, 1)),
                        (b"+X 2 +Y 2", (1, 3, 0, 2)), (b"-X 2 +Y 2", (3, 1, 2, 0))):
        yield ("Radiance, columns " + size.decode(),
               b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + size + b"\n" + pixels, "light",
               "R G B", sum((values[i] for i in order), []))
    yield ("Radiance, XYZ", b"#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 4\n" + pixels, "light",
           "X Y Z", sum(values, []))


# -------- JPEG --------

def jpeg(levels, cut=0):
    """Grey squares of 8 x 8: a table of ones, differences of the mean alone."""
    def segment(marker, body):
        return bytes([0xff, marker]) + struct.pack(">H", len(body) + 2) + body
    lengths = [0] * 16
    lengths[3] = 12  # twelve codes of four bits: sizes 0 .. 11
    bits, before = "", 0
    for level in levels:
        difference = 8 * (level - 128) - before
        before += difference
        size = abs(difference).bit_length()
        bits += format(size, "04b")
        if size:
            bits += format(difference if difference > 0 else difference + 2 ** size - 1,
                           f"0{size}b")
        bits += "0"  # the end of the block, the one code of the other table
    bits += "1" * (-len(bits) % 8)
    scan = int(bits, 2).to_bytes(len(bits) // 8, "big").replace(b"\xff", b"\xff\0")
    return (b"\xff\xd8" + segment(0xdb, b"\0" + b"\1" * 64) +
            segment(0xc0, struct.pack(">BHHB3B", 8, 8, 8 * len(levels), 1, 1, 0x11, 0)) +
            segment(0xc4, b"\0" + bytes(lengths) + bytes(range(12))) +
            segment(0xc4, b"\x10" + bytes([1] + [0] * 15) + b"\0") +
            segment(0xda, b"\1\1\0\0\x3f\0") + scan + b"\xff\xd9")[:-cut or None]


def jpeg_cases():
    levels = [0, 255, 17, 128, 200]
    values = [level / 255 for _ in range(8) for level in levels for _ in range(8)]
    yield "JPEG", jpeg(levels), "codes", "Y", values
    yield "JPEG, light", jpeg(levels), "light", "Y", [light(v) for v in values]
    yield "JPEG, cut", jpeg(levels, 3), "codes", "JPEG: ends at byte ", None


# -------- the checks --------

def close(a, b):
    return a == b or abs(a - b) <= 1e-7 * max(abs(a), abs(b))


def check_written(checks, name, data):
    if name.endswith(".png"):
        check_png(checks, name, data)
        return
    notes = NOTES
    if name.endswith(".pfm"):
        width, height, channels, rows = read_pfm(data)
        notes = None
    elif name.endswith(".hdr"):
        width, height, channels, rows, notes = read_radiance(data)
    else:
        width, height, names, lines, attributes = read_exr(data)
        channels = len(names)
        order = {1: "Y", 3: "RGB", 4: "RGBA"}.get(channels) or [str(i + 1) for i in range(channels)]
        rows = [[line[k][x] for x in range(width) for k in order] for line in lines]
        notes = {key: value.decode() for key, (kind, value) in attributes.items()
                 if kind == "string"}
        checks.check({form for _, form in names} == {"e" if name in ("half.exr", "many.exr")
                                                     else "f"}, f"{name}: {names}")
    checks.check((width, height) == (WIDTH, HEIGHT), f"{name}: {width} x {height}")
    checks.check(notes in (None, NOTES), f"{name}: {notes}")
    relative = {"half.exr": 2 ** -11, "many.exr": 2 ** -11}.get(name, 2 ** -24)
    for y, row in enumerate(known(WIDTH, HEIGHT, channels)):
        for x in range(0, len(row), channels):
            most = max(row[x:x + channels])
            absolute = most / 256 if name.endswith(".hdr") else 0
            off = max(abs(a - b) - relative * b for a, b in zip(rows[y][x:x + channels],
                                                                 row[x:x + channels]))
            checks.check(off <= absolute, f"{name}: row {y}, value {x} is off by {off}")


def asked(tool, what, path):
    return subprocess.run([tool], env={**os.environ, what: path}, capture_output=True, text=True)


def check_read(checks, tool, folder, case):
    name, data, values, channels, expected = case
    path = os.path.join(folder, "case")
    with open(path, "wb") as file:
        file.write(data)
    done = asked(tool, "READ_" + values.upper(), path)
    if expected is None:
        checks.check(done.returncode == 4 and done.stdout.startswith(channels),
                     f"{name}: {done.returncode} {done.stdout[:200]}")
        return
    if not checks.check(done.returncode == 0, f"{name}: {done.stdout[:200]}"):
        return
    names = {1: "Y", 2: "Y A", 3: "R G B", 4: "R G B A"}.get(channels, channels)
    head, *lines = done.stdout.splitlines()
    got = [float(line) for line in lines if "=" not in line]
    checks.check(" ".join(head.split()[3:]) == names, f"{name}: {head}")
    checks.check(len(got) == len(expected), f"{name}: {len(got)} values, not {len(expected)}")
    wrong = [(i, a, b) for i, (a, b) in enumerate(zip(got, expected)) if not close(a, b)]
    checks.check(not wrong, f"{name}: {len(wrong)} values differ, the first {wrong[:1]}")


def main():
    checks = Checks()
    tool = os.path.join(os.path.abspath(sys.argv[1]), "unit", "test_pictures")
    if not os.path.exists(tool):
        sys.exit(f"FAILED no program {tool}\n0 passed, 1 failed")
    with tempfile.TemporaryDirectory(prefix="lenscalc-test-") as folder:
        checks.check(asked(tool, "WRITE", folder).returncode == 0, "files are written")
        names = sorted(os.listdir(folder))
        checks.check(len(names) == 16, f"files: {names}")
        for name in names:
            with open(os.path.join(folder, name), "rb") as file:
                check_written(checks, name, file.read())
        for case in [*png_cases(), *float_cases(), *jpeg_cases()]:
            check_read(checks, tool, folder, case)
    checks.finish()


if __name__ == "__main__":
    main()
