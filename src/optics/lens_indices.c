/* optics/lens_indices.c - the indices of a lens at one wavelength. */
/* SPDX-License-Identifier: MIT */
#include "optics/lens_indices.h"

static bool is_equal(struct pair a, struct pair b)
{
    return a.hi == b.hi && a.lo == b.lo;
}

static bool lens_indices_ask(const struct medium *medium, double wavelength, struct medium *asked,
                             struct pair *n, struct error *error)
{
    if (asked != NULL &&
        (medium->kind == asked->kind && is_equal(medium->index, asked->index) &&
         is_equal(medium->abbe, asked->abbe) && medium->points == asked->points &&
         medium->glass_index == asked->glass_index && medium->glass == asked->glass)) {
        return true;
    }
    const bool found = medium_index(medium, wavelength, n, error);
    if (asked != NULL) {
        *asked = found ? *medium : (struct medium){.kind = MEDIUM_CONSTANT};
    }
    return found;
}

bool lens_indices(const struct lens *lens, double wavelength, struct medium *asked, struct pair *n,
                  struct error *error)
{
    if (!lens_indices_ask(&lens->object_medium, wavelength, asked, &n[0], error)) {
        return error_prefix(error, "object medium: ");
    }
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        if (surface_reflects(surface)) {
            n[i + 1] = n[i];
        } else if (!lens_indices_ask(&surface->medium, wavelength,
                                     asked != NULL ? &asked[i + 1] : NULL, &n[i + 1], error)) {
            return error_prefix(error, "surface %zu: ", i + 1);
        }
    }
    return true;
}
