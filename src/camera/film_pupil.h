/* camera/film_pupil.h - where rays from the film may leave a lens: its pupil, by film radius. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_FILM_PUPIL_H
#define LENSCALC_CAMERA_FILM_PUPIL_H

#include "base/arena.h"
#include "base/error.h"
#include "optics/first_order.h"
#include "trace/system.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

enum { FILM_PUPIL_RADII = 65, FILM_PUPIL_CORNERS = 64 };

/*
 * The pupil of a point of the film at (0, r): a polygon of direction cosines (x, y), whose corners
 * stand for sectors of about equal area. It holds the pupil, and little beside it. A point where no
 * light arrives has all corners in the centre.
 */
struct film_outline {
    double centre[2];
    double corners[FILM_PUPIL_CORNERS + 1][2]; /* the last is the first */
};

/* Radii in equal steps from the axis to `reach`; in between everything goes in a straight line. */
struct film_pupil {
    double image, reach; /* film behind the last vertex, farthest point of it, mm */
    struct film_outline at[FILM_PUPIL_RADII];
};

struct film_pupil_question {
    /* compiled with clip and `reverse`, one a wavelength: the pupil is the union of theirs */
    const struct system *const *systems;
    size_t system_count;
    const struct first_order *first;
    double image, reach; /* mm */
};

/*
 * Make the table.
 *
 * Result    the part of the pupil that nothing within it blocks: rays through the hole of a mirror
 *           lens are in the table, and lost when they are traced
 * Formula   edges in 128 directions (trace/edges.h) about the centroid, and near the radii, of the
 *           outline before; angles that would have cut that one in equal areas. Corners are then
 *           moved away from the centre until the middles of all sectors, and the outlines of the
 *           points halfway between two radii, lie within the polygon
 * Limits    what lies beyond a gap, seen from the centroid, is not in it. Of lenses whose pupils
 *           are whole 99 % of the rays arrive, and less than 1e-4 of the light is left out
 * Errors    ERROR_DOMAIN: the lens is not the same in all directions; its stop has no diameter;
 *           nothing arrives on the axis of the film
 */
bool film_pupil_open(const struct film_pupil_question *question, struct arena *arena,
                     struct film_pupil *pupil, struct error *error);

/* A direction towards the lens, and what it stands for. */
struct film_direction {
    double x, y;   /* cosines, at the film point (0, r) */
    double weight; /* projected solid angle, sr: the mean of weight x radiance is E */
};

/*
 * A direction within the pupil.
 *
 * Given     radius  of the point of the film, 0 to reach
 *           u, v    in 0..1, evenly spread
 * Formula   sector by u, the rest of which goes along its outer side; from the centre by the root
 *           of v. Irradiance is the integral of radiance over direction cosines, so that the weight
 *           is the number of sectors times the triangle's area, exactly
 */
static inline struct film_direction film_pupil_direction(const struct film_pupil *pupil,
                                                         double radius, double u, double v)
{
    const double step = radius / pupil->reach * (FILM_PUPIL_RADII - 1);
    const double sector = u * FILM_PUPIL_CORNERS;
    const size_t i = step < FILM_PUPIL_RADII - 2 ? (size_t)step : FILM_PUPIL_RADII - 2;
    const size_t k = sector < FILM_PUPIL_CORNERS - 1 ? (size_t)sector : FILM_PUPIL_CORNERS - 1;
    const struct film_outline *low = &pupil->at[i], *high = low + 1;
    const double f = step - (double)i, t = sector - (double)k, out = sqrt(v);
    double centre[2], from[2], to[2];
    for (int axis = 0; axis < 2; axis++) {
        centre[axis] = low->centre[axis] + f * (high->centre[axis] - low->centre[axis]);
        from[axis] = low->corners[k][axis] + f * (high->corners[k][axis] - low->corners[k][axis]) -
                     centre[axis];
        to[axis] = low->corners[k + 1][axis] +
                   f * (high->corners[k + 1][axis] - low->corners[k + 1][axis]) - centre[axis];
    }
    const double area = (from[0] * to[1] - from[1] * to[0]) / 2;
    return (struct film_direction){centre[0] + out * (from[0] + t * (to[0] - from[0])),
                                   centre[1] + out * (from[1] + t * (to[1] - from[1])),
                                   FILM_PUPIL_CORNERS * (area < 0 ? -area : area)};
}

#endif
