/* design/degenerate.c - lenses that a search may end at, and that are none. */
/* SPDX-License-Identifier: MIT */
#include "design/degenerate.h"

#include <math.h>

/* Of the height of the marginal ray where it is largest: a stop of less limits no beam. */
static const double least_stop = 1e-3;

/* The largest height of the marginal ray at a surface, mm; NaN: it is not known. */
static double degenerate_height(const struct lens *lens, const struct setup *setup,
                                const struct first_order *first, struct arena *arena)
{
    struct paraxial_system system;
    struct error ignored;
    double most = 0;
    if (!paraxial_compile(lens, lens_primary_wavelength(lens), setup->section, arena, &system,
                          &ignored)) {
        return NAN;
    }
    struct paraxial_ray *rays = ARENA_ARRAY(arena, system.count + 1, struct paraxial_ray);
    paraxial_follow(&system, pair_of(first->marginal_y), pair_of(first->marginal_v), rays);
    for (size_t i = 0; i < system.count; i++) {
        most = fmax(most, fabs(rays[i].y));
    }
    return most;
}

const char *degenerate_words(const struct merit *merit, const struct lens *all, struct arena *arena)
{
    for (size_t i = 0; i < merit->place_count; i++) {
        const struct merit_place *place = &merit->places[i];
        const struct setup *setup = &place->setup;
        const struct lens *lens = lens_at_position(all, place->position, arena);
        const struct arena_mark mark = arena_mark(arena);
        struct first_order first;
        struct error ignored;
        const bool has_beam = lens->stop != LENS_NONE && !setup->first.is_telecentric &&
                              first_order_of_lens(lens, lens_primary_wavelength(lens),
                                                  setup->section, arena, &first, &ignored) &&
                              first_order_aperture(&first, &setup->object, &place->aperture,
                                                   FIELD_NONE, NAN, &ignored);
        const double height = has_beam ? degenerate_height(lens, setup, &first, arena) : NAN;
        arena_reset(arena, mark);
        if (has_beam && fabs(first.stop_radius) < least_stop * height) {
            return "the stop lies at an image of the object, where its radius is 0";
        }
    }
    return NULL;
}
