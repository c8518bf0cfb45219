/* photo/fov.c - field of view of the five projections. */
/* SPDX-License-Identifier: MIT */
#include "photo/fov.h"

#include "base/constants.h"
#include "photo/given.h"

#include <math.h>

const struct word projections[PROJECTIONS + 1] = {
    [RECTILINEAR] = {"rectilinear", "f tan t: straight lines stay straight"},
    [EQUIDISTANT] = {"equidistant", "f t: image height in proportion to the angle"},
    [EQUISOLID] = {"equisolid", "2 f sin(t/2): image area in proportion to the solid angle"},
    [STEREOGRAPHIC] = {"stereographic", "2 f tan(t/2): small shapes stay true"},
    [ORTHOGRAPHIC] = {"orthographic", "f sin t: at most a half sphere"},
};

static double identity(double x)
{
    return x;
}

/* The image height r/f' of the half angle t is factor forward(t/factor). */
static const struct fov_rule {
    double (*forward)(double), (*inverse)(double);
    double factor;
    double largest_height; /* r/f' at the edge of the projection */
    double largest_angle;  /* full, rad */
    bool open;             /* the largest angle itself is not reached */
} rules[PROJECTIONS] = {
    [RECTILINEAR] = {tan, atan, 1, INFINITY, PI, true},
    [EQUIDISTANT] = {identity, identity, 1, PI, 2 * PI, false},
    [EQUISOLID] = {sin, asin, 2, 2, 2 * PI, false},
    [STEREOGRAPHIC] = {tan, atan, 2, INFINITY, 2 * PI, true},
    [ORTHOGRAPHIC] = {sin, asin, 1, 1, PI, false},
};

static double projected_height(const struct fov_rule *rule, double angle)
{
    return rule->factor * rule->forward(angle / rule->factor);
}

bool fov_angle(enum projection projection, double scale, double dimension, double *angle,
               struct error *error)
{
    const struct fov_rule *rule = &rules[projection];
    if (!check_positive("focal length", " mm", scale, error) ||
        !check_positive("sensor dimension", " mm", dimension, error)) {
        return false;
    }
    double x = dimension / 2 / scale;
    if (!(x <= rule->largest_height)) {
        return fail(error, ERROR_DOMAIN,
                    "image height %.15g mm lies beyond the edge of the %s projection, %.15g mm",
                    dimension / 2, projections[projection].word, rule->largest_height * scale);
    }
    *angle = 2 * (rule->factor * rule->inverse(x / rule->factor));
    return true;
}

bool fov_height(enum projection projection, double angle, double *height, struct error *error)
{
    const struct fov_rule *rule = &rules[projection];
    const double largest = rule->largest_angle / 2;
    if (!(angle >= 0 && (rule->open ? angle < largest : angle <= largest))) {
        return fail(error, ERROR_DOMAIN,
                    "a field of %.6g deg lies beyond the %s projection, which ends %s %.6g deg",
                    angle * DEGREES_PER_RADIAN, projections[projection].word,
                    rule->open ? "before" : "at", largest * DEGREES_PER_RADIAN);
    }
    *height = projected_height(rule, angle);
    return true;
}

bool fov_compute(const struct fov_setting *setting, const struct sensor *sensor, struct fov *fov,
                 struct error *error)
{
    if (!check_positive("focal length", " mm", setting->f, error) ||
        !check_positive("pupil magnification", "", setting->P, error) ||
        !check_positive("anamorphic squeeze", "", setting->squeeze, error)) {
        return false;
    }
    if (!(setting->s > setting->f)) {
        return fail(error, ERROR_DOMAIN,
                    "{distance} %.15g mm lies within {the focal length} %.15g mm: no real image",
                    setting->s, setting->f);
    }
    if (!sensor_check(sensor, error)) {
        return false;
    }
    struct sensor wide = *sensor;
    wide.width *= setting->squeeze;
    enum projection projection = setting->projection;
    double diagonal = sensor_diagonal(&wide);
    double m = setting->f / (setting->s - setting->f);
    double scale = setting->f * (1 + m / setting->P);
    double unit = projection == RECTILINEAR ? 1 / m : NAN;
    fov->width_at_s = wide.width * unit;
    fov->height_at_s = wide.height * unit;
    fov->diagonal_at_s = diagonal * unit;
    if (!fov_angle(projection, scale, wide.width, &fov->horizontal, error) ||
        !fov_angle(projection, scale, wide.height, &fov->vertical, error) ||
        !fov_angle(projection, scale, diagonal, &fov->diagonal, error)) {
        return false;
    }
    fov->kind = fov_kind(fov->diagonal);
    return true;
}

static bool fov_check_angle(enum projection projection, double angle, struct error *error)
{
    const struct fov_rule *rule = &rules[projection];
    return (angle > 0 &&
            (angle < rule->largest_angle || (angle <= rule->largest_angle && !rule->open))) ||
           fail(error, ERROR_DOMAIN,
                "angle of view %.15g deg must be above 0 and %s %.15g deg (%s)",
                angle * DEGREES_PER_RADIAN, rule->open ? "below" : "at most",
                rule->largest_angle * DEGREES_PER_RADIAN, projections[projection].word);
}

bool fov_focal_length(const struct fov_setting *setting, double dimension, double angle, double *f,
                      struct error *error)
{
    double s = setting->s, P = setting->P;
    if (!check_positive("sensor dimension", " mm", dimension, error) ||
        !check_positive("pupil magnification", "", P, error) ||
        !fov_check_angle(setting->projection, angle, error)) {
        return false;
    }
    if (!(s > 0)) {
        return fail(error, ERROR_DOMAIN, "{distance} %.15g mm must be above 0 mm", s);
    }
    double scale = dimension / 2 / projected_height(&rules[setting->projection], angle / 2);
    if (s < INFINITY) {
        double b = P * (s + scale), root = hypot(P * (s - scale), 2 * sqrt(P * scale * s));
        *f = 2 * P * (scale / (b + root)) * s;
    } else {
        *f = scale;
    }
    return check_positive("focal length", " mm", *f, error);
}

bool fov_focal_length_for_field(double dimension, double field, double s, double *f,
                                struct error *error)
{
    *f = s * (dimension / (field + dimension));
    return check_positive("sensor dimension", " mm", dimension, error) &&
           check_positive("field width", " mm", field, error) &&
           check_positive("distance", " mm", s, error);
}

/* On level ground, straight below. */
static double ground_across(double altitude, double angle)
{
    return angle < PI ? 2 * altitude * tan(angle / 2) : (double)INFINITY;
}

double fov_scale(const struct fov_setting *setting)
{
    const double m = setting->f / (setting->s - setting->f);
    return setting->f * (1 + m / setting->P);
}

bool fov_ground(const struct fov_setting *setting, const struct fov *fov, double pitch,
                struct fov_ground *ground, struct error *error)
{
    const struct given numbers[] = {{"altitude", " mm", ground->altitude},
                                    {"ground sample", " mm", ground->sample},
                                    {"pixel pitch", " mm", pitch}};
    if (is_given(ground->altitude) == is_given(ground->sample)) {
        return fail(error, ERROR_USAGE, "give one of {altitude} and {ground sample}");
    }
    if (is_given(ground->sample) && !is_given(pitch)) {
        return fail(error, ERROR_USAGE, "{ground sample} needs {pixel pitch}");
    }
    if (!given_positive(numbers, 3, error)) {
        return false;
    }
    const double scale = fov_scale(setting);
    if (is_given(ground->sample)) {
        ground->altitude = ground->sample * (scale / pitch);
    } else {
        ground->sample = ground->altitude * (pitch / scale);
    }
    ground->width = ground_across(ground->altitude, fov->horizontal);
    ground->height = ground_across(ground->altitude, fov->vertical);
    return true;
}

const char *fov_kind(double diagonal)
{
    static const struct {
        double below; /* deg */
        const char *word;
    } kinds[] = {{20, "narrow"}, {40, "medium"}, {60, "normal"}, {90, "wide"}};
    for (int i = 0; i < 4; i++) {
        if (diagonal * DEGREES_PER_RADIAN < kinds[i].below) {
            return kinds[i].word;
        }
    }
    return "ultra-wide";
}
