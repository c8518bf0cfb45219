/* exchange/entrance_pupil.c - near objects: apertures that files state in other words, virtual ones. */
/* SPDX-License-Identifier: MIT */
#include "exchange/entrance_pupil.h"

#include "file/lens_unit.h"
#include "optics/first_order.h"

#include <math.h>
#include <string.h>

/* The diameter in mm; NaN where there is none. */
static double entrance_diameter_of(const struct lens *lens, enum pupil_stated stated, double value,
                                   struct arena *arena)
{
    const struct aperture_setting unit = {APERTURE_EPD, 1};
    const struct conjugate_object object = lens_object(lens);
    struct first_order of;
    struct error ignored;
    if (!first_order_of_lens(lens, lens_primary_wavelength(lens), SECTION_Y, arena, &of,
                             &ignored) ||
        !first_order_aperture(&of, &object, &unit, FIELD_NONE, NAN, &ignored)) {
        return NAN;
    }
    const double distance = object.distance.hi;
    return stated == PUPIL_WORKING_FNUMBER
               ? of.working_fnumber / value
               : fabs(2 * value * (distance + of.entrance_pupil) / distance);
}

bool entrance_pupil_set(struct lens *lens, enum pupil_stated stated, double value,
                        struct arena *arena)
{
    const double diameter = entrance_diameter_of(lens, stated, value, arena);
    const struct number_scale scale = lens_unit_scale(lens->unit);
    lens->aperture_kind = APERTURE_NONE;
    if (!(diameter > 0 && diameter < INFINITY)) {
        return false;
    }
    const char *typed =
        arena_printf(arena, "%.15g", diameter / (scale.multiplier * pow(10, scale.power)));
    lens->aperture_kind = APERTURE_EPD;
    lens->aperture = (struct figure){.typed = text_of(typed), .variable = LENS_NONE};
    return pair_read(typed, typed + strlen(typed), scale, &lens->aperture.value) != NULL;
}

void virtual_object_put(struct lens_build *build, struct pair distance)
{
    struct lens *lens = build->lens;
    struct figure one = {.typed = text_of("1"), .variable = LENS_NONE};
    const struct number_scale unit = lens_unit_scale(lens->unit);
    text_pair(one.typed, unit, &one.value);
    lens->object = one;
    lens->object_is_infinite = false;
    struct surface *plane = lens_build_surface(build);
    plane->medium = lens->object_medium;
    plane->thickness = figure_computed(pair_subtract(distance, one.value), unit, build->arena);
    const char *where =
        distance.hi < 0 ? arena_printf(build->arena, "%.6g mm behind", -distance.hi) : "in";
    lens_build_note(build,
                    text_of(arena_printf(build->arena,
                                         "the object lies %s the first surface of the file: "
                                         "surface 1 is a plane 1 %s behind the object, from which "
                                         "rays go back",
                                         where, lens->unit)));
}
