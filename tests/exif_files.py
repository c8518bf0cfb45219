"""tests/exif_files.py - JPEG and TIFF files with Exif data that are known to the last bit.

A list of tags is a dictionary: the number of a tag to its type and value. Only what the header of
a photograph needs: the picture itself is missing.
"""
# SPDX-License-Identifier: MIT

import struct

ASCII, SHORT, LONG, RATIONAL, SRATIONAL = 2, 3, 4, 5, 10
MAKE, MODEL, EXIF = 0x10F, 0x110, 0x8769
TIME, FNUMBER, ISO, DISTANCE, FOCAL, EQUIVALENT = 0x829A, 0x829D, 0x8827, 0x9206, 0x920A, 0xA405
SHUTTER_APEX, APERTURE_APEX, OUTPUT_SENSITIVITY, EXPOSURE_INDEX = 0x9201, 0x9202, 0x8831, 0x8832
INFINITE = (0xFFFFFFFF, 1)

CAMERA = {MAKE: (ASCII, "NIKON CORPORATION"), MODEL: (ASCII, "NIKON D850")}
SETTINGS = {TIME: (RATIONAL, (10, 1250)), FNUMBER: (RATIONAL, (28, 10)), ISO: (SHORT, 400),
            DISTANCE: (RATIONAL, (32, 10)), FOCAL: (RATIONAL, (500, 10)), EQUIVALENT: (SHORT, 50)}


def value_bytes(order, kind, value):
    """(the bytes of a value, how many values they are)"""
    if kind == ASCII:
        raw = value.encode("latin-1") + b"\0"
        return raw, len(raw)
    if kind in (RATIONAL, SRATIONAL):
        return struct.pack(order + ("II" if kind == RATIONAL else "ii"), *value), 1
    values = value if isinstance(value, tuple) else (value,)
    return struct.pack(order + ("H" if kind == SHORT else "I") * len(values), *values), len(values)


def tiff(camera=None, settings=None, big=False):
    """A TIFF whose first list of tags is `camera`, and that of Exif `settings`; None: the usual."""
    order = ">" if big else "<"
    camera = dict(CAMERA if camera is None else camera)
    settings = SETTINGS if settings is None else settings
    second = 8 + 2 + 12 * (len(camera) + 1) + 4
    data_at = second + 2 + 12 * len(settings) + 4
    camera[EXIF] = (LONG, second)
    lists, data = b"", b""
    for tags in (camera, settings):
        lists += struct.pack(order + "H", len(tags))
        for tag, (kind, value) in sorted(tags.items()):
            raw, count = value_bytes(order, kind, value)
            lists += struct.pack(order + "HHI", tag, kind, count)
            if len(raw) > 4:
                lists += struct.pack(order + "I", data_at + len(data))
                data += raw + b"\0" * (len(raw) % 2)
            else:
                lists += raw.ljust(4, b"\0")
        lists += struct.pack(order + "I", 0)
    head = (b"MM" if big else b"II") + struct.pack(order + "HI", 42, 8)
    return head + lists + data


def segment(marker, body):
    return struct.pack(">HH", marker, len(body) + 2) + body


def jpeg(camera=None, settings=None, big=False, size=(6000, 4000), exif=None):
    """The header of a JPEG with these tags, or these bytes for its segment of Exif."""
    body = tiff(camera, settings, big) if exif is None else exif
    width, height = size
    return (b"\xff\xd8" + segment(0xFFE0, b"JFIF\0\1\1\0\0\1\0\1\0\0") +
            segment(0xFFE1, b"Exif\0\0" + body) +
            segment(0xFFC0, struct.pack(">BHHB", 8, height, width, 1) + b"\1\x11\0") +
            segment(0xFFDA, b"\1\1\0\0\x3f\0") + b"\0\xff\xd9")


def without(*tags):
    return {tag: value for tag, value in SETTINGS.items() if tag not in tags}
