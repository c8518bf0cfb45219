"""tests/robust/pairs.py - all pairs of options of a command: each changes the answer, or is refused.

A question is asked with one option more, and with two; the second must show: in the answer, in what
is said beside it, or in a refusal. BASES has the questions, VALUES what options are given, EXEMPT
the pairs that are to say nothing, with their reason.
"""
# SPDX-License-Identifier: MIT

import os
import subprocess
import tempfile
from concurrent.futures import ThreadPoolExecutor

# questions of the photographic commands, from which all pairs of the other options start
PHOTOGRAPHIC = {
    "dof": ("-f 50 -N 5.6 -s 3", "-f 50 -N 5.6", "--lens double-gauss -N 8 -s 3",
            "-f 100 -N 8 --near 30cm --far 35cm --stack", "-f 100 -N 8 -m 1:1 --dof 9mm --stack"),
    "hyperfocal": ("-f 50 -N 5.6", "-f 50", "--lens double-gauss -N 8"),
    "fov": ("-f 50 -s 3", "-s 3", "-f 24 --altitude 50m --sensor 1in", "--lens double-gauss -s 3"),
    "focus": ("-f 50 -s 3 -N 5.6", "-f 50 -N 4", "--lens double-gauss -s 3", "-f 100 --stacked 50"),
    "exposure": ("-N 5.6 -t 1/60 --iso 200", "-N 5.6 --iso 200 --ev 12", "-N 5.6 -t 1/60"),
    "flash": ("-g 36 -N 5.6", "-g 36 -s 4", "-N 5.6 -s 4"),
    "bracket": ("--from 30s --to 1/1000", "-t 1/60 --shots 5", "-t 1/60 --range 6"),
    "motion": ("-f 50 -s 10 --speed 5km/h", "-f 50 -s 10 -t 1/60"),
    "stars": ("-f 24 -N 5.6", "-f 24 -N 5.6 -t 20"),
    "diffraction": ("-N 5.6", "-N 5.6 -f 50", "-f 50 --near 2 --far 10"),
    "equivalent": ("-f 50 -N 5.6 --sensor 4/3", "--lens double-gauss -N 5.6 --sensor 4/3"),
    "tilt": ("-f 90 -N 5.6 --tilt 5 -s 0.6", "-f 90 -N 5.6"),
    "panorama": ("-f 24", "-f 24 --pixels 6000", "-f 24 --distance 3"),
    "timelapse": ("--event 1h --clip 10s -t 1/60", "--event 1h --interval 5s"),
}
# and of the others, small
OTHERS = {
    "refract": ("--after 1.5168 -R 50 -z -200",),
    "lensmaker": ("--r1 50 --r2 -50 -n 1.5168 -d 5",),
    "lens": ("double-gauss -N 5.6",),
    "surfaces": ("double-gauss",),
    "matrix": ("double-gauss",),
    "conjugate": ("double-gauss --object 1m",),
    "trace": ("double-gauss --field 5",),
    "check": ("double-gauss --steps 2",),
    "pupil": ("double-gauss --field 0,14",),
    "seidel": ("double-gauss",),
    "spot": ("double-gauss --field 5 --rays 20",),
    "field": ("double-gauss --field 5",),
    "distortion": ("double-gauss --field 10",),
    "illumination": ("double-gauss --height 5",),
    "wavefront": ("double-gauss -N 8 --field 5 -w d",),
    "mtf": ("double-gauss -N 8 --field 5 -w d --frequency 40",),
    "psf": ("double-gauss -N 8 --field 0 -w d --size 32",),
    "fan": ("double-gauss --field 5 -w d --points 3",),
    "color": ("double-gauss -N 5.6 --field 5 --spectrum F,d,C",),
    "glass": ("N-BK7 -w 500",),
    "convert": ("double-gauss",),
}

VALUES = {
    "focal-length": "35mm", "lens": "double-gauss", "position": "wide", "section": "x", "aperture": "4",
    "distance": "2.5m", "coc": "0.02mm", "sensor": "Nikon D1", "pitch": "4um", "print": "A3",
    "viewing": "400mm", "acuity": "7", "wavelength": "480nm", "pupil": "1.3", "from": "front",
    "model": "merklinger", "near": "2m", "far": "10m", "dof": "1m", "hyperfocal": "30m",
    "magnification": "1:3", "overlap": "0.4", "equal-on": "4/3", "close-up": "2", "tube": "12mm",
    "converter": "1.4", "squeeze": "1.8", "t-stop": "6.3", "criterion": "energy80",
    "projection": "equisolid", "horizontal": "40deg", "vertical": "30deg", "diagonal": "50deg",
    "field-width": "2m", "field-height": "1.5m", "field-diagonal": "2.5m", "altitude": "60m",
    "gsd": "2cm", "image": "52mm", "sensor-distance": "2.6m", "hiatus": "3mm", "front": "20mm",
    "stacked": "80mm", "stacked-aperture": "16", "gap": "10mm", "converter-length": "20mm",
    "order": "converter-tube", "time": "1/30", "iso": "400", "ev": "10", "ev-at-iso": "11",
    "luminance": "500", "illuminance": "5000", "scene": "moon", "compensation": "1",
    "filter": "ND8", "transmittance": "0.8", "shutter-angle": "172.8deg", "frame-rate": "25fps",
    "metered": "10s", "film": "HP5 Plus", "corrected-time": "20s", "vignetting": "0.9",
    "off-axis": "20deg", "meter-k": "14", "meter-c": "330", "kelvin": "4000", "balance": "5500",
    "mains": "60", "series": "full", "guide-number": "20m", "zoom": "24mm:20m,105mm:50m",
    "at": "50mm", "second": "15m", "power": "1/4", "flashes": "2", "loss": "umbrella",
    "ceiling": "2m", "ceiling-subject": "1.4m", "background": "3m", "sync": "1/200",
    "key-to-fill": "1", "ratio": "3:1", "to": "1/500", "step": "2", "shots": "7", "range": "8",
    "scene-range": "9", "speed": "10km/h", "blur": "0.05mm", "angle": "45deg", "height": "0.5m",
    "rotation": "20deg/s", "track": "0.5", "stabiliser": "3", "readout": "1/30",
    "declination": "40deg", "trail": "20um", "rule": "400", "accuracy": "2", "frequency": "30",
    "pixels": "3", "defocus": "20um", "focus-spread": "0.1mm", "by": "width", "keep": "exposure",
    "tilt": "4deg", "hinge": "1m", "through": "2m:0,5m:1m", "sight": "5deg", "rise": "3mm",
    "shift": "2mm", "circle": "60mm", "depth": "3m", "arc": "170deg", "span": "100deg",
    "elevation": "10deg", "per-row": "9", "rows": "4", "offset": "5mm", "tolerance": "2",
    "event": "2h", "interval": "3s", "clip": "20s", "frame-size": "30MB", "card": "64GB",
    "star-angle": "20deg", "film/diffraction": "60", "to/equivalent": "1in", "image/tilt": "100mm",
    "from/bracket": "15s", "gap/timelapse": "2s", "angle/tilt": "60deg", "focal-length/tilt": "120mm",
    "pixels/panorama": "6000", "horizontal/panorama": "60deg", "vertical/panorama": "40deg",
    "before": "1.33", "after": "1.6", "radius": "40mm", "object": "2m", "height-at": "5mm",
    "object/refract": "-150mm", "r1": "40mm", "r2": "-60mm", "index": "1.6", "thickness": "6mm",
    "shape": "0.5", "field": "10deg", "field-x": "3deg", "height-x": "2mm", "focus": "best",
    "object-medium": "1.33", "image-medium": "1.33", "steps": "3", "height": "6mm",
    "height/motion": "0.5m", "temperature": "30C", "pressure": "900hPa", "method": "geometric",
    "size": "48", "size/psf": "48", "rays": "30", "points": "5", "energy": "80%", "aim": "entrance",
    "pattern": "hexapolar", "scale/convert": "2", "pitch/psf": "1um", "stop-diameter": "9mm",
    "pitch/stars": "5um", "time/bracket": "1/30", "shots/timelapse": "300",
}
# options of speed, form and files, which change no answer, and those of pictures; of form is the
# stop series whose labels stand beside exact values; positions and sections are of few lenses
FORM = {"threads", "position", "section", "scale", "wedge", "plot", "map", "save", "output", "seed",
        "series", "focus-by"}
# command (None: any), option, what it says nothing beside (None: anything), and why that is right
EXEMPT = (
    (None, "clip", None, "the default, said"),
    (None, "no-clip", None, "stopped down, nothing else limits a lens's rays"),
    ("pupil", "focus", None, "pupils stand where they stand; the image plane is of all analyses"),
    ("seidel", "real", "height", "heights are real ones already"),
    ("seidel", "real", "height-x", "heights are real ones already"),
    ("field", "aperture", None, "rays next to the chief ray; -N is of all analyses alike"),
    ("distortion", "aperture", None, "chief rays alone; -N is of all analyses alike"),
    ("flash", "sync", "time", "the time is within what the shutter synchronises"),
    ("panorama", "overlap", "per-row", "it may still be that of the rows"),
    ("panorama", "per-row", "overlap", "so many frames overlap by that much"),
    ("dof", "overlap", None, "so few shots may be the same for both"),
    ("panorama", "pupil", "each-row", "frames focused at infinity do not depend on it"),
    ("panorama", "tolerance", "near", "an angle alone where pixels are not known, with --offset"),
    ("focus", "converter-length", "converter", "it shows in distances, where these are known"),
    ("motion", "pitch", "rotation", "what is implied by it is a limit that a time given overrules"),
)


def value_of(command, option, takes_value):
    if not takes_value:
        return []
    return [VALUES.get(f"{option}/{command}", VALUES.get(option))]


LETTERS = {"-f": "focal-length", "-N": "aperture", "-s": "distance", "-t": "time", "-m": "magnification",
           "-g": "guide-number", "-w": "wavelength", "-d": "thickness", "-n": "index", "-R": "radius",
           "-z": "object"}


def is_given(name, words):
    return any(LETTERS.get(word) == name for word in words)


class Asker:
    """One command, asked often: the same question only once, several at a time."""

    def __init__(self, program, command, folder):
        self.program, self.command, self.folder = program, command, folder
        self.environment = program.environment()

    def answer(self, words):
        result = subprocess.run([*self.program.command, self.command, *words, "--json"],
                                cwd=self.folder, env=self.environment, stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=120)
        return result.returncode, result.stdout, result.stderr


def is_exempt(command, option, beside):
    return any(entry[0] in (None, command) and entry[1] == option and entry[2] in (None, beside)
               for entry in EXEMPT)


def without_value(command, options):
    """Options that take a value and have none in VALUES: they cannot be tried."""
    return [name for name, takes in options
            if name not in FORM and value_of(command, name, takes) == [None]]


def silent_pairs(program, command, bases, options):
    """(question, the first option, the second one that says nothing beside it), how many asked"""
    silent, asked = [], 0
    known = [(name, takes) for name, takes in options
             if name not in FORM and value_of(command, name, takes) != [None]]
    with tempfile.TemporaryDirectory(prefix="lenscalc-pairs-") as folder, \
            ThreadPoolExecutor(int(os.environ.get("LENSCALC_JOBS", "2"))) as pool:
        asker = Asker(program, command, folder)
        for base in bases:
            words = base.split()
            free = [[f"--{name}", *value_of(command, name, takes)] for name, takes in known
                    if f"--{name}" not in words and not is_given(name, words)]
            single = list(pool.map(asker.answer, [words + more for more in free]))
            plain = asker.answer(words)
            good = [(more, answer) for more, answer in zip(free, single)]
            tries = [(first, second) for first in range(len(good)) for second in range(len(good))
                     if first < second and good[first][1][0] in (0, 3)]
            both = pool.map(asker.answer, [words + good[a][0] + good[b][0] for a, b in tries])
            asked += 1 + len(free) + len(tries)
            for more, answer in good:
                if answer == plain and plain[0] == 0 and not is_exempt(command, more[0][2:], None):
                    silent.append((base, "", " ".join(more)))
            for (a, b), answer in zip(tries, both):
                for first, second in ((a, b), (b, a)):
                    if answer[0] in (0, 3) and answer == good[first][1] and \
                            not is_exempt(command, good[second][0][0][2:], good[first][0][0][2:]):
                        silent.append((base, " ".join(good[first][0]), " ".join(good[second][0])))
    return silent, asked
