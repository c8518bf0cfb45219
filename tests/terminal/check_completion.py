#!/usr/bin/env python3
"""tests/terminal/check_completion.py - what TAB does in bash, zsh and fish, asked of the shells.

Each shell runs on a terminal with the script of `lenscalc completion`; a command line is typed, then
TAB, then a key that writes the line to a file. A shell that is not here is left out, and said so.
"""
# SPDX-License-Identifier: MIT

import os
import pty
import shutil
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks, Program, has_terminals

# What is typed behind "lenscalc ", and what TAB makes of it.
CASES = [
    ("hyp", "hyperfocal "),
    ("dof --foc", "dof --focal-length "),
    ("dof --model ex", "dof --model exact "),
    ("dof --model=ex", "dof --model=exact "),
    ("dof -f 50 --coc air", "dof -f 50 --coc airy "),
    ("exposure --film Ilford\\ Pan", "exposure --film Ilford\\ Pan\\ F\\ Plus "),
    ("exposure --film=Ilford\\ Pan", "exposure --film=Ilford\\ Pan\\ F\\ Plus "),
    ("exposure --film \"Ilford Pan", "exposure --film \"Ilford Pan F Plus\" "),
    ("exposure --scene star", "exposure --scene starlight-night "),
    ("exposure --filter wratten-12-", "exposure --filter wratten-12-tungsten "),
    ("fov --sensor nikon\\ z\\ 50i", "fov --sensor Nikon\\ Z\\ 50II "),
    ("fov --sensor=apS-C-n", "fov --sensor=aps-c-nikon "),
    ("dof --columns near_m,hyperfocal_", "dof --columns near_m,hyperfocal_m "),
    ("dof --columns=hyperfocal_", "dof --columns=hyperfocal_m "),
    ("draw nikkor-z-14-24 --position te", "draw nikkor-z-14-24 --position tele "),
    ("lens --lens nikkor-z-14-24 --position=te", "lens --lens nikkor-z-14-24 --position=tele "),
    ("lens double-gauss-5", "lens double-gauss-50 "),
    ("glass N-BK7HTi", "glass N-BK7HTi "),
    ("spot my", "spot my.lens "),
    ("draw -o m", "draw -o my.lens "),
    ("help unit", "help units "),
    ("list colum", "list columns "),
    ("list columns hyp", "list columns hyperfocal "),
    ("dof --no-such-option", "dof --no-such-option"),
]
START = {
    "bash": (["bash", "--norc", "--noprofile", "-i"],
             "set +o history; PS1='> '; bind 'set bell-style none'\n"
             "bind -x '\"\\C-g\": printf \"%s\\n\" \"$READLINE_LINE\" >> lines'\n"
             "source ./script\necho ready >> lines\n"),
    "zsh": (["zsh", "-f", "-i"],
            "PS1='> '; unsetopt beep; autoload -U compinit; compinit -u -D; zstyle ':completion:*' "
            "menu no\nshow() { print -r -- \"$BUFFER\" >> lines }; zle -N show; bindkey '^G' show\n"
            "mkdir own; cp script own/_lenscalc; fpath=(own $fpath); compinit -u -D\n"
            "echo ready >> lines\n"),
}


def lines_of(folder):
    try:
        with open(os.path.join(folder, "lines")) as file:
            return file.read().split("\n")[:-1]
    except FileNotFoundError:
        return []


def wait_for(folder, count, ours):
    """Until the file has so many lines; what the shell prints meanwhile is thrown away."""
    end = time.monotonic() + 30
    os.set_blocking(ours, False)
    while len(lines_of(folder)) < count and time.monotonic() < end:
        try:
            os.read(ours, 65536)
        except BlockingIOError:
            time.sleep(0.005)
        except OSError:
            break
    return lines_of(folder)[count - 1:count]


def read_until(ours, word):
    """What the shell prints, until the word is among it."""
    end, shown = time.monotonic() + 30, b""
    while word not in shown and time.monotonic() < end:
        try:
            shown += os.read(ours, 65536)
        except BlockingIOError:
            time.sleep(0.005)
        except OSError:
            break
    return shown


def ask_on_terminal(program, shell):
    """The lines after TAB, one a case; None where the shell did not answer."""
    with tempfile.TemporaryDirectory(prefix="lenscalc-tab-") as folder:
        with open(os.path.join(folder, "script"), "wb") as file:
            file.write(program.run("completion", shell).stdout)
        with open(os.path.join(folder, "my.lens"), "w") as file:
            file.write("lens mine\n")
        words, start = START[shell]
        ours, terminal = pty.openpty()
        process = subprocess.Popen(words, cwd=folder, stdin=terminal, stdout=terminal,
                                   stderr=terminal, start_new_session=True,
                                   env={**program.environment(), "TERM": "dumb",
                                        "HOME": folder, "LC_ALL": "C.UTF-8"})
        os.close(terminal)
        os.write(ours, start.encode())
        wait_for(folder, 1, ours)
        answers = []
        for number, (typed, _) in enumerate(CASES):
            os.write(ours, f"\x15lenscalc {typed}\t\x07".encode())
            answers.append((wait_for(folder, number + 2, ours) or [None])[0])
        # nothing is typed yet: all commands are shown
        os.write(ours, b"\x15lenscalc \t\t")
        shown = read_until(ours, b"wavefront")
        process.kill()
        process.wait()
        os.close(ours)
        return answers, shown


def commands_of(program):
    rows = program.run("list", "commands", "--columns", "command", "--csv").stdout.decode()
    return rows.split("\n")[1:-1]


def check_nothing_typed(checks, program):
    """Behind the name of the program: all commands."""
    offered = program.run("completion", "words", "--", "").stdout.decode()
    names = [line.split("\t")[0] for line in offered.split("\n")[:-1]]
    checks.check(sorted(names) == sorted(commands_of(program)) and len(names) > 30,
                 f"completion words -- '': {names}")


def check_on_terminal(checks, program, shell):
    answers, shown = ask_on_terminal(program, shell)
    checks.check(b"bracket" in shown and b"hyperfocal" in shown and b"wavefront" in shown,
                 f"{shell}: 'lenscalc ' TAB TAB shows {shown!r}")
    for (typed, expected), answer in zip(CASES, answers):
        checks.check(answer == "lenscalc " + expected,
                     f"{shell}: 'lenscalc {typed}' TAB gives {answer!r}, not '{expected}'")


def check_fish(checks, program):
    """fish says itself what TAB would offer."""
    with tempfile.TemporaryDirectory(prefix="lenscalc-tab-") as folder:
        with open(os.path.join(folder, "script"), "wb") as file:
            file.write(program.run("completion", "fish").stdout)
        with open(os.path.join(folder, "my.lens"), "w") as file:
            file.write("lens mine\n")
        asked = "source ./script\n" + "".join(
            "complete -C 'lenscalc " + typed.replace("\\", "\\\\") + "'\necho ==\n"
            for typed, _ in [*CASES, ("", "")])
        result = subprocess.run(["fish", "--no-config", "-c", asked], cwd=folder, timeout=60,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                env={**program.environment(), "HOME": folder,
                                     "LC_ALL": "C.UTF-8"})
    answers = result.stdout.decode().split("==\n")
    checks.check(result.stderr == b"" and len(answers) == len(CASES) + 2, f"fish: {result.stderr}")
    offered = {line.split("\t")[0] for line in answers[-2].split("\n")}
    checks.check(offered >= set(commands_of(program)), f"fish: 'lenscalc ' TAB offers {offered}")
    for (typed, expected), answer in zip(CASES, answers):
        last = expected.rstrip(" ").replace("\\ ", "\0").replace("Pan F Plus\"", "Pan\0F\0Plus")
        last = last.replace("\"Ilford ", "Ilford\0").split(" ")[-1].replace("\0", " ")
        offered = [line.split("\t")[0] for line in answer.split("\n")]
        wanted = not typed.endswith("no-such-option")
        checks.check((last in offered) == wanted,
                     f"fish: 'lenscalc {typed}' TAB offers {offered}, '{last}' expected: {wanted}")


def main():
    checks, program = Checks(), Program(sys.argv[1])
    check_nothing_typed(checks, program)
    here = [shell for shell in START if shutil.which(shell) and has_terminals()]
    with ThreadPoolExecutor() as pool:
        waiting = [pool.submit(check_on_terminal, checks, program, shell) for shell in here]
        if shutil.which("fish"):
            waiting.append(pool.submit(check_fish, checks, program))
        for one in waiting:
            one.result()
    for shell in ("bash", "zsh", "fish"):
        if not shutil.which(shell):
            print(f"{shell} is not here: skipped")
    checks.finish()


main()
