/* trace/aim/grazing.h - rays that surfaces are about to lose. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_AIM_GRAZING_H
#define LENSCALC_TRACE_AIM_GRAZING_H

#include "trace/aim/aimed.h"

#include <stdbool.h>

/*
 * The margin of a ray at a surface is the square of the cosine of its angle with the normal, in the
 * rarer medium of the two: 0 where it misses the surface, or where it is totally reflected. It is
 * smooth in all that moves the ray, where the angle itself goes through 90 deg like a root.
 */
struct grazing_penalty {
    double margin;            /* of all rays the least; 1: none is bent */
    bool any;                 /* some are below the limit */
    double value[RAYS_BLOCK]; /* what each ray counts */
    /* its derivatives by directions, of the surfaces where some count */
    struct derivative_seeds seeds;
};

/*
 * What the rays of a block count that are near loss.
 *
 * Given     aimed  traced last of those with its work, with derivatives or `keeps`
 *           limit  the margin m0 above which a ray counts for nothing; 0: none counts
 *           derives  seeds are wanted
 *           arena  for the seeds
 * Formula   the sum over surfaces with margin m below m0 of (m0 - m)^2/(m0 (m + m0/100)): 0 with
 *           slope 0 at m0, 0.5 half way, 100 where the ray is lost. With p, p' = n times the
 *           direction before and behind, g = p' - p is along the normal, and of the rarer side
 *           m = (p.g)^2/(g.g p.p)
 * Source    derived here from the law of refraction
 * Limits    thick lenses and surfaces between equal media lose no rays in this way, and do not
 *           count
 */
void grazing_find(const struct aimed *aimed, double limit, bool derives, struct arena *arena,
                  struct grazing_penalty *grazing);

#endif
