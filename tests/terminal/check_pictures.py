#!/usr/bin/env python3
"""tests/terminal/check_pictures.py - drawings and pictures on the terminal, and as PNG and PDF.

What is written to the terminal is read back: Braille dots lie where formulas have the curve, half
blocks, sixels and kitty's graphics hold the picture that the file has, and terminals that can show
them, cannot, or say nothing are played here.
"""
# SPDX-License-Identifier: MIT

import base64
import fcntl
import os
import pty
import re
import select
import signal
import stat
import struct
import subprocess
import sys
import tempfile
import termios
import time

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import pictures
from harness import Checks, Program, has_terminals, on_terminal

RENDER = ["render", "chart:checker", "--lens", "double-gauss-50", "-s", "1m", "--size", "96x64",
          "--samples", "4", "--seed", "1", "-o"]
# every kind of drawing there is: curves, sections, panels, maps, bars, scales
DRAWINGS = [
    ["dof", "-f", "50", "-N", "2.8,5.6,11", "-s", "1..20", "--plot"], ["draw", "double-gauss", "-o"],
    ["draw", "nikkor-z-14-24", "--position", "tele", "-o"], ["fan", "double-gauss", "--plot"],
    ["spot", "double-gauss", "--plot"], ["mtf", "double-gauss", "--plot"],
    ["seidel", "double-gauss", "--plot"], ["wavefront", "double-gauss", "--plot"],
    ["distortion", "double-gauss", "--grid"], ["field", "double-gauss", "--plot"],
    ["illumination", "double-gauss", "--plot"], ["pupil", "double-gauss", "--plot"],
    ["dof", "-f", "50", "-N", "8", "-s", "3", "--scale"], ["glass", "--abbe"],
    ["conjugate", "-f", "50", "--object", "1m", "--diagram"],
]
ESCAPE = re.compile("\033\\[[0-9;]*m")
# the dots of a Braille character, U+2800 + bits: (column, row) of each bit
DOTS = [(0, 0), (0, 1), (0, 2), (1, 0), (1, 1), (1, 2), (0, 3), (1, 3)]


def dots_of(lines):
    """The dots of Braille characters of a text, as (x, y)."""
    found = set()
    for row, line in enumerate(lines):
        for column, letter in enumerate(line):
            bits = ord(letter) - 0x2800
            if 0 <= bits < 256:
                found.update((2 * column + x, 4 * row + y) for bit, (x, y) in enumerate(DOTS)
                             if bits >> bit & 1)
    return found


def line_through(places, values):
    """Slope and intercept of the line through points, by least squares."""
    count = len(places)
    mean, middle = sum(places) / count, sum(values) / count
    slope = (sum((p - mean) * (v - middle) for p, v in zip(places, values)) /
             sum((p - mean) ** 2 for p in places))
    return slope, middle - slope * mean


def check_curve(checks, program):
    """Dots of a curve lie where the formula of the near limit has it, by the axes' numbers."""
    focal, fnumber, coc = 50.0, 8.0, 0.03
    words = ["dof", "-f", "50", "-N", "8", "-c", "0.03", "-s", "1..9#81", "--columns", "near",
             "--plot", "term"]
    for width in ("80", "120", "200"):
        text = program.run(*words, variables={"COLUMNS": width}).stdout.decode()
        lines = text[text.index("\n\n") + 2:].split("\n")
        dots = dots_of(lines)
        frame = min(x for x, _ in dots)
        # numbers of the axes: in front of the vertical axis, and below the lowest dots
        lowest = max(y for _, y in dots)
        rows, columns = [], []
        for row, line in enumerate(lines):
            number = re.match(r" *([0-9.]+)(?= {0,2}[\u2800-\u28ff])", line)
            if number:
                rows.append((4 * row + 2, float(number[1])))
            if row > lowest // 4:
                columns += [(found.start() + found.end(), float(found[0]))
                            for found in re.finditer(r"[0-9.]+", line)]
        checks.check(len(rows) >= 3 and len(columns) >= 4,
                     f"{width} columns: numbers {rows} {columns}")
        if len(rows) < 3 or len(columns) < 4:
            continue
        up, up_0 = line_through([value for _, value in rows], [at for at, _ in rows])
        across, across_0 = line_through([value for _, value in columns], [at for at, _ in columns])
        hyperfocal = focal * focal / (fnumber * coc) + focal
        checked = off = 0
        for step in range(5, 76):
            distance = 1 + step / 10
            s = 1000 * distance
            near = s * (hyperfocal - focal) / (hyperfocal + s - 2 * focal) / 1000
            x, y = across_0 + across * distance, up_0 + up * near
            if x < frame + 4:
                continue
            # numbers stand to the nearest row and column: half of one, and a dot
            checked += 1
            off += not any(abs(x - u) <= 2 and abs(y - v) <= 3 for u, v in dots)
        checks.check(checked > 60 and off == 0,
                     f"{width} columns: {off} of {checked} places of the near limit have no dot")


def check_widths(checks, program):
    """No drawing is wider than its terminal, of 40 to 200 columns; its title is there."""
    for words in DRAWINGS:
        name = " ".join(words)
        svg = program.run(*words, "/dev/stdout", "-o", "/dev/null").stdout if "-o" not in words \
            else program.run(*words[:-1]).stdout
        title = re.search(r"<title>(.*?)</title>", svg.decode())
        wanted = (title[1] if title else "").replace("&amp;", "&").split()
        for width in (40, 80, 200):
            result = program.run(*words, "term", variables={"COLUMNS": str(width)})
            text = result.stdout.decode()
            checks.check(result.returncode == 0 and "\033" not in text,
                         f"{name} at {width}: {result.returncode}, {result.stderr[-200:]!r}")
            wide = [line for line in text.split("\n") if len(line) > width and
                    re.search("[\u2800-\u28ff]", line)]
            checks.check(not wide, f"{name} at {width}: {wide[:2]}")
            checks.check(len(re.findall("[\u2800-\u28ff]", text)) > 40, f"{name} at {width}: {text}")
            shown = re.sub("[\u2800-\u28ff]", " ", text).split()
            missing = [word for word in wanted if word not in shown]
            checks.check(not missing, f"{name} at {width}: no {missing}")


def check_words(checks, program):
    """Words stand where they belong: panels' titles below the title, notes whole, labels level."""
    for width in ("40", "80", "200"):
        def shown(*words, columns=width):
            return program.run(*words, "term", variables={"COLUMNS": columns}).stdout.decode()
        sums = shown("seidel", "double-gauss", "--plot")
        places = [sums.find(words) for words in ("Seidel sums of", "S1 spherical", "S2 coma")]
        checks.check(0 <= places[0] < places[1] < places[2], f"seidel at {width}: {places}")
        for lens in ("double-gauss", "fisheye-16"):
            section = shown("draw", lens, "-o")
            note = "the oblique bundle is cut by the clear apertures of the elements"
            checks.check(note in " ".join(section.split()), f"{lens} at {width}: no note: {section}")
            split = [line for line in section.split("\n")
                     if line.count("\u00b7") != len(re.findall("[0-9] \u00b7 1\\.[0-9]", line))]
            checks.check(not split, f"{lens} at {width}: labels not in a line: {split}")


def cells_of(text):
    """Colours of the half blocks of a text in 24 bits: rows of (upper, lower)."""
    rows = []
    for line in text.split("\n")[:-1]:
        front = back = None
        row = []
        for escape, letter in re.findall("\033\\[([0-9;]*)m|(.)", line):
            numbers = [int(number) for number in escape.split(";")] if escape else []
            if numbers[:2] == [38, 2]:
                front = tuple(numbers[2:])
            elif numbers[:2] == [48, 2]:
                back = tuple(numbers[2:])
            elif letter == "\u2580":
                row.append((front, back))
        rows.append(row)
    return rows


def light(code):
    value = code / 255
    return value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4


def pixels_of(png):
    """Lines of (red, green, blue) of an 8-bit PNG."""
    lines, step = pictures.lines_of(png)
    return [[tuple(line[x:x + 3]) for x in range(0, len(line), step)] for line in lines]


def mean_light(pixels, left, top, right, bottom):
    """Of the green of an area whose edges lie between pixels."""
    values = [light(pixels[y][x][1]) for y in range(top, bottom) for x in range(left, right)]
    return sum(values) / len(values)


def check_half_blocks(checks, program, png):
    """Each half block is the mean light of the pixels that it covers."""
    pixels = pixels_of(png)
    text = program.run(*RENDER, "term", "--color", "always",
                       variables={"COLUMNS": "48", "COLORTERM": "truecolor"}).stdout.decode()
    rows = cells_of(text)
    checks.check(len(rows) == 16 and all(len(row) == 48 for row in rows),
                 f"half blocks: {len(rows)} rows of {sorted(set(map(len, rows)))}")
    worst = 0
    for y, row in enumerate(rows):
        for x, cell in enumerate(row):
            for half in (0, 1):
                top = 4 * y + 2 * half  # 96 x 64 pixels as 48 x 32: two by two
                expected = mean_light(pixels, 2 * x, top, 2 * x + 2, top + 2)
                worst = max(worst, abs(light(cell[half][1]) - expected))
    checks.check(worst < 0.006, f"half blocks: light differs by {worst}")  # a code is 0.009 at most
    # without colours: dots, as many of a hundred as the mean of encoded light says
    plain = program.run(*RENDER, "term", variables={"COLUMNS": "48"}).stdout.decode()
    dots = dots_of(plain.split("\n"))
    share = len(dots) / (96 * 64)
    codes = [pixel[1] / 255 for line in pixels for pixel in line]
    checks.check("\033" not in plain and abs(share - sum(codes) / len(codes)) < 0.02,
                 f"dots: {share} of them, expected {sum(codes) / len(codes)}")


def sixels_of(text):
    """Pixels of a sixel picture: (width, height, {(x, y): (red, green, blue)} in percent)."""
    body = re.search("\033P[0-9;]*q(.*?)\033\\\\", text, re.S)[1]
    width, height = map(int, re.match(r'"1;1;(\d+);(\d+)', body).groups())
    colours, pixels = {}, {}
    x = top = number = 0
    for define, red, green, blue, choose, count, one, step in re.findall(
            r"#(\d+);2;(\d+);(\d+);(\d+)|#(\d+)|(?:!(\d+))?([?-~])|([$-])", body[body.index("#"):]):
        if define:
            colours[int(define)] = (int(red), int(green), int(blue))
        elif choose:
            number = int(choose)
        elif step:
            x = 0
            top += 6 if step == "-" else 0
        else:
            for _ in range(int(count or 1)):
                for bit in range(6):
                    if ord(one) - 63 >> bit & 1:
                        pixels[x, top + bit] = colours[number]
                x += 1
    return width, height, pixels


def check_sixel(checks, program, png):
    """Every pixel has one colour; means over squares are those of the file."""
    pixels = pixels_of(png)
    text = program.run(*RENDER, "term", "--terminal", "sixel").stdout.decode()
    width, height, found = sixels_of(text)
    checks.check((width, height) == (96, 64) and len(found) == 96 * 64,
                 f"sixel: {width} x {height}, {len(found)} pixels")
    worst = 0
    for top in range(0, 64, 8):
        for left in range(0, 96, 8):
            for k in range(3):
                area = [(x, y) for y in range(top, top + 8) for x in range(left, left + 8)]
                has = sum(found.get(place, (0, 0, 0))[k] for place in area) / 6400
                expected = sum(pixels[y][x][k] for x, y in area) / (64 * 255)
                worst = max(worst, abs(has - expected))
    checks.check(worst < 0.04, f"sixel: squares differ by {worst}")  # what is handed on at edges


def kitty_bytes(text):
    """The bytes that pieces of kitty's protocol hold together."""
    pieces = re.findall("\033_G([^;]*);([A-Za-z0-9+/=]*)\033\\\\", text)
    more = [dict(item.split("=") for item in keys.split(",")) for keys, _ in pieces]
    whole = all(keys["m"] == "1" for keys in more[:-1]) and more[-1]["m"] == "0"
    return (base64.b64decode("".join(data for _, data in pieces)) if whole else b"", more[0],
            max(len(data) for _, data in pieces))


def check_kitty(checks, program, png):
    """The bytes of the file, in pieces of 4096 letters at most."""
    text = program.run(*RENDER, "term", "--terminal", "kitty").stdout.decode()
    data, keys, longest = kitty_bytes(text)
    checks.check(data == png and keys["a"] == "T" and keys["f"] == "100" and keys["q"] == "2" and
                 longest <= 4096, f"kitty: {keys}, {len(data)} bytes of {len(png)}")
    if not pictures.can_render():
        return
    text = program.run("draw", "double-gauss", "-o", "term", "--terminal", "kitty").stdout.decode()
    data, _, _ = kitty_bytes(text)
    lines = pixels_of(data)
    svg = program.run("draw", "double-gauss").stdout.decode()
    expected = pixels_of(pictures.render(svg, len(lines[0])))
    checks.check(len(lines[0]) == 800 and lines == expected, "kitty: not the drawing's pixels")


# -------- terminals that are played --------

def settings_of(terminal):
    return termios.tcgetattr(terminal)


def played(program, words, answer, interrupt=False, **variables):
    """
    A call on a terminal that answers the question it is asked by `answer`, or not at all.

    Returns what it showed behind the question, the question, the status, whether the terminal's
    settings are as before, and how long it took from the question to the first of the picture.
    """
    ours, theirs = pty.openpty()
    fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 40, 60, 600, 800))
    before = settings_of(theirs)
    environment = {**program.environment(), "TERM": "xterm-256color", **variables}
    for name in ("COLUMNS", "NO_COLOR", "COLORTERM"):
        if name not in variables:
            environment.pop(name, None)
    process = subprocess.Popen(program.command + words, stdin=subprocess.DEVNULL, stdout=theirs,
                               stderr=subprocess.PIPE, env=environment)
    shown, asked, took = b"", None, None
    quiet = 0
    while process.poll() is None or select.select([ours], [], [], 0)[0]:
        if not select.select([ours], [], [], 0.2)[0]:
            quiet += 1
            if quiet > 150:
                process.kill()
            continue
        piece = os.read(ours, 65536)
        if asked is not None and took is None and piece:
            took = time.monotonic() - asked_at
        shown += piece
        if asked is None and b"\033[c" in shown:
            asked, shown = shown[:shown.index(b"\033[c") + 3], b""
            asked_at = time.monotonic()
            if interrupt:
                process.send_signal(signal.SIGINT)
            if answer:
                os.write(ours, answer)
    process.stderr.close()
    after = settings_of(theirs)
    os.close(theirs)
    os.close(ours)
    return shown.decode(), asked, process.wait(), before == after, took


def check_asked(checks, program):
    """Terminals that say what they can, within 100 ms, and are left as they were."""
    kitty, sixel, cell = b"\033_Gi=31;OK\033\\", b"\033[?62;4;22c", b"\033[6;20;10t"
    neither = b"\033[?62;22c"
    cases = (("kitty", kitty + cell + neither, "\033_Ga=T"), ("sixel", cell + sixel, "\033P0;1;0q"),
             ("both", kitty + sixel, "\033_Ga=T"), ("neither", neither, "\u2580"),
             ("no answer", b"", "\u2580"), ("half an answer", b"\033[?62;4", "\u2580"),
             ("64 is not 4", b"\033[?64;14;40c", "\u2580"))
    for name, answer, begins in cases:
        shown, asked, status, is_same, took = played(program, RENDER + ["term"], answer)
        checks.check(status == 0 and asked is not None and b"a=q" in asked and begins in shown and
                     is_same, f"{name}: status {status}, asked {asked!r}, settings "
                     f"{'as before' if is_same else 'changed'}, {shown[:80]!r}")
        # a machine at work may be late itself
        checks.check(took is not None and took < 2, f"{name}: {took} s")
    # who is told what to do does not ask, and neither does who may not show colours
    for words, variables in ((["--terminal", "blocks"], {}), ([], {"NO_COLOR": "1"}),
                             ([], {"TERM": "dumb"}), (["--color", "never"], {})):
        shown, asked, status, is_same, _ = played(program, RENDER + ["term"] + words, b"",
                                                  **variables)
        checks.check(asked is None and status == 0 and is_same and
                     ("\033" in shown) == (words == ["--terminal", "blocks"]),
                     f"{words} {variables}: asked {asked!r}, {shown[:80]!r}")
    # Ctrl-C while it waits: as before, too
    shown, asked, status, is_same, _ = played(program, RENDER + ["term"], b"", interrupt=True)
    checks.check(asked is not None and is_same,
                 f"interrupted: settings {'as before' if is_same else 'changed'}")
    shown, _, status, _, _ = played(program, ["draw", "double-gauss", "-o", "term"], neither)
    checks.check(status == 0 and re.search("[\u2801-\u28ff]", shown) and "\033[38;5;" in shown and
                 shown.count("\033[0m") >= 3, f"a drawing with colours: {shown[:100]!r}")


def check_colours(checks, program):
    """Colours alone differ, but for the dashes that tell curves apart without them."""
    for words in (["draw", "double-gauss", "-o", "term"], ["dof", "-f", "50", "-N", "4,8", "-s",
                                                          "1..9", "--plot", "term"]):
        plain = on_terminal(program, words, 100, TERM="xterm", NO_COLOR="1")[0]
        coloured = on_terminal(program, words, 100, TERM="xterm")[0]
        coloured = coloured[coloured.rindex("\033[c") + 3:]  # behind what it asks
        bare = ESCAPE.sub("", coloured)
        letters = [re.sub("[\u2800-\u28ff ]+", " ", text) for text in (plain, bare)]
        checks.check("\033" not in plain and "\033[" in coloured and letters[0] == letters[1],
                     f"{words}: {letters}")
        more, fewer = (len(dots_of(text.split("\n"))) for text in (bare, plain))
        checks.check(more > fewer or words[0] != "draw", f"{words}: no dashes without colours")
        for line in coloured.split("\n"):
            last = re.findall(ESCAPE, line)
            checks.check(not last or last[-1] == "\033[0m", f"{words}: a colour has no end: {line!r}")


def check_places(checks, program):
    """Where it goes: below a table, behind no rows for programs, into a file of that name."""
    words = ["dof", "-f", "50", "-N", "8", "-s", "1..5"]
    both = program.run(*words, "--plot", "term").stdout.decode()
    table = program.run(*words).stdout.decode()
    checks.check(both.startswith(table + "\n") and len(both) > len(table) + 300, "below the table")
    for form in ("csv", "json", "markdown"):
        result = program.run(*words, "--plot", "term", "--format", form)
        checks.check(result.returncode == 2 and result.stdout == b"" and
                     b"table for reading" in result.stderr, f"{form}: {result.stderr!r}")
    result = program.run("dof", "-f", "50", "-N", "8", "-s", "3", "--terminal", "sixel")
    checks.check(result.returncode == 2 and b"--terminal says how" in result.stderr,
                 f"--terminal alone: {result.stderr!r}")
    result = program.run("list", "films", "--terminal", "sixel")
    checks.check(result.returncode == 2 and b"draws nothing" in result.stderr,
                 f"--terminal of what draws nothing: {result.stderr!r}")
    with tempfile.TemporaryDirectory() as folder:
        program.shell(f"lenscalc {' '.join(words)} --csv --plot term -o rows.csv > shown && "
                      "lenscalc draw double-gauss -o ./term && lenscalc draw double-gauss > x.svg",
                      folder)
        names = sorted(os.listdir(folder))
        texts = {}
        for name in names:
            with open(os.path.join(folder, name), encoding="utf-8") as file:
                texts[name] = file.read()
        checks.check(names == ["rows.csv", "shown", "term", "x.svg"] and
                     texts["term"] == texts["x.svg"] and texts["term"].startswith("<?xml") and
                     texts["shown"].strip("\n") in both, f"files: {names}")
        evil = program.run("draw", "double-gauss", "--title", "a\033[31mb\u202ec", "-o", "term")
        checks.check("\033" not in evil.stdout.decode() and "\u202e" not in evil.stdout.decode() and
                     "a?[31mb?c" in evil.stdout.decode(), f"a title: {evil.stdout[:80]!r}")


def converter(folder, script):
    """A folder that has, in the place of rsvg-convert, a script."""
    path = os.path.join(folder, "rsvg-convert")
    with open(path, "w", encoding="ascii") as file:
        file.write("#!/bin/sh\n" + script)
    os.chmod(path, stat.S_IRWXU)
    return folder


def check_files(checks, program):
    """PNG and PDF by rsvg-convert; without it, and with one that fails, nothing is written."""
    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as programs:
        target = os.path.join(folder, "x.png")
        for script, said in (("echo sorry >&2; exit 3\n", b"rsvg-convert failed: sorry"),
                             ("kill -9 $$\n", b"rsvg-convert failed: signal 9")):
            result = program.run("draw", "double-gauss", "-o", target,
                                 variables={"PATH": converter(programs, script)})
            checks.check(result.returncode == 5 and said in result.stderr and
                         os.listdir(folder) == [], f"{script}: {result.stderr!r}")
        os.remove(os.path.join(programs, "rsvg-convert"))
        for words in (["draw", "double-gauss", "-o", target], ["spot", "double-gauss", "--plot",
                                                              target]):
            result = program.run(*words, variables={"PATH": programs})
            checks.check(result.returncode == 5 and b"librsvg2-bin" in result.stderr and
                         result.stdout == b"" and os.listdir(folder) == [],
                         f"{words}: {result.stderr!r}")
        # drawn in blocks where nobody asked for pixels; asked for, it is named
        result = program.run("draw", "double-gauss", "-o", "term", "--terminal", "sixel",
                             variables={"PATH": programs})
        checks.check(result.returncode == 5 and b"rsvg-convert" in result.stderr and
                     result.stdout == b"", f"sixel without it: {result.stderr!r}")
        if not pictures.can_render():
            return
        for words in (["dof", "-f", "50", "-N", "8", "-s", "1..9", "--plot"], ["draw", "fisheye-16", "-o"],
                      ["report", "double-gauss", "-N", "4", "-o"], ["mtf", "double-gauss", "--plot"]):
            for ending, begin, last in ((".png", b"\x89PNG\r\n\x1a\n", b"IEND\xaeB`\x82"),
                                        (".PDF", b"%PDF-", b"%%EOF\n")):
                path = os.path.join(folder, "a drawing" + ending)
                result = program.run(*words, path)
                data = b""
                if result.returncode == 0:
                    with open(path, "rb") as file:
                        data = file.read()
                checks.check(data.startswith(begin) and data.endswith(last),
                             f"{words} {ending}: {result.returncode} {result.stderr!r} {data[:9]!r}")
        svg = program.run("draw", "double-gauss").stdout.decode()
        program.run("draw", "double-gauss", "-o", target)
        with open(target, "rb") as file:
            pixels = pixels_of(file.read())
        width = float(re.search(r'width="([0-9.]+)"', svg)[1])
        checks.check(len(pixels[0]) == 2 * width and
                     pixels == pixels_of(pictures.render(svg, len(pixels[0]))), "x.png: its pixels")
    wrong = program.run("draw", "double-gauss", "-o", "x.gif")
    checks.check(wrong.returncode == 2 and b"must end in .svg, .png or .pdf" in wrong.stderr,
                 f"x.gif: {wrong.stderr!r}")


def main():
    signal.signal(signal.SIGINT, signal.default_int_handler)
    program = Program(sys.argv[1])
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "x.png")
        program.run(*RENDER, path)
        with open(path, "rb") as file:
            png = file.read()
    for check in (check_half_blocks, check_sixel, check_kitty):
        check(checks, program, png)
    on_terminals = (check_asked, check_colours)
    for check in (check_curve, check_widths, check_words, check_places, check_files,
                  *(on_terminals if has_terminals() else ())):
        check(checks, program)
    checks.finish()


main()
