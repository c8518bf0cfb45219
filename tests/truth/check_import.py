#!/usr/bin/env python3
"""tests/truth/check_import.py - lens files of other programs.

Real files (../shared/data/import) against focal length and back focus that import_files.py works out
from the numbers in the file with 50 digits, glasses evaluated from ../shared/data/glass; import.tsv
has them, and which files are refused and why. Then every lens of lensdb through every format and
back: the same first-order figures bit for bit, or a stated refusal.
"""
# SPDX-License-Identifier: MIT

import csv
import json
import math
import os
import re
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from decimal import Decimal

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import import_files
from harness import ROOT, SHARED, Checks, Program

FOLDER = os.path.join(SHARED, "data/import")
STUDIO = os.path.join(SHARED, "reference/opticstudio")
GLASSES = os.path.join(SHARED, "data/glass/glass.tsv")


def has_convert(program):
    return program.run("convert", "--help").returncode == 0


def read_tsv(path):
    with open(path, encoding="utf-8") as file:
        lines = [line.rstrip("\n") for line in file if not line.startswith("#")]
    return list(csv.DictReader(lines, delimiter="\t", quoting=csv.QUOTE_NONE))


def compute(row, glasses):
    """Surfaces, efl and bfl of a file, and distances from planes behind its last surface."""
    path = os.path.join(FOLDER, row["file"])
    with open(path, "rb") as file:
        text = import_files.text_of(file.read())
    _, surfaces, wavelength, unit = import_files.READERS[row["file"].rsplit(".", 1)[1]](text)
    names = dict(pair.split("=") for pair in row["glasses"].split())
    efl, bfl = import_files.first_order(surfaces, wavelength, unit,
                                        {name: glasses[to] for name, to in names.items()})
    # planes of air at the end change nothing: a reader may leave them out
    backs, back = [bfl], bfl
    for i in range(len(surfaces) - 1, 0, -1):
        if surfaces[i].c != 0 or surfaces[i].medium or surfaces[i - 1].medium not in (None, "mirror"):
            break
        back += surfaces[i - 1].t * unit
        backs.append(back)
    if hasattr(surfaces[-1], "image_t"):  # a displaced image may be kept as a last plane
        back = bfl - surfaces[-1].t * unit
        shift = surfaces[-1].image_t * unit
        backs += [back, back - shift, -shift]  # with PIM the distance before it is the bfl
    return efl, backs


def near(value, true, limit):
    return value is not None and abs(Decimal(value) - true) <= Decimal(limit) * max(abs(true), 1)


def first_row(result):
    try:
        return json.loads(result.stdout)["rows"][0]
    except (ValueError, KeyError, IndexError):
        return None


def figures_right(row, result, efl, backs):
    got = first_row(result)
    return (result.returncode == 0 and got is not None and near(got["efl_mm"], efl, row["limit"]) and
            any(near(got["bfl_mm"], back, row["limit"]) for back in backs)), got


def check_file(checks, program, row, glasses):
    path = os.path.join(FOLDER, row["file"])
    efl, backs = None, []
    if row["efl_mm"] != "-":
        efl, backs = compute(row, glasses)
        checks.check(near(efl, Decimal(row["efl_mm"]), "1e-12") and
                     near(backs[0], Decimal(row["bfl_mm"]), "1e-12"),
                     f"{row['file']}: computed {efl:.16g} {backs[0]:.16g}, import.tsv differs")
    more = []
    if row["agf"] != "-":
        catalog = os.path.join(program.holder.name, row["agf"])
        with open(catalog, "w", encoding="ascii") as file:
            file.write(AGF[row["agf"]])
        more = ["--agf", catalog]
    result = program.run("lens", path, "--json")
    message = result.stderr.decode("utf-8", "replace")
    if row["read"] == "ok":
        right, got = figures_right(row, result, efl, backs)
        checks.check(right, f"{row['file']}: {got and (got['efl_mm'], got['bfl_mm'])}, not "
                            f"{efl:.12g} {backs[0]:.12g}; {message}")
        if got is not None:
            checks.against("foreign", row["file"], "efl_mm", got["efl_mm"], efl,
                           Decimal(row["limit"]) * max(abs(efl), 1), "mm")
    else:
        checks.check(result.returncode == 4 and re.search(row["read"], message),
                     f"{row['file']}: status {result.returncode}, no /{row['read']}/ in {message!r}")
        if efl is not None and has_convert(program):
            lens = os.path.join(program.holder.name, row["file"] + ".lens")
            lossy = program.run("convert", path, "--lossy", "-o", lens, *more)
            listed = lossy.stdout.decode() + lossy.stderr.decode()
            result = program.run("lens", lens, "--json", *more)
            right, got = figures_right(row, result, efl, backs)
            checks.check(lossy.returncode == 0 and right,
                         f"{row['file']} --lossy: {got and (got['efl_mm'], got['bfl_mm'])}, not "
                         f"{efl:.12g} {backs[0]:.12g}; {listed[:300]}")


# fused silica by Malitson, J. Opt. Soc. Am. 55 (1965) 1205: what Zemax calls MISC SILICA
AGF = {"misc.agf": "NM SILICA 2 0 0 0\nCD 0.6961663 {} 0.4079426 {} 0.8974794 {}\nLD 0.21 3.71\n".format(
    *(Decimal(word) ** 2 for word in ("0.0684043", "0.1162414", "9.896161")))}

FORMATS = ("zmx", "seq", "len", "dat")
REFUSABLE = ("dat",)  # may refuse most lenses


def rows_of(program, lens, *more):
    result = program.run("lens", lens, "--json", "--position", "all", *more)
    if result.returncode != 0:
        return result.stderr.decode()[:300]
    return [{key: value for key, value in row.items() if key not in ("lens", "warning", "position")}
            for row in json.loads(result.stdout)["rows"]]


def lossy_trip(program, name, path, kind):
    """What is kept of a lens that the format refuses: its power, at its primary wavelength."""
    out = program.run("convert", name, "--to", kind, "--lossy", "-o", path)
    listed = (out.stdout + out.stderr).decode()
    if out.returncode != 0 or re.search("asphere|plane|A2", listed):
        return None if listed else "lossy: no word"
    before = rows_of(program, name)[0]
    after = rows_of(program, path, "-w", f"{before['wavelength_nm']}nm")
    keys = ("power_per_m", "efl_mm", "bfl_mm", "ffl_mm", "front_principal_mm")
    unlike = [key for key in keys if isinstance(after, str) or before[key] != after[0][key]]
    return f"lossy: {unlike} {after}" if unlike else None


def roundtrip(program, name, kind):
    """None, or what is wrong; and whether it was refused."""
    path = os.path.join(program.holder.name, f"{name}.{kind}")
    out = program.run("convert", name, "--to", kind, "-o", path)
    if out.returncode == 4:
        return (lossy_trip(program, name, path, kind) if out.stderr else "refused without a word"), True
    if out.returncode != 0:
        return f"convert: status {out.returncode}, {out.stderr.decode()[:200]}", False
    before, after = rows_of(program, name), rows_of(program, path)
    if isinstance(after, str):
        return f"read back: {after}", False
    if before != after:
        unlike = [(key, one[key], two.get(key)) for one, two in zip(before, after)
                  for key in one if one[key] != two.get(key)]
        return f"{len(before)} and {len(after)} rows, {unlike[:3]}", False
    return None, False


def check_json(checks, program, names):
    """The power that JSON's own radii, distances and indices give is that of the lens."""
    def at(value, position):
        return value[position] if isinstance(value, list) else value

    for name in names:
        lens = json.loads(program.run("convert", name, "--to", "json").stdout)
        rows = rows_of(program, name)
        waves = [wave["wavelength_nm"] for wave in lens["wavelengths"]] or [587.5618]
        checks.check([row["wavelength_nm"] for row in rows] ==
                     waves * max(len(lens["positions"]), 1), f"{name}: wavelengths of JSON")
        for i, row in enumerate(rows):
            position, wave = divmod(i, len(waves))
            y, v, n = 1.0, 0.0, 1.0
            for surface in lens["surfaces"]:
                after = -n if surface["medium"] == "mirror" else math.copysign(
                    surface["index"][wave], n)
                c = surface.get("curvature_per_mm")
                if c is None:
                    c = 0 if surface["radius_is_infinite"] else 1 / at(surface["radius_mm"], position)
                c += 2 * at(surface.get("coefficients_mm", {}).get("A2", 0), position)
                # without a section named the lens is followed in y-z
                v -= 0 if surface.get("cylinder") == "x" else y * (after - n) * c
                n = after
                y += (at(surface["thickness_mm"], position) or 0) * v / n
            checks.check(abs(-v * 1000 - row["power_per_m"]) <= 1e-9 * max(1, abs(row["power_per_m"])),
                         f"{name}, row {i}: power {-v * 1000} by its JSON, not {row['power_per_m']}")


def check_roundtrips(checks, program):
    kinds = [kind for kind in FORMATS
             if program.run("convert", "double-gauss-50", "--to", kind).returncode != 2]
    if kinds != list(FORMATS):
        print(f"skipped: round trips through {' '.join(kind for kind in FORMATS if kind not in kinds)}"
              " (no such format)")
    names = sorted(name[:-5] for name in os.listdir(os.path.join(ROOT, "lensdb/lenses")))
    if program.run("convert", "double-gauss-50", "--to", "json").returncode == 0:
        check_json(checks, program, names)
    tasks = [(name, kind) for kind in kinds for name in names]
    with ThreadPoolExecutor(2) as pool:
        answers = list(pool.map(lambda task: roundtrip(program, *task), tasks))
    refused = {kind: 0 for kind in kinds}
    for (name, kind), (wrong, was_refused) in zip(tasks, answers):
        checks.check(wrong is None, f"{name} through {kind}: {wrong}")
        refused[kind] += was_refused
    for kind in kinds: # a format that refuses most lenses is none
        if kind not in REFUSABLE:
            checks.check(refused[kind] < len(names) / 4, f"{kind} refuses {refused[kind]} lenses")
    if "--verbose" in sys.argv:
        print("refused:", refused, "of", len(names))


def schott_of(table):
    """a0, a1, a2 of n^2 = a0 + a1 l^2 + a2/l^2 through the indices at three wavelengths, um."""
    rows = [[1, l * l, 1 / (l * l), n * n] for l, n in table]
    for i in range(3):
        rows[i] = [x / rows[i][i] for x in rows[i]]
        for k in range(3):
            if k != i:
                rows[k] = [x - rows[k][i] * y for x, y in zip(rows[k], rows[i])]
    return [row[3] for row in rows]


def check_left_overs(checks, program):
    """
    What OpticStudio prints of a lens whose lines GLAS have the numbers of former model glasses: the
    lens as a .zmx file with such numbers has that focal length, and another one by the numbers.
    """
    with open(os.path.join(STUDIO, "studio.lens"), encoding="utf-8") as file:
        lens = file.read()
    with open(os.path.join(STUDIO, "figures.json"), encoding="utf-8") as file:
        printed = next(one["opticstudio"] for one in json.load(file)["figures"]
                       if one["quantity"] == "EFL")
    with tempfile.TemporaryDirectory(prefix="lenscalc-import-") as folder:
        def write(name, text):
            with open(os.path.join(folder, name), "w", encoding="utf-8", newline="") as file:
                file.write(text)
        agf = ""
        for i, table in enumerate(re.findall(r"\{.*?\}", lens)):
            pairs = [(float(l) / 1000, float(n)) for l, n in re.findall(r"([\d.]+)nm ([\d.]+)", table)]
            agf += f"NM T{i} 1 0 1.6 50 0\nCD {' '.join(map(repr, schott_of(pairs)))} 0 0 0\nLD 0.4 0.7\n"
            lens = lens.replace(table, f"OWN:T{i}")
        write("own.agf", agf)
        write("own.lens", lens)
        plain = program.run("convert", "own.lens", "--to", "zmx", "--agf", "own.agf", cwd=folder)
        numbers = re.sub(rb"(GLAS \S+ 0 0) \S+ \S+", rb"\1 1.6 40", plain.stdout)
        checks.check(plain.returncode == 0 and numbers.count(b" 1.6 40") == 11, "studio.lens as .zmx")
        write("own.zmx", numbers.decode())
        found = {}
        for which in ("file", "line", "catalog"):
            # by the numbers the last solve contradicts the lens, which is a loss
            row = first_row(program.run("lens", "./own.zmx", "--json", "--agf", "own.agf", "--lossy",
                                        "--glass-numbers", which, cwd=folder))
            found[which] = row["efl_mm"] if row is not None else float("nan")
        checks.check(abs(found["file"] - float(printed)) <= 5e-6 and found["catalog"] == found["file"],
                     f"left-overs beside the glasses: {found}, OpticStudio {printed}")
        checks.check(abs(found["line"] - float(printed)) > 0.1, f"--glass-numbers line: {found}")


def main():
    checks, program = Checks(), Program(sys.argv[1])
    if os.path.isdir(STUDIO):
        check_left_overs(checks, program)
    else:
        print("skipped: left-overs beside glasses (no ../shared/reference/opticstudio)")
    if os.path.isdir(FOLDER) and os.path.exists(GLASSES):
        glasses = {f"{row['catalog']}:{row['name']}": row for row in read_tsv(GLASSES)}
        rows = read_tsv(os.path.join(ROOT, "tests/truth/import.tsv"))
        for row in rows:
            check_file(checks, program, row, glasses)
        known = {row["file"] for row in rows} | {"README.md", "lightpath.agf"}
        checks.check(set(os.listdir(FOLDER)) <= known, "a file of data/import is not in import.tsv")
    else:
        print("skipped: real files (no ../shared/data/import)")
    if has_convert(program):
        check_roundtrips(checks, program)
    else:
        print("skipped: round trips (no convert in this program)")
    checks.finish()


if __name__ == "__main__":
    main()
