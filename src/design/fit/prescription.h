/* design/fit/prescription.h - radii, gaps, indices that give a lens what was measured. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_FIT_PRESCRIPTION_H
#define LENSCALC_DESIGN_FIT_PRESCRIPTION_H

#include "base/arena.h"
#include "base/error.h"
#include "design/solver/solver.h"
#include "optics/lens.h"
#include "optics/parameter.h"

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

/* A number of the prescription that may change; of an index by the same at all wavelengths. */
struct prescription_part {
    struct parameter what; /* a radius with 2 A2, a thickness or an index */
    double low, high;      /* bounds, mm or 1; infinite = none */
};

/* Can this be fitted? */
bool prescription_fits(enum parameter_kind kind);

struct prescription_fit {
    double *values;  /* one a part: radius, gap, index at the first goal's wavelength */
    double *errors;  /* standard errors of these; NaN where they do not follow */
    double *before;  /* what the lens has */
    double *reached; /* one a goal, mm; infinite where the lens is afocal */
    struct solver_summary summary;
    bool is_loose; /* fewer goals than parts: of all answers that nearest to the lens */
};

/* What a lens is fitted to, and by what. */
struct prescription_task {
    const struct prescription_goal *goals;
    size_t goal_count;
    const struct prescription_part *parts;
    size_t part_count;
    struct solver_options options; /* its engine is not read */
};

/*
 * Fit.
 *
 * Given     lens   in one position
 *           parts  at least one; radii of surfaces that have one, gaps between surfaces, indices of
 *                  media that are numbers or nd/Vd
 * Result    fit, in the arena; the radius of a plane is infinite
 * Formula   smallest sum over goals of squares that are ((figure - value)/deviation)^2 near the
 *           goal, by curvatures, gaps and indices; [a b; c d] the system, power P = -c:
 *             efl     (1/value - P) value^2/deviation
 *             height  of a distant object in the rear focal plane, n tan(field)/P: the same with
 *                     P/(n tan(field))
 *             bfl     -n' a/c: (n' a + value c)/(P0 deviation), P0 the power of the lens that is
 *                     found, by rounds; ffl, n d/c, alike
 *             length  the sum of gaps, as it is
 *           All are linear in the matrix, and that in each curvature, gap over index and power, so
 *           that power may pass through 0; a focal length has a pole there, and a minimum at no
 *           focal length at all. Derivatives exactly: of the product of matrices, what is before
 *           and what is behind the changed one
 * Source    [Smith05]
 * Errors    ERROR_DOMAIN: no parts, no goals, a part that the lens does not have, bounds that leave
 *           nothing or that the lens lies outside of, a focal length or image height of 0, an
 *           image height on the axis
 * Limits    the nearest minimum
 */
bool prescription_fit(const struct lens *lens, const struct prescription_task *task,
                      struct arena *arena, struct prescription_fit *fit, struct error *error);

/* The lens with the fitted numbers, in the arena. */
struct lens prescription_apply(const struct lens *lens, const struct prescription_part *parts,
                               size_t part_count, const struct prescription_fit *fit,
                               struct arena *arena);

#endif
