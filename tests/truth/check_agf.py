#!/usr/bin/env python3
"""tests/truth/check_agf.py - glass catalogues in the AGF format.

formulas.agf has a glass of each of the thirteen formulas: their indices through the binary, within
4e-16 of the formulas evaluated here with 50 digits (OpticStudio User Guide 2025 R1, "The Glass
Dispersion Formulas"), in every encoding that is met; what the other lines say; what is doubtful is
named, what is wrong refused with its place; glasses in lenses; a real catalogue of a maker.
"""
# SPDX-License-Identifier: MIT

import csv
import io
import os
import re
import sys
from decimal import Decimal, getcontext

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import ROOT, SHARED, Checks, Program

getcontext().prec = 50
LIMIT = Decimal("4e-16")
FILE = os.path.join(ROOT, "tests/truth/formulas.agf")
REAL = os.path.join(SHARED, "data/import/lightpath.agf")


class Tool(Program):
    def run(self, words):
        return super().run(*words)

    def rows(self, words):
        result = self.run([*words, "--csv"])
        if result.returncode != 0:
            print(words, result.stderr.decode())
        return list(csv.DictReader(io.StringIO(result.stdout.decode())))

    def write(self, name, content):
        """A file in a folder of the test's own."""
        path = os.path.join(self.holder.name, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "wb") as file:
            file.write(content)
        return path


def index_of(number, c, l):
    """Formula `number`; c has ten numbers; l in um."""
    x = l * l

    def sellmeier(terms):
        return 1 + sum(c[2 * i] * x / (x - c[2 * i + 1]) for i in range(terms))

    if number in (3, 5):
        z = 1 / (x - Decimal("0.028"))
        return (c[0] + c[1] * z + c[2] * z**2 + c[3] * x + c[4] * x**2 + c[5] * x**3
                if number == 3 else c[0] + c[1] / l + c[2] / (l**3 * l.sqrt()))
    schott = c[0] + c[1] * x + c[2] / x + c[3] / x**2 + c[4] / x**3 + c[5] / x**4
    square = {
        1: lambda: schott,
        2: lambda: sellmeier(3),
        4: lambda: 1 + c[0] + c[1] * x / (x - c[2]**2) + c[3] / (x - c[4]**2),
        6: lambda: sellmeier(4),
        7: lambda: c[0] + c[1] / (x - c[2]) - c[3] * x,
        8: lambda: c[0] + c[1] * x / (x - c[2]) - c[3] * x,
        9: lambda: c[0] + c[1] * x / (x - c[2]) + c[3] * x / (x - c[4]),
        10: lambda: schott + c[6] / x**5 + c[7] / x**6,
        11: lambda: sellmeier(5),
        12: lambda: schott + c[6] * x**2 + c[7] * x**3,
        13: lambda: (c[0] + c[1] * x + c[2] * x**2 + c[3] / x + c[4] / x**2 + c[5] / x**3
                     + c[6] / x**4 + c[7] / x**5 + c[8] / x**6),
    }[number]()
    return square.sqrt()


def read(text):
    """name -> (formula, coefficients, nd, Vd)"""
    glasses = {}
    name = None
    for words in (line.split() for line in text.splitlines()):
        if words[:1] == ["NM"]:
            name = words[1]
            glasses[name] = [int(words[2]), None, Decimal(words[4]), Decimal(words[5])]
        elif words[:1] == ["CD"] and name:
            c = [Decimal(word) for word in words[1:]]
            glasses[name][1] = c + [Decimal(0)] * (10 - len(c))
    return glasses


def check_indices(checks, program, path, glasses, what):
    for name, (formula, c, nd, vd) in glasses.items():
        near = ("1500", "2345.6", "9000") if formula == 3 else ("435.8343", "587.5618", "1013.98")
        waves = near if name not in ("BD1", "BD2") else ("3000", "9000")
        rows = program.rows(["glass", name, "--agf", path, "-w", ",".join(waves)])
        for wave, row in zip(waves, rows):
            true = index_of(formula, c, Decimal(wave) / 1000)
            checks.check(row["glass"] == name, f"{what}: {name} is answered by {row['glass']}")
            checks.against("agf" if what == "formulas.agf" else None,
                           f"{what}: {name} at {wave} nm", "index", row["index"], true, LIMIT * true)
        checks.check(len(rows) == len(waves), f"{what}: {name}: {len(rows)} rows")


def check_encodings(checks, program, text):
    wanted = program.run(["list", "glasses", "--agf", FILE, "--csv"]).stdout
    wanted = wanted.replace(FILE.encode(), b"FILE")
    for name, data in {
        "crlf": text.replace("\n", "\r\n").encode(),
        "mac": text.replace("\n", "\r").encode(),
        "utf8-bom": b"\xef\xbb\xbf" + text.encode(),
        "utf16le-bom": b"\xff\xfe" + text.encode("utf-16-le"),
        "utf16be-bom": b"\xfe\xff" + text.encode("utf-16-be"),
        "utf16le": text.replace("\n", "\r\n").encode("utf-16-le"),
        "8bit": text.replace("! One", "! \xd6ne").encode("cp1252"),
        "no-end": text.rstrip("\n").encode(),
    }.items():
        path = program.write(f"{name}/formulas.agf", data)
        got = program.run(["list", "glasses", "--agf", path, "--csv"]).stdout
        checks.check(got.replace(path.encode(), b"FILE") == wanted, f"encoding {name} reads otherwise")


def check_facts(checks, program):
    def facts(name, *more):
        return program.rows(["glass", name, "--agf", FILE, "-w", "500", *more])[0]

    one = facts("t1schott", "--thickness", "25mm")
    for key, value in {"glass": "T1-SCHOTT", "catalog": "FORMULAS", "status": "standard",
                       "from_nm": "310", "to_nm": "2500", "density_g_cm3": "2.51",
                       "expansion_1e6_k": "7.1", "source": FILE}.items():
        checks.check(one[key] == value, f"T1-SCHOTT: {key} is {one[key]}, not {value}")
    # of 0.99 at 25 mm and 0.998 at 10 mm the second is kept: 0.998^2.5
    checks.check(abs(float(one["transmittance"]) - 0.998**2.5) < 1e-15,
                 f"transmittance {one['transmittance']}")
    # dn/dT of [Schott TIE-19] at 20 C: (n^2 - 1)/(2 n) (D0 + E0/(l^2 - lTK^2))
    n = float(one["index"])
    growth = (n * n - 1) / (2 * n) * (1.86e-6 + 4.34e-7 / (0.25 - 0.17**2))
    checks.check(abs(float(one["dn_dt_vacuum_per_k"]) / growth - 1) < 1e-4, "dn/dT")
    for name, status in {"T2-SELLMEIER1": "obsolete", "T4-SELLMEIER2": "special",
                         "T5-CONRADY": "melt"}.items():
        checks.check(facts(name)["status"] == status, f"{name}: status")
    row = program.rows(["glass", "T3-HERZBERGER", "--agf", FILE, "-w", "2um"])[0]
    checks.check(row["status"] == "preferred" and row["dn_dt_vacuum_per_k"] == "", "T3: facts")
    checks.check(all(row["warning"] == "" for row in
                     program.rows(["list", "glasses", "--agf", FILE, "--kind", "formulas"])),
                 "formulas.agf has warnings")
    checks.check(program.run(["glass", "T1-SCHOTT", "--agf", FILE, "-w", "2501"]).returncode == 1,
                 "beyond the range")


BAD = [  # content, status, what stderr has
    ("NM A 14 0 1.5 50\nCD 2.25\n", 4, r"a.agf:1:6: '14' is not a formula.*1 to 13"),
    ("NM A 1.5 0 1.5 50\nCD 2.25\n", 4, r"a.agf:1:6: '1.5' is not a formula"),
    ("NM A 1 0 1.5 50\nCD 2.25 x\n", 4, r"a.agf:2:9: 'x' is not a number"),
    ("NM A 1 0 1.5 50\nLD 0.4 0.7\nNM B 1\nCD 2.25\n", 4, r"a.agf:1: glass 'A' has no line CD"),
    ("NM A 1 0 1.5 50\nCD 2.25\nLD 0.7 0.4\n", 4, r"a.agf:3:1: the range"),
    ("NM A 1 0 nan 50\nCD 2.25\n", 4, r"a.agf:1:10: 'nan' is not a number"),
    ("NM A 1\nCD 1 2 3 4 5 6 7 8 9 10 11\n", 4, r"a.agf:2:25: '11' is an eleventh"),
    ("nothing\n", 4, r"a.agf: no glass"),
    ("", 4, r"a.agf: no glass"),
]
DOUBTFUL = [  # content, what the warning has
    ("NM A 1 0 1.500 50\nCD 2.2 0 0.01\n", r"a.agf:1: A: the formula gives nd 1.492972, stated 1.5"),
    ("NM A 1 0 1.5 0\nCD 2.25\nZZ 1\n", r"a.agf:3: 'ZZ' is not known"),
    ("NM A 1 0 1.5 0\nCD 2.25 0 0 0 0 0 1\n", r"coefficient 7 is none of formula 1"),
    ("NM A 1 0 1.5 0\nCD 2.25\nIT 0.5 1.2 10\n", r"a.agf:3: .*not used"),
    ("NM A 1 0 1.5 0\nCD 2.25\nNM a 1 0 1.5\nCD 2.25\n", r"a.agf:1: the name stands in line 3"),
]


def check_bad(checks, program):
    for content, status, message in BAD:
        path = program.write("a.agf", content.encode())
        result = program.run(["glass", "A", "--agf", path])
        checks.check(result.returncode == status and re.search(message, result.stderr.decode()),
                     f"{content!r}: status {result.returncode}, {result.stderr.decode()}")
    for content, message in DOUBTFUL:
        path = program.write("a.agf", content.encode())
        rows = program.rows(["glass", "A", "--agf", path, "-w", "d"])
        checks.check(rows and re.search(message, rows[0]["warning"]), f"{content!r}: {rows}")
    # one name, two glasses
    path = program.write("a.agf", b"NM A 1\nCD 2.25\nNM a 1\nCD 2.26\n")
    result = program.run(["glass", "A", "--agf", path])
    checks.check(result.returncode == 2 and b"A:A (line 1), A:a (line 3)" in result.stderr,
                 f"homonyms in one file: {result.stderr}")
    checks.check(program.run(["glass", "A", "--agf", "/nowhere.agf"]).returncode == 5, "no file")
    # the candidates of two files, either by its catalogue
    other = program.write("b.AGF", b"NM A 1\nCD 2.27\n")
    first = program.write("a.agf", b"NM A 1\nCD 2.25\n")
    result = program.run(["glass", "A", "--agf", f"{first},{other}"])
    checks.check(result.returncode == 2 and b"A:A (line 1), B:A (line 1)" in result.stderr,
                 f"homonyms in two files: {result.stderr}")
    rows = program.rows(["glass", "B:A", "--agf", f"{first},{other}", "-w", "d"])
    checks.check(rows and rows[0]["catalog"] == "B", f"B:A: {rows}")


def wrapped(text, at, cut):
    """Every line CD, LD, TD and IT wrapped before its word `at`, or inside of that of CD."""
    lines = []
    for line in text.splitlines():
        words = line.split(" ")
        if words[0] not in ("CD", "LD", "TD", "IT") or len(words) <= at:
            lines.append(line)
        elif not cut:
            lines += [" ".join(words[:at]), " ".join(words[at:])]
        elif words[0] == "CD":
            middle = len(words[at]) // 2
            head, tail = words[at][:middle], words[at][middle:]
            lines += [" ".join([*words[:at], head]), " ".join([tail, *words[at + 1:]])]
        else:
            lines.append(line)
    return "\n".join(lines) + "\n"


def check_wrapped(checks, program, text, glasses):
    """A number that the end of a line has carried off, or cut in two, is read where it belongs."""
    for at in range(2, 9):
        path = program.write(f"w{at}.agf", wrapped(text, at, False).encode())
        check_indices(checks, program, path, glasses, f"wrapped before word {at}")
    stated = {name: glass for name, glass in glasses.items() if abs(glass[2] - 1) > 0 and glass[2]}
    checks.check(len(stated) >= 2, "glasses with a stated nd")
    for at in range(1, 7):
        path = program.write(f"c{at}.agf", wrapped(text, at, True).encode())
        check_indices(checks, program, path, stated, f"cut in word {at}")


def check_damaged(checks, program):
    """A glass that cannot be read is left out and named with its line; the others are read."""
    good = "NM {} 1 0 1.5 0\n{}CD 2.25\n"
    damage = {"E": "ED 7.8 - 5.2\n", "L": "LD 0.7 0.4\n", "T": "TD 1 x\n", "I": "IT a 1 10\n"}
    content = "".join(good.format(name, line) + good.format("N" + name, "")
                      for name, line in damage.items())
    content += "NM C 1 0 1.5 0\nNM NC 1 0 1.5 0\nCD 2.25\nNM F 99\nCD 2.25\n"
    path = program.write("d.agf", content.encode())
    lines = content.split("\n")
    result = program.run(["list", "glasses", "--agf", path, "--kind", "d", "--csv"])
    names = [row["glass"] for row in csv.DictReader(io.StringIO(result.stdout.decode()))]
    checks.check(result.returncode == 0 and names == ["NE", "NL", "NT", "NI", "NC"], f"read: {names}")
    said = re.findall(r"^(\S+):(\d+): .*the glass '(\w+)' is left out$", result.stderr.decode(), re.M)
    at = [(name, lines.index(line.strip()) + 1) for name, line in damage.items()]
    at += [("C", lines.index("NM C 1 0 1.5 0") + 1), ("F", lines.index("NM F 99") + 1)]
    checks.check(said == [(path, str(line), name) for name, line in at], f"left out: {said}")
    for name, line in at:
        result = program.run(["glass", name, "--agf", path])
        checks.check(result.returncode == 4 and f"{path}:{line}:" in result.stderr.decode(),
                     f"glass {name}: {result.stderr.decode()}")
    # a damaged one hides the glass of its name in the program
    path = program.write("schott.agf", b"NM N-BK7 2 0 1.5168 64.17\nCD x\nNM A 1\nCD 2.25\n")
    checks.check(program.run(["glass", "N-BK7", "--agf", path]).returncode == 4, "N-BK7 is damaged")


def check_lenses(checks, program):
    """A plano-convex lens of n = 1.5, R = 50 mm has f = 100 mm exactly; glasses of a folder."""
    lens = program.write("l.lens", b"surface 50 5 MINE -\nsurface - - air -\n")
    agf = program.write("db/glass/mine.agf", b"NM MINE 1 0 1.6 0\nCD 2.25\n")
    folder = os.path.dirname(os.path.dirname(agf))
    for option in (["--agf", agf], ["--lensdb", folder]):
        rows = program.rows(["lens", lens, *option])
        checks.check(rows and float(rows[0]["efl_mm"]) == 100 and
                     "stated 1.6" in rows[0]["warning"], f"{option}: {rows}")
    checks.check(program.run(["lens", lens]).returncode == 4, "MINE is in no catalogue")


def main():
    checks, program = Checks(), Tool(sys.argv[1])
    with open(FILE, encoding="utf-8") as file:
        text = file.read()
    glasses = read(text)
    checks.check(sorted(value[0] for value in glasses.values()) == list(range(1, 14)), "13 formulas")
    check_indices(checks, program, FILE, glasses, "formulas.agf")
    check_encodings(checks, program, text)
    check_facts(checks, program)
    check_bad(checks, program)
    check_wrapped(checks, program, text, glasses)
    check_damaged(checks, program)
    check_lenses(checks, program)
    if os.path.exists(REAL):
        with open(REAL, encoding="cp1252") as file:
            real = read(file.read())
        checks.check(len(real) == 11, f"lightpath.agf: {len(real)} glasses")
        check_indices(checks, program, REAL, real, "lightpath.agf")
        rows = program.rows(["list", "glasses", "--agf", REAL, "--kind", "lightpath"])
        checks.check(len(rows) == 11 and all(row["warning"] == "" for row in rows),
                     "lightpath.agf: eleven glasses without warnings")
    else:
        print("skipped: lightpath.agf (no ../shared/data/import)")
    checks.finish()


if __name__ == "__main__":
    main()
