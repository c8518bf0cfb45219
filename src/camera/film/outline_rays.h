/* camera/film/outline_rays.h - what a point of the film is looked from with: a disc of rays. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_FILM_OUTLINE_RAYS_H
#define LENSCALC_CAMERA_FILM_OUTLINE_RAYS_H

#include "camera/film/pupil_outline.h"
#include "trace/pupil/pupil_boundary.h"

/* Half widths that discs have where nothing asks for more. */
#define SIGHT_AROUND 2.0

/* One point of the film at one wavelength. */
struct outline_rays {
    const struct film_lens *lens;
    double tangent;
    struct film_place place;
    struct beam beam;
    struct stop_beam disc;
    struct clearances margins;
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
void outline_rays_open(const struct pupil_outline_search *search, size_t wavelength,
                       const struct pupil_outline *about, double widths,
                       struct outline_rays *sight);

/* A direction, as the search has them, in units of the disc: u, v. */
void outline_rays_to_disc(const struct outline_rays *sight, struct pupil_outline_point way,
                          double uv[2]);

/* The direction of a place of the disc. */
struct pupil_outline_point outline_rays_from_disc(const struct outline_rays *sight,
                                                  const double uv[2]);

#endif
