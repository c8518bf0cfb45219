/* camera/film/exit_pupil_bounds.h - where the light of a point of the film comes from, and a little more. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_FILM_EXIT_PUPIL_BOUNDS_H
#define LENSCALC_CAMERA_FILM_EXIT_PUPIL_BOUNDS_H

#include "base/arena.h"
#include "base/error.h"
#include "camera/film/pupil_outline.h"

#include <stdbool.h>
#include <stddef.h>

/* Points of the film in one direction, or in every one of several. */
enum { FILM_RADII = 65, FILM_GRID_RADII = 17, FILM_COLUMNS = 16, FILM_CORNERS = FILM_SECTORS + 1 };

/*
 * Regions of directions, one for each of some distances from a point of the film, its pole:
 * h = end (1 - (1 - t)^2), t in equal steps: closer to each other where light ends and pupils
 * shrink. Each is a ring of FILM_SECTORS pieces between two polygons, with outwards from the pole
 * as upwards; the first corner lies upwards, the next ones towards what is +x then, the last is the
 * first again. Between two distances corners are interpolated, and all light still passes within.
 *
 * A round lens is the same in all directions; of others there are columns, each in one direction
 * from the pole: (1 - f, f) from +x to +y, f in equal steps, and so on; they are interpolated too.
 * What stands there is less by slope times the place, which is what directions change about evenly
 * with.
 *
 * Directions are cosines L, M, whose areas are projected solid angles. Where light comes from
 * beyond 70 degrees pupils are slivers of these, bent along the circle on which all end: there
 * places in a plane stand for directions, L/N and M/N, of which areas times N^4 are the same.
 */
struct exit_pupil_bounds {
    double film;        /* behind the last vertex, mm */
    double index;       /* n of the image space */
    double largest;     /* distance from the axis up to which light arrives, mm; 0: none does */
    double pole[2];     /* mm; of a round lens on the axis */
    double tangent;     /* 1: x and y that follow are tangents; 0: cosines */
    bool is_grid;       /* has columns */
    bool turns;         /* outwards from the pole is upwards; else y is, everywhere */
    bool has_hole;      /* something dark in the middle: a mirror */
    int rows;           /* of one column */
    const double *ends; /* how far a column goes from the pole, mm: FILM_COLUMNS + 1 of them, the
                            last the first again; of a round lens one */
    double slope[2];    /* of x and y by the place from the pole, per mm */
    double *centre[2];  /* x, y of the middle, for each row of each column */
    double *inner[2];   /* x, y of FILM_CORNERS corners, the same; only with holes */
    double *outer[2];
    /* the same as what rays are started by, x and y side by side */
    const double *centre_xy, *inner_xy, *outer_xy;
    double per_mm; /* 1/end of a round lens */
    double ratio;  /* about what the hole is of the region, in radii */
};

/* How many rows all columns have. */
static inline size_t exit_pupil_bounds_nodes(const struct exit_pupil_bounds *region)
{
    return (size_t)region->rows * (region->is_grid ? FILM_COLUMNS + 1 : 1);
}

/* A direction at a place as it stands in the rows. */
static inline struct pupil_outline_point
exit_pupil_bounds_reduced(const struct exit_pupil_bounds *region, const struct film_place *place,
                          struct pupil_outline_point way)
{
    const double x = place->x - region->pole[0], y = place->y - region->pole[1];
    const double right = x * place->up[1] - y * place->up[0];
    const double up = x * place->up[0] + y * place->up[1];
    return (struct pupil_outline_point){way.x - region->slope[0] * right,
                                        way.y - region->slope[1] * up};
}

/* How far from the pole light arrives in a direction from it, with columns, mm. */
double exit_pupil_bounds_end(const struct exit_pupil_bounds *region, double x, double y);

/*
 * Find the regions of a lens.
 *
 * Result    regions that contain the clear pupils of all wavelengths; nothing else is promised of
 *           them: rays are traced to know which pass
 * Formula   the edge in 128 directions from a centre, each found from that of the distance before
 *           (camera/film/pupil_outline.h); polygons are stretched until they contain these edges,
 *           at
 *           their own place and half way to the next ones (camera/film/bounds_fit.h), and rays that
 *           are
 *           scattered there and pass. How far light arrives is found by steps from what is lit
 * Errors    ERROR_DOMAIN: the film lies in the last vertex; light comes from more than 89 degrees
 *           off its normal, or 86 where the lens is not round
 * Limits    only what is connected with the middle of the pupil, seen from places that are lit
 *           without a gap on the way from the pole. Beside what was looked at 1e-4 of the
 *           irradiance on the axis may be missed, in lensdb's lenses; 6e-3 where a pupil folds
 *           within the last tenth of an image circle
 */
bool exit_pupil_bounds_open(const struct film_lens *lens, struct arena *arena,
                            struct exit_pupil_bounds *region, struct error *error);

#endif
