/* optics/lens_indices.h - the indices of a lens at one wavelength. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_OPTICS_LENS_INDICES_H
#define LENSCALC_OPTICS_LENS_INDICES_H

#include "base/error.h"
#include "optics/lens.h"

#include <stdbool.h>

/*
 * Indices of refraction of all media.
 *
 * Given     wavelength  um
 *           asked       surface_count + 1 media that `n` has the indices of already, at this
 *                       wavelength: only what differs is asked for. Receives those of the lens. At
 *                       first zeroed, which is no medium; null: all are asked for
 *           n           receives them: before the first surface and after each, all positive; a
 *                       mirror's is that before it
 * Errors    as medium_index, with the surface
 */
bool lens_indices(const struct lens *lens, double wavelength, struct medium *asked, struct pair *n,
                  struct error *error);

#endif
