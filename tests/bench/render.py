"""tests/bench/render.py - pictures with and without all that they skip, to the same error."""
# SPDX-License-Identifier: MIT

import math
import os
import subprocess

from common import entry

TURNS = 3

CAMERA = "camera at=0,0,1.5 look=0,0,0 focus=1.5\n"
SCENES = {
    "lamps": "material warm black emission=2700K luminance=3000\n"
             "material cold black emission=8000K luminance=1000\n"
             "card size=0.3,0.2 at=-0.3,0.1,0 material=warm\n"
             "sphere radius=0.1 at=0.2,-0.1,0.2 material=cold\n"
             "sphere radius=0.05 at=0.3,0.15,-0.3 material=warm\n",
    "portrait": "material skin lambert colour=0.6,0.4,0.3\nmaterial wall lambert colour=0.5\n"
                "material lamp black luminance=20000\n"
                "sphere radius=0.12 at=0,0,0 material=skin\nplane at=0,0,-2 material=wall\n"
                "card size=0.8,0.8 at=1,1,1.5 normal=-1,-1,-1.5 material=lamp\n",
    "sky": "light environment file=sky.pfm luminance=3000\n"
           "material ball lambert colour=0.3\nsphere radius=0.15 at=0,0,0 material=ball\n",
}

# all skips against none, to the same error, which there are samples enough for
ALL_OR_NONE = {
    "uniform sky about a ball": "sky.scene --lens double-gauss-50 -t 1/1000 --size 120x80 --error 2% "
                               "--samples 65536",
    "still lamps": "lamps.scene --lens double-gauss-50 -t 1/100 --size 120x80 --error 2% "
                   "--samples 65536",
    "grey card, thick lens": "chart:checker --lens double-gauss-50 -s 1m --model thick -t 1/100 "
                             "--size 240x160 --error 1%",
    "portrait wide open": "portrait.scene --lens double-gauss-50 -t 1/100 --size 60x40 --error 5% "
                          "--samples 65536",
    "star stopped down": "chart:star --lens double-gauss-50 -s 1m -N 16 -t 1/10 --size 240x160 "
                         "--error 2%",
}


def write_scenes(bench):
    for name, things in SCENES.items():
        with open(bench.path(f"{name}.scene"), "w", encoding="ascii") as file:
            file.write(CAMERA + things)
    with open(bench.path("sky.pfm"), "wb") as file:
        file.write(b"PF\n2 1\n-1.0\n" + 6 * b"\0\0\x80?")


def words_of(bench, scene):
    """The command; its scene lies with the others."""
    name, *options = scene.split()
    subject = bench.path(name) if name.endswith(".scene") else name
    return [bench.lenscalc, "render", subject, *options, "--threads", "1", "-o",
            bench.path("render.pfm")]


def processor_time(words):
    """Seconds of the processor, which others on the machine do not lengthen much."""
    with subprocess.Popen(words, stdout=subprocess.DEVNULL,
                          stderr=subprocess.DEVNULL) as child:
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        raise SystemExit(f"bench: {' '.join(words)} ended with {child.returncode}")
    return usage.ru_utime + usage.ru_stime


def against(words, kept):
    """Least time without skips, and with them."""
    times = [(processor_time(words + ["--no-skip", kept]), processor_time(words))
             for _ in range(TURNS)]
    return min(without for without, _ in times), min(with_it for _, with_it in times)


def pictures(bench):
    """Time without skips over time with them, and the mean of these."""
    write_scenes(bench)
    logarithms = []
    for name, scene in ALL_OR_NONE.items():
        times = against(words_of(bench, scene), "all")
        logarithms.append(math.log(times[0] / times[1]))
        yield entry(f"render: none / all skips, {name}", times[0] / times[1], "x",
                    f"{1000 * times[0]:.0f} ms / {1000 * times[1]:.0f} ms")
    yield entry("render: none / all skips, geometric mean",
                math.exp(sum(logarithms) / len(logarithms)), "x")


SECTIONS = {"render": pictures}
