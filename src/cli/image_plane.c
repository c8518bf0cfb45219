/* cli/image_plane.c - the kinds of image plane. */
/* SPDX-License-Identifier: MIT */
#include "cli/image_plane.h"

#include "trace/focus.h"
#include "trace/system.h"

#include <math.h>

bool image_plane_best(const struct lens *lens, const struct first_order *first, double stop_radius,
                      struct arena *arena, double *z, struct error *error)
{
    const struct conjugate_object object = lens_object(lens);
    struct system_options options = system_options_default();
    struct system system;
    options.stop_radius = stop_radius;
    return system_compile(lens, lens_primary_wavelength(lens), &options, arena, &system, error) &&
           lens_best_focus(&system, &object, first, arena, z, error);
}

static bool find_table(const struct lens *lens, bool asked, struct image_plane *plane,
                       struct error *error)
{
    const struct surface *last = &lens->surfaces[lens->surface_count - 1];
    if (last->has_thickness) {
        *plane = (struct image_plane){.z = last->thickness.value.hi, .focus = "table"};
    }
    return last->has_thickness || !asked ||
           fail(error, ERROR_DOMAIN,
                "--focus table: the lens states no distance behind its last surface");
}

bool image_plane_find(const struct plane_value *asked, const struct lens *lens,
                      const struct first_order *first, double stop_radius, struct arena *arena,
                      struct image_plane *plane, struct error *error)
{
    static const enum plane_kind kinds[] = {
        [FOCUS_PARAXIAL] = PLANE_PARAXIAL, [FOCUS_TABLE] = PLANE_TABLE, [FOCUS_BEST] = PLANE_BEST};
    bool is_asked = asked->kind != PLANE_OF_LENS;
    enum plane_kind kind = is_asked ? asked->kind : kinds[lens->focus];
    *plane = (struct image_plane){.z = first->image, .focus = "paraxial"};
    if (kind == PLANE_TABLE && !find_table(lens, is_asked, plane, error)) {
        return false;
    }
    if (kind == PLANE_AT) {
        *plane = (struct image_plane){.z = asked->distance, .focus = "given"};
    }
    if (kind == PLANE_BEST) {
        double best;
        if (image_plane_best(lens, first, stop_radius, arena, &best, error)) {
            *plane = (struct image_plane){.z = best, .focus = "best"};
        } else if (is_asked) {
            return error_prefix(error, "--focus best: ");
        } else {
            plane->warning = arena_printf(arena, "%s: paraxial focus instead", error->message);
        }
    }
    if (isfinite(plane->z)) {
        return true;
    }
    plane->z = NAN;
    plane->focus = NULL;
    return !is_asked || fail(error, ERROR_DOMAIN,
                             "the image is infinitely far away: --focus wants a number of mm");
}
