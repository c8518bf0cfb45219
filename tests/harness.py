"""tests/harness.py - what the test scripts share: counting checks, and running the program.

Every script takes the build folder as its first argument, is run from the repository root, names
each failure in a line that starts with "FAILED", and ends with "N passed, N failed".

LENSCALC_WRAPPER (for example "valgrind -q --error-exitcode=99") is put before the program. With
LENSCALC_ALL set, as make check-all has it, scripts try everything; what is EVERYTHING only would
take too long for every day.

With LENSCALC_VALIDATE set to a folder, as tests/run has it, each comparison with a value from
outside that names its source is a line of a file there: see tests/validation.py.
"""
# SPDX-License-Identifier: MIT

import csv
import fcntl
import io
import math
import os
import pty
import select
import shlex
import signal
import struct
import subprocess
import sys
import tempfile
import termios
from fractions import Fraction

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
SHARED = os.path.join(os.path.dirname(ROOT), "shared")
EVERYTHING = bool(os.environ.get("LENSCALC_ALL"))
VALIDATE = os.environ.get("LENSCALC_VALIDATE")
# a shell that begins this in the background has it ignore SIGINT, and so all that is started here
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)
INSTRUMENTED = 60  # times as long what sanitizers or valgrind watch may take
NEED_SOLVER = ("fit", "bench")  # commands that a build without Ceres has not


def exact(number):
    """A number without rounding: the digits of a text, the bits of a float."""
    return Fraction(number) if math.isfinite(float(number)) else float(number)


class Checks:
    """Counts checks; prints each failure once, at most `most` of them."""

    def __init__(self, most=40):
        self.passed = self.failed = 0
        self.most = most
        self.worst = {}  # of each kind the share of what is allowed that was needed, and where
        self.compared = []

    def check(self, condition, what):
        if condition:
            self.passed += 1
            return True
        self.failed += 1
        if self.failed <= self.most:
            print("FAILED", what)
        elif self.failed == self.most + 1:
            print("(more failures are not shown)")
        return False

    def near(self, kind, name, actual, expected, allowed):
        """A number of a table, as text; `worst` keeps the largest error of its kind."""
        if actual == "":
            return self.check(False, f"{name} is absent, expected {expected}")
        error = abs(float(actual) - float(expected))
        self.worst[kind] = max(self.worst.get(kind, (0, "")), (error / allowed, name))
        return self.check(error <= allowed, f"{name} is {actual}, expected {expected} "
                                            f"within {allowed:.3g}")

    def against(self, source, case, quantity, actual, expected, allowed, unit=""):
        """
        A value against one from outside, of a source of tests/truth/sources.tsv (None: it is not
        of the table), numbers or texts: their difference is taken without rounding. `allowed` has
        the unit of both.
        """
        if actual in (None, ""):
            return self.check(False, f"{case}: {quantity} is absent, expected {expected}")
        value, truth, allowed = exact(actual), exact(expected), exact(allowed)
        finite = isinstance(value, Fraction) and isinstance(truth, Fraction)
        error = abs(value - truth) if finite else 0 if value == truth else math.inf
        if VALIDATE and source is not None:
            self.compared.append((source, case, quantity, actual, expected, float(error),
                                  float(allowed), unit))
        return self.check(error <= allowed,
                          f"{case}: {quantity} is {actual}, expected {expected} within "
                          f"{float(allowed):.3g} {unit}".rstrip())

    def against_relative(self, source, case, quantity, actual, expected, allowed):
        """The same with a share of what is expected, which is not 0, for `allowed`."""
        if actual is not None and math.isfinite(actual):
            actual, expected = exact(actual) / exact(expected), 1
        return self.against(source, case, f"{quantity} (relative)", actual, expected, allowed)

    def finish(self):
        if self.compared:
            name = os.path.splitext(os.path.basename(sys.argv[0]))[0]
            with open(os.path.join(VALIDATE, name + ".tsv"), "w", encoding="utf-8") as file:
                for row in self.compared:
                    file.write("\t".join(" ".join(str(word).split()) for word in row) + "\n")
        print(f"{self.passed} passed, {self.failed} failed")
        sys.exit(self.failed != 0)


def has_terminals():
    """Does this machine give terminals to programs? Some containers do not."""
    try:
        for end in pty.openpty():
            os.close(end)
    except OSError:
        print("no terminals here: skipped")
        return False
    return True


def on_terminal(program, words, width, **variables):
    """(standard output, standard error, status) of one call on terminals of so many columns."""
    ends = [pty.openpty() for _ in range(2)]
    for _, terminal in ends:
        fcntl.ioctl(terminal, termios.TIOCSWINSZ, struct.pack("HHHH", 24, width, 0, 0))
    environment = {name: value for name, value in program.environment().items()
                   if name != "COLUMNS"}
    process = subprocess.Popen(program.command + words, stdin=subprocess.DEVNULL,
                               stdout=ends[0][1], stderr=ends[1][1],
                               env={**environment, **variables})
    for _, terminal in ends:
        os.close(terminal)
    ours = [end for end, _ in ends]
    shown, open_ends = {end: b"" for end in ours}, set(ours)
    while open_ends:
        for end in select.select(list(open_ends), [], [], 60)[0]:
            try:
                piece = os.read(end, 65536)
            except OSError:  # the other side is closed
                piece = b""
            shown[end] += piece
            if not piece:
                open_ends.remove(end)
                os.close(end)
    texts = [shown[end].replace(b"\r\n", b"\n").decode() for end in ours]
    return texts[0], texts[1], process.wait()


class Program:
    """The built program, in a folder of its own for PATH."""

    def __init__(self, build):
        self.build = os.path.abspath(build)
        self.binary = os.path.join(self.build, "lenscalc")
        if not os.access(self.binary, os.X_OK):
            sys.exit(f"FAILED no program {self.binary}\n0 passed, 1 failed")
        self.holder = tempfile.TemporaryDirectory(prefix="lenscalc-test-")
        self.path = os.path.join(self.holder.name, "bin")
        os.mkdir(self.path)
        link = os.path.join(self.path, "lenscalc")
        wrapper = os.environ.get("LENSCALC_WRAPPER", "")
        if wrapper:
            with open(link, "w") as script:
                script.write(f'#!/bin/sh\nexec {wrapper} {shlex.quote(self.binary)} "$@"\n')
            os.chmod(link, 0o755)
        else:
            os.symlink(self.binary, link)
        self.command = shlex.split(wrapper) + [self.binary]
        self.inherited = {name: value for name, value in os.environ.items() if not
                          name.startswith(("LENSCALC", "LC_", "LANG", "NO_COLOR"))}
        self.inherited["PATH"] = self.path + ":" + os.environ.get("PATH", "/usr/bin:/bin")
        with open(self.binary, "rb") as file:
            content = file.read()
        # sanitizers and valgrind take memory and time of their own
        self.is_instrumented = (bool(wrapper) or b"__asan_init" in content or
                                b"__tsan_init" in content or b"__ubsan_handle" in content)

    def environment(self):
        return {**self.inherited, "LC_ALL": "C", "TERM": "dumb", "LENSCALC_CONFIG": "",
                "UBSAN_OPTIONS": "halt_on_error=1:print_stacktrace=1"}

    def allowed(self, seconds):
        """Processor time, s, that an answer may take which takes at most so much unwatched."""
        return seconds * (INSTRUMENTED if self.is_instrumented else 1)

    def run_within(self, seconds, *words, **more):
        """
        (result, its processor time in s) of one call with Popen's arguments: however busy the
        machine is, the same. One that takes 20 times what is allowed never ends, and is ended.
        """
        limit = int(20 * self.allowed(seconds))
        more = {"stdin": subprocess.DEVNULL, "env": self.environment(), **more}
        with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
            child = subprocess.Popen(
                ["sh", "-c", f'ulimit -t {limit}; exec "$@"', "sh", *self.command, *words],
                stdout=out, stderr=err, **more)
            _, status, usage = os.wait4(child.pid, 0)
            child.returncode = os.waitstatus_to_exitcode(status)
            texts = []
            for file in (out, err):
                file.seek(0)
                texts.append(file.read())
        return (subprocess.CompletedProcess(child.args, child.returncode, *texts),
                usage.ru_utime + usage.ru_stime)

    def has_solver(self):
        """Was it built with what `fit` needs?"""
        return os.path.exists(os.path.join(self.build, "lenscalc-ceres"))

    def run(self, *words, stdin=b"", timeout=60, **more):
        """One call; the result has bytes in stdout and stderr. `timeout` is of the unwatched."""
        if isinstance(stdin, str):
            stdin = stdin.encode()
        variables = more.pop("variables", {})
        more.setdefault("stdout", subprocess.PIPE)
        more.setdefault("stderr", subprocess.PIPE)
        if "stdin_file" in more:
            more["stdin"] = more.pop("stdin_file")
        elif stdin:
            more["input"] = stdin
        else:
            more["stdin"] = subprocess.DEVNULL  # a pipe that ends at once costs a third of a run
        return subprocess.run(self.command + [str(word) for word in words],
                              timeout=self.allowed(timeout), env={**self.environment(), **variables}, **more)

    def rows(self, *words, text=None):
        """The rows of a command's table; where it fails what it says."""
        result = self.run(*words, "--csv", stdin=text or "")
        if result.returncode != 0:
            return result.stderr.decode()
        return list(csv.DictReader(io.StringIO(result.stdout.decode(), newline="")))

    def shell(self, script, folder, timeout=60):
        """An sh script in a folder, with the program in PATH."""
        return subprocess.run(["sh", "-c", script], cwd=folder, env=self.environment(),
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, timeout=self.allowed(timeout))
