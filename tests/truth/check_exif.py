#!/usr/bin/env python3
"""tests/truth/check_exif.py - Exif data as lenscalc reads them itself, against exiftool.

What exiftool 12.57 prints of the files of tests/exif_files.py is kept in exif.json; where it is
installed it is asked again, as `check_exif.py BUILD_DIR accept` does to write that file.
"""
# SPDX-License-Identifier: MIT

import json
import os
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import exif_files as exif
from harness import Checks, Program

KEPT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "exif.json")
TAGS = ("Make", "Model", "FocalLength#", "FocalLengthIn35mmFormat#", "Aperture#", "ShutterSpeed#",
        "ISO#", "RecommendedExposureIndex#", "SubjectDistance#", "ImageWidth#", "ImageHeight#")
# exiftool prints 10 digits of a quotient
SAME = 1e-9


def files():
    """Names and contents: every value in both byte orders, in a JPEG and in a TIFF."""
    sets = {"usual": exif.SETTINGS,
            "long": {**exif.SETTINGS, exif.TIME: (exif.RATIONAL, (1, 60)),
                     exif.FOCAL: (exif.RATIONAL, (4250, 1000)), exif.EQUIVALENT: (exif.SHORT, 26),
                     exif.DISTANCE: (exif.RATIONAL, (1, 3))},
            "slow": {**exif.SETTINGS, exif.TIME: (exif.RATIONAL, (30, 1)),
                     exif.ISO: (exif.SHORT, (100, 0)), exif.DISTANCE: (exif.RATIONAL, (7, 0))},
            "apex": {exif.SHUTTER_APEX: (exif.SRATIONAL, (6, 1)),
                     exif.APERTURE_APEX: (exif.RATIONAL, (5, 1)), exif.ISO: (exif.LONG, 3200),
                     exif.FOCAL: (exif.RATIONAL, (135, 1)), exif.DISTANCE: (exif.RATIONAL, (5, 1))},
            "negative": {**exif.SETTINGS, exif.TIME: (exif.SRATIONAL, (1, 8000))},
            "index": {**exif.SETTINGS, exif.ISO: (exif.SHORT, 65535),
                      exif.EXPOSURE_INDEX: (exif.LONG, 204800)}}
    for name, settings in sets.items():
        for big in (False, True):
            order = "big" if big else "little"
            yield f"{name}-{order}.jpg", exif.jpeg(settings=settings, big=big)
            yield f"{name}-{order}.tif", exif.tiff(settings=settings, big=big)


def ask_exiftool(names, folder):
    words = ["exiftool", "-json", *("-" + tag for tag in TAGS), *names]
    answer = subprocess.run(words, cwd=folder, stdout=subprocess.PIPE,
                            stderr=subprocess.DEVNULL, check=True)
    return {item.pop("SourceFile"): item for item in json.loads(answer.stdout)}


def compare(checks, program, folder, name, tags):
    """What rows of commands say of a file, without exiftool, and what that says."""
    bare = {"PATH": folder}
    path = os.path.join(folder, name)
    values = {}
    for command in (["dof", "-s", "1"], ["exposure"]):
        result = program.run(*command, path, "--jsonl", variables=bare)
        checks.check(result.returncode == 0, f"{name}: {result.stderr.decode()[:200]}")
        values.update(json.loads(result.stdout or "{}"))
    iso = float(str(tags["ISO"]).split()[0])
    iso = tags["RecommendedExposureIndex"] if iso == 65535 else iso
    pairs = [("focal length", values.get("focal_mm"), tags["FocalLength"], "mm"),
             ("f-number", values.get("fnumber"), tags["Aperture"], ""),
             ("time", values.get("time_s"), tags["ShutterSpeed"], "s"),
             ("speed", values.get("iso"), iso, "")]
    if tags["SubjectDistance"] == "inf":
        checks.check(values.get("distance_is_infinite"), f"{name}: the distance is not infinite")
    else:
        pairs.append(("distance", values.get("distance_m"), tags["SubjectDistance"], "m"))
    for quantity, actual, expected, unit in pairs:
        checks.against("exiftool", name, quantity, actual, expected, SAME * expected, unit)
    checks.check("Nikon D850" in values.get("sensor", ""), f"{name}: {values.get('sensor')!r}")


def main():
    checks = Checks()
    program = Program(sys.argv[1])
    has_exiftool = shutil.which("exiftool") is not None
    with tempfile.TemporaryDirectory(prefix="lenscalc-test-") as folder:
        made = dict(files())
        for name, content in made.items():
            with open(os.path.join(folder, name), "wb") as file:
                file.write(content)
        if "accept" in sys.argv[2:]:
            with open(KEPT, "w", encoding="utf-8") as file:
                json.dump(ask_exiftool(list(made), folder), file, indent=1)
                file.write("\n")
        with open(KEPT, encoding="utf-8") as file:
            kept = json.load(file)
        if has_exiftool:
            checks.check(ask_exiftool(list(made), folder) == kept,
                         "exiftool says something else than exif.json")
        else:
            print("exiftool: skipped, it is not here; exif.json stands alone")
        for name in made:
            compare(checks, program, folder, name, kept[name])
    checks.finish()


if __name__ == "__main__":
    main()
