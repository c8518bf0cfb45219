"""tests/bench/optimize.py - what an optimisation is made of."""
# SPDX-License-Identifier: MIT

from common import printed

# Names that tests/bench/merit.c prints: what they are, and the unit.
MERIT = {
    "merit": ("optimize: nine spots", "us"),
    "normal": ("optimize: and normal equations", "us"),
    "normal/trace": ("optimize: the same / trace", "x"),
    "aimed": ("optimize: aimed at the stop", "us"),
    "aimed/trace": ("optimize: that / trace", "x"),
}


def optimize(bench):
    """The least of three runs."""
    program, best = bench.linked("merit"), {}
    for _ in range(3):
        for item in printed(program, MERIT):
            kept = best.get(item.name, item)
            best[item.name] = min(item, kept, key=lambda one: one.value)
    yield from best.values()


SECTIONS = {"optimize": optimize}
