/* analysis/pupil/quadrature_whole.h - quadrature over a stop or a disc that nothing clips. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_PUPIL_QUADRATURE_WHOLE_H
#define LENSCALC_ANALYSIS_PUPIL_QUADRATURE_WHOLE_H

#include "analysis/pupil/quadrature.h"
#include "trace/pupil/clearances.h"

/*
 * Gauss's points of the whole disc, without a search for edges.
 *
 * Result    false: that would not do, for rims may end the rays, areas of the beam of a stop are
 *           asked for, rays do not reach the stop by whole steps of Broyden's method, or those of
 *           the outermost ring are lost behind it
 * Formula   rays are aimed at points of the stop to 1e-10 of its radius, and named by where they
 *           cross it; of halves that mirror each other (stop_beam_is_mirrored) those of one
 */
bool quadrature_whole(const struct clearances *margins, size_t rays, struct arena *arena,
                      struct quadrature *all);

#endif
