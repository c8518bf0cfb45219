/* analysis/rays/fresnel.h - what uncoated faces let pass. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_RAYS_FRESNEL_H
#define LENSCALC_ANALYSIS_RAYS_FRESNEL_H

#include "base/arena.h"
#include "trace/system.h"

/*
 * The share of unpolarised light that all refracting faces let pass along a ray.
 *
 * Given     system  nothing clipped; forward or reversed: the share is the same
 *           start   as given to rays_set
 * Formula   mean of the products of 1 - Rs and of 1 - Rp over the faces,
 *           Rs = ((n cos I - n' cos I')/(n cos I + n' cos I'))^2,
 *           Rp = ((n' cos I - n cos I')/(n' cos I + n cos I'))^2
 * Source    Fresnel's formulas, [BornWolf99] 1.5.2
 * Result    NaN: the ray is lost
 * Limits    both polarisations stay what they are: exact for rays that run in one plane, as those
 *           of a point on the axis of a round lens. Mirrors and ideal thick lenses lose nothing;
 *           what is reflected twice and arrives is not counted; glass absorbs nothing
 */
double fresnel_pass(const struct system *system, const struct ray *start, struct arena *arena);

#endif
