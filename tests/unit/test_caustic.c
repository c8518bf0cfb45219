/* tests/unit/test_caustic.c - folds of maps whose Jacobian is known. */
/* SPDX-License-Identifier: MIT */
#include "analysis/pupil/caustic.h"
#include "base/constants.h"
#include "check.h"

#include <math.h>

enum { EDGES = 256 };

static const double pi = PI;

static bool seen_in(const double (*points)[2], size_t count)
{
    struct jacobian_extremes folding = {0, 0, 0};
    caustic_add(&folding, points, count);
    return caustic_seen(&folding);
}

/* A disc about (0, y), mapped by (x, y) -> (x, y + bend y^2): the Jacobian is 1 + 2 bend y. */
static bool folds(double centre, double radius, double bend, double mirror)
{
    struct arena arena = {0};
    struct clear_arm arms[EDGES] = {0};
    struct clear_pupil clear = {.centre = {0, centre},
                                .low = {-radius, centre - radius},
                                .high = {radius, centre + radius},
                                .arms = arms,
                                .arm_count = EDGES};
    for (size_t i = 0; i < EDGES; i++) {
        double angle = 2 * pi * (double)i / EDGES - pi / 2;
        arms[i].edge.at[0] = radius * cos(angle);
        arms[i].edge.at[1] = centre + radius * sin(angle);
    }
    bool seen = false;
    for (enum caustic_grid grid = CAUSTIC_COARSE; grid <= CAUSTIC_FINE; grid++) {
        struct jacobian_extremes folding = {0, 0, 0};
        size_t count;
        const double(*at)[2] = folding_places(&clear, grid, &arena, &count);
        double(*points)[2] = arena_array(&arena, count, sizeof *points);
        for (size_t i = 0; i < count; i++) {
            points[i][0] = mirror * at[i][0];
            points[i][1] = at[i][1] + bend * at[i][1] * at[i][1];
        }
        caustic_add(&folding, (const double(*)[2])points, count);
        seen = caustic_seen(&folding);
        /* the Jacobian at both ends of the disc */
        const double low = 1 + 2 * bend * (centre - radius),
                     high = 1 + 2 * bend * (centre + radius);
        const double ratio = fmin(low, high) / fmax(low, high);
        CHECK(caustic_ruled_out(&folding) == (ratio > 0.5 && ratio < 2));
    }
    arena_free(&arena);
    return seen;
}

/* The line of the fold, y = -1/(2 bend), cuts the disc or does not. */
static void test_parabola(void)
{
    CHECK(!folds(0, 10, 0, 1));
    CHECK(!folds(0, 10, 0, -1));     /* turned over as a whole: no fold */
    CHECK(!folds(0, 10, 0.01, 1));   /* as good as none: from 0.8 to 1.2 */
    CHECK(!folds(0, 10, 0.0499, 1)); /* at y = -10.02 */
    CHECK(folds(0, 10, 0.0501, 1));  /* -9.98 */
    CHECK(folds(0, 10, 0.0501, -1));
    CHECK(folds(0, 10, -0.0501, 1));
    CHECK(folds(0, 10, 1, 1));
    CHECK(!folds(-20, 10, 1, 1)); /* the other sheet alone */
    CHECK(folds(-10.4, 10, 1, 1));
}

/* Lost rays say nothing. */
static void test_lost(void)
{
    const double points[6][2] = {{0, 0}, {1, 0}, {0, 1}, {0, 0}, {NAN, NAN}, {0, -1}};
    const double turned[6][2] = {{0, 0}, {1, 0}, {0, 1}, {0, 0}, {1, 0}, {0, -1}};
    CHECK(!seen_in(points, 6));
    CHECK(seen_in(turned, 6));
    CHECK(!seen_in(points, 0));
    struct jacobian_extremes folding = {0, 0, 0};
    caustic_add(&folding, points, 6);
    CHECK(!caustic_ruled_out(&folding));
}

int main(void)
{
    test_parabola();
    test_lost();
    return check_report();
}
