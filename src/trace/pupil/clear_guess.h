/* trace/pupil/clear_guess.h - where what is clear of a beam is looked for, and a ray at its edge. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_PUPIL_CLEAR_GUESS_H
#define LENSCALC_TRACE_PUPIL_CLEAR_GUESS_H

#include "optics/first_order.h"
#include "trace/aim/beam.h"
#include "trace/kernel/rays.h"
#include "trace/system.h"

#include <stddef.h>

/* A ray at the edge: the last that passes. */
struct clear_edge {
    double at[2];           /* coordinates in the beam, mm */
    enum ray_status status; /* of its neighbour outside, and where that one is lost; 1-based */
    size_t surface;
    size_t part; /* where apertures are listed: a number of the pieces of edges that it meets */
};

/* Where to look: a point inside, roughly, and a size. */
struct clear_guess {
    double centre[2], radius; /* mm, in the beam */
};

/* By the paraxial entrance pupil, or for a reversed system by the exit pupil. */
struct clear_guess clear_guess_of(const struct system *system, const struct beam *beam,
                                  const struct first_order *first);

#endif
