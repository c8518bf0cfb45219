"""tests/bench/readme.py - README's lines of speed, from what a whole run of the bench has measured.

measured.tsv holds the entries that the lines name, and the machine; make bench RECORD=1 writes both.
"""
# SPDX-License-Identifier: MIT

import os
import re

from common import HERE, ROOT

MEASURED = os.path.join(HERE, "measured.tsv")
README = os.path.join(ROOT, "README")
SECTION = re.compile(r"(?ms)^Speed\n-----\n\n.*?\n\n\n")
HEAD = """\
Speed
-----

make bench measures all of it against what runs beside it: /bin/true, mawk, the loop
of a textbook, the processor's divider (goals: tests/bench/goals.tsv). On
{machine}:

"""
# what README says, and the entries whose values it puts there
LINES = (
    ("start of an answer", "{:.2f} of /bin/true's time", "start: a dof answer / true"),
    ("rows of dof, csv to csv", "{:.1f} M/s, {:.1f} times as many as mawk",
     "pipe: csv, 6 digits", "pipe: digits 6 / mawk"),
    ("exact rays, one core", "{:.0f} M surfaces/s, {:.0f} times a textbook's loop, {:.2f} of the "
     "divider's limit", "rays: AVX-512", "rays: AVX-512 / plain",
     "rays: AVX-512 / limit of the divider"),
    ("all their derivatives", "{:.1f} times the time of the rays", "rays: all derivatives / trace"),
    ("cardinal points, pupils", "{:.0f} ns a lens of 11 surfaces",
     "paraxial: trace and all figures"),
    ("rays of a camera", "{:.0f} M/s a core, {:.0f} % arrive", "camera",
     "camera: rays that arrive"),
    ("what pictures skip", "{:.1f} times as fast, to the same error",
     "render: none / all skips, geometric mean"),
    ("double Gauss optimised", "{:.1f} ms for 19 variables, {:.2f} of Ceres's time",
     "optimize: 19 variables, dls: time", "optimize: 19 variables, dls / ceres"),
    ("trials of a tolerance", "{:,.0f} a second by default", "tolerance: the default command"),
)


def machine():
    """The processor, as it names itself."""
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        name = re.search(r"(?m)^model name\s*:\s*(.*)$", file.read())
    cores = len(os.sched_getaffinity(0))
    return f"{name[1].strip() if name else 'an unnamed processor'}, {cores} cores"


def record(items):
    """Write measured.tsv and README anew; items: of a whole run."""
    values = {item.name: item.value for item in items}
    names = [name for _, _, *names in LINES for name in names]
    missing = [name for name in names if name not in values]
    if missing:
        raise SystemExit(f"bench: README wants what was not measured: {', '.join(missing)}")
    with open(MEASURED, "w", encoding="utf-8") as file:
        file.write(f"machine\t{machine()}\n")
        file.writelines(f"{name}\t{values[name]:.6g}\n" for name in names)
    with open(README, encoding="utf-8") as file:
        text = file.read()
    with open(README, "w", encoding="utf-8") as file:
        file.write(SECTION.sub(lambda _: section(), text))


def section():
    """README's section of speed, as measured.tsv has it."""
    with open(MEASURED, encoding="utf-8") as file:
        values = dict(line.rstrip("\n").split("\t") for line in file)
    width = max(len(what) for what, *_ in LINES)
    lines = [f"    {what:{width}}  {text.format(*(float(values[name]) for name in names))}"
             for what, text, *names in LINES]
    return HEAD.format(machine=values["machine"]) + "\n".join(lines) + "\n\n\n"


def committed():
    """The section that README has."""
    with open(README, encoding="utf-8") as file:
        found = SECTION.search(file.read())
    return found[0] if found else ""
