"""tests/bench/spots.py - converged spots and aimed rays, against the bare trace of their rays."""
# SPDX-License-Identifier: MIT

from common import printed

# Names that tests/bench/spots.c prints: what they are, and the unit.
SPOTS = {
    "whole/trace": ("spots: nine, unclipped / trace", "x"),
    "whole": ("spots: nine, unclipped, to 1e-6", "ms"),
    "clipped": ("spots: nine, clipped, to 1e-4", "ms"),
    "aim/trace": ("spots: an aimed ray / trace", "x"),
}


def spots(bench):
    """The least of three runs."""
    program, best = bench.linked("spots"), {}
    for _ in range(3):
        for item in printed(program, SPOTS):
            kept = best.get(item.name, item)
            best[item.name] = min(item, kept, key=lambda one: one.value)
    yield from best.values()


SECTIONS = {"spots": spots}
