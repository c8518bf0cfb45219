/* camera/photograph/irradiance_table.h - a table of the light on a film, by the distance from the axis. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_PHOTOGRAPH_IRRADIANCE_TABLE_H
#define LENSCALC_CAMERA_PHOTOGRAPH_IRRADIANCE_TABLE_H

#include "base/arena.h"
#include "camera/film/lens_film.h"

struct irradiance_table;

/*
 * Given     film    of a lens that is the same all around, and so is its shutter
 *           passes  one a wavelength of it, or one for all
 *           blocks  of rays for each number of the table
 * Result    E/L up to where light ends, closer to each other there
 */
const struct irradiance_table *irradiance_table_new(const struct lens_film *film, size_t passes,
                                                    size_t blocks, struct arena *arena);

/*
 * E/L of a pixel of a tile, sr: the mean over it.
 *
 * Given     plan   of the tile
 *           pixel  of TILE_PIXELS, in rows from the upper left of the picture
 * Formula   between numbers of the table linearly, at Gauss's four points of the pixel
 */
double irradiance_table_of(const struct irradiance_table *light, size_t wavelength,
                           const struct film_plan *plan, size_t pixel);

#endif
