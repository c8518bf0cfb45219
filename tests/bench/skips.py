"""tests/bench/skips.py - each thing that is not done: how much longer it would take to do it, and
the proof that the answer is the same: the same bits, a difference at rounding, or noise that is
no more than between two seeds."""
# SPDX-License-Identifier: MIT

import glob
import os
import subprocess

from common import SPAWNS, entry
from render import against, processor_time, words_of, write_scenes

STEPS = {
    "clip": "no clipping where nothing is clear to a diameter",
    "path": "no optical path where it is not asked for",
    "spheres": "steps of spheres, not of conics",
    "planes": "steps of planes, not of spheres",
}

# what --no-skip takes, and, after a comma, of what, with a scene that lives by it; of the pupil
# to the same error
LIVES_BY = {
    "pupil": "chart:checker --lens double-gauss-50 -s 1m -t 1/100 --size 240x160 --error 0.01",
    "colour": "chart:checker --lens double-gauss-50 -s 1m --model thick -t 1/100 --size 240x160",
    "colour, scene": "portrait.scene --lens double-gauss-50 -t 1/100 --size 120x80 --samples 32",
    "blur": "chart:star --lens double-gauss-50 -s 1m -N 16 -t 1/10 --size 240x160",
    "uniform": "chart:edge --lens double-gauss-50 -s 1m -t 1/100 --size 240x160",
    "exposures": "chart:star --lens double-gauss-50 -s 1m -t 1/50,1/100,1/200 --size 240x160",
    "time": "portrait.scene --lens double-gauss-50 -t 1/100 --size 120x80 --bounces 1",
    "secondary": "lamps.scene --lens double-gauss-50 -t 1/100 --size 240x160 --samples 256",
}

# a command with all of its columns, and one that needs less work
COLUMNS = {
    "fov: breathing": ("fov --lens double-gauss-50 --csv -s 0.5..5#200", "horizontal"),
    "spot: radius": ("spot double-gauss --csv --field 0..14#12", "rms"),
    "illumination: light by field": ("illumination double-gauss --csv --height 0..20#12", "height"),
    "exposure: labels": ("exposure -t 1/100 -N 1..64#100001 --csv", "ev100"),
}

# analyses of one wavelength, and a column of them; the others would be traced all the same if they
# had weights that count for nothing beside the first
ONE, OTHERS = "--spectrum d:1", ",F:1e-300,C:1e-300"
ANALYSES = {
    "spots": ("spot double-gauss --csv --field 0..14#24 --error 1e-8", "rms_um"),
    "contrast": ("mtf double-gauss --csv --frequency 10..50#5", "tangential"),
}


def steps(bench):
    """Of exact rays through the double Gauss, and through plates."""
    output = subprocess.run([bench.linked("skips")], check=True, capture_output=True, text=True)
    for line in output.stdout.splitlines():
        name, ratio, moved = line.split()
        proof = "same bits" if moved == "0" else f"within {float(moved):.1g} mm"
        yield entry(f"skips: {STEPS[name]}", float(ratio), "x", proof)


def floats(path):
    """Those of a PFM picture."""
    with open(path, "rb") as file:
        for _ in range(3):
            file.readline()
        return memoryview(file.read()).cast("f")


def same_light(bench, words, skip):
    """How alike pictures are with a skip and without it, and without it by another seed."""
    for path in glob.glob(bench.path("render*.pfm")):
        os.remove(path)

    def picture(*more):
        processor_time([*words, *more])
        return floats(sorted(glob.glob(bench.path("render*.pfm")))[0])

    taken = picture()
    kept = picture("--no-skip", skip)
    if taken == kept:
        return "same bits"
    other = picture("--no-skip", skip, "--seed", "2")
    count = len(kept)
    noise = sum((a - b) ** 2 for a, b in zip(kept, other)) / count
    apart = sum((a - b) ** 2 for a, b in zip(taken, kept)) / count
    shift = abs(sum(taken) - sum(kept)) / count
    # the mean of a picture without noise of its own differs by half the variance of two
    sigmas = shift / max((noise / 2 / count) ** 0.5, 1e-300)
    return (f"differs by {(apart / noise) ** 0.5:.2f} of what two seeds do, the mean by "
            f"{sigmas:.1f} sigma")


def pictures(bench):
    write_scenes(bench)
    for name, scene in LIVES_BY.items():
        skip = name.split(",")[0]
        words = words_of(bench, scene)
        times = against(words, skip)
        yield entry(f"skips: {name} of a picture", times[0] / times[1], "x",
                    f"{1000 * times[0]:.0f} ms / {1000 * times[1]:.0f} ms, "
                    f"{same_light(bench, words, skip)}")


def column(text, name):
    """A column of csv by the beginning of its name: its cells."""
    lines = [line.split(",") for line in text.decode().splitlines()]
    at = next(i for i, cell in enumerate(lines[0]) if cell.startswith(name))
    return [line[at] for line in lines]


def with_and_without(name, words, wanted):
    """Two commands, the second with less work, of which a column is the same."""
    times = [min(processor_time(one) for _ in range(3)) for one in words]
    cells = [column(subprocess.run(one, check=True, capture_output=True).stdout, wanted)
             for one in words]
    return entry(f"skips: {name}", times[0] / times[1], "x",
                 f"{1000 * times[0]:.0f} ms / {1000 * times[1]:.0f} ms, column {wanted}: "
                 + ("same bytes" if cells[0] == cells[1] else "DIFFERENT"))


def columns(bench):
    for name, (question, wanted) in COLUMNS.items():
        words = bench.words(question)
        yield with_and_without(f"a column nobody asks for, {name}",
                               (words, [*words, "--columns", wanted]), wanted)


def wavelengths(bench):
    for name, (question, wanted) in ANALYSES.items():
        words = [bench.words(f"{question} {ONE}{others}") for others in (OTHERS, "")]
        yield with_and_without(f"one wavelength of {name}", words, wanted)


def faults(words):
    """Pages of memory that a program touches."""
    with subprocess.Popen(words, stdout=subprocess.DEVNULL) as child:
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
    return usage.ru_minflt


def start(bench):
    """Embedded glasses and lenses that are not read, and the second program that is not started."""
    few, all_glasses = bench.words("dof -f 50mm -N 2.8 -s 3m"), bench.words("list glasses")
    words = [bench.tool("spawn"), str(SPAWNS), "/bin/true", "--", *few, "--", *all_glasses]
    solver = bench.lenscalc + "-ceres"
    if os.path.exists(solver):
        words += ["--", solver, "--version"]
    _, short, *others = map(float, subprocess.run(words, check=True, capture_output=True,
                                                  text=True).stdout.split())
    yield entry("skips: embedded data not read, dof", others[0] / short, "x",
                f"{others[0]:.0f} us / {short:.0f} us, {faults(all_glasses)} pages / "
                f"{faults(few)} pages")
    if len(others) > 1:
        yield entry("skips: Ceres not started, dof", others[1] / short, "x",
                    f"{others[1]:.0f} us / {short:.0f} us, {faults([solver, '--version'])} pages / "
                    f"{faults(few)} pages")


def skips(bench):
    for part in (steps, wavelengths, pictures, columns, start):
        yield from part(bench)


SECTIONS = {"skips": skips}
