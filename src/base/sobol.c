/* base/sobol.c - Sobol' sequences in many dimensions, scrambled by hashing. */
/* SPDX-License-Identifier: MIT */
#include "base/sobol.h"

#include "base/random.h"

#include <assert.h>

static uint32_t sobol_reversed(uint32_t word)
{
    uint32_t backwards = 0;
    for (int i = 0; i < 32; i++) {
        backwards |= (word >> i & 1) << (31 - i);
    }
    return backwards;
}

/* v_1 .. v_32, their bits as they are. */
static void find_directions(uint32_t dimension, uint32_t v[32])
{
    if (dimension == 0) {
        for (int k = 0; k < 32; k++) {
            v[k] = 0x80000000U >> k;
        }
        return;
    }
    const struct sobol_numbers *numbers = &sobol_numbers[dimension - 1];
    int degree = 0;
    while (numbers->polynomial >> (degree + 1) != 0) {
        degree++;
    }
    for (int k = 0; k < 32; k++) {
        if (k < degree) {
            v[k] = (uint32_t)numbers->m[k] << (31 - k);
            continue;
        }
        v[k] = v[k - degree] >> degree;
        for (int i = 1; i <= degree; i++) {
            v[k] ^= numbers->polynomial >> (degree - i) & 1 ? v[k - i] : 0;
        }
    }
}

void sobol_open(uint32_t dimension, struct sobol *sobol)
{
    uint32_t v[32];
    assert(dimension < SOBOL_DIMENSIONS);
    find_directions(dimension, v);
    sobol->low[0] = 0;
    for (uint32_t i = 1; i < SOBOL_BLOCK; i++) {
        int highest = 0;
        while (i >> (highest + 1) != 0) {
            highest++;
        }
        sobol->low[i] = sobol->low[i ^ 1U << highest] ^ sobol_reversed(v[highest]);
    }
    for (int k = SOBOL_LOW; k < 32; k++) {
        sobol->high[k - SOBOL_LOW] = sobol_reversed(v[k]);
    }
}

void sobol_open_strands(uint32_t dimension, uint32_t bits, struct sobol *sobol)
{
    uint32_t v[32];
    assert(dimension < SOBOL_DIMENSIONS && bits <= 32 - SOBOL_LOW);
    find_directions(dimension, v);
    for (uint32_t i = 0; i < SOBOL_BLOCK; i++) {
        sobol->low[i] = 0;
        for (uint32_t k = 0; k < SOBOL_LOW; k++) {
            sobol->low[i] ^= i >> k & 1 ? sobol_reversed(v[bits + k]) : 0;
        }
    }
    for (uint32_t k = 0; k < 32 - SOBOL_LOW; k++) {
        sobol->high[k] = sobol_reversed(v[k]);
    }
}

uint32_t sobol_scrambling(uint64_t seed, uint64_t sequence, uint32_t dimension)
{
    return random_words(RANDOM_SCRAMBLING, seed, sequence, dimension).w[0];
}
