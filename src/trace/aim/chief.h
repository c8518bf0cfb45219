/* trace/aim/chief.h - the search for the chief ray of a beam; see trace/aim/aim.h. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_AIM_CHIEF_H
#define LENSCALC_TRACE_AIM_CHIEF_H

#include "base/arena.h"
#include "base/error.h"
#include "trace/aim/aim.h"

#include <stdbool.h>

/*
 * Fill chief and slope of an aim that has its system, beam, stop radius and block.
 *
 * Errors    as aim_open
 */
bool chief_find(struct aim *aim, struct arena *arena, struct error *error);

/*
 * The same by Newton's method from a chief ray near by; in a round lens along the meridional plane
 * alone.
 *
 * Result    false: it does not lead straight to a ray on the same sheet, and no more is filled
 */
bool chief_find_near(struct aim *aim, const struct aim_near *near);

/*
 * Newton's method to the centre of the stop, steps halved while they lead away.
 *
 * Given     aim  with its system, beam, stop radius and block, and about slope[3]
 *           at   a ray of the beam; receives the chief ray
 */
bool chief_newton(const struct aim *aim, double at[2]);

/*
 * d(x, y in the stop)/d(a, b) at a ray of the beam, by central differences.
 *
 * Result    false: the rays about it are lost
 */
bool chief_slope(const struct aim *aim, const double at[2], double slope[4]);

/* The same of up to RAYS_BLOCK rays at once; found: of each what chief_slope says. */
void chief_slopes(const struct aim *aim, const double (*at)[2], size_t count, double (*slopes)[4],
                  bool *found);

/* Take the first `count` rays in aim->work to the stop, in its own frame: origin in its centre. */
void chief_to_stop(const struct aim *aim, size_t count);

/* Take `count` rays of the beam (1 to RAYS_BLOCK) to the stop; their fate is in aim->work. */
void chief_trace(const struct aim *aim, const double (*at)[2], size_t count);

/* How near rays come at least to where they are meant to cross the stop, mm: 1e-12 of its radius,
   or of a tiny one as far as rounding of where they start beside the axis moves them there. */
double chief_rounding(const struct aim *aim);

#endif
