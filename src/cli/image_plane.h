/* cli/image_plane.h - where --focus, or else the lens, puts the image plane. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_IMAGE_PLANE_H
#define LENSCALC_CLI_IMAGE_PLANE_H

#include "base/arena.h"
#include "base/error.h"
#include "cli/option_ray.h"
#include "optics/first_order.h"

#include <stdbool.h>

struct image_plane {
    double z;            /* from the last vertex, mm; NaN = none: it lies at infinity */
    const char *focus;   /* "paraxial", "table", "best", "given"; null = none */
    const char *warning; /* what the lens asks for and cannot have; null = nothing */
};

/*
 * Find the plane that is asked for. What the file asks for but cannot be is replaced by the
 * paraxial image, with a warning; what the user asks for is not.
 *
 * Given     asked        PLANE_OF_LENS: as the file says
 *           first        of the lens at its primary wavelength: one plane for all wavelengths
 *           stop_radius  mm, for system_options: NaN = what the lens says
 * Errors    ERROR_DOMAIN: a table without an image distance; as lens_best_focus; an image at
 *           infinity that was asked for by name
 */
bool image_plane_find(const struct plane_value *asked, const struct lens *lens,
                      const struct first_order *first, double stop_radius, struct arena *arena,
                      struct image_plane *plane, struct error *error);

/* The best focus of exact rays at the primary wavelength; see lens_best_focus. */
bool image_plane_best(const struct lens *lens, const struct first_order *first, double stop_radius,
                      struct arena *arena, double *z, struct error *error);

#endif
