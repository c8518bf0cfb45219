/* tests/stress/quad.c - numbers of 113 bits: read, written, roots and angles. */
/* SPDX-License-Identifier: MIT */
#include "quad.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

quad quad_root(quad x)
{
    if (!(x > 0)) {
        return x == 0 ? 0 : (quad)NAN;
    }
    quad y = (quad)sqrtl((long double)x);
    y = (y + x / y) / 2;
    return (y + x / y) / 2;
}

/* Taylor's series about 0 after halving to below 1/8. */
static void quad_turn(quad x, quad *sine, quad *cosine)
{
    int halvings = 0;
    while (quad_size(x) > (quad)0.125) {
        x /= 2;
        halvings++;
    }
    quad term = x, sum = x, versine = 0; /* 1 - cosine keeps its digits */
    for (int i = 2; i < 40; i += 2) {
        term *= -x * x / (i * (i + 1));
        sum += term;
    }
    term = x * x / 2;
    versine = term;
    for (int i = 3; i < 40; i += 2) {
        term *= -x * x / (i * (i + 1));
        versine += term;
    }
    for (; halvings > 0; halvings--) {
        sum = 2 * sum * (1 - versine);
        versine = 2 * versine * (2 - versine);
    }
    *sine = sum;
    *cosine = 1 - versine;
}

quad quad_sine(quad x)
{
    quad sine, cosine;
    quad_turn(x, &sine, &cosine);
    return sine;
}

quad quad_cosine(quad x)
{
    quad sine, cosine;
    quad_turn(x, &sine, &cosine);
    return cosine;
}

quad quad_pi(void)
{
    return quad_read("3.14159265358979323846264338327950288419717");
}

static quad power_of_ten(int exponent)
{
    quad power = 1, base = 10;
    for (int left = abs(exponent); left > 0; left /= 2) {
        power *= left % 2 == 1 ? base : 1;
        base *= base;
    }
    return power;
}

quad quad_read(const char *text)
{
    quad value = 0;
    bool negative = *text == '-';
    int exponent = 0;
    bool behind = false;
    text += *text == '-' || *text == '+';
    for (; (*text >= '0' && *text <= '9') || *text == '.'; text++) {
        if (*text == '.') {
            behind = true;
            continue;
        }
        value = 10 * value + (*text - '0');
        exponent -= behind;
    }
    if (*text == 'e') {
        exponent += atoi(text + 1);
    }
    value = exponent < 0 ? value / power_of_ten(exponent) : value * power_of_ten(exponent);
    return negative ? -value : value;
}

void quad_write(char *text, size_t room, quad x, int digits)
{
    if (x == 0 || !quad_is_finite(x)) {
        snprintf(text, room, "%g", (double)x);
        return;
    }
    quad size = quad_size(x);
    int exponent = (int)floor(log10((double)size));
    size = exponent < 0 ? size * power_of_ten(exponent) : size / power_of_ten(exponent);
    char mantissa[40];
    digits = digits > 33 ? 33 : digits;
    for (int i = 0; i < digits; i++) {
        int digit = (int)size;
        digit = digit > 9 ? 9 : digit;
        mantissa[i] = (char)('0' + digit);
        size = (size - digit) * 10;
    }
    mantissa[digits] = '\0';
    snprintf(text, room, "%s%c.%se%d", x < 0 ? "-" : "", mantissa[0], mantissa + 1, exponent);
}
