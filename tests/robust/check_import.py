#!/usr/bin/env python3
"""tests/robust/check_import.py - bad files of other programs.

For each kind of file 1 MiB of random bytes, of random words of its own, of itself over and over, and
itself cut off or with bytes changed: an answer or a message and a status, in a short time.
"""
# SPDX-License-Identifier: MIT

import os
import random
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import ROOT, Checks, Program

SIZE = 1 << 20
DAT = b"# two lenses\n29.475 3.76 1.67 25.2\n84.83 0.12 1 25.2\n0 4.5 0 17.1\n-14.5 1.18 1.6 17\n40 0 1 20\n"
LENSES = ("double-gauss", "aspheric-singlet", "nikkor-z-14-24")


def seeds(program):
    """kind -> real files of that kind, which the program writes."""
    files = {"dat": [DAT]}
    for kind in ("zmx", "seq", "len", "dat", "json", "lens"):
        texts = [program.run("convert", lens, "--to", kind, "--lossy").stdout for lens in LENSES]
        files[kind] = [text for text in texts if text] + files.get(kind, [])
        assert files[kind], f"no lens is written as .{kind}"
    with open(os.path.join(ROOT, "tests/truth/formulas.agf"), "rb") as file:
        files["agf"] = [file.read()]
    return files


def spoilt(chance, texts):
    """Bad contents made of good ones, with a name each."""
    words = b" ".join(texts).split()
    yield "empty", b""
    yield "random", chance.randbytes(SIZE)
    yield "utf16", b"\xff\xfe" + chance.randbytes(SIZE)
    yield "zeros", bytes(SIZE)
    yield "one line", b"1 " * (SIZE // 2)
    yield "over and over", (texts[0] * (SIZE // len(texts[0]) + 1))[:SIZE]
    mixed = b"".join(chance.choice(words) + chance.choice((b" ", b" ", b"\n")) for _ in range(150000))
    yield "words", mixed[:SIZE]
    for text in texts:
        for i in range(8):
            yield f"cut {i}", text[:chance.randrange(len(text))]
            changed = bytearray(text)
            for _ in range(1 + i):
                changed[chance.randrange(len(changed))] = chance.choice(b"\0\n -1.e9\xff\"A;&")
            yield f"changed {i}", bytes(changed)
        lines = text.splitlines(True)
        chance.shuffle(lines)
        yield "shuffled", b"".join(lines)
        yield "as utf16", text.decode("latin-1").encode("utf-16-le")


def main():
    checks, program = Checks(), Program(sys.argv[1])
    chance = random.Random(4)
    read = ["convert", "--lossy", "--to", "lens"]
    for kind, texts in seeds(program).items():
        path = os.path.join(program.holder.name, f"bad.{kind}")
        for what, content in spoilt(chance, texts):
            with open(path, "wb") as file:
                file.write(content)
            words = (["list", "glasses", "--agf", path, "--kind", "bad"] if kind == "agf" else
                     read + [path])
            try:
                result = program.run(*words, timeout=10)
            except Exception as trouble:  # too slow
                checks.check(False, f"{kind}, {what}: {str(trouble)[:200]}")
                continue
            checks.check(result.returncode in (0, 1, 2, 4) and
                         (result.returncode == 0 or result.stderr.startswith(b"lenscalc: ")),
                         f"{kind}, {what}: status {result.returncode}, {result.stderr[:200]}")
    checks.finish()


if __name__ == "__main__":
    main()
