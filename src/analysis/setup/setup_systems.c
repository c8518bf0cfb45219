/* analysis/setup/setup_systems.c - a setup's systems for exact rays, image plane, width. */
/* SPDX-License-Identifier: MIT */
#include "analysis/setup/setup.h"

#include "optics/aperture.h"
#include "optics/wavelength.h"
#include "trace/follow.h"
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
    options.stop_radius = setup_stop_radius(setup);
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

/* -------- the stop that the exact marginal ray fills -------- */

bool setup_marginal_stop(const struct setup *setup, double *radius, struct error *error)
{
    const struct arena_mark mark = arena_mark(setup->arena);
    const struct field_point axis = {.kind = FIELD_NONE};
    const size_t stop = setup->lens->stop, along = setup_axis(setup);
    struct system system;
    struct beam beam;
    struct ray ray;
    *radius = NAN;
    if (setup->aperture <= APERTURE_STOP || stop == LENS_NONE) {
        return true;
    }
    if (setup->first.is_telecentric) {
        return fail(error, ERROR_DOMAIN, "the object space is telecentric");
    }
    bool found = systems_compile(setup, setup->lens, lens_primary_wavelength(setup->lens),
                                 SETUP_OPEN, &system, error) &&
                 beam_of_field(&axis, &setup->object, &setup->first, &beam, error) &&
                 aim_at_entrance(&beam, &setup->first, along == 0, along == 1, &ray, error);
    if (found) {
        struct ray_intersection *meetings =
            ARENA_ARRAY(setup->arena, system.places + 1, struct ray_intersection);
        ray_follow(&system, &ray, setup->arena, meetings);
        const struct ray *at = &meetings[stop].ray;
        *radius = hypot(at->point[0], at->point[1]);
        found = at->status == RAY_OK || fail(error, ERROR_DOMAIN,
                                             "the marginal ray of the aperture is lost at surface "
                                             "%zu",
                                             at->surface);
    }
    arena_reset(setup->arena, mark);
    return found;
}

/* A difference between the beams that is said, as a share. */
static const double most_unsaid = 0.02;

const char *setup_stop_warning(const struct setup *setup, struct arena *arena)
{
    double real;
    struct error ignored;
    if (setup->lens->stop_is_real || setup->first.is_telecentric ||
        !setup_marginal_stop(setup, &real, &ignored) || isnan(real)) {
        return NULL;
    }
    const double share = setup->first.stop_radius / real;
    const double diameter = setup->first.entrance_diameter;
    return fabs(share - 1) > most_unsaid
               ? arena_printf(arena,
                              "the stop has the size of the paraxial marginal ray: a beam of about "
                              "%.3g mm fills it, where the aperture says %.3g (stop size real: as "
                              "wide as the exact ray)",
                              share * diameter, diameter)
               : NULL;
}

/* -------- the image plane -------- */

struct pair setup_paraxial_image(const struct lens *lens, const struct first_order *first)
{
    const struct surface *last = &lens->surfaces[lens->surface_count - 1];
    return lens->focus == FOCUS_TABLE && last->has_thickness ? last->thickness.value
                                                             : pair_of(first->image);
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
    const struct surface *last = &setup->lens->surfaces[setup->lens->surface_count - 1];
    if (kind == PLANE_TABLE && last->has_thickness) {
        setup->image = last->thickness.value.hi;
        setup->focus = "table";
    } else if (kind == PLANE_TABLE && is_asked) {
        return fail(error, ERROR_DOMAIN, "the lens states no distance behind its last surface");
    } else if (kind == PLANE_TABLE) {
        setup->warning =
            "the lens states no distance behind its last surface: paraxial focus instead";
    }
    if (kind == PLANE_AT) {
        setup->image = asked->distance;
        setup->focus = "given";
    }
    struct system system;
    if (kind == PLANE_BEST &&
        systems_compile(setup, setup->lens, lens_primary_wavelength(setup->lens), SETUP_OPEN,
                        &system, error) &&
        lens_best_focus(&system, &setup->object, &setup->first, setup->arena, &best, error)) {
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

/* -------- a beam that is asked for wider than the lens is -------- */

/* How far the marginal ray goes beyond the clear apertures: the largest of height over reach. */
static double excess(const struct setup *setup, struct arena *arena)
{
    const struct lens *lens = setup->lens;
    const struct first_order *first = &setup->first;
    struct paraxial_system system;
    struct error ignored;
    double most = 0;
    if (isnan(first->marginal_y) || !paraxial_compile(lens, lens_primary_wavelength(lens),
                                                      setup->section, arena, &system, &ignored)) {
        return 0;
    }
    struct paraxial_ray *rays = ARENA_ARRAY(arena, system.count + 1, struct paraxial_ray);
    paraxial_follow(&system, pair_of(first->marginal_y), pair_of(first->marginal_v), rays);
    for (size_t i = 0; i < system.count; i++) {
        /* the stop is as wide as the beam has it */
        if (i != system.stop) {
            most = fmax(most, fabs(rays[i].y) / aperture_reach(&lens->surfaces[i]));
        }
    }
    return most;
}

struct setup_width setup_width(const struct setup *setup, double fnumber, struct arena *arena)
{
    /* The f-number of the beam that the lens states; NaN where it states none. */
    const struct aperture_setting own = lens_aperture(setup->lens);
    struct first_order first = setup->first;
    struct error ignored;
    const double passing = fnumber * excess(setup, arena),
                 stated =
                     first_order_aperture(&first, &setup->object, &own, FIELD_NONE, NAN, &ignored)
                         ? first.fnumber
                         : (double)NAN;
    return (struct setup_width){isfinite(stated) ? stated : passing, passing};
}

const char *setup_width_text(const struct setup_width *width, double fnumber, struct arena *arena)
{
    const bool is_wider =
        fnumber < SETUP_WIDTH_SLACK * width->own && fnumber < SETUP_WIDTH_SLACK * width->passing;
    return is_wider ? arena_printf(arena,
                                   "the lens is f/%.4g wide open: rays of f/%.4g pass only where "
                                   "its clear apertures let them",
                                   width->own, fnumber)
                    : NULL;
}

const char *setup_width_warning(const struct setup *setup, double fnumber, struct arena *arena)
{
    if (!(fnumber > 0)) {
        return NULL;
    }
    const struct setup_width width = setup_width(setup, fnumber, arena);
    return setup_width_text(&width, fnumber, arena);
}
