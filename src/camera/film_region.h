/* camera/film_region.h - where the light of a point of the film comes from, and a little more. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_FILM_REGION_H
#define LENSCALC_CAMERA_FILM_REGION_H

#include "base/arena.h"
#include "base/error.h"
#include "optics/first_order.h"
#include "trace/system.h"

#include <stdbool.h>
#include <stddef.h>

enum { FILM_RADII = 65, FILM_SECTORS = 128, FILM_CORNERS = FILM_SECTORS + 1 };

/* A round lens at all wavelengths that count, and its film. */
struct film_lens {
    const struct system *const *systems; /* reversed, with clip; the first is the one followed */
    size_t count;
    const struct first_order *first; /* for where the search begins */
    double film;                     /* behind the last vertex, mm */
    double reach;                    /* the point of the film farthest from the axis, mm */
};

/*
 * Regions of direction cosines, one for each of FILM_RADII distances of the film from the axis,
 * h = largest (1 - (1 - t)^2), t in equal steps: closer to each other where light ends and pupils
 * shrink. Each is a ring of FILM_SECTORS pieces between two polygons, for the point (0, h) of the
 * film; the first corner lies upwards, the next ones towards +x, the last is the first again.
 * Between two distances corners are interpolated, and all light still passes within.
 */
struct film_region {
    double film;      /* behind the last vertex, mm */
    double index;     /* n of the image space */
    double largest;   /* distance from the axis up to which light arrives, mm; 0: none does */
    double per_mm;    /* 1/largest */
    bool has_hole;    /* something dark in the middle: a mirror */
    double *centre;   /* its y, mm, FILM_RADII of them */
    double *inner[2]; /* x, y of the corners, FILM_RADII rows of FILM_CORNERS; only with holes */
    double *outer[2];
    double ratio; /* about what the hole is of the region, in radii */
};

/*
 * Find the regions of a lens.
 *
 * Given     lens   round: the same in all directions about its axis
 * Result    regions that contain the clear pupils of all wavelengths; nothing else is promised of
 *           them: rays are traced to know which pass
 * Formula   the edge in 256 directions from a centre, each found from that of the distance before
 *           (trace/edges.h), at twice as many distances as are kept; polygons are stretched until
 *           they contain these edges, at their own distance and half way to the next, and then
 *           by 0.3 %; a hole is the smaller by 1.5 %
 * Errors    ERROR_DOMAIN: the lens is not round; the film lies in the last vertex
 * Limits    as trace/star.h: only what is connected with the middle of the pupil. Beside what was
 *           looked at 1e-4 of the irradiance on the axis may be missed, in lensdb's lenses
 */
bool film_region_open(const struct film_lens *lens, struct arena *arena, struct film_region *region,
                      struct error *error);

#endif
