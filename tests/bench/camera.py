"""tests/bench/camera.py - rays from the film through a lens, against the bare trace of them."""
# SPDX-License-Identifier: MIT

from common import printed

# Names that tests/bench/camera.c prints: what they are, and the unit.
CAMERA = {
    "rate": ("camera", "M rays/s"),
    "survivors": ("camera: rays that arrive", "%"),
    "all/trace": ("camera: a ray / its trace", "x"),
    "threads": ("camera: two threads / one", "x"),
    "double-gauss": ("camera: pupils of double-gauss", "ms"),
    "nikkor-z-58-f095": ("camera: pupils of nikkor-z-58-f095", "ms"),
    "questar-35": ("camera: pupils of questar-35", "ms"),
    "fisheye-16": ("camera: pupils of fisheye-16", "ms"),
}


def camera(bench):
    yield from printed(bench.linked("camera"), CAMERA)


SECTIONS = {"camera": camera}
