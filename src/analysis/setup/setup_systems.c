/* analysis/setup/setup_systems.c - a setup's systems for exact rays, and its image plane. */
/* SPDX-License-Identifier: MIT */
#include "analysis/setup/setup.h"
#include "trace/pupil/focus.h"

#include <math.h>

struct setup setup_apart(const struct setup *setup, struct arena *arena)
{
    struct setup other = *setup;
    other.arena = arena;
    other.systems =
        ARENA_ARRAY(arena, setup->wavelength_count * SETUP_SYSTEMS, const struct system *);
    return other;
}

struct setup setup_at_wavelength(const struct setup *setup, double wavelength, struct arena *arena)
{
    struct setup other = *setup;
    struct setup_wavelength *one = ARENA_NEW(arena, struct setup_wavelength);
    *one = (struct setup_wavelength){wavelength, 1};
    other.wavelengths = one;
    other.wavelength_count = 1;
    return setup_apart(&other, arena);
}

/* -------- exact rays -------- */

/* Every system of lenscalc's commands: the stop is as wide as at the primary wavelength. */
static bool systems_compile(const struct setup *setup, const struct lens *lens, double wavelength,
                            unsigned which, struct system *system, struct error *error)
{
    struct system_options options = system_options_default();
    options.clip = (which & SETUP_CLIPPED) != 0;
    options.reverse = (which & SETUP_REVERSED) != 0;
    options.path = (which & SETUP_PATH) != 0;
    options.image = (which & SETUP_IMAGE) != 0 ? setup->image : (double)NAN;
    options.paraxial = (which & SETUP_PARAXIAL) != 0;
    options.stop_radius = setup->first.stop_radius;
    return system_compile(lens, wavelength, &options, setup->arena, system, error);
}

bool setup_compile(const struct setup *setup, const struct lens *lens, size_t wavelength,
                   unsigned which, struct system *system, struct error *error)
{
    return systems_compile(setup, lens, setup->wavelengths[wavelength].wavelength, which, system,
                           error);
}

const struct system *setup_system(const struct setup *setup, size_t wavelength, unsigned which,
                                  struct error *error)
{
    const struct system **kept = &setup->systems[wavelength * SETUP_SYSTEMS + which];
    if (*kept == NULL) {
        struct system *system = ARENA_NEW(setup->arena, struct system);
        if (!setup_compile(setup, setup->lens, wavelength, which, system, error)) {
            return NULL;
        }
        *kept = system;
    }
    return *kept;
}

/* -------- the image plane -------- */

struct pair setup_paraxial_image(const struct lens *lens, const struct first_order *first)
{
    const struct surface *last = &lens->surfaces[lens->surface_count - 1];
    return lens->focus == FOCUS_TABLE && last->has_thickness ? last->thickness.value
                                                             : pair_of(first->image);
}

static bool find_best(const struct setup *setup, double *z, struct error *error)
{
    struct system system;
    return systems_compile(setup, setup->lens, lens_primary_wavelength(setup->lens), SETUP_OPEN,
                           &system, error) &&
           lens_best_focus(&system, &setup->object, &setup->first, setup->arena, z, error);
}

static bool find_table(struct setup *setup, bool is_asked, struct error *error)
{
    const struct surface *last = &setup->lens->surfaces[setup->lens->surface_count - 1];
    if (last->has_thickness) {
        setup->image = last->thickness.value.hi;
        setup->focus = "table";
    } else {
        setup->warning =
            "the lens states no distance behind its last surface: paraxial focus instead";
    }
    return last->has_thickness || !is_asked ||
           fail(error, ERROR_DOMAIN, "the lens states no distance behind its last surface");
}

bool setup_place_image(struct setup *setup, const struct plane_value *asked, struct error *error)
{
    static const enum plane_kind kinds[] = {[FOCUS_PARAXIAL] = PLANE_PARAXIAL,
                                            [FOCUS_TABLE] = PLANE_TABLE,
                                            [FOCUS_BEST] = PLANE_BEST,
                                            [FOCUS_AFOCAL] = PLANE_PARAXIAL};
    bool is_asked = asked->kind != PLANE_OF_LENS;
    enum plane_kind kind = is_asked ? asked->kind : kinds[setup->lens->focus];
    double best;
    setup->image = setup->first.image;
    setup->focus = "paraxial";
    if (kind == PLANE_TABLE && !find_table(setup, is_asked, error)) {
        return false;
    }
    if (kind == PLANE_AT) {
        setup->image = asked->distance;
        setup->focus = "given";
    }
    if (kind == PLANE_BEST && find_best(setup, &best, error)) {
        setup->image = best;
        setup->focus = "best";
    } else if (kind == PLANE_BEST && is_asked) {
        return false;
    } else if (kind == PLANE_BEST) {
        setup->warning = arena_printf(setup->arena, "%s: paraxial focus instead", error->message);
    }
    if (isfinite(setup->image)) {
        return true;
    }
    setup->image = NAN;
    setup->focus = NULL;
    return !is_asked || fail(error, ERROR_DOMAIN,
                             "the image is infinitely far away: its distance must be given");
}
