"""tests/bench/scene.py - rays through scenes, against triangles that are tried one by one."""
# SPDX-License-Identifier: MIT

from common import printed

# Names that tests/bench/scene.c prints: what they are, and the unit.
SCENE = {
    "random": ("scene: random rays at 1e5 triangles", "M rays/s"),
    "picture": ("scene: rays of a picture at 1e5 triangles", "M rays/s"),
    "tries": ("scene: a random ray / 100 triangles one by one", "x"),
    "threads": ("scene: two threads / one", "x"),
    "build": ("scene: a tree of 1e6 triangles", "s"),
}


def scene(bench):
    yield from printed(bench.linked("scene"), SCENE)


SECTIONS = {"scene": scene}
