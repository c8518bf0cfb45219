/* tests/stress/stress_numbers.c - numbers to text and back, against printf and strtod. */
/* SPDX-License-Identifier: MIT */
#include "base/number.h"
#include "base/pair.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* stress_numbers SECONDS [SEED] */

static uint64_t state;
static unsigned long failed;

static uint64_t draw(void) /* xorshift64* */
{
    state ^= state >> 12;
    state ^= state << 25;
    state ^= state >> 27;
    return state * 2685821657736338717u;
}

/* All doubles alike; or of the sizes that people write; or beside a power of two or ten. */
static double number(void)
{
    uint64_t bits = draw();
    double x;
    memcpy(&x, &bits, sizeof x);
    switch (draw() % 4) {
    case 0:
        return isfinite(x) ? x : 1;
    case 1:
        return (double)(int64_t)(bits >> 24) * pow(10, -(double)(draw() % 12));
    case 2:
        return ldexp(1, (int)(draw() % 2000) - 1000) * (1 + (double)(bits % 5) * 0x1p-52);
    default:
        return strtod((char[]){(char)('1' + bits % 9), 'e', (char)('0' + bits / 16 % 10),
                               (char)('0' + bits / 256 % 10), '\0'},
                      NULL);
    }
}

static void complain(const char *what, double x, const char *text)
{
    if (++failed <= 20) {
        printf("FAILED %s: %a as '%s'\n", what, x, text);
    }
}

static double read_back(const char *text)
{
    double x = NAN;
    const char *end = text + strlen(text);
    return number_read(text, end, NUMBER_UNSCALED, &x) == end ? x : NAN;
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

static void check_text(double x)
{
    char ours[NUMBER_LENGTH + 1], theirs[64];
    *number_write_shortest(ours, x) = '\0';
    if (strtod(ours, NULL) != x || read_back(ours) != x) {
        complain("shortest does not read back", x, ours);
    }
    int shortest = digits_of(ours), digits = 1 + (int)(draw() % 17);
    snprintf(theirs, sizeof theirs, "%.*g", digits, x);
    *number_write_digits(ours, x, digits) = '\0';
    if (strcmp(ours, theirs) != 0) {
        complain("unlike printf", x, ours);
    }
    if (strtod(theirs, NULL) == x && shortest > digits) {
        complain("not the shortest", x, theirs);
    }
    if (number_needs_more(x, digits) != (shortest > digits)) {
        complain("needs more digits?", x, theirs);
    }
}

/* Long, short, with and without point and exponent: the same double as strtod. */
static void check_reading(void)
{
    char text[96];
    int length = 0, digits = 1 + (int)(draw() % (draw() % 4 == 0 ? 40 : 19));
    int point = (int)(draw() % (unsigned)(digits + 1));
    for (int i = 0; i < digits; i++) {
        text[length++] = (char)('0' + draw() % 10);
        if (i + 1 == point) {
            text[length++] = '.';
        }
    }
    text[length] = '\0';
    if (draw() % 2 == 0) {
        snprintf(text + length, sizeof text - (size_t)length, "e%d", (int)(draw() % 700) - 350);
    }
    double wanted = strtod(text, NULL);
    if (read_back(text) != wanted) {
        complain("read unlike strtod", wanted, text);
    }
}

/* A pair reads back as itself, from 31 digits or fewer. */
static void check_pair(void)
{
    char text[PAIR_LENGTH + 1];
    double hi = ldexp(1 + (double)(draw() >> 12) * 0x1p-52, (int)(draw() % 400) - 200);
    double lo = hi * 0x1p-54 * (2 * (double)(draw() >> 11) * 0x1p-53 - 1);
    struct pair x = pair_fast_sum(hi, lo), back = {NAN, NAN};
    char *end = pair_write_shortest(text, x, NUMBER_UNSCALED);
    *end = '\0';
    if (pair_read(text, end, NUMBER_UNSCALED, &back) != end ||
        !(fabs((back.hi - x.hi) + (back.lo - x.lo)) <= 1e-30 * fabs(x.hi))) {
        complain("pair does not read back", x.hi, text);
    }
}

static double seconds_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

int main(int count, char **words)
{
    double end = seconds_now() + (count > 1 ? atof(words[1]) : 10);
    unsigned long numbers = 0;
    state = 88172645463325252u + (count > 2 ? strtoul(words[2], NULL, 10) : 0);
    while (numbers == 0 || seconds_now() < end) {
        for (int i = 0; i < 10000; i++, numbers++) {
            check_text(number());
            check_reading();
            if (i % 10 == 0) {
                check_pair();
            }
        }
    }
    printf("numbers          %9lu written and %lu read: %lu wrong\n", numbers, numbers, failed);
    printf("%lu passed, %lu failed\n", numbers - (failed < numbers ? failed : numbers), failed);
    return failed != 0;
}
