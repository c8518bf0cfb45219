#!/usr/bin/env python3
"""tests/truth/check_sequences.py - CODE V and OSLO files give the lens that their numbers say.

Focal length and back focus of every file are worked out here from the numbers that stand in it, by
a trace (y, n u) of its own with 40 digits and the makers' dispersion formulas; the program must
agree within 1e-12. Files of other programs lie in ../shared/data/import: those that say more than a
lens holds are refused with the line and the reason, and read when that line is taken out. The
smaller cases are files of this test's own: every spelling of a glass, pick-ups and solves against
their closed forms, positions, tilts, units, and what is refused.
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
from harness import SHARED, Checks, Program

getcontext().prec = 40
FILES = os.path.join(SHARED, "data/import")
GLASSES = os.path.join(SHARED, "data/glass/glass.tsv")


class Tool(Program):
    def file(self, name, content):
        path = os.path.join(self.holder.name, name)
        with open(path, "wb") as out:
            out.write(content if isinstance(content, bytes) else content.encode())
        return path

    def rows(self, command, path, *more):
        result = self.run(command, path, *more, "--csv")
        error = result.stderr.decode()
        return list(csv.DictReader(io.StringIO(result.stdout.decode()))), error


def load_glasses():
    """Sellmeier coefficients of Schott by the name without '-'."""
    found = {}
    with open(GLASSES, encoding="utf-8") as table:
        for row in csv.DictReader(table, delimiter="\t"):
            if row["catalog"] == "SCHOTT" and row["formula"] == "sellmeier":
                found[row["name"].replace("-", "").upper()] = [
                    Decimal(c) for c in row["coeffs"].split()]
    return found


def index_of(glasses, name, um):
    if name is None:
        return Decimal(1)
    if isinstance(name, Decimal):
        return name
    c = glasses[name.replace("-", "").upper()]
    square = um * um
    return (1 + sum(b * square / (square - d) for b, d in zip(c[::2], c[1::2]))).sqrt()


def trace(surfaces, glasses, um):
    """efl and bfl of [(curvature, thickness, glass)]; the glass "REFL" is a mirror."""
    y, v, n = Decimal(1), Decimal(0), Decimal(1)
    for i, (c, t, glass) in enumerate(surfaces):
        after = -n if glass == "REFL" else index_of(glasses, glass, um) * (1 if n > 0 else -1)
        v -= y * (after - n) * c
        n = after
        if i + 1 < len(surfaces):
            y += t / n * v
    return -1 / v, -y * n / v


def seq_surfaces(text, radius):
    surfaces = []
    for line in text.splitlines():
        words = line.split("!")[0].split()
        if words and words[0].upper() == "S":
            first = Decimal(words[1])
            c = (1 / first if first != 0 else first) if radius else first
            glass = words[3].upper() if len(words) > 3 else None
            if glass not in (None, "REFL"):
                glass = glass.replace("_SCHOTT", "")
            surfaces.append((c, Decimal(words[2]), glass))
    return surfaces


def len_surfaces(text):
    blocks = text.split("NXT")[1:-1]
    surfaces = []
    for block in blocks:
        words = {line.split()[0]: line.split()[1:] for line in block.splitlines()
                 if line.strip() and not line.strip().startswith("//")}
        radius = Decimal(words.get("RD", ["0"])[0])
        glass = None
        if "RFL" in words:
            glass = "REFL"
        elif "GLA" in words:
            last = words["GLA"][-1]
            glass = Decimal(last) if re.fullmatch(r"[\d.]+", last) else last
        surfaces.append((1 / radius if radius else radius,
                         Decimal(words.get("TH", ["0"])[0]), glass))
    return surfaces


def check_lens(checks, tool, name, path, surfaces, glasses, um, scale=1):
    rows, error = tool.rows("lens", path)
    if not checks.check(rows, f"{name} is not read: {error}"):
        return
    efl, bfl = trace(surfaces, glasses, um)
    for key, value in (("efl_mm", efl * scale), ("bfl_mm", bfl * scale)):
        checks.against("foreign", name, key, rows[0][key], value, Decimal("1e-12") * abs(efl), "mm")
    checks.check(abs(Decimal(rows[0]["wavelength_nm"]) - um * 1000) < Decimal("1e-9"),
                 f"{name}: wavelength {rows[0]['wavelength_nm']}")


def without(text, pattern):
    return "\n".join(line for line in text.splitlines() if not re.match(pattern, line))


def check_refused(checks, tool, path, line, reason):
    _, error = tool.rows("lens", path)
    name = os.path.basename(path)
    checks.check(f"{name}:{line}:" in error and reason in error,
                 f"{name}: refused at line {line} for '{reason}', not: {error}")


def check_shared(checks, tool):
    if not os.path.isdir(FILES):
        print("files of other programs: not here, skipped")
        return
    glasses = load_glasses()
    cases = (("ag_dblgauss.seq", r"VUY|VLY", 12, "vignetting", False, "0.5876", 1),
             ("questar35.seq", None, 0, "", False, "0.5550", "25.4"),
             ("threemir.seq", None, 0, "", True, "0.5", 1),
             ("folded_lenses.seq", None, 0, "", False, "0.555", 1))
    for name, pattern, line, reason, radius, um, scale in cases:
        path = os.path.join(FILES, name)
        text = open(path).read()
        if pattern is not None:
            check_refused(checks, tool, path, line, reason)
            path = tool.file(name, without(text, pattern))
        surfaces = seq_surfaces(re.sub(r"(?m)^s ", "S ", text), radius)
        if name.startswith("threemir"):  # its image plane is tilted: it stays, out of focus
            c, _, glass = surfaces[-1]
            focus = trace(surfaces, glasses, Decimal(um))[1]
            surfaces[-1] = (c, focus + Decimal("15.407921"), glass)
            surfaces.append((Decimal(0), Decimal(0), None))
        check_lens(checks, tool, name, path, surfaces, glasses, Decimal(um), Decimal(scale))
    name = "optiland_cooke_triplet.seq"
    text = open(os.path.join(FILES, name)).read()
    check_refused(checks, tool, os.path.join(FILES, name), 10, "without RDM")
    check_lens(checks, tool, name, tool.file(name, "RDM\n" + text), seq_surfaces(text, True),
               glasses, Decimal("0.5876"))
    for name, um in (("test_cooke_triplet.len", "0.48"), ("test_cassegrain.len", "0.55"),
                     ("test_asphere_singlet.len", "0.587"), ("cox2_01.len", "0.58756")):
        path = os.path.join(FILES, name)
        check_lens(checks, tool, name, path, len_surfaces(open(path).read()), glasses, Decimal(um))
    check_details(checks, tool)


def check_details(checks, tool):
    """Single facts of the files, as they stand there."""
    path = os.path.join(FILES, "cox2_01.len")
    rows, _ = tool.rows("surfaces", path)
    checks.check([r["medium"] for r in rows[1::2]][:2] == ["1.573", "1.510"] or
                 [r["medium"] for r in rows if r["medium"] != "air"] ==
                 ["1.573", "1.51", "1.648", "1.516"], "cox2_01: indices")
    checks.check([float(r["diameter_mm"]) for r in rows[1:3]] == [1.294083296208, 1.38374760518],
                 "cox2_01: AP is the radius")
    rows, _ = tool.rows("surfaces", os.path.join(FILES, "test_asphere_singlet.len"))
    checks.check(len(rows) == 2, "test_asphere_singlet: surfaces")
    rows, _ = tool.rows("surfaces", os.path.join(FILES, "test_cassegrain.len"))
    checks.check([float(r["conic"]) for r in rows] == [-1, -2.5], "test_cassegrain: conics")


HEAD = "RDM;LEN\nEPD 5\nWL 587.5618\nSO 0 1e13\n"


def thickness(tool, path, surface, *more):
    rows, error = tool.rows("surfaces", path, *more)
    found = [r for r in rows if r["surface"] == str(surface)]
    return float(found[0]["thickness_mm"]) if found else error


def check_own_seq(checks, tool):
    body = HEAD + "S 50 5 {}\nSTO\nS -50 40\nSI 0 0\n"
    for glass, index in (("517642", 1.517), ("516800.641670", 1.5168), ("1.5168:64.17", 1.5168),
                         ("670.471", 1.670), ("'OWN'", 1.5), ("'own'", 1.5)):
        text = body.format(glass).replace("SO 0", "PRV\nPWL 656.3 587.5618 486.1\n"
                                          "'OWN' 1.5 1.5 1.5\nEND\nSO 0")
        rows, error = tool.rows("surfaces", tool.file("glass.seq", text))
        checks.check(rows and abs(float(rows[0]["index"]) - index) < 1e-14,
                     f"glass {glass}: {rows[0]['index'] if rows else error}")
    table = body.format("'T'").replace("SO 0", "PRV\nPWL 656.3 587.5618&\n 486.1\n"
                                       "'T' 1.51 1.52 1.53\nEND\nSO 0")
    rows, error = tool.rows("surfaces", tool.file("table.seq", table))
    checks.check(rows and float(rows[0]["index"]) == 1.52, f"table of PRV: {error}")
    for text in (body.format("NBK7_SCHOTT"), body.format("nbk7_schott"), body.format("'N-BK7'"),
                 body.format("AIR\nGLA S1 NBK7_SCHOTT")):
        rows, error = tool.rows("surfaces", tool.file("name.seq", text))
        checks.check(rows and rows[0]["medium"] == "SCHOTT:N-BK7" or
                     rows and rows[0]["medium"] == "N-BK7", f"N-BK7: {error}")


def check_own_solves(checks, tool):
    # a plano-convex lens, n = 1.5, R = 50: f = 100, and the image 100 behind its plane side
    # less t/n = 4 of the thickness 6
    plano = HEAD + "S 50 6 500000.500000\nSTO\nS 0 1\n{}SI 0 0\n"
    for solve in ("PIM\n", "THI HMY 0\n"):
        path = tool.file("solve.seq", plano.format(solve))
        rows, error = tool.rows("lens", path)
        checks.check(rows and abs(float(rows[0]["bfl_mm"]) - 96) < 1e-12, f"{solve}: {error}")
    path = tool.file("height.seq", plano.format("THI HMY 1.2\n") )
    # the marginal ray: y = 2.5 at surface 1, 2.4 at surface 2, then falls by 2.5/100 a mm
    checks.check(abs(thickness(tool, path, 2) - 48) < 1e-12, "THI HMY 1.2 is 48 mm")
    # a curvature behind which the marginal ray has the angle -0.05: n'u' = 1.5 u - y (1 - 1.5) c,
    # u = -1/60, y = 2.4: c = (-0.05 + 0.025)/1.2
    path = tool.file("angle.seq", plano.format("CUY UMY -0.05\n"))
    rows, error = tool.rows("surfaces", path)
    found = 1 / float(rows[1]["radius_mm"]) if rows else 0
    checks.check(abs(found + 0.025 / 1.2) < 1e-14, f"CUY UMY: {found} {error}")
    path = tool.file("pick.seq", HEAD + "S 50 6 517642\nSTO\nS 30 2\nS -70 3\nSI 0 0\n"
                     "PIK RDY S2 Z1 RDY S1 Z1 -1.0\nPIK THI S3 THI S1 2 0.5\n")
    rows, error = tool.rows("surfaces", path)
    checks.check(rows and rows[1]["radius_mm"] == "-50" and rows[2]["thickness_mm"] == "12.5",
                 f"PIK: {error}")
    # OSLO: the same lens in centimetres
    oslo = ("LEN NEW \"plano\" 10 3\nEBR 0.25\nANG 0\nUNI 10\nTH 1e20\nNXT\nGLA 1.5\nRD 5\nTH 0.6\n"
            "NXT\nAIR\n{}NXT\nAIR\nWV 0.5875618\nEND 3\n")
    rows, error = tool.rows("lens", tool.file("plano.len", oslo.format("PY 0\n")))
    checks.check(rows and abs(float(rows[0]["bfl_mm"]) - 96) < 1e-12 and
                 abs(float(rows[0]["efl_mm"]) - 100) < 1e-12, f"OSLO, cm: {error}")
    path = tool.file("height.len", oslo.format("PY 0.12\n"))
    checks.check(abs(thickness(tool, path, 2) - 48) < 1e-12, "OSLO: PY 0.12 is 48 mm")
    path = tool.file("pick.len", oslo.format("PK CVM 1\nPK THM 1 1.0\n"))
    rows, error = tool.rows("surfaces", path)
    checks.check(rows and rows[1]["radius_mm"] == "-50" and rows[1]["thickness_mm"] == "4",
                 f"OSLO: PK: {error}")
    path = tool.file("model.len", oslo.format("TH 1\n").replace("GLA 1.5", "GLA MOD 1.6 50"))
    rows, error = tool.rows("surfaces", path)
    checks.check(rows and rows[0]["medium"] == "1.6/50", f"OSLO: GLA MOD: {error}")


def check_own_positions(checks, tool):
    text = HEAD + ("S 50 5 517642\nSTO\nCIR 6\nS -50 40\nS 0 3\nPIM\nSI 0 0\nZOO 3\nZOO TIT\n"
                   "TIT Z1 'far end'\nTIT Z2 'mid'\nZOO THI S2 40 30 20.5\nZOO EPD 5 4 3\n")
    path = tool.file("zoom.seq", text)
    for position, gap, pupil in (("far-end", 40, 5), ("mid", 30, 4), ("z3", 20.5, 3)):
        checks.check(thickness(tool, path, 2, "--position", position) == gap,
                     f"ZOO THI at {position}")
        rows, error = tool.rows("lens", path, "--position", position)
        checks.check(rows and float(rows[0]["entrance_pupil_diameter_mm"]) == pupil,
                     f"ZOO EPD at {position}: {error}")
    # surface by surface it is the same: THI S2 Z3
    text = text.replace("ZOO THI S2 40 30 20.5\n",
                        "ZOO THI S2\nTHI S2 Z2 30\nTHI S2 Z3 20.5\n")
    path = tool.file("zoom2.seq", text)
    checks.check(thickness(tool, path, 2, "--position", "z3") == 20.5, "THI S2 Z3")
    path = tool.file("units.seq", HEAD.replace("EPD", "DIM I\nEPD") + "S 2 0.5 517642\nSI 0 0\n")
    rows, error = tool.rows("surfaces", path)
    checks.check(rows and rows[0]["radius_mm"] == "50.8" and rows[0]["thickness_mm"] == "12.7",
                 f"inches: {error}")


def check_own_refusals(checks, tool):
    good = HEAD + "S 50 5 517642\nSTO\nS -50 40\nSI 0 0\n"
    cases = (("S 50 5 517642", "S 50 5 NOGLASS", "refused.seq:5:8:", "in no catalogue"),
             ("S 50 5 517642", "S 5x 5 517642", "refused.seq:5:4:", "not a number"),
             ("S 50 5 517642", "S 50", "refused.seq:5:5:", "thickness is missing"),
             ("STO", "STO S9", "refused.seq:6:5:", "there is no surface"),
             ("STO", "XYZ 1", "refused.seq:6:1:", "unknown command"),
             ("STO", "RDX 1", "refused.seq:6:1:", "no cylinder"),
             ("STO", "PRV\n'A' 1.5", "refused.seq:7:5:", "for 0 wavelengths"),
             ("STO", "^x == 1", "refused.seq:6:1:", "macro"),
             ("STO", "TITLE 'open", "refused.seq:6:7:", "does not end"),
             ("STO", "ZOO THI S1 3 4", "refused.seq:6:1:", "2 numbers for 0"),
             ("SI 0 0", "", "refused.seq: ", "no image surface"),
             ("SO 0 1e13\n", "", "refused.seq:4:1:", "before the object"),
             ("EPD 5", "EPD 0", "refused.seq:2:5:", "above 0"),
             ("WL 587.5618", "WL 0.5876", "refused.seq:3:4:", "1 nm to 100 mm"))
    for old, new, place, reason in cases:
        result = tool.run("lens", tool.file("refused.seq", good.replace(old, new, 1)))
        error = result.stderr.decode()
        checks.check(result.returncode == 4 and place in error and reason in error,
                     f"{new}: {result.returncode} {error}")
    good = 'LEN NEW "x" 1 3\nEBR 1\nTH 1e20\nNXT\nGLA 1.5\nRD 5\nNXT\nTH 1\nNXT\nEND 3\n'
    cases = (("GLA 1.5", "GLA 1.5 1.6", "refused.len:5:5:", "2 indices for 3"),
             ("GLA 1.5", "GLA NOGLASS", "refused.len:5:5:", "in no catalogue"),
             ("RD 5", "RD five", "refused.len:6:4:", "not a number"),
             ("RD 5", "PK CV 1", "refused.len:6:7:", "not before surface 1"),
             ("RD 5", "PFL 5", "refused.len:6:1:", "perfect lens"),
             ("RD 5", "ASP ZER 4", "refused.len:6:1:", "not a polynomial of r"),
             ("EBR 1", "UNI 7", "refused.len:2:5:", "one of 1, 10"),
             ("RD 5", "WV9 0.5", "refused.len:6:1:", "number 9 behind 0"))
    for old, new, place, reason in cases:
        result = tool.run("lens", tool.file("refused.len", good.replace(old, new, 1)))
        error = result.stderr.decode()
        checks.check(result.returncode == 4 and place in error and reason in error,
                     f"{new}: {result.returncode} {error}")


def check_modes(checks, tool):
    """Without RDM a lens of lensdb with its radii is refused, with its curvatures read."""
    names = tool.run("list", "lenses", "--columns", "lens", "--tsv").stdout.decode().split()[1:]
    kinds = {"EPD": None, "FNO": "FNO 4\n", "NA": "NA 0.125\n", "none": ""}
    counts = {kind: [0, 0] for kind in kinds}
    for name in names:
        text = tool.run("convert", name, "--to", "seq", "--lossy").stdout.decode()
        text = text.replace("RDM;LEN", "LEN")
        for kind, line in kinds.items():
            radii = text
            if line is not None:  # neither clear diameters nor fields, which tell by themselves
                radii = re.sub(r"^(ZOO )?(EPD|FNO|NAO|[XY](AN|OB|IM)) .*\n| +CIR .*\n|ZOO CIR .*\n|"
                               r"! lenscalc: the stop's .*\n", "", text, flags=re.M)
                radii = radii.replace("DIM M\n", "DIM M\n" + line)
            curved = re.sub(r"^S ([-0-9.eE+]+) ", lambda word: "S %r " % (
                1 / float(word[1]) if float(word[1]) else 0.0), radii, flags=re.M)
            curved = re.sub(r"^  RDX (\S+)", lambda word: "  CUX %r" % (1 / float(word[1])), curved,
                            flags=re.M)
            for at, content in enumerate((radii, curved)):
                result = tool.run("convert", tool.file("mode.seq", content), "--lossy")
                said = b"put a line before the surfaces: RDM if they are radii" in result.stderr
                counts[kind][at] += (result.returncode, said) == ((4, True) if at == 0 else (0, False))
    for kind, right in counts.items():
        checks.check(right == [len(names)] * 2, f"{kind}: {right} of {len(names)} are right")


def main():
    checks = Checks()
    tool = Tool(sys.argv[1])
    check_shared(checks, tool)
    check_own_seq(checks, tool)
    check_own_solves(checks, tool)
    check_own_positions(checks, tool)
    check_own_refusals(checks, tool)
    check_modes(checks, tool)
    checks.finish()


main()
