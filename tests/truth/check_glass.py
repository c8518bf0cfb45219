#!/usr/bin/env python3
"""tests/truth/check_glass.py - indices of all glasses against exact arithmetic.

Every row of lensdb/glass at the d F C g e lines and two wavelengths near the ends of its range,
through the binary: within 4e-16 of the formula evaluated with 50 digits from the decimals of the
table; nd and Vd as the maker prints them; tests/truth/glass.tsv (evaluated by another program);
the (nd, Vd) model; tests/truth/published.tsv (indices that others print); every name is found, homonyms are
refused or the current one is taken; names of other programs;
what is nearest to an nd and Vd.
"""
# SPDX-License-Identifier: MIT

import csv
import glob
import io
import math
import os
import re
import sys
from decimal import Decimal, getcontext

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import ROOT, Checks, Program

getcontext().prec = 50
LIMIT = Decimal("4e-16")  # of the index, relative: half an ulp, and that of the wavelength
ND_LIMIT = 3e-5           # the makers print nd to 5 or 6 places and fit to 1e-5
VD_LIMIT = 0.0012         # of Vd, or 0.06: printed with two places from rounded indices
LINES = {"d": "587.5618", "F": "486.1327", "C": "656.2725", "g": "435.8343", "e": "546.0740"}


def read_table(path):
    with open(path, encoding="utf-8") as file:
        lines = [line.rstrip("\n") for line in file if not line.startswith("#")]
    return list(csv.DictReader(lines, delimiter="\t", quoting=csv.QUOTE_NONE))


def pairs(values):
    return zip(values[0::2], values[1::2])


def index_of(formula, c, l):
    """The formulas as the head of the tables states them."""
    x = l * l
    if formula == "sellmeier":
        return (1 + sum(b * x / (x - r) for b, r in pairs(c))).sqrt()
    if formula == "sellmeier_sq":
        return (1 + c[0] + sum(b * x / (x - r * r) for b, r in pairs(c[1:]))).sqrt()
    if formula == "schott":
        return (c[0] + c[1] * x + c[2] / x + c[3] / x**2 + c[4] / x**3 + c[5] / x**4).sqrt()
    if formula == "power":
        return (c[0] + sum(a * l ** int(p) for a, p in pairs(c[1:]))).sqrt()
    if formula == "conrady":
        return c[0] + c[1] / l + c[2] / (l**3 * l.sqrt())
    if formula == "herzberger":
        z = 1 / (x - Decimal("0.028"))
        return c[0] + c[1] * z + c[2] * z * z + c[3] * x + c[4] * x**2 + c[5] * x**3
    raise ValueError(formula)


def catalogue():
    rows = {}
    for path in sorted(glob.glob(os.path.join(ROOT, "lensdb/glass/*.tsv"))):
        catalog = os.path.basename(path)[:-4]
        for row in read_table(path):
            row["c"] = [Decimal(word) for word in row["coefficients"].split()]
            rows[catalog, row["name"]] = row
    return rows


def ask(program, checks, questions):
    """The answers to (glass, wavelength) pairs."""
    text = "glass\twavelength_nm\n" + "".join(f"{glass}\t{nm}\n" for glass, nm in questions)
    result = program.run("glass", "--batch", "-", "--tsv", "--columns",
                         "glass,catalog,wavelength,index,nd,vd,taken_as,error", stdin=text, timeout=600)
    answers = list(csv.DictReader(io.StringIO(result.stdout.decode()), delimiter="\t",
                                  quoting=csv.QUOTE_NONE))
    checks.check(len(answers) == len(questions), f"{len(answers)} answers of {len(questions)}: "
                                                 f"{result.stderr.decode()[:300]}")
    return answers


def wavelengths(row):
    """Lines and two wavelengths near the ends, nm, as far as the range reaches."""
    found = list(LINES.values())
    if row["from_um"] != "-":
        low, high = 1000 * Decimal(row["from_um"]), 1000 * Decimal(row["to_um"])
        found = [nm for nm in found if low <= Decimal(nm) <= high]
        found += [str(low), str(high), str((low * 3 + high) / 4)]
    return found


def check_index(checks, source, what, value, truth):
    checks.against(source, what, "index", value, truth, LIMIT * truth)


def check_catalogue(program, checks, rows):
    questions = [(f"{catalog}:{name}", nm) for (catalog, name), row in rows.items()
                 for nm in wavelengths(row)]
    answers = ask(program, checks, questions)
    for (glass, nm), answer in zip(questions, answers):
        catalog, name = glass.split(":", 1)
        row = rows[catalog, name]
        checks.check((answer["catalog"], answer["glass"]) == (catalog, name),
                     f"{glass} is answered by {answer['catalog']}:{answer['glass']}")
        check_index(checks, "glass-formulas", f"{glass} at {nm} nm", answer["index"],
                    index_of(row["formula"], row["c"], Decimal(nm) / 1000))
    return {glass: answer for (glass, _), answer in zip(questions, answers)}


def check_printed(checks, rows, answers):
    """nd and Vd recomputed agree with what the maker prints."""
    for (catalog, name), row in rows.items():
        answer = answers.get(f"{catalog}:{name}")
        if answer is None or row["nd"] == "-":
            continue
        # where the formula's range ends short of the lines the program states no nd or Vd
        if answer["nd"]:
            checks.against("catalogues", f"{catalog}:{name}", "nd", answer["nd"], row["nd"],
                           ND_LIMIT)
        if answer["vd"] and row["vd"] != "-":
            printed = float(row["vd"])
            limit = max(0.06, VD_LIMIT * printed)
            if catalog == "SUMITA":  # from indices of five places, printed with one or none
                limit += 0.5 * 10 ** -len(row["vd"].partition(".")[2])
                limit += printed ** 2 * 1e-5 / (float(row["nd"]) - 1)
            checks.against("catalogues", f"{catalog}:{name}", "Vd", answer["vd"], row["vd"], limit)


def check_truth(program, checks, rows):
    """Independent numbers; those outside of a glass's range are refused."""
    lines = {row["name"]: row["nm"] for row in read_table(os.path.join(ROOT, "lensdb/lines.tsv"))}
    cases = []
    for row in read_table(os.path.join(ROOT, "tests/truth/glass.tsv")):
        model = re.fullmatch(r"nd=(.*),Vd=(.*)", row["glass"])
        nm = lines.get(row["wavelength"]) or str(1000 * Decimal(row["wavelength"]))
        glass = f"{model[1]}/{model[2]}" if model else row["glass"]
        cases.append((glass, nm, Decimal(row["index"])))
    answers = ask(program, checks, [(glass, nm) for glass, nm, _ in cases])
    for (glass, nm, truth), answer in zip(cases, answers):
        row = rows.get(tuple(glass.split(":", 1)))
        inside = row is None or row["from_um"] == "-" or \
            float(row["from_um"]) <= float(nm) / 1000 <= float(row["to_um"])
        if inside:
            check_index(checks, "indices", f"{glass} at {nm} nm", answer["index"], truth)
        else:
            checks.check("outside the range" in answer["error"], f"{glass} at {nm} nm: not refused")


def check_published(program, checks):
    """Indices that others print, each with its own limit."""
    cases = read_table(os.path.join(ROOT, "tests/truth/published.tsv"))
    answers = ask(program, checks, [(case["glass"], str(1000 * Decimal(case["um"])))
                                    for case in cases])
    for case, answer in zip(cases, answers):
        what = f"{case['glass']} at {case['um']} um"
        checks.against("published", f"{what} ({case['source'].partition(';')[0]})", "index",
                       answer["index"], case["index"], float(case["within"]))


def check_nearest(program, checks, rows):
    """What is nearest to an nd and a Vd, against a ranking made here."""
    lines = [Decimal(LINES[name]) / 1000 for name in "dFC"]
    known = {}
    for (catalog, name), row in rows.items():
        if row["from_um"] == "-" or (Decimal(row["from_um"]) <= lines[1] and
                                     Decimal(row["to_um"]) >= lines[2]):
            d, F, C = (float(index_of(row["formula"], row["c"], line)) for line in lines)
            known[catalog, name] = (d, (d - 1) / (F - C) if F != C else math.inf)
    for nd, Vd in ((1.517, 64), (1.62, 36), (1.9, 31), (1.435, 95), (1.52, None), (None, 50)):
        asked = [word for option, value in (("--nd", nd), ("--vd", Vd)) if value is not None
                 for word in (option, str(value))]
        result = program.run("glass", *asked, "--count", "12", "--tsv", "--columns",
                             "glass,catalog,distance,nd_difference,vd_difference"
                             if nd and Vd else "glass,catalog,distance")
        found = list(csv.DictReader(io.StringIO(result.stdout.decode()), delimiter="\t"))

        def distance(values):
            return math.hypot((values[0] - nd) / 0.0005 if nd else 0,
                              (values[1] - Vd) / (0.008 * Vd) if Vd else 0)
        best = sorted(distance(values) for values in known.values())[:12]
        what = " ".join(asked)
        checks.check(len(found) == 12, f"{what}: {len(found)} rows, {result.stderr.decode()}")
        for want, row in zip(best, found):
            values = known[row["catalog"], row["glass"]]
            checks.check(abs(float(row["distance"]) - want) <= 1e-7 + 1e-9 * want and
                         abs(distance(values) - want) <= 1e-7 + 1e-9 * want,
                         f"{what}: {row} instead of a distance of {want}")
            if nd and Vd:
                checks.check(abs(float(row["nd_difference"]) - (values[0] - nd)) <= 1e-12 and
                             abs(float(row["vd_difference"]) - (values[1] - Vd)) <= 1e-8,
                             f"{what}: differences of {row}")


def chosen(found):
    """Of several glasses of a name the only current one, else the only one not obsolete."""
    current = [entry for entry in found if entry[2]["status"] == "current"]
    alive = [entry for entry in found if entry[2]["status"] != "obsolete"]
    return current if current else alive


def check_names(program, checks, rows):
    """A bare name finds its glass in any case, the current one of several, or is refused."""
    by_name = {}
    for (catalog, name), row in rows.items():
        by_name.setdefault(name.lower(), []).append((catalog, name, row))
    names = list(by_name)
    answers = ask(program, checks, [(name, "1000") for name in names])
    for name, answer in zip(names, answers):
        found = by_name[name]
        several = len({(row["formula"], row["coefficients"]) for _, _, row in found}) > 1
        left = chosen(found) if several else found
        if several and len(left) != 1:
            typed = [f"{catalog}:{spelt}" for catalog, spelt, _ in found]
            checks.check("several glasses" in answer["error"] and
                         all(word in answer["error"] for word in typed),
                         f"homonym {name} is not refused with its list: {answer['error']}")
        elif answer["error"]:
            checks.check("outside the range" in answer["error"], f"{name}: {answer['error']}")
        else:
            checks.check((answer["catalog"], answer["glass"]) in
                         [(catalog, spelt) for catalog, spelt, _ in left],
                         f"{name} is answered by {answer['catalog']}:{answer['glass']}")
            checks.check(bool(answer["taken_as"]) == several,
                         f"{name}: what it is taken as is '{answer['taken_as']}'")


def check_aliases(program, checks):
    """Other programs' names: a question takes them and says so, a lens file does not."""
    aliases = [row for row in read_table(os.path.join(ROOT, "lensdb/glass_aliases.tsv"))
               if ":" not in row["alias"]]  # without catalogues and homonyms
    answers = ask(program, checks, [(row["alias"].lower(), "3000") for row in aliases])
    for row, answer in zip(aliases, answers):
        if not answer["error"]:
            checks.check(f"{answer['catalog']}:{answer['glass']}" == row["material"] and
                         answer["taken_as"].startswith(row["material"] + ", "),
                         f"{row['alias']} is {answer['catalog']}:{answer['glass']}, "
                         f"'{answer['taken_as']}'")
        else:
            checks.check(f"range of {row['material']}," in answer["error"],
                         f"{row['alias']}: {answer['error']}")
        lens = f"wavelength 3um\nsurface 50 1 {row['alias']} 9\nsurface - 9 air 9\n"
        result = program.run("lens", "--lens", "-", stdin=lens)
        checks.check(result.returncode == 4 and "is in no catalogue" in result.stderr.decode() and
                     row["material"] in result.stderr.decode(),
                     f"{row['alias']} in a lens file: {result.stderr.decode()}")


def main():
    program, checks = Program(sys.argv[1]), Checks()
    rows = catalogue()
    checks.check(len(rows) == 2862, f"{len(rows)} glasses, 2862 expected")
    answers = check_catalogue(program, checks, rows)
    check_printed(checks, rows, answers)
    check_truth(program, checks, rows)
    check_published(program, checks)
    check_names(program, checks, rows)
    check_aliases(program, checks)
    check_nearest(program, checks, rows)
    checks.finish()


main()
