"""tests/robust/pairs.py - all pairs of options of a command: each changes the answer, or is refused.

A question is asked with one option more, and with two; the second must show: in the answer, in what
is said beside it, in the files that are written, or in a refusal. PHOTOGRAPHIC, EXACT and OTHERS
have the questions, which take about three minutes of one processor together; VALUES what options
are given, EXEMPT the pairs that are to say nothing, with their reason.
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
    "fov": ("-f 50 -s 3", "-s 3", "-f 24 --altitude 50m --sensor 1in", "--lens double-gauss -s 3",
            "-f 50 --sensor imx264", "--telecentric -m 0.5 --sensor imx264", "--line-scan --pixels 4096 --pitch 7um -f 50 -s 1"),
    "focus": ("-f 50 -s 3 -N 5.6", "-f 50 -N 4", "--lens double-gauss -s 3", "-f 100 --stacked 50"),
    "exposure": ("-N 5.6 -t 1/60 --iso 200", "-N 5.6 --iso 200 --ev 12", "-N 5.6 -t 1/60"),
    "flash": ("-g 36 -N 5.6", "-g 36 -s 4", "-N 5.6 -s 4"),
    "bracket": ("--from 30s --to 1/1000", "-t 1/60 --shots 5", "-t 1/60 --range 6"),
    "motion": ("-f 50 -s 10 --speed 5km/h", "-f 50 -s 10 -t 1/60", "-v 2m/s --gsd 2cm"),
    "stars": ("-f 24 -N 5.6", "-f 24 -N 5.6 -t 20"),
    "diffraction": ("-N 5.6", "-N 5.6 -f 50", "-f 50 --near 2 --far 10", "--diameter 200mm"),
    "pinhole": ("-f 150 --metered 1/60", "-f 150 --diameter 0.4 -s 1"),
    "equivalent": ("-f 50 -N 5.6 --sensor 4/3", "--lens double-gauss -N 5.6 --sensor 4/3"),
    "tilt": ("-f 90 -N 5.6 --tilt 5 -s 0.6", "-f 90 -N 5.6"),
    "panorama": ("-f 24", "-f 24 --pixels 6000", "-f 24 --distance 3"),
    "survey": ("-f 10 --sensor 1in --pixels 20Mpx --altitude 100",
               "-f 10 --sensor 1in --pixels 20Mpx --altitude 100 -v 10m/s --overlap 80%"),
    "projector": ("--throw 1.5 --screen 100in", "--screen 100in --lumens 2000"),
    "timelapse": ("--event 1h --clip 10s -t 1/60", "--event 1h --interval 5s"),
    "visual": ("--telescope 1200 --diameter 200 --eyepiece 25", "--diameter 200 --telescope 1200",
               "10x42", "--telescope 1200 --diameter 200 --lens erfle-eyepiece"),
    "microscope": ("40x/0.65", "--na 0.65 -m 40", "40x/0.65 --eyepiece 10x/22",
                   "40x/0.65 --pitch 4um"),
}
SINGLET = "../singlet.lens --vary R1"
# pixels of 4 um
SMALL = " --lens ../singlet.lens --sensor 0.064x0.048mm --size 16x12 --samples 4"
# by exact rays, which take longer
EXACT = {
    "dof": ("--lens double-gauss -N 8 -s 3 --exact",),
    "hyperfocal": ("--lens double-gauss -N 8 --exact",),
    "fov": ("--lens double-gauss -s 3 --exact",),
    "focus": ("--lens double-gauss -s 3 --exact",),
    "exposure": ("--lens double-gauss -N 5.6 -t 1/60 --iso 200 --exact",),
}
# and of the others, small
OTHERS = {
    "refract": ("--after 1.5168 -R 50 -z -200",),
    "lensmaker": ("--r1 50 --r2 -50 -n 1.5168 -d 5", "-f 100 --r1 60 -n 1.5168 -d 6",
                  "-f 100 --shape 1 -n 1.5168", "--ball -d 10 -n 1.5168"),
    "lens": ("double-gauss -N 5.6",),
    "surfaces": ("double-gauss", "double-gauss --show footprints"),
    "sag": ("double-gauss --surface 1", "double-gauss --height 5mm"),
    "matrix": ("double-gauss",),
    "conjugate": ("double-gauss --object 1m", "-f 100 --object 150 --then gap=50,f=-30",
                  "--mirror convex --object 150"),
    "trace": ("double-gauss --field 5", "double-gauss --field 5 --pattern gauss --rays 9",
              "double-gauss --field 5 --pupil-point 0.3:0.4", "double-gauss --point 0:14:-20",
              "double-gauss --x 0 --y 14 --z -20"),
    "check": ("double-gauss --steps 2",),
    "draw": ("double-gauss", "double-gauss --construction", "double-gauss --no-rays"),
    "report": ("../singlet.lens -N 8",),
    "pupil": ("double-gauss --field 0,14", "double-gauss --height 5", "double-gauss --field 5 --outline 4"),
    "seidel": ("../singlet.lens", "../singlet.lens --form waves", "../singlet.lens --order 5"),
    "spot": ("double-gauss --field 5 --rays 20", "double-gauss --field 5 --rays 20 --to 3",
             "double-gauss --field 5 --pattern gauss",
             "double-gauss --field 5 --rays 20 --over-field out.pfm"),
    "field": ("double-gauss --field 5", "double-gauss --field 5 --show fnumbers",
              "double-gauss --field 5 --over-field out.svg"),
    "distortion": ("double-gauss --field 10", "double-gauss --fit poly3",
                   "double-gauss --field 10 --grid out.svg"),
    "illumination": ("double-gauss --height 5",),
    "wavefront": ("double-gauss -N 8 --field 5 -w d", "double-gauss -N 8 --field 5 -w d --map out.pfm --size 16",
                  "double-gauss -N 8 --field 5 -w d --map out.png --size 16",
                  "double-gauss -N 8 --field 5 -w d --zernike fringe --terms 9",
                  "double-gauss -N 8 --field 5 -w d --rays 20 --over-field out.pfm"),
    "mtf": ("double-gauss -N 8 --field 5 -w d --frequency 40",
            "double-gauss -N 8 --field 5 -w d --frequency 40 --method geometric",
            "double-gauss -N 8 --field 5 -w d --frequency 40 --over-field out.svg"),
    "psf": ("double-gauss -N 8 --field 0 -w d --size 32",
            "double-gauss -N 8 --field 0 -w d --size 32 --plot out.svg"),
    "energy": ("double-gauss -N 8 --field 5 -w d --radius 5um",
               "double-gauss -N 8 --field 5 -w d --plot out.svg"),
    "spread": ("double-gauss -N 8 --field 0 -w d", "double-gauss -N 8 --field 0 -w d --plot out.svg"),
    "fan": ("double-gauss --field 5 -w d --points 3", "double-gauss --field 5 -w d --points 3 --show opd",
            "double-gauss --field 5 -w d --points 3 --show pupil"),
    "color": ("double-gauss -N 5.6 --field 5 --spectrum F,d,C", "double-gauss -N 5.6 --show zone",
              "double-gauss -N 5.6 --show field"),
    "glass": ("N-BK7 -w 500", "--nd 1.517 --vd 64", "--nd 1.5..1.52 --vd 64..66", "--like N-BK7",
              "--catalog SCHOTT --abbe out.svg"),
    "convert": ("double-gauss",),
    # without times, which are never the same twice
    "bench": ("../singlet.lens --columns model,degree,rms_error,digits",
              "../singlet.lens --quantity spot --rays 20 --columns model,degree,rms_error,digits"),
    "list": ("formats", "lenses", "glasses", "options"),
    "merge": ("../one.part -o out.png",),
    "fit": ("double-gauss --rays 8", "double-gauss --rays 8 --show parameters",
            "double-gauss --prescription efl=101 --vary R1", "--glass ../indices.csv"),
    "optimize": (SINGLET + " --goals spot --iterations 2", SINGLET + " --goals asbuilt --iterations 2",
                 SINGLET + " --goals spot --iterations 2 --global 2"),
    "tolerance": ("../singlet.lens --grade precision --trials 4",
                  "../singlet.lens --grade precision --show sensitivity",
                  "../singlet.lens --grade precision --show inverse --drop 10um"),
    "tone": ("../short.png ../long.png --fov 2deg", "../short.png ../long.png --glare --fov 2deg -o out.hdr",
             "../short.png --glare --fov 2deg --falsecolor", "../short.png --fov 2deg --operator linear",
             "../short.png --fov 2deg --operator gamma"),
    "render": ("chart:checker -s 1" + SMALL, "chart:checker -s 1 --noise -t 1/60" + SMALL,
               "../short.png -s 2 --depth-map ../depth.png --depth 1..4" + SMALL,
               "chart:checker -s 1 --film sfx" + SMALL, "../tiny.scene -s 1 -t 1/60" + SMALL, "--lens ../singlet.lens --rays out.csv --samples 4"),
}

WITHOUT = {"help", "completion"}  # whose answers are not of options

VALUES = {
    "focal-length": "35mm", "lens": "double-gauss", "position": "wide", "section": "x", "aperture": "4",
    "distance": "2.5m", "coc": "0.02mm", "sensor": "Nikon D1", "pitch": "4um", "print": "A3",
    "viewing": "400mm", "acuity": "7", "wavelength": "480nm", "pupil": "1.3", "from": "front",
    "model": "merklinger", "near": "2m", "far": "10m", "dof": "1m", "hyperfocal": "30m",
    "magnification": "1:3", "overlap": "0.4", "equal-on": "4/3", "close-up": "2", "tube": "12mm",
    "converter": "1.4", "blur-at": "5m", "blur-behind": "4m", "own": "ND8,ND64", "crop/fov": "1.5", "crop/equivalent": "1.5", "squeeze": "1.8", "t-stop": "6.3", "criterion": "energy80",
    "projection": "equisolid", "horizontal": "40deg", "vertical": "30deg", "diagonal": "50deg",
    "field-width": "2m", "field-height": "1.5m", "field-diagonal": "2.5m", "altitude": "60m",
    "gsd": "2cm", "image": "52mm", "sensor-distance": "2.6m", "hiatus": "3mm", "front": "20mm",
    "stacked": "80mm", "stacked-aperture": "16", "gap": "10mm", "converter-length": "20mm",
    "order": "converter-tube", "order/seidel": "5", "time": "1/30", "iso": "400", "ev": "10", "ev-at-iso": "11",
    "luminance": "500", "illuminance": "5000", "scene": "moon", "compensation": "1",
    "filter": "ND8", "transmittance": "0.8", "shutter-angle": "172.8deg", "frame-rate": "25fps",
    "metered": "10s", "diameter": "0.3mm", "rule/pinhole": "young", "metered-at": "8", "focal-length/pinhole": "90mm", "distance/pinhole": "1.5m", "crop/pinhole": "1.5", "metered/pinhole": "1/30", "film/pinhole": "HP5 Plus", "film": "HP5 Plus", "corrected-time": "20s", "vignetting": "0.9",
    "off-axis": "20deg", "meter-k": "14", "meter-c": "330", "kelvin": "4000", "balance": "5500",
    "mains": "60", "series": "full", "guide-number": "20m", "zoom": "24mm:20m,105mm:50m",
    "at": "50mm", "second": "15m", "power": "1/4", "flashes": "2", "loss": "umbrella",
    "ceiling": "2m", "ceiling-subject": "1.4m", "background": "3m", "sync": "1/200",
    "key-to-fill": "1", "ratio": "3:1", "to": "1/500", "step": "2", "shots": "7", "range": "8",
    "scene-range": "9", "speed": "10km/h", "blur": "0.05mm", "angle": "45deg", "height": "0.5m",
    "rotation": "20deg/s", "track": "0.5", "stabiliser": "3", "readout": "1/30",
    "declination": "40deg", "trail": "20um", "rule": "400", "accuracy": "2", "frequency": "30",
    "pixels": "3", "defocus": "20um", "focus-spread": "0.1mm", "by": "width", "keep": "exposure",
    "quantity/bench": "focus", "degree/bench": "5",
    "tilt": "4deg", "hinge": "1m", "through": "2m:0,5m:1m", "sight": "5deg", "rise": "3mm",
    "shift": "2mm", "circle": "60mm", "depth": "3m", "arc": "170deg", "span": "100deg",
    "elevation": "10deg", "per-row": "9", "rows": "4", "offset": "5mm", "tolerance": "2",
    "event": "2h", "interval": "3s", "clip": "20s", "frame-size": "30MB", "card": "64GB",
    "star-angle": "20deg", "film/diffraction": "60", "to/equivalent": "1in", "image/tilt": "100mm",
    "from/bracket": "15s", "gap/timelapse": "2s", "angle/tilt": "60deg", "focal-length/tilt": "120mm",
    "sidelap": "60%", "along": "width", "blur/survey": "2", "pixels/survey": "5472x3648", "throw": "2",
    "screen": "80in", "width": "3m", "height/projector": "2m", "aspect": "4:3", "lumens": "1500",
    "gain/projector": "1.3",
    "field/fov": "3x2.5m", "na": "0.05", "working-fnumber": "9", "blur/fov": "2",
    "pixels/fov": "3000x2000", "density": "100px/m", "task": "observe", "line-rate": "20kHz",
    "pixels/panorama": "6000", "horizontal/panorama": "60deg", "vertical/panorama": "40deg",
    "before": "1.33", "after": "1.6", "radius": "40mm", "object": "2m", "height-at": "5mm",
    "object/refract": "-150mm", "r1": "40mm", "r2": "-60mm", "index": "1.6", "thickness": "6mm",
    "shape": "0.5", "field": "10deg", "field-x": "3deg", "height-x": "2mm", "focus": "best",
    "object-medium": "1.33", "image-medium": "1.33", "steps": "3", "height": "6mm",
    "height/motion": "0.5m", "power/conjugate": "5dpt", "then": "gap=20mm,f=50mm", "refracted": "20deg",
    "diagram": "rays.svg", "projection/visual": "90mm", "afocal": "7mm", "print/panorama": "1x0.5m", "dpi": "150", "image-height": "8mm",
    "near-point": "200mm", "mirror": "concave", "temperature": "30C", "pressure": "900hPa", "method": "geometric",
    "height/sag": "4mm", "surface": "3", "radius/energy": "4um", "offset/spread": "2um", "draw": "edge", "radius-angle": "0.1mrad", "size": "48", "size/psf": "48", "rays": "30", "points": "5", "energy": "80%", "aim": "entrance",
    "pattern": "hexapolar", "scale/convert": "2", "pitch/psf": "1um", "pitch/render": "3um", "stop-diameter": "9mm",
    "pitch/stars": "5um", "binoculars": "8x30", "telescope": "900mm", "diameter": "150mm",
    "eyepiece": "10mm", "eyepiece/microscope": "12x/18", "barlow": "2x", "reducer": "0.63x", "power": "80x",
    "exit-pupil": "3mm", "field-stop": "20mm", "apparent-field": "60deg", "field/visual": "1deg",
    "field-width/visual": "90m", "at": "500m", "obstruction": "30%", "secondary": "50mm",
    "eye-pupil": "5mm", "naked-eye": "5", "back-focus": "55mm", "filter-thickness": "3mm",
    "filter-index": "1.6", "objective": "60x/0.8", "na": "0.6", "immersion": "water",
    "index": "1.4", "field-number": "20", "tube-lens": "180mm", "marked-for": "200mm",
    "condenser": "0.3", "adapter": "0.5x", "sensor/microscope": "2/3in", "subject-angle": "40arcsec", "pixel-scale": "1arcsec", "time/bracket": "1/30", "shots/timelapse": "300",
    "solution": "second", "lens-file": "single.lens", "pupil-point": "0.3:0.5", "pupil-x": "0.3",
    "pupil-y": "0.5", "point": "0:6:-20", "direction": "0:0.1:1", "x": "1mm", "y": "2mm",
    "z": "-20mm", "cos-x": "0.1", "cos-y": "0.1", "cos-z": "0.9", "side": "exit", "outline": "5",
    "title": "Other", "form": "waves", "chromatic": "lens", "spectrum": "d:1,F:0.5",
    "reference": "centroid", "reference/spot": "chief", "reference/energy": "chief", "weight": "beam", "error": "1e-9", "error/mtf": "1e-7", "error/illumination": "1e-9", "map": "map.pfm", "curve": "curve.svg", "over-field": "over.svg", "mapped": "strehl", "glass": "N-SF6", "zernike": "noll", "terms": "5",
    "show/fan": "opd", "show/field": "fnumbers", "show/surfaces": "footprints", "show/color": "zone", "pitch-angle": "0.1mrad", "fit": "brown",
    "grid": "grid.svg", "plot": "plot.svg", "air": "ciddor", "nd": "1.52", "vd": "60", "pgf": "0.5355..0.55",
    "catalog": "OHARA", "status": "obsolete", "like": "N-SF6", "count": "3", "label": "N-BK7",
    "abbe": "abbe.svg", "unit": "cm", "search": "b", "kind": "dof",
    "show/fit": "residuals", "distortion": "0", "match": "rays", "prescription": "efl=99",
    "vary": "R2", "glass/fit": "../indices.csv", "formula": "cauchy", "name": "OTHER",
    "map/fit": "map.svg", "object/fit": "2m", "field/fit": "0,5,10", "hold": "R1", "goals": "efl=99",
    "no-goal": "edge",
    "grade": "commercial", "tolerances": "../tolerances.txt", "glasses": "SCHOTT",
    "test-plates": "../plates.tsv", "set-diameters": "5", "solver": "ceres", "iterations": "3", "seconds": "100", "global": "2", "keep": "2",
    "start": "elements=1,efl=50,fnumber=8,field=5",
    "escapes": "1", "relocate": "1", "spread": "0.5", "part": "1/2", "show/optimize": "variables",
    "state": "search.state", "of": "mean", "limit": "20um", "refocus": "none", "adjust": "t1",
    "trials": "5", "show/tolerance": "trials", "drop": "20um", "criterion/tolerance": "efl",
    "method/tolerance": "differential", "gap/tolerance": "last", "field/tolerance": "0,1deg",
    "field/optimize": "0,1deg", "rays/optimize": "12", "rays/tolerance": "12",
    "depth-map": "../depth.png", "hidden": "nearby", "band": "20nm", "blades": "6",
    "blade-turn": "10deg", "blade-rounding": "0.5", "focus-at": "sharpest", "autofocus": "0.3:0.4",
    "shutter": "rolling", "travel-time": "5ms", "curtain-distance": "2mm", "curtain-overrun": "1mm",
    "opening-time": "2ms", "closing-time": "3ms", "shutter-direction": "left", "crop": "2:2:8x6",
    "samples": "8", "bounces": "0", "bands": "16", "bits": "16", "packing": "none",
    "read-noise": "9", "full-well": "3000", "dark-current": "90000", "fill": "0.7",
    "efficiency": "0.8", "response": "mono", "gain": "0.3", "black": "64", "adc": "12",
    "acceptance": "2", "mosaic": "rggb", "white": "tungsten", "grain": "17", "no-skip": "all",
    "error/render": "20%", "focus/render": "98", "size/render": "20x15", "depth/render": "1m..3m",
    "scene/render": "sunny-16", "gap/render": "1", "model/render": "thin", "rays/render": "rays.csv",
    "sensor/render": "4/3", "field-width/render": "0.5mm", "film/render": "HP5 Plus",
    "output/render": "own.pfm", "seed": "7", "readout/render": "1/100", "criterion": "energy80",
    "times": "1/30,1/2", "response/tone": "debevec", "calibrate": "100", "fov": "20deg",
    "fx": "6000", "resolution": "0.5um", "subject-size": "1m", "lenses": "10cm,2cm,20cm", "medium": "1.33",
    "operator": "filmic", "ceiling/tone": "human", "white/tone": "0.01", "gamma": "1.8",
    "display": "5,80", "scale/tone": "1,1000", "curves": "curves.csv",
}
# options of speed, form and files, which change no answer; of form is the stop series whose labels
# stand beside exact values; positions and sections are of few lenses, and what is no option but
# stands by itself is in the questions
FORM = {"threads", "position", "section", "scale", "disc", "card", "list", "element", "iso10110", "wedge", "save", "output", "series", "focus-by",
        "seconds", "resume", "report", "state", "shell", "words", "subject", "frames", "parts", "files", "topic"}
# command (None: any), option, what it says nothing beside (None: anything), and why that is right
EXEMPT = (
    (None, "clip", None, "the default, said"),
    (None, "no-clip", None, "stopped down, nothing else limits a lens's rays"),
    (None, "error", None, "what is reached anyway is better than that"),
    ("psf", "log", None, "the default of a drawing, said"),
    ("fan", "show", None, "of text and drawings: rows have both"),
    ("fit", "show", None, "what is left of goals stands beside them"),
    ("tolerance", "refocus", "gap", "the gap is that of the image plane"),
    ("tone", "acuity", "calibrate", "so much light leaves the eye all it can see"),
    ("render", "black", None, "development takes it off again, but for rounding"),
    ("render", "noise", "full-well", "where light comes pixels are full"),
    ("glass", "pgf", "vd", "the nearest may all have it"),
    ("exposure", "ev", "ev-at-iso", "the same light, as the rows of an answer name it"),
    ("exposure", "ev-at-iso", "ev", "the same light, as the rows of an answer name it"),
    ("optimize", "escapes", "show", "the best of two starts may be the same"),
    ("optimize", "spread", "show", "the best of two starts may be the same"),
    ("optimize", "relocate", "show", "of one element there is nowhere else to put it"),
    ("render", "wavelength", "model", "these have one focal length, and the chart is grey"),
    ("render", "spectrum", "model", "the same"),
    ("render", "band", "model", "the same"),
    ("render", "bits", "raw", "raw numbers have 16"),
    ("render", "noise", "read-noise", "noise of reading brings that of photons along"),
    ("flash", "sync", "time", "the time is within what the shutter synchronises"),
    ("panorama", "overlap", "per-row", "it may still be that of the rows"),
    ("panorama", "per-row", "overlap", "so many frames overlap by that much"),
    ("dof", "overlap", None, "so few shots may be the same for both"),
    ("panorama", "pupil", "each-row", "frames focused at infinity do not depend on it"),
    ("panorama", "tolerance", "near", "an angle alone where pixels are not known, with --offset"),
    ("fov", "field-width", "field-diagonal", "of several fields the largest counts"),
    ("fov", "field-diagonal", "field-height", "the same"),
    ("focus", "converter-length", "converter", "it shows in distances, where these are known"),
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


# the small files that questions read, which stand beside the folder of each
FILES = {
    "singlet.lens": "lens Singlet\naperture f/8\nfield angle 0 3\nwavelength d g C\n"
                    "surface 102 5 N-BK7 26 stop\nsurface -103 97 air 26\n",
    "indices.csv": "wavelength_nm,index\n706.5,1.51289\n656.3,1.51432\n589.3,1.51673\n"
                   "546.1,1.51872\n486.1,1.52238\n435.8,1.52668\n404.7,1.53024\n",
    "tolerances.txt": "tolerance t1 0.2mm normal\n",
    "plates.tsv": "radius_mm\tdiameter_mm\n90\t40\n110\t40\n130\t40\n",
    "tiny.scene": "scene Tiny\ncamera at=0,0,1 look=0,0,0 focus=1\n"
                  "material lamp black emission=1 luminance=1000\nmaterial grey lambert colour=0.5\n"
                  "sphere radius=0.2 at=0.6,0,0.8 material=lamp\n"
                  "card size=1,1 at=0,0,-0.1 material=grey\n"
                  "sphere radius=0.05 at=0,0,0 material=grey move=0.01,0,0\n",
}
# and what makes others of them
MAKING = tuple(f"render {words} --lens ../singlet.lens --size 16x12 --samples 4" for words in (
    "chart:wedge -s 1 --luminance 0.05 -t 100 -o ../short.png", "chart:wedge -s 1 --luminance 0.05 -t 1000 -o ../long.png",
    "chart:bars -s 2 --response mono --raw -o ../depth.png", "chart:star -s 1 --part 1/2 -o ../one.part",
    "chart:star -s 1 --part 2/2 -o ../two.part"))


class Asker:
    """One command, asked often, several at a time, each in an empty folder of its own."""

    def __init__(self, program, command, folder):
        self.program, self.command, self.folder = program, command, folder
        self.environment = program.environment()
        has_format = "--format" in program.run(command, "--help").stdout.decode()
        self.format = ["--json"] if has_format else []
        for name, text in FILES.items():
            with open(os.path.join(folder, name), "w") as file:
                file.write(text)
        for words in MAKING:
            status, _, said, _ = self.run(words.split())
            assert status == 0, (words, said)

    def run(self, words):
        """(status, answer, what is said, the files that are written)"""
        with tempfile.TemporaryDirectory(dir=self.folder) as own:
            result = subprocess.run([*self.program.command, *words],
                                    cwd=own, env=self.environment, stdin=subprocess.DEVNULL,
                                    stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=120)
            written = []
            for name in sorted(os.listdir(own)):
                with open(os.path.join(own, name), "rb") as file:
                    written.append((name, file.read()))
        return result.returncode, result.stdout, result.stderr, tuple(written)

    def answer(self, words):
        return self.run([self.command, *words, *self.format])


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
