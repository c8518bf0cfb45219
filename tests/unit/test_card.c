/* tests/unit/test_card.c - parts of cards that are said to be even, point by point. */
/* SPDX-License-Identifier: MIT */
#include "camera/subject/card.h"

#include "check.h"
#include "stream.h"

enum { PARTS = 10000, POINTS = 200, SIDE = 12, CHANNELS = 3 };

static struct stream stream = {.seed = 11};

/* A third of the sides lie where something of a chart begins, or a little beside that. */
static void side_of(double size, double middle, double half, double side[2])
{
    static const double divisors[] = {6, 12, 21, 24, 40, 160, SIDE};
    side[0] = middle - half;
    side[1] = middle + half;
    for (int i = 0; i < 2; i++) {
        if (next(&stream) < 1.0 / 3) {
            const double step = size / divisors[(size_t)between(&stream, 0, 7)];
            const double off = next(&stream) < 0.5 ? 0 : pow(10, between(&stream, -13, -2));
            side[i] = step * (round(side[i] / step) + (next(&stream) < 0.5 ? off : -off));
        }
    }
    if (side[0] > side[1]) {
        const double low = side[1];
        side[1] = side[0];
        side[0] = low;
    }
}

/* From a 10,000th of the card to a third of it, on it and beside it. */
static struct card_part part_of(const struct card *card)
{
    struct card_part part;
    for (int k = 0; k < 2; k++) {
        double side[2];
        const double size = k == 0 ? card->width : card->height;
        side_of(card->width, between(&stream, -0.6 * size, 0.6 * size),
                size / 2 * pow(10, between(&stream, -4, -0.5)), side);
        part.low[k] = side[0];
        part.high[k] = side[1];
    }
    return part;
}

/* Have its corners, and points in it, that light? */
static bool has(const struct card *card, const struct card_part *part, struct card_light light)
{
    bool same = true;
    for (int i = 0; i < POINTS && same; i++) {
        double at[2];
        for (int k = 0; k < 2; k++) {
            const double share = i < 4 ? i >> k & 1 : next(&stream);
            at[k] = part->low[k] * (1 - share) + part->high[k] * share;
        }
        const struct card_light seen = card_look(card, at[0], at[1]);
        for (int k = 0; k < CARD_CHANNELS; k++) {
            same = same && seen.of[k] == light.of[k];
        }
    }
    return same;
}

/* All parts that are said to be even are, and a tenth of them at least lies on the card. */
static void check_card(const struct card *card, const char *what)
{
    size_t evens = 0, wrong = 0;
    for (size_t i = 0; i < PARTS; i++) {
        const struct card_part part = part_of(card);
        struct card_light light;
        if (!card_is_even(card, &part, &light)) {
            continue;
        }
        const bool is_on = part.low[0] > -card->width / 2 && part.high[0] < card->width / 2 &&
                           part.low[1] > -card->height / 2 && part.high[1] < card->height / 2;
        evens += is_on;
        wrong += !has(card, &part, light);
    }
    CHECK_NEAR((double)wrong, 0, 0, what);
    check_at(evens >= PARTS / 10, __FILE__, __LINE__, what);
}

static void test_charts(void)
{
    static const enum chart all[] = {CHART_EDGE, CHART_STAR,  CHART_GRID,   CHART_CHECKER,
                                     CHART_BARS, CHART_WEDGE, CHART_POINTS, CHART_STARS};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        const struct card card = {.chart = all[i], .distance = 1000, .width = 360, .height = 240};
        check_card(&card, charts[all[i] - 1].word);
    }
}

/* Squares of 4 x 4 pixels have one colour each, some of them that of their neighbours. */
static void test_pictures(void)
{
    static float pixels[SIDE * SIDE * CHANNELS];
    for (size_t channels = 1; channels <= CHANNELS; channels += 2) {
        for (size_t i = 0; i < (size_t)SIDE * SIDE; i++) {
            const size_t square = i / SIDE / 4 * 3 + i % SIDE / 4;
            for (size_t k = 0; k < channels; k++) {
                pixels[i * channels + k] = square % 4 == 3 ? 0.25F + 0.1F * (float)k : 0.3F;
            }
        }
        const struct image image = {
            .width = SIDE, .height = SIDE, .channels = channels, .pixels = pixels};
        const struct card card = {.picture = &image, .distance = 1000, .width = 200, .height = 120};
        check_card(&card, channels == 1 ? "grey" : "coloured");
    }
}

/* By hand, on a card of 120 x 60 mm. */
static void test_places(void)
{
    static const struct {
        enum chart chart;
        double low[2], high[2];
        bool is_even;
        float light;
    } cases[] = {
        /* lines of 0.5 mm every 10 mm */
        {CHART_GRID, {0.26, 0.26}, {9.74, 9.74}, true, 1},
        {CHART_GRID, {0.24, 0.26}, {9.74, 9.74}, false, 0},
        {CHART_GRID, {0.26, 0.26}, {9.74, 9.76}, false, 0},
        {CHART_CHECKER, {10.01, 0.01}, {19.99, 9.99}, true, 1},
        {CHART_CHECKER, {10.01, -0.01}, {19.99, 9.99}, false, 0},
        /* 36 cycles out to 28.8 mm */
        {CHART_STAR, {0, 28.9}, {50, 29.9}, true, 1},
        {CHART_STAR, {0, 28.7}, {50, 29.9}, false, 0},
        /* discs of 0.6 mm, its diameter, every 10 mm */
        {CHART_POINTS, {0.31, 0.31}, {9.69, 9.69}, true, 0},
        {CHART_POINTS, {0.1, 0.1}, {9, 9}, false, 0},
        /* fields of 120/21 mm; the 11th has half a stop ten times */
        {CHART_WEDGE, {-2.8, -29}, {2.8, 29}, true, 0x1p-5F},
        {CHART_WEDGE, {-2.8, -29}, {2.9, 29}, false, 0},
        /* the edge: x = y tan 5 degrees, 2.5 mm at the upper end */
        {CHART_EDGE, {2.6, -29}, {50, 29}, true, 0.25F},
        {CHART_EDGE, {2.5, -29}, {50, 29}, false, 0},
        /* bars of 120/5/2 mm in the first group, 20 mm wide: white in its second half */
        {CHART_BARS, {-47.9, -29}, {-40.1, 29}, true, 1},
        {CHART_BARS, {-48.1, -29}, {-40.1, 29}, false, 0},
        /* beside the card, and across its end */
        {CHART_EDGE, {60.1, 0}, {70, 1}, true, 0},
        {CHART_EDGE, {50, 0}, {60.1, 1}, false, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct card card = {.chart = cases[i].chart, .width = 120, .height = 60};
        const struct card_part part = {{cases[i].low[0], cases[i].low[1]},
                                       {cases[i].high[0], cases[i].high[1]}};
        char what[32];
        struct card_light light;
        snprintf(what, sizeof what, "case %zu", i);
        const bool is = card_is_even(&card, &part, &light);
        check_at(is == cases[i].is_even, __FILE__, __LINE__, what);
        if (is) {
            CHECK_NEAR((double)light.of[0], (double)cases[i].light, 1e-9, what);
        }
    }
}

/* Of a picture so many pixels are compared at most; where they lie in it does not matter. */
static void test_large(void)
{
    enum { WIDE = 400 };
    static float pixels[WIDE * WIDE];
    const struct image image = {.width = WIDE, .height = WIDE, .channels = 1, .pixels = pixels};
    const struct card card = {.picture = &image, .width = WIDE, .height = WIDE};
    for (int i = 0; i < WIDE * WIDE; i++) {
        pixels[i] = 0.25F;
    }
    static const struct {
        double middle[2], half;
        bool is_even;
    } parts[] = {{{0, 0}, 126, true},     {{0, 0}, 130, false},    {{180, 180}, 10, true},
                 {{-180, 180}, 10, true}, {{180, -180}, 10, true}, {{-180, -180}, 10, true},
                 {{70, 70}, 126, true},   {{-70, -70}, 126, true}, {{70, 70}, 129, false},
                 {{-70, -70}, 129, false}};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        struct card_part part;
        struct card_light light;
        for (int k = 0; k < 2; k++) {
            part.low[k] = parts[i].middle[k] - parts[i].half;
            part.high[k] = parts[i].middle[k] + parts[i].half;
        }
        CHECK(card_is_even(&card, &part, &light) == parts[i].is_even);
    }
}

int main(void)
{
    test_charts();
    test_pictures();
    test_places();
    test_large();
    return check_report();
}
