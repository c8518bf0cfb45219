"""tests/bench/tone.py - three frames of 24 megapixels merged and shown, besides decoding."""
# SPDX-License-Identifier: MIT

from common import printed

# Names that tests/bench/tone.c prints: what they are, and the unit.
TONE = {
    "all": ("tone: three of 24 megapixels", "s"),
    "aligned": ("tone: of it, looking for shifts", "s"),
    "merged": ("tone: of it, merging", "s"),
    "shown": ("tone: of it, showing", "s"),
    "memory": ("tone: memory / picture", "x"),
}


def tone(bench):
    yield from printed(bench.linked("tone"), TONE)


SECTIONS = {"tone": tone}
