/* camera/sensor/shutter.c - intervals of time, by the way of a ray. */
/* SPDX-License-Identifier: MIT */
#include "camera/sensor/shutter.h"

#include <math.h>

/* Radius of the hole that lets half of the light through, over that fully open. */
static const double half_light = 0.70710678118654752;

const struct word shutter_kinds[] = {
    [SHUTTER_GLOBAL] = {"global", "open to all rays at once"},
    [SHUTTER_FOCAL] = {"focal", "a slit between two curtains in front of the film"},
    [SHUTTER_LEAF] = {"leaf", "a hole in the stop that grows and shrinks"},
    [SHUTTER_ROLLING] = {"rolling", "read out line after line"},
    [SHUTTER_KINDS] = {NULL, NULL},
};

const struct word shutter_directions[] = {
    [SHUTTER_DOWN] = {"down", "from the top of the picture"},
    [SHUTTER_UP] = {"up", "from its bottom"},
    [SHUTTER_RIGHT] = {"right", "from its left"},
    [SHUTTER_LEFT] = {"left", "from its right"},
    {NULL, NULL},
};

/* How much longer than the exposure: more digits would be lost in the interval's ends. */
static const double longest_travel = 1e8;

static bool check_curtains(const struct shutter_question *question, struct error *error)
{
    const double most = longest_travel * question->time;
    if (!(question->travel > 0 && question->travel <= most && isfinite(question->travel))) {
        return fail(error, ERROR_DOMAIN,
                    "%s takes %.6g s over the film: it must be above 0, and at most %.3g s for an "
                    "exposure of %.6g s",
                    question->kind == SHUTTER_FOCAL ? "a curtain" : "the reading", question->travel,
                    most, question->time);
    }
    return (question->distance >= 0 && isfinite(question->distance) && question->overrun >= 0) ||
           fail(error, ERROR_DOMAIN,
                "the curtains are %.6g mm before the film and run %.6g mm beyond it: neither is "
                "below 0",
                question->distance, question->overrun);
}

static bool check_leaf(const struct shutter_question *question, struct error *error)
{
    const double ramps = question->opening + question->closing;
    if (!(question->opening >= 0 && question->closing >= 0 && isfinite(ramps))) {
        return fail(error, ERROR_DOMAIN,
                    "the shutter opens in %.6g s and closes in %.6g s: neither is below 0",
                    question->opening, question->closing);
    }
    const double least = (1 - half_light) * ramps;
    return question->time >= least ||
           fail(error, ERROR_DOMAIN,
                "an exposure of %.6g s: a leaf shutter that opens in %.6g s and closes in %.6g s "
                "takes %.6g s at least, from half of its light to half of it",
                question->time, question->opening, question->closing, least);
}

bool shutter_open(const struct shutter_question *question, struct shutter *shutter,
                  struct error *error)
{
    /* film and picture stand upside down to each other: down in the picture is +y, right -x */
    static const double ways[][2] = {[SHUTTER_DOWN] = {0, 1},
                                     [SHUTTER_UP] = {0, -1},
                                     [SHUTTER_RIGHT] = {-1, 0},
                                     [SHUTTER_LEFT] = {1, 0}};
    const enum shutter_kind kind = question->kind;
    const bool runs = kind == SHUTTER_FOCAL || kind == SHUTTER_ROLLING;
    const double *way = ways[question->direction];
    if (!(question->time > 0 && isfinite(question->time))) {
        return fail(error, ERROR_DOMAIN, "an exposure of %.6g s: a shutter needs more than 0",
                    question->time);
    }
    if ((runs && !check_curtains(question, error)) ||
        (kind == SHUTTER_LEAF && !check_leaf(question, error))) {
        return false;
    }
    *shutter = (struct shutter){.kind = kind, .time = question->time, .run = INFINITY};
    if (kind == SHUTTER_LEAF) {
        shutter->opening = question->opening;
        shutter->closing = question->closing;
        shutter->stopped = question->stopped;
    }
    if (runs) {
        shutter->extent = way[0] == 0 ? question->height : question->width;
        shutter->per_mm = question->travel / shutter->extent;
        shutter->along[0] = way[0];
        shutter->along[1] = way[1];
    }
    if (kind == SHUTTER_FOCAL) {
        shutter->distance = question->distance;
        shutter->run = shutter->extent / 2 + question->overrun;
    }
    return true;
}

void shutter_interval(const struct shutter *shutter, const struct shutter_ray *ray,
                      double interval[2])
{
    double q = 0, later = 0, beyond = 0;
    if (shutter->kind == SHUTTER_LEAF) {
        /* what lies further out is stopped by the stop itself */
        beyond = fmin(ray->stop, 1) - half_light;
    } else if (shutter->kind != SHUTTER_GLOBAL) {
        for (int k = 0; k < 2; k++) {
            q += shutter->along[k] * (ray->film[k] + shutter->distance * ray->slope[k]);
        }
        later = q * shutter->per_mm;
    }
    const bool is_open = fabs(q) <= shutter->run;
    interval[0] = is_open ? later - shutter->time / 2 + shutter->opening * beyond : 0;
    interval[1] = is_open ? later + shutter->time / 2 - shutter->closing * beyond : 0;
}

void shutter_span(const struct shutter *shutter, double reach, double span[2])
{
    const double q =
        shutter->kind == SHUTTER_FOCAL ? fmin(reach, shutter->run) : shutter->extent / 2;
    span[0] = -q * shutter->per_mm - shutter->time / 2 - shutter->opening * half_light;
    span[1] = q * shutter->per_mm + shutter->time / 2 + shutter->closing * half_light;
}

struct shutter_times shutter_times(const struct shutter *shutter, double beam)
{
    const double ramps = shutter->opening + shutter->closing;
    struct shutter_times times = {shutter->time, shutter->time};
    if (shutter->kind == SHUTTER_LEAF) {
        times.effective += ramps * (half_light - 2 * shutter->stopped / 3);
        times.total += ramps * half_light;
    } else if (shutter->kind == SHUTTER_FOCAL) {
        times.total += beam * shutter->per_mm;
    }
    return times;
}
