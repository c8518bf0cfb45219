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
    double place, share; /* on an arm, which goes from 0 to 1: by Gauss's rule there */
    size_t beside[2];    /* marks on its arm, inwards and outwards; QUANTILE_ALONE: none */
};

/* The arms of a sample while its marks are made, ray after ray. */
struct quantile_arms {
    size_t arms, rings;
    double *places, *shares; /* of a ring */
    size_t *last;            /* mark of an arm */
};

/* Given: arms and rings as analysis/bundle.h has them; arms 0: it has none. */
struct quantile_arms quantile_arms_open(size_t arms, size_t rings, struct arena *arena);

/*
 * Say where on its arm a mark lies, and beside which.
 *
 * Given     ray   its place in the bundle; all of them in their order, lost ones too
 *           mark  its place among the marks; QUANTILE_ALONE: the ray is lost
 */
void quantile_arms_add(const struct quantile_arms *arms, size_t ray, struct quantile_mark *marks,
                       size_t mark);

/*
 * The distance within which a share of the weight lies.
 *
 * Given     marks     at least one; without arms they are put in order of their distance
 *           has_arms  rays lie on arms: quantile_arms_add
 *           share     0..1
 *           arena     for working
 * Formula   with arms: along each the distance goes as the radius in the pupil from ray to ray, and
 *           beyond the last ones; the light between two is what their weights say it is there. So
 *           rings do not show as steps, and a disc out of focus is met exactly.
 *           Without: half of each mark's weight lies before it, linear between two
 */
double quantile_of_marks(struct quantile_mark *marks, size_t count, bool has_arms, double share,
                         struct arena *arena);

#endif
