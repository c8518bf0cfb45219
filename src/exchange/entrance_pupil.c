/* exchange/entrance_pupil.c - apertures of near objects that files state in other words. */
/* SPDX-License-Identifier: MIT */
#include "exchange/entrance_pupil.h"

#include "file/lens_unit.h"
#include "optics/first_order.h"

#include <math.h>
#include <string.h>

/* The diameter in mm; NaN where there is none. */
static double diameter_of(const struct lens *lens, enum pupil_stated stated, double value,
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
    const double diameter = diameter_of(lens, stated, value, arena);
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
