"""tests/bench/models.py - pictures by models of a lens: their error beside their time."""
# SPDX-License-Identifier: MIT

import array
import math
import os

from common import entry

MODELS = ("exact", "paraxial", "fitted", "thick", "thin", "pinhole")
FNUMBERS = 2, 8  # at the first the lens vignettes
# by the same samples, so that what differs is the lens
PICTURE = ("render chart:checker --lens double-gauss-50 -s 1m --field-width 70cm -t 1/500 "
           "--size 360x240 --samples 64")
RUNS = 2


def values_of(path):
    with open(path, "rb") as file:
        data = file.read().split(b"\n", 3)[3]
    return array.array("f", data)


def take(bench, fnumber, model):
    """The picture, and the least seconds of the processor that it took."""
    path, best = bench.path(model + ".pfm"), math.inf
    words = [*bench.words(PICTURE), "-N", str(fnumber), "--model", model, "-o", path]
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
    for fnumber in FNUMBERS:
        exact, exact_time = take(bench, fnumber, "exact")
        size = math.sqrt(sum(value * value for value in exact))
        yield entry(f"models: f/{fnumber}, exact", 0, "%", f"{1e3 * exact_time:.0f} ms")
        for model in MODELS[1:]:
            picture, spent = take(bench, fnumber, model)
            if picture is None:  # fitted, of a program without the solver
                continue
            off = math.sqrt(sum((a - b) ** 2 for a, b in zip(picture, exact)))
            yield entry(f"models: f/{fnumber}, {model}", 100 * off / size, "%",
                        f"{1e3 * spent:.0f} ms, {spent / exact_time:.2f} of exact")


SECTIONS = {"models": models}
