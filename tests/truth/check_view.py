#!/usr/bin/env python3
"""tests/truth/check_view.py - cameras in scenes, by lenscalc render: check_view.py BUILD_DIR

A card in a scene must give the picture that the same card gives without one; what moves the blur
that its way makes, by closed form; a camera that moves what a thing gives that moves the other way.
"""
# SPDX-License-Identifier: MIT

import json
import math
import os
import re
import struct
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program

LENS = "double-gauss-50"
COLUMNS, ROWS = 48, 32
LAMP = "material lamp black emission=1 luminance=1000\n"


class Fixture:
    def __init__(self, build, checks, folder):
        self.program, self.checks, self.folder = Program(build), checks, folder

    def run(self, words):
        result = subprocess.run(self.program.command + words, cwd=self.folder, text=True,
                                capture_output=True, env=self.program.environment())
        self.checks.check(result.returncode == 0, f"{' '.join(words)}: {result.stderr}")
        return result.stdout

    def take(self, subject, words):
        """The green of a picture, in rows from above."""
        self.run(["render", subject, "--lens", LENS, "--size", f"{COLUMNS}x{ROWS}", "-o",
                  "out.pfm", *words.split()])
        with open(os.path.join(self.folder, "out.pfm"), "rb") as file:
            data = file.read().split(b"\n", 3)[3]
        numbers = struct.unpack(f"<{3 * COLUMNS * ROWS}f", data)
        rows = [numbers[3 * COLUMNS * y + 1:3 * COLUMNS * (y + 1):3] for y in range(ROWS)]
        return rows[::-1]

    def scene(self, name, text):
        with open(os.path.join(self.folder, name), "w", encoding="ascii") as file:
            file.write(text)
        return name


def most_off(a, b):
    """The largest difference of two pictures, over the largest number."""
    most = max(max(row) for row in a)
    return max(abs(x - y) for one, other in zip(a, b) for x, y in zip(one, other)) / most


def write_picture(path):
    rows = [[0.5 + 0.4 * math.sin(x / 3) * math.cos(y / 4) + 0.002 * x for x in range(30)]
            for y in range(20)]
    with open(path, "wb") as file:
        file.write(b"Pf\n30 20\n-1.0\n")
        for row in rows:
            file.write(struct.pack("<30f", *row))


def first_order(fixture):
    return json.loads(fixture.run(["lens", LENS, "--json"]))["rows"][0]


def check_card(fixture, pupil):
    """Rays meet the same card, others of a scene than without; where it stands is all the same."""
    write_picture(os.path.join(fixture.folder, "card.pfm"))
    more = "-t 0.01 --samples 1024 --no-skip blur,uniform"
    flat = fixture.take("card.pfm", f"-s 1m --from front --field-width 600mm {more}")
    scene = fixture.scene("card.scene", f"camera at=0,0,{1000 + pupil}mm look=0,0,0\n"
                                        "card file=card.pfm size=0.6,0.4 at=0,0,0 luminance=1000\n")
    seen = fixture.take(scene, f"-s 1m --from front {more}")
    fixture.checks.check(most_off(flat, seen) < 5e-3,
                         f"card in a scene: {most_off(flat, seen):.3g} of white off")
    # from elsewhere, turned upside down: the frame of the camera counts, not that of the scene
    scene = fixture.scene("turned.scene",
                          f"camera at={1002 + pupil}mm,3mm,4mm look=2mm,3mm,4mm up=0,-1,0\n"
                          "card file=card.pfm size=0.6,0.4 at=2mm,3mm,4mm normal=1,0,0 up=0,-1,0 "
                          "luminance=1000\n")
    turned = fixture.take(scene, f"-s 1m --from front {more}")
    fixture.checks.check(most_off(seen, turned) < 1e-5,
                         f"the same turned: {most_off(seen, turned):.3g} of white off")


def check_focus(fixture, pupil):
    """What focus= says counts from where the camera stands, unless its line says otherwise."""
    words = "-t 0.01 --samples 16"
    card = "card size=2,2 at=0,0,0 material=lamp\nbox size=0.1,0.1,0.1 at=0.2,0,0.2 material=lamp\n"
    first = f"camera at=0,0,1m look=0,0,0 %s\n{LAMP}{card}"
    for said, counted in (("focus=800mm", f"-s {800 - pupil}mm --from front"),
                          ("focus=800mm from=entrance", f"-s {800 - pupil}mm --from front"),
                          ("focus=800mm from=sensor", "-s 800mm --from sensor"),
                          ("focus=800mm from=front", "-s 800mm --from front"),
                          ("focus=800mm from=principal", "-s 800mm")):
        by_scene = fixture.take(fixture.scene("said.scene", first % said), words)
        by_option = fixture.take(fixture.scene("option.scene", first % ""), f"{words} {counted}")
        fixture.checks.check(most_off(by_scene, by_option) < 1e-6,
                             f"{said}: {most_off(by_scene, by_option):.3g} off {counted}")
    # the answer says so, by whatever the lens is focused; a mirror lens has its pupil far behind
    mirror = "mirror-tele-us5331467"
    for lens, said, metres in ((LENS, "focus=0.8", 0.8), (mirror, "focus=20", 20),
                               (mirror, "focus=20 from=front", None), (f"{LENS} --gap 1", "focus=5", 5),
                               (f"{LENS} --model thin", "focus=5", 5)):
        name = lens.split()[0]
        row = json.loads(fixture.run(["lens", name, "--json"]))["rows"][0]
        metres = metres or 20 + row["entrance_pupil_mm"] / 1000
        fixture.scene("far.scene", first % said)
        shot = ["render", "far.scene", "--lens", *lens.split(), "--size", "6x4", "--samples", "1",
                "-t", "1", "-o", "far.png"]
        result = subprocess.run(fixture.program.command + shot, cwd=fixture.folder, text=True,
                                capture_output=True, env=fixture.program.environment())
        found = re.search(r"in focus: ([0-9.]+) m from the camera's place", result.stderr)
        fixture.checks.check(found and abs(float(found[1]) - metres) < 1e-5 * metres,
                             f"{lens} {said}: {metres} m, {result.stderr}")


def check_box(fixture):
    """A camera within a closed box is told which line is the box."""
    fixture.scene("box.scene", "camera at=0,1,0 look=0,1,-1 focus=2\nmaterial grey lambert "
                  "colour=0.5\nlight sky uniform luminance=1000\nplane at=0,0,0 normal=0,1,0 "
                  "material=grey\nbox at=0,0,0 size=6,6,6 material=grey\n")
    for more in ([], ["-t", "1/100"]):
        result = subprocess.run([*fixture.program.command, "render", "box.scene", "--lens", LENS,
                                 "--size", "6x4", "--samples", "4", "-o", "box.png", *more],
                                cwd=fixture.folder, text=True, capture_output=True,
                                env=fixture.program.environment())
        fixture.checks.check(result.returncode == (0 if more else 1) and
                             "within what line 5 of box.scene places" in result.stderr,
                             f"box {more}: {result.stderr}")


def ramp(low, high, begin, end, steps=4000):
    """Share of time and of low .. high that lies within begin .. end + s, s evenly -0.1 .. 0.1."""
    total = 0
    for k in range(steps):
        shift = 0.2 * ((k + 0.5) / steps - 0.5)
        total += max(0, min(high, end + shift) - max(low, begin + shift))
    return total / steps / (high - low)


def check_ramp(fixture):
    """A card 0.4 m wide moves 0.2 m, 2 m before a pinhole."""
    words = "-s 2m --model pinhole -t 0.1 --samples 256"
    first = first_order(fixture)
    camera = "camera at=0,0,2 look=0,0,0\n" + LAMP
    whole = fixture.take(fixture.scene("whole.scene", camera + "card size=9,9 at=0,0,0 "
                                                                "material=lamp\n"), words)
    moving = fixture.take(fixture.scene("ramp.scene", camera + "card size=0.4,9 at=0,0,0 "
                                        "material=lamp move=2,0,0\n"), words)
    # the film from the pinhole in H: f/(1 - f/s), s from H; the entrance pupil is the hole
    focal = first["efl_mm"]
    film = focal / (1 - focal / 2000)
    for x in range(COLUMNS):
        edges = [(k / COLUMNS - 0.5) * 36 / film * 2.0 for k in (x, x + 1)]
        expected = ramp(*edges, -0.2, 0.2)
        found = sum(row[x] for row in moving) / sum(row[x] for row in whole)
        fixture.checks.check(abs(found - expected) < 0.005,
                             f"column {x} of what moves: {found:.4f} of the light, not "
                             f"{expected:.4f}")


def check_opposite(fixture):
    """Camera and thing, moving and turning against each other."""
    words = "-s 2m -t 0.1 --samples 8 -N 4"
    thing = LAMP + "card size=0.5,0.3 at=0.1,0,0 material=lamp "
    for what, of_thing, of_camera in (
            ("moves", "move=1,0.5,-0.3", "move=-1,-0.5,0.3"),
            ("turns", "", "")):
        if what == "moves":
            one = "camera at=0,0,2 look=0,0,0\n" + thing + of_thing + "\n"
            other = f"camera at=0,0,2 look=0,0,0 {of_camera}\n" + thing + "\n"
        else:  # about the axis of the camera, on which the card's middle lies
            thing = thing.replace("0.1,0,0", "0,0,0")
            one = "camera at=0,0,2 look=0,0,0\n" + thing + "spin=200deg/s axis=0,0,1\n"
            other = "camera at=0,0,2 look=0,0,0 spin=-200deg/s axis=0,0,1\n" + thing + "\n"
        a = fixture.take(fixture.scene("one.scene", one), words)
        b = fixture.take(fixture.scene("other.scene", other), words)
        still = fixture.take(fixture.scene("still.scene", "camera at=0,0,2 look=0,0,0\n" + thing +
                                           "\n"), words)
        fixture.checks.check(most_off(a, b) < 1e-3, f"what {what} against the camera: "
                                                    f"{most_off(a, b):.3g} off")
        fixture.checks.check(most_off(a, still) > 0.1, f"what {what} does not: nothing is blurred")


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory(prefix="lenscalc-view-") as folder:
        fixture = Fixture(sys.argv[1], checks, folder)
        check_card(fixture, first_order(fixture)["entrance_pupil_mm"])
        check_focus(fixture, first_order(fixture)["entrance_pupil_mm"])
        check_box(fixture)
        check_ramp(fixture)
        check_opposite(fixture)
    return checks.finish()


if __name__ == "__main__":
    sys.exit(main())
