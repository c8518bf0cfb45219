/* tests/unit/test_random.c - random numbers by counting: known answers, spread, independence. */
/* SPDX-License-Identifier: MIT */
#include "base/random.h"
#include "check.h"

/* Random123 1.14, tests/kat_vectors, lines "philox4x32 10": counter, key, answer. */
static const struct known {
    struct random_words counter;
    uint32_t key[2];
    struct random_words answer;
} known[] = {
    {{{0, 0, 0, 0}}, {0, 0}, {{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}}},
    {{{0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}},
     {0xffffffff, 0xffffffff},
     {{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}}},
    {{{0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}},
     {0xa4093822, 0x299f31d0},
     {{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}}},
};

static void test_known(void)
{
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        const struct random_words got =
            random_cipher(known[i].counter, known[i].key[0], known[i].key[1]);
        for (int k = 0; k < 4; k++) {
            CHECK(got.w[k] == known[i].answer.w[k]);
        }
    }
    /* where seed, sample and number go: the third line again */
    const struct random_words third = random_words(
        (enum random_purpose)0x03707344, 0x299f31d0a4093822U, 0x85a308d3243f6a88U, 0x13198a2e);
    CHECK(third.w[0] == 0xd16cfe09 && third.w[3] == 0x24126ea1);
}

/* The ends of the range: (2^52 - 1 + 1/2) 2^-52 is 1 - 2^-53, and no rounding makes it 1. */
static void test_ends(void)
{
    CHECK(random_unit_of(0, 0) == 0x1p-53);
    CHECK(random_unit_of(0, 0xfff) == 0x1p-53);
    CHECK(random_unit_of(0, 0x1000) == 3 * 0x1p-53);
    CHECK(random_unit_of(0xffffffff, 0xffffffff) == 1 - 0x1p-53);
    CHECK(random_unit_of(0x80000000, 0) == 0.5 + 0x1p-53);
}

/* A pair is made of all words of a cipher text, each number of the 52 leading bits of two. */
static void test_pair(void)
{
    const struct random_words words = random_words(RANDOM_UNITS, 7, 12345, 3);
    const struct random_pair pair = random_pair(7, 12345, 3);
    const double u = words.w[0] * 0x1p20 + words.w[1] / 4096 + 0.5;
    const double v = words.w[2] * 0x1p20 + words.w[3] / 4096 + 0.5;
    CHECK(pair.u == ldexp(u, -52) && pair.v == ldexp(v, -52));
}

/*
 * Moments of what is evenly spread: mean 1/2, variance 1/12, that of the square 4/45; neighbours
 * in sample, dimension and seed do not go together. All within 4 sigma of 200000 numbers.
 */
static void test_spread(void)
{
    enum { COUNT = 200000 };
    double sum = 0, sum2 = 0, along = 0, across = 0, beside = 0;
    for (uint64_t i = 0; i < COUNT; i++) {
        const double u = random_unit(7, i, 5) - 0.5;
        sum += u;
        sum2 += u * u;
        along += u * (random_unit(7, i + 1, 5) - 0.5);
        across += u * (random_unit(7, i, 4) - 0.5);
        beside += u * (random_unit(8, i, 5) - 0.5);
    }
    const double root = sqrt((double)COUNT);
    CHECK_NEAR(sum / COUNT, 0, 4 * sqrt(1 / 12.0) / root, "mean");
    CHECK_NEAR(sum2 / COUNT, 1 / 12.0, 4 * sqrt(1 / 80.0 - 1 / 144.0) / root, "variance");
    CHECK_NEAR(along / COUNT, 0, 4 / 12.0 / root, "samples");
    CHECK_NEAR(across / COUNT, 0, 4 / 12.0 / root, "dimensions");
    CHECK_NEAR(beside / COUNT, 0, 4 / 12.0 / root, "seeds");
}

/* Seeds and samples above 2^32 are others; a pair is its two dimensions. */
static void test_arguments(void)
{
    const double here = random_unit(1, 1, 0);
    CHECK(here != random_unit(1 + (1ULL << 32), 1, 0) && here != random_unit(1, 1ULL << 32, 0));
    const struct random_pair pair = random_pair(3, 9, 6);
    CHECK(pair.u == random_unit(3, 9, 12) && pair.v == random_unit(3, 9, 13));
    const struct random_words other = random_words(RANDOM_SCRAMBLING, 1, 1, 0);
    CHECK(other.w[0] != random_words(RANDOM_UNITS, 1, 1, 0).w[0]);
}

int main(void)
{
    test_known();
    test_ends();
    test_pair();
    test_spread();
    test_arguments();
    return check_report();
}
