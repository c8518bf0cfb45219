"""tests/bench/desk.py - the other photographic commands: one answer each, and two pipes."""
# SPDX-License-Identifier: MIT

import random

from common import ROWS, entry, fastest, starts


def desk(bench):
    answers = {"focus": "-f 50mm -s 3m", "exposure": "-N 8 -t 1/125 --iso 100",
               "flash": "--guide-number 36m -s 5m", "bracket": "--from 30s --to 1/1000s",
               "motion": "--speed 10m/s -t 1/250 -f 200mm -s 20m", "stars": "-f 24mm -N 2.8",
               "diffraction": "-N 64", "equivalent": "-f 25mm -N 1.8 --sensor 4/3",
               "tilt": "-f 90mm -N 11 --tilt 5deg -s 3m", "panorama": "-f 35mm"}
    yield from starts(bench, {name: f"{name} {words}" for name, words in answers.items()})
    source = bench.path("desk.csv")
    draw = random.Random(3)
    with open(source, "w", encoding="ascii") as file:
        file.write("a,b\n")
        for _ in range(ROWS):
            file.write(f"{draw.choice((24, 50, 85, 200))},{draw.uniform(0.5, 50):.3f}\n")
    pipe = {"focus": ("f_mm,s_m", "image_mm,magnification"), "exposure": ("N,t_s", "ev100")}
    for name, (header, columns) in pipe.items():
        rows = bench.path(name + ".csv")
        with open(source, encoding="ascii") as file, open(rows, "w", encoding="ascii") as to:
            to.write(header + "\n" + file.read().partition("\n")[2])
        words = [bench.lenscalc, name, "--batch", "-", "--csv", "--digits", "6", "--columns",
                 columns]
        best = fastest({name: words}, rows)[name]
        yield entry(f"pipe: {name}, 6 digits", ROWS / best / 1e6, "M rows/s",
                    f"{best * 1e3:.0f} ms")


SECTIONS = {"desk": desk}
