/* scene/points.h - the numbers that a ray decides by on its way through a scene. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_SCENE_POINTS_H
#define LENSCALC_SCENE_POINTS_H

#include "base/arena.h"
#include "base/sobol.h"

#include <stdint.h>

/* So many numbers of a ray are of Sobol' sequences; those it asks for after them are random. */
enum { POINTS_DIMENSIONS = 64 };

/* Dimensions of Sobol' sequences, made once for a picture. */
struct points_table {
    struct sobol sobol[POINTS_DIMENSIONS];
    uint32_t first; /* which one sobol[0] is */
};

/* What the rays of one sequence have in common, as those of a tile of a picture. */
struct points_sequence {
    const struct points_table *table;
    uint64_t seed;
    uint32_t number;
    uint32_t scrambling[POINTS_DIMENSIONS];
};

/* The numbers of one ray. */
struct points {
    const struct points_sequence *sequence;
    uint32_t index; /* of the ray: in blocks of its sequence, one behind the other */
    uint32_t next;  /* how many have been asked for */
};

/*
 * Given     first  dimension from which on rays have their numbers: those below it are for where
 *                  and when they begin; first + POINTS_DIMENSIONS at most SOBOL_DIMENSIONS
 *           bits   as sobol_open_strands has them: rays are places of its blocks
 */
const struct points_table *points_table_new(uint32_t first, uint32_t bits, struct arena *arena);

/*
 * A sequence of rays.
 *
 * Given     seed, number  as sobol_scrambling has them: where the dimensions below table->first are
 *                         scrambled with the same two, all are of one sequence
 */
void points_sequence_open(const struct points_table *table, uint64_t seed, uint32_t number,
                          struct points_sequence *sequence);

/* Those of one of its rays: a place of a block of the sequence. */
static inline struct points points_of(const struct points_sequence *sequence, uint32_t block,
                                      uint32_t place)
{
    return (struct points){.sequence = sequence, .index = block * SOBOL_BLOCK + place};
}

/*
 * The next number of a ray, in 0..1, neither of them.
 *
 * Result    the same for the same seed, sequence, index and turn, whatever was asked before; evenly
 *           spread, and over the points of a sequence more evenly than by chance
 * Source    [Burley20] (Sobol' dimensions, each scrambled by hashing); [Salmon11] beyond them
 */
double points_next(struct points *points);

#endif
