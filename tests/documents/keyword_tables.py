"""tests/documents/keyword_tables.py - the tables of keywords in lenscalc-convert(1).

Between a line '.\\" keywords of FORMAT' and '.\\" end of keywords' stands what
`lenscalc list keywords --kind FORMAT` says, so that page and program cannot differ.
"""
# SPDX-License-Identifier: MIT

import csv
import itertools
import re
import textwrap

PAGE = "man/lenscalc-convert.1"
BEGIN = re.compile(r'^\.\\" keywords of (\w+)$')
END = '.\\" end of keywords'


def wrap(text):
    return textwrap.wrap(text, 80, break_on_hyphens=False, break_long_words=False)


def table_of(program, kind):
    """The lines of roff of one format: an entry for each group of keywords."""
    result = program.run("list", "keywords", "--kind", kind, "--csv")
    rows = list(csv.DictReader(result.stdout.decode().splitlines()))
    lines = []
    for group, members in itertools.groupby(
            rows, lambda row: (row["fate"], row["place"], row["meaning"])):
        fate, place, meaning = (text.replace("-", "\\-") for text in group)
        words = " ".join(row["keyword"] for row in members)
        lines += [".TP 10", f".B {fate}", *wrap(f"{place}: {meaning}:"), *wrap(words)]
    return lines


def rewritten(program, text):
    """The page with the tables as the program has them, and of which formats it has one."""
    lines, kinds, inside = [], [], False
    for line in text.split("\n"):
        found = BEGIN.match(line)
        inside = inside and line != END
        if not inside:
            lines.append(line)
        if found:
            kinds.append(found.group(1))
            lines += table_of(program, found.group(1))
            inside = True
    return "\n".join(lines), kinds
