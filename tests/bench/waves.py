"""tests/bench/waves.py - wave fronts, contrast, images of points, Fourier transforms."""
# SPDX-License-Identifier: MIT

from common import printed

# Names that tests/bench/waves.c prints: what they are, and the unit.
WAVES = {
    "fft256": ("waves: Fourier transform, 256 x 256", "ms"),
    "fft512": ("waves: Fourier transform, 512 x 512", "ms"),
    "map": ("waves: map of 64 x 64", "ms"),
    "map/trace": ("waves: map of 64 x 64 / trace", "x"),
    "mtf": ("waves: contrast, three fields", "ms"),
    "plane": ("waves: image of 128 x 128, plane waves", "ms"),
    "fft": ("waves: image of 128 x 128, by transform", "ms"),
    "huygens": ("waves: image of 128 x 128, wavelets", "ms"),
}


def waves(bench):
    """The least of three runs."""
    program, best = bench.linked("waves"), {}
    for _ in range(3):
        for item in printed(program, WAVES):
            kept = best.get(item.name, item)
            best[item.name] = min(item, kept, key=lambda one: one.value)
    yield from best.values()


SECTIONS = {"waves": waves}
