/* scene/sampler.c - sampler: the numbers of a ray, dimension by dimension. */
/* SPDX-License-Identifier: MIT */
#include "scene/sampler.h"

#include "base/random.h"

#include <assert.h>

const struct sampler_table *sampler_table_new(uint32_t first, uint32_t bits, struct arena *arena)
{
    struct sampler_table *table = ARENA_NEW(arena, struct sampler_table);
    assert(first + SAMPLER_DIMENSIONS <= SOBOL_DIMENSIONS);
    table->first = first;
    for (uint32_t k = 0; k < SAMPLER_DIMENSIONS; k++) {
        sobol_open_strands(first + k, bits, &table->sobol[k]);
    }
    return table;
}

void sampler_sequence_open(const struct sampler_table *table, uint64_t seed, uint32_t number,
                           struct sampler_sequence *sequence)
{
    sequence->table = table;
    sequence->seed = seed;
    sequence->number = number;
    for (uint32_t k = 0; k < SAMPLER_DIMENSIONS; k++) {
        sequence->scrambling[k] = sobol_scrambling(seed, number, table->first + k);
    }
}

double sampler_next(struct sampler *sampler)
{
    const struct sampler_sequence *sequence = sampler->sequence;
    const uint32_t k = sampler->next++;
    if (k < SAMPLER_DIMENSIONS) {
        return sobol_point(&sequence->table->sobol[k], sequence->scrambling[k], sampler->index);
    }
    const struct random_words words = random_words(
        RANDOM_PATHS, sequence->seed, (uint64_t)sequence->number << 32 | sampler->index, k);
    return random_unit_of(words.w[0], words.w[1]);
}
