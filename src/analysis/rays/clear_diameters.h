/* analysis/rays/clear_diameters.h - diameters of surfaces from the beams that cross them. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_RAYS_CLEAR_DIAMETERS_H
#define LENSCALC_ANALYSIS_RAYS_CLEAR_DIAMETERS_H

#include "analysis/setup/setup_question.h"
#include "base/arena.h"
#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>

/* Which beams, and how much more than they. */
struct clear_diameters_question {
    const struct lens *lens; /* with all its positions, in which it is asked */
    double fnumber;          /* NaN: the lens's own aperture */
    /* counts of 0: all of the lens; of one without fields the axis */
    const struct setup_field *fields;
    size_t field_count;
    const struct setup_wavelength *wavelengths;
    size_t wavelength_count;
    double margin; /* of the diameter, as a share: 0.02 for 2 % */
};

/*
 * The lens with diameters that let all beams pass, whatever they were before.
 *
 * Result    in the arena, without diameters that `question->lens` has and the beams do not need;
 *           the stop keeps its own where it states one, and gets none where it is a plane of its
 *           own; so do diameters that change with the position.
 *           notes  receives what is to be said, in words; null: nothing
 * Formula   of each surface the ray farthest from its vertex, of 64 directions at four heights of
 *           the stop (a disc of the entrance beam without one), for every field, wavelength and
 *           position; plus the margin, rounded up to 4 digits; less margin, down to none, where the
 *           surface has no sag so far out. Nothing is clipped on the way
 * Errors    ERROR_DOMAIN: a ray is lost, with the field and the surface; no aperture; as setup_open
 *           and bundle_open
 */
bool clear_diameters_find(const struct clear_diameters_question *question, struct arena *arena,
                          const struct lens **found, const char **notes, struct error *error);

#endif
