#!/usr/bin/env python3
"""tests/truth/check_report.py - the page of `report` holds what its commands say: check_report.py BUILD_DIR

Each part names the command that makes it again: run by itself that must give the same text, and the
same drawing but for the names inside it. The page is well-formed, needs nothing from outside, and
no name stands in it twice.
"""
# SPDX-License-Identifier: MIT

import html
import os
import re
import shlex
import sys
import tempfile
import xml.etree.ElementTree as tree

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import EVERYTHING, Checks, Program

FIGURE = re.compile(r"<figure>\n<figcaption>(.*?) <code>(.*?)</code></figcaption>\n(.*?)</figure>", re.S)
BARE = "lens bare & <plain>\nobject inf\nsurface 50 3 1.5168/64.2 -\nsurface -50 0 air -\n"


def check_names(checks, what, text):
    names = re.findall(r' id="([^"]*)"', text)
    checks.check(len(names) == len(set(names)), f"{what}: a name stands there twice")
    used = set(re.findall(r"url\(#([^)]*)\)", text) + re.findall(r'href="#([^"]*)"', text))
    checks.check(used <= set(names), f"{what}: names of nothing: {sorted(used - set(names))[:3]}")


def check_part(checks, program, folder, command, body):
    words = shlex.split(html.unescape(command))[1:]
    result = program.run(*words, cwd=folder)
    said = result.stdout.decode()
    if body.startswith("<p>"):
        checks.check(result.returncode != 0, f"{command}: fails in the page only")
    elif body.startswith("<pre>"):
        checks.check(html.unescape(body[5:-len("</pre>\n")]) == said, f"{command}: another text")
    else:
        if "--plot" in words:
            with open(os.path.join(folder, words[-1])) as file:
                said = file.read()
        tree.fromstring(body)
        plain = re.sub(r'(id="|url\(#|href="#)p\d+-', r"\1", body)
        checks.check(said[said.index("<svg"):] == plain, f"{command}: another drawing")


def check_page(checks, program, folder, words, least):
    what = " ".join(words)
    result = program.run("report", *words, cwd=folder)
    page = result.stdout.decode()
    if not checks.check(result.returncode == 0 and page.endswith("</html>\n"),
                        f"{what}: {result.stderr.decode()}"):
        return
    parts = FIGURE.findall(page)
    checks.check(len(parts) >= least, f"{what}: {len(parts)} parts")
    checks.check(not re.search(r'(src|href)="(?!#|data:)', page), f"{what}: something from outside")
    check_names(checks, what, page)
    for _, command, body in parts:
        check_part(checks, program, folder, command, body)
    result = program.run("report", *words, "-o", "page.svg", cwd=folder)
    with open(os.path.join(folder, "page.svg")) as file:
        drawing = file.read()
    checks.check(result.returncode == 0, f"{what}: {result.stderr.decode()}")
    tree.fromstring(drawing)
    check_names(checks, what + " as a drawing", drawing)
    for title, _, _ in parts:
        checks.check(f">{title}</text>" in drawing, f"{what}: no {title} in the drawing")


def main():
    checks, program = Checks(), Program(sys.argv[1])
    with tempfile.TemporaryDirectory(prefix="lenscalc-test-") as folder:
        with open(os.path.join(folder, "bare & plain.lens"), "w") as file:
            file.write(BARE)
        check_page(checks, program, folder, ["double-gauss"], 12)
        check_page(checks, program, folder, ["double-gauss", "-N", "4"], 12)
        if EVERYTHING:
            check_page(checks, program, folder, ["canon-nfd-70-210"], 30)
            check_page(checks, program, folder, ["questar-35", "--images"], 16)
        check_page(checks, program, folder, ["bare & plain.lens"], 12)
    checks.finish()


if __name__ == "__main__":
    main()
