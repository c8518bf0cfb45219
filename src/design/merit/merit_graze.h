/* design/merit/merit_graze.h - rays near loss, as an operand. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_MERIT_MERIT_GRAZE_H
#define LENSCALC_DESIGN_MERIT_MERIT_GRAZE_H

#include "design/merit/merit_bundle.h"
#include "design/merit/merit_state.h"

/* What the rays of a position count that are near loss, as its evaluation goes on. */
struct merit_graze {
    double limit;          /* margin below which they count: trace/aim/grazing.h */
    double margin;         /* the least of all rays; NaN: there are none */
    double value, *slopes; /* by the variables */
    unsigned long evaluation;
};

/* Add the rays of a block that was traced last. */
void merit_graze_add(struct merit *merit, const struct merit_slot *slot,
                     struct merit_bundle *bundle, size_t block, const struct bundle_links *links);

/*
 * grazing: the largest angle with the normal of a surface, in the rarer medium, of all rays of the
 * operands of rays in the position. These are filled before.
 *
 * Formula   not what the angle is off, but the sum over rays, weighted as in spots, of
 *           trace/aim/grazing.h, over the deviation: smooth, and 0 below the target

 * Errors    another relation than '<', a target not between 0 and 90 deg; no operand of rays
 */
merit_fill merit_fill_graze;
merit_prepare merit_prepare_graze;

#endif
