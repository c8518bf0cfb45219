/* camera/film/bounds_builder.h - a film's region while it is built: its rows, and what is seen there. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_FILM_BOUNDS_BUILDER_H
#define LENSCALC_CAMERA_FILM_BOUNDS_BUILDER_H

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

#endif
