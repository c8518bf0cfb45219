/* tests/unit/test_sampler.c - the numbers of rays: even, independent, the same in any order. */
/* SPDX-License-Identifier: MIT */
#include "scene/sampler.h"

#include "check.h"

enum { FIRST = 5, BITS = 20, COUNT = 1024, TOLD = SAMPLER_DIMENSIONS + 6 };

/* The dimensions of one sequence that begin where the film's end. */
static void test_sobol(const struct sampler_table *table)
{
    struct sampler_sequence sequence;
    sampler_sequence_open(table, 7, 11, &sequence);
    for (uint32_t i = 0; i < 300; i += 7) {
        struct sampler points = sampler_of(&sequence, i, 0);
        for (uint32_t k = 0; k < SAMPLER_DIMENSIONS; k++) {
            struct sobol sobol;
            sobol_open(FIRST + k, &sobol);
            CHECK(sampler_next(&points) ==
                  sobol_point(&sobol, sobol_scrambling(7, 11, FIRST + k), i));
        }
    }
}

/* Each of 2^m points in one of 2^m parts; beyond the table as often as by chance. */
static void test_even(const struct sampler_table *table)
{
    static unsigned char seen[TOLD][COUNT];
    struct sampler_sequence sequence;
    int filled[TOLD] = {0};
    sampler_sequence_open(table, 1, 2, &sequence);
    for (uint32_t i = 0; i < COUNT; i++) {
        struct sampler points = sampler_of(&sequence, i, 0);
        for (int k = 0; k < TOLD; k++) {
            const double u = sampler_next(&points);
            CHECK(u > 0 && u < 1);
            unsigned char *part = &seen[k][(size_t)(u * COUNT)];
            filled[k] += *part == 0;
            *part = 1;
        }
    }
    for (int k = 0; k < TOLD; k++) {
        /* by chance 1 - 1/e of them, +- sqrt((e - 2)/n)/e */
        const double chance = 1 - exp(-1);
        CHECK_NEAR(filled[k], k < SAMPLER_DIMENSIONS ? COUNT : COUNT * chance,
                   k < SAMPLER_DIMENSIONS ? 0 : 4 * sqrt((exp(1) - 2) * COUNT) / exp(1), "parts");
    }
}

/* Another seed, sequence, ray or turn: other numbers; the same: the same, whoever asked between. */
static void test_order(const struct sampler_table *table)
{
    struct sampler_sequence sequence, seed, number;
    sampler_sequence_open(table, 3, 4, &sequence);
    sampler_sequence_open(table, 5, 4, &seed);
    sampler_sequence_open(table, 3, 6, &number);
    struct sampler a = sampler_of(&sequence, 9, 0), b = a, other = sampler_of(&sequence, 10, 0);
    struct sampler c = sampler_of(&seed, 9, 0), d = sampler_of(&number, 9, 0);
    double first[TOLD], last = -1;
    for (int k = 0; k < TOLD; k++) {
        first[k] = sampler_next(&a);
        CHECK(first[k] != last);
        last = first[k];
    }
    for (int k = 0; k < TOLD; k++) {
        CHECK(sampler_next(&other) != first[k]);
        CHECK(sampler_next(&c) != first[k] && sampler_next(&d) != first[k]);
        CHECK(sampler_next(&b) == first[k]);
    }
}

int main(void)
{
    struct arena arena = {0};
    const struct sampler_table *table = sampler_table_new(FIRST, BITS, &arena);
    test_sobol(table);
    test_even(table);
    test_order(table);
    arena_free(&arena);
    return check_report();
}
