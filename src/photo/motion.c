/* photo/motion.c - blur of moving subjects and unsteady cameras. */
/* SPDX-License-Identifier: MIT */
#include "photo/motion.h"

#include "base/constants.h"

#include <math.h>

#include "photo/given.h"

static bool motion_check_angle(double angle, struct error *error)
{
    return (angle >= 0 && angle <= PI) ||
           fail(error, ERROR_DOMAIN, "{angle of the motion} %.10g deg lies outside 0 to 180 deg",
                angle * DEGREES_PER_RADIAN);
}

bool motion_magnification(double f, double s, double *m, struct error *error)
{
    if (!require_positive("focal length", " mm", f, error)) {
        return false;
    }
    if (!(s > f)) {
        return fail(error, ERROR_DOMAIN,
                    "{distance} %.10g mm lies within {the focal length} %.10g mm: no real image", s,
                    f);
    }
    *m = f / (s - f);
    return true;
}

/* Image shift per path, and how the path changes the distance: shift = x across/(1 - x depth). */
struct rate {
    double across; /* mm on the sensor per mm of path, at the start; signed */
    double depth;  /* part of the distance covered per mm of path, 1/mm; + towards the camera */
};

static struct rate find_rate(const struct motion *motion)
{
    double depth = is_given(motion->s) ? cos(motion->angle) / motion->s : 0;
    return (struct rate){
        (is_given(motion->m) ? motion->m : 0) * sin(motion->angle) + motion->h * depth, depth};
}

static bool blur_of(struct motion *motion, struct error *error)
{
    struct rate rate = find_rate(motion);
    double path = motion->v * motion->t;
    if (!(path * rate.depth < 1)) {
        return fail(error, ERROR_DOMAIN,
                    "{exposure time} %.10g s is too long: the subject reaches the lens in %.6g s",
                    motion->t, 1 / (motion->v * rate.depth));
    }
    motion->blur = fabs(path * rate.across / (1 - path * rate.depth));
    return true;
}

static bool magnification_of(struct motion *motion, struct error *error)
{
    double path = motion->v * motion->t;
    double depth = find_rate(motion).depth;
    if (fabs(motion->h) > 0) {
        return fail(error, ERROR_USAGE,
                    "{magnification} is solved for on the axis only: leave {image height} out");
    }
    motion->m = motion->blur * (1 - path * depth) / (path * sin(motion->angle));
    return answer_positive("the magnification", motion->m, error);
}

bool motion_solve(struct motion *motion, struct error *error)
{
    const struct given numbers[] = {{"speed", " mm/s", motion->v},
                                    {"exposure time", " s", motion->t},
                                    {"magnification", "", motion->m},
                                    {"blur", " mm", motion->blur}};
    if (given_missing(numbers, 4) != 1) {
        return fail(error, ERROR_USAGE,
                    "give exactly three of {speed}, {exposure time}, {magnification} and {blur}");
    }
    const struct given distance = {"distance", " mm", motion->s};
    if (!given_above_0(&distance, 1, error) ||
        !check_finite("image height", " mm", motion->h, error) ||
        !given_positive(numbers, 4, error) || !motion_check_angle(motion->angle, error)) {
        return false;
    }
    if (!is_given(motion->blur)) {
        return blur_of(motion, error);
    }
    if (!is_given(motion->m)) {
        return magnification_of(motion, error);
    }
    /* Length of path that blurs by motion->blur; inf if none does. */
    struct rate rate = find_rate(motion);
    double slope = fabs(rate.across) + motion->blur * rate.depth;
    double path = fabs(rate.across) > 0 && slope > 0 ? motion->blur / slope : INFINITY;
    if (!is_given(motion->t)) {
        motion->t = path / motion->v;
        return true;
    }
    motion->v = path / motion->t;
    if (!isfinite(motion->v)) {
        return fail(error, ERROR_DOMAIN,
                    "no speed makes {the blur} %.10g mm at {the angle of the motion} %.6g deg",
                    motion->blur, motion->angle * DEGREES_PER_RADIAN);
    }
    return answer_positive("the speed", motion->v, error);
}

bool shake_solve(struct shake *shake, struct error *error)
{
    const struct given numbers[] = {{"focal length", " mm", shake->f},
                                    {"rotation", " rad/s", shake->omega},
                                    {"exposure time", " s", shake->t},
                                    {"blur", " mm", shake->blur}};
    if (given_missing(numbers, 4) != 1) {
        return fail(error, ERROR_USAGE,
                    "give exactly three of {focal length}, {rotation}, {exposure time} and {blur}");
    }
    if (!given_positive(numbers, 4, error) ||
        !check_not_negative("magnification", "", shake->m, error)) {
        return false;
    }
    double *unknown = &shake->blur;
    double stretch = 1 + shake->m;
    if (!is_given(shake->blur)) {
        shake->blur = shake->f * stretch * shake->omega * shake->t;
    } else if (!is_given(shake->f)) {
        unknown = &shake->f;
        shake->f = shake->blur / (stretch * shake->omega * shake->t);
    } else if (!is_given(shake->omega)) {
        unknown = &shake->omega;
        shake->omega = shake->blur / (shake->f * stretch * shake->t);
    } else {
        unknown = &shake->t;
        shake->t = shake->blur / (shake->f * stretch * shake->omega);
    }
    return answer_positive("the answer", *unknown, error);
}

bool blur_measure(double blur, double pitch, double c, struct blur_size *size, struct error *error)
{
    const struct given numbers[] = {{"pixel pitch", " mm", pitch},
                                    {"circle of confusion", " mm", c}};
    size->pixels = blur / pitch;
    size->circles = blur / c;
    return given_positive(numbers, 2, error);
}

bool panning_solve(const struct panning_shot *pan, struct panning_blur *blur, struct error *error)
{
    double m = 0;
    if (!require_positive("speed", " mm/s", pan->v, error) ||
        !require_positive("exposure time", " s", pan->t, error) ||
        !motion_check_angle(pan->angle, error) ||
        !motion_magnification(pan->f, pan->s, &m, error) ||
        !check_not_negative("track", "", pan->track, error)) {
        return false;
    }
    double across = pan->v * sin(pan->angle);
    blur->rate = across / pan->s;
    blur->subject = fabs(1 - pan->track) * m * across * pan->t;
    blur->background = pan->track * m * across * pan->t;
    return true;
}

bool handheld_time(double f, double crop, double stops, double *t, struct error *error)
{
    *t = exp2(stops) / (crop * f);
    return require_positive("focal length", " mm", f, error) &&
           require_positive("crop factor", "", crop, error) &&
           require_within("stabiliser", " stops", stops, 0, 20, error) &&
           answer_positive("the longest time", *t, error);
}

bool rolling_shutter(double speed, double readout, double height, struct rolling_skew *skew,
                     struct error *error)
{
    skew->shift = speed * readout;
    skew->angle = atan(skew->shift / height);
    return check_not_negative("speed of the image", " mm/s", speed, error) &&
           require_positive("readout time", " s", readout, error) &&
           require_positive("height of the sensor", " mm", height, error);
}
