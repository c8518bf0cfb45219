"""tests/integrals.py - Gauss and Legendre's rule, and Zernike's polynomials as Noll has them."""
# SPDX-License-Identifier: MIT

import functools
import math


@functools.cache
def gauss(count):
    """(node, weight) on 0..1, by Newton's method on the recurrence of the polynomials."""
    rule = []
    for i in range(count):
        x = math.cos(math.pi * (i + 0.75) / (count + 0.5))
        for _ in range(50):
            p, q = 1.0, x
            for k in range(2, count + 1):
                p, q = q, ((2 * k - 1) * x * q - (k - 1) * p) / k
            slope = count * (x * q - p) / (x * x - 1)
            x -= q / slope
        rule.append(((1 - x) / 2, 1 / ((1 - x * x) * slope * slope)))
    return rule


def noll(j, r, angle):
    """Polynomial j of [Noll76] at a point of the unit disc, by its explicit sum."""
    n = 0
    while (n + 1) * (n + 2) // 2 < j:
        n += 1
    place = j - n * (n + 1) // 2
    m = place // 2 * 2 if n % 2 == 0 else (place - 1) // 2 * 2 + 1
    radial = sum((-1) ** k * math.factorial(n - k) / (math.factorial(k)
                 * math.factorial((n + m) // 2 - k) * math.factorial((n - m) // 2 - k))
                 * r ** (n - 2 * k) for k in range((n - m) // 2 + 1))
    turn = 1 if m == 0 else math.sqrt(2) * (math.cos if j % 2 == 0 else math.sin)(m * angle)
    return math.sqrt(n + 1) * radial * turn
