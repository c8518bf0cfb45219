/* tests/unit/test_neutral.c - stacks of neutral-density filters, by exact sums and all subsets. */
/* SPDX-License-Identifier: MIT */
#include "photo/neutral.h"

#include <math.h>
#include <stdint.h>

#include "check.h"

static const double usual[] = {1, 2, 3, 6, 10};
enum { USUAL = sizeof usual / sizeof usual[0] };

static void test_sums(void)
{
    static const struct {
        double wanted;
        size_t most, found;
        double stops[4];
        const char *source;
    } rows[] = {
        {11, 3, 3, {10, 11, 12, 0}, "10, then 10 + 1 exactly and 10 + 2"},
        {3, 3, 3, {3, 6, 4, 0}, "a filter that is there; above it 3 + 1 is nearer than 6"},
        {4, 2, 4, {3, 6, 4, 5}, "between two, then 3 + 1 and 3 + 2"},
        {7.5, 3, 4, {6, 10, 7, 8}, "then 6 + 1 and 6 + 2"},
        {0.5, 3, 1, {1, 0, 0, 0}, "none takes less"},
        {40, 3, 3, {10, 16, 19, 0}, "none takes more: 10, 10 + 6, 10 + 6 + 3"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct neutral_stack stacks[NEUTRAL_STACKS];
        struct error error;
        size_t found;
        CHECK(neutral_stacks(usual, USUAL, rows[i].most, rows[i].wanted, stacks, &found, &error));
        CHECK(found == rows[i].found);
        for (size_t k = 0; k < found && k < rows[i].found; k++) {
            double sum = 0;
            for (size_t j = 0; j < stacks[k].count; j++) {
                sum += usual[stacks[k].filters[j]];
            }
            CHECK_NEAR(stacks[k].stops, rows[i].stops[k], 0, rows[i].source);
            CHECK_NEAR(sum, rows[i].stops[k], 0, rows[i].source);
        }
    }
}

/* Against all subsets of up to three, as sets of bits. */
static void test_subsets(void)
{
    enum { THERE = 9, ROUNDS = 200 };
    uint32_t state = 7;
    for (int round = 0; round < ROUNDS; round++) {
        double strengths[THERE], low = -1, high = INFINITY, sum = 0;
        for (int i = 0; i < THERE; i++) {
            state = state * 1664525u + 1013904223u;
            sum += 0.125 * (double)(1 + (state >> 24) % 16);
            strengths[i] = sum / 2;
        }
        state = state * 1664525u + 1013904223u;
        const double wanted = 0.0625 * (double)(1 + (state >> 16) % 300);
        for (unsigned set = 1; set < 1u << THERE; set++) {
            double stops = 0;
            int count = 0;
            for (int i = 0; i < THERE; i++) {
                stops += (set >> i & 1) != 0 ? strengths[i] : 0;
                count += (int)(set >> i & 1);
            }
            if (count <= NEUTRAL_FILTERS) {
                low = stops <= wanted ? fmax(low, stops) : low;
                high = stops > wanted ? fmin(high, stops) : high;
            }
        }
        struct neutral_stack stacks[NEUTRAL_STACKS];
        struct error error;
        size_t found;
        double below = -1, above = INFINITY;
        CHECK(neutral_stacks(strengths, THERE, NEUTRAL_FILTERS, wanted, stacks, &found, &error));
        for (size_t i = 0; i < found; i++) {
            below = stacks[i].stops <= wanted ? fmax(below, stacks[i].stops) : below;
            above = stacks[i].stops > wanted ? fmin(above, stacks[i].stops) : above;
        }
        CHECK(below == low);
        CHECK(above == high);
    }
}

/* 0.1 + 0.2 is 0.3, whatever doubles make of it: no stack that takes more. */
static void test_equal_sums(void)
{
    static const double strengths[] = {0.1, 0.2, 0.3};
    struct neutral_stack stacks[NEUTRAL_STACKS];
    struct error error;
    size_t found;
    CHECK(neutral_stacks(strengths, 3, 3, 0.3, stacks, &found, &error));
    CHECK(found == 2);
    CHECK_NEAR(stacks[0].stops, 0.3, 0, "the filter itself");
    CHECK_NEAR(stacks[1].stops, 0.4, 1e-15, "0.3 + 0.1");
}

static void test_refusals(void)
{
    struct neutral_stack stacks[NEUTRAL_STACKS];
    struct error error;
    size_t found;
    CHECK(!neutral_stacks(usual, USUAL, 3, 0, stacks, &found, &error));
    CHECK(!neutral_stacks(usual, USUAL, 3, NAN, stacks, &found, &error));
    CHECK(!neutral_stacks(usual, USUAL, 3, INFINITY, stacks, &found, &error));
    CHECK(!neutral_stacks(usual, 0, 3, 5, stacks, &found, &error));
    CHECK(!neutral_stacks(usual, USUAL, 0, 5, stacks, &found, &error));
    CHECK(!neutral_stacks(usual, USUAL, NEUTRAL_FILTERS + 1, 5, stacks, &found, &error));
}

int main(void)
{
    test_sums();
    test_subsets();
    test_equal_sums();
    test_refusals();
    return check_report();
}
