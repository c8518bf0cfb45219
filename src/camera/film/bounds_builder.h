/* camera/film/bounds_builder.h - a film's region while it is built: its rows, and what is seen there. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_FILM_BOUNDS_BUILDER_H
#define LENSCALC_CAMERA_FILM_BOUNDS_BUILDER_H

#include "base/error.h"
#include "camera/film/exit_pupil_bounds.h"

/* One lens, its region as far as it is known, and the edges at its rows. */
struct bounds_builder {
    struct pupil_outline_search search;
    struct exit_pupil_bounds *region;
    double *ends;
    struct pupil_outline
        *nodes; /* of the wavelength that is followed, at every row of every column */
    bool is_round;
    size_t columns;            /* that are looked at: the others repeat them */
    struct pupil_outline pole; /* its centre and size alone */
    double steepest;           /* of the directions seen where light ends: their sine */
};

/* Rows of the columns that are looked at, and of the first again. */
size_t film_building_nodes(const struct bounds_builder *building);

/* How far from the pole a row is, or what lies between two, mm. */
double film_building_height(const struct bounds_builder *building, double column, double row);

/* An outline of a place that is so far from the pole; nothing of it is known. */
struct pupil_outline film_building_outline(const struct bounds_builder *building, double column,
                                           double height);

/* The last lit node of a column up to one; null: none is. */
const struct pupil_outline *film_building_lit(const struct bounds_builder *building, size_t node);

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
