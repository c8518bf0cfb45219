/* camera/film/bounds_follow.h - edges of pupils followed over the film. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_FILM_BOUNDS_FOLLOW_H
#define LENSCALC_CAMERA_FILM_BOUNDS_FOLLOW_H

#include "camera/film/bounds_builder.h"

/* Holes change little from one row to the next: they are asked for so many rows apart. */
enum { FOLLOW_HOLE_ROWS = 4 };

/*
 * The outlines of a column, each from those before it, of the wavelength that is followed.
 *
 * Given     building  with ends; the columns before this one
 */
void bounds_follow_column(const struct bounds_builder *building, size_t column);

/* Make the rows contain what is seen between all of them and columns that are neighbours. */
void bounds_follow_between(const struct bounds_builder *building);

/*
 * The same with what all other wavelengths see at the rows; those that are not asked are stretched
 * as their neighbours are.
 *
 * Result    has_hole of the region: at every wavelength
 */
void bounds_follow_waves(const struct bounds_builder *building);

#endif
