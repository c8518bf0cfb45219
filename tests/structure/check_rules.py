#!/usr/bin/env python3
"""tests/structure/check_rules.py - does each rule of check_structure.py fail where it is broken?

Makes a tiny tree that keeps all rules, in a temporary folder; breaks one rule at a time; and
expects exactly the failure that belongs to it.
"""
# SPDX-License-Identifier: MIT

import os
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import check_structure
from harness import Checks

SPDX = "/* SPDX-License-Identifier: MIT */\n"


def source(path, *parts):
    return f"/* {path} - of a tiny tree. */\n" + SPDX + "".join(parts)


def header(path, *parts):
    guard = path.upper().replace("/", "_").replace(".", "_")
    return source(path, f"#ifndef {guard}\n#define {guard}\n", *parts, "#endif\n")


def function(name, *lines, head="int {}(int a)"):
    return head.format(name) + "\n{\n" + "".join(f"    {line}\n" for line in lines) + "}\n"


# main -> ray -> number, and a formula that a test alone uses
TREE = {
    "base/number.h": header("base/number.h", "int number_next(int a);\n"),
    "base/number.c": source("base/number.c", '#include "base/number.h"\n',
                            function("number_next", "return a + 1;")),
    "trace/ray.h": header("trace/ray.h", "int ray_next(int a);\n"),
    "trace/ray.c": source("trace/ray.c", '#include "trace/ray.h"\n\n#include "base/number.h"\n',
                          function("ray_next", "return number_next(a);")),
    "photo/dof.h": header("photo/dof.h", "int dof_near(int a);\n"),
    "photo/dof.c": source("photo/dof.c", '#include "photo/dof.h"\n',
                          function("dof_near", "return a;")),
    "main.c": source("main.c", '#include "trace/ray.h"\n',
                     function("main", "return ray_next(0);", head="int {}(void)")),
    "../tests/unit/test_dof.c": "/* tests/unit/test_dof.c - of a tiny tree. */\n" + SPDX +
                                '#include "photo/dof.h"\nint near = sizeof dof_near(0);\n',
}


def add(path, text):
    """The tiny tree's file with more at its end."""
    return {path: TREE[path] + text}


def change(path, *pairs):
    """The tiny tree's file with the first of each pair replaced by the second."""
    text = TREE[path]
    for old, new in pairs:
        assert old in text
        text = text.replace(old, new)
    return {path: text}


MANY = ", ".join(f"int a{i}" for i in range(9))
CHOICES = [f"if (a == {i}) {{ return {i * i}; }}" for i in range(20)]
PRIVATE = "static inline int {}(int a)"
# what is broken -> the files that break it, and how the one failure begins
BROKEN = {
    "a folder without a layer": (
        {"optic/lens.c": source("optic/lens.c", "extern int not_empty;\n")},
        "src/optic/lens.c: folder 'optic' is not in the layer table"),
    "a higher layer": (
        change("base/number.c", ('number.h"\n', 'number.h"\n#include "trace/ray.h"\n')),
        "src/base/number.c:4: base may not include trace/ray.h"),
    "a path that is not there": (
        change("trace/ray.h", ("int ray", '#if 0\n#include "base/none.h"\n#endif\nint ray')),
        'src/trace/ray.h:6: includes "base/none.h", which is not a path in src'),
    "stdio in a numeric folder": (
        change("base/number.c", ("    return", '    puts("");\n    return'),
               ('number.h"\n', 'number.h"\n#include <stdio.h>\n')),
        "src/base/number.c:7: 'puts' in a numeric folder"),
    "a question that costs every start": (
        change("base/number.c", ("a + 1", 'a + __builtin_cpu_supports("avx2")')),
        "src/base/number.c:6: '__builtin_cpu_supports' in a numeric folder"),
    "an extension of C": (
        change("photo/dof.c", ("    return", "    __typeof__(a) b = a;\n    return")),
        "src/photo/dof.c:6: __typeof__ is no C17, and not used here"),
    "an extension in a file that has none": (
        change("photo/dof.c", ("return a", "return __builtin_ctzll(8ULL) + a")),
        "src/photo/dof.c:6: __builtin_ctzll is no C17, and not used here"),
    "an option below cli": (
        change("photo/dof.h",
               ("int dof", '#define DOF_ASKS "too wide: \\"less\\" " "--aperture"\nint dof')),
        'src/photo/dof.h:5: spells an option: "too wide: \\"less\\" --aperture"'),
    "an option of a name": (
        change("photo/dof.h", ("int dof", '#define DOF_ASKS "--%s is missing"\nint dof')),
        'src/photo/dof.h:5: spells an option: "--%s is missing"'),
    "a quantity that no option gives": (
        {**change("photo/dof.h", ("int dof", '#define DOF_ASKS "{the f-number} within {focal "'
                                             '"lenght}"\nint dof')),
         "cli/number_names.h": header("cli/number_names.h", '#define GIVES .quantity = "f-number", '
                                      '.name = "focal-length"\n')},
        "src/photo/dof.h:5: names {focal lenght}, which no option gives"),
    "an option that a batch cannot rename": (
        {"commands/number_asks.h": header(
            "commands/number_asks.h",
            '#define ASKS_FIRST fail(error, ERROR_USAGE, "{--near} wants " "{--far}")\n',
            '#define ASKS fail(error, ERROR_USAGE, "{--near} wants "\\\n', '    "--far")\n')},
        "src/commands/number_asks.h:6: an error names an option without braces"),
    "writable data": (
        change("base/number.c", ("int number", "static int last;\nint number"),
               ("return a + 1", "return last += a")),
        "base/number.o: writable data ['last']"),
    "a long function": (
        add("base/number.c", function("long_one", "(void)a;", *["a++;"] * 79, "return a;",
                                      head=PRIVATE)),
        "src/base/number.c:9: long_one has 81 code lines, at most 80"),
    "a long file": (
        add("base/number.c", "/* */\n\n" + "extern int number_last;\n" * 596),
        "src/base/number.c: 601 code lines, at most 600"),
    "a long line": (
        add("base/number.c", f"/*{'-' * 97}*/\n"), "src/base/number.c:[8]: over 100 columns"),
    "a tab": (
        add("base/number.c", "/*\t*/\n"),
        "src/base/number.c: tabs, carriage returns or blanks at a line's end"),
    "an empty last line": (add("base/number.c", "\n"), "src/base/number.c: its last line"),
    "a first line": (
        change("base/number.c", ("base/number.c", "number.c")),
        "src/base/number.c:1: does not begin '/* base/number.c - what it is. */'"),
    "no licence": (
        change("base/number.c", (SPDX, "/* */\n")),
        "src/base/number.c:2: no SPDX line"),
    "complexity": (
        add("base/number.c", function("complex", *CHOICES, "return a;", head=PRIVATE)),
        "src/base/number.c(8): complex has complexity 21, at most 20"),
    "a choice in a branch of another": (
        change("base/number.c", ("a + 1", "a > 1 ? a : number_next(a < 0 ? 0 : 1)")),
        "src/base/number.c:6: a conditional expression within another"),
    "a choice in the condition of another": (
        change("base/number.c", ("a + 1", "(a > 1 ? a : 0) > 2 ? 0 : 1")),
        "src/base/number.c:6: a conditional expression within another"),
    "a choice that is written to": (
        add("base/number.c", function("number_put", "int b = a;", "*(a > 1 ? &a : &b) += 1;",
                                      "return a + (b ? b : 1);", head=PRIVATE)),
        "src/base/number.c:11: a conditional expression is written to"),
    "a choice that is called": (
        change("base/number.c", ("a + 1", "(a > 1 ? number_next : number_next)(a)")),
        "src/base/number.c:6: a conditional expression is called"),
    "parameters": (
        change("trace/ray.h", ("#endif", f"int ray_inside({MANY});\n#endif")),
        "src/trace/ray.h: ray_inside has 9 parameters, at most 8"),
    "a header that leans on others": (
        {"base/more.h": header("base/more.h", "size_t more(void);\n")},
        "src/base/more.h does not compile alone"),
    "two files of a name": (
        {"trace/number.c": source("trace/number.c", "extern int not_empty;\n")},
        "src/trace/number.c: the name is taken by src/base/number.c"),
    "a circle": (
        {**change("base/number.c", ("a + 1", "number_more(a)"),
                  ("int number", "int number_more(int a);\nint number")),
         "base/more.c": source("base/more.c", '#include "base/number.h"\n\n',
                               "int number_more(int a);\n",
                               function("number_more", "return a < 9 ? number_next(a) : 9;"))},
        "a circle of files that call each other: base/more, base/number"),
    "a public name for nobody": (
        add("base/number.c", "int number_last(int a);\n" +
            function("number_last", "return a - 1;")),
        "src/base/number.c: number_last is public, and no other file uses it"),
    "public data for nobody": (
        add("base/number.c", "extern const int number_least;\nconst int number_least = 1;\n"),
        "src/base/number.c: number_least is public, and no other file uses it"),
    "a public name for tests": (
        {**add("base/number.c", "int number_last(int a);\n" +
               function("number_last", "return a - 1;")),
         "../tests/unit/test_dof.c": TREE["../tests/unit/test_dof.c"] +
                                     "int last = sizeof number_last(0);\n"},
        "src/base/number.c: number_last is public, and no other file uses it but tests"),
    "a formula that no test uses": (
        {"../tests/unit/test_dof.c": "/* tests/unit/test_dof.c - of a tiny tree. */\n" + SPDX},
        "src/photo/dof.c: dof_near is public, and no other file uses it"),
    "a word": (
        add("base/number.c", "/* /" + "tmp/ */\n"),
        "word that does not belong here: src/base/number.c:8: '/" + "tmp/'"),
}


class Recorder(Checks):
    """Keeps what failed instead of printing it."""

    def __init__(self):
        super().__init__(most=0)
        self.failures = []

    def check(self, condition, what):
        if not condition:
            self.failures.append(what)
        return bool(condition)


def write(tree):
    for path, text in tree.items():
        path = os.path.normpath(os.path.join("src", path))
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w") as file:
            file.write(text)


def build(tree):
    """Objects of all sources, and their list, as the Makefile makes them."""
    objects = []
    for path in sorted(path for path in tree if path.endswith(".c") and not path.startswith("..")):
        result = os.path.join("build", path[:-2] + ".o")
        os.makedirs(os.path.dirname(result), exist_ok=True)
        subprocess.run([*os.environ.get("CC", "cc").split(), "-Isrc", "-c", "-o", result,
                        os.path.join("src", path)], check=True)
        if path != "main.c":
            objects.append(os.path.relpath(result, "build"))
    with open("build/objects", "w") as file:
        file.write(" ".join(objects))


def failures_of(broken):
    with tempfile.TemporaryDirectory(prefix="lenscalc-rules-") as folder:
        os.chdir(folder)
        tree = {**TREE, **broken}
        write(tree)
        build(tree)
        recorder = Recorder()
        check_structure.check_tree(recorder, os.path.abspath("build"))
        os.chdir(check_structure.ROOT)
        return recorder.failures


def main():
    checks = Checks()
    kept = failures_of({})
    checks.check(kept == [], f"the tiny tree breaks rules: {kept}")
    for name, (broken, expected) in BROKEN.items():
        found = failures_of(broken)
        checks.check(len(found) == 1 and found[0].startswith(expected),
                     f"{name}: expected [{expected}], got {found}")
    checks.finish()


main()
