/* photo/distance_from.c - distances from the sensor, the pupil or the principal plane. */
/* SPDX-License-Identifier: MIT */
#include "photo/distance_from.h"

#include <math.h>

const struct word distances_from[DISTANCES_FROM + 1] = {
    [FROM_PRINCIPAL] = {"principal", "the front principal plane, as in the formulas"},
    [FROM_SENSOR] = {"sensor", "the sensor, as on the distance scales of lenses"},
    [FROM_ENTRANCE] = {"entrance", "the entrance pupil, the centre of perspective"},
    [FROM_FRONT] = {"front", "the first vertex of the lens; real lenses only"},
};

double distance_image(double f, double s)
{
    return f + f * (f / (s - f));
}

double distance_offset(const struct dof_setting *a, const struct distance_reference *measuring)
{
    switch (measuring->from) {
    case FROM_SENSOR:
        return distance_image(a->f, a->s) + measuring->hiatus;
    case FROM_ENTRANCE:
        return -a->f * (1 - 1 / a->P);
    case FROM_FRONT:
        return -measuring->front;
    default:
        return 0;
    }
}

static bool needs_front(const struct distance_reference *measuring, struct error *error)
{
    return measuring->from != FROM_FRONT || !isnan(measuring->front) ||
           fail(error, ERROR_USAGE,
                "{distance origin} front needs {lens}: a thin lens has no front");
}

static bool from_sensor(double f, double distance, double hiatus, double *s, struct error *error)
{
    double D = distance - hiatus;
    if (!(D >= 4 * f) && hiatus == 0) {
        return fail(error, ERROR_DOMAIN,
                    "{distance} %.6g mm from the sensor is less than 4 times {the focal length} "
                    "%.6g mm: no real image (%.6g mm or more)",
                    distance, f, 4 * f);
    }
    if (!(D >= 4 * f)) {
        return fail(error, ERROR_DOMAIN,
                    "{distance} %.6g mm from the sensor is less than 4 times {the focal length} "
                    "%.6g mm and what lies between the principal planes: no real image (%.6g mm "
                    "or more)",
                    distance, f, 4 * f + hiatus);
    }
    *s = (D + sqrt(D) * sqrt(D - 4 * f)) / 2;
    return true;
}

bool distance_to_principal(double f, double P, double distance,
                           const struct distance_reference *measuring, double *s,
                           struct error *error)
{
    if (measuring->from == FROM_SENSOR && !isinf(distance)) {
        return from_sensor(f, distance, measuring->hiatus, s, error);
    }
    *s = distance;
    if (measuring->from == FROM_ENTRANCE) {
        *s = distance + f * (1 - 1 / P);
    } else if (measuring->from == FROM_FRONT) {
        *s = distance + measuring->front;
    }
    return needs_front(measuring, error);
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

bool distance_solve(struct dof_setting *setting, const struct dof_targets *targets,
                    const struct distance_reference *measuring, struct error *error)
{
    enum distance_from from = measuring->from;
    bool measured = from != FROM_PRINCIPAL;
    /* none is negative, so that no two infinities make a NaN */
    bool is_complete = !isnan(setting->f + setting->N + setting->c + setting->s);
    bool has_goals = !(isnan(targets->near) && isnan(targets->far) && isnan(targets->total) &&
                       isnan(targets->hyperfocal) && isnan(targets->magnification));
    if (!measured && is_complete && !has_goals) {
        return true; /* nothing to solve, as in most batches */
    }
    bool has_s = !isnan(setting->s), has_f = !isnan(setting->f);
    bool has_limits = !isnan(targets->near) || !isnan(targets->far);
    if (!needs_front(measuring, error)) {
        return false;
    }
    if (!measured || (!has_s && !has_limits)) {
        return dof_solve(setting, targets, error);
    }
    if (!has_f) {
        return fail(error, ERROR_USAGE,
                    "with {distance origin} %s a distance needs {focal length}: give it, or "
                    "measure from the principal plane",
                    distances_from[from].word);
    }
    struct dof_setting answer = *setting;
    if (has_s) {
        if (!distance_to_principal(setting->f, setting->P, setting->s, measuring, &answer.s,
                                   error)) {
            return false;
        }
        *setting = answer;
        return solve_with_offset(setting, targets, distance_offset(setting, measuring), error);
    }
    /* Limits are known, the distance is not: where it is measured from moves with it. */
    enum { MOST_TURNS = 200 };
    answer.s = INFINITY; /* the subject far away, to begin with */
    double offset = distance_offset(&answer, measuring);
    for (int turn = 0; turn < MOST_TURNS; turn++) {
        answer = *setting;
        if (!solve_with_offset(&answer, targets, offset, error)) {
            return false;
        }
        double next = distance_offset(&answer, measuring);
        if (fabs(next - offset) <= 4e-16 * fabs(next) || measuring->from != FROM_SENSOR) {
            *setting = answer;
            return true;
        }
        offset = next;
    }
    return fail(error, ERROR_DOMAIN, "no distance from the %s gives these limits",
                distances_from[measuring->from].word);
}
