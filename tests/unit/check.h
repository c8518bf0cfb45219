/* tests/unit/check.h - checks that count themselves and name what failed. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_UNIT_CHECK_H
#define LENSCALC_TESTS_UNIT_CHECK_H

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

static int checks_passed, checks_failed;

/* Count one check; a failure is printed with its place and what was expected. */
static inline void check_at(bool passed, const char *file, int line, const char *what)
{
    if (passed) {
        checks_passed++;
    } else {
        checks_failed++;
        printf("%s:%d: FAILED %s\n", file, line, what);
    }
}

#define CHECK(condition) check_at((condition), __FILE__, __LINE__, #condition)

/* |actual - expected| <= tolerance; infinities must be equal; NaN fails. */
static inline void check_near_at(double actual, double expected, double tolerance, const char *file,
                                 int line, const char *what)
{
    bool equal = isinf(expected) ? actual == expected : fabs(actual - expected) <= tolerance;
    if (equal) {
        checks_passed++;
    } else {
        checks_failed++;
        printf("%s:%d: FAILED %s is %.17g, expected %.17g within %.3g\n", file, line, what, actual,
               expected, tolerance);
    }
}

#define CHECK_NEAR(actual, expected, tolerance, what)                                              \
    check_near_at((actual), (expected), (tolerance), __FILE__, __LINE__, (what))

/* The same with a relative tolerance. */
#define CHECK_RELATIVE(actual, expected, tolerance, what)                                          \
    check_near_at((actual), (expected), (tolerance)*fabs(expected), __FILE__, __LINE__, (what))

static inline void check_text_at(const char *actual, const char *expected, const char *file,
                                 int line)
{
    if (strcmp(actual, expected) == 0) {
        checks_passed++;
    } else {
        checks_failed++;
        printf("%s:%d: FAILED text is '%s', expected '%s'\n", file, line, actual, expected);
    }
}

#define CHECK_TEXT(actual, expected) check_text_at((actual), (expected), __FILE__, __LINE__)

/* The last line of every test program; `return check_report();` from main. */
static inline int check_report(void)
{
    printf("%d passed, %d failed\n", checks_passed, checks_failed);
    return checks_failed != 0;
}

#endif
