#!/usr/bin/env python3
"""tests/truth/check_basis.py - spectra of the primaries of sRGB: check_basis.py BUILD_DIR | --print

Three spectra of surfaces, red, green and blue, that are as smooth as can be: the sum of the squared
differences between neighbours of 5 nm is least, where they are nowhere negative, make 1 together
at each wavelength, and look under D65 as the primaries they stand for (the programme of Mallett and
Yuksel 2019). It is solved here by a barrier method, in double precision, of the observer and the
daylight that stand in the sources, and compared with the table in src/light/bands.c, which
--print writes.
"""
# SPDX-License-Identifier: MIT

import os
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import Checks
from source_tables import table

ROWS = 95  # 360 .. 830 nm
TO_XYZ = ((0.4124, 0.3576, 0.1805), (0.2126, 0.7152, 0.0722), (0.0193, 0.1192, 0.9505))
DIGITS = 6
# Of a difference d between neighbours of red and green: their squares and that of blue, -(d0 + d1).
SQUARES = ((2.0, 1.0), (1.0, 2.0))
OFF = ((-4.0, -2.0), (-2.0, -4.0))  # their second derivatives by both neighbours


def solved(matrix, right):
    """x of a small system by elimination with pivots."""
    n = len(right)
    rows = [list(matrix[i]) + [right[i]] for i in range(n)]
    for i in range(n):
        pivot = max(range(i, n), key=lambda k: abs(rows[k][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for k in range(i + 1, n):
            share = rows[k][i] / rows[i][i]
            for j in range(i, n + 1):
                rows[k][j] -= share * rows[i][j]
    x = [0.0] * n
    for i in reversed(range(n)):
        x[i] = (rows[i][n] - sum(rows[i][j] * x[j] for j in range(i + 1, n))) / rows[i][i]
    return x


def times(a, b):
    return [[a[i][0] * b[0][j] + a[i][1] * b[1][j] for j in range(2)] for i in range(2)]


def applied(a, x):
    return [a[0][0] * x[0] + a[0][1] * x[1], a[1][0] * x[0] + a[1][1] * x[1]]


def weights():
    """What each wavelength of a white surface under D65 adds to red, green and blue of white."""
    observer = table("src/light/observer.c", "functions", 3)
    daylight = table("src/light/spectrum.c", "components", 3)[12:107]  # 360 nm on
    sums = []
    for row, (eye, s) in enumerate(zip(observer, daylight)):
        light = s[0] - 0.296 * s[1] - 0.688 * s[2]  # CIE 15:2004, M1 and M2 of D65
        end = 0.5 if row in (0, ROWS - 1) else 1
        sums.append(solved(TO_XYZ, [end * light * part for part in eye]))
    white = [sum(part[c] for part in sums) for c in range(3)]
    return [[part[c] / white[c] for c in range(3)] for part in sums]


class Programme:
    """Red z[i][0] and green z[i][1]; blue is what is left of 1."""

    def __init__(self, parts):
        self.parts = parts
        self.z = [[1 / 3, 1 / 3] for _ in range(ROWS)]

    def gradient(self, i, barrier):
        red, green = self.z[i]
        slope = [0.0, 0.0]
        for k in (i - 1, i + 1):
            if 0 <= k < ROWS:
                d = [self.z[i][c] - self.z[k][c] for c in range(2)]
                for c in range(2):
                    slope[c] += 2 * (SQUARES[c][0] * d[0] + SQUARES[c][1] * d[1])
        blue = 1 - red - green
        return [slope[0] - barrier / red + barrier / blue,
                slope[1] - barrier / green + barrier / blue]

    def block(self, i, barrier):
        """Second derivatives at one wavelength; those with a neighbour are OFF."""
        red, green = self.z[i]
        neighbours = 1 if i in (0, ROWS - 1) else 2
        rest = barrier / (1 - red - green) ** 2
        own = (barrier / red ** 2, barrier / green ** 2)
        return [[2 * neighbours * SQUARES[a][b] + rest + (own[a] if a == b else 0)
                 for b in range(2)] for a in range(2)]

    def missing(self):
        """How far the six conditions are from being met: red and green look as they should."""
        return [sum(part[m] * z[c] for part, z in zip(self.parts, self.z)) - (m == c)
                for c in range(2) for m in range(3)]

    @staticmethod
    def factors(blocks):
        """Of the block-tridiagonal matrix: the inverse pivots."""
        pivots = []
        for block in blocks:
            pivot = [list(row) for row in block]
            if pivots:  # less what the block before it takes over
                taken = times(times(OFF, pivots[-1]), OFF)
                pivot = [[pivot[a][b] - taken[a][b] for b in range(2)] for a in range(2)]
            d = pivot[0][0] * pivot[1][1] - pivot[0][1] * pivot[1][0]
            pivots.append(((pivot[1][1] / d, -pivot[0][1] / d),
                           (-pivot[1][0] / d, pivot[0][0] / d)))
        return pivots

    @staticmethod
    def back(pivots, right):
        """The system for one right side."""
        sides = [right[0]]
        for i in range(1, ROWS):
            before = applied(OFF, applied(pivots[i - 1], sides[-1]))
            sides.append([right[i][a] - before[a] for a in range(2)])
        x = [applied(pivots[-1], sides[-1])]
        for i in reversed(range(ROWS - 1)):
            behind = applied(OFF, x[-1])
            x.append(applied(pivots[i], [sides[i][a] - behind[a] for a in range(2)]))
        return x[::-1]

    def step(self, barrier):
        """One of Newton's, as far as all stays positive; how large it was."""
        blocks = self.factors([self.block(i, barrier) for i in range(ROWS)])
        rows = [[[part[m] if c == a else 0.0 for a in range(2)] for part in self.parts]
                for c in range(2) for m in range(3)]
        free = self.back(blocks, [self.gradient(i, barrier) for i in range(ROWS)])
        bound = [self.back(blocks, row) for row in rows]

        def product(a, b):
            return sum(p[0] * q[0] + p[1] * q[1] for p, q in zip(a, b))
        missing = self.missing()
        multipliers = solved([[product(row, other) for other in bound] for row in rows],
                             [missing[k] - product(rows[k], free) for k in range(6)])
        move = [[-free[i][c] - sum(m * b[i][c] for m, b in zip(multipliers, bound))
                 for c in range(2)] for i in range(ROWS)]
        share = 1.0
        for z, d in zip(self.z, move):
            for value, change in ((z[0], d[0]), (z[1], d[1]), (1 - z[0] - z[1], -d[0] - d[1])):
                if change < 0:
                    share = min(share, -0.99 * value / change)
        self.z = [[z[c] + share * d[c] for c in range(2)] for z, d in zip(self.z, move)]
        return max(abs(d[c]) for d in move for c in range(2))

    def solve(self):
        barrier = 1e-2
        while barrier > 1e-15:
            for _ in range(40):
                if self.step(barrier) < 1e-9:
                    break
            barrier *= 0.2
        return [[z[0], z[1], 1 - z[0] - z[1]] for z in self.z]


def looks(parts, spectra):
    """sRGB of each of the three spectra under D65."""
    return [[sum(part[m] * row[c] for part, row in zip(parts, spectra)) for m in range(3)]
            for c in range(3)]


def print_table(spectra):
    for row in spectra:
        print("    {%s}," % ", ".join(f"{value:.{DIGITS}f}".rstrip("0").rstrip(".")
                                      for value in row[:2]))


def main():
    parts = weights()
    spectra = Programme(parts).solve()
    if sys.argv[1] == "--print":
        print_table(spectra)
        return
    checks = Checks()
    for c, row in enumerate(looks(parts, spectra)):
        for m in range(3):
            checks.near("looks", f"primary {c}, part {m}", row[m], float(m == c), 1e-9)
    stored = table("src/light/bands.c", "primaries", 2)
    checks.check(len(stored) == ROWS, f"the table has {len(stored)} rows, expected {ROWS}")
    for i, (row, want) in enumerate(zip(stored, spectra)):
        for c in range(2):
            checks.near("table", f"{360 + 5 * i} nm, column {c}", row[c], want[c],
                        0.6 * 10 ** -DIGITS)
        checks.check(min(row) >= 0 and sum(row) <= 1, f"{360 + 5 * i} nm: {row} leaves 0 to 1")
    checks.finish()


if __name__ == "__main__":
    main()
