#!/usr/bin/env python3
"""tests/truth/check_tolerance.py - lenses of trials against what was written of them:
check_tolerance.py BUILD_DIR

200 lenses as they may be made, of ten designs, are written as files, read again, and looked at by
spot, wavefront, lens, distortion and color; of some also by mtf, which adds rays until contrasts
are right to what it says, and by a pupil that is clipped. The figures are those of the trials.
"""
# SPDX-License-Identifier: MIT

import csv
import glob
import io
import os
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program
from meridional import first_order

# with aspheres, catalogue glasses, model glasses, positions, a cemented triplet
LENSES = ("double-gauss", "double-gauss-50", "cooke-triplet-50", "brendel-tessar-100",
          "phone-80deg", "canon-ef50-f18", "itoh-zoom-100-146", "laikin91-telephoto",
          "rudolph-planar-100", "cs348b-wide-22")
TRIALS = 20
# of the lens, mm: what is left of doubles after a dozen surfaces, whatever size a spot has
ROUNDING = 4e-13
RAYS = ["--pattern", "gauss", "--rays", "12"]
OPEN = ["--no-clip", *RAYS]


class Question:
    """A criterion: words for tolerance, the command that says the same with its words, its column
    (of two directions two), and what it may be off by: of itself, and in its own unit."""

    def __init__(self, criterion, command, columns, least, *, share=1e-12, trial=(), asked=(),
                 lenses=LENSES):
        self.criterion, self.command, self.columns = criterion, command, columns
        self.share, self.least = share, least
        self.trial, self.asked, self.lenses = list(trial), list(asked), lenses


QUESTIONS = (
    Question("spot", "spot", ["rms_um"], 1e3 * ROUNDING, trial=OPEN, asked=OPEN),
    # a wave is half a thousandth of a mm
    Question("wavefront", "wavefront", ["rms_waves"], 2e3 * ROUNDING,
             trial=["-w", "d", *OPEN], asked=["-w", "d", *OPEN]),
    Question("efl", "lens", ["efl_mm"], ROUNDING),
    Question("bfl", "lens", ["bfl_mm"], ROUNDING),
    # percent of an image height of mm at least
    Question("distortion", "distortion", ["distortion_percent"], 100 * ROUNDING),
    # its own error is the least that it takes
    Question("mtf@30", "mtf", ["tangential", "sagittal"], 2e-8, share=0,
             trial=["-w", "d", "-N", "8", "--rays", "200"],
             asked=["-w", "d", "-N", "8", "--no-clip", "--frequency", "30", "--error", "1e-8"],
             lenses=("double-gauss",)),
)


def rows_of(program, folder, *words):
    result = subprocess.run([*program.command, *words], cwd=folder, text=True, check=False,
                            capture_output=True, env=program.environment())
    if result.returncode != 0:
        return None, result.stderr
    return list(csv.DictReader(io.StringIO(result.stdout))), ""


def marks(count, media):
    """Every kind of error that a file can hold."""
    glasses = "".join(f"tolerance n{i} 0.001\n" for i in media)
    return (f"tolerance R1..R{count} 0.2%\ntolerance t1..t{count - 1} 0.02\n{glasses}"
            f"tolerance elements 1..{count} tilt 2arcmin\n"
            f"tolerance elements 1..{count} decenter 0.02\n"
            f"tolerance surface 1..{count} tilt 1arcmin normal\n")


def write_marks(program, folder, name):
    surfaces, message = rows_of(program, folder, "surfaces", name, "--csv")
    if not surfaces:
        return message
    count = max(int(row["surface"]) for row in surfaces)
    media = sorted({int(row["surface"]) for row in surfaces
                    if row["medium"] not in ("air", "mirror", "1")})
    with open(os.path.join(folder, "marks.txt"), "w", encoding="ascii") as file:
        file.write(marks(count, media))
    return ""


def tried(program, folder, name, question, *words):
    """The rows of all trials, {trial: [row]}."""
    rows, message = rows_of(program, folder, "tolerance", name, "--tolerances", "marks.txt",
                            "--trials", str(TRIALS), "--aim", "stop", "--of", "each", "--show",
                            "trials", "--criterion", question.criterion, "--csv", *question.trial,
                            *words)
    trials = {}
    for row in rows or []:
        trials.setdefault(row["trial"], []).append(row)
    return trials, message


def saved(folder):
    """{trial: path} of what was written."""
    files = {}
    for path in glob.glob(os.path.join(folder, "made-*.lens")):
        with open(path, encoding="utf-8") as file:
            files[next(line.split()[5] for line in file
                       if line.startswith("note        as made"))] = path
    return files


def said(program, folder, files, question, has_positions):
    """What the command says of the lenses, {trial: [row]}."""
    with open(os.path.join(folder, "files.csv"), "w", encoding="ascii") as file:
        file.write("lens,trial\n" + "".join(f"{path},{trial}\n" for trial, path in files.items()))
    words = ["--position", "all"] if has_positions else []
    rows, message = rows_of(program, folder, question.command, "--batch", "files.csv", *words,
                            "--columns", "wavelength_nm," + ",".join(question.columns), "--csv",
                            *question.asked)
    answers = {}
    for row in rows or []:
        answers.setdefault(row["trial"], []).append(row)
    return answers, message


def figures_of(rows, question):
    """As trials have them: of the first wavelength; a distortion of a field off the axis."""
    rows = [row for row in rows if row["wavelength_nm"] == rows[0]["wavelength_nm"]]
    return [row[column] for row in rows for column in question.columns if row[column] != ""]


def compare(program, checks, folder, name, question, trials, files):
    has_positions = any(row["position"] for rows in trials.values() for row in rows)
    answers, message = said(program, folder, files, question, has_positions)
    for number, rows in trials.items():
        what = f"{name}, trial {number}, {question.criterion}"
        figures = figures_of(answers.get(number, []), question)
        if not checks.check(len(figures) == len(rows), f"{what}: {message}"):
            continue
        for row, figure in zip(rows, figures):
            checks.near(question.criterion, f"{what}, {row['of']} {row['position']}",
                        row["figure"], figure, question.share * abs(float(figure)) +
                        question.least)


def check_lens(program, checks, folder, name):
    message = write_marks(program, folder, name)
    if not checks.check(not message, f"{name}: {message}"):
        return
    for refocus in ("best", "none"):
        files = {}
        for question in QUESTIONS:
            if name not in question.lenses or (refocus == "best") != (question is QUESTIONS[0]):
                continue
            words = ["--refocus", refocus]
            if not files:
                words += ["--save", f"worst:{TRIALS}", "-o", "made.lens", "--force"]
            trials, message = tried(program, folder, name, question, *words)
            if not trials and "there is none" in message:  # no field off the axis
                continue
            files = files or saved(folder)
            if checks.check(len(trials) == len(files) == TRIALS,
                            f"{name}, {question.criterion}: {message}"):
                compare(program, checks, folder, name, question, trials, files)


def check_clipped(program, checks, folder, name):
    """Nothing is wrong with a lens: its rays are those that spot lets through, of all colours."""
    with open(os.path.join(folder, "none.txt"), "w", encoding="ascii") as file:
        file.write("tolerance t1 1e-9\n")
    rows, message = rows_of(program, folder, "tolerance", name, "--tolerances", "none.txt",
                            "--refocus", "none", "--of", "each", "--trials", "1", "--csv", *RAYS)
    if not checks.check(rows, f"{name}, clipped: {message}"):
        return
    position = ["--position", "all"] if rows[0]["position"] else []
    spots, message = rows_of(program, folder, "spot", name, *position, "--csv", *RAYS)
    if not checks.check(spots and len(spots) == len(rows), f"{name}, clipped: {message}"):
        return
    for row, spot in zip(rows, spots):
        checks.near("clipped", f"{name}, clipped, {row['of']} {row['position']}", row["nominal"],
                    spot["rms_um"], 1e-12 * float(spot["rms_um"]) + 1e3 * ROUNDING)


def check_airspace(program, checks, folder):
    """One spacer makes the gaps before and behind a stop: its error is one, and that of the focal
    length by its derivative, of paraxial rays with the gap changed either way."""
    half, gaps = 0.05, (3.0, 5.0)
    glass = ((40.0, 4.0, 1.6), (-300.0, None, 1.0), (-35.0, 2.0, 1.7), (60.0, 0.0, 1.0))

    def efl(change):
        lens = [(radius, sum(gaps) + change if thickness is None else thickness, index, 20, False)
                for radius, thickness, index in glass]
        return first_order(lens)[0]

    lines = ["wavelength d", "aperture epd 8"]
    for i, (radius, thickness, index) in enumerate(glass):
        lines.append(f"surface {radius} {gaps[0] if thickness is None else thickness} {index} 20")
        if i == 1:
            lines.append(f"stop - {gaps[1]} air -")
    path = os.path.join(folder, "pair.lens")
    with open(path, "w", encoding="ascii") as file:
        file.write("\n".join(lines) + "\n")
    linear = (efl(half) - efl(-half)) / 2
    for name, words in (("t3", "t1..t5"), ("t2", "t2"), ("t3", "t3")):
        with open(os.path.join(folder, "air.txt"), "w", encoding="ascii") as file:
            file.write(f"tolerance {words} {half}\n")
        rows, message = rows_of(program, folder, "tolerance", path, "--tolerances", "air.txt",
                                "--criterion", "efl", "--refocus", "none", "--show",
                                "sensitivity", "--csv")
        air = [row for row in rows if row["perturbation"] in ("t2", "t3")]
        checks.check([row["perturbation"] for row in air] == [name], f"{words}: {rows} {message}")
        for row in air:
            checks.near("airspace", f"{words}: efl", row["linear"], linear, 1e-4 * abs(linear))


def main():
    program, checks = Program(sys.argv[1]), Checks()
    for name in LENSES:
        with tempfile.TemporaryDirectory(prefix="lenscalc-tolerance-") as folder:
            check_lens(program, checks, folder, name)
            check_clipped(program, checks, folder, name)
    with tempfile.TemporaryDirectory(prefix="lenscalc-tolerance-") as folder:
        check_airspace(program, checks, folder)
    for kind, (share, where) in checks.worst.items():
        print(f"{kind}: {share:.2g} of what is allowed at {where}")
    checks.finish()


if __name__ == "__main__":
    main()
