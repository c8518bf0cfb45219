/* photo/visual.c - telescopes and binoculars, with the eye behind them. */
/* SPDX-License-Identifier: MIT */
#include "photo/visual.h"

#include "base/constants.h"
#include "photo/diffraction.h"
#include "photo/given.h"

#include <math.h>

/* Numbers as they are marked agree so well: a telescope of 200 mm and 1219 mm is sold as f/6. */
static const double MARKED = 0.02;

/* a = b c, of which two make the third; do all three agree? */
static bool visual_relate(double *a, double *b, double *c)
{
    if (!is_given(*a)) {
        *a = *b * *c;
    } else if (!is_given(*b)) {
        *b = *a / *c;
    } else if (!is_given(*c)) {
        *c = *a / *b;
    } else {
        return fabs(*a / (*b * *c) - 1) <= MARKED;
    }
    return true;
}

bool visual_solve(struct visual_setting *s, struct error *error)
{
    const struct given numbers[] = {
        {"telescope", " mm", s->focal},       {"diameter", " mm", s->diameter},
        {"f-number", "", s->fnumber},         {"Barlow factor", "", s->barlow},
        {"eyepiece", " mm", s->eyepiece},     {"power", "", s->power},
        {"exit pupil", " mm", s->exit_pupil},
    };
    if (!given_positive(numbers, sizeof numbers / sizeof numbers[0], error)) {
        return false;
    }
    if (!visual_relate(&s->focal, &s->fnumber, &s->diameter)) {
        return fail(error, ERROR_USAGE,
                    "{telescope}, {diameter} and {f-number} contradict each other: give two");
    }
    if (!visual_relate(&s->diameter, &s->power, &s->exit_pupil)) {
        return fail(error, ERROR_USAGE,
                    "{diameter}, {power} and {exit pupil} contradict each other: give two");
    }
    double whole = s->focal * s->barlow;
    if (!visual_relate(&whole, &s->eyepiece, &s->power)) {
        return fail(error, ERROR_USAGE,
                    "{telescope}, {eyepiece} and the power contradict each other: give two");
    }
    /* the power from the eyepiece makes the exit pupil */
    if (!is_given(s->exit_pupil)) {
        s->exit_pupil = s->diameter / s->power;
    } else if (!is_given(s->diameter)) {
        s->diameter = s->exit_pupil * s->power;
    }
    if (!is_given(s->focal)) {
        s->focal = whole / s->barlow;
    }
    if (!is_given(s->fnumber)) {
        s->fnumber = s->focal / s->diameter;
    }
    return true;
}

bool visual_see(double focal, double power, struct visual_field *field, struct error *error)
{
    const struct given numbers[] = {{"field stop", " mm", field->stop},
                                    {"apparent field", " rad", field->apparent},
                                    {"field", " rad", field->true_field}};
    if (!given_positive(numbers, 3, error)) {
        return false;
    }
    if (field->apparent >= PI || field->true_field >= PI) {
        return fail(error, ERROR_DOMAIN, "a field of view must be below 180 deg");
    }
    const bool has_apparent = is_given(field->apparent);
    field->true_by_ratio = field->apparent / power;
    field->true_by_tangent = 2 * atan(tan(field->apparent / 2) / power);
    const double by_stop = 2 * atan(field->stop / (2 * focal));
    bool is_own = true; /* it does not follow from the apparent field */
    if (is_given(field->true_field)) {
        field->true_from = "option";
    } else if (is_given(by_stop)) {
        field->true_field = by_stop;
        field->true_from = "field-stop";
    } else if (is_given(field->true_by_ratio)) {
        field->true_field = is_given(focal) ? field->true_by_ratio : field->true_by_tangent;
        field->true_from = is_given(focal) ? "ratio" : "tangents";
        is_own = false;
    }
    field->apparent_by_ratio = is_own ? field->true_field * power : (double)NAN;
    const double by_tangent = is_own ? 2 * atan(power * tan(field->true_field / 2)) : (double)NAN;
    if (has_apparent) {
        field->apparent_from = "option";
    } else if (is_given(by_tangent)) {
        field->apparent = by_tangent;
        field->apparent_from = "tangents";
    }
    return true;
}

bool visual_gather(const struct visual_setting *setting, const struct visual_eye *eye,
                   double obstruction, double wavelength, struct visual_light *light,
                   struct error *error)
{
    const double D = setting->diameter, M = setting->power, d = eye->pupil;
    const double ARCMIN = RADIANS_PER_DEGREE / 60;
    struct diffraction_angles all, used;
    if (!require_positive("diameter", " mm", D, error) ||
        !check_positive("pupil of the eye", " mm", d, error) ||
        !require_within("obstruction", "", obstruction, 0, 1, error) ||
        !diffraction_resolve(D, wavelength, &all, error)) {
        return false;
    }
    /* fmin passes over a power that is not known */
    light->used_diameter = fmin(D, M * d);
    const double area =
        light->used_diameter * light->used_diameter - obstruction * D * (obstruction * D);
    if (!(area > 0)) {
        return fail(error, ERROR_DOMAIN,
                    "the secondary mirror, %.4g mm, shades all of the %.4g mm that the eye's pupil "
                    "lets through at this power",
                    obstruction * D, light->used_diameter);
    }
    if (!diffraction_resolve(light->used_diameter, wavelength, &used, error)) {
        return false;
    }
    light->gain = area / (d * d);
    light->magnitude = eye->magnitude + 2.5 * log10(light->gain);
    light->rayleigh = used.rayleigh;
    light->dawes = used.dawes;
    light->lowest = D / d;
    light->matched = ARCMIN / all.rayleigh;
    light->highest = 2 * D;
    light->brightness = setting->exit_pupil * setting->exit_pupil;
    light->twilight = sqrt(M * D);
    return true;
}

double visual_eye_relief(double focal, double eyepiece, double back)
{
    return back + eyepiece * (eyepiece / focal);
}

double visual_filter_shift(double thickness, double n)
{
    return thickness * (1 - 1 / n);
}

double visual_pupil_place(double focal, double eyepiece)
{
    return eyepiece * (focal + eyepiece) / focal;
}

bool visual_photograph(const struct visual_camera_given *given, struct visual_camera *camera,
                       struct error *error)
{
    const bool is_projection = is_given(given->projection);
    if (is_projection && !is_given(given->eyepiece)) {
        return fail(error, ERROR_USAGE,
                    "{projection} needs the focal length of the eyepiece: give {eyepiece}, or the "
                    "{telescope}");
    }
    if (is_projection && !(given->projection > given->eyepiece)) {
        return fail(error, ERROR_DOMAIN,
                    "{projection} %.6g mm lies within the focal length of the eyepiece, %.6g mm: "
                    "no image there (more than %.6g mm)",
                    given->projection, given->eyepiece, given->eyepiece);
    }
    camera->factor = is_projection ? given->projection / given->eyepiece - 1
                                   : given->afocal / fabs(given->eyepiece);
    camera->focal = is_projection ? camera->factor * given->focal : given->power * given->afocal;
    camera->fnumber = camera->focal / given->diameter;
    return true;
}
