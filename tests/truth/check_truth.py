#!/usr/bin/env python3
"""tests/truth/check_truth.py - the program's answers against independent numbers.

Through the binary: tests/truth/dof.tsv (187 rows of exact rationals) and thin_dof.tsv within
their stated tolerances; ../shared/reference/dof_truth.tsv where it exists; the same numbers in
every format, as one call and through --batch; every number the shortest text of its double;
--digits as printf writes.
"""
# SPDX-License-Identifier: MIT

import csv
import io
import json
import math
import os
import re
import sys
from fractions import Fraction

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import ROOT, SHARED, Checks, Program

EPSILON = 2.0 ** -52
NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?(?:e[+-]?\d+)?(?![\w.])")
# Units of the machine formats for lengths that the tables give in mm.
OUTPUT = {"m": ("magnification", 1), "v_mm": ("image_mm", 1), "Neff": ("working_fnumber", 1),
          "H_mm": ("hyperfocal_m", 1000), "near_mm": ("near_m", 1000), "far_mm": ("far_m", 1000),
          "front_mm": ("front_m", 1000), "behind_mm": ("behind_m", 1000),
          "total_mm": ("dof_m", 1000), "depth_of_focus_mm": ("depth_of_focus_mm", 1),
          "blur_inf_mm": ("blur_at_infinity_mm", 1)}


def read_table(path):
    with open(path, encoding="utf-8") as file:
        lines = [line.rstrip("\n") for line in file if not line.startswith("#")]
    return list(csv.DictReader(lines, delimiter="\t"))


def dof_rows(program, checks, rows, form):
    """The answers of `dof --batch` to rows of a truth table, in one call."""
    text = "f_mm,N,s_mm,c_mm,P,id\n" + "".join(
        f"{row['f_mm']},{row['N']},{row['s_mm']},{row['c_mm']},{row.get('P', '1')},"
        f"{row.get('id', i)}\n" for i, row in enumerate(rows))
    result = program.run("dof", "--batch", "-", "--format", form, stdin=text)
    checks.check(result.returncode in (0, 3), f"dof --batch --{form}: status {result.returncode}")
    output = result.stdout.decode()
    answers = ([json.loads(line) for line in output.splitlines()] if form == "jsonl" else
               list(csv.DictReader(io.StringIO(output, newline=""),
                                   delimiter="\t" if form == "tsv" else ",")))
    checks.check(len(answers) == len(rows), f"dof --batch --{form}: {len(answers)} rows of "
                                            f"{len(rows)}")
    return answers


def value_of(answer, name):
    """A number of an answer; infinity from its companion in JSON; None where it is absent."""
    value = answer.get(name)
    if value in (None, ""):
        flag = answer.get(name.rsplit("_", 1)[0] + "_is_infinite")
        return math.inf if flag is True else None
    return float(value)


def check_value(checks, what, value, truth, scale, tolerance, source=None):
    """With a source the comparison is one of the table of validation: once, not in every format."""
    if value is None:
        checks.check(False, f"{what} is absent, expected {truth}")
    elif truth == "inf" or math.isinf(value):
        checks.check(value == float(truth), f"{what} is {value!r}, expected {truth}")
    else:
        case, _, column = what.rpartition(" ")
        truth = Fraction(truth) / scale
        checks.against(source, case, column, value, truth, Fraction(tolerance) * abs(truth),
                       {"m": "m", "mm": "mm"}.get(column.rpartition("_")[2], ""))


def check_dof_row(checks, where, row, answer, source=None):
    """Rules of tests/unit/test_dof.c, and one rounding more where the output is in metres."""
    if row["status"] != "ok":
        checks.check(bool(answer.get("error")), f"{where}: '{row['status']}' is not refused")
        checks.check(all(value_of(answer, name) is None for name, _ in OUTPUT.values()),
                     f"{where}: refused, but has results")
        return
    checks.check(not answer.get("error"), f"{where}: refused: {answer.get('error')}")
    # s is rounded to double before s - f is formed: condition s/(s - f)
    s, f = (float("inf") if row["s_mm"] == "inf" else Fraction(row["s_mm"])), Fraction(row["f_mm"])
    focus = 1 if s == float("inf") else float(s / (s - f))
    near, far = (4.0 if row[name] == "-" else float(row[name])
                 for name in ("kappa_near", "kappa_far"))
    limits = {"m": 4 * focus, "v_mm": 4 * focus, "Neff": 4 * focus, "H_mm": 4,
              "near_mm": 8 * near, "far_mm": 8 * far, "front_mm": 4 * near * focus,
              "behind_mm": 4 * far * focus, "total_mm": 4 * far * focus,
              "depth_of_focus_mm": 4 * focus, "blur_inf_mm": 4 * focus}
    for name, limit in limits.items():
        output, scale = OUTPUT[name]
        value = value_of(answer, output)
        if row["class"] == "at_H" and name in ("far_mm", "behind_mm", "total_mm"):
            # s is H itself: all that rounding leaves
            checks.check(value is not None and value * scale > 1e12, f"{where} {output}: {value}")
            continue
        # near and far are judged by the stated 8 eps kappa; the others may round once more
        extra = 0 if name in ("near_mm", "far_mm") or scale == 1 else 1
        check_value(checks, f"{where} {output}", value, row[name], scale,
                    (limit + extra) * EPSILON, source)


def check_dof(program, checks, path, form):
    rows = read_table(path)
    checks.check(len(rows) == 187, f"{path}: {len(rows)} rows")
    checks.check(sum(row["status"] != "ok" for row in rows) == 4, f"{path}: refused rows")
    for row, answer in zip(rows, dof_rows(program, checks, rows, form)):
        checks.check(str(answer.get("id")) == row["id"], f"{path}: row {row['id']} is out of order")
        check_dof_row(checks, f"{os.path.basename(path)} row {row['id']} ({form})", row, answer,
                      "dof" if form == "csv" else None)


def single_call(program, row, *more):
    return program.run("dof", "-f", row["f_mm"] + "mm", "-N", row["N"], "-s",
                       row["s_mm"] + ("" if row["s_mm"] == "inf" else "mm"), "-c",
                       row["c_mm"] + "mm", "-P", row["P"], *more)


def check_refusals(program, checks, path):
    for row in read_table(path):
        if row["status"] != "ok":
            result = single_call(program, row, "--csv")
            checks.check(result.returncode == 1 and result.stdout == b"" and result.stderr != b"",
                         f"row {row['id']} as one call: status {result.returncode}")


def check_thin(program, checks, path):
    rows = read_table(path)
    checks.check(len(rows) == 40, f"{path}: {len(rows)} rows")
    for number, (row, answer) in enumerate(zip(rows, dof_rows(program, checks, rows, "csv"))):
        where = f"thin_dof.tsv row {number + 1}"
        f, s = float(row["f_mm"]), float(row["s_mm"])
        blur = float(row["N"]) * float(row["c_mm"]) / f
        m = f / (s - f)
        # change of near and far for a relative change of the inputs: m/(m +- e)
        near, far = 1 + blur / (m + blur), 1 + blur / abs(m - blur)
        focus = s / (s - f)
        for name, output, scale, limit in (
                ("H_mm", "hyperfocal_m", 1000, 5), ("near_mm", "near_m", 1000, 8 * near * focus),
                ("far_mm", "far_m", 1000, 8 * far * focus), ("image_mm", "image_mm", 1, 4 * focus)):
            check_value(checks, f"{where} {output}", value_of(answer, output), row[name], scale,
                        limit * EPSILON, "thin-dof")
        check_value(checks, f"{where} magnification", value_of(answer, "magnification"),
                    row["mag"].lstrip("-"), 1, 8 * focus * EPSILON, "thin-dof")


def cells_of(output, form):
    """{name: text} of the one row that a call printed; texts are as printed."""
    if output == "":
        return {}
    if form in ("csv", "tsv"):
        names, values = list(csv.reader(io.StringIO(output, newline=""),
                                        delimiter="\t" if form == "tsv" else ","))
        return dict(zip(names, values))
    keep = {"parse_float": str, "parse_int": str}
    row = json.loads(output, **keep)
    return row["rows"][0] if form == "json" else row


def check_formats(program, checks, rows):
    """One row in all machine formats and through --batch: the same texts."""
    for row in rows:
        texts = {}
        for form in ("csv", "tsv", "json", "jsonl"):
            result = single_call(program, row, "--format", form)
            texts[form] = cells_of(result.stdout.decode(), form)
        if not checks.check(all(texts.values()), f"row {row['id']}: no answer in "
                                                 f"{[form for form in texts if not texts[form]]}"):
            continue
        reference = {name: value for name, value in texts["csv"].items() if name != "error"}
        for form in ("tsv", "json", "jsonl"):
            for name, value in reference.items():
                other = texts[form].get(name)
                if other is None:
                    flag = texts[form].get(name.rsplit("_", 1)[0] + "_is_infinite")
                    other = "inf" if flag else ""
                checks.check(other == value, f"row {row['id']} {name}: csv '{value}', "
                                             f"{form} '{other}'")
        header = "f_mm\tN\ts_mm\tc_mm\tP\n"
        line = "\t".join(row[name] for name in ("f_mm", "N", "s_mm", "c_mm", "P")) + "\n"
        result = program.run("dof", "--batch", "-", "--csv", stdin=header + line)
        batch = cells_of(result.stdout.decode(), "csv")
        for name, value in reference.items():
            checks.check(batch.get(name) == value,
                         f"row {row['id']} {name}: one call '{value}', --batch '{batch.get(name)}'")
        check_text(program, checks, row, reference)


def check_text(program, checks, row, reference):
    """The text format shows the same numbers with 4 digits."""
    for column in ("hyperfocal_m", "near_m", "magnification", "depth_of_focus_mm"):
        result = single_call(program, row, "--columns", column)
        lines = result.stdout.decode().splitlines()
        shown = re.findall(r"(-?\d[\d.]*(?:e[+-]?\d+)?|inf)\s*(\S*)$", lines[0]) if lines else []
        if not checks.check(shown != [], f"row {row['id']} {column}: text {lines[:1]}"):
            continue
        number, unit = shown[0]
        metres = {"km": 1000, "m": 1, "cm": 0.01, "mm": 0.001, "um": 1e-6, "nm": 1e-9}
        scale = 1.0
        if unit in metres:
            scale = metres[unit] / metres[column.rsplit("_", 1)[1]]
        exact, value = float(reference[column]), float(number) * scale
        checks.check(value == exact or abs(value / exact - 1) <= 6e-4 if exact else value == 0,
                     f"row {row['id']} {column}: text '{number} {unit}', csv {exact!r}")


def check_feed(program, checks):
    """The rows that dof writes are rows that dof and fov read: the same answers again."""
    for form in ("csv", "tsv", "jsonl"):
        first = program.run("dof", "-f", "35,50mm", "-N", "2.8,8", "-s", "1.5,3m,inf", "--format",
                            form)
        for command in ("dof", "fov", "hyperfocal"):
            again = program.run(command, "--batch", "-", "--format", form, stdin=first.stdout)
            checks.check(again.returncode == 0, f"dof --{form} | {command} --batch -: status "
                                                f"{again.returncode}: {again.stderr.decode()[:200]}")
            if command == "dof":
                def numbers(output):
                    rows = ([json.loads(line) for line in output.splitlines()]
                            if form == "jsonl" else list(csv.DictReader(
                                output.splitlines(), delimiter="\t" if form == "tsv" else ",")))
                    return [{name: row.get(name) for name in ("focal_mm", "fnumber", "distance_m",
                                                              "coc_mm", "near_m", "far_m", "dof_m")}
                            for row in rows]
                checks.check(numbers(first.stdout.decode()) == numbers(again.stdout.decode()),
                             f"dof --{form} | dof --batch - changes the numbers")


def check_pinned(program, checks):
    """Names that scripts outside rely on."""
    answer = json.loads(program.run("dof", "-f", "50mm", "-N", "2.8", "-s", "3m", "--sensor",
                                    "35mm", "--json").stdout)
    for key in ("command", "version", "assumptions", "rows"):
        checks.check(key in answer, f"dof --json has no key {key}")
    for key in ("sensor", "coc_mm", "coc_criterion", "pupil_magnification", "model",
                "distance_from"):
        checks.check(key in answer["assumptions"], f"dof --json: assumptions has no key {key}")
    for key in ("focal_mm", "fnumber", "distance_m", "coc_mm", "hyperfocal_m", "near_m", "far_m",
                "front_m", "behind_m", "dof_m", "magnification"):
        checks.check(isinstance(answer["rows"][0].get(key), (int, float)),
                     f"dof --json: no number {key}")
    airy = json.loads(program.run("dof", "-f", "50mm", "-N", "2.8", "-s", "3m", "-c", "airy",
                                  "--json").stdout)
    checks.check(airy["assumptions"].get("wavelength_nm") == 550,
                 "dof -c airy --json: assumptions has no wavelength_nm")


def check_digits(program, checks, rows):
    """Shortest texts, and --digits as printf rounds the same doubles."""
    table = "f_mm,N,s_mm,c_mm,P\n" + "".join(
        ",".join(row[name] for name in ("f_mm", "N", "s_mm", "c_mm", "P")) + "\n" for row in rows)
    for command in ("dof", "fov"):
        if command == "fov":
            table = "f_mm,s_mm,P\n" + "".join(
                f"{row['f_mm']},{row['s_mm']},{row['P']}\n" for row in rows)
        full = program.run(command, "--batch", "-", "--csv", stdin=table).stdout.decode()
        exact = list(csv.reader(io.StringIO(full, newline="")))
        for number, cells in enumerate(exact[1:], 1):
            wrong = [text for text in cells if NUMBER.fullmatch(text) and
                     shortest(float(text)) != text]
            checks.check(not wrong, f"{command} line {number}: not the shortest text: {wrong}")
        for digits in (1, 2, 6, 15, 17):
            cut = program.run(command, "--batch", "-", "--csv", "--digits", digits,
                              stdin=table).stdout.decode()
            rounded = list(csv.reader(io.StringIO(cut, newline="")))
            for number, (cells, short) in enumerate(zip(exact[1:], rounded[1:]), 1):
                wrong = [(text, found) for text, found in zip(cells, short)
                         if NUMBER.fullmatch(text) and found not in printed(text, digits)]
                checks.check(not wrong, f"{command} --digits {digits} line {number}: {wrong[:3]}")


def printed(text, digits):
    """What %.*g writes for the number that was printed in full as `text`.

    A text of at most 15 digits reads back as the program's own double (mm) without being the
    converted double (m) itself: that may be a neighbour.
    """
    value = float(text)
    near = [value]
    if len(re.sub(r"e.*|\D", "", text).lstrip("0")) <= 15:
        near += [math.nextafter(value, math.inf), math.nextafter(value, -math.inf)]
    return {"%.*g" % (digits, each) for each in near}


def shortest(value):
    """repr, laid out as the program does: exponents below 1e-4 and from 1e17 on."""
    sign, rest = ("-", repr(value)[1:]) if value < 0 else ("", repr(value))
    mantissa, _, exponent = rest.partition("e")
    whole, _, fraction = mantissa.partition(".")
    digits = (whole + fraction).lstrip("0")
    leading = len(whole + fraction) - len((whole + fraction).lstrip("0"))
    point = len(whole) - leading + int(exponent or 0)  # decimal point before digit `point`
    digits = digits.rstrip("0")
    if not digits:
        return sign + "0"
    if point < -3 or point > 17:
        body = digits[0] + ("." + digits[1:] if len(digits) > 1 else "")
        return f"{sign}{body}e{point - 1:+03d}"
    if point <= 0:
        return sign + "0." + "0" * -point + digits
    if len(digits) <= point:
        return sign + digits + "0" * (point - len(digits))
    return sign + digits[:point] + "." + digits[point:]


def main():
    os.chdir(ROOT)
    checks, program = Checks(), Program(sys.argv[1])
    own = "tests/truth/dof.tsv"
    for form in ("jsonl", "csv", "tsv"):
        check_dof(program, checks, own, form)
    reference = os.path.join(SHARED, "reference", "dof_truth.tsv")
    if os.path.exists(reference):
        check_dof(program, checks, reference, "jsonl")
    else:
        print(f"{os.path.relpath(reference, ROOT)}: not here: skipped")
    check_refusals(program, checks, own)
    check_thin(program, checks, "tests/truth/thin_dof.tsv")
    good = [row for row in read_table(own) if row["status"] == "ok"]
    check_formats(program, checks, good[::17])
    check_digits(program, checks, good)
    check_feed(program, checks)
    check_pinned(program, checks)
    checks.finish()


main()
