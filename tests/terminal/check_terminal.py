#!/usr/bin/env python3
"""tests/terminal/check_terminal.py - what the program does where somebody looks at a terminal.

Help within 80 columns; tables within the width of the terminal, of which they say what is left out;
colours; and nothing that comes from outside makes the terminal do what it should not.
"""
# SPDX-License-Identifier: MIT

import json
import os
import pty
import re
import resource
import signal
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program, has_terminals, on_terminal

HELP_WIDTH = 80


def words_of(program, *words):
    return program.run(*words).stdout.decode().split("\n")


def check_help(checks, program):
    """Every command's help, every topic, and the list of both; nothing of the texts is lost."""
    commands = words_of(program, "list", "commands", "--columns", "command", "--csv")[1:-1]
    overview = program.run("help").stdout.decode()
    topics = [line.split()[0] for line in
              overview.split("topics (lenscalc help TOPIC):\n")[1].split("\n\n")[0].split("\n")]
    checks.check(len(commands) > 30 and {"units", "version", "ranges"} <= set(topics),
                 f"help: commands {commands}, topics {topics}")
    for question in [["help"], []] + [["help", name] for name in commands + topics]:
        result = program.run(*question)
        text = (result.stdout or result.stderr).decode()
        for line in text.split("\n"):
            checks.check(len(line) <= HELP_WIDTH, f"{question}: {len(line)} columns: {line}")
    # an example broken into lines is one line to the shell
    long = [line for name in commands for line in words_of(program, "help", name)
            if line.endswith("\\")]
    checks.check(all(line.endswith(" \\") for line in long) and len(long) > 3,
                 f"examples are broken at {long}")


# Questions whose tables are wide: sweeps, lenses, lists, cross-tables, one answer with long words.
QUESTIONS = [
    ["lens", "double-gauss"], ["lens", "nikkor-z-14-24", "--position", "all"],
    ["surfaces", "double-gauss"], ["seidel", "double-gauss"], ["spot", "double-gauss"],
    ["dof", "-f", "50", "-N", "2.8..8", "-s", "1,2,3"], ["dof", "-f", "50", "-N", "4", "-s", "3"],
    ["dof", "-f", "50", "-N", "2.8..22/third", "-s", "1,2,3", "--table", "s,N"],
    ["exposure", "-N", "8", "-t", "1/60", "--iso", "100..6400"], ["flash", "-g", "36", "-N", "4"],
    ["equivalent", "-f", "50", "-N", "2", "--sensor", "35mm"],
    ["list", "films"], ["list", "cameras", "nikon"], ["list", "lenses"], ["list", "units"],
    ["list", "options"], ["list", "commands"], ["list", "glasses", "N-BK"],
    ["glass", "N-BK7", "-w", "d,F,C"], ["check", "double-gauss"], ["motion", "-f", "50",
     "-s", "5,10", "--speed", "2,5"], ["matrix", "double-gauss"], ["help", "units"],
]
LEFT_OUT = re.compile(r"\nnot shown, for want of room in (\d+) columns: (.*?); --columns NAMES", re.S)


def check_width(checks, program):
    """Lines keep within 60, 80 and 120 columns, and what is left out is named."""
    some_left_out = 0
    for words in QUESTIONS:
        name = " ".join(words)
        whole, _, status = on_terminal(program, words, 9999)
        piped = program.run(*words).stdout.decode()
        checks.check(status == 0 and len(whole) > 60, f"{name}: status {status}")
        # no table is wrapped where there is room; the lines below it are filled
        if words != ["list", "options"]:  # so many rows that later ones are wider
            checks.check(whole.split("\n\n")[0] == piped.split("\n\n")[0], f"{name}: wide")
        for width in (60, 80, 120):
            shown, _, _ = on_terminal(program, words, width)
            for line in shown.split("\n"):
                checks.check(len(line) <= width, f"{name}: {len(line)} of {width} columns: {line}")
            note = LEFT_OUT.search(shown)
            if note is None:
                continue
            some_left_out += 1
            checks.check(int(note[1]) == width, f"{name}: {note[0]}")
            left_out = re.sub(r"\s+", "", note[2])
            # these are names that --columns takes, and shows whatever the width
            asked, _, status = on_terminal(program, words + ["--columns", left_out], width)
            checks.check(status == 0 and "not shown" not in asked,
                         f"{name} --columns {left_out}: status {status}, {asked[:200]}")
    checks.check(some_left_out > 7, f"only {some_left_out} tables leave columns out")
    lens = ["lens", "double-gauss"]
    at_60, _, _ = on_terminal(program, lens, 60)
    checks.check(on_terminal(program, lens, 120, COLUMNS="60")[0] == at_60, "COLUMNS=60")
    for columns in ("", "0", "-5", "60x", "1e9"):
        checks.check(on_terminal(program, lens, 60, COLUMNS=columns)[0] == at_60,
                     f"COLUMNS='{columns}' is no width")
    checks.check(max(map(len, on_terminal(program, lens, 0)[0].split("\n"))) in range(61, 81),
                 "a terminal that does not know its width has 80 columns")
    # a pipe knows no width, and neither does a file
    plain = program.run(*lens).stdout
    checks.check(program.run(*lens, variables={"COLUMNS": "40"}).stdout == plain, "COLUMNS, pipe")
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "x.txt")
        on_terminal(program, lens + ["-o", path], 60)
        with open(path, "rb") as file:
            checks.check(file.read() == plain, "a file on a terminal of 60 columns")
    # rows that come later keep the layout of the first
    late, _, _ = on_terminal(program, ["dof", "-f", "50", "-N", "2.8", "-s", "1..700"], 40)
    table = late.split("\n\n")[0].split("\n")
    checks.check(len(table) > 700 and {len(line) for line in table[2:]} == {len(table[2])},
                 f"rows of {sorted({len(line) for line in table[2:]})} columns")


def check_blocks(checks, program):
    """A cross-table goes on below: each column once, the first one in each block."""
    words = ["dof", "-f", "50", "-N", "2.8..22/third", "-s", "1,2,3", "--table", "s,N"]
    def cells(text):
        blocks = [block.split("\n") for block in text.split("\n\n")[1:-1]]
        return [sum((re.split(r"  +", line[14:].strip()) for line in column), [])
                for column in zip(*blocks)]
    # heads hold blanks, so that the cells below them are compared
    narrow, _, _ = on_terminal(program, words, 60)
    heads = [block.split("\n")[0] for block in narrow.split("\n\n")[1:-1]]
    checks.check(len(heads) > 2 and all("distance (m)" in head for head in heads), f"{heads}")
    checks.check(cells(narrow)[1:] == cells(program.run(*words).stdout.decode())[1:],
                 "blocks hold other cells than the table")


def check_color(checks, program):
    """Colours on a terminal, unless it or somebody says no; in a pipe only if asked for."""
    table, wrong = ["lens", "double-gauss"], ["dof", "-f", "50nn"]
    warned = ["dof", "-f", "50", "-N", "0.3", "-s", "3"]
    for words, mark in ((table, "\033[1m"), (wrong, "\033[1;31mlenscalc: dof:\033[0m bad unit"),
                        (warned, "\033[33mwarning:\033[0m ")):
        name = " ".join(words)
        shown = "".join(on_terminal(program, words, 80, TERM="xterm")[:2])
        checks.check(mark in shown, f"{name}: no {mark!r} in {shown[:200]!r}")
        checks.check(shown.count("\033[0m") == len(re.findall("\033\\[(?!0m)", shown)),
                     f"{name}: a colour has no end")
        bare = "".join(on_terminal(program, words, 80, TERM="dumb")[:2])
        checks.check(re.sub("\033\\[[0-9;]*m", "", shown) == bare, f"{name}: colour alone differs")
        for more, variables in (([], {"NO_COLOR": "1", "TERM": "xterm"}), ([], {"TERM": "dumb"}),
                                (["--color", "never"], {"TERM": "xterm"}),
                                (["--csv"], {"TERM": "xterm"})):
            shown = on_terminal(program, words + more, 80, **variables)
            text = shown[0] if more == ["--csv"] else "".join(shown[:2])
            checks.check("\033" not in text, f"{name} {more} {variables}: {text[:200]!r}")
        checks.check("\033" in "".join(on_terminal(program, words, 80, TERM="xterm", NO_COLOR="")[:2]),
                     f"{name}: an empty NO_COLOR says nothing")
        piped = program.run(*words)
        checks.check(b"\033" not in piped.stdout + piped.stderr, f"{name}: colour in a pipe")
        always = program.run(*words, "--color=always", variables={"NO_COLOR": "1"})
        checks.check(mark in (always.stdout + always.stderr).decode(), f"{name} --color=always")
    for form in ("csv", "tsv", "json", "jsonl", "markdown", "html"):
        result = program.run(*table, "--format", form, "--color", "always")
        checks.check(result.returncode == 0 and b"\033" not in result.stdout, f"colour in {form}")
    with tempfile.TemporaryDirectory() as folder:
        for words, option in ((table, "-o"), (["draw", "double-gauss"], "-o")):
            path = os.path.join(folder, "x.svg")
            program.run(*words, option, path, "--color", "always")
            with open(path, "rb") as file:
                checks.check(b"\033" not in file.read(), f"{words} {option}: colour in a file")
    checks.check(b"'auto', 'always' or 'never'" in program.run(*table, "--color", "x").stderr or
                 program.run(*table, "--color", "x").returncode == 2, "--color x")


# What a terminal obeys: CSI in 7 and 8 bits, OSC, backspace, DEL, and marks that turn the writing.
EVIL = ["\033[31m", "\u009b31m", "\033]0;x\007", "\010", "\177", "\u202e", "\u2066", "\u200f",
        "\u061c", "\u2028"]
OBEYED = re.compile("[\0-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069]")


def check_escapes(checks, program):
    """What comes from files and words reaches no terminal raw: answers in text, all messages."""
    with tempfile.TemporaryDirectory() as folder:
        for number, evil in enumerate(EVIL):
            name = repr(evil)
            rows = f"f,N,s,note{evil}\n50,4,3,a{evil}b\n50,x{evil},3,c\n".encode()
            path = os.path.join(folder, f"rows{number}{evil}.csv")
            with open(path, "wb") as file:
                file.write(rows)
            for form in ("text", "markdown", "html"):
                result = program.run("dof", "--batch", path, "--format", form)
                for what, text in (("answer", result.stdout), ("message", result.stderr)):
                    found = OBEYED.findall(text.decode())
                    checks.check(not found, f"{form} {what} with {name} has {found}")
                checks.check(result.returncode == 3 and b"a" in result.stdout, f"{form} {name}")
            result = program.run("dof", "--batch", path, "--json")
            rows = json.loads(result.stdout)["rows"]
            checks.check(not OBEYED.findall(result.stdout.decode()) and
                         rows[0][f"note{evil}"] == f"a{evil}b", f"json with {name}")
            csv = program.run("dof", "--batch", path, "--csv").stdout.decode()
            checks.check(f"a{evil}b" in csv, f"csv changes {name}")
            lens = os.path.join(folder, f"lens{number}.zmx")
            with open(lens, "w", encoding="utf-8") as file:
                file.write(f"VERS 1\nMODE SEQ\nUNIT MM\nNAME a{evil}b\nXY{evil}Z 4\nENPD 5\nSURF 0\n"
                           "  DISZ INFINITY\nSURF 1\n  STOP\n  CURV 0.02\n  DISZ 5\n  GLAS N-BK7\n"
                           "SURF 2\n  CURV -0.02\n  DISZ 50\nSURF 3\n  DISZ 0\n")
            result = program.run("lens", lens, "--lossy")
            found = OBEYED.findall((result.stdout + result.stderr).decode())
            checks.check(b"lost:" in result.stderr and not found,
                         f"title and losses with {name}: {found}, {result.stderr[:200]!r}")
            for words in (["dof", "-f", f"50{evil}"], [f"dof{evil}"], ["help", evil],
                          ["dof", f"--f{evil}"], ["lens", f"x{evil}"], ["dof", "-o", f"no/{evil}"],
                          ["dof", "-f", "50", "-N", "4", "-s", "3", "-o", f"no{evil}/x"],
                          ["list", "films", f"x{evil}"], ["glass", f"N{evil}"]):
                result = program.run(*words)
                found = OBEYED.findall(result.stderr.decode())
                checks.check(result.returncode > 0 and not found, f"{words}: {found}")
    # a stray byte of that range, which terminals of 8 bits obey
    result = program.run("dof", "--batch", "-", stdin=b"f,N,s,n\n50,4,3,a\x9b31mb\n50,\x9b,3,x\n")
    checks.check(b"\x9b" not in result.stdout + result.stderr, "a stray byte 9b")
    result = program.run("dof", "--batch", "-", "--format", "markdown",
                         stdin=b"f,N,s,n\n50,4,3,<script>x|y\n")
    checks.check(rb"\<script>x\|y" in result.stdout, f"markdown: {result.stdout!r}")


def check_printed_files(checks, program):
    """Files and rows for programs, shown on a terminal; a pipe has them as they are."""
    evil = "".join(EVIL)
    with tempfile.TemporaryDirectory() as folder:
        lens = os.path.join(folder, "x.zmx")
        with open(lens, "w", encoding="utf-8") as file:
            file.write(f"VERS 1\nMODE SEQ\nUNIT MM\nNAME a{evil}b \u00e4\u2014\nENPD 5\nSURF 0\n"
                       f"  DISZ INFINITY\nSURF 1\n  STOP\n  COMM c{evil}\n  CURV 0.02\n  DISZ 5\n"
                       "  GLAS N-BK7\nSURF 2\n  CURV -0.02\n  DISZ 50\nSURF 3\n  DISZ 0\n")
        # so long that it is handed over in the middle of characters
        rows = os.path.join(folder, "rows.csv")
        with open(rows, "w", encoding="utf-8") as file:
            file.write("f,N,s,note\n" + f"50,4,3,\u20ac\u20ac{evil}\n" * 6000)
        for words in (["convert", lens], ["draw", lens, "--title", f"{evil}\u00e4"],
                      ["convert", lens, "--to", "zmx"],
                      ["dof", "--batch", rows, "--csv", "--columns", "near"],
                      ["dof", "--batch", rows, "--tsv", "--columns", "near"]):
            shown, _, status = on_terminal(program, words, 80)
            shown = shown.replace("\r\n", "\n")  # as the file has it, behind the terminal's own
            piped = program.run(*words).stdout.decode()
            name = " ".join(words[:2] + words[-2:])
            checks.check(status == 0 and not OBEYED.findall(shown),
                         f"{name!a}: status {status}, {OBEYED.findall(shown)[:9]}")
            # one '?' for each of them and nothing else
            expected = OBEYED.sub("?", piped.replace("\r\n", "\n"))
            checks.check(shown == expected, f"{name!a}: {len(shown)} characters, "
                                            f"expected {len(expected)}")


def screen(text):
    """What a terminal shows in the end of what was written to it; the lines that were there."""
    lines, seen = [""], []
    at = 0
    for c in text:
        if c == "\r":
            seen.append(lines[-1].rstrip())
            at = 0
        elif c == "\n":
            lines.append("")
            at = 0
        else:
            lines[-1] = lines[-1][:at] + c + lines[-1][at + 1:]
            at += 1
    return [line.rstrip() for line in lines], seen


def read_all(ours):
    """What is left to read of a terminal whose other side is closed."""
    shown = b""
    while True:
        try:
            shown += os.read(ours, 65536)
        except OSError:
            os.close(ours)
            return shown.decode().replace("\r\n", "\n")


def wait_for_rows(process):
    """Until it answers rows: it then waits for Ctrl-C, which Linux tells."""
    end = time.monotonic() + 30
    while time.monotonic() < end:
        try:
            with open(f"/proc/{process.pid}/status") as status:
                caught = re.search(r"^SigCgt:\s*(\w+)", status.read(), re.M)
        except OSError:
            return
        if caught is None or int(caught[1], 16) >> (signal.SIGINT - 1) & 1:
            return
        time.sleep(0.002)


def wait_for_work(process, seconds):
    """Until it has worked so long, in processors."""
    wait_for_rows(process)
    spent = 0
    while process.poll() is None and spent < seconds:
        with open(f"/proc/{process.pid}/stat", encoding="ascii") as file:
            fields = file.read().rsplit(")", 1)[1].split()
        spent = (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
        time.sleep(0.01)


def interrupt_amid(processes):
    """Ctrl-C for all, a while after each has got ready for it; returns when."""
    for process in processes:
        wait_for_rows(process)
    time.sleep(0.4)
    began = time.perf_counter()
    for process in processes:
        process.send_signal(signal.SIGINT)
    return began


def slowly(program, words, rows, interrupt=False, stderr=subprocess.PIPE):
    """A call whose rows come one by one, then its end or Ctrl-C; the process and its answer."""
    process = subprocess.Popen(program.command + words, stdin=subprocess.PIPE,
                               stdout=subprocess.PIPE, stderr=stderr, env=program.environment())
    process.stdin.write(b"f,N,s\n")
    for row in rows:
        process.stdin.write(row)
        process.stdin.flush()
        time.sleep(0.06)
    if interrupt:
        wait_for_rows(process)
        process.send_signal(signal.SIGINT)
        time.sleep(0.2)
    process.stdin.close()
    answer = process.stdout.read()
    return process.wait(), answer, process.stderr.read().decode() if process.stderr else ""


def check_progress(checks, program):
    """A line on a terminal after half a second, gone in the end; none anywhere else."""
    rows = [b"50,4,%d\n" % (i + 1) for i in range(13)]
    batch = ["dof", "--batch", "-", "--csv", "--columns", "near_m"]
    ours, terminal = pty.openpty()
    status, answer, _ = slowly(program, batch, rows + [b"x,4,1\n"], stderr=terminal)
    os.close(terminal)
    shown = read_all(ours)
    lines, seen = screen(shown)
    checks.check(status == 3 and len(answer.split()) == 15, f"slow rows: {status}, {answer}")
    checks.check(any(re.fullmatch(r"lenscalc dof: \d+ rows  [0-9.]+ rows/s", line) for line in seen),
                 f"slow rows: no progress in {seen}")
    checks.check(lines[0].startswith("lenscalc: dof: standard input:15:1") and lines[-1] == "",
                 f"slow rows: what stays is {lines}")
    status, _, error = slowly(program, batch, rows)
    checks.check(status == 0 and error == "", f"progress in a pipe: {error!r}")
    _, error, _ = on_terminal(program, ["optimize", "double-gauss", "--vary", "R1..R11", "--goals",
                                        "poly,efl=100", "--global", "40", "--rays", "60",
                                        "--seconds", "1.5"], 100)
    checks.check(re.search(r"optimize: \d+ starts  \d+ %  best merit [0-9.e-]+  ", error),
                 f"progress of a search: {error!r}")
    # a sweep knows its end; held up, so that it takes long on any machine
    ours, terminal = pty.openpty()
    process = subprocess.Popen(program.command + ["spot", "double-gauss", "--field", "0..14:0.02"],
                               stdout=subprocess.DEVNULL, stderr=terminal,
                               env=program.environment())
    os.close(terminal)
    wait_for_rows(process)
    process.send_signal(signal.SIGSTOP)
    time.sleep(0.6)
    process.send_signal(signal.SIGCONT)
    error = read_all(ours)
    lines, seen = screen(error)
    percents = [int(found) for found in re.findall(r"rows  (\d+) %  [0-9.]+ (?:k )?rows/s", error)]
    checks.check(process.wait() == 0 and percents and percents == sorted(percents) and
                 percents[-1] <= 100 and lines == [""], f"a sweep: {percents}, {lines}")
    quick = on_terminal(program, ["dof", "-f", "50", "-N", "4", "-s", "1..100", "--csv"], 80)
    checks.check(quick[1] == "", f"progress of what is done at once: {quick[1]!r}")


def check_interrupted(checks, program):
    """Ctrl-C between rows: the answer is complete but for them, says so, and status 1."""
    rows = [b"50,4,%d\n" % (i + 1) for i in range(3)]
    forms = ("json", "jsonl", "csv", "html", "markdown", "text")
    with ThreadPoolExecutor(len(forms)) as pool:  # they wait more than they work
        answers = list(pool.map(lambda form: slowly(program, ["dof", "--batch", "-", "--format",
                                                              form], rows, interrupt=True), forms))
    for form, (status, answer, error) in zip(forms, answers):
        text = answer.decode()
        checks.check(status == 1 and "interrupted" in error, f"{form}: {status}, {error!r}")
        if form == "json":
            found = json.loads(text)["rows"]
            checks.check(len(found) == 4 and found[2]["near_m"] > 0 and
                         "interrupted" in found[3]["error"], f"{form}: {text}")
        elif form == "jsonl":
            found = [json.loads(line) for line in text.split("\n")[:-1]]
            checks.check(len(found) == 4 and "interrupted" in found[3]["error"], f"{form}: {text}")
        else:
            checks.check("interrupted" in text and (form != "html" or "</html>" in text),
                         f"{form}: {text}")
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "x.csv")
        slowly(program, ["dof", "--batch", "-", "--csv", "-o", path], rows, interrupt=True)
        checks.check(os.listdir(folder) == [], "interrupted: the file is there")
    process = subprocess.Popen(program.command + ["spot", "double-gauss", "--field", "0..14:0.001",
                                                  "--json"], stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, env=program.environment())
    wait_for_rows(process)
    time.sleep(0.2)
    process.send_signal(signal.SIGINT)
    answer, error = process.communicate()
    found = json.loads(answer)["rows"]
    checks.check(process.returncode == 1 and 1 < len(found) < 14000 and
                 "interrupted" in found[-1]["error"], f"a sweep: {len(found)} rows, {error!r}")
    check_interrupted_lens(checks, program)
    check_interrupted_search(checks, program)
    check_interrupted_fit(checks, program)
    check_interrupted_trials(checks, program)
    check_interrupted_picture(checks, program)


def check_interrupted_lens(checks, program):
    """An optimisation that is interrupted writes the best so far, marked."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "best.lens")
        process = subprocess.Popen(program.command +
                                   ["optimize", "hubble-rc", "--vary", "all-R,k1,k2", "--rays",
                                    "20000", "--iterations", "1000000", "--json", "-o", path],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   env=program.environment())
        wait_for_work(process, 1.2)  # rays are ready by then
        process.send_signal(signal.SIGINT)
        answer, error = process.communicate()
        row = json.loads(answer)["rows"][0]
        with open(path, encoding="utf-8") as file:
            text = file.read()
        checks.check(process.returncode == 1 and row["status"] == "interrupted" and
                     row["merit_after"] < row["merit_before"] and b"interrupted after" in error and
                     "note        interrupted after" in text, f"a lens: {row}, {error!r}")


def check_interrupted_search(checks, program):
    """One that is gone on from its state has the bytes of one that was not interrupted."""
    asked = ["optimize", "double-gauss", "--vary", "R1..R11", "--goals", "poly,efl=100", "--rays",
             "60", "--global", "30", "--spread", "0.6", "--seed", "1", "--csv"]
    with tempfile.TemporaryDirectory() as folder:
        state = ["--state", os.path.join(folder, "search.state")]
        process = subprocess.Popen(program.command + asked + state, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, env=program.environment())
        wait_for_work(process, 0.25)
        process.send_signal(signal.SIGINT)
        answer, error = process.communicate()
        checks.check(process.returncode == 1 and b",interrupted," in answer and
                     b"of 30 starts: the best so far, incomplete" in error,
                     f"a search: {answer!r}, {error!r}")
        resumed = program.run(*asked, *state, "--threads", "2")
        checks.check(resumed.returncode == 0 and resumed.stdout == program.run(*asked).stdout,
                     f"a search, gone on from: {resumed.stdout!r}")


def check_interrupted_fit(checks, program):
    """A prescription of very many parts, each iteration of which takes them cubed, is left as it is
    by then, and says so."""
    lens = "lens stack\nwavelength d\nobject inf\naperture epd 5\n" + "".join(
        f"surface {1000 + i} 0.5 1.5/60 20\nsurface {-1000 - i} 0.5 air 20\n" for i in range(400))
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "stack.lens")
        with open(path, "w", encoding="utf-8") as file:
            file.write(lens)
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        process = subprocess.Popen(program.command + ["fit", path, "--prescription", "efl=50",
                                                      "--vary", "all-R", "--json"],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   env=program.environment())
        wait_for_rows(process)
        time.sleep(0.4)
        wait_for_rows(process)  # the second program, by now
        process.send_signal(signal.SIGINT)
        answer, error = process.communicate()
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if b"needs the solver Ceres" in error:
        return
    checks.check(process.returncode == 1 and b'"status":"stopped"' in answer and
                 after.ru_utime - before.ru_utime < 3, f"a fit: {answer!r}, {error!r}")


def check_interrupted_trials(checks, program):
    """What there is by then comes at once, or the reason for nothing; all would take long."""
    large = ["--rays", "20000"]
    cases = ((["--trials", "1e8"], True, "of 100000000 trials: what they say so far, incomplete"),
             (["--trials", "1e8", "--show", "trials"], True, "of 100000000 trials: those so far"),
             (["--show", "sensitivity", *large], True, "of 78 errors: those so far"),
             (["--show", "inverse", "--drop", "5um", *large], False, "before the tolerances were"),
             (["--show", "offenders", *large], False, "before all pairs of errors"),
             (["--method", "differential", *large], False, "before all pairs of errors"))
    processes = [subprocess.Popen([*program.command, "tolerance", "double-gauss", "--grade",
                                   "precision", "--csv", *asked], stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, env=program.environment())
                 for asked, _, _ in cases]
    began = interrupt_amid(processes)
    for process, (asked, has_rows, said) in zip(processes, cases):
        answer, error = process.communicate()
        if b"interrupted before rays were ready" in error:  # on a machine that is busy
            said, has_rows = "interrupted", False
        checks.check(process.returncode == 1 and said.encode() in error and
                     bool(answer) == has_rows, f"{asked}: {answer[-300:]!r}, {error!r}")
    checks.check(time.perf_counter() - began < 10, "trials: they do not end")


def check_interrupted_picture(checks, program):
    """In the middle of a tile whose rays would take minutes, by Ctrl-C or by its own clock."""
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "ball.scene"), "w", encoding="ascii") as file:
            file.write("camera at=0,0,3 look=0,0,0 focus=3\nmaterial grey lambert colour=0.5\n"
                       "light sky uniform luminance=1000\nsphere radius=0.5 material=grey\n"
                       "plane at=0,-1,0 normal=0,1,0 material=grey\n")
        words = ["render", "ball.scene", "--lens", "double-gauss-50", "--size", "16x16",
                 "--bounces", "16", "-t", "10", "--samples", str(1 << 20), "-o"]
        cases = ((["whole.pfm"], "incomplete, and black"), (["p.part"], "0 of 2 tiles"),
                 (["e.pfm", "--error", "1e-4"], "incomplete, and black"),
                 (["blur.pfm"], "incomplete, and black"))
        chart = ["render", "chart:star", "-s", "1m", "-N", "16", *words[2:6], *words[8:]]
        processes = [subprocess.Popen([*program.command, *(chart if "blur" in asked[0] else words),
                                       *asked], cwd=folder, stderr=subprocess.PIPE,
                                      env=program.environment()) for asked, _ in cases]
        began = interrupt_amid(processes)
        for process, (asked, said) in zip(processes, cases):
            error = process.communicate()[1].decode()
            checks.check(process.returncode == 1 and said in error and "no light" not in error,
                         f"a picture {asked}: {error!r}")
        timed = subprocess.run([*program.command, *words, "timed.pfm", "--seconds", "0.2"],
                               cwd=folder, stderr=subprocess.PIPE, env=program.environment())
        checks.check(timed.returncode == 0 and b"in the time given" in timed.stderr,
                     f"a picture in time: {timed.stderr!r}")
        checks.check(time.perf_counter() - began < 10, "pictures: they do not end")


def check_report(checks, program):
    """Ctrl-C ends a report, which is nothing without its parts: no file, and status 1."""
    with tempfile.TemporaryDirectory() as folder:
        process = subprocess.Popen(program.command + ["report", "nikkor-z-14-24", "-o", "r.html"],
                                   cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   env=program.environment())
        wait_for_rows(process)
        process.send_signal(signal.SIGINT)
        _, error = process.communicate()
        checks.check(process.returncode == 1 and b"interrupted: no report" in error and
                     os.listdir(folder) == [],
                     f"report: {process.returncode}, {error!r}, {os.listdir(folder)}")


def check_picture(checks, program):
    """The bytes of a picture are for files and pipes."""
    words = ["render", "chart:edge", "--lens", "double-gauss", "-s", "1m", "--size", "8x8"]
    shown, said, status = on_terminal(program, words, 80)
    checks.check(status == 2 and shown == "" and "a terminal shows no such files" in said,
                 f"a picture on a terminal: {status}, {shown[:40]!r}, {said!r}")


def check_broken_off(checks, program):
    """What fails between rows leaves a complete answer, in which a row has the reason."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "rows.csv")
        with open(path, "w") as file:
            file.write("f,N,s,note\n50,4,3,a\n50,4,x,b\n50,4,2,c\n")
        for words, name in ((["-f", "50", "-N", "4", "-s", "3,0.01,4", "--fail-fast"], "sweep"),
                            (["--batch", path, "--fail-fast"], "batch"),
                            (["-f", "100", "-N", "8", "--near", "24cm", "--far", "40cm", "--tube",
                              "50", "--stack"], "stack")):
            answers = {form: program.run("dof", *words, "--format", form)
                       for form in ("json", "html", "markdown", "text", "jsonl", "csv")}
            for form, result in answers.items():
                checks.check(result.returncode in (1, 3) and result.stderr != b"",
                             f"{name} {form}: status {result.returncode}")
            rows = json.loads(answers["json"].stdout)["rows"]
            lines = answers["jsonl"].stdout.decode().split("\n")[:-1]
            checks.check(len(rows) > 1 and "near_m" in rows[0] and "error" not in rows[-2] and
                         rows[-1]["error"] and rows[-1]["near_m"] is None, f"{name}: {rows[-2:]}")
            checks.check([json.loads(line) for line in lines] == rows, f"{name}: jsonl")
            checks.check(name != "batch" or rows[-1]["note"] == "b", f"{name}: {rows[-1]}")
            for form in ("html", "markdown", "text"):
                text = answers[form].stdout.decode()
                ends = text.endswith("</body>\n</html>\n") if form == "html" else "assuming" in text
                checks.check(ends and "error" in text, f"{name} {form}: {text[-300:]}")
            checks.check(len(answers["csv"].stdout.split(b"\n")) in (len(rows) + 1, len(rows) + 2),
                         f"{name} csv: {answers['csv'].stdout}")


def check_pager(checks, program):
    """Help on a terminal goes through the pager, which may be none, missing or left early."""
    whole = program.run("dof", "--help").stdout.decode()
    number = {"TERM": "xterm", "LENSCALC_PAGER": "sed s/^/:/"}
    cases = ((["dof", "--help"], number, "".join(f":{line}\n" for line in whole.split("\n")[:-1])),
             (["help", "dof"], {**number, "LENSCALC_PAGER": "head -n 1"}, whole.split("\n")[0] + "\n"),
             (["dof", "--help"], {"TERM": "xterm", "LENSCALC_PAGER": "", "PAGER": "sed d"}, whole),
             (["dof", "--help"], {"TERM": "xterm", "PAGER": "cat"}, whole),
             (["dof", "--help"], {"TERM": "xterm", "PAGER": "no-such-pager 2>/dev/null"}, whole),
             (["dof", "--help"], {**number, "TERM": "dumb"}, whole),
             (["dof", "-h"], number, program.run("dof", "-h").stdout.decode()))
    for words, variables, expected in cases:
        shown, _, status = on_terminal(program, words, 80, **variables)
        checks.check(status == 0 and shown == expected, f"pager {words} {variables}: {shown[:200]!r}")


def main():
    # jobs in the background of a shell ignore Ctrl-C, and what they start does too
    signal.signal(signal.SIGINT, signal.default_int_handler)
    program = Program(sys.argv[1])
    checks = Checks()
    on_terminals = (check_pager, check_width, check_blocks, check_color, check_progress, check_printed_files)
    for check in (check_help, check_escapes, check_interrupted, check_report, check_picture,
                  check_broken_off, *(on_terminals if has_terminals() else ())):
        check(checks, program)
    checks.finish()


main()
