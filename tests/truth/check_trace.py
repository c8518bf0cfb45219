#!/usr/bin/env python3
"""tests/truth/check_trace.py - lenscalc trace against rays from outside: check_trace.py BUILD_DIR

GOLDEN: twelve rays of the double Gauss on which three programs agree to 2e-13 (50 digits, optiland,
ray-optics). rays_*.txt: see tests/unit/test_trace_truth.c; every figure within 64 x 2^-53 x
(sensitivity + |value|). All rays go through the program as a batch; some one by one, and then every
character must be the same. Best focus: exact, for a ball of rays from a parabola. Lenses of lensdb:
every ray of their fields arrives, or is lost at a surface that is named.
"""
# SPDX-License-Identifier: MIT

import csv
import glob
import io
import math
import os
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import ROOT, Checks, Program

UNIT = 64 * 2.0 ** -53
OUT = ("x_out_mm", "y_out_mm", "z_out_mm", "cos_x_out", "cos_y_out", "cos_z_out", "path_mm")
HEADER = "x_mm,y_mm,z_mm,cos_x,cos_y,cos_z\n"
BFL = 72.211810477084275

C14, S14 = "0.9702957262759965", "0.24192189559966773"
# start x y (z = -20), cosines; x y at z = BFL, cosines, path
GOLDEN = """
0 10 0 0 1 = 0 -0.008851321568479689 0 -0.09936398260428688 0.99505115394185387 185.32490048102315
0 24 0 0 1 = 0 0.062622841302978188 0 -0.23768779565425643 0.97134160406986606 185.30842069978478
12 -16 0 0 1 = -0.0038935276610465496 0.0051913702147287327 -0.11916249035750817 0.15888332047667756 0.98007978826527289 185.32376052256921
0 -14.93 0 S14 C14 = 0 24.995375441028831 0 0.22016049339205467 0.97546366264939211 189.9818371182435
0 2 0 S14 C14 = 0 25.111476462530048 0 0.065449403439609204 0.99785588918911496 185.89601738264444
0 -29 0 S14 C14 = 0 24.901236591141657 0 0.34923766693382726 0.93703417866938938 193.35498065740999
15 -14.93 0 S14 C14 = 0.0020201280364521813 24.987600727140888 -0.14520736350867701 0.22019000348526883 0.96458860865553261 189.97833780099583
-10 -24 0 S14 C14 = -0.010712956741428974 24.952444755105395 0.096822888881627679 0.30348019007501001 0.94790564004053261 192.16220978572212
0 -21.8 0 0.3420201433256687 0.9396926207859084 = 0 36.261878248012608 0 0.30144185903263733 0.95348455971921622 194.94671641458279
-8 -14 0.1 0.2 0.9746794344808964 = 10.295706846556805 20.587449896116218 0.10900867116661903 0.19854980200496127 0.97400979755558855 189.81276067501237
0 0 0 0.3 0.9539392014169457 = 0 31.693325184150715 0 0.10419559488651324 0.99455682492567795 186.99849471962864
3 -4 -0.2 0.25 0.9473647660748199 = -21.123134248542084 26.402724888023997 -0.094068290370184834 0.11994712344857724 0.98831363661706215 188.82074275831309
""".replace("S14", S14).replace("C14", C14).strip().splitlines()


class Trace:
    def __init__(self, checks, program):
        self.checks, self.program = checks, program
        self.folder = tempfile.TemporaryDirectory(prefix="lenscalc-trace-")

    def rows(self, *words, stdin="", statuses=(0,)):
        result = self.program.run("trace", *words, "--csv", stdin=stdin)
        if not self.checks.check(result.returncode in statuses,
                                 f"trace {' '.join(map(str, words))}: {result.stderr.decode()}"):
            return []
        return list(csv.DictReader(io.StringIO(result.stdout.decode())))

    def batch(self, lens, starts, *words):
        text = HEADER + "".join(",".join(start) + "\n" for start in starts)
        rows = self.rows(lens, "--batch", "-", *words, stdin=text)
        self.checks.check(len(rows) == len(starts), f"{lens}: {len(rows)} rows of {len(starts)}")
        return rows if len(rows) == len(starts) else []

    def single(self, lens, start, *words):
        rows = self.rows(lens, "--point", ":".join(start[:3]), "--direction", ":".join(start[3:]),
                         *words)
        return rows[0] if rows else {}

    def lens_file(self, text):
        path = os.path.join(self.folder.name, "case.lens")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path


def unit_of(column):
    return "mm" if column.endswith("_mm") else ""


def check_golden(trace):
    words = ("--no-clip", "--focus", "paraxial")
    starts, expected = [], []
    for line in GOLDEN:
        start, end = (half.split() for half in line.split("="))
        starts.append(start[:2] + ["-20"] + start[2:])
        expected.append([float(end[0]), float(end[1]), BFL] + [float(x) for x in end[2:]])
    rows = trace.batch("double-gauss", starts, *words)
    trace.checks.check(len(rows) == 12, "the twelve rays")
    for start, truth, row in zip(starts, expected, rows):
        one = trace.single("double-gauss", start, *words)
        for name, value in zip(OUT, truth):
            trace.checks.against("three-programs", f"a ray from {':'.join(start[:3])} mm", name,
                                 row[name], value, 2e-13, unit_of(name))
            trace.checks.check(one.get(name) == row[name],
                               f"golden {start}: {name}: alone {one.get(name)}, batch {row[name]}")
    table = trace.single("double-gauss", ["12", "-16", "-20", "0", "0", "1"], "--focus", "table")
    for name, value in (("x_out_mm", -0.00586192237), ("y_out_mm", 0.00781589649)):
        trace.checks.check(abs(float(table[name]) - value) < 1e-11, f"table focus: {name}")
    # the edge of the paraxial image plane by number, from the last vertex
    number = trace.single("double-gauss", starts[0], "--no-clip", "--focus", repr(BFL))
    trace.checks.check(abs(float(number["y_out_mm"]) - expected[0][1]) <= 2e-13, "focus by number")


def cases():
    for path in sorted(glob.glob("tests/truth/rays_*.txt")):
        case = None
        with open(path, encoding="utf-8") as file:
            for line in file:
                if line.startswith("case "):
                    if case is not None:
                        yield case
                    case = {"name": line[5:].strip(), "lens": [], "rays": [], "image": None,
                            "length": 10.0}
                    inside = True
                elif case is None:
                    continue
                elif inside and line.strip() == "end":
                    inside = False
                elif inside:
                    case["lens"].append(line)
                elif line.startswith("image "):
                    case["image"] = line.split()[1]
                else:
                    case["rays"].append(line.split())
        yield case


def start_of(words):
    """Point and cosines of a line, as texts."""
    if words[0] == "ray":
        return words[1:7]
    x, y, u, v = map(float, words[1:5])
    length = math.sqrt(1 + u * u + v * v)
    return [repr(x), repr(y), "0", repr(u / length), repr(v / length), repr(1 / length)]


def in_short(words):
    """What names a ray: its start."""
    end = 7 if words[0] == "ray" else 5
    return " ".join([words[0], *(f"{float(word):g}" for word in words[1:end])])


def length_of(case):
    """As the unit test takes it: thicknesses, and 10 mm."""
    total = 10.0
    for line in case["lens"]:
        words = line.split()
        if words[0] in ("surface", "stop", "mirror") and len(words) > 2 and words[2] != "-":
            total += abs(float(words[2]))
    return total


def check_figures(trace, name, row, expected, scales):
    for column, value, scale in zip(OUT, expected, scales):
        trace.checks.against("rays", name, column, row[column], value, UNIT * (scale + abs(value)),
                             unit_of(column))


def check_case(trace, case):
    lens = trace.lens_file("".join(case["lens"]))
    starts = [start_of(words) for words in case["rays"]]
    if not starts:
        return 0
    rows = trace.batch(lens, starts, "--to", "last", "--no-clip")
    clipped = trace.batch(lens, starts, "--to", "last")
    length = length_of(case)
    for words, row, clip in zip(case["rays"], rows, clipped):
        name = f"{case['name']}: {in_short(words)}"
        if words[0] == "lost":
            status = "miss" if words[5] == "miss" else "total_reflection"
            trace.checks.check((row["status"], row["surface"]) == (status, words[6]),
                               f"{name}: {row['status']} at {row['surface']}, expected {words[5:]}")
            trace.checks.check(all(row[column] == "" for column in OUT), f"{name}: numbers")
            continue
        equals = words.index("=")
        expected = [float(x) for x in words[equals + 1:equals + 8]]
        if words[0] == "slope":
            scales = [float(x) for x in words[words.index("+-") + 1:][:7]]
        else:
            scales = [length] * 3 + [1] * 3 + [length]
            lost = words[-1]
            trace.checks.check((clip["status"], clip["surface"]) ==
                               (("ok", "") if lost == "0" else ("clipped", lost)),
                               f"{name}: {clip['status']} at {clip['surface']}, expected {lost}")
        check_figures(trace, name, row, expected, scales)
    if case["image"] is not None and math.isfinite(float(case["image"])):
        check_image(trace, lens, case, starts, length)
    for start, row in list(zip(starts, rows))[:2]:
        one = trace.single(lens, start, "--to", "last", "--no-clip")
        trace.checks.check(all(one.get(column) == row[column] for column in OUT),
                           f"{case['name']}: {start} alone differs")
    return len(starts)


def check_image(trace, lens, case, starts, length):
    rows = trace.batch(lens, starts, "--focus", case["image"], "--no-clip")
    scale = length + abs(float(case["image"]))
    for words, row in zip(case["rays"], rows):
        if words[0] != "ray" or words[-3] == "nan":
            continue
        for column, text in zip(OUT, words[-3:-1]):
            value = float(text)
            trace.checks.against("rays", f"{case['name']}: image of {in_short(words)}", column,
                                 row[column], text, UNIT * (scale + abs(value)), "mm")


# Their sources state a central obstruction, which the chief ray meets.
OBSTRUCTED = {"mirror-tele-us5331467", "questar-35"}
LOSSES = {"miss", "total_reflection", "clipped", "not_converged"}


def check_lensdb(trace):
    seen = 0
    for path in sorted(glob.glob("lensdb/lenses/*.lens")):
        name = os.path.basename(path)[:-5]
        rows = trace.rows(name, "--position", "all")
        trace.checks.check(len(rows) >= 4, f"{name}: {len(rows)} rays")
        seen += len(rows)
        for row in rows:
            field = row["field_deg"] or row["height_mm"]
            what = f"{name} {row['position']} field {field} {row['ray']}: {row['status']} " \
                   f"at {row['surface']}"
            blocked = name in OBSTRUCTED and row["ray"] == "chief"
            wanted = "clipped" if blocked else "ok"
            trace.checks.check(row["status"] == wanted, what)
            trace.checks.check((row["status"] == "ok") == (row["surface"] == ""), what)
            trace.checks.check((row["status"] == "ok") == (row["y_out_mm"] != ""), what)
            trace.checks.check(row["status"] == "ok" or row["status"] in LOSSES, what)
    trace.checks.check(seen > 500, f"only {seen} rays of lensdb")


# indices before and behind the surfaces of double-gauss at d
INDICES = (1, 1.67, 1, 1.67, 1.699, 1, 1, 1.603, 1.658, 1, 1.717, 1)


def check_surfaces(trace):
    """--all: Snell's law at every surface, and the last row is the ray; --paraxial: the limit."""
    start = ["3", "-4", "-20", "-0.2", "0.25", "0.9473647660748199"]
    words = ("double-gauss", "--point", ":".join(start[:3]), "--direction", ":".join(start[3:]),
             "--no-clip")
    rows = trace.rows(*words, "--all")
    last = trace.rows(*words)[0]
    trace.checks.check([row["surface"] for row in rows] == [str(i) for i in range(1, 13)], "--all")
    for i, row in enumerate(rows[:11]):
        sines = [math.sin(math.radians(float(row[angle]))) * INDICES[i + side]
                 for side, angle in enumerate(("incidence_deg", "refraction_deg"))]
        trace.checks.check(abs(sines[0] - sines[1]) < 4e-15,
                           f"surface {i + 1}: n sin I {sines[0]!r}, n' sin I' {sines[1]!r}")
        only = trace.rows(*words, "--to", str(i + 1))[0]
        trace.checks.check(all(only[name] == row[name] for name in OUT), f"--to {i + 1}")
    trace.checks.check(all(rows[-1][name] == last[name] for name in OUT), "--all ends with the ray")
    # exact minus paraxial is of third order
    errors = []
    for size in (1e-1, 1e-2):
        row = trace.rows("double-gauss", "--point", f"{2 * size}:{size}:-20", "--direction",
                         f"{0.01 * size}:{-0.02 * size}:1", "--paraxial")[0]
        errors.append([abs(float(row[a]) - float(row[b])) for a, b in (
            ("x_out_mm", "paraxial_x_mm"), ("y_out_mm", "paraxial_y_mm"))])
    for big, small in zip(*errors):
        trace.checks.check(0 < big < 1e-6 and small < 2e-3 * big + 1e-14,
                           f"exact minus paraxial: {big:g}, at a tenth {small:g}")
    # what 80-bit numbers say of the rays
    check = trace.rows(*words, "--verify")[0]
    for name, limit in (("point_error_mm", 1e-12), ("cosine_error", 1e-14),
                        ("path_error_mm", 1e-12)):
        trace.checks.check(float(check[name]) <= limit, f"--verify: {name} {check[name]}")


def check_focus(trace):
    """
    Best focus. Parallel rays on a sphere of radius R = -2 f: a ray at height h crosses the axis at
    R (1 - 1/(2 cos I)), sin I = h/R, under the angle 2 I: the least squares are a sum in closed
    form at the points of the Gauss rule; here with a fine trapezoid in r^2.
    """
    radius, half, steps = 100.0, 20.0, 20000
    up = down = 0.0
    for i in range(steps):
        h = half * math.sqrt((i + 0.5) / steps)
        turn = math.asin(h / radius)
        slope = -math.tan(2 * turn)
        cross = -radius * (1 - 1 / (2 * math.cos(turn)))
        up += slope * slope * cross
        down += slope * slope
    expected = up / down
    lens = trace.lens_file("lens a mirror\nobject inf\naperture stop\n"
                           "surface -100 - mirror 40 stop\n")
    rows = trace.rows(lens, "--focus", "best", "--columns", "image_mm,status")
    trace.checks.check(rows and abs(float(rows[0]["image_mm"]) - expected) < 1e-7,
                       f"best focus of a mirror {rows[:1]}, expected {expected!r}")


def main():
    os.chdir(ROOT)
    checks = Checks()
    trace = Trace(checks, Program(sys.argv[1]))
    check_golden(trace)
    traced = sum(check_case(trace, case) for case in cases())
    checks.check(traced > 1800, f"only {traced} rays in the files")
    check_focus(trace)
    check_surfaces(trace)
    check_lensdb(trace)
    checks.finish()


main()
