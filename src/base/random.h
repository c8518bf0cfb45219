/* base/random.h - random numbers by counting: the same whatever is asked first, and where. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_RANDOM_H
#define LENSCALC_BASE_RANDOM_H

#include <stdint.h>

struct random_words {
    uint32_t w[4];
};

/*
 * The generator: a counter enciphered.
 *
 * Given     counter, and key[0] and key[1]   any
 * Result    128 random bits; another counter or key gives others that have nothing to do with them
 * Formula   Philox4x32-10: ten rounds (R0, L1, R1', L1') of two 32 x 32 bit products
 * Source    [Salmon11] section 3.3; tested with the known answers of their Random123
 */
static inline struct random_words random_cipher(struct random_words counter, uint32_t key0,
                                                uint32_t key1)
{
    uint32_t a = counter.w[0], b = counter.w[1], c = counter.w[2], d = counter.w[3];
    for (int round = 0; round < 10; round++) {
        const uint64_t first = 0xd2511f53U * (uint64_t)a, second = 0xcd9e8d57U * (uint64_t)c;
        a = (uint32_t)(second >> 32) ^ b ^ key0;
        b = (uint32_t)second;
        c = (uint32_t)(first >> 32) ^ d ^ key1;
        d = (uint32_t)first;
        key0 += 0x9e3779b9U;
        key1 += 0xbb67ae85U;
    }
    return (struct random_words){{a, b, c, d}};
}

/* What numbers are for: one seed serves several purposes, which know nothing of each other. */
enum random_purpose {
    RANDOM_UNITS,      /* random_pair */
    RANDOM_SCRAMBLING, /* sobol_scrambling */
    RANDOM_NOISE,      /* sensor_expose */
    RANDOM_GRAIN,      /* emulsion_expose */
    RANDOM_STARS,      /* card_look */
    RANDOM_ESCAPES,    /* global_descend */
    RANDOM_TOLERANCES, /* tolerance_errors */
    RANDOM_PATHS,      /* points_next */
    RANDOM_CELLS,      /* tile_order */
    RANDOM_LAYOUTS,    /* predesign_find */
};

/* Numbers `which` of a purpose, for one sample of a run. */
static inline struct random_words random_words(enum random_purpose purpose, uint64_t seed,
                                               uint64_t sample, uint32_t which)
{
    const struct random_words counter = {
        {(uint32_t)sample, (uint32_t)(sample >> 32), which, (uint32_t)purpose}};
    return random_cipher(counter, (uint32_t)seed, (uint32_t)(seed >> 32));
}

/* In 0..1, neither of them: the middles of 2^52 steps. Exact, so the same everywhere. */
static inline double random_unit_of(uint32_t high, uint32_t low)
{
    const uint64_t step = (uint64_t)high << 20 | low >> 12;
    return ((double)step + 0.5) * 0x1p-52;
}

struct random_pair {
    double u, v;
};

/*
 * Independent numbers, evenly spread.
 *
 * Given     seed, sample   of the run, any
 *           pair           dimensions 2 pair and 2 pair + 1 of that sample
 * Result    each in 0..1, neither of them, a multiple of 2^-53
 */
static inline struct random_pair random_pair(uint64_t seed, uint64_t sample, uint32_t pair)
{
    const struct random_words words = random_words(RANDOM_UNITS, seed, sample, pair);
    return (struct random_pair){random_unit_of(words.w[0], words.w[1]),
                                random_unit_of(words.w[2], words.w[3])};
}

/* Dimension `dimension` alone. */
static inline double random_unit(uint64_t seed, uint64_t sample, uint32_t dimension)
{
    const struct random_pair pair = random_pair(seed, sample, dimension / 2);
    return dimension % 2 == 0 ? pair.u : pair.v;
}

#endif
