/* tests/unit/test_texture.c - between the pixels of pictures on things. */
/* SPDX-License-Identifier: MIT */
#include "scene/texture.h"

#include "check.h"

/* Two pixels wide and high, as one looks at it: 1 2 above, 4 8 below. */
static float grey[] = {1, 2, 4, 8};
static const struct image picture = {.width = 2, .height = 2, .channels = 1, .pixels = grey};

static void test_places(void)
{
    static const struct {
        const char *what;
        double place[2];
        enum texture_edges edges;
        double expected;
    } cases[] = {
        {"upper left pixel", {0.25, 0.75}, TEXTURE_ENDS, 1},
        {"upper right", {0.75, 0.75}, TEXTURE_ENDS, 2},
        {"lower left", {0.25, 0.25}, TEXTURE_ENDS, 4},
        {"lower right", {0.75, 0.25}, TEXTURE_REPEATS, 8},
        {"in the middle", {0.5, 0.5}, TEXTURE_ENDS, 3.75},
        {"nearer to the lower right",
         {0.625, 0.375},
         TEXTURE_REPEATS,
         0.0625 + 3.0 / 16 * 6 + 8 * 9.0 / 16},
        {"corner", {0, 1}, TEXTURE_ENDS, 1},
        {"other corner", {1, 0}, TEXTURE_ENDS, 8},
        {"corner of all four", {0, 1}, TEXTURE_REPEATS, 3.75},
        {"other corner of all four", {1, 0}, TEXTURE_REPEATS, 3.75},
        {"left border", {0, 0.75}, TEXTURE_REPEATS, 1.5},
        /* half of 1 and half of 2 */
        {"seam of a globe", {0, 0.75}, TEXTURE_ROUND, 1.5},
        {"seam of a globe, from the other side", {1, 1}, TEXTURE_ROUND, 1.5},
        {"pole of a globe", {0.25, 1}, TEXTURE_ROUND, 1},
        {"other pole", {0.75, 0}, TEXTURE_ROUND, 8},
        {"beyond", {-3, 9}, TEXTURE_ENDS, 1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        double of[TEXTURE_CHANNELS];
        texture_lookup(&picture, cases[i].place, cases[i].edges, of);
        for (size_t k = 0; k < TEXTURE_ALPHA; k++) {
            CHECK_NEAR(of[k], cases[i].expected, 1e-15, cases[i].what);
        }
        CHECK_NEAR(of[TEXTURE_ALPHA], 1, 0, "nothing is missing");
    }
}

static void test_channels(void)
{
    float pixels[] = {0.125F, 0.25F, 0.5F, 0.75F};
    const double place[] = {0.1, 0.9};
    double of[TEXTURE_CHANNELS];
    for (size_t channels = 1; channels <= 4; channels++) {
        const struct image one = {.width = 1, .height = 1, .channels = channels, .pixels = pixels};
        texture_lookup(&one, place, TEXTURE_ENDS, of);
        CHECK_NEAR(of[1], channels < 3 ? 0.125 : 0.25, 0, "green");
        CHECK_NEAR(of[2], channels < 3 ? 0.125 : 0.5, 0, "blue");
        CHECK_NEAR(of[TEXTURE_ALPHA], channels < 4 ? 1 : 0.75, 0, "alpha");
    }
}

/* What is no place has no light. */
static void test_nowhere(void)
{
    static const double places[][2] = {
        {NAN, 0.5}, {0.5, NAN}, {INFINITY, 0.5}, {0.5, -INFINITY}, {NAN, INFINITY}};
    static const enum texture_edges all[] = {TEXTURE_REPEATS, TEXTURE_ENDS, TEXTURE_ROUND};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
            double of[TEXTURE_CHANNELS];
            texture_lookup(&picture, places[i], all[k], of);
            CHECK(isnan(of[0]) && isnan(of[1]) && isnan(of[2]));
        }
    }
}

int main(void)
{
    test_places();
    test_channels();
    test_nowhere();
    return check_report();
}
