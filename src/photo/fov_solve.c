/* photo/fov_solve.c - focal length, distance or sensor from what the picture shall show. */
/* SPDX-License-Identifier: MIT */
#include "photo/fov_solve.h"

#include "photo/given.h"

#include <math.h>

/* One wanted angle or field, and the length on the sensor that it is seen on. */
struct goal {
    const char *name;
    double wanted, dimension;
};

enum { ANGLE_GOALS = 3, FIELD_GOALS = 4 };

static void angle_goals(const struct fov_problem *a, struct goal goals[ANGLE_GOALS])
{
    struct sensor wide = a->sensor;
    wide.width *= a->setting.squeeze;
    goals[0] = (struct goal){"horizontal angle", a->goals.horizontal, wide.width};
    goals[1] = (struct goal){"vertical angle", a->goals.vertical, wide.height};
    goals[2] = (struct goal){"diagonal angle", a->goals.diagonal, sensor_diagonal(&wide)};
}

static void field_goals(const struct fov_problem *a, struct goal goals[FIELD_GOALS])
{
    struct sensor wide = a->sensor;
    wide.width *= a->setting.squeeze;
    goals[0] = (struct goal){"field width", a->goals.field_width, wide.width};
    goals[1] = (struct goal){"field height", a->goals.field_height, wide.height};
    goals[2] = (struct goal){"field diagonal", a->goals.field_diagonal, sensor_diagonal(&wide)};
    goals[3] = (struct goal){"pixel density", a->goals.pixel, a->sensor.pitch * a->setting.squeeze};
}

static int count_wanted(const struct goal *goals, int count)
{
    int wanted = 0;
    for (int i = 0; i < count; i++) {
        wanted += is_given(goals[i].wanted);
    }
    return wanted;
}

bool fov_goal_magnification(const struct fov_problem *problem, double *m, const char **by,
                            struct error *error)
{
    struct goal goals[FIELD_GOALS];
    if (!sensor_check(&problem->sensor, error) ||
        !check_positive("squeeze", "", problem->setting.squeeze, error)) {
        return false;
    }
    field_goals(problem, goals);
    *m = INFINITY;
    for (int i = 0; i < FIELD_GOALS; i++) {
        const struct goal *goal = &goals[i];
        if (!is_given(goal->wanted)) {
            continue;
        }
        if (!is_given(goal->dimension)) {
            return fail(error, ERROR_USAGE, "a pixel density needs {pixel pitch} or {pixels}");
        }
        if (!check_positive(goal->name, " mm", goal->wanted, error)) {
            return false;
        }
        if (goal->dimension / goal->wanted < *m) {
            *m = goal->dimension / goal->wanted;
            *by = goal->name;
        }
    }
    return answer_positive("the magnification", *m, error);
}

/* The sensor on which a lens at its magnification has the wanted fields. */
static bool solve_sensor(struct fov_problem *a, struct error *error)
{
    const struct fov_setting *lens = &a->setting;
    const struct fov_goals *goals = &a->goals;
    struct sensor *sensor = &a->sensor;
    if (!(lens->s > lens->f)) {
        return fail(error, ERROR_DOMAIN,
                    "{distance} %.15g mm lies within {the focal length} %.15g mm: no real image",
                    lens->s, lens->f);
    }
    const double m = lens->f / (lens->s - lens->f);
    struct sensor wide = *sensor;
    wide.width *= lens->squeeze;
    double larger = 0; /* than the sensor was, where not both sides are wanted */
    if (is_given(goals->field_width) && is_given(goals->field_height)) {
        sensor->width = m * goals->field_width / lens->squeeze;
        sensor->height = m * goals->field_height;
        larger = 1;
        wide = *sensor;
        wide.width *= lens->squeeze;
    } else if (is_given(goals->field_width)) {
        larger = m * goals->field_width / wide.width;
    } else if (is_given(goals->field_height)) {
        larger = m * goals->field_height / wide.height;
    }
    if (is_given(goals->field_diagonal)) {
        larger = fmax(larger, m * goals->field_diagonal / sensor_diagonal(&wide));
    }
    sensor->width *= larger;
    sensor->height *= larger;
    sensor->pitch = NAN;
    a->unknown = FOV_SENSOR;
    return sensor_check(sensor, error);
}

static bool solve_fields(struct fov_problem *a, struct error *error)
{
    struct fov_setting *lens = &a->setting;
    const bool has_f = is_given(lens->f), has_s = lens->s < INFINITY;
    double m = 0;
    if (lens->projection != RECTILINEAR) {
        return fail(error, ERROR_DOMAIN, "a wanted field needs a rectilinear lens");
    }
    if (!has_f && !has_s) {
        return fail(error, ERROR_USAGE,
                    "a wanted field needs {focal length} or a finite {distance}");
    }
    if (has_f && has_s && (!a->sensor_is_open || is_given(a->goals.pixel))) {
        return fail(error, ERROR_USAGE,
                    "field, {focal length}, {distance} and {sensor}: three of them give the "
                    "fourth, leave one out");
    }
    if (!check_positive("squeeze", "", lens->squeeze, error)) {
        return false;
    }
    if (has_f && has_s) {
        return solve_sensor(a, error);
    }
    if (!fov_goal_magnification(a, &m, &a->by, error)) {
        return false;
    }
    if (has_f) {
        a->unknown = FOV_DISTANCE;
        lens->s = lens->f * (1 + 1 / m);
        return check_positive("focal length", " mm", lens->f, error) &&
               answer_positive("the distance", lens->s, error);
    }
    a->unknown = FOV_FOCAL_LENGTH;
    lens->f = lens->s * (m / (1 + m));
    return check_positive("distance", " mm", lens->s, error);
}

static bool solve_angle(struct fov_problem *a, const struct goal *goals, struct error *error)
{
    int i = 0;
    while (!is_given(goals[i].wanted)) {
        i++;
    }
    a->unknown = FOV_FOCAL_LENGTH;
    a->by = goals[i].name;
    return fov_focal_length(&a->setting, goals[i].dimension, goals[i].wanted, &a->setting.f, error);
}

bool fov_solve(struct fov_problem *problem, struct error *error)
{
    struct goal angles[ANGLE_GOALS], fields[FIELD_GOALS];
    problem->unknown = FOV_GIVEN;
    problem->by = NULL;
    if (!sensor_check(&problem->sensor, error) ||
        !check_positive("squeeze", "", problem->setting.squeeze, error)) {
        return false;
    }
    angle_goals(problem, angles);
    field_goals(problem, fields);
    const int angle_count = count_wanted(angles, ANGLE_GOALS);
    const bool has_fields = count_wanted(fields, FIELD_GOALS) > 0;
    if (angle_count == 0 && has_fields) {
        return solve_fields(problem, error);
    }
    if (angle_count + has_fields + is_given(problem->setting.f) != 1) {
        return fail(error, ERROR_USAGE,
                    "give exactly one of {focal length}, {horizontal angle of view}, {vertical "
                    "angle of view}, {diagonal angle of view}, or a field ({width of the field}, "
                    "{height of the field}, {diagonal of the field}) with {distance} or {focal "
                    "length}");
    }
    return angle_count == 0 || solve_angle(problem, angles, error);
}

bool fov_focal_length_from_sensor(double m, double distance, double *f, double *s,
                                  struct error *error)
{
    *f = distance * (m / (1 + m) / (1 + m));
    *s = distance / (1 + m);
    return check_positive("magnification", "", m, error) &&
           check_positive("distance", " mm", distance, error);
}
