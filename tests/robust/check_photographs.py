#!/usr/bin/env python3
"""tests/robust/check_photographs.py - photographs as operands: exiftool there, absent, slow, broken.

Whatever their names are, every file has its row, in the order of the operands. Programs that go by
the name exiftool are scripts in a folder that stands first in PATH.
"""
# SPDX-License-Identifier: MIT

import csv
import glob
import io
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import exif_files as exif
from harness import EVERYTHING, Checks, Program

# names that a shell, an option parser or a list in a file would take for something else
NAMES = (b"plain.jpg", b"-x.jpg", b"--csv.jpg", b"-@.jpg", b"@list.jpg", b" blank \"quoted'.jpg",
         b"two\nlines.jpg", b"$(touch bad).jpg", b"`touch bad`.jpg", b"; touch bad;.jpg",
         b"| touch bad |.jpg", b"\xff\xfe.jpg", b"*.jpg", b"%d%f.jpg", b"\xc3\xa9.JPG", b"a\\b.jpeg")


class Tester:
    def __init__(self, checks, program, folder):
        self.checks, self.program, self.folder = checks, program, folder
        self.bare = os.path.join(folder, "bare")  # a PATH without exiftool
        os.mkdir(self.bare)

    def put(self, name, content):
        with open(os.path.join(os.fsencode(self.folder), os.fsencode(name)), "wb") as file:
            file.write(content)

    def script(self, name, text):
        """A folder with a program that goes by the name of exiftool."""
        folder = os.path.join(self.folder, name)
        os.mkdir(folder)
        path = os.path.join(folder, "exiftool")
        with open(path, "w", encoding="utf-8") as file:
            file.write("#!/bin/sh\n" + text)
        os.chmod(path, 0o755)
        return folder + ":" + self.program.environment()["PATH"]

    def run(self, *words, path=None, **more):
        environment = {**self.program.environment(), **({} if path is None else {"PATH": path})}
        return subprocess.run(self.program.command + list(words), cwd=self.folder, env=environment,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, timeout=120, **more)

    def rows(self, *words, path=None):
        result = self.run(words[0], "--csv", *words[1:], path=path)
        text = result.stdout.decode("utf-8", "surrogateescape")
        rows = list(csv.DictReader(io.StringIO(text, newline="")))
        return rows, result.returncode, result.stderr.decode("utf-8", "replace")

    def expect(self, what, words, status, *says, path=None):
        rows, got, said = self.rows(*words, path=path)
        self.checks.check(got == status, f"{what}: status {got}, expected {status}: {said[:300]}")
        for text in says:
            self.checks.check(text in said, f"{what}: '{text}' is not in {said[:400]!r}")
        return rows


def check_names(tester, path):
    """Names are handed over as they are; each row has its own."""
    for name in NAMES:
        tester.put(name, exif.jpeg())
    names = [os.fsdecode(name) for name in NAMES]
    rows = tester.expect("names", ["dof", "--digits", "4", "--", *names], 0, path=path)
    tester.checks.check([row["SourceFile"] for row in rows] == names,
                        f"names: {[row['SourceFile'] for row in rows]!r}")
    tester.checks.check({row.get("near_m") for row in rows} == {"2.905"}, "names: near limits")
    tester.checks.check(not os.path.exists(os.path.join(tester.folder, "bad")),
                        "names: something in a name was run")


def check_rows(tester, path):
    """What is wrong with a file fails in its row and nowhere else."""
    tester.put("good.jpg", exif.jpeg())
    tester.put("big.tif", exif.tiff(big=True))
    tester.put("far.jpg", exif.jpeg(settings={**exif.SETTINGS,
                                              exif.DISTANCE: (exif.RATIONAL, exif.INFINITE)}))
    tester.put("near.jpg", exif.jpeg(settings=exif.without(exif.DISTANCE)))
    tester.put("empty.jpg", b"")
    tester.put("cut.jpg", exif.jpeg()[:60])
    os.mkdir(os.path.join(tester.folder, "folder.jpg"))
    os.mkfifo(os.path.join(tester.folder, "pipe.jpg"))
    words = ["dof", "good.jpg", "no.jpg", "big.tif", "folder.jpg", "pipe.jpg", "near.jpg",
             "empty.jpg", "cut.jpg", "far.jpg", "--digits", "4"]
    rows = tester.expect("rows", words, 3, "no.jpg: cannot read it: No such file",
                         "folder.jpg: this is no regular file", "pipe.jpg: this is no regular file",
                         "near.jpg: --distance missing", path=path)
    tester.checks.check([row["far_m"] for row in rows] ==
                        ["3.561", "", "3.561", "", "", "", "", "", "inf"],
                        f"rows: {[row['far_m'] for row in rows]}")
    tester.checks.check(all((row["error"] == "") == (row["near_m"] != "") for row in rows),
                        "rows: a row without a limit says why")
    rows = tester.expect("-s", ["dof", "near.jpg", "good.jpg", "-s", "3m", "--digits", "4"], 0,
                         path=path)
    tester.checks.check([row["distance_m"] for row in rows] == ["3", "3.2"], "-s: distances")
    rows = tester.expect("-s hyperfocal", ["dof", "near.jpg", "good.jpg", "-s", "hyperfocal",
                                           "--digits", "6"], 0, path=path)
    tester.checks.check([row["far_m"] for row in rows] == ["inf", "3.56124"] and
                        rows[0]["distance_m"] == rows[0]["hyperfocal_m"], "-s hyperfocal: rows")
    tester.expect("all fail", ["dof", "no.jpg"], 1, "no.jpg", path=path)
    tester.expect("fail fast", ["dof", "no.jpg", "good.jpg", "--fail-fast"], 1, "no.jpg", path=path)


def check_cameras(tester, path):
    """The sensor: the camera's, a phone's other camera, a crop, an unknown camera, none."""
    def photo(name, make, model, focal, equivalent):
        settings = {**exif.without(exif.EQUIVALENT), exif.FOCAL: (exif.RATIONAL, focal)}
        if equivalent is not None:
            settings[exif.EQUIVALENT] = (exif.SHORT, equivalent)
        tester.put(name, exif.jpeg({exif.MAKE: (exif.ASCII, make),
                                    exif.MODEL: (exif.ASCII, model)}, settings, size=(4000, 3000)))
    photo("tele.jpg", "Apple", "iPhone 13 Pro", (9, 1), 77)
    photo("zoom.jpg", "Apple", "iPhone 13 Pro", (57, 10), 52)
    photo("crop.jpg", "NIKON CORPORATION", "NIKON D850", (50, 1), 75)
    photo("canon.jpg", "Canon", "Canon EOS 350D DIGITAL", (50, 1), None)
    photo("unknown.jpg", "Nobody", "Nothing 1", (6, 1), 36)
    photo("maker.jpg", "Nobody", "D850", (50, 1), None)
    files = ["tele.jpg", "zoom.jpg", "crop.jpg", "canon.jpg", "unknown.jpg", "maker.jpg"]
    rows = tester.expect("cameras", ["fov", *files], 3,
                         "'D850' is no camera of lensdb, and no equivalent focal length",
                         path=path)
    sensors = [row["sensor"] for row in rows]
    expected = ("Apple iPhone 13 Pro tele (", " x ", " x ", "Canon EOS 350D (", " x ", "")
    for sensor, begin in zip(sensors, expected):
        tester.checks.check(begin in sensor, f"cameras: {sensor!r} for {begin!r}")
    # diagonals: sqrt(36^2 + 24^2) real/equivalent; 4:3 of the picture
    for sensor, real, equivalent in zip((sensors[1], sensors[2], sensors[4]), (5.7, 50, 6),
                                        (52, 75, 36)):
        width, height = (float(word) for word in sensor.split(" mm")[0].split(" x "))
        diagonal = 1872 ** 0.5 * real / equivalent
        tester.checks.check(abs((width * width + height * height) ** 0.5 - diagonal) < 0.01,
                            f"cameras: the diagonal of {sensor!r} is not {diagonal}")
    tester.checks.check(sensors[4].startswith("5.77 x 4.33 mm (Nothing 1: 6 mm is 36mm-eq)"),
                        f"cameras: {sensors[4]!r}")
    # what is printed reads back as the same size
    back = tester.expect("sensor again", ["fov", "-f", "6", "-s", "3.2", "--sensor", sensors[4]], 0)
    tester.checks.check(back[0]["horizontal_deg"] == tester.rows(
        "fov", "unknown.jpg", path=path)[0][0]["horizontal_deg"], "sensor again: another angle")
    for more in (["--sensor", "35mm"], ["-c", "0.03"]):
        tester.expect(f"with {more[0]}", ["dof", "maker.jpg", *more], 0, path=path)


def check_refused(tester):
    """What does not go with photographs."""
    tester.put("rows.csv", b"f,N,s\n50,2.8,3\n")
    for words, says in (
            (["dof", "good.jpg", "--batch", "rows.csv"], "exclude each other"),
            (["dof", "good.jpg", "--batch", "-"], "exclude each other"),
            (["dof", "good.jpg", "-N", "2,4"], "photographs and options with several values"),
            (["dof", "good.jpg", "--plot", "a.svg"], "not with photographs"),
            (["dof", "good.jpg", "--batch-format", "csv"], "--batch-format is of tables"),
            (["dof", "good.txt"], "unexpected argument"),
            (["refract", "good.jpg"], "unexpected argument")):
        tester.expect(" ".join(words), words, 2, says)
    before = exif.jpeg()
    tester.expect("-o", ["dof", "good.jpg", "-o", "good.jpg"], 5, "is also read")
    with open(os.path.join(tester.folder, "good.jpg"), "rb") as file:
        tester.checks.check(file.read() == before, "-o: the photograph is another one")
    rows = tester.expect("--batch", ["dof", "--batch", "good.jpg", "far.jpg"], 0)
    tester.checks.check([row["SourceFile"] for row in rows] == ["good.jpg", "far.jpg"],
                        "--batch: files")


def check_absent(tester):
    """Without exiftool: JPEG and TIFF alone, and the message says what is missing."""
    tester.put("raw.CR3", exif.tiff())
    tester.put("a.heic", exif.tiff())
    rows = tester.expect("absent", ["dof", "good.jpg", "raw.CR3", "a.heic", "near.jpg"], 3,
                         ".cr3 files are read with exiftool, which is not installed",
                         ".heic files are read with exiftool", "makers' notes", path=tester.bare)
    tester.checks.check([bool(row["error"]) for row in rows] == [False, True, True, True],
                        "absent: rows")


def check_broken(tester):
    """Programs of that name that fail, print nonsense, too much, or only some of it."""
    empty = '"SourceFile": "good.jpg"'
    cases = {
        "fails": ("echo 'no Perl here' >&2; exit 2\n", "(status 2): no Perl here"),
        "dies": ("kill -9 $$\n", "(signal 9)"),
        "nonsense": ("echo hello\n", "exiftool does not read it (status 0)"),
        "flood": ("yes '[{'\n", "printed too much"),
        "complaints": ("yes >&2\n", "printed too much"),
        "nothing": (f"echo '[{{{empty}}}]'\n", "nothing in it says how it was taken"),
        "half": (f"echo '[{{{empty}, \"ISO\": 1'\n", "exiftool does not read it"),
        "reads": ("cat; exit 1\n", "(status 1)"),  # there is nothing to read
    }
    for name, (text, says) in cases.items():
        tester.expect(name, ["dof", "good.jpg"], 1, says, path=tester.script(name, text))
    words = os.path.join(tester.folder, "words.txt")
    path = tester.script("words", f'printf "%s\\n" "$@" > {words}\necho call >> {words}\n')
    tester.rows("dof", "good.jpg", "far.jpg", path=path)
    with open(words, encoding="utf-8") as file:
        lines = file.read().split("\n")
    tester.checks.check(lines[-5:] == ["--", "good.jpg", "far.jpg", "call", ""],
                        f"words: {lines[-5:]}")


def lives(group):
    """Does a program of the group go on? One that has ended may wait for who asks how it did."""
    for path in glob.glob("/proc/[0-9]*/stat"):
        try:
            with open(path, encoding="latin-1") as file:
                state, _, number = file.read().rpartition(")")[2].split()[:3]
        except OSError:  # it has just ended
            continue
        if int(number) == group and state != "Z":
            return True
    return False


def check_slow(tester):
    """One that does not end is ended, with what it started; so it is with an interrupt."""
    path = tester.script("slow", "echo $$ > slow.pid\nsleep 300 &\nsleep 300\n")
    if EVERYTHING:
        begun = time.monotonic()
        tester.expect("slow", ["dof", "good.jpg"], 1, "exiftool was ended after 11 s", path=path)
        tester.checks.check(time.monotonic() - begun < 60, "slow: took a minute")
    for number in (signal.SIGTERM, signal.SIGINT):
        mark = os.path.join(tester.folder, "slow.pid")
        if os.path.exists(mark):
            os.remove(mark)
        process = subprocess.Popen(
            tester.program.command + ["dof", "good.jpg"], cwd=tester.folder,
            env={**tester.program.environment(), "PATH": path}, stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        until = time.monotonic() + 60
        while not (os.path.exists(mark) and os.path.getsize(mark)) and time.monotonic() < until:
            time.sleep(0.02)
        process.send_signal(number)
        process.communicate(timeout=60)
        tester.checks.check(process.returncode in (-number, 128 + number),
                            f"interrupted: status {process.returncode}")
        with open(mark, encoding="utf-8") as file:
            group = int(file.read())
        time.sleep(0.1)
        tester.checks.check(not lives(group), "interrupted: what exiftool started goes on")


def main():
    checks = Checks()
    program = Program(sys.argv[1])
    paths = [("without exiftool", None)]
    if shutil.which("exiftool"):
        paths.append(("with exiftool", program.environment()["PATH"]))
    else:
        print("with exiftool: skipped, it is not here (Debian: libimage-exiftool-perl)")
    for _, path in paths:
        with tempfile.TemporaryDirectory(prefix="lenscalc-test-") as folder:
            tester = Tester(checks, program, folder)
            path = tester.bare if path is None else path
            check_names(tester, path)
            check_rows(tester, path)
            check_cameras(tester, path)
            if path == tester.bare:
                check_refused(tester)
                check_absent(tester)
                check_broken(tester)
                check_slow(tester)
    checks.finish()


if __name__ == "__main__":
    main()
