#!/usr/bin/env python3
"""tests/truth/check_exposures.py - files of lenscalc render: check_exposures.py BUILD_DIR

Halves are the floats rounded by python's struct, packed rows those that are not packed; cd/m2 are
those of a white card whatever the exposure; one of several exposures is what it is alone; and all
formats that have room for it say how the picture was taken.
"""
# SPDX-License-Identifier: MIT

import os
import struct
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from check_pictures_files import read_exr, read_pfm, read_png, read_radiance
from harness import Checks, Program

WHITE = b"Pf\n2 2\n-1.0\n" + struct.pack("<4f", 1, 1, 1, 1)
CARD = ["white.pfm", "--lens", "double-gauss-50", "-s", "2m", "--field-width", "20m", "--size",
        "36x24", "--samples", "16"]
CHART = ["chart:star", "--lens", "double-gauss-50", "-s", "1m", "--size", "40x20", "--samples", "2"]
NOTES = {"Software": "lenscalc ", "Scene": "chart:star", "Lens": "Tronnier double Gauss 50 mm f/2",
         "Aperture": "f/4", "Distance": "1000 mm", "Exposure time": "0.004 s", "ISO": "200",
         "Seed": "7"}


def check_halves(checks, take):
    floats, halves = read_exr(take("a.exr", *CHART)), read_exr(take("b.exr", *CHART, "--bits", "16"))
    plain = read_exr(take("c.exr", *CHART, "--packing", "none"))
    plain_halves = read_exr(take("d.exr", *CHART, "--bits", "16", "--packing", "none"))
    rounded = [{name: struct.unpack(f"<{len(values)}e", struct.pack(f"<{len(values)}e", *values))
                for name, values in row.items()} for row in floats[3]]
    checks.check([form for _, form in floats[2]] == ["f"] * 3 and
                 [form for _, form in halves[2]] == ["e"] * 3, "floats and halves")
    checks.check(halves[3] == rounded, "halves are not the floats rounded")
    checks.check(floats[4]["compression"][1][0] == 3 and plain[4]["compression"][1][0] == 0,
                 "how they are packed")
    checks.check(plain[3] == floats[3] and plain_halves[3] == rounded, "packed ones differ")
    checks.check(read_pfm(take("a.pfm", *CHART))[3] ==
                 [[row[name][x] for x in range(40) for name in "RGB"] for row in floats[3]],
                 "a PFM differs from an OpenEXR")


def check_radiance(checks, take):
    found = []
    for time in "1/50", "1/400":
        rows = read_pfm(take("r.pfm", *CARD, "--radiance", "--luminance", "300", "-t", time))[3]
        found.append(rows)
        middle = rows[12][3 * 18 + 1]
        checks.check(abs(middle - 300) < 6, f"the middle of a white card has {middle} cd/m2")
    checks.check(found[0] == found[1], "cd/m2 depend on the exposure")
    light = read_pfm(take("l.pfm", *CARD, "--luminance", "300", "-t", "1/50"))[3]
    ratios = [b / a for row, other in zip(found[0], light) for a, b in zip(row, other)]
    checks.check(max(ratios) < min(ratios) * 1.000001, "lx s are not proportional to cd/m2")


def check_exposures(checks, take, folder):
    for ending in "png", "pfm":
        take(f"many.{ending}", *CHART, "-t", "1/30..1/500#5", "--iso", "100,400", "--noise"
             if ending == "png" else "--radiance", there=False)
        # noise is each exposure's own: only the first one's is that of a run by itself
        for number in (1,) if ending == "png" else (1, 2, 6, 10):
            time = 1 / 30 + (number - 1) // 2 * (1 / 500 - 1 / 30) / 4
            alone = take(f"one.{ending}", *CHART, "-t", repr(time), "--iso",
                         "100" if number % 2 else "400", "--noise" if ending == "png" else
                         "--radiance")
            with open(os.path.join(folder, f"many-{number:02}.{ending}"), "rb") as file:
                checks.check(file.read() == alone, f"exposure {number} of several, {ending}")
    names = [name for name in os.listdir(folder) if name.startswith("many")]
    checks.check(len(names) == 20, f"files: {sorted(names)}")


def texts_of(name, data):
    if name.endswith(".exr"):
        return {key: value.decode() for key, (kind, value) in read_exr(data)[4].items()
                if kind == "string"}
    if name.endswith(".hdr"):
        return read_radiance(data)[4]
    return dict(text.decode().split("\0") for text in read_png(data)[5][b"tEXt"])


def check_notes(checks, take):
    for name, *options in (["n.exr"], ["h.exr", "--bits", "16"], ["n.hdr"], ["n.png"],
                           ["d.png", "--bits", "16"], ["s.png", "--noise", "--mosaic", "rggb"],
                           ["w.png", "--raw", "--mosaic", "rggb"]):
        texts = texts_of(name, take(name, *CHART, "-N", "4", "-t", "1/250", "--iso", "200",
                                    "--seed", "7", *options))
        for key, value in NOTES.items():
            checks.check(texts.get(key, "").startswith(value), f"{name}: {key} {texts.get(key)}")
        if options[:1] == ["--raw"]:
            checks.check((texts["CFA pattern"], texts["Black level"], texts["White level"]) ==
                         ("rggb", "0", "16383"), f"raw: {texts}")
    width, height, bits, color = read_png(take("w.png", *CHART, "--raw", "--mosaic", "rggb"))[:4]
    checks.check((width, height, bits, color) == (40, 20, 16, 0), "raw: grey of 16 bits")


def main():
    program, checks = Program(sys.argv[1]), Checks()
    with tempfile.TemporaryDirectory(prefix="lenscalc-exposures-") as folder:
        def take(name, *words, there=True):
            path = os.path.join(folder, name)
            result = subprocess.run(program.command + ["render", *words, "-o", path], text=True,
                                    cwd=folder, capture_output=True, env=program.environment())
            checks.check(result.returncode == 0, f"{words}: {result.stderr}")
            if there:
                with open(path, "rb") as file:
                    return file.read()
            return None
        with open(os.path.join(folder, "white.pfm"), "wb") as file:
            file.write(WHITE)
        check_halves(checks, take)
        check_radiance(checks, take)
        check_exposures(checks, take, folder)
        check_notes(checks, take)
    return checks.finish()


if __name__ == "__main__":
    sys.exit(main())
