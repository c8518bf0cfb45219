#!/usr/bin/env python3
"""tests/validation.py - the table of validation: every value from outside, and how far off we are.

    tests/validation.py BUILD_DIR [compare]

Tests that compare with a value from outside name its source, a row of tests/truth/sources.tsv
(Checks.against of harness.py, check_source of unit/check.h). Run with LENSCALC_VALIDATE set, as
tests/run does, each leaves a file in BUILD_DIR/validate; here they become BUILD_DIR/validate.tsv,
and of each source the row of tests/truth/validation.tsv: how many values, and of the one that
needs the largest share of what it is allowed: share, difference, allowance, unit, quantity, case.
From that table the page lenscalc-validation(7) and a part of README are made.

Figures are cut to one digit. Machines differ in the last bits, by their C libraries above all:
with `compare` a committed row stands while the run has its count, and its worst share and that of
the row's case are within a factor of 2 of the row's, shares below 0.01 being alike. Without it all
is written as the run has it. What needs ../shared keeps its row where that is not.
"""
# SPDX-License-Identifier: MIT

import csv
import glob
import os
import re
import sys
import textwrap

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from harness import ROOT, SHARED, Checks

SOURCES = os.path.join(ROOT, "tests/truth/sources.tsv")
TABLE = os.path.join(ROOT, "tests/truth/validation.tsv")
PAGE = os.path.join(ROOT, "man/lenscalc-validation.7")
README = os.path.join(ROOT, "README")
FIELDS = ("source", "case", "quantity", "value", "outside", "difference", "allowed", "unit")
ROW = ("source", "count", "share", "difference", "allowed", "unit", "quantity", "case")
BEGIN, END = '.\\" from tests/truth/validation.tsv', '.\\" end of the table'
SECTION = re.compile(r"(?ms)^Validation\n-+\n\n(.*?)\n\n\n")
KINDS = {"reference": "A program of 50 digits", "algebra": "Exact algebra",
         "own": "Tracers of the tests", "program": "Other programs", "lens": "Patents and textbooks",
         "data": "Makers and standards"}
LEAST = 0.01  # of a share that is told from others


def text_of(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def read_table(path):
    """The rows of a table with a head, as dictionaries; lines that begin with # are notes."""
    with open(path, encoding="utf-8") as file:
        lines = [line.rstrip("\n") for line in file if not line.startswith("#")]
    return list(csv.DictReader(lines, delimiter="\t", quoting=csv.QUOTE_NONE))


def sources():
    return {row["source"]: row for row in read_table(SOURCES)}


def is_kept(source):
    """Does its row stand as committed, since the values are not here?"""
    return source["needs"] == "shared" and not os.path.isdir(SHARED)


# -------- of the run --------

def gather(build):
    """{source: [its comparisons]}, which are written to BUILD/validate.tsv together."""
    found = {}
    with open(os.path.join(build, "validate.tsv"), "w", encoding="utf-8") as whole:
        whole.write("\t".join(("test", *FIELDS)) + "\n")
        for path in sorted(glob.glob(os.path.join(build, "validate/*.tsv"))):
            test = os.path.splitext(os.path.basename(path))[0]
            with open(path, encoding="utf-8") as file:
                for line in file:
                    whole.write(f"{test}\t{line}")
                    row = line.rstrip("\n").split("\t")
                    found.setdefault(row[0], []).append((test, *row))
    return found


def share_of(row):
    difference, allowed = float(row[6]), float(row[7])
    return difference / allowed if difference > 0 else 0.0


def one_digit(number):
    """Such as 0.03, 400, 4e-7."""
    mantissa, exponent = f"{number:.0e}".split("e")
    if -4 < int(exponent) < 5:
        return f"{float(f'{number:.0e}'):g}"
    return f"{mantissa}e{int(exponent)}"


def row_of(source, rows):
    worst = max(rows, key=share_of)
    return {"source": source, "count": str(len(rows)), "share": one_digit(share_of(worst)),
            "difference": one_digit(float(worst[6])), "allowed": one_digit(float(worst[7])),
            "unit": worst[8], "quantity": worst[3], "case": worst[2]}


def is_like(a, b):
    """Are two figures the same, but for the last bits of machines?"""
    return a / 2 <= b <= 2 * a


def stands(row, rows):
    """Does a run say what the row does?"""
    share, worst = max(float(row["share"]), LEAST), max(LEAST, *map(share_of, rows))
    same = [one for one in rows
            if (one[3], one[2], one[8]) == (row["quantity"], row["case"], row["unit"])]
    return int(row["count"]) == len(rows) and is_like(share, worst) and any(
        is_like(share, max(share_of(one), LEAST)) and is_like(float(row["allowed"]), float(one[7]))
        for one in same)


def table_of(known, found, comparing):
    """The rows as they should be: of the run, or those committed ones that stand."""
    committed, rows = {row["source"]: row for row in read_table(TABLE)}, []
    for name, source in known.items():
        row = committed.get(name)
        if is_kept(source):
            rows += [row] if row is not None else []
        elif comparing and row is not None and stands(row, found[name]):
            rows.append(row)
        else:
            rows.append(row_of(name, found[name]))
    return rows


# -------- the page and README --------

def roff(text):
    return text.replace("\\", "\\e").replace("-", "\\-").replace("'", "\\(aq")


def lines_of(text):
    """Lines of running text; none begins like a request."""
    return [("\\&" if line.startswith((".", "\\(aq")) else "") + line for line in textwrap.wrap(
        text, 78, break_on_hyphens=False, break_long_words=False)]


def count_words(row):
    return f"{int(row['count']):,} value" + ("s" if row["count"] != "1" else "")


def amount(row, name):
    return f"{row[name]} {row['unit']}".rstrip()


def worst_words(row):
    where = f"{row['quantity']} of {row['case']}" if row["case"] else row["quantity"]
    if float(row["share"]) == 0:
        return "all met exactly."
    return f"worst {row['share']} of what is allowed: {amount(row, 'difference')} of " \
           f"{amount(row, 'allowed')}, {where}."


def page_lines(known, table):
    lines = []
    for kind, title in KINDS.items():
        lines.append(f".SS {title}")
        for row in table:
            source = known[row["source"]]
            if source["kind"] == kind:
                lines += [".TP", f".B {roff(source['what'])}", *lines_of(roff(source["title"]) + "."),
                          *lines_of(roff(f"{count_words(row)}; {worst_words(row)}"))]
                if source["needs"] == "shared":
                    lines += lines_of("These are not ours to carry: the row is from a run that had "
                                      "them, and kept as it is where they are not.")
    return lines


def page_text(known, table):
    head, rest = text_of(PAGE).split(BEGIN + "\n")
    return "\n".join([head + BEGIN, *page_lines(known, table), END]) + rest.split(END)[1]


def readme_lines(known, table):
    """Ten lines: what stands behind it, and a line a kind."""
    total = sum(int(row["count"]) for row in table)
    lines = [f"{total:,} values from outside are compared by make check, none off by more than it",
             "may be (lenscalc-validation(7); make validate writes all into build/validate.tsv):", ""]
    for kind, title in KINDS.items():
        rows = [row for row in table if known[row["source"]]["kind"] == kind]
        worst = max(rows, key=lambda row: float(row["share"]))
        count = sum(int(row["count"]) for row in rows)
        lines.append(f"    {title:<23}{len(rows):>3} sources {count:>7,} values, worst "
                     f"{worst['share']} of what is allowed")
    return lines + ["", "Rows of OpticStudio's lens and of others' files, which are not ours to carry, are",
                    "kept from a run that had them."]


def readme_text(known, table):
    text = text_of(README)
    found = SECTION.search(text)
    return text[:found.start(1)] + "\n".join(readme_lines(known, table)) + text[found.end(1):]


def made_of(known, table):
    """{path: content} of everything that is made here."""
    lines = ["# Made by tests/validation.py: of each source of sources.tsv what the tests find.",
             "\t".join(ROW), *("\t".join(row[name] for name in ROW) for row in table)]
    return {TABLE: "\n".join(lines) + "\n", PAGE: page_text(known, table),
            README: readme_text(known, table)}


def check_sources(checks, known, found):
    """Each comparison is of a source that is listed, by a test that its row names."""
    for name, rows in found.items():
        tests = set(known[name]["tests"].split()) if name in known else set()
        seen = {row[0] for row in rows}
        checks.check(seen == tests, f"sources.tsv: {name} is compared by {sorted(seen)}, listed "
                                    f"are {sorted(tests)}")
        checks.check(all(len(row) == len(FIELDS) + 1 for row in rows), f"{name}: a line is torn")
        worst = max(rows, key=share_of)
        checks.check(share_of(worst) <= 1, f"{name}: {worst} is off by more than it may be")
    missing = {name for name, row in known.items() if not is_kept(row)} - set(found)
    checks.check(not missing, f"sources.tsv: nothing was compared with {sorted(missing)}")
    return checks.failed == 0


def main():
    os.chdir(ROOT)
    checks, known, comparing = Checks(), sources(), "compare" in sys.argv
    found = gather(sys.argv[1])
    if check_sources(checks, known, found):
        kept = [name for name, row in known.items() if is_kept(row)]
        if kept:
            print(f"skipped: no ../shared, as committed: {', '.join(kept)}")
        committed, table = read_table(TABLE), table_of(known, found, comparing)
        moved = [row["source"] for row in table if row not in committed]
        checks.check(not moved or not comparing, f"{', '.join(moved)}: not as committed")
        for path, content in made_of(known, table).items():
            same = text_of(path) == content
            name = os.path.relpath(path, ROOT)
            if not same and not comparing:
                with open(path, "w", encoding="utf-8") as file:
                    file.write(content)
                print(f"{name} is written anew: review the difference")
            checks.check(same or not comparing,
                         f"{name} is not what the tests find: make validate writes it")
    checks.finish()


if __name__ == "__main__":
    main()
