/* photo/microscope.c - microscopes: resolution, depth of field, field, sampling. */
/* SPDX-License-Identifier: MIT */
#include "photo/microscope.h"

#include "photo/diffraction.h"
#include "photo/given.h"

#include <math.h>

static const double NEAR_POINT = 250; /* mm, by which powers are defined */
static const double BEREK = 0.34;     /* mm: what an eye tells apart, 340 um in [LeicaDepth] */

static bool microscope_check(const struct microscope_setting *s, struct error *error)
{
    const struct given numbers[] = {
        {"magnification", "", s->magnification},  {"condenser", "", s->condenser},
        {"wavelength", " um", s->wavelength},     {"eyepiece", "", s->eyepiece},
        {"field number", " mm", s->field_number}, {"adapter", "", s->adapter},
        {"pixel pitch", " mm", s->pitch},
    };
    if (!given_positive(numbers, sizeof numbers / sizeof numbers[0], error) ||
        !require_positive("numerical aperture", "", s->na, error)) {
        return false;
    }
    if (!(s->index >= 1)) {
        return fail(error, ERROR_DOMAIN, "{index} %.6g is below 1", s->index);
    }
    return s->na < s->index ||
           fail(error, ERROR_DOMAIN,
                "{numerical aperture} %.6g must be below the index of the medium, %.6g", s->na,
                s->index);
}

bool microscope_compute(const struct microscope_setting *s, struct microscope *result,
                        struct error *error)
{
    if (!microscope_check(s, error)) {
        return false;
    }
    const double l = s->wavelength / 1000, NA = s->na, M = s->magnification;
    const double sum = NA + (s->condenser < NA ? s->condenser : NA);
    const double total = M * s->eyepiece, on_sensor = M * s->adapter;
    *result = (struct microscope){
        .abbe = l / sum,
        .rayleigh = DIFFRACTION_AIRY_RADIUS * l / sum,
        .sparrow = DIFFRACTION_SPARROW * l / sum,
        .working_fnumber = M / (2 * NA),
        .power = total,
        .exit_pupil = 2 * NA * NEAR_POINT / total,
        .field = s->field_number / M,
        .lowest_power = 500 * NA,
        .highest_power = 1000 * NA,
        .eye_depth = s->index * (l / (2 * NA * NA) + BEREK / (NA * total)),
        .camera_magnification = on_sensor,
        .pixel = s->pitch / on_sensor,
        .nyquist_pitch = on_sensor * l / sum / 2,
        .pixels_per_abbe = l / sum * on_sensor / s->pitch,
        .camera_depth = s->index * (l / (NA * NA) + s->pitch / (on_sensor * NA)),
    };
    return true;
}

double microscope_aperture_for(double distance, double wavelength)
{
    return DIFFRACTION_AIRY_RADIUS * (wavelength / 1000) / (2 * distance);
}

double microscope_magnification(double marked, double tube, double reference)
{
    return marked * (tube / reference);
}
