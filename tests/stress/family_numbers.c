/* tests/stress/family_numbers.c - numbers to text and back, against printf and strtod. */
/* SPDX-License-Identifier: MIT */
#include "stress.h"

#include "base/number.h"
#include "base/pair.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* All doubles alike; or of the sizes that people write; or beside a power of two or ten. */
static double draw_number(struct trial *trial)
{
    uint64_t bits = (uint64_t)(trial_draw(trial) * 0x1p53) << 11;
    bits |= (uint64_t)trial_whole(trial, 0, 2047);
    double x;
    memcpy(&x, &bits, sizeof x);
    switch (trial_whole(trial, 0, 3)) {
    case 0:
        return isfinite(x) ? x : 1;
    case 1:
        return (double)(int64_t)(bits >> 24) * pow(10, -trial_whole(trial, 0, 11));
    case 2:
        return ldexp(1, trial_whole(trial, -1000, 999)) * (1 + (double)(bits % 5) * 0x1p-52);
    default:
        return strtod((char[]){(char)('1' + bits % 9), 'e', (char)('0' + bits / 16 % 10),
                               (char)('0' + bits / 256 % 10), '\0'},
                      NULL);
    }
}

static double read_back(const char *text)
{
    double x = (double)NAN;
    const char *end = text + strlen(text);
    return number_read(text, end, NUMBER_UNSCALED, &x) == end ? x : (double)NAN;
}

/* Significant digits of a text. */
static int digits_of(const char *text)
{
    int digits = 0, zeros = 0;
    for (; *text != '\0' && *text != 'e'; text++) {
        if (*text >= '1' && *text <= '9') {
            digits += zeros + 1;
            zeros = 0;
        } else if (*text == '0' && digits > 0) {
            zeros++;
        }
    }
    return digits;
}

static void check_text(struct trial *trial, double x)
{
    char ours[NUMBER_LENGTH + 1], theirs[64];
    *number_write_shortest(ours, x) = '\0';
    trial_verdict(trial, strtod(ours, NULL) == x && read_back(ours) == x,
                  "%a as '%s' does not read back", x, ours);
    const int shortest = digits_of(ours), digits = trial_whole(trial, 1, 17);
    snprintf(theirs, sizeof theirs, "%.*g", digits, x);
    *number_write_digits(ours, x, digits) = '\0';
    trial_verdict(trial, strcmp(ours, theirs) == 0, "%a as '%s', unlike printf", x, ours);
    trial_verdict(trial, strtod(theirs, NULL) != x || shortest <= digits,
                  "%a as '%s' is not the shortest", x, theirs);
    trial_verdict(trial, number_needs_more(x, digits) == (shortest > digits),
                  "%a: does it need more than %d digits?", x, digits);
}

/* Long, short, with and without point and exponent: the same double as strtod. */
static void check_reading(struct trial *trial)
{
    char text[96];
    int length = 0, digits = trial_whole(trial, 1, trial_chance(trial, 0.25) ? 40 : 19);
    const int point = trial_whole(trial, 0, digits);
    for (int i = 0; i < digits; i++) {
        text[length++] = (char)('0' + trial_whole(trial, 0, 9));
        if (i + 1 == point) {
            text[length++] = '.';
        }
    }
    text[length] = '\0';
    if (trial_chance(trial, 0.5)) {
        snprintf(text + length, sizeof text - (size_t)length, "e%d", trial_whole(trial, -350, 349));
    }
    trial_verdict(trial, read_back(text) == strtod(text, NULL), "'%s' read unlike strtod", text);
}

/* A pair reads back as itself, from 31 digits or fewer. */
static void check_pair(struct trial *trial)
{
    char text[PAIR_LENGTH + 1];
    const double hi = ldexp(trial_between(trial, 1, 2), trial_whole(trial, -200, 199));
    const double lo = hi * 0x1p-54 * trial_between(trial, -1, 1);
    struct pair x = pair_fast_sum(hi, lo), back = {(double)NAN, (double)NAN};
    char *end = pair_write_shortest(text, x, NUMBER_UNSCALED);
    *end = '\0';
    trial_verdict(trial,
                  pair_read(text, end, NUMBER_UNSCALED, &back) == end &&
                      fabs((back.hi - x.hi) + (back.lo - x.lo)) <= 1e-30 * fabs(x.hi),
                  "pair %a as '%s' does not read back", x.hi, text);
}

void try_numbers(struct trial *trial)
{
    check_text(trial, draw_number(trial));
    check_reading(trial);
    if (trial->number % 10 == 0) {
        check_pair(trial);
    }
}
