/* tests/unit/check.h - checks that count themselves and name what failed. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_UNIT_CHECK_H
#define LENSCALC_TESTS_UNIT_CHECK_H

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int checks_passed, checks_failed;
static const char *check_source_name, *check_source_unit = "";

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

/*
 * Until the next call the values that CHECK_NEAR and CHECK_RELATIVE expect are those of a source of
 * tests/truth/sources.tsv, in this unit, and `what` is "case: quantity"; NULL: of none. Where
 * LENSCALC_VALIDATE names a folder they are written there: see tests/validation.py.
 */
static inline void check_source(const char *name, const char *unit)
{
    check_source_name = name;
    check_source_unit = unit;
}

static inline void check_compared(double actual, double expected, double tolerance,
                                  const char *what)
{
    static FILE *table;
    const char *folder = check_source_name != NULL ? getenv("LENSCALC_VALIDATE") : NULL;
    if (folder == NULL) {
        return;
    }
    if (table == NULL) {
        char path[4096];
        const char *slash = strrchr(__BASE_FILE__, '/'), *name = slash ? slash + 1 : __BASE_FILE__;
        snprintf(path, sizeof path, "%s/%.*s.tsv", folder, (int)strcspn(name, "."), name);
        table = fopen(path, "w");
        if (table == NULL) {
            printf("FAILED cannot write %s\n", path);
            checks_failed++;
            check_source_name = NULL;
            return;
        }
    }
    const char *cut = strstr(what, ": ");
    for (const char *next = cut; next != NULL; next = strstr(next + 2, ": ")) {
        cut = next; /* the last */
    }
    double difference = isinf(expected) && actual == expected ? 0 : fabs(actual - expected);
    fprintf(table, "%s\t%.*s\t%s\t%.17g\t%.17g\t%.17g\t%.17g\t%s\n", check_source_name,
            cut != NULL ? (int)(cut - what) : 0, what, cut != NULL ? cut + 2 : what, actual,
            expected, difference, tolerance, check_source_unit);
}

/* |actual - expected| <= tolerance; infinities must be equal; NaN fails. */
static inline void check_near_at(double actual, double expected, double tolerance, const char *file,
                                 int line, const char *what)
{
    bool equal = isinf(expected) ? actual == expected : fabs(actual - expected) <= tolerance;
    check_compared(actual, expected, tolerance, what);
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
