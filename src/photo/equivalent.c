/* photo/equivalent.c - the same picture on another format. */
/* SPDX-License-Identifier: MIT */
#include "photo/equivalent.h"

#include "photo/given.h"

#include <math.h>

static double format_size(const struct sensor *format, enum equivalent_measure measure)
{
    switch (measure) {
    case EQUIVALENT_WIDTH:
        return format->width;
    case EQUIVALENT_HEIGHT:
        return format->height;
    case EQUIVALENT_AREA:
        return sqrt(format->width * format->height);
    case EQUIVALENT_DIAGONAL:
        break;
    }
    return sensor_diagonal(format);
}

bool equivalent_ratio(const struct sensor *from, const struct sensor *to,
                      enum equivalent_measure measure, double *k, struct error *error)
{
    *k = format_size(to, measure) / format_size(from, measure);
    return sensor_check(from, error) && sensor_check(to, error);
}

bool equivalent_compute(const struct equivalent_setting *setting, double k,
                        enum equivalent_keep keep, struct equivalent *result, struct error *error)
{
    if (!check_positive("focal length", " mm", setting->f, error) ||
        !check_positive("f-number", "", setting->N, error) ||
        !check_positive("pupil magnification", "", setting->P, error) ||
        !check_positive("ISO speed", "", setting->iso, error) ||
        !check_positive("size ratio of the formats", "", k, error) ||
        !check_not_negative("magnification", "", setting->m, error) ||
        !check_not_negative("circle of confusion", " mm", setting->c, error)) {
        return false;
    }
    double m = k * setting->m;
    double here = 1 + setting->m / setting->P, there = 1 + m / setting->P;
    double scale = k * here / there; /* f'/f */
    bool picture = keep == EQUIVALENT_PICTURE;
    double N = setting->N * (picture ? scale : here / there);
    *result = (struct equivalent){.k = k,
                                  .f = setting->f * scale,
                                  .N = N,
                                  .m = m,
                                  .iso = picture ? setting->iso * k * k : setting->iso,
                                  .c = k * setting->c,
                                  .pupil_diameter = setting->f * scale / N,
                                  .working_fnumber = N * there,
                                  .light_stops = picture ? 0 : 2 * log2(k),
                                  .field_depth_ratio = picture ? 1 : 1 / k};
    return true;
}
