/* scene/sampler.h - sampler: the numbers of a ray, dimension by dimension. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_SCENE_SAMPLER_H
#define LENSCALC_SCENE_SAMPLER_H

#include "base/arena.h"
#include "base/sobol.h"

#include <stdint.h>

/* So many numbers of a ray are of Sobol' sequences; those it asks for after them are random. */
enum { SAMPLER_DIMENSIONS = 64 };

/* Dimensions of Sobol' sequences, made once for a picture. */
struct sampler_table {
    struct sobol sobol[SAMPLER_DIMENSIONS];
    uint32_t first; /* which one sobol[0] is */
};

/* What the rays of one sequence have in common, as those of a tile of a picture. */
struct sampler_sequence {
    const struct sampler_table *table;
    uint64_t seed;
    uint32_t number;
    uint32_t scrambling[SAMPLER_DIMENSIONS];
};

/* The numbers of one ray. */
struct sampler {
    const struct sampler_sequence *sequence;
    uint32_t index; /* of the ray: in blocks of its sequence, one behind the other */
    uint32_t next;  /* how many have been asked for */
};

/*
 * Given     first  dimension from which on rays have their numbers: those below it are for where
 *                  and when they begin; first + POINTS_DIMENSIONS at most SOBOL_DIMENSIONS
 *           bits   as sobol_open_strands has them: rays are places of its blocks
 */
const struct sampler_table *sampler_table_new(uint32_t first, uint32_t bits, struct arena *arena);

/*
 * A sequence of rays.
 *
 * Given     seed, number  as sobol_scrambling has them: where the dimensions below table->first are
 *                         scrambled with the same two, all are of one sequence
 */
void sampler_sequence_open(const struct sampler_table *table, uint64_t seed, uint32_t number,
                           struct sampler_sequence *sequence);

/* Those of one of its rays: a place of a block of the sequence. */
static inline struct sampler sampler_of(const struct sampler_sequence *sequence, uint32_t block,
                                        uint32_t place)
{
    return (struct sampler){.sequence = sequence, .index = block * SOBOL_BLOCK + place};
}

/*
 * The next number of a ray, in 0..1, neither of them.
 *
 * Result    the same for the same seed, sequence, index and turn, whatever was asked before; evenly
 *           spread, and over the points of a sequence more evenly than by chance
 * Source    [Burley20] (Sobol' dimensions, each scrambled by hashing); [Salmon11] beyond them
 */
double sampler_next(struct sampler *sampler);

#endif
