/* photo/timelapse.c - plan of a time-lapse or of star trails: shots, interval, clip, storage. */
/* SPDX-License-Identifier: MIT */
#include "photo/timelapse.h"

#include "base/constants.h"
#include "photo/given.h"
#include "photo/stars.h"

#include <math.h>

/* Quotients that near to a whole number count as it: 33.3 s at 30 fps are 999 frames. */
static const double rounding = 1e-12;

static double whole_below(double x)
{
    return floor(x + rounding * fmax(1, x));
}

static double whole_above(double x)
{
    return ceil(x - rounding * fmax(1, x));
}

static bool timelapse_check_ranges(const struct timelapse_given *g, struct error *error)
{
    const struct given positive[] = {{"number of shots", "", g->shots},
                                     {"interval", " s", g->interval},
                                     {"event length", " s", g->event},
                                     {"clip length", " s", g->clip},
                                     {"frame rate", " fps", g->rate},
                                     {"exposure time", " s", g->time},
                                     {"star angle", " rad", g->star_angle},
                                     {"frame size", " B", g->frame},
                                     {"card", " B", g->card}};
    if (!given_positive(positive, sizeof positive / sizeof *positive, error)) {
        return false;
    }
    if (is_given(g->shots) && !(g->shots <= TIMELAPSE_SHOTS && g->shots == floor(g->shots))) {
        return fail(error, ERROR_DOMAIN, "{number of shots} %.10g must be a whole number, 1 to %g",
                    g->shots, TIMELAPSE_SHOTS);
    }
    if (is_given(g->star_angle) && !(g->star_angle <= 2 * PI * (1 + 1e-12))) {
        return fail(error, ERROR_DOMAIN, "{star angle} %.10g deg lies outside 0 to 360 deg",
                    degrees_from_radians(g->star_angle));
    }
    return !is_given(g->time) || check_not_negative("gap", " s", g->gap, error);
}

static bool has_length(const struct timelapse_given *g)
{
    return is_given(g->event) || is_given(g->star_angle);
}

/* From the beginning of the first exposure to that of the last. */
static double wanted_walk(const struct timelapse_given *g)
{
    return fmax(0, g->star_angle / STELLAR_RATE - g->time);
}

/* How many shots of this interval the event takes, not rounded. */
static double intervals(const struct timelapse_given *g, double interval)
{
    return is_given(g->event) ? g->event / interval : wanted_walk(g) / interval + 1;
}

static double shots_of_length(const struct timelapse_given *g, double interval)
{
    double exact = intervals(g, interval);
    return is_given(g->event) ? whole_below(exact) : whole_above(exact);
}

/* The number of shots, and rate and interval as far as they are found with it. */
static double find_shots(const struct timelapse_given *g, struct timelapse *plan)
{
    double shots = g->shots;
    if (!is_given(shots) && has_length(g) && is_given(g->interval)) {
        shots = shots_of_length(g, g->interval);
    }
    bool rate_follows = !is_given(g->rate) && is_given(g->clip) && is_given(shots);
    plan->rate_assumed = !is_given(g->rate) && !rate_follows;
    if (rate_follows) {
        plan->rate = shots / g->clip;
    } else if (plan->rate_assumed) {
        plan->rate = TIMELAPSE_RATE;
    } else {
        plan->rate = g->rate;
    }
    if (!is_given(shots) && is_given(g->clip)) {
        shots = whole_above(g->clip * plan->rate);
    }
    if (!is_given(shots) && has_length(g) && is_given(g->time)) {
        plan->interval = g->time + g->gap;
        shots = shots_of_length(g, plan->interval);
    }
    return is_given(shots) ? shots : whole_below(g->card / g->frame);
}

static void find_interval(const struct timelapse_given *g, double shots, struct timelapse *plan)
{
    if (is_given(plan->interval)) {
        return;
    }
    bool by_length = has_length(g) && (is_given(g->event) || shots > 1);
    if (!by_length) {
        plan->interval = g->time + g->gap;
    } else if (is_given(g->event)) {
        plan->interval = g->event / shots;
    } else {
        plan->interval = wanted_walk(g) / (shots - 1);
    }
}

/* What was given beyond need must say the same. */
static bool check_agreement(const struct timelapse_given *g, const struct timelapse *plan,
                            struct error *error)
{
    double shots = (double)plan->shots;
    const double slack = 1 + 1e-6;
    if (has_length(g) && !(fabs(intervals(g, plan->interval) - shots) < slack)) {
        return fail(error, ERROR_DOMAIN,
                    "%.10g shots at {interval} %.10g s take %.10g s: that is not {%s}", shots,
                    plan->interval, shots * plan->interval,
                    is_given(g->event) ? "the event length" : "the star angle");
    }
    if (is_given(g->clip) && !(fabs(g->clip * plan->rate - shots) < slack)) {
        return fail(error, ERROR_DOMAIN,
                    "%.10g shots at {frame rate} %.10g fps make a clip of %.10g s: that is not "
                    "{clip length} %.10g s",
                    shots, plan->rate, shots / plan->rate, g->clip);
    }
    double needed = g->time + g->gap;
    return !(needed > plan->interval * (1 + 1e-12)) ||
           fail(error, ERROR_DOMAIN,
                "{exposure time} %.10g s and {gap} %.10g s do not fit into {the interval} %.10g s: "
                "it must be at least %.10g s",
                g->time, g->gap, plan->interval, needed);
}

static void timelapse_complete(const struct timelapse_given *g, struct timelapse *plan)
{
    const double shots = (double)plan->shots, span = (shots - 1) * plan->interval + g->time;
    const double card_shots = whole_below(g->card / g->frame);
    *plan = (struct timelapse){
        .shots = plan->shots,
        .interval = plan->interval,
        .event = shots * plan->interval,
        .clip = shots / plan->rate,
        .rate = plan->rate,
        .rate_assumed = plan->rate_assumed,
        .speed_up = plan->interval * plan->rate,
        .pause = is_given(g->time) ? fmax(plan->interval - g->time, 0) : (double)NAN,
        .shutter_angle = 2 * PI * (g->time / plan->interval),
        .span = span,
        .star_angle = STELLAR_RATE * span,
        .space = shots * g->frame,
        .card_shots = card_shots,
        .cards = ceil(shots / card_shots),
        .card_time = card_shots * plan->interval,
    };
}

bool timelapse_solve(const struct timelapse_given *given, struct timelapse *plan,
                     struct error *error)
{
    *plan = (struct timelapse){.interval = given->interval};
    if (!timelapse_check_ranges(given, error)) {
        return false;
    }
    if (is_given(given->event) && is_given(given->star_angle)) {
        return fail(error, ERROR_USAGE, "give only one of {event length} and {star angle}");
    }
    if (is_given(given->star_angle) && !is_given(given->time)) {
        return fail(error, ERROR_USAGE, "{star angle} needs {exposure time}");
    }
    if (is_given(given->card) && !is_given(given->frame)) {
        return fail(error, ERROR_USAGE, "{card} needs {frame size}");
    }
    if (is_given(given->card) && !(given->card >= given->frame)) {
        return fail(error, ERROR_DOMAIN, "{frame size} %.10g B is larger than {the card}, %.10g B",
                    given->frame, given->card);
    }
    double shots = find_shots(given, plan);
    if (!is_given(shots)) {
        return fail(error, ERROR_USAGE,
                    "give {number of shots}, {clip length}, or {event length} with {interval} or "
                    "{exposure time}");
    }
    if (shots < 1) {
        return fail(error, ERROR_DOMAIN, "{interval} %.10g s is longer than {the event length}",
                    is_given(given->interval) ? given->interval : given->time + given->gap);
    }
    if (!(shots <= TIMELAPSE_SHOTS)) {
        return fail(error, ERROR_DOMAIN, "%.10g shots are out of range: 1 to %g", shots,
                    TIMELAPSE_SHOTS);
    }
    plan->shots = (long)shots;
    find_interval(given, shots, plan);
    if (!check_agreement(given, plan, error)) {
        return false;
    }
    timelapse_complete(given, plan);
    return true;
}
