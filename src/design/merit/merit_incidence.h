/* design/merit/merit_incidence.h - operands of angles of incidence. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_MERIT_MERIT_INCIDENCE_H
#define LENSCALC_DESIGN_MERIT_MERIT_INCIDENCE_H

#include "design/merit/merit_state.h"

/*
 * incidence: the largest angle at a surface, rad, a residual for each of the operand that bends
 * light: of the chief rays and those through the upper and the lower edge of the stop, of all
 * fields or that of the operand. Rays that are lost do not count.
 *
 * Formula   sin i = |p x p'|/(n |p' - p|), p and p' before and behind: their difference is along
 *           the normal
 * Source    derived here from the law of refraction
 * Errors    as merit_ray_check; a coordinate break at the surface, no such surface. Of an
 *           evaluation: no ray arrives
 */
merit_fill merit_fill_incidence;
merit_prepare merit_prepare_incidence;

#endif
