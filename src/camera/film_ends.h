/* camera/film_ends.h - how far from the pole of a film light arrives. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_FILM_ENDS_H
#define LENSCALC_CAMERA_FILM_ENDS_H

#include "base/error.h"
#include "camera/film_region.h"

/* One lens, its region as far as it is known, and the edges at its rows. */
struct film_building {
    struct outline_search search;
    struct film_region *region;
    double *ends;
    struct outline *nodes; /* of the wavelength that is followed, at every row of every column */
    bool is_round;
    size_t columns;      /* that are looked at: the others repeat them */
    struct outline pole; /* its centre and size alone */
    double steepest;     /* of the directions seen where light ends: their sine */
};

/* An outline of a place that is so far from the pole; nothing of it is known. */
struct outline film_outline_at(const struct film_building *building, double column, double height);

/*
 * Find the ends of columns, and `largest`.
 *
 * Given     building  its region with a pole that is lit, in cosines; `ends` to be filled
 * Result    every column ends where, or beyond where, light does, and so does what lies between
 *           them; directions of the region are tangents from there on if any is steep
 * Errors    ERROR_DOMAIN: light comes from more than 89 degrees off the normal, 86 where the lens
 *           is not round
 */
bool film_ends_find(struct film_building *building, struct error *error);

#endif
