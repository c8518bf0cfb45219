/* camera/film/bounds_extent.h - how far from the pole of a film light arrives. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_FILM_BOUNDS_EXTENT_H
#define LENSCALC_CAMERA_FILM_BOUNDS_EXTENT_H

#include "base/error.h"
#include "camera/film/bounds_builder.h"

/*
 * Find the ends of columns, and `largest`.
 *
 * Given     building  its region with a pole that is lit, in cosines; `ends` to be filled
 * Result    every column ends where, or beyond where, light does, and so does what lies between
 *           them; directions of the region are tangents from there on if any is steep
 * Errors    ERROR_DOMAIN: light comes from more than 89 degrees off the normal, 86 where the lens
 *           is not round
 */
bool bounds_extent_find(struct bounds_builder *building, struct error *error);

#endif
