/* base/sobol.h - Sobol' sequences in many dimensions, scrambled by hashing. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_SOBOL_H
#define LENSCALC_BASE_SOBOL_H

#include "base/sobol_numbers.h"

#include <stdint.h>

/* Points of a block differ in SOBOL_LOW bits of their number. */
enum { SOBOL_LOW = 7, SOBOL_BLOCK = 1 << SOBOL_LOW };

/*
 * One dimension, made to be asked for blocks of points: a point of a block is `low` of its place
 * there, xor a word that the block's points have in common. All words have their bits in reverse,
 * 2^0 standing for 1/2, as scrambling wants them.
 */
struct sobol {
    uint32_t low[SOBOL_BLOCK];
    uint32_t high[32 - SOBOL_LOW];
};

/*
 * Given     dimension   0 .. SOBOL_DIMENSIONS - 1
 * Result    point i is the xor of the direction numbers v_k of all k for which i has a 1 at 2^(k-1)
 * Source    [JoeKuo08]
 */
void sobol_open(uint32_t dimension, struct sobol *sobol);

/*
 * The same with blocks laid out across: block b, below 2^bits, holds of each strand of 2^bits
 * points that follow each other the one numbered b: place i of it is point 2^bits i + b. So a
 * strand is a net by itself, and so are 2, 4, 8 .. strands that follow each other.
 *
 * Given     bits   up to 32 - SOBOL_LOW
 */
void sobol_open_strands(uint32_t dimension, uint32_t bits, struct sobol *sobol);

/* What the points of one block, those numbered SOBOL_BLOCK block + 0, 1, .., have in common. */
static inline uint32_t sobol_common(const struct sobol *sobol, uint32_t block)
{
    uint32_t word = 0;
    for (int k = 0; k < 32 - SOBOL_LOW; k++) {
        word ^= block >> k & 1 ? sobol->high[k] : 0;
    }
    return word;
}

/* Point `i`, bits in reverse, as it was before scrambling. */
static inline uint32_t sobol_word(const struct sobol *sobol, uint32_t i)
{
    return sobol->low[i % SOBOL_BLOCK] ^ sobol_common(sobol, i / SOBOL_BLOCK);
}

/*
 * Owen's scrambling: each bit is turned over or not by chance, which knows the bits above it. So
 * every stratum keeps its number of points, and each point is spread evenly over 0..1.
 *
 * Given     word        bits in reverse
 *           scrambling  one of 2^32 scramblings
 * Formula   a hash in which a bit depends on the lower ones alone
 * Source    [Burley20]; multipliers of [Vegdahl21]
 */
static inline uint32_t sobol_scrambled(uint32_t word, uint32_t scrambling)
{
    word ^= word * 0x3d20adeaU;
    word += scrambling;
    word *= scrambling >> 16 | 1;
    word ^= word * 0x05526c56U;
    return word ^ word * 0x53a22864U;
}

/* In 0..1, neither of them: the word's bits read backwards, and the middle of that step. Exact. */
static inline double sobol_unit(uint32_t word)
{
    word = (word & 0x55555555U) << 1 | (word >> 1 & 0x55555555U);
    word = (word & 0x33333333U) << 2 | (word >> 2 & 0x33333333U);
    word = (word & 0x0f0f0f0fU) << 4 | (word >> 4 & 0x0f0f0f0fU);
    word = (word & 0x00ff00ffU) << 8 | (word >> 8 & 0x00ff00ffU);
    word = word << 16 | word >> 16;
    /* with a sign, as vectors convert it */
    return (double)(int32_t)(word ^ 0x80000000U) * 0x1p-32 + (0.5 + 0x1p-33);
}

/*
 * The scrambling of one dimension of one sequence: sequences of different numbers or seeds are
 * independent.
 */
uint32_t sobol_scrambling(uint64_t seed, uint64_t sequence, uint32_t dimension);

/* Point i of a scrambled dimension. */
static inline double sobol_point(const struct sobol *sobol, uint32_t scrambling, uint32_t i)
{
    return sobol_unit(sobol_scrambled(sobol_word(sobol, i), scrambling));
}

/* The points of a block: a loop without branches, of which a kernel makes vectors. */
static inline void sobol_points(const struct sobol *sobol, uint32_t scrambling, uint32_t block,
                                double points[SOBOL_BLOCK])
{
    const uint32_t common = sobol_common(sobol, block);
    for (int i = 0; i < SOBOL_BLOCK; i++) {
        points[i] = sobol_unit(sobol_scrambled(sobol->low[i] ^ common, scrambling));
    }
}

#endif
