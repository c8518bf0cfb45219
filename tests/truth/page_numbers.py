"""tests/truth/page_numbers.py - numbers that examples on pages print, against numbers from outside.

That a page says what the program says is check_documents.py's to prove; here its text is read.
"""
# SPDX-License-Identifier: MIT

import os
import re
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))),
                                "documents"))
from check_documents import examples_of, page_blocks, unescape


NUMBER = re.compile(r"([-+]?(?:inf|\d+(?:\.(\d+))?(?:e[-+]?\d+)?))"
                    r"(?: (?:s|mm|um|m|dpt|deg|waves)(?: from the sensor)?)?")


def number(cell):
    """(value, half a unit of its last digit) of "12.3", "1/125 s", "-5.0 dpt"; else None."""
    text = re.sub(r"^1/(?=[\d.]+( s)?$)", "", cell)
    parts = NUMBER.fullmatch(text)
    if parts is None:
        return None
    value = float(parts[1])
    is_rounded = parts[2] or 1000 <= value < 10000  # to four digits
    half = 0.5 * 10.0 ** -len(parts[2] or "") if is_rounded else 1e-9 * abs(value)
    return (1 / value, half / value ** 2) if text != cell else (value, half)


def numbers(lines):
    """Of a table, as text or csv, row by row; assumptions below it are none."""
    found = []
    for line in lines:
        if line.startswith("assuming "):
            break
        cells = (number(cell.strip()) for cell in re.split(r"\s{2,}|[,\t]", line))
        found += [cell for cell in cells if cell is not None]
    return found


class Page:
    """Each example of a page that prints numbers is to be asked for with holds."""

    def __init__(self, checks, path):
        self.checks, self.path = checks, path
        with open(path, encoding="utf-8") as file:
            text = file.read()
        self.lines = [unescape(line).strip() for line in text.split("\n")]
        blocks = list(page_blocks(text))
        self.examples = [[line, " ".join(command.split()), numbers(output)]
                         for start, block in blocks
                         for line, command, output in examples_of(start, block)]

    def holds(self, words, *expected):
        """The next example whose command has these words prints these numbers and no others."""
        for example in self.examples:
            line, command, found = example
            if words not in command or found is None:
                continue
            example[2] = None
            self.compare(f"{self.path}:{line}: {command}", found, expected)
            return
        self.checks.check(False, f"{self.path}: no example has {words}")

    def says(self, label, *expected):
        """The line of text that begins with a label, two blanks or more behind it, has these."""
        lines = [line[len(label):].strip() for line in self.lines
                 if re.match(re.escape(label) + r"\s{2,}", line)]
        if self.checks.check(len(lines) == 1, f"{self.path}: {len(lines)} lines say {label}"):
            self.compare(f"{self.path}: {label}", numbers(lines), expected)

    def compare(self, where, found, expected):
        if self.checks.check(len(found) == len(expected),
                             f"{where}: {len(found)} numbers, expected {len(expected)}"):
            for (value, half), wanted in zip(found, expected):
                self.checks.check(value == wanted or abs(value - wanted) <= half * 1.000001,
                                  f"{where}: {value:.9g}, expected {wanted:.11g}")

    def finish(self):
        for line, command, found in self.examples:
            self.checks.check(not found, f"{self.path}:{line}: nothing is known of the numbers of "
                                         f"{command}")
