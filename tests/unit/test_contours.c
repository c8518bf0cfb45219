/* tests/unit/test_contours.c - contour lines of maps. */
/* SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "check.h"
#include "draw/contours.h"
#include "draw/svg.h"

enum { SIZE = 41 };

/* Points of the paths of a drawing: how many, of how many lines, and the extremes of a measure. */
struct seen {
    int points, lines;
    double least, most;
};

static struct seen look(const char *svg, double (*measure)(double x, double y))
{
    struct seen seen = {.least = INFINITY, .most = -INFINITY};
    for (const char *at = strstr(svg, " d=\"M"); at != NULL; at = strstr(at + 1, " d=\"M")) {
        char *next = NULL;
        seen.lines++;
        for (const char *p = at + 5; *p != '"'; p = next) {
            while (*p == 'L' || *p == ' ' || *p == 'M') {
                p++;
            }
            const double x = strtod(p, &next), y = strtod(next, &next), m = measure(x, y);
            seen.least = fmin(seen.least, m);
            seen.most = fmax(seen.most, m);
            seen.points++;
        }
    }
    return seen;
}

/* The page is 100 to 300 px across and 50 to 250 down: -1 to 1 in both. */
static double radius(double x, double y)
{
    return hypot((x - 200) / 100, (150 - y) / 100);
}

static double product(double x, double y)
{
    return (x - 200) / 100 * (150 - y) / 100;
}

static double height(double x, double y)
{
    (void)x;
    return (150 - y) / 100;
}

static struct seen drawn(double (*measure)(double x, double y), double value, double hole,
                         struct arena *arena)
{
    double values[SIZE * SIZE];
    for (size_t i = 0; i < SIZE * SIZE; i++) {
        const double x = 100 + 200 * (double)(i % SIZE) / (SIZE - 1);
        const double y = 250 - 200 * (double)(i / SIZE) / (SIZE - 1);
        values[i] = radius(x, y) < hole ? (double)NAN : measure(x, y);
    }
    struct svg svg = {.arena = arena};
    const struct contour_map map = {SIZE, values, 100, 50, 200};
    svg_begin(&svg, 400, 300, NULL);
    contours_draw(&map, value, &svg);
    svg_end(&svg);
    return look(svg.data, measure);
}

int main(void)
{
    struct arena arena = {0};
    /* a circle is one closed line; linear between corners 1/20 apart it is off by 1/800 r */
    struct seen seen = drawn(radius, 0.5, -1, &arena);
    CHECK(seen.lines == 1 && seen.points > 60);
    CHECK_NEAR(seen.least, 0.5, 0.001, "radius of a circle, least");
    CHECK_NEAR(seen.most, 0.5, 0.001, "radius of a circle, most");
    /* a plane: a straight line from edge to edge, once an edge of the grid; a hole cuts it */
    seen = drawn(height, 0.33, -1, &arena);
    CHECK(seen.lines == 1 && seen.points == SIZE);
    CHECK_NEAR(seen.least, 0.33, 1e-4, "height of a line, least");
    CHECK_NEAR(seen.most, 0.33, 1e-4, "height of a line, most");
    seen = drawn(height, 0.33, 0.5, &arena);
    CHECK(seen.points < SIZE && seen.points > SIZE / 2);
    /* a saddle: the two branches of a hyperbola */
    seen = drawn(product, 0.1, -1, &arena);
    CHECK_NEAR(seen.least, 0.1, 0.001, "product on a hyperbola, least");
    CHECK_NEAR(seen.most, 0.1, 0.001, "product on a hyperbola, most");
    /* nothing beyond the values */
    CHECK(drawn(radius, 2, -1, &arena).lines == 0);
    arena_free(&arena);
    return check_report();
}
