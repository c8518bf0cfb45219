#!/usr/bin/env python3
"""tests/structure/check_lensdb.py - checks the tables in lensdb/*.tsv.

Run from the repository root. Prints FILE:LINE: text for each problem, ends with
"N passed, N failed" (one check = one table row or one whole-file rule) and
exits with status 1 on failures. An optional argument names another folder.
"""
# SPDX-License-Identifier: MIT

import glob
import math
import os
import re
import sys

CONFIDENCE = ("sourced", "approx")
CAMERAS = ("dslr", "mirrorless", "rangefinder", "compact", "cine", "phone", "drone", "action",
           "sensor", "astronomy", "-")
LENS = {"focal_mm": (1, 300), "equivalent_mm": (8, 1000), "fnumber": (0.9, 10)}
STATUS = ("published", "third-party")
DIVISIONS = {"full": 1, "half": 2, "third": 3}
DEFAULT_FORMAT = "35mm"
LABEL_STOPS = 0.25  # a printed label may be this far from the exact value
INCH = 25.4

# column -> smallest and largest legal value; "-" allowed where OPTIONAL says so
RANGES = {
    "formats.tsv": {"width_mm": (1, 700), "height_mm": (1, 700)},
    "cameras.tsv": {"width_mm": (2, 80), "height_mm": (2, 80), "px_w": (500, 20000),
                    "px_h": (400, 20000), "pitch_um": (0.5, 20)},
    "fstops.tsv": {"step": (-20, 60)},
    "shutters.tsv": {"step": (-60, 60)},
    "iso.tsv": {"step": (0, 60), "din": (1, 60)},
    "scenes.tsv": {"ev100": (-12, 24)},
    "films.tsv": {"onset_s": (0, 1000), "valid_to_s": (0, 100000)},
    "filters.tsv": {"factor": (1, 10000), "stops": (0, 15), "mired": (-140, 140)},
    "lines.tsv": {"nm": (100, 20000)},
    "tolerances.tsv": {"value": (1e-5, 100)},
}
OPTIONAL = {"px_w", "px_h", "pitch_um", "factor", "stops", "mired", "valid_to_s"}
WHOLE = {"px_w", "px_h", "step", "din"}

COLUMNS = {
    "formats.tsv": "name aliases width_mm height_mm class confidence source",
    "cameras.tsv": "maker model aliases class width_mm height_mm px_w px_h pitch_um pitch_from focal_mm equivalent_mm fnumber confidence source",
    "fstops.tsv": "series step label note",
    "shutters.tsv": "series step label note",
    "iso.tsv": "series step label din note",
    "scenes.tsv": "name aliases ev100 scene confidence source",
    "films.tsv": "maker film aliases iso type model parameters onset_s valid_to_s status source note",
    "filters.tsv": "name aliases kind factor stops mired confidence source",
    "lines.tsv": "name nm element note",
    "glass_aliases.tsv": "alias material",
    "tolerances.tsv": "grade quantity value unit distribution confidence source",
}

passed = 0
problems = []


def check(where, faults):
    """Counts one check; faults is a list of texts, empty when it passed."""
    global passed
    if faults:
        problems.extend(f"{where}: {text}" for text in faults)
    else:
        passed += 1


def number(text):
    """A finite decimal number written plainly, else None."""
    if not re.fullmatch(r"-?\d+(\.\d+)?", text):
        return None
    return float(text)


def key(name):
    """Names are compared without case, blanks, - and _."""
    return re.sub(r"[\s_-]", "", name.lower())


def read(path):
    """Rows as (line number, dict); file-level problems are reported here."""
    name = os.path.basename(path)
    faults = []
    with open(path, "rb") as stream:
        data = stream.read()
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError as error:
        check(f"{path}:1", [f"not UTF-8: {error}"])
        return []
    if b"\r" in data:
        faults.append("has carriage returns")
    if not text.endswith("\n"):
        faults.append("does not end with a newline")
    lines = text.split("\n")[:-1] if text.endswith("\n") else text.split("\n")
    start = 0
    while start < len(lines) and lines[start].startswith("# "):
        start += 1
    if start == 0:
        faults.append("does not begin with comment lines")
    if start == len(lines):
        check(f"{path}:1", faults + ["has no header line"])
        return []
    header = lines[start].split("\t")
    if any(not re.fullmatch(r"[a-z][a-z0-9_]*", column) for column in header):
        faults.append("column names must be snake_case")
    if len(set(header)) != len(header):
        faults.append("two columns have the same name")
    if name in COLUMNS and header != COLUMNS[name].split():
        faults.append("columns must be: " + COLUMNS[name])
    if start + 1 == len(lines):
        faults.append("has no rows")
    check(f"{path}:{start + 1}", faults)

    rows = []
    for index, line in enumerate(lines[start + 1:], start + 2):
        cells = line.split("\t")
        if len(cells) != len(header):
            check(f"{path}:{index}", [f"{len(cells)} cells, {len(header)} columns"])
            continue
        check(f"{path}:{index}", [f"empty or padded cell in column {column}"
                                  for column, cell in zip(header, cells)
                                  if cell.strip() != cell or not cell])
        rows.append((index, dict(zip(header, cells))))
    return rows if name not in COLUMNS or header == COLUMNS[name].split() else []


def cell_faults(name, row):
    """Ranges, words and sources that hold for one row by itself."""
    faults = []
    for column, (low, high) in RANGES.get(name, {}).items():
        text = row[column]
        if text == "-" and column in OPTIONAL:
            continue
        value = number(text)
        if value is None:
            faults.append(f"{column} '{text}' is not a number")
        elif not low <= value <= high:
            faults.append(f"{column} {text} is outside {low} to {high}")
        elif column in WHOLE and value != int(value):
            faults.append(f"{column} {text} is not a whole number")
    if row.get("confidence", "sourced") not in CONFIDENCE:
        faults.append(f"confidence '{row['confidence']}' is none of {', '.join(CONFIDENCE)}")
    if row.get("status", "published") not in STATUS:
        faults.append(f"status '{row['status']}' is none of {', '.join(STATUS)}")
    if "source" in row and len(row["source"]) < 4:
        faults.append("has no source")
    if row.get("confidence") == "sourced" and row["source"].startswith("unsourced"):
        faults.append("says sourced and unsourced")
    for column, cell in row.items():
        if re.search(r"\.\./|/work/|/tmp/|/home/", cell):
            faults.append(f"{column} holds a path of a machine")
    return faults


def unique(path, names):
    """names: (line, name) pairs; each must stand for one row only."""
    seen = {}
    for line, name in names:
        folded = key(name)
        other = seen.setdefault(folded, line)
        check(f"{path}:{line}",
              [] if other == line else [f"name '{name}' already stands in line {other}"])


def size_name_faults(name, width, height):
    """A name such as 4x5in must have that size, or not look like one."""
    match = re.fullmatch(r"([\d.]+)x([\d.]+)(mm|cm|in|inch|\"|m)", key(name))
    if not match:
        return []
    unit = {"mm": 1, "cm": 10, "m": 1000}.get(match[3], INCH)
    size = sorted((float(match[1]) * unit, float(match[2]) * unit))
    if all(abs(a - b) <= 0.5 for a, b in zip(size, sorted((width, height)))):
        return []
    return [f"name '{name}' looks like a size but the format is {width:g} x {height:g} mm"]


def check_formats(path, rows):
    names = []
    for line, row in rows:
        own = [row["name"]] + ([] if row["aliases"] == "-" else row["aliases"].split(","))
        names += [(line, name) for name in own]
        faults = [f"name '{name}' has a blank or is empty" for name in own
                  if not name or re.search(r"\s", name)]
        if len({key(name) for name in own}) != len(own):
            faults.append("an alias repeats the name or another alias")
        width, height = number(row["width_mm"]), number(row["height_mm"])
        if width and height:
            for name in own:
                faults += size_name_faults(name, width, height)
            if not 1 <= max(width, height) / min(width, height) <= 4.5:
                faults.append(f"aspect ratio of {width:g} x {height:g} is not believable")
        check(f"{path}:{line}", faults)
    unique(path, names)
    default = [row for _, row in rows if row["name"] == DEFAULT_FORMAT]
    check(f"{path}:1", [] if len(default) == 1 and default[0]["confidence"] == "sourced"
          else [f"the default format {DEFAULT_FORMAT} must be there once, and sourced"])


def check_cameras(path, rows):
    for line, row in rows:
        faults = []
        width, height, px_w, px_h, pitch = (number(row[column]) for column in (
            "width_mm", "height_mm", "px_w", "px_h", "pitch_um"))
        if row["pitch_from"] not in ("published", "counts", "estimate", "-"):
            faults.append(f"pitch_from '{row['pitch_from']}' is not a known word")
        if (row["pitch_from"] == "-") != (row["pitch_um"] == "-"):
            faults.append("pitch_um and pitch_from must be known or unknown together")
        if (row["px_w"] == "-") != (row["px_h"] == "-"):
            faults.append("px_w and px_h must be known or unknown together")
        if width and height and not 0.85 <= width / height <= 2.5:
            faults.append(f"aspect ratio of {width:g} x {height:g} mm is not believable")
        if pitch and width and px_w and abs(1000 * width / px_w / pitch - 1) > 0.05:
            faults.append("pitch differs from width / px_w by more than 5 %")
        if width and height and px_w and px_h and abs(width / px_w * px_h / height - 1) > 0.05:
            faults.append("pixels differ from square by more than 5 %")
        for column, (low, high) in LENS.items():
            ends = [number(end) for end in row[column].split("-")] if row[column] != "-" else []
            if None in ends or len(ends) > 2 or ends != sorted(ends) or \
                    any(not low <= end <= high for end in ends):
                faults.append(f"{column} '{row[column]}' is neither a number nor two, rising")
        focal, equivalent = number(row["focal_mm"]), number(row["equivalent_mm"])
        if focal and equivalent and width and height and abs(
                focal * math.hypot(36, 24) / math.hypot(width, height) / equivalent - 1) > 0.12:
            faults.append("real and equivalent focal length do not belong to this area")
        if row["class"] not in CAMERAS:
            faults.append(f"class '{row['class']}' is none of {', '.join(CAMERAS)}")
        check(f"{path}:{line}", faults)
    unique(path, [(line, row["maker"] + row["model"]) for line, row in rows])
    # an alias is found with its maker and without: it is the name of no other camera
    models = {key(row["model"]) for _, row in rows}
    aliases = [(line, name) for line, row in rows if row["aliases"] != "-"
               for name in row["aliases"].split(",")]
    unique(path, aliases)
    for line, name in aliases:
        check(f"{path}:{line}", [f"alias '{name}' is the model of a camera"]
              if key(name) in models or name != name.strip() else [])


def label_value(text):
    """The number a label stands for: 5.6, 1/125."""
    match = re.fullmatch(r"1/([\d.]+)", text)
    value = number(match[1] if match else text)
    if not value or value < 0:
        return None
    return 1 / value if match else value


def check_series(path, rows, stops_of, words):
    """stops_of(value) is the exact position of a label on the scale, in stops."""
    previous = None
    for line, row in rows:
        faults = []
        step, value = number(row["step"]), label_value(row["label"])
        if row["series"] not in words:
            faults.append(f"series '{row['series']}' is none of {', '.join(words)}")
        elif value is None:
            faults.append(f"label '{row['label']}' is not a number or 1/number")
        elif step is not None:
            error = stops_of(value) - step / DIVISIONS[row["series"]]
            if not abs(error) <= LABEL_STOPS:
                faults.append(f"label {row['label']} is {error:+.2f} stops from step {row['step']}")
            position = (list(DIVISIONS).index(row["series"]), step)
            if previous is not None and position <= previous:
                faults.append("rows must go by series, then by rising step")
            previous = position
        check(f"{path}:{line}", faults)
    labels = [(line, row["series"] + ":" + row["label"]) for line, row in rows]
    unique(path, labels)


def check_iso(path, rows):
    check_series(path, rows, lambda value: math.log2(value / 3.125), ("full", "third"))
    for line, row in rows:
        step, din = number(row["step"]), number(row["din"])
        if step is None or din is None or row["series"] not in DIVISIONS:
            continue
        # speed 100 is 21 degrees and lies 5 stops above 3.125; 3 degrees a stop
        right = 21 + 3 * (step / DIVISIONS[row["series"]] - 5)
        check(f"{path}:{line}", [] if abs(right - din) < 0.01 else [f"din must be {right:g}"])


def pairs(text):
    """time:value pairs with rising times, else None."""
    found = [tuple(map(number, pair.split(":"))) for pair in text.split(";")]
    if any(len(pair) != 2 or None in pair for pair in found):
        return None
    times = [pair[0] for pair in found]
    return found if times == sorted(set(times)) else None


def film_faults(row):
    model, text = row["model"], row["parameters"]
    if model == "none":
        return [] if text == "-" else ["model none takes no parameters"]
    if model == "power":
        match = re.fullmatch(r"p=(\d\.\d+)", text)
        return [] if match and 1 <= float(match[1]) <= 2 else [f"bad exponent '{text}'"]
    if model == "gainer":
        match = re.fullmatch(r"a=(0\.\d+)", text)
        return [] if match and 0 < float(match[1]) < 1 else [f"bad coefficient '{text}'"]
    if model not in ("table", "stops", "step"):
        return [f"model '{model}' is not known"]
    found = pairs(text)
    if found is None:
        return [f"'{text}' is not a list of time:value pairs with rising times"]
    if model == "table" and any(corrected < metered for metered, corrected in found):
        return ["a corrected time is shorter than the metered one"]
    values = [value for _, value in found]
    if values != sorted(values) or values[0] < 0:
        return ["corrections must not fall"]
    return []


def aliased(rows, name):
    """(line, name) of every row and of every other name it answers to."""
    return [(line, word.strip()) for line, row in rows
            for word in [row[name]] + ([] if row["aliases"] == "-" else row["aliases"].split(","))]


FILM_TYPES = ("panchromatic", "orthochromatic", "colour negative", "colour reversal")


def check_films(path, rows):
    for line, row in rows:
        faults = film_faults(row)
        if row["type"] not in FILM_TYPES:
            faults.append(f"type '{row['type']}' is none of {', '.join(FILM_TYPES)}")
        onset, last = number(row["onset_s"]), number(row["valid_to_s"])
        if onset is not None and last is not None and last < onset:
            faults.append("valid_to_s is before onset_s")
        check(f"{path}:{line}", faults)
    unique(path, [(line, row["maker"] + row["film"]) for line, row in rows])


def check_scenes(path, rows):
    previous = -math.inf
    for line, row in rows:
        faults = []
        if not re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)*", row["name"]):
            faults.append(f"name '{row['name']}' must be words with hyphens")
        value = number(row["ev100"])
        if value is not None and value < previous:
            faults.append("rows must go by rising ev100")
        previous = value if value is not None else previous
        check(f"{path}:{line}", faults)
    unique(path, aliased(rows, "name"))


def check_filters(path, rows):
    for line, row in rows:
        factor, stops = number(row["factor"]), number(row["stops"])
        faults = []
        if factor is None and stops is None:
            faults.append("neither factor nor stops is given")
        if factor and stops is not None and abs(math.log2(factor) - stops) > LABEL_STOPS:
            faults.append("factor and stops differ by more than a quarter stop")
        check(f"{path}:{line}", faults)
    unique(path, aliased(rows, "name"))


UNSTATED = (0.365, 1.014)  # um, i to t: where a glass without a stated range has to be normal
STEPS = 2000  # of a range that is looked through


def terms(row):
    """(weight, resonance l^2) of a Sellmeier sum; none of the other formulas."""
    c = [float(word) for word in row["coefficients"].split()]
    if row["formula"] == "sellmeier":
        return list(zip(c[0::2], c[1::2]))
    if row["formula"] == "sellmeier_sq":
        return [(b, r * r) for b, r in zip(c[1::2], c[2::2])]
    return []


def slope(row):
    """A function of l whose sign is that of dn/dl where n is above 0."""
    c = [float(word) for word in row["coefficients"].split()]
    formula, resonances = row["formula"], terms(row)
    if resonances:
        return lambda l: -sum(b * r / (l * l - r) ** 2 for b, r in resonances)
    if formula == "schott":
        return lambda l: c[1] - (c[2] + (2 * c[3] + (3 * c[4] + 4 * c[5] / l**2) / l**2)
                                 / l**2) / l**4
    if formula == "power":
        return lambda l: sum(a * p * l ** (p - 1) for a, p in zip(c[1::2], c[2::2]))
    if formula == "conrady":
        return lambda l: -c[1] - 3.5 * c[2] / l**2.5
    if formula == "herzberger":
        return lambda l: (c[3] + 2 * c[4] * l**2 + 3 * c[5] * l**4
                          - (c[1] + 2 * c[2] / (l * l - 0.028)) / (l * l - 0.028) ** 2)
    raise ValueError(formula)


NO_MATTER = ("N15", "VACUUM")  # one index for all light; the reciprocal of that of air


def dispersion_faults(row):
    """Transparent matter has normal dispersion: n falls all over the range, without a pole."""
    low, high = UNSTATED if row["from_um"] == "-" else (float(row["from_um"]),
                                                        float(row["to_um"]))
    resonances = terms(row)
    poles = [math.sqrt(r) for b, r in resonances if b != 0 and r > 0]
    if row["formula"] == "herzberger":
        poles.append(math.sqrt(0.028))
    faults = [f"has a pole at {pole:.4g} um, inside of its range" for pole in poles
              if low <= pole <= high]
    if row["name"] in NO_MATTER or faults or resonances and all(b >= 0 and r >= 0 for b, r in resonances):
        return faults  # each term of such a sum falls
    of = slope(row)
    rising = [l for l in (low + (high - low) * i / STEPS for i in range(STEPS + 1)) if not of(l) < 0]
    if rising:
        faults.append(f"index rises with the wavelength between {rising[0]:.4g} and "
                      f"{rising[-1]:.4g} um, inside of {low:g} to {high:g}")
    return faults


def check_glasses(path, rows):
    # names stand once but for case; ranges are ranges; n falls in them; sources are stated
    seen = {}
    for line, row in rows:
        faults = []
        other = seen.setdefault(row["name"].lower(), line)
        if other != line:
            faults.append(f"name '{row['name']}' already stands in line {other}")
        if (row["from_um"] == "-") != (row["to_um"] == "-") or \
                row["from_um"] != "-" and not 0 < float(row["from_um"]) < float(row["to_um"]):
            faults.append(f"range {row['from_um']} to {row['to_um']}")
        else:
            faults += dispersion_faults(row)
        if row["licence"] not in ("CC0", "facts") or len(row["source"]) < 4:
            faults.append("has no source or licence")
        check(f"{path}:{line}", faults)


def check_aliases(path, rows):
    # each leads to a material or a catalogue, and hides the name of none
    glasses = {}
    for other in sorted(glob.glob(os.path.join(os.path.dirname(path), "glass", "*.tsv"))):
        catalog = os.path.basename(other)[:-4]
        with open(other, encoding="utf-8") as stream:
            names = [line.split("\t")[0] for line in stream if not line.startswith("#")][1:]
        glasses[catalog] = {key(name) for name in names}
    for line, row in rows:
        faults = []
        catalog, name = (row["material"].split(":") + [""])[:2]
        if row["alias"].endswith(":"):
            if catalog not in glasses or name or row["alias"][:-1] in glasses:
                faults.append(f"'{row['alias']}' is a catalogue or stands for none")
        elif ":" in row["alias"]:  # a homonym
            own, word = row["alias"].split(":")
            if own not in glasses or key(name) not in glasses.get(catalog, ()):
                faults.append(f"'{row['material']}', or the catalogue {own}, is not there")
            elif not any(key(word) in names for names in glasses.values()):
                faults.append(f"no glass is called '{word}'")
        else:
            if key(name) not in glasses.get(catalog, ()):
                faults.append(f"'{row['material']}' is in no catalogue")
            faults += [f"alias '{row['alias']}' hides {other}:{row['alias']}"
                       for other, names in glasses.items() if key(row["alias"]) in names]
        check(f"{path}:{line}", faults)
    unique(path, [(line, row["alias"]) for line, row in rows])


GRADES = ("commercial", "precision", "high")  # from wide to narrow
PERTURBED = {"radius", "thickness", "air", "index", "abbe", "irregularity", "element tilt",
             "element decenter"}


def check_tolerances(path, rows):
    """Every grade has every quantity, and each is narrower than the one before."""
    values = {}
    for line, row in rows:
        where = row["quantity"], row["unit"]
        widths = values.setdefault(where, [])
        faults = [] if row["grade"] in GRADES else [f"an unknown grade '{row['grade']}'"]
        if widths and not float(row["value"]) < widths[-1]:
            faults.append(f"{' '.join(where)} is not below that of the grade before")
        widths.append(float(row["value"]))
        check(f"{path}:{line}", faults)
    check(path, [f"{' '.join(where)} is not in every grade" for where, widths in values.items()
                 if len(widths) != len(GRADES)])
    check(path, [f"no {name}" for name in PERTURBED - {name for name, _ in values}])
    unique(path, [(line, f"{row['grade']} {row['quantity']} {row['unit']}") for line, row in rows])


CHECKS = {
    "tolerances.tsv": check_tolerances,
    "formats.tsv": check_formats,
    "cameras.tsv": check_cameras,
    "fstops.tsv": lambda path, rows: check_series(
        path, rows, lambda value: 2 * math.log2(value), tuple(DIVISIONS)),
    "shutters.tsv": lambda path, rows: check_series(
        path, rows, lambda value: -math.log2(value), tuple(DIVISIONS)),
    "iso.tsv": check_iso,
    "scenes.tsv": check_scenes,
    "films.tsv": check_films,
    "filters.tsv": check_filters,
    "glass_aliases.tsv": check_aliases,
}


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else "lensdb"
    for name in CHECKS:
        path = os.path.join(folder, name)
        check(f"{path}:1", [] if os.path.exists(path) else ["is missing"])
    for path in sorted(glob.glob(os.path.join(folder, "*.tsv"))):
        name = os.path.basename(path)
        rows = read(path)
        for line, row in rows:
            check(f"{path}:{line}", cell_faults(name, row))
        if name in CHECKS:
            CHECKS[name](path, rows)
    for path in sorted(glob.glob(os.path.join(folder, "glass", "*.tsv"))):
        check_glasses(path, read(path))
    for text in problems:
        print(text)
    print(f"{passed} passed, {len(problems)} failed")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
