/* commands/photo/fov_telecentric.c - answers of lenscalc fov without a focal length. */
/* SPDX-License-Identifier: MIT */
#include "commands/photo/fov_question.h"
#include "photo/telecentric.h"

#include <math.h>

/* The magnification that is given, or the one that has the wanted field on the sensor. */
static bool find_magnification(const struct fov_input *input, const struct sensor *sensor,
                               struct fov_row *row, struct error *error)
{
    const struct fov_problem problem = {.setting = {RECTILINEAR, NAN, NAN, 1, input->squeeze},
                                        .sensor = *sensor,
                                        .goals = fov_input_goals(input)};
    const bool has_field = fov_goals_fields(&problem.goals) > 0;
    const char *by = NULL;
    if (input->telecentric && has_field == !isnan(input->magnification)) {
        return fail(error, ERROR_USAGE,
                    "{--telecentric} needs one of {--magnification} and a field or {--density}");
    }
    row->magnification = input->magnification;
    if (has_field) {
        row->solved_for = "magnification";
        return fov_goal_magnification(&problem, &row->magnification, &by, error);
    }
    return row->magnification > 0 ||
           fail(error, ERROR_DOMAIN, "{--magnification} of a telecentric lens must be above 0");
}

static bool find_depth(const struct fov_input *input, struct fov_row *row, struct error *error)
{
    const double fnumber =
        isnan(input->na) ? input->fnumber : telecentric_fnumber(row->magnification, input->na);
    row->fnumber = fnumber;
    row->blur = input->blur;
    if (isnan(fnumber)) {
        return true;
    }
    if (isnan(row->pitch)) {
        return fail(error, ERROR_USAGE,
                    "the depth of field needs pixels: give {--pitch}, {--pixels}, or a camera as "
                    "{--sensor}");
    }
    return telecentric_depth(row->magnification, fnumber, input->blur * row->pitch, &row->depth,
                             error);
}

bool fov_telecentric(const struct fov_input *input, struct run *run, struct error *error)
{
    const struct pixels_question pixels = {input->pixels, input->pitch, input->line_scan};
    struct sensor_value sensor = input->sensor;
    struct fov_row row = fov_row_none;
    if (!pixels_settle(&pixels, &sensor, run->arena, run->doubts, error) ||
        !find_magnification(input, &sensor.size, &row, error)) {
        return false;
    }
    row.sensor = sensor.name;
    row.width = sensor.size.width;
    row.height = sensor.size.height;
    row.pitch = sensor.size.pitch;
    row.crop = sensor_crop(&sensor.size);
    row.setting.squeeze = input->squeeze;
    row.projection = input->telecentric ? "telecentric" : NULL;
    row.fov.width_at_s = input->squeeze * row.width / row.magnification;
    row.fov.height_at_s = row.height / row.magnification;
    row.fov.diagonal_at_s = hypot(row.fov.width_at_s, row.fov.height_at_s);
    if (!find_depth(input, &row, error) || !fov_fill_pixels(input, &row, error)) {
        return false;
    }
    run_emit(run, &row);
    return true;
}
