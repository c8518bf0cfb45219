"""tests/truth/outside.py - lenses of lensdb for clear_sums.c, which sums what passes them.

The prescription is what `lenscalc convert` writes as JSON: indices, positions and units are read by
lenscalc. All that is done with them is not: the first-order focal length and the height of the
marginal ray in the stop are traced here.

What clear_sums answered is kept in outside.tsv, by a digest of its sources, the lens and the question;
make check-all asks it all again and compares. What is not kept is asked; LENSCALC_KEEP=1 keeps it,
and drops what the script that runs asks no more.
"""
# SPDX-License-Identifier: MIT

import glob
import hashlib
import json
import math
import os
import shlex
import subprocess
import sys

from harness import EVERYTHING

HERE = os.path.dirname(os.path.abspath(__file__))
SOURCE = os.path.join(HERE, "clear_sums.c")
KEPT = os.path.join(HERE, "outside.tsv")
AGREE = 1e-9  # other compilers round otherwise
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


def read_kept():
    """(script, digest) -> answer"""
    with open(KEPT, encoding="ascii") as file:
        rows = [line.rstrip("\n").split("\t") for line in file if line[0] != "#"]
    return {(script, digest): answer for script, digest, answer in rows}


def write_kept(script, answers):
    """Those of the script in place of all that it had."""
    kept = {key: answer for key, answer in read_kept().items() if key[0] != script}
    kept.update({(script, digest): answer for digest, answer in answers.items()})
    with open(KEPT, "w", encoding="ascii") as file:
        file.write("# what clear_sums answered, see outside.py: script, digest, answer\n")
        file.writelines(f"{name}\t{digest}\t{answer}\n"
                        for (name, digest), answer in sorted(kept.items()))


def numbers_of(answer):
    """A list of numbers, None where nothing passes."""
    return None if answer == "none" else [float(word) for word in answer.split()]


def agree(answer, other):
    one, two = numbers_of(answer), numbers_of(other)
    return answer == other or (None not in (one, two) and len(one) == len(two) and all(
        math.isclose(a, b, rel_tol=AGREE, abs_tol=AGREE) for a, b in zip(one, two)))


class Outside:
    """The built clear_sums, and what it answered before."""

    def __init__(self, program):
        self.binary = os.path.join(program.holder.name, "clear_sums")
        self.script = os.path.splitext(os.path.basename(sys.argv[0]))[0]
        self.kept, self.answers, self.is_built = read_kept(), {}, False
        self.sources = hashlib.sha256()
        for path in sorted(glob.glob(os.path.join(HERE, "clear_*.[ch]"))):
            with open(path, "rb") as file:
                self.sources.update(file.read())

    def digest(self, text, question):
        digest = self.sources.copy()
        digest.update((text + question).encode())
        return digest.hexdigest()[:24]

    def run(self, text, questions):
        if not self.is_built:
            compiler = shlex.split(os.environ.get("CC", "cc"))
            subprocess.run([*compiler, "-std=c17", "-D_DEFAULT_SOURCE", "-O3", "-o", self.binary,
                            SOURCE, "-lm"], check=True)
            self.is_built = True
        result = subprocess.run([self.binary], text=True, capture_output=True, check=True, timeout=600,
                                input=text + "".join(question + "\n" for question in questions))
        return result.stdout.splitlines()

    def ask(self, lens, questions, wave=None):
        """Answers to lines such as "spot 1e-8 14": lists of numbers, None where nothing passes."""
        text = lens.text(wave)
        known = {question: self.kept.get((self.script, self.digest(text, question)))
                 for question in questions}
        asked = [question for question in questions if EVERYTHING or known[question] is None]
        if asked:
            for question, answer in zip(asked, self.run(text, asked)):
                if known[question] is not None and not agree(known[question], answer):
                    sys.exit(f"FAILED {question}: kept is {known[question]}, answered {answer}\n"
                             "0 passed, 1 failed")
                known[question] = answer
        self.answers.update({self.digest(text, question): known[question] for question in questions})
        if os.environ.get("LENSCALC_KEEP"):
            write_kept(self.script, self.answers)
        return [numbers_of(known[question]) for question in questions]
