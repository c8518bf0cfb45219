#!/usr/bin/env python3
"""tests/robust/check_output.py - writing that fails: never silent, never half a file.

Closed standard output, a full disk, a pipe whose reader leaves, -o, --plot and --scale into
missing, unwritable and full places. Exit status 5, a message that names the place, no file and no
temporary file left behind, and the file that was there before still whole.
"""
# SPDX-License-Identifier: MIT

import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program

DOF = ["dof", "-f", "50", "-N", "4", "-s", "3"]
SWEEP = ["dof", "-f", "50", "-N", "4", "-s", "1..100:0.001", "--csv"]
ANSWERS = (DOF, DOF + ["--csv"], DOF + ["--tsv"], DOF + ["--json"], DOF + ["--jsonl"],
           DOF + ["--format", "markdown"], DOF + ["--format", "html"], SWEEP,
           ["dof", "-f", "50", "-N", "2.8..8", "-s", "1..5", "--table", "s,N"], ["help"],
           ["dof", "--help"], ["--version"], ["list", "cameras"], ["completion", "bash"],
           ["completion", "zsh"], ["completion", "fish"], ["help", "fov"])


def check_failed(checks, what, result, *says):
    error = result.stderr.decode("utf-8", "replace")
    checks.check(result.returncode == 5, f"{what}: status {result.returncode}, expected 5")
    checks.check(error.startswith("lenscalc: "), f"{what}: message {error[:200]!r}")
    for text in says:
        checks.check(text in error, f"{what}: '{text}' is not in {error[:200]!r}")


def check_standard_output(checks, program):
    for words in ANSWERS:
        name = " ".join(words)
        with open("/dev/full", "wb") as full:
            result = program.run(*words, stdout=full)
        check_failed(checks, f"{name} > /dev/full", result, "standard output")
        result = program.shell(f"lenscalc {' '.join(words)} >&-", "/")
        check_failed(checks, f"{name} >&-", result, "standard output")
    # an error message that cannot be written is no reason to crash
    for words in (["dof", "-f", "x"], [], DOF):
        quoted = " ".join(words)
        result = program.shell(f"lenscalc {quoted} 2>&-", "/")
        expected = 0 if words == DOF else 2
        checks.check(result.returncode == expected, f"{quoted} 2>&-: status {result.returncode}")
        result = program.shell(f"lenscalc {quoted} <&-", "/")
        checks.check(result.returncode == expected, f"{quoted} <&-: status {result.returncode}")
    check_failed(checks, "--batch - <&-", program.shell("lenscalc dof --batch - <&-", "/"),
                 "standard input")


BATCH = "printf 'f,N,s\\n50,x,3\\n50,4,3\\n' | lenscalc dof --batch - --csv --columns near"
OPTIMIZE = "lenscalc optimize double-gauss --vary R1 --goals efl=101 --iterations 1"


def check_closed_streams(checks, program):
    """The first file that is opened does not become the stream that is closed."""
    for script, name, status in (
            (f"{OPTIMIZE} -o new >&-", "", 5), (f"{OPTIMIZE} -o new <&- >&-", "", 5),
            ("lenscalc fit double-gauss --distortion 0 -o new.lens >&-", "", 5),
            ("lenscalc tolerance double-gauss --grade commercial --trials 2 --save worst:1 -o new.lens "
             ">&-", "", 5),
            (f"{BATCH} -o rows 2>&-", "rows", 3), (f"{BATCH} -o rows <&- 2>&- >&-", "", 5)):
        if " fit " in script and not program.has_solver():
            continue
        with tempfile.TemporaryDirectory() as folder:
            result = program.shell(script, folder)
            checks.check(result.returncode == status, f"{script}: status {result.returncode}, "
                                                      f"expected {status}: {result.stderr!r}")
            if status == 5:
                checks.check(os.listdir(folder) == [], f"{script}: left {os.listdir(folder)}")
                continue
            with open(os.path.join(folder, name)) as file:
                text = file.read()
            checks.check(text.startswith("near_m\n") and "lenscalc" not in text,
                         f"{script}: {text!r}")


def check_open_streams(checks, program):
    """A name of what is open is written to where it stands: a pipe, the middle of a file."""
    fov = "lenscalc fov -f 24 --csv --columns horizontal"  # "horizontal_deg" and a row
    for script in (f"echo keep > f; {fov} -o /dev/stdout >> f; echo tail >> f",
                   f"{{ echo keep; {fov} -o /dev/stdout; echo tail; }} > f",
                   f"{{ echo keep; {fov} -o /dev/fd/1; echo tail; }} > f",
                   f"{{ echo keep; {fov} -o /proc/self/fd/5 5>&1; echo tail; }} > f",
                   f"ln -s /dev/stderr here; {{ echo keep; {fov} -o here; echo tail; }} 2>&1 | cat > f",
                   f"{{ echo keep; cd /dev; {fov} -o stdout; echo tail; }} > f",
                   f"echo keep > f; {fov} -o /proc/$$/fd/7 7>> f 8>> f; echo tail >> f",
                   f"echo keep > f; exec 7>> f; {fov} -o /proc/$$/fd/7; echo tail >> f",
                   f"{{ echo keep; {fov} -o /dev/stdout; echo tail; }} | cat > f"):
        with tempfile.TemporaryDirectory() as folder:
            result = program.shell(script, folder)
            with open(os.path.join(folder, "f")) as file:
                lines = file.read().split("\n")
            # 2 atan(36 / 48) = 73.7398 degrees
            checks.check(lines[:2] == ["keep", "horizontal_deg"] and lines[3:] == ["tail", ""] and
                         lines[2].startswith("73.7397952916"),
                         f"{script}: {lines}, {result.stderr!r}")
    with tempfile.TemporaryDirectory() as folder:
        for script, found in ((f"{OPTIMIZE} -o /dev/stdout > f", b"write the same file"),
                              ("lenscalc fan double-gauss --plot /dev/stdout > f",
                               b"write the same file"),
                              (f"{fov} -o /dev/fd/99", b"cannot write /dev/fd/99: Bad file"),
                              ("lenscalc draw double-gauss -o /dev/stdout > f", b"")):
            result = program.shell(script, folder)
            checks.check(found in result.stderr and (result.returncode != 0 or found == b""),
                         f"{script}: {result.returncode}, {result.stderr!r}")


def check_protected(checks, program):
    """What may not be written is not replaced; what runs with an owner's rights loses them."""
    with tempfile.TemporaryDirectory() as folder:
        os.chmod(folder, 0o777)
        target = os.path.join(folder, "rows.csv")
        with open(target, "w") as file:
            file.write("keep\n")
        os.chmod(target, 0o444)
        nobody = {"user": 65534, "group": 65534, "extra_groups": []} if os.geteuid() == 0 else {}
        # the program where everybody may run it
        copy = os.path.join(folder, "copy")
        shutil.copy(program.binary, copy)
        os.chmod(copy, 0o755)
        try:
            result = subprocess.run([copy] + DOF + ["--csv", "-o", target], cwd=folder,
                                    stderr=subprocess.PIPE, env=program.environment(), **nobody)
        except (PermissionError, subprocess.SubprocessError):
            return  # where nobody becomes anybody else
        check_failed(checks, "-o over a protected file", result, "rows.csv: Permission denied")
        with open(target) as file:
            checks.check(file.read() == "keep\n", "a protected file is replaced")
        os.chmod(target, 0o6755)
        program.run(*DOF, "--csv", "-o", target)
        mode = os.stat(target).st_mode & 0o7777
        checks.check(mode == 0o755, f"-o over a program of mode 6755: mode {mode:o}")
        if nobody:
            os.chown(target, 65534, 65534)
            program.run(*DOF, "--csv", "-o", target)
            checks.check(os.stat(target).st_uid == 65534, "-o over a file gives it an owner")


def check_pipe(checks, program):
    """`lenscalc ... | head -n 1`: the reader takes a line and leaves."""
    rows = b"f,N,s\n" + b"50,4,3\n" * 200000
    for words in (SWEEP, ["list", "cameras", "--csv"], ["dof", "--batch", "-", "--csv"]):
        with tempfile.TemporaryFile() as given:
            given.write(rows)
            given.seek(0)
            process = subprocess.Popen(program.command + words, stdin=given,
                                       stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                       env=program.environment())
            first = process.stdout.readline()
            process.stdout.close()
            error = process.stderr.read().decode()
            process.stderr.close()
            status = process.wait(60)
        name = f"{' '.join(words)} | head -n 1"
        checks.check(first.endswith(b"\n"), f"{name}: no first line")
        # the status of a program that the pipe ended; what fits into the pipe before the reader
        # leaves may be all of a short list
        checks.check(status == 128 + signal.SIGPIPE or (status == 0 and words[0] == "list"),
                     f"{name}: status {status}")
        checks.check(error == "", f"{name}: message {error!r}")


def check_file(checks, program, words, option, target, folder):
    """One write to a place where none is possible."""
    before = sorted(os.listdir(folder))
    result = program.run(*words, option, target, cwd=folder)
    name = f"{words[0]} {option} {target}"
    check_failed(checks, name, result, os.path.basename(target))
    checks.check(sorted(os.listdir(folder)) == before,
                 f"{name}: left {sorted(os.listdir(folder))}")


def check_places(checks, program):
    plot = ["dof", "-f", "50", "-N", "4", "-s", "1..10"]
    drawings = ((DOF, "-o"), (SWEEP, "-o"), (["help"], "-o"), (["completion", "bash"], "-o"),
                (plot, "--plot"), (DOF, "--scale"),
                (["dof", "-f", "50", "-N", "2.8..8", "-s", "1..5", "--table", "s,N"], "-o"))
    with tempfile.TemporaryDirectory() as folder:
        os.mkdir(os.path.join(folder, "sub"))
        with open(os.path.join(folder, "plain"), "w") as file:
            file.write("plain\n")
        for words, option in drawings:
            for target in ("missing/x.svg", "sub", "plain/x.svg", "/dev/full", "/proc/x.svg"):
                check_file(checks, program, words, option, target, folder)
        if os.geteuid() != 0:
            os.chmod(os.path.join(folder, "sub"), 0o500)
            for words, option in drawings:
                check_file(checks, program, words, option, "sub/x.svg", folder)
            os.chmod(os.path.join(folder, "sub"), 0o700)
        # a file that was there stays as it was when the new one fails
        target = os.path.join(folder, "old.csv")
        with open(target, "w") as file:
            file.write("old\n")
        for words in (["dof", "-f", "50", "-N", "4", "-s", "0.01", "--csv"],
                      ["dof", "-f", "50", "-N", "4", "-s", "3,0.01", "--fail-fast", "--csv"],
                      ["dof", "-f", "x"], ["list", "formats", "no-such-thing"]):
            program.run(*words, "-o", target, cwd=folder)
            with open(target) as file:
                checks.check(file.read() == "old\n", f"{' '.join(words)} -o: the old file is gone")
        result = program.run(*DOF, "--csv", "-o", target, cwd=folder)
        with open(target) as file:
            checks.check(result.returncode == 0 and file.read().startswith("focal_mm"),
                         "-o over an old file")
        checks.check(sorted(os.listdir(folder)) == ["old.csv", "plain", "sub"],
                     f"left behind: {sorted(os.listdir(folder))}")


def check_links(checks, program):
    """A link is followed, its target there or not; links in a circle and twice one file are refused."""
    with tempfile.TemporaryDirectory() as folder:
        os.mkdir(os.path.join(folder, "sub"))
        for name, target in (("dangling", "later"), ("far", "sub/far"), ("sub/back", "../later2"),
                             ("one", "two"), ("two", "one"), ("nowhere", "no/x"), ("x.svg", "y.svg")):
            os.symlink(target, os.path.join(folder, name))
        for name, target in (("dangling", "later"), ("dangling", "later"), ("far", "sub/far"),
                             ("sub/back", "later2")):
            result = program.run(*DOF, "--csv", "-o", name, cwd=folder)
            checks.check(result.returncode == 0 and os.path.islink(os.path.join(folder, name)),
                         f"-o {name}: {result.stderr!r}, or the link is replaced")
            with open(os.path.join(folder, target)) as file:
                checks.check(file.read().startswith("focal_mm"), f"-o {name}: {target} is not it")
        for name in ("one", "nowhere"):
            check_failed(checks, f"-o {name}", program.run(*DOF, "-o", name, cwd=folder), "cannot")
        for first, second in (("x.svg", "y.svg"), ("y.svg", "x.svg"),
                              ("x.svg", "./sub/../y.svg")):
            result = program.run(*DOF, "--scale", first, "-o", second, cwd=folder)
            checks.check(result.returncode == 2 and b"write the same file" in result.stderr,
                         f"--scale {first} -o {second}: {result.stderr!r}")
        # a name as long as names may be, which leaves no room for one that is longer
        longest = "n" * 255
        result = program.run(*DOF, "--csv", "-o", longest, cwd=folder)
        checks.check(result.returncode == 0 and longest in os.listdir(folder),
                     f"-o {longest}: {result.stderr!r}")
        checks.check(not [name for name in os.listdir(folder) if name.startswith(".lenscalc")],
                     f"left behind: {os.listdir(folder)}")


def check_memory(checks, program):
    """What wants more memory than there is ends with a message, not with a core."""
    if program.is_instrumented:
        return
    with tempfile.TemporaryDirectory() as folder:
        for words in ("dof -f 50 -N 4 -s 1..100000000:1 --force",
                      "dof --batch huge.csv --csv", "lens huge.lens"):
            with open(os.path.join(folder, "huge.csv"), "w") as file:
                file.write("f,N,s\n" + "5" * 40_000_000)
            with open(os.path.join(folder, "huge.lens"), "w") as file:
                file.write("lens huge\n" + "surface 50 1 air 10\n" * 2_000_000)
            result = program.shell(f"ulimit -v 65536; lenscalc {words}", folder)
            check_failed(checks, f"{words} in 64 MB", result, "out of memory")
            checks.check(result.stdout == b"", f"{words} in 64 MB: prints {result.stdout[:80]!r}")
        # nothing of a search stays behind but the glass that it found
        result = program.shell("ulimit -v 65536; lenscalc glass -w d --csv "
                               + ",".join(["N-BK7"] * 5000), folder)
        checks.check(result.stdout.count(b"\nN-BK7,") == 5000,
                     f"5000 glasses in 64 MB: {result.stderr[:80]!r}")
        # threads take no memory that one alone would have had
        for room in range(18000, 44000, 3000):
            words = "tolerance double-gauss --grade commercial --trials 60 --threads"
            script = f"ulimit -v {room}; lenscalc {words} 4 --csv"
            one = program.shell(script.replace("threads 4", "threads 1"), folder)
            four = program.shell(script, folder)
            checks.check((one.returncode, one.stdout) == (four.returncode, four.stdout),
                         f"{script}: {one.returncode}, {four.returncode}: {four.stderr!r}")
        if program.has_solver():  # which takes its memory itself
            result = program.shell("ulimit -v 120000; lenscalc fit double-gauss -w d --rays 1e5 "
                                   "--csv --columns efl,rays", folder)
            checks.check(result.returncode == 0 and b",9" in result.stdout,
                         f"fit --rays 1e5 in 120 MB: {result.stdout!r}, {result.stderr[:80]!r}")
            with open(os.path.join(folder, "many.csv"), "w") as file:
                file.write("wavelength_nm,index\n")
                file.writelines(f"{400 + i / 500},{1.5 + 1e-6 * (i % 7) + 4e3 / (400 + i / 500)**2}"
                                "\n" for i in range(200_000))
            result = program.shell("ulimit -v 120000; lenscalc fit --glass many.csv", folder)
            check_failed(checks, "fit --glass in 120 MB", result, "out of memory")


def check_full_disk(checks, program):
    """A limit on the size of files stands for a full disk in the middle of a file."""
    with tempfile.TemporaryDirectory() as folder:
        for words, option in ((SWEEP, "-o"), (["list", "cameras", "--csv"], "-o"),
                              (["dof", "-f", "50", "-N", "4", "-s", "1..10"], "--plot"),
                              (DOF, "--scale")):
            script = (f"ulimit -f 4; lenscalc {' '.join(words)} {option} big.svg "
                      f"> /dev/null")
            result = program.shell(script, folder)
            check_failed(checks, f"{' '.join(words)} {option} on a full disk", result, "big.svg")
            checks.check(os.listdir(folder) == [], f"{' '.join(words)} {option}: left "
                                                   f"{os.listdir(folder)}")


def check_interrupted(checks, program):
    """A signal in the middle leaves no file under the name that was asked for."""
    with tempfile.TemporaryDirectory() as folder:
        read, write = os.pipe()
        process = subprocess.Popen(program.command + ["dof", "--batch", "-", "--csv", "-o", "x.csv"],
                                   stdin=read, cwd=folder, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, env=program.environment())
        os.close(read)
        os.write(write, b"f,N,s\n50,4,3\n")
        try:
            process.wait(0.3)
        except subprocess.TimeoutExpired:
            pass
        checks.check("x.csv" not in os.listdir(folder), "-o: the file is there before its end")
        process.terminate()
        process.communicate()
        os.close(write)
        checks.check("x.csv" not in os.listdir(folder), "-o: half a file after a signal")


def check_json(checks, program):
    """Whatever the rows hold, JSON stays JSON."""
    noise = random.Random(9)
    rows = [bytes(noise.randrange(1, 256) for _ in range(noise.randrange(1, 80)))
            for _ in range(300)]
    rows = [row.replace(b"\n", b"").replace(b"\r", b"").replace(b'"', b"").replace(b",", b";")
            .replace(b"#", b"") for row in rows]
    rows += [("\u00e4" * length).encode() for length in range(1, 140)]
    given = b"f,N,s,note\n" + b"".join(b"50,4,3," + row + b"\n" + row + b",4,3,x\n" for row in rows)
    for form in ("jsonl", "json"):
        result = program.run("dof", "--batch", "-", "--format", form, "--columns", "near_m",
                             stdin=given)
        pieces = (result.stdout.split(b"\n")[:-1] if form == "jsonl" else [result.stdout])
        checks.check(form == "json" or len(pieces) == 2 * len(rows), f"{form}: {len(pieces)} rows")
        broken = []
        for piece in pieces:
            try:
                json.loads(piece.decode("utf-8"))
            except ValueError as trouble:
                broken.append(f"{trouble}: {piece[:120]!r}")
        checks.check(not broken, f"{form}: {len(broken)} broken of {len(pieces)}: {broken[:2]}")


def main():
    checks, program = Checks(), Program(sys.argv[1])
    for check in (check_standard_output, check_closed_streams, check_open_streams, check_protected,
                  check_pipe, check_places, check_links, check_memory, check_full_disk,
                  check_interrupted, check_json):
        check(checks, program)
    checks.finish()


main()
