#!/usr/bin/env python3
"""tests/documents/check_documents.py BUILD [long] - every example runs, pages and program agree.

What takes long, of blocks of examples and of the examples of --help, is left out, and alone what
`long` runs.

Conventions of README and man/*.[157]:
- Example: in README a fenced (```) or indented (4 blanks) block, in a page what stands between .EX
  and .EE. A line "$ command" is run by sh in an empty folder (one folder a block, so that a later
  command finds an earlier one's files) with lenscalc first in PATH; the lines up to the next "$ "
  or the end of the block are its exact standard output. A command goes on in the lines behind it
  that begin with "> ", the shell's second prompt, which is taken away, and where it ends in " \\".
  A block without "$ " is not run. Exit status and standard error are not compared: show them with
  `; echo $?` and `2>&1`. The same commands from an empty folder on are run once, wherever they
  stand.
- A command that starts with "make" or "sudo" is shown, never run.
- `lenscalc bench` prints times, and rows for the instructions of the machine: the form of its
  output is compared, see form_of.
- Options: in a page's section OPTIONS each option is a .TP followed by a line that names it:
  .BR \\-f ", " \\-\\-focal\\-length ... or \\fB\\-f\\fR, \\fB\\-\\-focal\\-length\\fR .... They must
  be those of `lenscalc list options --kind COMMAND --tsv`; lenscalc(1) has the common ones, and may
  name them in a section COMMON OPTIONS too.
- Pages: every command has man/lenscalc-COMMAND.1; those of the group "tool" (help, completion) may
  stand in lenscalc(1) alone.
- Keywords: lenscalc-convert.1 has the tables of `lenscalc list keywords`, see keyword_tables.py.
- Bibliography: lenscalc.7 has a section BIBLIOGRAPHY; a source is a .TP followed by a line that
  begins with its key in brackets: .B [Ray02]. Every [Key] cited in src, man and lensdb (a capital,
  letters, then two digits of a year and perhaps a letter) must be there.
"""
# SPDX-License-Identifier: MIT

import csv
import difflib
import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import keyword_tables
from harness import NEED_SOLVER, ROOT, Checks, Program

KEY = re.compile(r"\[([A-Z][A-Za-z]*[0-9]{2}[a-z]?)\]")
NOT_RUN = ("make", "sudo")
TOOLS = ("jq", "parallel")  # that a machine may lack
# pictures of full size, searches, comparisons, and drawings of a hundred answers
LONG = re.compile(r"lenscalc (render chart:(?!.*--size)|optimize .*(--start|--global)|bench|report|"
                  r"(energy|psf) questar-35 .*--plot|mtf .*--defocus .*--plot)", re.S)


def unescape(line):
    """A line of roff as it is printed."""
    line = re.sub(r"\\f(\[[^]]*\]|\(..|.)", "", line)
    for escape, text in (("\\-", "-"), ("\\(aq", "'"), ("\\(dq", '"'), ("\\(ga", "`"),
                         ("\\(ha", "^"), ("\\(ti", "~"), ("\\(bs", "\\"), ("\\(rs", "\\"),
                         ("\\&", ""), ("\\[aq]", "'"), ("\\[dq]", '"'), ("\\[ti]", "~"),
                         ("\\[ha]", "^"), ("\\[rs]", "\\"), ("\\ ", " "), ("\\(mc", "\u00b5")):
        line = line.replace(escape, text)
    return line.replace("\\e", "\\").replace("\\\\", "\\")


def page_blocks(text):
    """(line number, lines) of each .EX block of a page."""
    block, start = None, 0
    for number, line in enumerate(text.split("\n"), 1):
        if line.startswith(".EX"):
            block, start = [], number + 1
        elif line.startswith(".EE") and block is not None:
            yield start, block
            block = None
        elif block is not None and not line.startswith('.\\"'):
            block.append(unescape(line))


def readme_blocks(text):
    """(line number, lines) of each fenced or indented block."""
    block, start, fenced = [], 0, False
    for number, line in enumerate(text.split("\n") + [""], 1):
        if line.startswith("```"):
            if fenced:
                yield start, block
            fenced, block, start = not fenced, [], number + 1
        elif fenced:
            block.append(line)
        elif line.startswith("    ") or (block and not line.strip()):
            if not block:
                start = number
            block.append(line[4:])
        elif block:
            while block and not block[-1]:
                block.pop()
            yield start, block
            block = []


def examples_of(start, block):
    """(line number, command, expected output) of each command of a block."""
    found, asked, going_on = [], False, False
    for number, line in enumerate(block, start):
        asked = going_on or (asked and line.startswith("> ")) or line.startswith("$ ")
        if going_on or (asked and line.startswith("> ")):
            found[-1][1] += "\n" + (line[2:] if line.startswith("> ") else line)
        elif line.startswith("$ "):
            found.append([number, line[2:], []])
        elif found:
            found[-1][2].append(line)
        else:
            return []  # text, a file: no example
        going_on = asked and line.endswith("\\")
    for example in found:
        while example[2] and not example[2][-1]:
            example[2].pop()
    return found


def form_of(lines):
    """What of an answer of bench is the same on every machine: its words, no numbers, no times."""
    lines = "\n".join(lines).split("\nwarning: the machine is busy")[0].split("\n")
    numbers = re.compile(r"(?<![\w.])[-+]?[0-9][0-9.]*(e[-+]?[0-9]+)?(?![\w.])")
    which = re.compile("sse2|avx2|avx512|^verdict:")  # what there is, and which is quickest
    lines = [numbers.sub("", line) for line in lines if not which.search(line)]
    return [" ".join(re.sub(r"\b(yes|no|true|false)\b", "", line).split()) for line in lines]


def lacking(program, command):
    """What the command needs and is not here; what follows in its block may need its files."""
    needs = command.startswith(tuple(f"lenscalc {name}" for name in NEED_SOLVER))
    if needs and not program.has_solver():
        return "the solver"
    return next((tool for tool in TOOLS
                 if re.search(rf"(?<![\w-]){tool} ", command) and not shutil.which(tool)), None)


class Examples:
    """Runs examples; of each series of commands from an empty folder on the last result is kept."""

    def __init__(self, program, room):
        self.program, self.room, self.known = program, room, {}

    def run(self, commands):
        """(the result of the last command, did it make a file), each after those before it."""
        commands = tuple(commands)
        if commands not in self.known:
            if commands[:-1]:
                self.run(commands[:-1])
            folder = os.path.join(self.room, str(len(self.known)))
            if commands[:-1]:
                shutil.copytree(self.known[commands[:-1]][2], folder, symlinks=True)
            else:
                os.mkdir(folder)
            before = set(os.listdir(folder))
            result = self.program.shell(commands[-1], folder)
            self.known[commands] = result, set(os.listdir(folder)) != before, folder
        return self.known[commands][:2]


def check_examples(checks, examples, path, blocks, is_long):
    count, program = 0, examples.program
    for start, block in blocks:
        commands, found = [], examples_of(start, block)
        if is_long and not any(LONG.match(command) for _, command, _ in found):
            continue
        for number, command, expected in found:
            if command.split()[0] in NOT_RUN:
                continue
            count += 1
            lacks = lacking(program, command)
            if lacks:
                print(f"{path}:{number}: $ {command}: skipped, {lacks} is not here")
                break
            if not is_long and LONG.match(command):
                break
            commands.append(command)
            result = examples.run(commands)[0]
            actual = result.stdout.decode("utf-8", "replace").rstrip("\n").split("\n")
            actual = [] if actual == [""] else actual
            if command.startswith("lenscalc bench"):
                expected, actual = form_of(expected), form_of(actual)
            wanted = "\n".join(expected)
            difference = "" if "\n".join(actual) == wanted else "\n    ".join(
                list(difflib.unified_diff(expected, actual, "page", "program", lineterm="",
                                          n=0))[2:14])
            checks.check(difference == "" and "\n".join(actual) == wanted and
                         b"yntax error" not in result.stderr,
                         f"{path}:{number}: $ {command}\n    {difference}"
                         f"{result.stderr.decode('utf-8', 'replace')[:300]}")
    return count


def section_of(text, *names):
    """The lines of the sections with these names."""
    inside, lines = False, []
    for line in text.split("\n"):
        if line.startswith(".SH"):
            inside = line[3:].strip().strip('"').upper() in names
        elif inside:
            lines.append(line)
    return lines


def options_of(lines):
    """The options that .TP entries name: {"--focal-length"}; "-f" where there is no long name."""
    found = set()
    for tag, line in zip(lines, lines[1:]):
        if not tag.startswith((".TP", ".TQ")):
            continue
        plain = unescape(re.sub(r"^\.[BIR]+ ", "", line).replace('" "', " ").replace('"', ""))
        found.update(re.findall(r"(?<![\w-])--[a-z][a-z0-9-]*", plain))
    return found


def list_options(program, command):
    result = program.run("list", "options", "--kind", command, "--tsv")
    rows = list(csv.DictReader(result.stdout.decode().splitlines(), delimiter="\t"))
    return {row["option"] for row in rows if row["command"] == command}


def common_options(program, command):
    """What `COMMAND --help` shows under "Common options"."""
    text = program.run(command, "--help").stdout.decode()
    return set(re.findall(r"^ .{2,6}(--[a-z-]+)", text.partition("Common options")[2],
                          re.M))


def check_options(checks, program, commands, tools):
    common = common_options(program, commands[0])
    checks.check(len(common) > 10, f"common options in --help: {common}")
    main_page = "man/lenscalc.1"
    if checks.check(os.path.exists(main_page), f"{main_page} does not exist"):
        with open(main_page) as file:
            page = file.read()
        named = options_of(section_of(page, "OPTIONS", "COMMON OPTIONS"))
        checks.check(common - named == set(), f"{main_page}: does not name {common - named}")
        for command in commands:
            checks.check(re.search(rf"lenscalc(\\-|-){command}\b|\.BR? {command}\b", page),
                         f"{main_page}: does not name the command {command}")
    for command in commands:
        path = f"man/lenscalc-{command}.1"
        if command in tools and not os.path.exists(path):
            continue
        if not checks.check(os.path.exists(path), f"{path} does not exist"):
            continue
        with open(path) as file:
            page = file.read()
        own = list_options(program, command)
        named = options_of(section_of(page, "OPTIONS")) - (common - own)
        checks.check(own == named, f"{path}: OPTIONS lacks {sorted(own - named)}, has "
                                   f"{sorted(named - own)} that the command does not know")


def check_words(checks, program, commands):
    """The words of a choice, and the endings of lens files, stand in the pages as in --help."""
    def lacks(path, words):
        with open(path) as file:
            text = unescape(re.sub(r"\\f.", "", file.read()))
        return [word for word in words
                if not re.search(rf"(?<![\w-]){re.escape(word)}(?![\w-])", text)]
    main_page = "man/lenscalc.1"
    shown = {command: program.run(command, "--help").stdout.decode() for command in commands}
    words = {main_page: set()}
    for command in commands:
        own, _, common = shown[command].partition("Common options")
        for path, text in ((f"man/lenscalc-{command}.1", own), (main_page, common)):
            words.setdefault(path, set()).update(re.findall(r"^ {32}(\S+) ", text, re.M))
    for path in (path for path in words if os.path.exists(path)):
        missing = lacks(path, sorted(words[path]))
        checks.check(not missing, f"{path}: lacks {missing}, which --help lists")
    endings = re.search(r"--output FILE[^(]*\(([^)]*)\)", shown["convert"])
    endings = re.findall(r"\.[a-z]+", endings.group(1)) if endings else []
    checks.check(len(endings) > 4, f"convert --help lists the endings {endings}")
    for path in ("man/lenscalc-convert.1", "README"):
        missing = lacks(path, endings)
        checks.check(not missing, f"{path}: lacks the endings {missing} of lens files")


def check_help(checks, examples, commands, is_long):
    """The examples that --help shows run with status 0, and print or make something."""
    program = examples.program
    for command in commands:
        text = program.run(command, "--help").stdout.decode()
        block = text.partition("Examples:\n")[2].partition("\n\n")[0]
        block = re.sub(r" \\\n +", " ", block)  # a long one goes on in the next line
        found = [line.strip() for line in block.split("\n") if line.startswith("  lenscalc ")]
        checks.check(found, f"{command} --help has no examples")
        found = [one for one in found if not lacking(program, one)]
        for number, example in enumerate(found):
            if bool(LONG.match(example)) != is_long:
                continue
            result, made = examples.run([example])
            if result.returncode != 0:  # it reads what an earlier one made
                result, made = examples.run(found[:number + 1])
            checks.check(result.returncode == 0 and (made or result.stdout != b""),
                         f"{command} --help: '{example}' ends with {result.returncode}: "
                         f"{result.stderr.decode()[:200]}")


def check_keys(checks):
    bibliography = "man/lenscalc.7"
    known = set()
    if os.path.exists(bibliography):
        with open(bibliography) as file:
            lines = section_of(file.read(), "BIBLIOGRAPHY")
        for tag, line in zip(lines, lines[1:]):
            if tag.startswith(".TP"):
                known.update(KEY.findall(re.sub(r"^\.[BIR]+ ", "", unescape(line)))[:1])
    checks.check(known != set(), f"{bibliography} has no BIBLIOGRAPHY with .TP and .B [Key]")
    for path in sorted(glob.glob("src/**/*.[ch]", recursive=True) + glob.glob("man/*.[157]") +
                       glob.glob("lensdb/**/*", recursive=True)):
        if os.path.isdir(path):
            continue
        with open(path, encoding="utf-8") as file:
            missing = sorted(set(KEY.findall(file.read())) - known)
        checks.check(not missing or known == set(), f"{path}: cites {missing}, not in "
                                                    f"{bibliography}")


def check_pages(checks):
    """mandoc has nothing to say of style; pages name each other, lenscalc(1) all of them."""
    pages = sorted(glob.glob("man/*.[157]"))
    if shutil.which("mandoc"):
        for page in pages:
            result = subprocess.run(["mandoc", "-T", "lint", "-W", "style", page],
                                    stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            checks.check(result.returncode == 0 and result.stdout == b"",
                         f"{page}: {result.stdout.decode()[:300]}(make accept breaks long lines)")
    else:
        print("mandoc is not here: skipped")
    there = {os.path.basename(page) for page in pages}
    for page in pages:
        with open(page, encoding="utf-8") as file:
            see_also = "\n".join(section_of(file.read(), "SEE ALSO"))
        named = {f"{unescape(name)}.{number}" for name, number in
                 re.findall(r"^\.BR (lenscalc\S*) \((\d)\)", see_also, re.M)}
        own = os.path.basename(page)
        wanted = there - {own} if own == "lenscalc.1" else {"lenscalc.1"}
        checks.check(wanted <= named, f"{page}: SEE ALSO lacks {sorted(wanted - named)}")
        checks.check(named <= there - {own}, f"{page}: SEE ALSO names {sorted(named - there)}")


def check_trade_names(checks):
    """lenscalc(1) lists the names of trade_aliases: "option (command)", then its other names."""
    with open("src/cli/question/trade_names.c", encoding="utf-8") as file:
        table = file.read().partition("trade_aliases[] = {")[2].partition("{NULL")[0]
    known, shown, option = set(), set(), ""
    for names, meant, command in re.findall(r'\{"([^"]+)",\s*"([^"]+)",\s*("[^"]+"|NULL),', table):
        where = "" if command == "NULL" else " (" + command.strip('"') + ")"
        known |= {(meant + where, name) for name in names.split()}
    with open("man/lenscalc.1", encoding="utf-8") as file:
        section = file.read().partition(".SS Other names of options\n")[2].partition("\n.SS")[0]
    for _, lines in page_blocks(section):
        for line in lines:
            option = line[:24].strip() or option
            shown |= {(option, name.strip().replace("-", ""))
                      for name in line[24:].split(",") if name.strip()}
    for entry in known ^ shown:
        checks.check(False, f"man/lenscalc.1, other names of options: {entry}")
    checks.check(len(known) > 50, f"trade_names.c: {len(known)} names found")


def check_keywords(checks, program):
    with open(keyword_tables.PAGE, encoding="utf-8") as file:
        text = file.read()
    wanted, kinds = keyword_tables.rewritten(program, text)
    checks.check(kinds == ["zmx", "seq", "len"], f"{keyword_tables.PAGE}: tables of {kinds}")
    checks.check(wanted == text, f"{keyword_tables.PAGE}: a table of keywords is not that of "
                                 "'lenscalc list keywords': make accept")


def main():
    os.chdir(ROOT)
    checks, program = Checks(), Program(sys.argv[1])
    rows = program.run("list", "commands", "--csv").stdout.decode().splitlines()
    commands = [row["command"] for row in csv.DictReader(rows)]
    tools = {row["command"] for row in csv.DictReader(rows) if row["group"] == "tool"}
    checks.check("dof" in commands, f"lenscalc list commands: {commands}")
    is_long = sys.argv[2:] == ["long"]
    with tempfile.TemporaryDirectory(prefix="lenscalc-doc-") as room:
        examples = Examples(program, room)
        if checks.check(os.path.exists("README"), "README does not exist"):
            with open("README", encoding="utf-8") as file:
                count = check_examples(checks, examples, "README", readme_blocks(file.read()),
                                       is_long)
            checks.check(count > 0 or is_long, "README has no example")
        for path in sorted(glob.glob("man/*.[157]")):
            with open(path, encoding="utf-8") as file:
                count = check_examples(checks, examples, path, page_blocks(file.read()), is_long)
            checks.check(count > 0 or is_long or not path.endswith(".1"), f"{path} has no example")
        check_help(checks, examples, commands, is_long)
    if not is_long:
        check_options(checks, program, commands, tools)
        check_words(checks, program, commands)
        check_keys(checks)
        check_keywords(checks, program)
        check_trade_names(checks)
        check_pages(checks)
    checks.finish()


if __name__ == "__main__":
    main()
