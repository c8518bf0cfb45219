/* photo/format.c - sensor formats and the circle of confusion that suits them. */
/* SPDX-License-Identifier: MIT */
#include "photo/format.h"

#include "base/constants.h"
#include "photo/given.h"

#include <math.h>

#define FIRST_ZERO_OF_J1 3.83170597020751231561

const struct coc coc_default = {.kind = COC_DIAGONAL, .value = 1500};

bool sensor_check(const struct sensor *sensor, struct error *error)
{
    return check_positive("sensor width", " mm", sensor->width, error) &&
           check_positive("sensor height", " mm", sensor->height, error) &&
           (isnan(sensor->pitch) || check_positive("pixel pitch", " mm", sensor->pitch, error));
}

double sensor_diagonal(const struct sensor *sensor)
{
    return hypot(sensor->width, sensor->height);
}

double sensor_pitch_of(const struct sensor *sensor, double pixels)
{
    return sqrt(sensor->width * (sensor->height / pixels));
}

double sensor_crop(const struct sensor *sensor)
{
    return hypot(36, 24) / sensor_diagonal(sensor);
}

bool sensor_optical_format(double inches, struct sensor *sensor, struct error *error)
{
    if (!(inches >= 0.05 && inches <= 4)) {
        return fail(error, ERROR_DOMAIN, "an optical format is 1/20 to 4 inches, not %.6g", inches);
    }
    double diagonal = (inches >= 0.5 ? 16 : 18) * inches;
    *sensor = (struct sensor){.width = diagonal * 4 / 5, .height = diagonal * 3 / 5, .pitch = NAN};
    return true;
}

bool sensor_extract(const struct sensor *gate, double ratio, struct sensor *part,
                    struct error *error)
{
    if (!(ratio >= 0.1 && ratio <= 10)) {
        return fail(error, ERROR_DOMAIN, "a picture's shape is 0.1:1 to 10:1, not %.6g:1", ratio);
    }
    *part = *gate;
    if (gate->width > gate->height * ratio) {
        part->width = gate->height * ratio;
    } else {
        part->height = gate->width / ratio;
    }
    return true;
}

bool coc_resolve(const struct coc *coc, const struct sensor *sensor, double *c, struct error *error)
{
    const double value = coc->value;
    *c = value;
    if (coc->kind == COC_LENGTH) {
        return check_not_negative("circle of confusion", " mm", value, error);
    }
    if (!sensor_check(sensor, error)) {
        return false;
    }
    if (coc->kind == COC_DIAGONAL) {
        *c = sensor_diagonal(sensor) / value;
        return check_positive("circle of confusion d/x: x", "", value, error);
    }
    if (coc->kind == COC_PIXELS) {
        *c = value * sensor->pitch;
        if (isnan(sensor->pitch)) {
            return fail(error, ERROR_DOMAIN,
                        "a circle of confusion in pixels needs the pixel pitch: give {pixel "
                        "pitch}, or a camera with a known one as {sensor}");
        }
        return check_positive("circle of confusion", " pixels", value, error);
    }
    if (coc->kind == COC_PRINT) {
        double enlargement = coc->print / fmax(sensor->width, sensor->height);
        double other = coc->print_short / fmin(sensor->width, sensor->height);
        enlargement = other > 0 ? fmin(enlargement, other) : enlargement;
        *c = coc->viewing / 250 / (coc->acuity * enlargement);
        return check_positive("viewing distance", " mm", coc->viewing, error) &&
               check_positive("acuity", " line pairs per mm", coc->acuity, error) &&
               check_positive("long side of the print", " mm", coc->print, error);
    }
    *c = 2 * FIRST_ZERO_OF_J1 / PI * coc->wavelength * coc->fnumber;
    return check_positive("wavelength", " mm", coc->wavelength, error) &&
           check_positive("f-number", "", coc->fnumber, error);
}
