#!/usr/bin/env python3
"""tests/robust/check_input.py - bad input through the binary: a message and the right status.

Never a signal, never "nan" in the output, never a silent answer, memory that does not grow with
the file. What the messages say in full is pinned in tests/cli.
"""
# SPDX-License-Identifier: MIT

import os
import random
import re
import resource
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program

GOOD_ROW = b"50,2.8,3\n"
HEADER = b"f,N,s\n"
STATUSES = (0, 1, 2, 3, 4, 5)
MEGABYTE = 1 << 20
# The peak of a child counts that of its parent until exec: a small parent starts the program.
LAUNCHER = """
import os, sys
child = os.posix_spawnp(sys.argv[1], sys.argv[1:], os.environ, file_actions=[
    (os.POSIX_SPAWN_OPEN, 1, os.devnull, os.O_WRONLY, 0)])
_, status, usage = os.wait4(child, 0)
print(os.waitstatus_to_exitcode(status), usage.ru_maxrss)
"""


class Tester:
    def __init__(self, checks, program):
        self.checks, self.program = checks, program

    def sane(self, what, result, statuses):
        """The rules that hold for every input."""
        error = result.stderr.decode("utf-8", "replace")
        self.checks.check(result.returncode in statuses,
                          f"{what}: status {result.returncode}, expected one of {statuses}: "
                          f"{error[:200]!r}")
        self.checks.check(not re.search(rb"(?m)(^|[,\t:])\s*-?nan\s*($|[,\t}])", result.stdout),
                          f"{what}: nan in the output: {result.stdout[-200:]!r}")
        if result.returncode != 0:
            self.checks.check(error.startswith("lenscalc: "), f"{what}: message {error[:100]!r}")
        self.checks.check(not re.search(r"[\x00-\x08\x0b-\x1f\x7f]", error),
                          f"{what}: control characters in the message {error[:200]!r}")
        lines = error.split("\n")
        self.checks.check(all(len(line) < 1200 for line in lines),
                          f"{what}: a message of {max(map(len, lines))} characters")
        return error

    def option(self, what, words, statuses, *says):
        result = self.program.run(*words)
        error = self.sane(what, result, statuses)
        if 0 not in statuses:
            self.checks.check(result.stdout == b"", f"{what}: output {result.stdout[:100]!r}")
        for text in says:
            self.checks.check(text in error, f"{what}: '{text}' is not in {error[:300]!r}")

    def batch(self, what, content, statuses, *says, command="dof", options=()):
        result = self.program.run(command, "--batch", "-", "--csv", *options, stdin=content)
        error = self.sane(what, result, statuses)
        for text in says:
            self.checks.check(text in error, f"{what}: '{text}' is not in {error[:300]!r}")
        return result


def check_values(tester):
    """What is no value, on the command line and in a cell of line 3."""
    bad = {"nan": "nan", "-nan": "nan", "1e999": "too large", "-1e999": "too large",
           "1e-999": "too small", "-0": "out of range", "0": "out of range", "-1": "out of range",
           "3s": "time", "3kg": "mass", "3nn": "unknown unit", "0x10": "", "x": "",
           "1e": "", "--": "", "3m3": "", "3 4": "", "1/0": "", "\u0663": "", "3\u00a0m": "",
           "infinity m": "", "1" * 400: "too large", "9" * 100000 + "x": "", "3" + "m" * 100000: ""}
    for value, says in bad.items():
        name = value if len(value) < 30 else value[:10] + "... long"
        tester.option(f"--distance={name}", ["dof", "-f", "50", "-N", "4", f"--distance={value}"],
                      (1, 2), "--distance", says)
        result = tester.batch(f"cell '{name}'", HEADER + GOOD_ROW + f"50,4,{value}\n".encode(),
                              (3,), "standard input:3:", says)
        tester.checks.check(len(result.stdout.splitlines()) == 3, f"cell '{name}': rows lost")
    tester.option("2,8 as a range end", ["dof", "-f", "50", "-N", "2..2,8x", "-s", "3"], (2,))
    tester.batch("a decimal comma", HEADER + b'50,"2,8",3\n', (1,), "standard input:2:5",
                 "2.8")
    tester.option("infinite focal length", ["dof", "-f", "inf", "-N", "4", "-s", "3"], (1,),
                  "--focal-length")
    # every number that a double holds, or a refusal: never a crash, never nan
    numbers = ["1e-320", "5e-324", "2.2e-308", "1e-300", "1e-160", "1e-9", "1", "1e9", "1e160",
               "1e300", "1.7976931348623157e308"]
    for f in numbers:
        for s in numbers + ["inf"]:
            result = tester.program.run("dof", "-f", f, "-N", "2.8", "-s", s, "--jsonl")
            tester.sane(f"-f {f} -s {s}", result, (0, 1, 2))
    for command, option in (("fov", "-f"), ("fov", "-s"), ("hyperfocal", "-N"), ("fov", "-P"),
                            ("fov", "--squeeze"), ("fov", "--horizontal")):
        for number in numbers:
            words = [command, option, number] + ([] if option in ("-f", "--horizontal")
                                                 else ["-f", "50"])
            tester.sane(" ".join(words), tester.program.run(*words, "--csv"), (0, 1, 2))


def check_ranges(tester):
    endless = ["1..10:-1", "1..10:0", "10..1:1", "1..2*1", "1..2*0.5", "2..1*2", "0..2*2",
               "-1..2*2", "1..2*inf", "1..2*0", "1..2*-1", "1..2#1", "1..2#0", "1..2#-3",
               "1..2#1.5", "1..2#inf", "1..inf", "-inf..1", "1..2:inf", "1..2:1e-300", "1..1e300",
               "1..2*1.0000000001", "1..1e308*1.0000001", "1..2#1e9", "1..2#1e300", "..", "1..",
               "..2", "1..2..3", "1..2:", "1..2*", "1..2#", "1..2/", "1..2/third", "1..2:1:1",
               "1..2,", ",1..2", "1,,2", ",", "1..nan", "nan..1", "1..2:nan", "1..2*nan"]
    for text in endless:
        tester.option(f"-s {text}", ["dof", "-f", "50", "-N", "4", f"--distance={text}"], (1, 2),
                      "--distance")
    # a product over a million wants --force, and says so at once
    for words in (["-s", "1..1000001"], ["-s", "1..1001", "-f", "1..1001"],
                  ["-s", "1..1e6", "-f", "1..1e6", "-N", "1..1e6:1"]):
        more = [] if "-N" in words else ["-N", "4"]
        more += [] if "-f" in words else ["-f", "50"]
        tester.option(" ".join(words), ["dof", *words, *more], (2,), "million")


def check_files(tester):
    """Whole files that are not what they should be."""
    noise = random.Random(7)
    binary = bytes(noise.randrange(256) for _ in range(100000))
    cases = [
        ("empty", b"", (4,), "standard input"),
        ("blank lines", b"\n\n\r\n  \n", (4,), "standard input"),
        ("comments only", b"# a\n# b\n", (4,), "standard input"),
        ("header only", HEADER, (0,)),
        ("header without end", b"f,N,s", (0,)),
        ("binary", binary, (1, 3, 4), "standard input:"),
        ("binary rows", HEADER + binary, (1, 3, 4), "standard input:"),
        ("NUL bytes", b"\0" * 1000, (4,), "standard input:1"),
        ("NUL in the header", b"f\0,N,s\n50,4,3\n", (4,), "standard input:1"),
        ("NUL in a cell", HEADER + b"5\x000,4,3\n", (1,), "standard input:2:"),
        ("UTF-16", (HEADER + GOOD_ROW).decode().encode("utf-16"), (4,), "standard input:1"),
        ("UTF-16 BE", (HEADER + GOOD_ROW).decode().encode("utf-16-be"), (4,), "standard input:1"),
        ("a column too few", HEADER + b"50,4\n", (1,), "standard input:2:"),
        ("a column too many", HEADER + b"50,4,3,2\n", (1,), "standard input:2:"),
        ("missing columns", b"f,N\n50,4\n", (1,), "standard input:2:", "--distance"),
        ("no column", b"a,b\n1,2\n", (4,), "standard input:1:"),
        ("empty name", b"f,N,s,\n50,4,3,x\n", (0, 4)),
        ("a name twice", b"f,N,s,f\n1,2,3,4\n", (4,), "standard input:1:7"),
        ("an option twice", b"f,N,s,focal_mm\n1,2,3,4\n", (4,), "standard input:1:7"),
        ("unknown twice", b"f,N,s,x,x\n1,2,3,4,5\n", (4,), "standard input:1:9"),
        ("wrong dimension", b"f_s,N,s\n50,4,3\n", (4,), "standard input:1:1", "f_s"),
        ("unknown unit", b"f_zz,N,s\n50,4,3\n", (4,), "standard input:1:1"),
        ("open quote", HEADER + b'50,4,"3\n' + GOOD_ROW * 10, (1, 3), "standard input:2:6"),
        ("text behind a quote", HEADER + b'50,4,"3"x\n', (1,), "standard input:2:6"),
        ("open quote in the header", b'f,N,"s\n50,4,3\n', (4,), "standard input:1:5"),
        ("JSON, not closed", b'{"f":50,"N":4,"s":3\n', (1, 4), "standard input:1"),
        ("JSON, nested", b'{"f":50,"N":4,"s":{"a":1}}\n', (1, 4), "standard input:1"),
        ("JSON array", b'{"f":50,"N":4,"s":3}\n[1]\n', (3,), "standard input:2"),
        ("JSON, bad escape", b'{"f":50,"N":4,"s":"\\q"}\n', (1, 4), "standard input:1"),
        ("JSON, half a surrogate", b'{"f":50,"N":4,"s":3,"t":"\\ud800"}\n', (0, 1, 4)),
        ("JSON, key twice", b'{"f":50,"N":4,"s":3,"f":40}\n', (1, 4), "standard input:1"),
        ("JSON, NaN", b'{"f":50,"N":4,"s":NaN}\n', (1, 4), "standard input:1"),
        ("JSON, deep", b'{"f":' + b"[" * 100000 + b"\n", (1, 4), "standard input:1"),
        ("JSON, bare", b"{", (1, 4), "standard input:1"),
        ("JSON, text behind", b'{"f":50,"N":4,"s":3} x\n', (1, 4), "standard input:1"),
    ]
    for what, content, statuses, *says in cases:
        tester.batch(what, content, statuses, *says)
    # what is allowed
    plain = tester.batch("plain", HEADER + GOOD_ROW, (0,)).stdout
    for what, content in (("CRLF", b"f,N,s\r\n50,2.8,3\r\n"), ("BOM", b"\xef\xbb\xbf" + HEADER +
                          GOOD_ROW), ("no end", HEADER + GOOD_ROW[:-1]),
                          ("comments", b"# x\n" + HEADER + b"\n# y\n" + GOOD_ROW + b"\n\n"),
                          ("quotes", b'"f","N","s"\n"50","2.8","3"\n')):
        result = tester.batch(what, content, (0,))
        tester.checks.check(result.stdout == plain, f"{what}: {result.stdout[-200:]!r}")
    # a bad row keeps its place and its own cells: never those of the row above
    result = tester.batch("place", b"f,N,s,id\n50,2.8,3,one\nbad,2.8,3,two\n50,2.8\n50,2.8,3,four\n",
                          (3,), "standard input:3:1", "standard input:4:",
                          options=("--columns", "near_m"))
    lines = [line.split(b",")[0] for line in result.stdout.splitlines()]
    tester.checks.check(lines in ([b"id", b"one", b"two", b"", b"four"],
                                  [b"id", b"one", b"", b"", b"four"]),
                        f"place: the ids of the rows are {lines}")


def check_huge(tester):
    """Long fields, lines and headers."""
    for what, content, statuses in (
            ("a field of 1e6 digits", HEADER + b"50,4," + b"1" * 10**6 + b"\n", (1,)),
            ("0.00...1", HEADER + b"50,4,0." + b"0" * 10**6 + b"1\n", (1,)),
            ("3.000...", HEADER + b"50,4,3." + b"0" * 10**6 + b"\n", (0,)),
            ("a field of 1e6 letters", HEADER + b"50,4," + b"x" * 10**6 + b"\n", (1,)),
            ("a note of 1e6 letters", b"f,N,s,note\n50,4,3," + b"x" * 10**6 + b"\n", (0,)),
            ("a quoted note of 1e6 quotes", b'f,N,s,note\n50,4,3,"' + b'""' * 10**6 + b'"\n', (0,)),
            ("a name of 1e6 letters", b"f,N,s," + b"y" * 10**6 + b"\n50,4,3,1\n", (0, 4)),
            ("1000 columns", b"f,N,s," + b",".join(b"c%d" % i for i in range(1000)) + b"\n50,4,3" +
             b",1" * 1000 + b"\n", (0, 4)),
            ("1e6 commas", HEADER + b"," * 10**6 + b"\n", (1,)),
            # a bad row that moves the buffer, behind a row whose note lay there
            ("a bad row behind a note", b"f,N,s,note\n50,2.8,3,hello\nbad,2.8," + b"7" * 400000 +
             b",x\n", (3,)),
            ("a line of 32 MB", HEADER + b"z" * (32 * MEGABYTE) + b"\n", (1,))):
        result = tester.batch(what, content, statuses)
        if what.startswith("a bad row"):
            last = result.stdout.splitlines()[-1]
            tester.checks.check(b"hello" not in last, f"{what}: the note of another row: {last}")
        if b"note" in content and statuses == (0,):
            tester.checks.check(len(result.stdout) > 10**6, f"{what}: the note is cut")


MOST_SURFACES = 10000


def many_surfaces(count):
    """A pile of plates as each reader has it: (name of the file, content)."""
    plates = [(100 + i % 7, i % 2 == 0) for i in range(count)]
    yield "many.lens", "lens Many\n" + "".join(
        f"surface {r} 1 {'1.5' if is_glass else 'air'} 20\n" for r, is_glass in plates)
    yield "many.dat", "# Many\n" + "".join(f"{r} 1 {'1.5' if is_glass else '1'} 20\n"
                                           for r, is_glass in plates)
    yield "many.seq", "RDM\nLEN\nSO 0 1e20\n" + "".join(
        f"S {r} 1 {'1.5' if is_glass else ''}\n" for r, is_glass in plates) + "SI 0 0\n"
    yield "many.len", 'LEN NEW "Many" 100 %d\n' % count + "UNI 1\nAIR\nTH 1e20\nNXT\n" + "".join(
        f"RD {r}\nTH 1\n{'GLA BK7' if is_glass else 'AIR'}\nNXT\n" for r, is_glass in plates) + "END\n"
    yield "many.zmx", "MODE SEQ\nUNIT MM\nSURF 0\n  DISZ INFINITY\n" + "".join(
        f"SURF {i + 1}\n  CURV {1 / r}\n  DISZ 1\n"
        + ("  GLAS ___BLANK 1 0 1.5 0\n" if is_glass else "")
        for i, (r, is_glass) in enumerate(plates)) + f"SURF {count + 1}\n"


def check_surfaces(tester):
    """One limit for all readers; what is below it is read at once."""
    with tempfile.TemporaryDirectory() as folder:
        for count in (2000, MOST_SURFACES + 2):
            for name, content in many_surfaces(count):
                path = os.path.join(folder, name)
                with open(path, "w") as file:
                    file.write(content)
                result = tester.program.run("lens", path, "--csv")
                what = f"{name} of {count} surfaces"
                error = tester.sane(what, result, (4,) if count > MOST_SURFACES else (0,))
                tester.checks.check(count < MOST_SURFACES or
                                    f"more than {MOST_SURFACES} surfaces" in error,
                                    f"{what}: {error[:200]!r}")


def frugal(tester, what, words):
    """An answer, with at most 16 MiB of memory."""
    program = tester.program
    result = subprocess.run([sys.executable, "-ISc", LAUNCHER, *words], stdout=subprocess.PIPE,
                            env=program.environment())
    status, kibibytes = map(int, result.stdout.split())
    tester.checks.check(status == 0, f"{what}: status {status}")
    if not program.is_instrumented:
        tester.checks.check(kibibytes <= 16 * 1024, f"{what}: {kibibytes} KiB of memory")


def check_lenses(tester):
    """As many lenses as a command line holds: one name again and again, and files."""
    command = tester.program.command
    for form in ("--csv", "--json"):
        # the shell writes the words: a launcher that held them would count as well
        frugal(tester, f"20000 lenses of one name {form}",
               ["sh", "-c", 'exec "$@" $(yes double-gauss 2> /dev/null | head -n 20000) ' + form, "sh",
                *command, "lens"])
    with tempfile.TemporaryDirectory() as folder:
        paths = [os.path.join(folder, f"{i}.lens") for i in range(1000)]
        for radius, path in enumerate(paths, 50):
            with open(path, "w") as file:
                file.write(f"lens Plano\nsurface {radius} 2 1.5 10\nsurface - 90 air 10\n")
        for command in ("lens", "surfaces"):
            frugal(tester, f"{len(paths)} files {command}",
                   tester.program.command + [command] + paths + ["--csv"])


def check_memory(tester):
    """300,000 rows in at most 16 MiB, rows streamed: the first answer before the last question."""
    program = tester.program
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "rows.csv")
        rows = 20000 if program.is_instrumented else 300000
        with open(path, "wb") as file:
            file.write(b"f_mm,N,s_m,c_mm,note\n")
            block = b"".join(b"%d,2.8,%d.5,0.03,%s\n" % (20 + i % 80, 1 + i % 50,
                                                         b"bad" if i % 10 else b'"x,y"')
                             for i in range(1000))
            for _ in range(rows // 1000):
                file.write(block)
        for options in (["--csv", "--columns", "hyperfocal_m,near_m,far_m", "--digits", "6"],
                        ["--csv"], ["--jsonl", "--columns", "near_m"]):
            words = program.command + ["dof", "--batch", path, *options]
            frugal(tester, f"{rows} rows {options}", words)
    with subprocess.Popen(program.command + ["dof", "--batch", "-", "--csv", "--columns", "near_m"],
                          stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                          env=program.environment()) as process:
        process.stdin.write(HEADER + GOOD_ROW)
        process.stdin.flush()
        first = process.stdout.readline(), process.stdout.readline()
        tester.checks.check(first[1].startswith(b"2.73897"), f"an answer at once: {first}")
        process.stdin.close()


def check_words(tester):
    """Command lines of every kind."""
    for words, says in ((["dof", "--focal-length=" + "5" * 100000 + "x"], "--focal-length"),
                        (["x" * 100000], "unknown command"), (["dof", "--" + "x" * 100000], ""),
                        (["dof", "-" + "\x01"], "unknown option"), ([""], "unknown command"),
                        (["dof", "--sensor", "y" * 100000, "-f", "50", "-N", "4", "-s", "3"], ""),
                        (["dof", "--columns", "," * 1000, "-f", "50", "-N", "4", "-s", "3"], ""),
                        (["dof", "--batch", ""], ""), (["dof", "--batch", "/"], ""),
                        (["dof", "--batch", "/nonexistent/x"], "/nonexistent/x"),
                        (["dof", "--lensdb", "/nonexistent/x", "-f", "50", "-N", "4", "-s", "3"],
                         "/nonexistent/x")):
        tester.option(" ".join(words)[:40], words, (1, 2, 5), says)
    for text in (b"\xff\xfe", b"\xc3", b"\x80" * 50, b"35mm\xff", b"\x1b[31m"):
        name = os.fsdecode(text)
        for words in (["dof", "-f", name, "-N", "4", "-s", "3"], ["dof", "--sensor", name],
                      [name], ["dof", "--" + name], ["list", "formats", name], ["dof", name]):
            result = tester.program.run(*words)
            tester.sane(f"{words!r}", result, (1, 2))


def check_endless(tester):
    """What is no picture and no part is not read to its end, which it may not have."""
    for words in (["merge", "/dev/zero"], ["tone", "/dev/zero", "-o", "lost.png"],
                  ["render", "/dev/zero", "-s", "1", "-N", "8", "--lens", "double-gauss",
                   "-o", "lost.png"]):
        tester.option(" ".join(words), words, (4,), "/dev/zero")
    for words in (["lens", "/dev/zero"], ["dof", "--batch", "/dev/zero", "-N", "8"],
                  ["fit", "--glass", "/dev/zero"]):
        tester.option(" ".join(words), words, (4, 5), "/dev/zero")


def check_lensdb(tester):
    """The user's tables are parsed with the same care."""
    noise = random.Random(8)
    good = ("name\taliases\twidth_mm\theight_mm\tclass\tconfidence\tsource\n"
            "mine\t-\t30\t20\town\tsourced\tme\n").encode()
    line = good.split(b"\n")[1]
    cases = [("good", good, (0,)), ("CRLF", good.replace(b"\n", b"\r\n"), (0,)),
             ("BOM", b"\xef\xbb\xbf" + good, (0,)), ("no end", good[:-1], (0,)),
             ("empty", b"", (4,)), ("NUL", good.replace(b"mine", b"mi\0e"), (2, 4)),
             ("UTF-16", good.decode().encode("utf-16"), (4,)),
             ("binary", bytes(noise.randrange(256) for _ in range(50000)), (4,)),
             ("a column less", good.replace(b"\tclass", b""), (4,)),
             ("a cell less", good.replace(b"\town", b""), (4,)),
             ("a column twice", good.replace(b"class", b"name"), (4,)),
             ("nan", good.replace(b"\t30", b"\tnan"), (4,)),
             ("negative", good.replace(b"\t30", b"\t-30"), (4,)),
             ("zero", good.replace(b"\t30", b"\t0"), (4,)),
             ("huge", good.replace(b"\t30", b"\t1e999"), (4,)),
             ("a unit", good.replace(b"\t30", b"\t30mm"), (4,)),
             ("comma", good.replace(b"\t30", b"\t3,0"), (4,)),
             ("a field of 1e6", good.replace(b"me\n", b"m" * 10**6 + b"\n"), (0,)),
             ("100 columns", good.replace(b"\n", b"\tx" * 100 + b"\n"), (4,)),
             ("100000 rows", good + b"".join(b"f%d" % i + line[4:] + b"\n" for i in range(10**5)),
              (0,))]
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "formats.tsv")
        for what, content, statuses in cases:
            with open(path, "wb") as file:
                file.write(content)
            result = tester.program.run("dof", "-f", "50", "-N", "4", "-s", "3", "--sensor", "mine",
                                        "--lensdb", folder, "--csv")
            error = tester.sane(f"formats.tsv: {what}", result, statuses)
            if statuses == (4,):
                tester.checks.check("formats.tsv:" in error, f"formats.tsv: {what}: {error[:200]!r}")
        os.remove(path)
        os.mkdir(path)
        result = tester.program.run("list", "formats", "--lensdb", folder)
        tester.sane("formats.tsv is a folder", result, (5,))


def main():
    # a runaway parser fails here instead of filling the machine
    checks, program = Checks(), Program(sys.argv[1])
    if not program.is_instrumented:
        resource.setrlimit(resource.RLIMIT_AS, (2048 * MEGABYTE, 2048 * MEGABYTE))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    tester = Tester(checks, program)
    for check in (check_values, check_ranges, check_files, check_huge, check_surfaces,
                  check_lenses, check_memory, check_words, check_endless,
                  check_lensdb):
        check(tester)
    checks.finish()


main()
