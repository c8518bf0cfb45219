/* photo/distance_from.c - distances from the sensor, the pupil or the principal plane. */
/* SPDX-License-Identifier: MIT */
#include "photo/distance_from.h"

#include <math.h>

const struct word distances_from[DISTANCES_FROM + 1] = {
    [FROM_PRINCIPAL] = {"principal", "the front principal plane, as the formulas have it"},
    [FROM_SENSOR] = {"sensor", "the sensor, as distance scales on lenses have it"},
    [FROM_ENTRANCE] = {"entrance", "the entrance pupil, the centre of perspective"},
};

double distance_offset(const struct dof_setting *a, enum distance_from from)
{
    if (from == FROM_SENSOR) {
        return isinf(a->s) ? a->f : a->f / (1 - a->f / a->s);
    }
    return from == FROM_ENTRANCE ? -a->f * (1 - 1 / a->P) : 0;
}

bool distance_to_principal(double f, double P, double distance, enum distance_from from, double *s,
                           struct error *error)
{
    *s = distance;
    if (from == FROM_ENTRANCE) {
        *s = distance + f * (1 - 1 / P);
    } else if (from == FROM_SENSOR && !isinf(distance)) {
        if (!(distance >= 4 * f)) {
            return fail(error, ERROR_DOMAIN,
                        "distance %.15g mm from the sensor is less than 4 x focal length = %.15g "
                        "mm: no real image",
                        distance, 4 * f);
        }
        *s = (distance + sqrt(distance) * sqrt(distance - 4 * f)) / 2;
    }
    return true;
}

/* One turn: the targets moved by the offset of the last answer. */
static bool solve_with_offset(struct dof_setting *setting, const struct dof_targets *targets,
                              double offset, struct error *error)
{
    struct dof_targets moved = *targets;
    moved.near -= offset;
    moved.far -= offset;
    return dof_solve(setting, &moved, error);
}

static bool has_goals(const struct dof_targets *a)
{
    return !(isnan(a->near) && isnan(a->far) && isnan(a->total) && isnan(a->hyperfocal) &&
             isnan(a->magnification));
}

static bool is_complete(const struct dof_setting *a)
{
    return !isnan(a->f) && !isnan(a->N) && !isnan(a->c) && !isnan(a->s);
}

bool distance_solve(struct dof_setting *setting, const struct dof_targets *targets,
                    enum distance_from from, struct error *error)
{
    enum { MOST_TURNS = 200 };
    bool measured = from != FROM_PRINCIPAL;
    if (!measured && is_complete(setting) && !has_goals(targets)) {
        return true; /* nothing to solve, as in most batches */
    }
    bool has_s = !isnan(setting->s), has_f = !isnan(setting->f);
    bool has_limits = !isnan(targets->near) || !isnan(targets->far);
    if (!measured || (!has_s && !has_limits)) {
        return dof_solve(setting, targets, error);
    }
    if (!has_f) {
        return fail(error, ERROR_USAGE,
                    "with --from %s a distance needs --focal-length: give it, or measure from the "
                    "principal plane",
                    distances_from[from].word);
    }
    struct dof_setting answer = *setting;
    if (has_s) {
        if (!distance_to_principal(setting->f, setting->P, setting->s, from, &answer.s, error)) {
            return false;
        }
        *setting = answer;
        return solve_with_offset(setting, targets, distance_offset(setting, from), error);
    }
    double offset = from == FROM_SENSOR ? setting->f : distance_offset(setting, from);
    for (int turn = 0; turn < MOST_TURNS; turn++) {
        answer = *setting;
        if (!solve_with_offset(&answer, targets, offset, error)) {
            return false;
        }
        double next = distance_offset(&answer, from);
        if (fabs(next - offset) <= 4e-16 * next || from == FROM_ENTRANCE) {
            *setting = answer;
            return true;
        }
        offset = next;
    }
    return fail(error, ERROR_DOMAIN, "no distance from the %s gives these limits",
                distances_from[from].word);
}
