/* exchange/zemax/zemax_working.c - the working f-number of a near object in .zmx files. */
/* SPDX-License-Identifier: MIT */
#include "exchange/zemax/zemax_working.h"

#include "file/lens_unit.h"
#include "optics/first_order.h"

#include <math.h>
#include <string.h>

/* The diameter in mm; NaN where there is none. */
static double diameter_of(const struct lens *lens, double working, struct arena *arena)
{
    const struct aperture_setting unit = {APERTURE_EPD, 1};
    const struct conjugate_object object = lens_object(lens);
    struct first_order of;
    struct error ignored;
    bool known =
        first_order_of_lens(lens, lens_primary_wavelength(lens), SECTION_Y, arena, &of, &ignored) &&
        first_order_aperture(&of, &object, &unit, FIELD_NONE, NAN, &ignored);
    return known ? of.working_fnumber / working : NAN;
}

bool zemax_set_working_aperture(struct zemax_file *file, struct error *error)
{
    const struct zemax_line *line = file->aperture;
    struct lens *lens = file->build.lens;
    if (line == NULL || !text_same(line->keyword, "FNUM") || zemax_number(line, 1) == 0 ||
        lens->object_is_infinite) {
        return true;
    }
    double diameter = diameter_of(lens, zemax_number(line, 0), file->job->arena);
    if (!(diameter > 0 && diameter < INFINITY)) {
        return zemax_loss(file, line, error,
                          "a working f-number that no entrance pupil gives" LOSS_INSTEAD
                          "the lens gets no aperture");
    }
    const struct number_scale scale = lens_unit_scale(lens->unit);
    const char *typed = arena_printf(file->job->arena, "%.15g",
                                     diameter / (scale.multiplier * pow(10, scale.power)));
    lens->aperture_kind = APERTURE_EPD;
    lens->aperture = (struct figure){.typed = text_of(typed), .variable = LENS_NONE};
    return pair_read(typed, typed + strlen(typed), scale, &lens->aperture.value) != NULL;
}
