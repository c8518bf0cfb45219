"""tests/bench/rays.py - exact rays: million ray-surfaces a second, ratios, and as a filter."""
# SPDX-License-Identifier: MIT

import random

from common import ROWS, entry, fastest, printed, rate

# Names that tests/bench/trace.c prints: what they are, and the unit.
TRACE = {
    "plain": ("rays: plain loop", "M rs/s"),
    "sse2": ("rays: SSE2", "M rs/s"),
    "sse2/plain": ("rays: SSE2 / plain", "x"),
    "avx2": ("rays: AVX2", "M rs/s"),
    "avx2/plain": ("rays: AVX2 / plain", "x"),
    "avx512": ("rays: AVX-512", "M rs/s"),
    "avx512/plain": ("rays: AVX-512 / plain", "x"),
    "sse2_limit": ("rays: limit of the divider, SSE2", "M rs/s"),
    "avx2_limit": ("rays: limit of the divider, AVX2", "M rs/s"),
    "avx512_limit": ("rays: limit of the divider, AVX-512", "M rs/s"),
    "sse2/limit": ("rays: SSE2 / limit of the divider", "x"),
    "avx2/limit": ("rays: AVX2 / limit of the divider", "x"),
    "avx512/limit": ("rays: AVX-512 / limit of the divider", "x"),
    "path": ("rays: with path", "x"),
    "conic": ("rays: conics", "x"),
    "asphere": ("rays: aspheres", "x"),
    "phone": ("rays: speed of 13 aspheres / spheres", "x"),
    "derivatives": ("rays: all derivatives / trace", "x"),
    "tangents_1": ("rays: 1 derivative forwards / trace", "x"),
    "tangents_2": ("rays: 2 derivatives forwards / trace", "x"),
    "tangents_4": ("rays: 4 derivatives forwards / trace", "x"),
    "tangents_8": ("rays: 8 derivatives forwards / trace", "x"),
    "threads_1e5": ("rays: 2 threads, 1e5 rays", "x"),
    "threads_1e6": ("rays: 2 threads, 1e6 rays", "x"),
}

# The same of tests/bench/aimed.c.
AIMED = {
    "aimed_anew": ("rays: aimed anew and traced / trace", "x"),
    "aimed_derivatives": ("rays: all derivatives of aimed rays / trace", "x"),
}


def rays(bench):
    """The best of three runs: of ratios to a plain trace the least, of speeds the most."""
    for source, names in ("trace", TRACE), ("aimed", AIMED):
        program, best = bench.linked(source), {}
        for _ in range(3):
            for item in printed(program, names):
                kept = best.get(item.name, item)
                pick = min if bench.is_ceiling(item.name) else max
                best[item.name] = pick(item, kept, key=lambda one: one.value)
        yield from best.values()


def filtering(bench):
    """As a filter: six numbers in, six out."""
    source = bench.path("rays.csv")
    draw = random.Random(5)
    block = []
    for _ in range(ROWS // 10):
        a, b = round(draw.uniform(-0.1, 0.1), 6), round(draw.uniform(-0.1, 0.1), 6)
        block.append(f"{draw.uniform(-15, 15):.4f},{draw.uniform(-15, 15):.4f},-20,{a},{b},"
                     f"{(1 - a * a - b * b) ** 0.5:.9f}\n")
    with open(source, "w", encoding="ascii") as file:
        file.write("x_mm,y_mm,z_mm,cos_x,cos_y,cos_z\n" + "".join(block) * 10)
    words = [bench.lenscalc, "trace", "double-gauss", "--batch", "-", "--csv", "--columns",
             "x_out_mm,y_out_mm,z_out_mm,cos_x_out,cos_y_out,cos_z_out"]
    best = fastest({"nine": words + ["--digits", "9"], "shortest": words}, source)
    for name in "nine", "shortest":
        yield entry(f"pipe: trace, {name} digits", ROWS / best[name] / 1e6, "M/s",
                    rate(best[name]))


SECTIONS = {"rays": rays, "filter": filtering}
