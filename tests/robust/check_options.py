#!/usr/bin/env python3
"""tests/robust/check_options.py - every common option with every command: honoured, or refused.

An option that says nothing beside what else is asked is refused, and answered beside what it serves;
check_pairs.py tries all pairs of options. What a command's --help does not show is refused with exit status 2 and the
reason. What it shows makes a difference that is tried here: another answer, a file, another
failure. A new command needs its line in ASKED below, a new common option its function.
"""
# SPDX-License-Identifier: MIT

import csv
import io
import json
import os
import re
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import NEED_SOLVER, Checks, Program

# Command -> a question that every format answers, two options with values to sweep (the first with
# a number), and a batch of two questions where the question is not two of the same lens.
ASKED = {
    "dof": ("-f 50 -s 3 -N 5.6", ("f", "35,50", "N", "2.8,4"), "s\n2\n3\n"),
    "hyperfocal": ("-f 50 -N 5.6", ("f", "35,50", "N", "2.8,4"), "N\n4\n8\n"),
    "fov": ("-f 50 -s 3", ("f", "35,50", "s", "1,2"), "s\n2\n3\n"),
    "focus": ("-f 50 -s 3 -N 5.6", ("s", "1,2", "f", "35,50"), "s\n2\n3\n"),
    "exposure": ("-N 5.6 -t 1/60 --iso 200", ("N", "4,8", "t", "1/30,1/60"), "N\n4\n8\n"),
    "flash": ("-g 36 -N 5.6", ("N", "4,8", "g", "20,36"), "N\n4\n8\n"),
    "bracket": ("--from 30s --to 1/1000", None, "from\n30\n15\n"),
    "motion": ("-f 50 -s 10 --speed 5km/h", ("s", "5,10", "f", "35,50"), "s\n2\n3\n"),
    "stars": ("-f 24 -N 5.6 --pitch 4um", ("f", "24,35", "N", "2.8,4"), "N\n4\n8\n"),
    "diffraction": ("-N 5.6 -f 50", ("N", "4,8", "f", "35,50"), "N\n4\n8\n"),
    "pinhole": ("-f 150", ("f", "100,150", "s", "1,2"), "f\n100\n150\n"),
    "equivalent": ("-f 50 -N 5.6 --sensor 4/3", ("f", "35,50", "N", "2.8,4"), "N\n4\n8\n"),
    "tilt": ("-f 90 -N 5.6 --tilt 5 -s 0.6", ("s", "0.6,1", "tilt", "2,4"), "s\n2\n3\n"),
    "panorama": ("-f 24 --distance 3", ("f", "24,35", "overlap", "0.2,0.3"), "f\n24\n35\n"),
    "timelapse": ("--event 1h --clip 10s -t 1/60", ("event", "1h,2h", "clip", "10s,20s"), "clip\n10\n20\n"),
    "survey": ("-f 10 --sensor 1in --pixels 20Mpx --altitude 100", ("altitude", "50,100", "f", "8,10"),
               "altitude\n50\n60\n"),
    "projector": ("--throw 1.5 --screen 100in", ("throw", "1.5,2", "screen", "80,100"),
                  "throw\n1.2\n2\n"),
    "visual": ("--telescope 1200 --diameter 200 --lens double-gauss",
               ("telescope", "900,1200", "diameter", "150,200"), "diameter\n150\n200\n"),
    "microscope": ("--na 0.5 -m 20 --sensor 4/3", ("na", "0.4,0.5", "m", "10,20"), "na\n0.4\n0.5\n"),
    "refract": ("--after 1.5168 -R 50 -z -200", ("R", "40,50", "z", "-100,-200"), "R\n40\n50\n"),
    "lensmaker": ("--r1 50 --r2 -50 -n 1.5168 -d 5", ("r1", "40,50", "d", "4,5"), "d\n4\n5\n"),
    "lens": ("double-gauss -N 5.6 -w d", ("N", "4,8", "w", "486,587"), "N\n4\n8\n"),
    "surfaces": ("double-gauss -N 5.6", None, "N\n4\n8\n"),
    "sag": ("double-gauss --surface 1 --height 5", ("surface", "1,2", "height", "5,10"),
            "height\n5\n10\n"),
    "matrix": ("double-gauss", None, "w\n486\n587\n"),
    "conjugate": ("double-gauss --object 1m -N 5.6 -w d", ("object", "1m,2m", "w", "486,587"),
                  "w\n486\n587\n"),
    "trace": ("double-gauss --x 0 --y 5 --z -20 -w d -N 5.6", ("w", "486,587", "N", "4,8"),
              "w\n486\n587\n"),
    "check": ("double-gauss -N 5.6 --steps 2", None, "N\n4\n8\n"),
    "pupil": ("double-gauss -N 5.6 --field 0", None, "N\n4\n8\n"),
    "render": ("chart:edge -s 1 -N 5.6 --size 16x8 --samples 1 --lens double-gauss", None, None),
    "draw": ("double-gauss -N 5.6", None, None),
    "seidel": ("double-gauss -N 5.6 -w d", None, "N\n4\n8\n"),
    "spot": ("double-gauss -N 5.6 -w d --field 5", ("N", "4,8", "field", "5,10"),
             "field\n5\n10\n"),
    "field": ("double-gauss -w d --field 5", ("field", "5,10", "w", "486,587"),
              "field\n5\n10\n"),
    "illumination": ("double-gauss -N 5.6 --height 5", ("N", "4,8", "height", "5,10"),
                     "height\n5\n10\n"),
    "color": ("double-gauss -N 5.6 --field 5 --spectrum F,d,C", None, "field\n5\n10\n"),
    "wavefront": ("double-gauss -N 5.6 --field 0", ("N", "4,8", "field", "0,5"), "N\n5.6\n8\n"),
    "mtf": ("double-gauss -N 8 --field 0 -w d --frequency 40", ("N", "8,16", "field", "0,5"),
            "N\n5.6\n8\n"),
    "psf": ("double-gauss -N 8 --field 0 -w d --size 32", ("N", "8,16", "field", "0,5"),
            "N\n5.6\n8\n"),
    "energy": ("double-gauss -N 8 --field 0 -w d --radius 5um", ("N", "8,16", "field", "0,5"),
               "N\n5.6\n8\n"),
    "spread": ("double-gauss -N 8 --field 0 -w d", ("N", "8,16", "field", "0,5"), "N\n5.6\n8\n"),
    "fan": ("double-gauss -N 5.6 --field 0 -w d --points 3", None, "N\n4\n8\n"),
    "distortion": ("double-gauss --field 10", ("field", "5,10", "w", "486,587"),
                   "field\n5\n10\n"),
    "report": ("double-gauss -N 5.6", None, None),
    "fit": ("double-gauss -N 5.6 --distortion 0", ("N", "4,8", "w", "486,587"), "N\n4\n8\n"),
    "optimize": ("double-gauss --vary R1 --goals efl=100 --pattern sobol",
                 ("N", "4,8", "seed", "1,2"), "N\n4\n8\n"),
    "tolerance": ("double-gauss --trials 20", ("N", "4,8", "seed", "1,2"), "N\n4\n8\n"),
    "merge": ("one.part", None, None),
    "tone": ("one.png -N 5.6 --iso 100 --operator filmic --white 1000 --bits 16",
             None, None),
    "list": ("formats", None, None),
    "glass": ("N-BK7 -w 500 --thickness 10mm", ("w", "486,587", "thickness", "5,10"),
              "w\n486\n587\n"),
    "convert": ("double-gauss", None, None),
    "bench": ("double-gauss -N 5.6 --degree 3 --rays 12", ("N", "4,8", "w", "486,587"),
              "N\n4\n8\n"),
    "help": ("", None, None),
    "completion": ("bash", None, None),
}
# Columns of bench that take no time to be found, and come out again.
UNTIMED = ("--columns", "model,rms_error,digits")
ODD_LENS = ("MODE SEQ\nUNIT MM\nENPD 10\nFTYP 0 0 2 1 0 0 0\nYFLN 0 5\nVDXN 0 0.1\n"
            "WAVM 1 0.5876 1\nPWAV 1\nSURF 0\n  DISZ INFINITY\nSURF 1\n  STOP\n  CURV 0.02\n"
            "  DISZ 4\n  GLAS N-BK7 0 0 1.6 40\n  USAP slit.uda\n  DIAM 6\nSURF 2\n  DIAM 6\n  DISZ 90\nSURF 3\n")
TABLES = ("cameras", "films", "filters", "formats", "fstops", "iso", "lines", "scenes", "shutters",
          "glass/BAD")


# Command, options that say nothing there, the words of the refusal, what makes them say something
# (None: nothing is tried). Without words of a refusal the question is answered.
IDLE = (
    ("trace double-gauss", "--rays 5", "--rays needs --pattern", "--pattern gauss"),
    ("trace double-gauss", "--pattern few --rays 5", "--rays needs --pattern", None),
    ("trace double-gauss", "--seed 5", "--seed needs --pattern sobol", "--pattern sobol"),
    ("trace double-gauss", "--pattern gauss --seed 5", "--seed needs --pattern sobol", None),
    ("trace double-gauss", "--pupil-point 0:0.5 --rays 9", "--rays needs --pattern", None),
    ("trace double-gauss", "--point 0:1:0 --aim entrance", "--aim and --point exclude", None),
    ("trace double-gauss --pupil-point 0:0.5", "--aim entrance", None, ""),
    ("fit double-gauss", "--seed 4", "--seed needs --pattern sobol", "--pattern sobol"),
    ("fit double-gauss", "--terms 3", "--terms needs --glass", None),
    ("fit double-gauss", "--formula cauchy", "--formula needs --glass", None),
) + tuple(("fit double-gauss --prescription efl=101 --vary R1", option,
           f"--prescription and {option.split()[0]} exclude", None)
          for option in ("--distortion 1", "--rays 20", "--field 0,10", "--match rays",
                         "--no-clip", "--chromatic")) + (
    ("glass N-BK7", "--count 3", "--count needs --like or --nd or --vd", None),
    ("glass", "--count 3 --nd 1.5", None, ""),
    ("glass N-BK7", "--air ciddor", "--air needs --temperature or --pressure",
     "--temperature 20"),
    ("dof -f 50 -s 3 -N 5.6", "-w 500", "--wavelength needs --lens or --coc airy", "--coc airy"),
    ("dof -s 3 -N 5.6", "-w 500 --lens double-gauss", None, ""),
    ("dof -f 50 -s 3 -N 5.6", "-w 500 --coc 0.03,airy", None, ""),
    ("hyperfocal -f 50 -N 5.6", "-w 500", "--wavelength needs", "--coc airy"),
    ("equivalent -f 50 -N 5.6 --sensor 4/3", "-w 500", "--wavelength needs", "--coc airy"),
    ("tilt -f 90 -N 5.6 --tilt 5 -s 0.6", "-w 500", "--wavelength needs --coc airy",
     "--coc airy"),
    ("exposure -N 8 --ev 12", "-w 500", "--wavelength needs --lens", None),
    ("exposure -N 8 --ev 12", "-P 2", "--pupil needs --magnification", "-m 1"),
    ("fov -f 50", "-w 500", "--wavelength needs --lens", None),
    ("focus -f 50 -s 3", "-w 500", "--wavelength needs --lens", None),
    ("timelapse --shots 9 --interval 5", "--gap 2", "--gap needs --time", "-t 2"),
    ("timelapse --shots 9 --interval 5 -t 2", "--declination 9", "--declination needs --focal-length",
     "-f 24"),
    ("fov -f 50 -s 3", "-v 2m/s", "--speed needs --line-scan", "--line-scan --pitch 7um"),
    ("fov -f 50 --sensor imx264", "--dori --task detect", "exclude each other", None),
    ("stars -f 24 -N 2.8", "--trail 10um --coc 0.02", "--trail and --coc exclude", None),
    ("stars -f 24 -N 2.8", "-w 500", "--wavelength needs", "--trail airy"),
    ("draw double-gauss --no-rays", "--field 5", "--no-rays and --field exclude", None),
    ("draw double-gauss", "--construction --field-x 5", "--construction and --field-x", None),
    ("trace double-gauss --point 0:5:-20", "-N 4 --no-clip", "no --aperture", None),
    ("pupil double-gauss", "--focus best", "--focus needs --height", "--height 5"),
    ("color double-gauss --show zone", "--field 5", "--field needs --show", None),
    ("tolerance double-gauss --grade high --criterion efl --trials 2", "-w 500",
     "no --wavelength", "--gap last"),
    ("glass --catalog OHARA --abbe /dev/null", "--label SCHOTT:N-BK7", "none of the glasses", None),
    ("wavefront double-gauss --zernike noll", "--error 1e-3", "--zernike and --error", None),
    ("focus -s 3", "-f 26mm-eq", "this command has none", None),
    ("timelapse --shots 9 --interval 5 -t 2", "-f 24mm-eq", "this command has none", None),
    ("flash -g 36 -N 8", "--sync 1/200", "--sync needs --time", "-t 1/125 --ev 12"),
)


class Asked:
    """A command's question, tried with more options; the folder has data that cannot be read."""

    def __init__(self, program, command, folder):
        self.program, self.command, self.folder = program, command, folder
        question, self.pair, self.batch = ASKED[command]
        self.question = question.split()
        self.plain = self.run()

    def run(self, *more, question=None, stdin=""):
        words = [*(self.question if question is None else question), *more]
        if self.command == "bench" and not {"--columns", "--value", "--plot"} & set(words):
            words += UNTIMED
        return self.program.run(self.command, *words, stdin=stdin, cwd=self.folder)

    def differs(self, *more, plain=None):
        result = self.run(*more)
        return result.returncode == 0 and result.stdout != (plain or self.plain).stdout

    def without(self, *options):
        """The question without these options, which a sweep or a batch gives."""
        words, at = [], 0
        while at < len(self.question):
            word = self.question[at]
            if word.startswith("-") and word.lstrip("-") in options:
                at += 1
            else:
                words.append(word)
            at += 1
        return words

    def swept(self, *more):
        names, lists = self.pair[::2], self.pair[1::2]
        words = self.without(*names)
        for name, values_of in zip(names, lists):
            words += ["-" * (1 + (len(name) > 1)) + name + "=" + values_of]
        return self.run(*more, question=words)

    def batched(self, *more, rows=None):
        header = self.batch.split("\n")[0]
        return self.run("--batch", "-", *more, question=self.without(header),
                        stdin=self.batch if rows is None else rows)

    def with_lens(self, *more):
        """A file that another program wrote, in place of any lens."""
        words = [word for word in self.question if word not in ("double-gauss", "--lens")]
        if words == self.question:
            words = self.without("f")
        if self.command == "fit":
            words += ["--field", "0,5"]
        return self.run("--lens", "./odd.zmx", *more, question=words)


def try_format(asked):
    return asked.differs("--format", "html") and asked.differs("--format", "json")


def try_short(name):
    return lambda asked: asked.differs(f"--{name}")


def try_explain(asked):
    """Below the answer, or on standard error beside a picture."""
    result = asked.run("--explain")
    return result.returncode == 0 and (result.stdout != asked.plain.stdout or
                                       result.stderr != asked.plain.stderr)


def try_columns(asked):
    name = asked.run("--csv").stdout.decode().split("\n")[0].split(",")[0]
    return asked.run("--csv", "--columns", name).stdout.decode().split("\n")[0] == name


def try_value(asked):
    header, first = asked.run("--csv").stdout.decode().split("\n")[:2]
    name, cell = (next(csv.reader([line]))[0] for line in (header, first))
    return asked.run("--value", name).stdout.decode().split("\n")[0] == cell


def try_no_header(asked):
    header, *rows = asked.run("--csv").stdout.split(b"\n")
    bare = asked.run("--csv", "--no-header").stdout.split(b"\n")
    return len(bare) == len(rows) and header not in bare


def try_digits(asked):
    return asked.differs("--csv", "--digits", "2", plain=asked.run("--csv"))


def try_table(asked):
    cell = ":y_out_mm" if asked.command == "trace" else ""  # the command proposes none
    result = asked.swept("--table", f"{asked.pair[0]},{asked.pair[2]}{cell}")
    return result.returncode == 0 and result.stdout != asked.swept().stdout


DRAW_ONE = ("tolerance", "bench", "optimize")  # their plots are of one answer


def plotted(asked, *more):
    """A plot of an answer with several values, where the command wants that."""
    pair = asked.pair if asked.command not in DRAW_ONE else None
    return (asked.run("--plot", "plot.svg", *more) if pair is None else
            asked.run("--plot", "plot.svg", *more, question=asked.without(pair[0]) +
                      ["-" * (1 + (len(pair[0]) > 1)) + pair[0] + "=" + pair[1]]))


def try_plot(asked):
    path = os.path.join(asked.folder, "plot.svg")
    result = plotted(asked)
    with open(path if os.path.exists(path) else os.devnull, "rb") as file:
        written = file.read().startswith(b"<?xml")
    return result.returncode == 0 and written


def try_drawing(option, value, wanted):
    """It needs a drawing, and changes that."""
    def attempt(asked):
        alone = asked.run(option, value)
        if asked.command == "draw":
            return wanted in alone.stdout
        if asked.command == "report":
            asked.run(option, value, "-o", "page.svg")
            with open(os.path.join(asked.folder, "page.svg"), "rb") as file:
                return wanted in file.read()
        if alone.returncode != 2 or f"{option} needs --".encode() not in alone.stderr:
            return False
        if asked.command == "tone":  # its frames here have no response; check_lettering.py draws
            return True
        path = os.path.join(asked.folder, "plot.svg")
        if os.path.exists(path):
            os.remove(path)  # a search writes over none
        plotted(asked, option, value)
        with open(path if os.path.exists(path) else os.devnull, "rb") as file:
            return wanted in file.read()
    return attempt


def try_units(asked):
    if asked.command == "diffraction":  # the distances of the best f-number
        asked.question = "-f 50 --near 2 --far 10".split()
        asked.plain = asked.run()
    return asked.differs("--units", "imperial")


def try_batch(asked):
    result = asked.batched("--csv")
    return result.returncode == 0 and result.stdout.count(b"\n") > asked.batch.count("\n") - 1


def try_batch_format(asked):
    return asked.batched("--batch-format", "jsonl").returncode not in (0, asked.batched().returncode)


def try_fail_fast(asked):
    header = asked.batch.split("\n")[0]
    rows = f"{header}\nx\nx\n"
    plain, fast = (asked.batched(*more, rows=rows).stderr.count(b": standard input:")
                   for more in ((), ("--fail-fast",)))
    return plain == 2 and fast == 1


# Command without a batch -> a question that reads a file, which it is then asked to write to.
OVERWRITING = {
    "draw": ("./own.svg", "own.svg"),
    "report": ("./own.html", "own.html"),
    "convert": ("own.lens", "own.lens"),
    "list": ("glasses --agf own.agf", "own.agf"),
    "tone": ("own.png", "own.png"),
    "render": ("own.png -s 1 --size 16x8 --samples 1 --lens double-gauss", "own.png"),
    "merge": ("own.part", "own.png"),
}


def try_overwriting(asked):
    """What is read is not written over without --force."""
    run, folder = asked.program.run, asked.folder
    words, name = OVERWRITING.get(asked.command, ("", ""))
    if name == "own.png":
        run("render", *ASKED["render"][0].split(), "-o", name, cwd=folder)
        run("render", *OVERWRITING["render"][0].split(), "-o", "own.part", cwd=folder)
    else:
        run("convert", "double-gauss", "-o", "own.lens", cwd=folder)
        os.replace(os.path.join(folder, "own.lens"), os.path.join(folder, name))
    plain, forced = (asked.run("-o", name, *more, question=words.split())
                     for more in ((), ("--force",)))
    return b"also read: --force" in plain.stderr and b"--force" not in forced.stderr


def try_force(asked):
    """More than a million rows are refused; with --force the next error comes."""
    if asked.command in OVERWRITING:
        return try_overwriting(asked)
    header = asked.batch.split("\n")[0]
    option = "-" * (1 + (len(header) > 1)) + header
    words = asked.without(header) + [option, "1..2#1000001", "--columns", "nothing"]
    plain, forced = asked.run(question=words), asked.run("--force", question=words)
    return b"--force" in plain.stderr and forced.stderr.find(b"nothing") > 0


def try_output(asked):
    ending = {"draw": "out.svg", "convert": "out.lens", "fit": "out.lens", "optimize": "out.lens",
              "render": "out.png", "merge": "out.png", "tone": "out.png",
              "report": "out.html"}.get(asked.command, "out")
    saves = {"distortion": "double-gauss --fit poly3 -o out.xml".split(),
             "tolerance": "double-gauss --trials 9 --save worst:1 -o out.lens".split()}
    if asked.command in saves:
        return asked.run(question=saves[asked.command]).returncode == 0
    result = asked.run("-o", ending)
    path = os.path.join(asked.folder, ending)
    with open(path if os.path.exists(path) else os.devnull, "rb") as file:
        content = file.read()
    return result.returncode == 0 and (content == asked.plain.stdout or
                                        asked.command in ("fit", "optimize"))


def try_lensdb(asked):
    """Tables that cannot be read are an error where they are used."""
    words = {"glass": ["N-BK7", "-w", "d"]}.get(asked.command)
    return (asked.run("--lensdb", "bad", question=words).returncode == 4 or
            asked.run("--lensdb", "bad", "--nominal").returncode == 4)


def try_agf(asked):
    if asked.command in ("glass", "list"):
        question = {"glass": None, "list": ["glasses"]}[asked.command]
        return asked.run("--agf", "bad.agf", question=question).returncode == 4
    return asked.with_lens("--lossy", "--agf", "bad.agf").returncode == 4


def try_lossy(asked):
    plain, lossy = asked.with_lens(), asked.with_lens("--lossy")
    return plain.returncode == 4 and lossy.returncode == 0 and b"lost:" in lossy.stderr


def try_glass_numbers(asked):
    """The indices beside the name of a glass are others than its own."""
    line, catalog = (asked.with_lens("--lossy", "--glass-numbers", which)
                     for which in ("line", "catalog"))
    return line.returncode == catalog.returncode == 0 and line.stdout != catalog.stdout


def try_stop_size(asked):
    """A word for no ray is refused; check_stop_size.py of tests/truth has what the others do."""
    result = asked.with_lens("--lossy", "--stop-size", "wrong")
    return result.returncode == 2 and b"lens, paraxial, real" in result.stderr


def try_usage(asked):
    """Examples and its own options, a line each: all that --help shows, and no more."""
    brief, whole = (asked.run(word).stdout.decode() for word in ("-h", "--help"))
    own, name = whole.partition("\nCommon options:\n")[0], r"^ {2}(?:-\w, |    )(--[a-z-]+)"
    return re.findall(name, brief, re.M) == re.findall(name, own, re.M) and all(
        len(line) <= 80 for line in brief.split("\n") if not line.startswith("  lenscalc"))


def try_help(asked):
    return b"Examples:" in asked.run("--help").stdout


def with_config(asked, *more):
    """The question with a file of defaults whose kit has a word for no colour."""
    path = os.path.join(asked.folder, "kit.conf")
    with open(path, "w") as file:
        file.write("[kit wrong]\ncolor = purple\n")
    return asked.program.run(asked.command, *asked.question, *more, cwd=asked.folder,
                             variables={"LENSCALC_CONFIG": path})


def try_kit(asked):
    """Its options are taken where it is asked for, and only there."""
    wrong = with_config(asked, "-K", "wrong")
    return wrong.returncode == 4 and b"kit.conf:2:9: " in wrong.stderr and \
        with_config(asked).returncode == asked.plain.returncode


def try_no_config(asked):
    """A file that is not there is not missed."""
    plain, without = (asked.program.run(asked.command, *asked.question, *more, cwd=asked.folder,
                                        variables={"LENSCALC_CONFIG": "nowhere"})
                      for more in ((), ("--no-config",)))
    return plain.returncode == 5 and without.returncode == asked.plain.returncode


def try_color(asked):
    """What is wrong is said in colours, where they are asked for."""
    return asked.run("--no-such-option", "--color", "always").stderr.startswith(b"\033[")


def try_terminal(asked):
    """How something is shown, where it is: without, it has nothing to do."""
    result = asked.run("--terminal", "sixel")
    return result.returncode == 2 and b"a file called term is the terminal" in result.stderr


TRIES = {
    "--format": try_format, "--columns": try_columns, "--digits": try_digits,
    "--value": try_value, "--no-header": try_no_header,
    "--units": try_units, "--table": try_table, "--plot": try_plot,
    "--theme": try_drawing("--theme", "dark", b'fill="#17191d"'),
    "--title": try_drawing("--title", "Of <mine>", b">Of &lt;mine&gt;</text>"),
    "--subtitle": try_drawing("--subtitle", "5 um", ">5 µm</text>".encode()),
    "--explain": try_explain, "--nominal": try_short("nominal"), "--batch": try_batch,
    "--batch-format": try_batch_format, "--fail-fast": try_fail_fast, "--force": try_force,
    "--output": try_output, "--lensdb": try_lensdb, "--agf": try_agf, "--lossy": try_lossy,
    "--glass-numbers": try_glass_numbers, "--stop-size": try_stop_size, "--color": try_color,
    "--terminal": try_terminal,
    "--kit": try_kit, "--no-config": try_no_config, "--help": try_help, "--usage": try_usage,
}
TRIES.update({f"--{name}": try_short(name) for name in ("csv", "tsv", "json", "jsonl")})


def common_options(program):
    rows = program.run("list", "options", "--kind", "all", "--tsv", "--columns", "option,value")
    return [row.split("\t") for row in rows.stdout.decode().split("\n")[1:-1]]


def shown_options(program, command):
    """(its own, the common ones that it uses)"""
    text = program.run(command, "--help").stdout.decode()
    own, _, common = text.partition("\nCommon options:\n")
    return tuple(set(re.findall(r"^ {2}(?:-\w, |    )(--[a-z-]+)", part, re.M))
                 for part in (own.partition("\nOptions:\n")[2], common))


def make_folder(folder):
    os.makedirs(os.path.join(folder, "bad", "glass"))
    os.makedirs(os.path.join(folder, "bad", "lenses"))
    for name in TABLES:
        with open(os.path.join(folder, "bad", name + ".tsv"), "w") as file:
            file.write("nothing\tof\tuse\nx\ty\n")
    with open(os.path.join(folder, "bad", "lenses", "double-gauss.lens"), "w") as file:
        file.write("nothing of use\n")
    with open(os.path.join(folder, "bad.agf"), "w") as file:
        file.write("NM\nnothing of use\n")
    with open(os.path.join(folder, "odd.zmx"), "w") as file:
        file.write(ODD_LENS)


def check_batch_beside_option(checks, asked):
    """A filled cell wins over an option, which is what an empty one takes."""
    header, *cells = asked.batch.split("\n")[:3]
    name, question = "-" * (1 + (len(header) > 1)) + header, asked.without(header)
    plain = asked.batched("--csv")
    for cell in cells:
        words = ("--batch", "-", "--csv", f"{name}={cell}")
        filled = asked.run(*words, question=question, stdin=asked.batch)
        checks.check(filled.returncode == 0 and filled.stdout == plain.stdout,
                     f"{asked.command} {name}={cell} beside a column of it: status "
                     f"{filled.returncode}, {filled.stderr.decode()[:200]!r}")
        empty, full = (asked.run(*words, question=question, stdin=f"{header}\n{text}\n")
                       for text in ('""', cell))
        checks.check(empty.returncode == 0 and empty.stdout == full.stdout,
                     f"{asked.command}: an empty cell of {header} is not {name}={cell}")


def check_absent_columns(checks, asked):
    """A column that is asked for and has no value says so, and when it would have one.

    Where nothing is doubtful a warning is rightly empty for programs.
    """
    listed = asked.run("--columns", "?", "--csv", question=[]).stdout.decode()
    names = [row["column"] for row in csv.DictReader(io.StringIO(listed))
             if row["shown"] != "as a warning" and row["column"] != "warning"]
    names = list(dict.fromkeys(names))
    every = ",".join(names)
    if not asked.run("--csv", "--columns", every).stdout.startswith(f"{every}\n".encode()):
        names = [name for name in names  # some are of other answers
                 if asked.run("--csv", "--columns", name).stdout.startswith(f"{name}\n".encode())]
    for format in ("--csv", "--json"):
        result = asked.run(format, "--columns", ",".join(names))
        error = result.stderr.decode()
        if format == "--json":
            rows = json.loads(result.stdout)["rows"]
            absent = {name for name in names if all(
                row[name] is None and not any(value for key, value in row.items()
                                              if key.endswith("_is_infinite")
                                              and name.startswith(key[:-12]))
                for row in rows)}
        else:
            rows = list(csv.DictReader(io.StringIO(result.stdout.decode())))
            absent = {name for name in names if all(row[name] == "" for row in rows)}
        said = set(re.findall(r": (\S+) has no value here: .", error))
        checks.check(rows and said == absent, f"{asked.command} {format}: said to be absent are "
                     f"{sorted(said - absent)}, not said {sorted(absent - said)}")
        for name in sorted(absent)[:2]:
            text = asked.run("--columns", name).stdout.decode()
            checks.check(re.search(r"(^|\s)-\s", text) and len(text.split()) > 3,
                         f"{asked.command} --columns {name}: {text!r}")


def check_command(checks, program, command, options):
    own, used = shown_options(program, command)
    with tempfile.TemporaryDirectory(prefix="lenscalc-options-") as folder:
        make_folder(folder)
        if command == "merge":
            program.run("render", *ASKED["render"][0].split(), "-o", "one.part", cwd=folder)
        if command == "tone":
            program.run("render", *ASKED["render"][0].split(), "-o", "one.png", cwd=folder)
        asked = Asked(program, command, folder)
        checks.check(asked.plain.returncode == 0, f"{command} {ASKED[command][0]}: status "
                     f"{asked.plain.returncode}: {asked.plain.stderr.decode()[:200]}")
        if "--columns" in used:
            check_absent_columns(checks, asked)
        if asked.batch is not None:
            check_batch_beside_option(checks, asked)
        for option, value in options:
            name = f"{command} {option}"
            if option in used or option in own:
                checks.check(TRIES[option](asked), f"{name} is shown by --help, and does nothing")
                continue
            result = asked.run(*([option] if value == "" else [option, "x"]))
            error = result.stderr.decode()
            checks.check(result.returncode == 2 and f"{option} does nothing here" in error,
                         f"{name}: status {result.returncode}, {error[:120]!r}")


def check_idle(checks, program, commands):
    for question, options, refusal, served in IDLE:
        if question.split()[0] not in commands:
            continue
        words = f"{question} {options}"
        if refusal is not None:
            result = program.run(*words.split())
            checks.check(result.returncode == 2 and refusal in result.stderr.decode(),
                         f"{words}: status {result.returncode}, {result.stderr.decode()[:120]!r}")
        if served is not None:
            result = program.run(*words.split(), *served.split())
            checks.check(result.returncode == 0, f"{words} {served}: {result.stderr.decode()[:120]!r}")
    batch = program.run(*"dof -f 50 -s 3 -N 5.6 -w 500 --batch -".split(), stdin="coc\nairy\n")
    checks.check(batch.returncode == 0, f"columns of a batch count as given: {batch.stderr[:120]}")


def check_fields_apart(checks, program):
    """Rows of a sweep can be distinguished."""
    result = program.run(*"surfaces double-gauss --field 7,14 --csv --columns field_deg".split())
    rows = result.stdout.decode().split("\n")[1:-1]
    checks.check(set(rows) == {"7", "14"} and len(rows) > 2, f"surfaces --field: {rows}")


def main():
    checks, program = Checks(), Program(sys.argv[1])
    rows = program.run("list", "commands", "--columns", "command", "--csv").stdout.decode()
    commands, options = rows.split("\n")[1:-1], common_options(program)
    checks.check(len(commands) > 20 and len(options) > 10, f"{commands} {options}")
    checks.check({option for option, _ in options} == set(TRIES),
                 f"tried are {set(TRIES)}, there are {options}")
    if not os.path.exists(os.path.join(program.build, "lenscalc-ceres")):
        print(f"{', '.join(NEED_SOLVER)}: skipped, CERES=0")
        commands = [command for command in commands if command not in NEED_SOLVER]
    check_idle(checks, program, commands)
    check_fields_apart(checks, program)
    for command in commands:
        if checks.check(command in ASKED, f"{command} has no question in ASKED"):
            check_command(checks, program, command, options)
    checks.finish()


if __name__ == "__main__":
    main()
