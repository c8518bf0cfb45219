/* design/prescription.h - radii, gaps, indices that give a lens what was measured. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_PRESCRIPTION_H
#define LENSCALC_DESIGN_PRESCRIPTION_H

#include "base/arena.h"
#include "base/error.h"
#include "design/solver.h"
#include "optics/lens.h"

#include <stdbool.h>
#include <stddef.h>

enum goal_kind { GOAL_EFL, GOAL_BFL, GOAL_FFL, GOAL_HEIGHT, GOAL_LENGTH, GOAL_KINDS };

/* Something that was measured. */
struct prescription_goal {
    enum goal_kind kind;
    double value, deviation; /* mm; the deviation is above 0 */
    double wavelength;       /* um */
    double field;            /* of GOAL_HEIGHT: angle in object space, rad */
};

enum part_kind { PART_RADIUS, PART_GAP, PART_INDEX };

/* A number of the prescription that may change; of an index by the same at all wavelengths. */
struct prescription_part {
    enum part_kind kind;
    size_t surface;   /* from 0 */
    double low, high; /* bounds, mm or 1; infinite = none */
};

struct prescription_fit {
    double *values;  /* one a part: radius, gap, index at the first goal's wavelength */
    double *errors;  /* standard errors of these; NaN where they do not follow */
    double *before;  /* what the lens has */
    double *reached; /* one a goal */
    struct solver_summary summary;
    bool is_loose; /* fewer goals than parts: of all answers that nearest to the lens */
};

/*
 * Fit.
 *
 * Given     lens   in one position
 *           parts  at least one; radii of surfaces that have one, gaps between surfaces, indices of
 *                  media that are numbers or nd/Vd
 * Result    fit, in the arena; the radius of a plane is infinite
 * Formula   smallest sum over goals of ((figure - value)/deviation)^2 by curvatures, gaps and
 *           indices; [a b; c d] the system: efl = -1/c, bfl = -n' a/c, ffl = n d/c, height of a
 *           distant object in the rear focal plane n efl tan(field), length the sum of gaps.
 *           Derivatives exactly: of the product of matrices, what is before and what is behind
 *           the changed one
 * Source    [Smith05]
 * Errors    ERROR_DOMAIN: no parts, no goals, a part that the lens does not have, bounds that leave
 *           nothing or that the lens lies outside of, an afocal start
 * Limits    the nearest minimum
 */
bool prescription_fit(const struct lens *lens, const struct prescription_goal *goals,
                      size_t goal_count, const struct prescription_part *parts, size_t part_count,
                      struct arena *arena, struct prescription_fit *fit, struct error *error);

/* The lens with the fitted numbers, in the arena. */
struct lens prescription_apply(const struct lens *lens, const struct prescription_part *parts,
                               size_t part_count, const struct prescription_fit *fit,
                               struct arena *arena);

#endif
