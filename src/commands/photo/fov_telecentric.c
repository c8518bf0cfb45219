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
    if (has_field == !isnan(input->magnification)) {
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
    row.projection = "telecentric";
    row.fov.width_at_s = input->squeeze * row.width / row.magnification;
    row.fov.height_at_s = row.height / row.magnification;
    row.fov.diagonal_at_s = hypot(row.fov.width_at_s, row.fov.height_at_s);
    if (!find_depth(input, &row, error) || !fov_fill_pixels(input, &row, error)) {
        return false;
    }
    run_emit(run, &row);
    return true;
}

bool fov_is_bare_line(const struct fov_input *input)
{
    const struct fov_goals goals = fov_input_goals(input);
    const double others[] = {
        input->lens.focal.length, input->lens.pupil, input->magnification, input->horizontal,
        input->vertical,          input->diagonal,   input->altitude,      input->gsd,
        input->converter,         input->crop,       input->sky.angle,     input->sky.scale};
    bool is_bare = input->line_scan && photo_lens_is_thin(&input->lens) && isinf(input->distance) &&
                   input->projection == VIEW_AUTO && input->sky.subject == 0 &&
                   input->sensor.is_fallback && fov_goals_fields(&goals) == 1 &&
                   !isnan(goals.field_width) && !isnan(input->pixels.wide);
    for (size_t i = 0; i < sizeof others / sizeof others[0] && is_bare; i++) {
        is_bare = isnan(others[i]);
    }
    return is_bare;
}

bool fov_bare_line(const struct fov_input *input, struct run *run, struct error *error)
{
    const bool has_pitch = !isnan(input->pitch);
    struct fov_row row = fov_row_none;
    row.setting.squeeze = input->squeeze;
    row.fov.width_at_s = fov_input_goals(input).field_width;
    /* the density is that of any pitch */
    row.pitch = has_pitch ? input->pitch : 1;
    row.magnification = input->squeeze * input->pixels.wide * row.pitch / row.fov.width_at_s;
    row.sensor = arena_printf(run->arena, "a line of %.15g pixels", input->pixels.wide);
    if (!fov_fill_pixels(input, &row, error)) {
        return false;
    }
    if (!has_pitch) {
        row.pitch = row.magnification = NAN;
    }
    run_emit(run, &row);
    return true;
}
