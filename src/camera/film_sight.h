/* camera/film_sight.h - what a point of the film is looked from with: a disc of rays. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_FILM_SIGHT_H
#define LENSCALC_CAMERA_FILM_SIGHT_H

#include "camera/film_outline.h"
#include "trace/star.h"

/* Half widths that discs have where nothing asks for more. */
#define SIGHT_AROUND 2.0

/* One point of the film at one wavelength. */
struct film_sight {
    const struct film_lens *lens;
    double tangent;
    struct film_place place;
    struct beam beam;
    struct stop_beam disc;
    struct margins margins;
    struct probe probe;
    struct edge_frame frame;
};

/*
 * Look with a disc of so many half widths of an outline about its centre.
 *
 * Given     about  its place, centre and size
 * Result    sight  stays where it is, as parts of it point to others; what they hold lives in the
 *                  arena of the search
 */
void film_sight_open(const struct outline_search *search, size_t wavelength,
                     const struct outline *about, double widths, struct film_sight *sight);

/* A direction, as the search has them, in units of the disc: u, v. */
void film_sight_to_disc(const struct film_sight *sight, struct outline_point way, double uv[2]);

/* The direction of a place of the disc. */
struct outline_point film_sight_from_disc(const struct film_sight *sight, const double uv[2]);

#endif
