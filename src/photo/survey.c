/* photo/survey.c - pictures of a survey from the air: overlaps, intervals, motion blur. */
/* SPDX-License-Identifier: MIT */
#include "photo/survey.h"

#include "photo/given.h"

static bool survey_check(const struct survey_flight *a, struct error *error)
{
    const struct given numbers[] = {
        {"ground width", " mm", a->along},   {"ground height", " mm", a->across},
        {"ground sample", " mm", a->sample}, {"speed", " mm/s", a->speed},
        {"interval", " s", a->interval},     {"blur", " pixels", a->blur},
        {"exposure time", " s", a->time},
    };
    if (is_given(a->speed) && is_given(a->interval)) {
        return fail(error, ERROR_USAGE,
                    "give one of {speed} and {interval}: {overlap} gives the "
                    "other");
    }
    if (is_given(a->interval) && !is_given(a->overlap)) {
        return fail(error, ERROR_USAGE, "{interval} needs {overlap}");
    }
    return (!is_given(a->overlap) || require_within("overlap", "", a->overlap, 0, 0.999, error)) &&
           (!is_given(a->sidelap) || require_within("sidelap", "", a->sidelap, 0, 0.999, error)) &&
           given_positive(numbers, sizeof numbers / sizeof numbers[0], error);
}

bool survey_solve(const struct survey_flight *flight, struct survey_plan *plan, struct error *error)
{
    if (!survey_check(flight, error)) {
        return false;
    }
    plan->base = flight->along * (1 - flight->overlap);
    plan->spacing = flight->across * (1 - flight->sidelap);
    const bool is_open = !is_given(flight->speed) && !is_given(flight->interval);
    plan->speed = is_given(flight->speed) ? flight->speed : plan->base / flight->interval;
    if (is_open) {
        plan->speed = flight->blur * flight->sample / flight->time;
    }
    plan->interval = is_given(flight->interval) ? flight->interval : plan->base / plan->speed;
    plan->longest = flight->blur * flight->sample / plan->speed;
    plan->moved = plan->speed * flight->time / flight->sample;
    return true;
}
