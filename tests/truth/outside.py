"""tests/truth/outside.py - lenses of lensdb for clear_sums.c, which sums what passes them.

The prescription is what `lenscalc convert` writes as JSON: indices, positions and units are read by
lenscalc. All that is done with them is not: the first-order focal length and the height of the
marginal ray in the stop are traced here.
"""
# SPDX-License-Identifier: MIT

import json
import math
import os
import shlex
import subprocess

SOURCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "clear_sums.c")
TERMS = [f"A{power}" for power in range(2, 17, 2)]


class Lens:
    """A prescription in one position as clear_sums.c takes it; refused: why it does not. fnumber:
    of a lens that states no aperture. Without a stop the beam itself is limited, where it meets
    the first vertex: right on the axis."""

    def __init__(self, program, lens, position, image, fnumber=None):
        path = os.path.join(program.holder.name, "lens.json")
        program.run("convert", lens, "-o", path)
        with open(path, encoding="utf-8") as file:
            self.all = json.load(file)
        os.remove(path)
        names = self.all["positions"]
        self.place = names.index(position) if position in names else 0
        self.image, self.refused = image, ""
        self.waves = self.all["wavelengths"]
        self.stop = (self.all["stop_surface"] or 0) - 1
        self.fnumber = fnumber or (self.one(self.all["aperture"])
                                   if self.all["aperture_kind"] == "fnumber" else None)
        if not self.all["object_is_infinite"]:
            self.refused = "a near object"
        self.surfaces, z = [], 0.0
        index = [1.0] * len(self.waves)
        for surface in self.all["surfaces"]:
            index = surface.get("index") or index
            self.surfaces.append(self.read(surface, index, z))
            z += self.one(surface["thickness_mm"]) or 0.0
        if self.stop < 0:
            self.stop = 0
            self.surfaces.insert(0, {"c": 0.0, "k": 0.0, "z": 0.0, "clear": math.inf, "blocked": 0.0,
                                     "mirror": False, "bends": (1, 1), "terms": [0.0] * len(TERMS),
                                     "n": [1.0] * len(self.waves)})
            self.surfaces[0]["clear"] = self.stop_radius()
        self.last = self.surfaces[-1]["z"]
        self.radius = math.nan if self.refused else self.stop_radius()

    def one(self, value):
        return value[self.place] if isinstance(value, list) else value

    def read(self, surface, index, z):
        shapes = surface.get("apertures", [])
        if surface["kind"] not in ("refract", "reflect", "stop") or any(
                shape["shape"] != "circle" or not shape["blocks"] or any(shape["decenter_mm"])
                for shape in shapes):
            self.refused = f"surface {surface['surface']}"
        diameter, radius = self.one(surface["diameter_mm"]), self.one(surface["radius_mm"])
        terms = surface.get("coefficients_mm", {})
        if set(terms) - set(TERMS):
            self.refused = f"terms of surface {surface['surface']}"
        return {"c": 1 / radius if radius else 0.0, "k": self.one(surface["conic"]) or 0.0, "z": z,
                "clear": diameter / 2 if diameter else math.inf,
                "blocked": max([shape["size_mm"][0] / 2 for shape in shapes], default=0.0),
                "mirror": surface["kind"] == "reflect",
                "bends": {None: (1, 1), "x": (1, 0), "y": (0, 1)}[surface.get("cylinder")],
                "terms": [self.one(terms.get(name, 0.0)) for name in TERMS], "n": index}

    def stop_radius(self):
        """The diameter of the stop, or the height there of a ray that makes the f-number."""
        if self.fnumber is None and self.all["aperture_kind"] == "stop":
            return self.surfaces[self.stop]["clear"]
        if self.fnumber is None:
            self.refused = f"aperture {self.all['aperture_kind']}"
            return math.nan
        y, v, n, at_stop = 1.0, 0.0, 1.0, 1.0
        for i, surface in enumerate(self.surfaces):
            y += v / n * (surface["z"] - (self.surfaces[i - 1]["z"] if i > 0 else 0.0))
            at_stop = y if i == self.stop else at_stop
            behind = math.copysign(surface["n"][0], n) * (-1 if surface["mirror"] else 1)
            v -= y * (behind - n) * (surface["c"] + 2 * surface["terms"][0])
            n = behind
        return abs(at_stop / v) / (2 * self.fnumber)

    def open(self):
        """Nothing takes light but the stop."""
        for i, surface in enumerate(self.surfaces):
            if i != self.stop:
                surface["clear"], surface["blocked"] = math.inf, 0.0

    def text(self, wave=None):
        waves = range(len(self.waves)) if wave is None else [wave]
        words = [len(self.surfaces), len(waves), self.stop, self.radius,
                 self.last + self.image]
        words += [self.waves[i]["weight"] for i in waves]
        for one in self.surfaces:
            words += [one["c"], one["k"], one["z"], one["clear"], one["blocked"],
                      int(one["mirror"]), *one["bends"], *one["terms"], *(one["n"][i] for i in waves)]
        return "lens " + " ".join(repr(word) for word in words) + "\n"


class Outside:
    """The built clear_sums."""

    def __init__(self, program):
        self.binary = os.path.join(program.holder.name, "clear_sums")
        compiler = shlex.split(os.environ.get("CC", "cc"))
        subprocess.run([*compiler, "-std=c17", "-D_DEFAULT_SOURCE", "-O3", "-o", self.binary,
                        SOURCE, "-lm"], check=True)

    def ask(self, lens, questions, wave=None):
        """Answers to lines such as "spot 1e-8 14": lists of numbers, None where nothing passes."""
        text = lens.text(wave) + "".join(question + "\n" for question in questions)
        result = subprocess.run([self.binary], input=text, text=True, capture_output=True,
                                check=True, timeout=600)
        return [None if line == "none" else [float(word) for word in line.split()]
                for line in result.stdout.splitlines()]
