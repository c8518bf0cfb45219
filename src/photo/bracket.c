/* photo/bracket.c - plan of an exposure bracket by time. */
/* SPDX-License-Identifier: MIT */
#include "photo/bracket.h"

#include <math.h>

#include "photo/given.h"

static bool bracket_check_shots(double shots, struct error *error)
{
    if (!(shots >= 1 && shots <= BRACKET_SHOTS)) {
        return fail(error, ERROR_DOMAIN, "%.10g shots lie outside 1 to %d", shots, BRACKET_SHOTS);
    }
    if (shots < round(shots) || shots > round(shots)) {
        return fail(error, ERROR_DOMAIN, "{number of shots} %.10g must be a whole number", shots);
    }
    return true;
}

/* Complete the plan from its longest time, step and number of shots. */
static bool bracket_lay_out(struct bracket *plan, struct error *error)
{
    plan->span = (plan->shots - 1) * plan->step;
    plan->shortest = bracket_time(plan, plan->shots - 1);
    /* expm1 keeps the ratio for small steps; its limit for step 0 is the number of shots */
    double ln2 = 0.69314718055994530942;
    plan->total = plan->longest * (plan->step > 0 ? expm1(-plan->shots * plan->step * ln2) /
                                                        expm1(-plan->step * ln2)
                                                  : plan->shots);
    return answer_positive("the longest time", plan->longest, error) &&
           answer_positive("the shortest time", plan->shortest, error) &&
           answer_positive("the total time", plan->total, error);
}

bool bracket_plan(const struct bracket_given *given, struct bracket *plan, struct error *error)
{
    const struct given numbers[] = {{"time at one end", " s", given->from},
                                    {"time at the other end", " s", given->to},
                                    {"step", " stops", given->step},
                                    {"number of shots", "", given->shots}};
    if (!is_given(given->from) && !is_given(given->to)) {
        return fail(error, ERROR_USAGE,
                    "a bracket needs an exposure to start from: give {time at one end} or {time at "
                    "the other end}");
    }
    if (given_missing(numbers, 4) == 0) {
        return fail(error, ERROR_USAGE,
                    "{time at one end}, {time at the other end}, {step} and {number of shots} are "
                    "all given: leave out one, it follows from the others");
    }
    if (given_missing(numbers, 4) != 1) {
        return fail(error, ERROR_USAGE,
                    "give exactly three of {time at one end}, {time at the other end}, {step} and "
                    "{number of shots}");
    }
    if (!given_positive(numbers, 4, error) ||
        (is_given(given->shots) && !bracket_check_shots(given->shots, error))) {
        return false;
    }
    if (is_given(given->from) && is_given(given->to)) {
        /* Both ends are known: count the shots, or divide the span among them. */
        double span = fabs(log2(given->from / given->to));
        plan->longest = fmax(given->from, given->to);
        plan->residual = 0;
        if (is_given(given->step)) {
            double shots = round(span / given->step) + 1;
            if (!bracket_check_shots(shots, error)) {
                return false;
            }
            plan->shots = (int)shots;
            plan->step = given->step;
            plan->residual = span - (shots - 1) * given->step;
        } else {
            plan->shots = (int)given->shots;
            if (plan->shots == 1 && span > 0) {
                return fail(error, ERROR_DOMAIN, "one shot cannot reach from %.10g s to %.10g s",
                            given->from, given->to);
            }
            plan->step = plan->shots > 1 ? span / (plan->shots - 1) : 0;
        }
        return bracket_lay_out(plan, error);
    }
    const int shots = (int)given->shots;
    *plan = (struct bracket){.shots = shots,
                             .step = given->step,
                             .longest = is_given(given->from)
                                            ? given->from
                                            : given->to * exp2((shots - 1) * given->step)};
    return bracket_lay_out(plan, error);
}

bool bracket_around(double metered, double step, double shots, struct bracket *plan,
                    struct error *error)
{
    if (!require_positive("exposure time", " s", metered, error) ||
        !require_positive("step", " stops", step, error) || !bracket_check_shots(shots, error)) {
        return false;
    }
    *plan = (struct bracket){
        .shots = (int)shots, .step = step, .longest = metered * exp2((shots - 1) * step / 2)};
    return bracket_lay_out(plan, error);
}

double bracket_time(const struct bracket *plan, int i)
{
    return plan->longest * exp2(-i * plan->step);
}

double bracket_offset(const struct bracket *plan, int i, double base)
{
    return log2(plan->longest / base) - i * plan->step;
}

bool bracket_covers(const struct bracket *plan, double single, struct bracket_range *range,
                    struct error *error)
{
    range->covered = single + plan->span;
    range->overlap = single - plan->step;
    return require_positive("range of a shot", " stops", single, error);
}

bool bracket_shots_needed(double scene, double single, double step, int *shots, struct error *error)
{
    if (!require_positive("scene range", " stops", scene, error) ||
        !require_positive("range of a shot", " stops", single, error) ||
        !require_positive("step", " stops", step, error)) {
        return false;
    }
    if (!(step <= single)) {
        return fail(error, ERROR_DOMAIN,
                    "{step} %.10g stops leaves gaps between shots of %.10g stops each", step,
                    single);
    }
    /* 1e-9: 12 stops in steps of 0.1 need no extra shot for a rounding */
    double needed = fmax(0, ceil((scene - single) / step - 1e-9)) + 1;
    if (!bracket_check_shots(needed, error)) {
        return false;
    }
    *shots = (int)needed;
    return true;
}
