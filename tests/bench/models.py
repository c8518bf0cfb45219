"""tests/bench/models.py - pictures by models of a lens: their error beside their time."""
# SPDX-License-Identifier: MIT

import array
import math
import os

from common import entry

MODELS = ("exact", "paraxial", "fitted", "thick", "thin", "pinhole")
# by the same samples, or nearly, so that what differs is the lens; at f/2 it vignettes
PICTURES = (
    ("", (2, 8), "render chart:checker --lens double-gauss-50 -s 1m --field-width 70cm -t 1/500 "
                 "--size 360x240 --samples 64"),
    ("lamps at several distances, ", (2,),
     "render lamps.scene --lens double-gauss-50 -t 1/500 --size 240x160 --samples 64 --bounces 0"),
)
LAMPS = """camera at=0,0,1 look=0,0,0 focus=1
material warm black emission=2700K luminance=3000
material cold black emission=8000K luminance=1000
card size=0.3,0.2 at=-0.12,0.1,0 material=warm
sphere radius=0.08 at=0.15,-0.1,0.2 material=cold
sphere radius=0.3 at=0.4,0.3,-1 material=warm
card size=9,9 at=0,0,-4 material=cold
"""
RUNS = 2


def values_of(path):
    with open(path, "rb") as file:
        data = file.read().split(b"\n", 3)[3]
    return array.array("f", data)


def take(bench, words, fnumber, model):
    """The picture, and the least seconds of the processor that it took."""
    path, best = bench.path(model + ".pfm"), math.inf
    words = [bench.path(word) if word.endswith(".scene") else word for word in bench.words(words)]
    words += ["-N", str(fnumber), "--model", model, "-o", path]
    for _ in range(RUNS):
        child = os.posix_spawn(words[0], words, os.environ, file_actions=[
            (os.POSIX_SPAWN_OPEN, 2, os.devnull, os.O_WRONLY, 0)])
        _, status, usage = os.wait4(child, 0)
        if status != 0:
            return None, math.nan
        best = min(best, usage.ru_utime + usage.ru_stime)
    return values_of(path), best


def models(bench):
    """Root mean square of the difference from the exact picture, over that of the picture."""
    with open(bench.path("lamps.scene"), "w", encoding="ascii") as file:
        file.write(LAMPS)
    for name, fnumber, words in [(name, fnumber, words) for name, fnumbers, words in PICTURES
                                 for fnumber in fnumbers]:
        exact, exact_time = take(bench, words, fnumber, "exact")
        size = math.sqrt(sum(value * value for value in exact))
        yield entry(f"models: {name}f/{fnumber}, exact", 0, "%", f"{1e3 * exact_time:.0f} ms")
        for model in MODELS[1:]:
            picture, spent = take(bench, words, fnumber, model)
            if picture is None:  # fitted, of a program without the solver
                continue
            off = math.sqrt(sum((a - b) ** 2 for a, b in zip(picture, exact)))
            yield entry(f"models: {name}f/{fnumber}, {model}", 100 * off / size, "%",
                        f"{1e3 * spent:.0f} ms, {spent / exact_time:.2f} of exact")


SECTIONS = {"models": models}
