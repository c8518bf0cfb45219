"""tests/bench/pipes.py - dof as a pipe: its speed against mawk and printf, its bytes, its memory."""
# SPDX-License-Identifier: MIT

import os
import shutil
import subprocess

from common import HERE, ROWS, entry, fastest, rate, run


def pipes(bench):
    source = bench.rows(ROWS)
    commands = {"6": bench.batch("--csv", "--digits", "6"),
                "shortest": bench.batch("--csv"),
                "c6": [bench.tool("printf_dof"), "6"], "c17": [bench.tool("printf_dof"), "17"]}
    if shutil.which("mawk"):
        commands["mawk"] = ["mawk", "-F,", "-f", os.path.join(HERE, "dof.awk")]
    for name in "tsv", "jsonl", "json":
        commands[name] = bench.batch("--" + name)
    best = fastest(commands, source)
    for name, label in ("6", "6 digits"), ("shortest", "shortest"):
        yield entry(f"pipe: csv, {label}", ROWS / best[name] / 1e6, "M rows/s",
                    f"{best[name] * 1e3:.0f} ms")
    if "mawk" in best:
        yield entry("pipe: digits 6 / mawk", best["mawk"] / best["6"], "x",
                    f"mawk {rate(best['mawk'])}")
    yield entry("pipe: digits 6 / plain C %.6g", best["c6"] / best["6"], "x",
                f"C {rate(best['c6'])}")
    yield entry("pipe: shortest / plain C %.17g", best["c17"] / best["shortest"], "x",
                f"C {rate(best['c17'])}")
    for name in "tsv", "jsonl", "json":
        yield entry(f"pipe: {name}, shortest", ROWS / best[name] / 1e6, "M rows/s")


def identity(bench):
    """The same bytes as printf with as many digits."""
    source, ours, theirs = bench.rows(ROWS), bench.path("ours"), bench.path("theirs")
    for digits in "6", "12", "17":
        run(bench.batch("--csv", "--digits", digits), source, ours)
        run([bench.tool("printf_dof"), digits], source, theirs)
        with open(ours, "rb") as a, open(theirs, "rb") as b:
            different = sum(x != y for x, y in zip(a, b)) + (os.path.getsize(ours) !=
                                                             os.path.getsize(theirs))
        yield entry(f"pipe: bytes unlike printf %.{digits}g", different)


def memory(bench):
    def peak(count):
        with open(bench.rows(count), "rb") as stdin:
            words = [bench.tool("peak"), *bench.batch("--csv")]
            return int(subprocess.run(words, stdin=stdin, stdout=subprocess.DEVNULL,
                                      stderr=subprocess.PIPE, check=True).stderr)

    few, many = peak(ROWS), peak(4 * ROWS)
    yield entry("memory: 1e6 rows", few, "KiB")
    yield entry("memory: 4e6 rows / 1e6 rows", many / few, "x", f"{many} KiB")


SECTIONS = {"pipes": pipes, "identity": identity, "memory": memory}
