/* photo/equivalent.c - the same picture on another format. */
/* SPDX-License-Identifier: MIT */
#include "photo/equivalent.h"

#include "photo/given.h"

#include <math.h>

static double size_diagonal(const struct equivalent_format *format)
{
    return hypot(format->width, format->height);
}

static double size_width(const struct equivalent_format *format)
{
    return format->width;
}

static double size_height(const struct equivalent_format *format)
{
    return format->height;
}

static double size_area(const struct equivalent_format *format)
{
    return sqrt(format->width * format->height);
}

/* In the order of enum equivalent_measure. */
static double (*const sizes[])(const struct equivalent_format *) = {size_diagonal, size_width,
                                                                    size_height, size_area};

static bool equivalent_check_format(const struct equivalent_format *format, struct error *error)
{
    if (!(format->width > 0 && isfinite(format->width) && format->height > 0 &&
          isfinite(format->height))) {
        return fail(error, ERROR_DOMAIN, "format %g x %g mm is out of range (both sides above 0)",
                    format->width, format->height);
    }
    return true;
}

bool equivalent_ratio(const struct equivalent_format *from, const struct equivalent_format *to,
                      enum equivalent_measure measure, double *k, struct error *error)
{
    if (!equivalent_check_format(from, error) || !equivalent_check_format(to, error)) {
        return false;
    }
    *k = sizes[measure](to) / sizes[measure](from);
    return true;
}

static bool equivalent_check_setting(const struct equivalent_setting *s, double k,
                                     struct error *error)
{
    if (!check_positive("focal length", " mm", s->f, error) ||
        !check_positive("f-number", "", s->N, error) ||
        !check_positive("pupil magnification", "", s->P, error) ||
        !check_positive("ISO speed", "", s->iso, error) ||
        !check_positive("size ratio of the formats", "", k, error)) {
        return false;
    }
    if (!(s->m >= 0 && isfinite(s->m))) {
        return fail(error, ERROR_DOMAIN, "{magnification} %g is out of range (0 or more, finite)",
                    s->m);
    }
    if (!(s->c >= 0 && isfinite(s->c))) {
        return fail(error, ERROR_DOMAIN,
                    "{circle of confusion} %g mm is out of range (0 or more, finite)", s->c);
    }
    return true;
}

bool equivalent_compute(const struct equivalent_setting *setting, double k,
                        enum equivalent_keep keep, struct equivalent *result, struct error *error)
{
    if (!equivalent_check_setting(setting, k, error)) {
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
