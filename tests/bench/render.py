"""tests/bench/render.py - pictures with and without what they skip."""
# SPDX-License-Identifier: MIT

import os

from common import entry, fastest

# what --no-skip takes, and a scene that lives by it; of the pupil to the same error
SCENES = {
    "pupil": "chart:checker --lens double-gauss-50 -s 1m -t 1/100 --size 240x160 --error 0.01",
    "colour": "chart:checker --lens double-gauss-50 -s 1m --model thick -t 1/100 --size 240x160",
    "blur": "chart:star --lens double-gauss-50 -s 1m -N 16 -t 1/10 --size 240x160",
    "uniform": "chart:edge --lens double-gauss-50 -s 1m -t 1/100 --size 240x160",
    "exposures": "chart:star --lens double-gauss-50 -s 1m -t 1/50,1/100,1/200 --size 240x160",
}


def skips(bench):
    """Time without a skip over time with it."""
    out = bench.path("render.pfm")
    for name, scene in SCENES.items():
        words = bench.words(f"render {scene} --threads 1") + ["-o", out]
        times = fastest({"with": words, "without": words + ["--no-skip", name]}, os.devnull)
        yield entry(f"render: without / with {name}", times["without"] / times["with"], "x",
                    f"{1000 * times['without']:.0f} ms / {1000 * times['with']:.0f} ms")


SECTIONS = {"render": skips}
