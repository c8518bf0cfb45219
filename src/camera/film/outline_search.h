/* camera/film/outline_search.h - where light comes to a point of the film from. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_FILM_OUTLINE_SEARCH_H
#define LENSCALC_CAMERA_FILM_OUTLINE_SEARCH_H

#include "camera/film/pupil_outline.h"

/* The most rays that one call of outline_scatter finds. */
enum { OUTLINE_SCATTER = 5 * RAYS_BLOCK };

/*
 * Does any light come? Looked for about the centre that the outline has, with a grid of rays over
 * its half widths, and finer ones about the ray that fails by least.
 *
 * Result    true: the centre is a ray that passes well, half widths are about what is clear
 */
bool outline_is_lit(const struct pupil_outline_search *search, size_t wavelength,
                    struct pupil_outline *outline);

/* The same without any idea where. */
bool outline_discover(const struct pupil_outline_search *search, size_t wavelength,
                      struct pupil_outline *outline);

/*
 * Rays that pass, among some spread over 1.6 of the half widths about the centre, farther where
 * they lie beyond these: light that a star from there does not see, as horns of a crescent.
 *
 * Given     turn  other rays for each
 *           lit   receives directions, as edges have them: OUTLINE_SCATTER at most
 * Result    how many
 */
size_t outline_scatter(const struct pupil_outline_search *search, size_t wavelength,
                       const struct pupil_outline *outline, size_t turn,
                       struct pupil_outline_point *lit);

#endif
