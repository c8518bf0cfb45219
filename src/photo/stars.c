/* photo/stars.c - star trails of a camera that stands still. */
/* SPDX-License-Identifier: MIT */
#include "photo/stars.h"

#include "base/constants.h"

#include <math.h>

#include "photo/given.h"

static bool check_declination(double dec, struct error *error)
{
    /* 1e-12: 90 deg converted from other units may round up */
    return fabs(dec) <= PI / 2 * (1 + 1e-12) ||
           fail(error, ERROR_DOMAIN, "{declination} %.10g deg lies outside -90 to 90 deg",
                dec * DEGREES_PER_RADIAN);
}

static bool check_off_pole(double dec, struct error *error)
{
    return check_declination(dec, error) &&
           (fabs(dec) < PI / 2 * (1 - 1e-12) ||
            fail(error, ERROR_DOMAIN,
                 "{declination} %.10g deg is a pole: a star there does not move and no time is "
                 "too long; the declination must lie between -90 and 90 deg",
                 dec * DEGREES_PER_RADIAN));
}

static bool check_time(double t, struct error *error)
{
    return require_positive("exposure time", " s", t, error) &&
           (t <= STELLAR_DAY ||
            fail(
                error, ERROR_DOMAIN,
                "{exposure time} %.10g s exceeds one turn of the sky, %.10g s: the trail is closed",
                t, STELLAR_DAY));
}

/* End-to-end trail per focal length; inf where an end lies 90 deg off the axis or behind it. */
static double unit_chord(double dec, double t)
{
    double q = STELLAR_RATE * t / 2;
    double c = cos(dec);
    double half_sine = sin(q / 2);
    double depth = 1 - 2 * c * c * half_sine * half_sine; /* cosine of the angle off the axis */
    return depth > 0 ? 2 * c * sin(q) / depth : INFINITY;
}

bool star_trail(double f, double dec, double t, struct star_trail *trail, struct error *error)
{
    if (!require_positive("focal length", " mm", f, error) || !check_declination(dec, error) ||
        !check_time(t, error)) {
        return false;
    }
    const double c = fmax(cos(dec), 0), rotation = STELLAR_RATE * t, arc = rotation * c;
    *trail = (struct star_trail){.rotation = rotation,
                                 .arc = arc,
                                 .separation = 2 * asin(c * sin(rotation / 2)),
                                 .linear = f * arc,
                                 .chord = f * fmax(unit_chord(dec, t), 0)};
    return true;
}

bool star_trail_worst(double f, double dec, double t, double half_diagonal, double *worst,
                      struct error *error)
{
    if (!require_positive("focal length", " mm", f, error) || !check_declination(dec, error) ||
        !check_time(t, error) ||
        !check_not_negative("half diagonal", " mm", half_diagonal, error)) {
        return false;
    }
    double R = half_diagonal / f, c = fmax(cos(dec), 0), s = fabs(sin(dec));
    double steep = 2 + R * R;
    bool aside = s < c * R * steep; /* not straight towards the equator */
    double speed =
        aside ? sqrt(c * c * (1 + R * R) * (1 + R * R) + R * R * s * s + s * s / steep) : c + s * R;
    *worst = f * STELLAR_RATE * t * speed;
    return true;
}

bool star_time(double f, double dec, double allowed, struct star_time *time, struct error *error)
{
    if (!require_positive("focal length", " mm", f, error) || !check_off_pole(dec, error) ||
        !require_positive("trail", " mm", allowed, error)) {
        return false;
    }
    double g = f * cos(dec);
    double inside = 4 * g * g + allowed * allowed * cos(2 * dec);
    time->linear = allowed / (g * STELLAR_RATE);
    time->exact =
        inside >= 0 ? 4 * atan(allowed / (2 * g + sqrt(inside))) / STELLAR_RATE : INFINITY;
    return true;
}

bool star_focal_length(double dec, double t, double allowed, double *f, struct error *error)
{
    *f = allowed / unit_chord(dec, t);
    return check_off_pole(dec, error) && check_time(t, error) &&
           require_positive("trail", " mm", allowed, error) &&
           answer_positive("the focal length", *f, error);
}

bool star_rule_time(double constant, double f, double crop, double *t, struct error *error)
{
    *t = constant / (crop * f);
    return require_positive("rule constant", "", constant, error) &&
           require_positive("focal length", " mm", f, error) &&
           require_positive("crop factor", "", crop, error) &&
           answer_positive("the longest time", *t, error);
}

static bool check_npf(double f, double N, double pitch, struct error *error)
{
    return require_positive("focal length", " mm", f, error) &&
           require_positive("f-number", "", N, error) &&
           require_positive("pixel pitch", " mm", pitch, error);
}

bool npf_simple_time(double f, double N, double pitch, double *t, struct error *error)
{
    *t = (35 * N + 30 * (pitch * 1000)) / f;
    return check_npf(f, N, pitch, error) && answer_positive("the longest time", *t, error);
}

bool npf_full_time(double f, double N, double pitch, double dec, double k, double *t,
                   struct error *error)
{
    *t = k * (16.9 * N + 0.10 * f + 13.7 * (pitch * 1000)) / (f * cos(dec));
    return check_npf(f, N, pitch, error) && check_off_pole(dec, error) &&
           require_positive("accuracy", "", k, error) &&
           answer_positive("the longest time", *t, error);
}

bool four_minus_crop_time(double f, double crop, double *t, struct error *error)
{
    if (!require_positive("focal length", " mm", f, error) ||
        !require_positive("crop factor", "", crop, error)) {
        return false;
    }
    if (!(crop < 4)) {
        return fail(error, ERROR_DOMAIN, "crop factor %.10g must lie below 4 for the 4 - crop rule",
                    crop);
    }
    *t = 100 * (4 - crop) / f;
    return answer_positive("the longest time", *t, error);
}
