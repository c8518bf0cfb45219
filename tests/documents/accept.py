#!/usr/bin/env python3
"""tests/documents/accept.py - rewrite the outputs of all examples in README and man pages, the
tables of keywords, and long lines of the pages' text.

The conventions are those of check_documents.py. The difference is to be reviewed like any other:
this pins how things look, never what is true. Usage: tests/documents/accept.py BUILD [FILE...]
"""
# SPDX-License-Identifier: MIT

import glob
import os
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from check_documents import NOT_RUN, examples_of, form_of, page_blocks, readme_blocks
import keyword_tables
from harness import ROOT, Program


def escape(line):
    """A line of output as roff source; a blank one is no blank line there, which mandoc minds."""
    if not line:
        return "\\&"
    line = line.replace("\\", "\\e").replace("-", "\\-").replace("'", "\\(aq")
    return "\\&" + line if line.startswith((".", "\\(aq")) else line


WIDTH = 80  # of a line of roff source, which mandoc minds
KEPT = {".EX": ".EE", ".nf": ".fi", ".TS": ".TE"}  # whose lines are what they are


def break_line(line):
    """A line of text in lines of at most WIDTH; none of them begins like a request."""
    lines = []
    while len(line.encode()) > WIDTH:
        places = [i for i, c in enumerate(line[:WIDTH + 1]) if c == " " and 0 < i < len(line) - 1 and
                  line[i - 1] not in "\\." and line[i + 1] not in ".'"]
        if not places:
            break
        lines.append(line[:places[-1]])
        line = line[places[-1] + 1:]
    return lines + [line]


def wrap(lines):
    """The lines of a page, long ones of running text broken."""
    wrapped, end = [], None
    for line in lines:
        begins = KEPT.get(line[:3])
        if end is None and begins is None and not line.startswith((".", "'")):
            wrapped += break_line(line)
        else:
            wrapped.append(line)
        end = begins if end is None else None if line.startswith(end) else end
    return wrapped


def rewrite(program, path):
    page = path.startswith("man/")
    with open(path, encoding="utf-8") as file:
        lines = file.read().split("\n")
    blocks = list((page_blocks if page else readme_blocks)("\n".join(lines)))
    edits = []
    for start, block in blocks:
        indent = "" if page or lines[start - 1].startswith("$ ") else "    "
        with tempfile.TemporaryDirectory(prefix="lenscalc-doc-") as folder:
            for number, command, expected in examples_of(start, block):
                if command.split()[0] in NOT_RUN:
                    continue
                output = program.shell(command, folder).stdout.decode().rstrip("\n").split("\n")
                if command.startswith("lenscalc bench") and form_of(output) == form_of(expected):
                    continue  # its times never come out again
                first = number + command.count("\n")
                edits.append((first, first + len(expected),
                              [escape(line) if page else (indent + line if line else line)
                               for line in output if output != [""]]))
    for first, last, output in reversed(edits):
        lines[first:last] = output
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(wrap(lines) if page else lines))


def main():
    os.chdir(ROOT)
    program = Program(sys.argv[1])
    with open(keyword_tables.PAGE, encoding="utf-8") as file:
        text, _ = keyword_tables.rewritten(program, file.read())
    with open(keyword_tables.PAGE, "w", encoding="utf-8") as file:
        file.write(text)
    for path in sys.argv[2:] or ["README"] + sorted(glob.glob("man/*.[157]")):
        rewrite(program, path)


main()
