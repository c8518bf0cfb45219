/* analysis/setup/setup_width.c - a beam that is asked for wider than the lens is. */
/* SPDX-License-Identifier: MIT */
#include "analysis/setup/setup.h"
#include "optics/aperture.h"

#include <math.h>

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
