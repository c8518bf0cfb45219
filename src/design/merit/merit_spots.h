/* design/merit/merit_spots.h - spots of fields in every plane near the image, from one trace. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_MERIT_MERIT_SPOTS_H
#define LENSCALC_DESIGN_MERIT_MERIT_SPOTS_H

#include "design/merit/merit_rays.h"

/*
 * The spot of a field, of all wavelengths that the operand is of, where the image plane stands s
 * behind its place, mm.
 */
struct merit_spot {
    double centroid[2];  /* at s = 0, mm */
    double drift[2];     /* of the centroid with s */
    double at, by, bend; /* RMS^2 = at + 2 by s + bend s^2, mm^2, 1 mm, 1 */
};

/* Where rays are, for one look. */
struct merit_lines;
struct merit_lines *merit_lines_open(const struct merit_slot *slot, struct arena *arena);

/*
 * The spots of a slot of OPERAND_POLY, in the lens that merit_put_lens has put there.
 *
 * Given     spots  receives one a field of the slot, whatever its weight
 * Formula   a wavelength counts by its weight and by how much of the pupil is clear at it, as in
 *           analysis/rays/spot.h. Behind the lens rays are straight: x = x0 + s p/r. So moments
 *           about
 *           the moving centroid are a parabola in s, exactly
 * Result    false: merit->why, as merit_fill_rays
 */
bool merit_spots_find(struct merit *merit, const struct merit_slot *slot, struct merit_lines *lines,
                      struct merit_spot *spots);

#endif
