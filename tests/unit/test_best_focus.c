/* tests/unit/test_best_focus.c - the plane where rays spread least, from lines given as numbers. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "trace/pupil/focus.h"

#include <stdlib.h>

/* A line through (x, y, z) with the slopes a, b. */
struct line {
    double x, y, z, a, b, weight;
};

static double focus_of(const struct line *lines, size_t count, size_t lost)
{
    struct arena arena = {0};
    struct rays rays = rays_new(&arena, count);
    double *weights = ARENA_ARRAY(&arena, count, double);
    for (size_t i = 0; i < count; i++) {
        const struct line *line = &lines[i];
        double length = sqrt(1 + line->a * line->a + line->b * line->b);
        const struct ray ray = {.point = {line->x, line->y, line->z},
                                .cosine = {line->a / length, line->b / length, 1 / length}};
        rays_set(&rays, i, 1.5, &ray);
        weights[i] = line->weight;
        if (i == lost) {
            rays.blocks[i / RAYS_BLOCK].lost[i % RAYS_BLOCK] = RAY_LOST_AT(1, 1, RAY_MISS);
        }
    }
    double z = rays_best_focus(&rays, weights);
    arena_free(&arena);
    return z;
}

static const size_t NONE = (size_t)-1;

/* All through one point off the axis: there they meet, whatever their weights. */
static void test_point(void)
{
    struct line lines[5];
    for (int i = 0; i < 5; i++) {
        double a = 0.1 * i - 0.05, b = 0.03 * i * i - 0.2, z = 3 * i;
        lines[i] = (struct line){7 + a * (z - 40), -2 + b * (z - 40), z, a, b, 1 + i};
    }
    CHECK_NEAR(focus_of(lines, 5, NONE), 40, 1e-12, "through one point");
    /* one that goes elsewhere does not count where it is lost, or has no weight */
    lines[2].x += 1;
    CHECK_NEAR(focus_of(lines, 5, 2), 40, 1e-12, "a lost ray");
    lines[2].weight = 0;
    CHECK_NEAR(focus_of(lines, 5, NONE), 40, 1e-12, "no weight");
}

/*
 * Three rays in one plane through z = 0 at 1, 4, 2 with slopes 0, -1, 1/2 and weights 1, 2, 1:
 * means 11/4 and -3/8; sum w x a = -8 + 1 - 4 (11/4)(-3/8) = -23/8, sum w a^2 = 2 + 1/4 - 9/16 =
 * 27/16; z = (23/8)/(27/16) = 46/27. The same lines stated elsewhere, and across.
 */
static void test_least_squares(void)
{
    static const struct line lines[] = {
        {1, 0, 0, 0, 0, 1}, {4, 0, 0, -1, 0, 2}, {2, 0, 0, 0.5, 0, 1}};
    static const struct line moved[] = {
        {0, 1, 5, 0, 0, 1}, {0, 1, 3, 0, -1, 2}, {0, 1, -2, 0, 0.5, 1}};
    CHECK_NEAR(focus_of(lines, 3, NONE), 46.0 / 27, 1e-14, "by hand");
    CHECK_NEAR(focus_of(moved, 3, NONE), 46.0 / 27, 1e-14, "in y, from other places");
}

/* One ray, or parallel ones, meet nowhere. */
static void test_parallel(void)
{
    static const struct line lines[] = {{1, 2, 0, 0.3, 0.1, 1}, {4, 0, 0, 0.3, 0.1, 2}};
    CHECK(isnan(focus_of(lines, 1, NONE)));
    CHECK(isnan(focus_of(lines, 2, NONE)));
    CHECK(isnan(focus_of(lines, 2, 1)));
}

/* More rays than a block has: pairs that cross at 2 and at 4 alike. */
static void test_blocks(void)
{
    enum { COUNT = 2 * RAYS_BLOCK + 40 };
    struct line *lines = calloc(COUNT, sizeof *lines);
    for (int i = 0; i < COUNT; i++) {
        double slope = (i % 2 ? 0.1 : -0.1), cross = i % 4 < 2 ? 2 : 4;
        lines[i] = (struct line){-slope * cross, 0, 0, slope, 0, 1};
    }
    CHECK_NEAR(focus_of(lines, COUNT, NONE), 3, 1e-13, "between the two");
    free(lines);
}

int main(void)
{
    test_point();
    test_least_squares();
    test_parallel();
    test_blocks();
    return check_report();
}
