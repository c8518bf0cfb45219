/* analysis/quantile.h - within which distance so much of the light of a sample lies. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_QUANTILE_H
#define LENSCALC_ANALYSIS_QUANTILE_H

#include "base/arena.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* No mark on that side. */
static const size_t QUANTILE_ALONE = SIZE_MAX;

/* A ray of the sample. */
struct quantile_mark {
    double distance, weight;
    size_t beside[2]; /* marks on its arm, inwards and outwards; QUANTILE_ALONE: none */
};

/*
 * The distance within which a share of the weight lies.
 *
 * Given     marks     at least one; without arms they are put in order of their distance
 *           has_arms  rays lie on arms: along each the distance is smooth, and light between two
 *                     rays lies between their distances, so that rings do not show as steps
 *           share     0..1
 *           arena     for working
 * Formula   without arms: half of each mark's weight lies before it, linear between two
 */
double quantile_of_marks(struct quantile_mark *marks, size_t count, bool has_arms, double share,
                         struct arena *arena);

#endif
