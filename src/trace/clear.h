/* trace/clear.h - what the rims let through of a beam: pupils with their vignetting. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_CLEAR_H
#define LENSCALC_TRACE_CLEAR_H

#include "base/arena.h"
#include "optics/first_order.h"
#include "trace/beam.h"
#include "trace/system.h"

#include <stdbool.h>
#include <stddef.h>

/* A ray at the edge: the last that passes. */
struct clear_edge {
    double at[2];           /* coordinates in the beam, mm */
    enum ray_status status; /* of its neighbour outside, and where that one is lost; 1-based */
    size_t surface;
};

/* The part of a beam that arrives, as a star about `centre`. */
struct clear_pupil {
    bool is_empty; /* nothing arrives: the rest is not set */
    double centre[2];
    double low[2], high[2];         /* bounds along the two axes of the beam, mm */
    struct clear_edge ends[4];      /* where they are: the largest a, b, the least a, b */
    double area;                    /* in the plane of the beam, mm^2 */
    const struct clear_edge *edges; /* counterclockwise, the first at -90 degrees: below */
    size_t edge_count;
};

/* Where to look: a point inside, roughly, and a size. */
struct clear_guess {
    double centre[2], radius; /* mm, in the beam */
};

/* By the paraxial entrance pupil, or for a reversed system by the exit pupil. */
struct clear_guess clear_guess_of(const struct system *system, const struct beam *beam,
                                  const struct first_order *first);

/*
 * The shape of a beam that passes all clear apertures and the stop.
 *
 * Given     system      compiled with clip on, forward or reversed; rays are lost by rims, by
 *                       total reflection or by missing a surface
 *           directions  how many edges: a multiple of 4, 4 to 4096
 *           guess       from clear_guess_of
 * Formula   a point inside is searched for on finer and finer grids about the guess; from it every
 *           edge is bracketed and bisected to rounding; the centre then moves to the centroid and
 *           all is done once more. Bounds: the extreme edge and its neighbours are searched again
 *           with 128 times the directions
 *           Area: the sum of r^2/2 over equal angles about the centre, which converges as fast as
 *           Fourier series do: 1e-15 for discs and ellipses
 * Limits    a shape that is not a star about its centroid is cut at its nearest edges; corners (of
 *           cat's eyes) leave about 5/k^2 of the area with k directions
 */
void clear_find(const struct system *system, const struct beam *beam,
                const struct clear_guess *guess, size_t directions, struct arena *arena,
                struct clear_pupil *pupil);

/*
 * Where a ray of the beam crosses a plane z = const of the frame it starts in.
 *
 * Result    false: it runs along the plane
 */
bool clear_on_plane(const struct beam *beam, const double at[2], double z, double point[2]);

#endif
