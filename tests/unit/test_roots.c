/* tests/unit/test_roots.c - the search for a root: its steps, its accuracy, what it refuses. */
/* SPDX-License-Identifier: MIT */
#include "base/roots.h"
#include "check.h"

#include <float.h>

/* A function, how often it was asked, and whether ever outside its bracket. */
struct asked {
    double (*function)(double x);
    double low, high;
    int count;
    bool strayed;
};

static double ask(double x, const void *context)
{
    struct asked *asked = *(struct asked *const *)context;
    asked->count++;
    asked->strayed = asked->strayed || !(x >= asked->low && x <= asked->high);
    return asked->function(x);
}

static double line(double x)
{
    return x - 1;
}
static double cubic(double x)
{
    return x * x * x - 2;
}
static double cosine(double x)
{
    return cos(x) - x;
}
/* nearly a step: nothing on the way says where it is */
static double step(double x)
{
    return tanh(1e6 * (x - 0.987654321));
}
/* flat to the ninth order at its root */
static double flat(double x)
{
    return pow(x - 0.7, 9);
}
static double near_low(double x)
{
    return x - 1e-12;
}
static double near_high(double x)
{
    return x - (1 - 1e-13);
}
static double hole(double x)
{
    return x < 0.4 ? -1 : x > 0.6 ? 1 : NAN;
}

static void test_roots(void)
{
    static const struct {
        double (*function)(double x);
        double low, high, root, allowed;
        int most; /* evaluations, the two ends included */
    } rows[] = {
        {line, 0, 2, 1, 0, 3}, /* the middle is tried first */
        {line, 2, 0, 1, 0, 3},
        {cubic, 0, 4, 1.2599210498948731648, 1e-15, 12},
        {cosine, 0, 1, 0.73908513321516064166, 1e-15, 10},
        {step, 0, 1, 0.987654321, 1e-15, 60},
        {flat, 0, 1, 0.7, 1e-3, 130}, /* (1e-3)^9 is all that is left of it */
        {near_low, 0, 1, 1e-12, 1e-27, 12},
        {near_high, 0, 1, 1 - 1e-13, 1e-15, 12},
        {near_high, 1, 0, 1 - 1e-13, 1e-15, 12},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        struct asked asked = {rows[i].function, fmin(rows[i].low, rows[i].high),
                              fmax(rows[i].low, rows[i].high), 0, false};
        struct asked *context = &asked;
        struct error error;
        double root = NAN;
        CHECK(root_find(ask, &context, rows[i].low, rows[i].high, &root, &error));
        CHECK_NEAR(root, rows[i].root, rows[i].allowed, "root");
        CHECK(!asked.strayed);
        CHECK(asked.count <= rows[i].most);
        if (asked.count > rows[i].most) {
            printf("row %zu: %d evaluations\n", i, asked.count);
        }
    }
}

/* A root at an end costs no search. */
static void test_ends(void)
{
    struct asked asked = {line, 1, 5, 0, false}, *context = &asked;
    struct error error;
    double root = NAN;
    CHECK(root_find(ask, &context, 1, 5, &root, &error) && root == 1 && asked.count == 2);
    CHECK(root_find(ask, &context, 5, 1, &root, &error) && root == 1 && asked.count == 4);
}

static void test_refusals(void)
{
    struct asked asked = {line, 2, 5, 0, false}, *context = &asked;
    struct error error;
    double root = NAN;
    CHECK(!root_find(ask, &context, 2, 5, &root, &error));
    CHECK(error.code == ERROR_DOMAIN && root == 2);
    CHECK(strstr(error.message, "between 2 and 5") != NULL);
    asked = (struct asked){hole, 0, 1, 0, false};
    CHECK(!root_find(ask, &context, 0, 1, &root, &error));
    CHECK(strstr(error.message, "no number at 0.5") != NULL);
}

/* -1 below a place, 1 from it on: only halving finds it. */
static double jump(double x, const void *context)
{
    return x < *(const double *)context ? -1 : 1;
}

/* The bracket is closed to twice 2 eps of the root, wherever in its binade that is. */
static void test_jumps(void)
{
    struct error error;
    for (int i = 1; i < 400; i++) {
        double place = (1 + i / 400.0) * (i % 2 ? 1 : 4096), root = NAN;
        CHECK(root_find(jump, &place, -3 * place, 7.1 * place, &root, &error));
        CHECK_NEAR(root, place, 4 * DBL_EPSILON * place, "a jump");
    }
}

int main(void)
{
    test_jumps();
    test_roots();
    test_ends();
    test_refusals();
    return check_report();
}
