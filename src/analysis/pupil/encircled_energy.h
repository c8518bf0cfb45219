/* analysis/pupil/encircled_energy.h - within which distance so much of the light of a sample lies. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_PUPIL_ENCIRCLED_ENERGY_H
#define LENSCALC_ANALYSIS_PUPIL_ENCIRCLED_ENERGY_H

#include "analysis/pupil/bundle.h"
#include "base/arena.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* No mark on that side. */
static const size_t ENCIRCLED_ENERGY_ALONE = SIZE_MAX;

/* A ray of the sample. */
struct encircled_energy_mark {
    double at[2]; /* from where distances count */
    double weight;
    double place, share; /* on an arm, which goes from 0 to 1: by Gauss's rule there */
    size_t beside[2];    /* marks on its arm, inwards and outwards; ENCIRCLED_ENERGY_ALONE: none */
};

/* Marks first .. of a part of the pupil that lost no ray: the arms of ring after ring outwards. */
struct encircled_energy_sheet {
    const struct encircled_energy_sheet *next; /* null: the last */
    size_t first, arms, rings;
    struct quadrature_arcs arcs;
    const double *places, *shares; /* of the rings, by Gauss's rule */
};

/* A sample while its marks are made, ray after ray. */
struct encircled_energy_arms {
    size_t arms, rings;
    struct quadrature_arcs arcs;
    double *places, *shares;                     /* of a ring */
    size_t *last;                                /* mark of an arm */
    size_t arrived;                              /* rays of this sheet so far */
    const struct encircled_energy_sheet *sheets; /* those that are whole */
    struct arena *arena;
};

/* Given: sheets  those of other wavelengths; null: none */
struct encircled_energy_arms encircled_energy_arms_open(const struct bundle *bundle,
                                                        const struct encircled_energy_sheet *sheets,
                                                        struct arena *arena);

/*
 * Say where on its arm a mark lies, and beside which.
 *
 * Given     ray   its place in the bundle; all of them in their order, lost ones too
 *           mark  its place among the marks, which are in the same order; ENCIRCLED_ENERGY_ALONE:
 *           the ray
 *                 is lost
 */
void encircled_energy_arms_add(struct encircled_energy_arms *arms, size_t ray,
                               struct encircled_energy_mark *marks, size_t mark);

/* At least one mark. */
struct encircled_energy_sample {
    const struct encircled_energy_mark *marks;
    size_t count;
    bool has_arms; /* encircled_energy_arms_add */
    const struct encircled_energy_sheet *sheets;
};

/*
 * The distance within which a share of the weight lies.
 *
 * Given     share  0..1
 *           arena  for working
 * Formula   sheets: place and density are polynomials through the rays, those nearest by, of the
 *           radius in the pupil, and along the edge from corner to corner, looked at so finely
 *           that the distance between two looks counts as linear; so rings do not show as steps
 *           Other arms: linear from ray to ray and beyond the last ones, the light between two
 *           what their weights say it is there
 *           No arms: half of each mark's weight lies before it, linear between two
 */
double encircled_energy_find(const struct encircled_energy_sample *sample, double share,
                             struct arena *arena);

#endif
