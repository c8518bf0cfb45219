/* camera/photograph/lateral_colour.h - where a lens sends the other colours of a point, within a tile of its film. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_PHOTOGRAPH_LATERAL_COLOUR_H
#define LENSCALC_CAMERA_PHOTOGRAPH_LATERAL_COLOUR_H

#include "base/arena.h"
#include "camera/film/lens_film.h"

#include <stdbool.h>

enum { LATERAL_COLOUR_AXES = 2, LATERAL_COLOUR_CORNERS = 4 };

/* Of one tile. */
struct lateral_colour {
    /* What a ray of a wavelength shows at a point, one of the middle shows so far away, mm: mean
       over the pupil, at the left and right of the bottom of the tile, then of the top */
    double (*moved)[LATERAL_COLOUR_CORNERS][LATERAL_COLOUR_AXES];
    double low[LATERAL_COLOUR_AXES],
        high[LATERAL_COLOUR_AXES]; /* the least and the most of these, and 0 */
};

/* For tiles of so many wavelengths, one after the other. */
struct lateral_colour_scratch;
struct lateral_colour_scratch *lateral_colour_scratch_new(size_t wavelengths, struct arena *arena);

/* Pixels, of spread over the pupil and of the mean of what is moved. */
#define FRINGES_MOST 0.25

/*
 * May rays of one wavelength stand for those of all, whatever they meet?
 *
 * Given     wavelengths, middle  of the film; the one that stands for all
 *           pixel  its size, mm
 *           plan   of a tile
 * Result    what is moved by how much, in the scratch; null: they may not, or that is hard to see,
 *           as in the dark. A ray of another colour then shows at a point what one of the middle
 *           shows at the moved point, but for less than FRINGES_MOST that it is spread about that:
 *           of a step between two lights a pixel loses or gains an eighth of it at most
 * Formula   a ray of another colour, from the same point of the film in the same way, leaves the
 *           lens dx, dp beside that of the middle: as the middle's from a point
 *           d = (dp'/dp)^T dx - (dx'/dp)^T dp away, p, p' the optical direction cosines before and
 *           after. This at the corners of the tile, by 32 points of each pupil
 * Source    derived here: the map of (x, y, p, q) is symplectic, so that its inverse has the same
 *           four blocks, transposed and with signs; blurred evenly by b, a step on the edge of a
 *           pixel adds the integral of x/b from 0 to b/2 to it
 * Limits    lights smaller than a pixel, near the edge of one, change more, as when they move
 */
const struct lateral_colour *lateral_colour_find(const struct lens_film *film, size_t wavelengths,
                                                 size_t middle, const double pixel[2],
                                                 const struct film_plan *plan,
                                                 struct lateral_colour_scratch *scratch);

/* How far it is moved along an axis at a place in the tile, each from 0 to 1. */
static inline double lateral_colour_moved(const struct lateral_colour *fringes, size_t wavelength,
                                          int axis, double across, double up)
{
    const double(*corner)[LATERAL_COLOUR_AXES] =
        (const double(*)[LATERAL_COLOUR_AXES])fringes->moved[wavelength];
    const double below = corner[0][axis] + across * (corner[1][axis] - corner[0][axis]);
    const double above = corner[2][axis] + across * (corner[3][axis] - corner[2][axis]);
    return below + up * (above - below);
}

#endif
