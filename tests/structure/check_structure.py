#!/usr/bin/env python3
"""tests/structure/check_structure.py - rules of the source tree: check_structure.py BUILD_DIR

The layer table, what the numeric folders may not call, no writable data in any object, first
lines, headers that compile alone, sizes of functions, files and lines, how much one function
decides and takes, no options below cli, no circles between files, no public name that nobody uses, and words that do not
belong into the repository. check_rules.py shows of each rule that it fails where it is broken.
"""
# SPDX-License-Identifier: MIT

import functools
import glob
import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import ROOT, Checks

# Folder -> folders it may include besides itself; folders inside it are of its layer.
LAYERS = {
    "base": [],
    "light": ["base"],
    "scene": ["base", "light"],
    "report": ["base"],
    "photo": ["base"],
    "optics": ["base"],
    "trace": ["base", "optics"],
    "data": ["base", "optics", "photo"],
    "file": ["base", "light", "scene", "optics", "data"],
    "exchange": ["base", "optics", "data", "file"],
    "analysis": ["base", "optics", "trace", "photo"],
    "design": ["base", "optics", "trace", "analysis", "photo"],
    "camera": ["base", "light", "scene", "optics", "trace", "analysis", "photo", "file"],
    "tone": ["base", "light", "camera"],
    "draw": ["base", "report", "photo", "optics", "analysis", "design"],
    "cli": ["base", "light", "scene", "report", "photo", "optics", "trace", "data", "file",
            "exchange", "analysis", "design", "camera", "tone", "draw"],
    "commands": None,  # everything
    "": None,          # main.c
}
# What knows options; the folders below it name quantities, in braces, see base/error.h.
OF_OPTIONS = ("cli", "commands", "")
OPTION = re.compile(r"--[a-z%]")
NAME = re.compile(r"\{(?:the )?([A-Za-z][A-Za-z0-9 -]*)\}")
FAILURE = re.compile(r"\b(?:fail|fail_at|error_prefix|error_hint)\(([^\";]*"
                     r"\"(?:\\.|[^\"\\\n])*\"(?:[\s\\]*\"(?:\\.|[^\"\\\n])*\")*)")
NUMERIC = ("base", "light", "scene", "photo", "optics", "trace", "analysis", "design", "camera",
           "tone")
# Words no numeric source may use; stdio only formats into buffers there. What asks the processor
# anew costs every start, see base/processor.h.
FORBIDDEN_CALLS = re.compile(
    r"(?<![\w.>])(fopen|fdopen|freopen|fread|fwrite|fgets|fputs|fputc|putc|putchar|puts|printf|"
    r"fprintf|vprintf|vfprintf|sprintf|scanf|sscanf|fscanf|perror|open|read|write|exit|_exit|"
    r"abort|getenv|setlocale|signal|system|fork|__builtin_cpu_supports)\s*\(|"
    r"\b(stdin|stdout|stderr|FILE)\b")
ALLOWED_CALLS = {"base/arena.c": {"write", "_exit"}, "base/processor.h": {"__builtin_cpu_supports"}}
# What gcc and clang add to C17, and what of it src/README says is used, with the files of the rare
# ones.
EXTENSIONS = re.compile(r"__attribute__\(\((\w+)|(__builtin_\w+|__int128|__typeof__|__asm__|\btypeof|"
                        r"\basm|__thread|__extension__|\balloca)\b")
USED_EXTENSIONS = {"format": None, "noinline": None, "always_inline": None, "target": None,
                   "vector_size": "optics/paraxial.c", "__builtin_fma": "optics/",
                   "__builtin_clzll": "base/", "__builtin_ctzll": "base/",
                   "__builtin_bswap64": "base/", "__int128": "base/", "__extension__": "base/",
                   "__builtin_cpu_supports": "base/"}
# Object -> symbols that may be writable data: none. Const tables of pointers lie in .data.rel.ro,
# which is read-only once the program is loaded; nm calls it "d", objdump names the section.
WRITABLE = {
    # what the handler of a signal notes: C has no other way (C17 7.14.1.1)
    "cli/interrupt.o": {"came", "arrived", "watcher", "is_noticed", "phase", "is_taken"},
    # the libraries' own: the constructor of C++'s streams, where an unwinding exception looks, and
    # Eigen's names for the end of an array
    "design/solver/solver_ceres.o": {"_ZStL8__ioinit", "DW.ref.__gxx_personality_v0",
                              "DW.ref._ZTISt9exception", "DW.ref._ZTISt9bad_alloc",
                              "_ZN5EigenL4lastE",
                              "_ZN5EigenL6lastp1E", "_ZN5EigenL3allE"},
}
# The one source in C++; what it may call of stdio only formats into buffers.
CXX_SOURCES = ["src/design/solver/solver_ceres.cc"]
# of code lines, which are neither blank nor comment alone: nobody is to save explanations; columns
LONGEST_FUNCTION, LONGEST_FILE, LONGEST_LINE = 80, 600, 100
MOST_COMPLEX = 20  # McCabe's number as pmccabe counts it, a switch as one decision
MOST_PARAMETERS = 8  # of a public function
# The table of commands, which those of them that tell what there is are in.
OPEN_TABLES = {"commands", "command_find"}
# Public names that only tests use, with the reason; those of PUBLIC_FOLDERS need none.
PUBLIC_FOLDERS = ("photo",)  # formulas, complete whether a command asks for them or not
FOR_TESTS = {
    # formulas that are tested where their numbers come out, before others use them up
    "text_distance": "edit distance, by hand",
    "air_refractivity": "tables of air",
    "irregularity_height": "a map of it has the span that is said",
    "rays_best_focus": "lines given as numbers",
    "aim_ray": "one ray, against longer arithmetic",
    "thick_residuals": "the solver calls it by its pointer; its derivatives",
    # derivatives of everything by everything, which the optimiser stands on
    "merit_bundle_start": "where 113 bits begin",
    "merit_mtf_look": "what contrasts are by rays",
    "derivative_layout": "", "derivative_sweep": "", "tangent_trace": "",
    # every set of instructions gives the same bits
    "instruction_set_name": "", "instruction_set_works": "",
    "first_order_compute_portable": "", "paraxial_trace_portable": "",
    # what photographs stand on
    "image_file_bytes": "", "image_file_parse": "", "image_file_read": "", "image_file_types": "",
    "srgb_encoded": "",
    "blades_area": "the opening of an iris in closed form",
    "blades_aperture": "its shape by itself",
    "fft_has": "which lengths there are", "fft_transform": "lines, with every set of instructions",
    # what divided runs stand on
    "digest_add": "", "digest_begin": "", "digest_end": "", "digest_item": "",
    "part_parse": "", "part_range": "", "part_read": "", "part_write": "", "parts_order": "",
    # tolerances, which trials stand on
    "distribution_words": "", "spread_of": "", "spread_quantile": "", "spread_variance": "",
    "tolerances_of": "",
    "tally_histogram": "",
    "illuminant_words": "every one of them has a spectrum",
    # what there is to try
    "foreign_formats": "the fuzzer's list of formats",
}
# Sources that are one table or one idea and may be longer, with the reason.
LONG_FILES = {}
# What a text is to hold before a pattern, which is slow, is tried on it: the pattern, None for itself.
FORBIDDEN_WORDS = {mark: re.compile(pattern or re.escape(mark), re.I) for mark, pattern in {
    "session": r"\bsessions?\b", "issue ": r"\bissue #?\d|\bissue #", "/work/": None, "/tmp/": None,
    "../shared": None, "deb.debian.org": None, "pypi.org": None, "pythonhosted": None,
    "crates.io": None, "npmjs": None, "proxy.golang": None}.items()}
# Where a word has another meaning, or is needed.
WORDS_ALLOWED = {
    "tests": re.compile(r"/tmp/|\.\./shared"),
    ".ci": re.compile(r"/tmp/"),
}
STRICT = ["-std=c17", "-D_POSIX_C_SOURCE=200809L", "-Wall", "-Wextra", "-Wconversion", "-Wshadow",
          "-Wstrict-prototypes", "-pedantic", "-Werror", "-Isrc"]


def read(path):
    with open(path, encoding="utf-8", errors="surrogateescape") as file:
        return file.read()


@functools.lru_cache(2)  # several rules look at each text in turn
def blank_comments(text):
    """The text with comments and the content of literals blanked, lines kept."""
    token = re.compile(r"/\*.*?\*/|//[^\n]*|\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])*'", re.S)

    def blank(match):
        found = match.group()
        if found[0] in "\"'":
            return found[0] + re.sub(r"[^\n]", " ", found[1:-1]) + found[0]
        return re.sub(r"[^\n]", " ", found)
    return token.sub(blank, text)


def literals_of(text):
    """(line, content) of each string, those that the compiler joins as one."""
    token = re.compile(r"/\*.*?\*/|//[^\n]*|'(?:\\.|[^'\\\n])*'|"
                       r"(\"(?:\\.|[^\"\\\n])*\"(?:\s*\"(?:\\.|[^\"\\\n])*\")*)", re.S)
    for match in token.finditer(text):
        if match[1] is not None:
            parts = re.findall(r"\"((?:\\.|[^\"\\\n])*)\"", match[1])
            yield text.count("\n", 0, match.start()) + 1, "".join(parts)


def functions_of(text):
    """(name, line, code lines) of each function of clang-formatted code."""
    lines = blank_comments(text).split("\n")
    start = None
    for number, line in enumerate(lines):
        if line == "{":
            start = number
        elif line == "}" and start is not None:
            head = start - 1
            while head > 0 and lines[head - 1].strip() not in ("", "}", "};") and \
                    not lines[head - 1].startswith("#"):
                head -= 1
            names = re.findall(r"(\w+)\s*\(", " ".join(lines[head:start]))
            code = sum(1 for body in lines[start + 1:number] if body.strip())
            yield names[0] if names else "?", start + 1, code
            start = None


def layer_of(inside):
    """The layer of a path in src: its outermost folder."""
    return inside.split("/")[0] if "/" in inside else ""


def check_includes(checks, path, text):
    inside = os.path.relpath(path, "src")
    folder = layer_of(inside)
    if not checks.check(folder in LAYERS, f"{path}: folder '{folder}' is not in the layer table"):
        return
    allowed = LAYERS[folder]
    for number, line in enumerate(text.split("\n"), 1):
        include = re.match(r'\s*#\s*include\s*"([^"]+)"', line)
        if include is None:
            continue
        target = include[1]
        checks.check(os.path.exists(os.path.join("src", target)),
                     f"{path}:{number}: includes \"{target}\", which is not a path in src")
        wanted = layer_of(target)
        checks.check(allowed is None or wanted == folder or wanted in allowed,
                     f"{path}:{number}: {folder} may not include {target}")


def check_calls(checks, path, text):
    inside = os.path.relpath(path, "src")
    if layer_of(inside) not in NUMERIC:
        return
    found, plain = [], blank_comments(text)
    for match in FORBIDDEN_CALLS.finditer(plain):
        word = match[1] or match[2]
        if word not in ALLOWED_CALLS.get(inside, ()):
            number = plain.count("\n", 0, match.start()) + 1
            found.append(f"{path}:{number}: '{word}' in a numeric folder")
    checks.check(not found, "; ".join(found[:5]))


def check_extensions(checks, path, text):
    inside, plain = os.path.relpath(path, "src"), blank_comments(text)
    for match in EXTENSIONS.finditer(plain):
        word = match[1] or match[2]
        place = USED_EXTENSIONS.get(word, "nowhere")
        checks.check(place is None or inside.startswith(place),
                     f"{path}:{plain.count(chr(10), 0, match.start()) + 1}: {word} is no C17, "
                     "and not used here")


def check_options(checks, sources):
    """
    No option is spelt below cli, and every quantity named there is one that an option gives;
    commands leave room in their errors for the column of a batch.
    """
    texts = {path: read(path) for path in sources}
    known = set()
    for path, text in texts.items():
        if layer_of(os.path.relpath(path, "src")) in OF_OPTIONS:
            known.update(re.findall(r'\.quantity = "([^"]*)"', text))
            known.update(name.replace("-", " ")
                         for name in re.findall(r'\.name = "([a-z-]+)"', text))
    for path, text in texts.items():
        folder = layer_of(os.path.relpath(path, "src"))
        for match in FAILURE.finditer(text) if folder == "commands" else ():
            own = re.sub(r'lenscalc [a-z]+ [^"]*', "", match[1])  # what to ask another command
            checks.check(not re.search(r"(?<!\{)--[a-z%]", own),
                         f"{path}:{text.count(chr(10), 0, match.start()) + 1}: an error names an "
                         "option without braces, so that a batch cannot name its column")
        if folder in OF_OPTIONS:
            continue
        for line, content in literals_of(text):
            checks.check(OPTION.search(content) is None,
                         f"{path}:{line}: spells an option: \"{content[:60]}\"")
            for name in NAME.findall(content):
                checks.check(name in known,
                             f"{path}:{line}: names {{{name}}}, which no option gives")


def check_head(checks, path, text):
    lines = text.split("\n")
    # sources name themselves from src on, tests from the root
    own = os.path.relpath(path, "src") if path.startswith("src/") else path
    checks.check(lines[0].startswith(f"/* {own} - ") and lines[0].endswith(". */"),
                 f"{path}:1: does not begin '/* {own} - what it is. */'")
    checks.check(len(lines) > 1 and lines[1] == "/* SPDX-License-Identifier: MIT */",
                 f"{path}:2: no SPDX line")


def check_sizes(checks, path, text):
    limit = LONG_FILES.get(path, LONGEST_FILE)
    count = sum(1 for line in blank_comments(text).split("\n") if line.strip())
    checks.check(count <= limit, f"{path}: {count} code lines, at most {limit}")
    long_lines = [number for number, line in enumerate(text.split("\n"), 1)
                  if len(line) > LONGEST_LINE + (len(path) if number == 1 else 0)]
    checks.check(not long_lines, f"{path}:{long_lines[:3]}: over {LONGEST_LINE} columns")
    checks.check("\t" not in text and "\r" not in text and not re.search(r"[ \t]+$", text, re.M),
                 f"{path}: tabs, carriage returns or blanks at a line's end")
    checks.check(text.endswith("\n") and not text.endswith("\n\n"), f"{path}: its last line")
    if path.startswith("src/"):
        for name, line, code in functions_of(text):
            checks.check(code <= LONGEST_FUNCTION,
                         f"{path}:{line}: {name} has {code} code lines, at most {LONGEST_FUNCTION}")


def check_complexity(checks, sources):
    """Decisions of each function; pmccabe prints: modified, McCabe's ... path(line): name."""
    listing = subprocess.run(["pmccabe", *sources], capture_output=True, text=True).stdout
    checks.check(len(listing.splitlines()) >= len(sources) / 2, "pmccabe counted hardly a function")
    for line in listing.splitlines():
        count, *_, where = line.split("\t")
        place, name = where.split(": ")
        checks.check(int(count) <= MOST_COMPLEX,
                     f"{place}: {name} has complexity {count}, at most {MOST_COMPLEX}")


def choices_of(text):
    """(line, what is wrong) of conditional expressions that are hard to read: one within another,
    in its condition, its branches or their arguments, and one that is called or written to."""
    text = blank_comments(text)
    closed = re.compile(r"\s*(\(|[-+*/%&|^]?=(?!=)|<<=|>>=)")
    stack = [[0, False, False]]  # of each bracket: where, a branch is open, there was one before
    for match in re.finditer(r"[][(){}?,;]|(?<![=!<>])=(?!=)", text):
        sign, at = match.group(), match.start()
        if sign in "([{":
            stack.append([at, False, False])
        elif sign in ")]}" and len(stack) > 1:
            opened, branch, before = stack.pop()
            follows = closed.match(text, at + 1)
            if branch and sign == ")" and follows:
                if follows[1] == "(":
                    yield text.count("\n", 0, at) + 1, "a conditional expression is called"
                elif re.search(r"(^|[;{}&|(,])\s*\*$", text[:opened].rstrip(" ")[-40:]):
                    yield text.count("\n", 0, at) + 1, "a conditional expression is written to"
            stack[-1][2] = sign != "}" and (stack[-1][2] or branch or before)
        elif sign == "?":
            if stack[-1][2] or any(branch for _, branch, _ in stack):
                yield text.count("\n", 0, at) + 1, "a conditional expression within another"
            stack[-1][1] = True
        elif sign in ",;=":
            stack[-1][1:] = [False, False]


def check_choices(checks, path, text):
    for line, what in choices_of(text):
        checks.check(False, f"{path}:{line}: {what}")


def parameters_of(arguments):
    """How many there are between the brackets of a prototype."""
    depth = count = 0
    for letter in arguments:
        depth += (letter in "([") - (letter in ")]")
        count += letter == "," and depth == 0
    return count + 1


def check_parameters(checks, path, text):
    plain = re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", "", blank_comments(text), flags=re.M)
    for match in re.finditer(r"^[a-z][\w\s*]*?\b(\w+)\s*\(([^;{]*?)\)\s*"
                             r"(?:__attribute__\s*\(\(.*?\)\)\s*)?[;{]", plain, re.M | re.S):
        count = parameters_of(match[2])
        checks.check(count <= MOST_PARAMETERS,
                     f"{path}: {match[1]} has {count} parameters, at most {MOST_PARAMETERS}")


def links_of(build):
    """(symbol -> file that has it, file -> symbols it takes from others) of the objects in C."""
    objects = [os.path.join(build, name) for name in
               [*read(os.path.join(build, "objects")).split(), "main.o"]]
    solvers = [os.path.join(build, "design", "solver", name) for name in ("solver_engines.o", "solver_ceres.o")]
    listing = subprocess.run(["nm", "-A", "-g", *objects, *filter(os.path.exists, solvers)],
                             capture_output=True, text=True, check=True).stdout
    owner, wanted = {}, {}
    for line in listing.splitlines():
        entry = re.match(r"(.+)\.o:\S*\s+(\w)\s+(\S+)$", line)
        if entry is None or entry[3].startswith("_"):
            continue
        # a kernel is compiled once for each instruction set
        name = re.sub(r"(kernel\w*)_(sse2|avx2|avx512|few)$", r"\1", os.path.relpath(entry[1], build))
        if entry[2] == "U":
            wanted.setdefault(name, set()).add(entry[3])
        elif name != "design/solver/solver_ceres" and entry[2] in "TDBRC":
            owner.setdefault(entry[3], name)
    return owner, wanted


def circles_of(calls):
    """The files of each circle: those that reach each other."""
    reached = {}
    for start in calls:
        found, waiting = set(), [start]
        while waiting:
            for name in calls.get(waiting.pop(), ()):
                if name not in found:
                    found.add(name)
                    waiting.append(name)
        reached[start] = found
    circles = {tuple(sorted(other for other in reached[name] if name in reached.get(other, ())))
               for name in reached if name in reached[name]}
    return sorted(circles)


def check_links(checks, build):
    owner, wanted = links_of(build)
    calls = {name: {owner[symbol] for symbol in symbols - OPEN_TABLES
                    if owner.get(symbol, name) != name} for name, symbols in wanted.items()}
    for circle in circles_of(calls):
        checks.check(False, f"a circle of files that call each other: {', '.join(circle)}")
    tests = "\n".join(read(path) for path in glob.glob("tests/**/*.[ch]", recursive=True))
    used = {symbol for name, symbols in wanted.items() for symbol in symbols
            if owner.get(symbol) not in (None, name)}
    tested = set(re.findall(r"\w+", tests))
    for symbol, name in sorted(owner.items()):
        spared = layer_of(name) in PUBLIC_FOLDERS or symbol in FOR_TESTS
        checks.check(symbol in used | {"main"} or (spared and symbol in tested),
                     f"src/{name}.c: {symbol} is public, and no other file uses it" +
                     (" but tests" if symbol in tested else ""))


def compiled_first(sources):
    """The headers that a source includes before all else: the build has compiled them alone."""
    plain = (re.sub(r"/\*.*?\*/", "", read(path), flags=re.S) for path in sources)
    first = (re.match(r'\s*#include "([^"]+)"', text) for text in plain)
    return {"src/" + match[1] for match in first if match}


def check_headers(checks, headers):
    def compile_alone(header):
        compiler = os.environ.get("CC", "cc").split()
        return subprocess.run([*compiler, *STRICT, "-x", "c", "-fsyntax-only", "-"],
                              input=f'#include "{header[4:]}"\nextern int not_empty;\n',
                              capture_output=True, text=True)
    with ThreadPoolExecutor(2) as pool:
        for header, result in zip(headers, pool.map(compile_alone, headers)):
            checks.check(result.returncode == 0,
                         f"{header} does not compile alone: {result.stderr[:300]}")


def check_names(checks, paths):
    seen = {}
    for path in paths:
        name = os.path.basename(path)
        checks.check(name not in seen, f"{path}: the name is taken by {seen.get(name)}")
        seen[name] = path


def check_objects(checks, build):
    objects = sorted(glob.glob(os.path.join(build, "**", "*.o"), recursive=True))
    sources = {os.path.splitext(os.path.relpath(path, "src"))[0]
               for path in glob.glob("src/**/*.c*", recursive=True)} | {"lensdb"}
    objects = [path for path in objects
               if os.path.splitext(os.path.relpath(path, build))[0] in sources]
    checks.check(objects != [], f"no objects in {build}")
    listing = subprocess.run(["objdump", "-t", *objects], capture_output=True, text=True).stdout
    if "__asan_" in listing or "__tsan_" in listing:
        print("writable data: skipped, a sanitizer's objects have it")
        return
    found, name = {}, ""
    for line in listing.splitlines():
        if ":     file format" in line:
            name = os.path.relpath(line.split(":")[0], build)
        # address, 7 flags (O = an object), section, size, symbol
        entry = re.match(r"[0-9a-f]+ .{6}O (\S+)\s+[0-9a-f]+\s+(?:\.hidden )?(\S+)$", line)
        if entry is not None and re.match(r"\.t?(data|bss)|\*COM\*", entry[1]) and \
                not entry[1].startswith(".data.rel.ro") and \
                entry[2] not in WRITABLE.get(name, ()):
            found.setdefault(name, []).append(entry[2])
    for path in objects:
        name = os.path.relpath(path, build)
        checks.check(name not in found, f"{name}: writable data {found.get(name)}")


def check_words(checks):
    everything = [path for top in ("src", "man", "lensdb", "tests", ".ci")
                  for path in glob.glob(top + "/**/*", recursive=True)]
    for path in sorted(everything) + ["README", "Makefile", ".ci/run"]:
        # these two spell such words to look for them
        if not os.path.isfile(path) or "/corpus/" in path or \
                path.endswith((".pyc", ".out", "check_structure.py", "check_lensdb.py")):
            continue
        text = read(path)
        spared, lower = WORDS_ALLOWED.get(path.split("/")[0]), text.lower()
        found = [f"{path}:{text.count(chr(10), 0, match.start()) + 1}: '{match.group()}'"
                 for mark, pattern in FORBIDDEN_WORDS.items() if mark in lower
                 for match in pattern.finditer(text)
                 if not (spared and spared.fullmatch(match.group()))]
        checks.check(not found, f"word that does not belong here: {'; '.join(found[:4])}")


def check_tree(checks, build):
    """Every rule on the tree that is the working directory."""
    sources = sorted(glob.glob("src/**/*.[ch]", recursive=True) +
                     glob.glob("src/**/*.cc", recursive=True))
    programs = sorted(glob.glob("tests/**/*.[ch]", recursive=True))
    for path in sources + programs:
        text = read(path)
        check_head(checks, path, text)
        check_sizes(checks, path, text)
        if path in sources:
            check_includes(checks, path, text)
            check_calls(checks, path, text)
            check_extensions(checks, path, text)
            check_choices(checks, path, text)
        if path in sources and path.endswith(".h"):
            check_parameters(checks, path, text)
    check_options(checks, sources)
    check_complexity(checks, [path for path in sources if path.endswith(".c")])
    check_names(checks, sources)
    alone = compiled_first(path for path in sources if path.endswith(".c"))
    check_headers(checks, [path for path in sources if path.endswith(".h") and path not in alone])
    check_objects(checks, build)
    check_links(checks, build)
    check_words(checks)


def main():
    os.chdir(ROOT)
    checks = Checks()
    checks.check(glob.glob("src/**/*.c?*", recursive=True) == CXX_SOURCES, "sources in C++")
    checks.check(len(glob.glob("src/**/*.c", recursive=True)) > 40, "src is not here")
    check_tree(checks, os.path.abspath(sys.argv[1]))
    checks.finish()


if __name__ == "__main__":
    main()
