/* commands/photo/fov_bare.c - answers of lenscalc fov that no lens, or no sensor, has a part in. */
/* SPDX-License-Identifier: MIT */
#include "commands/photo/fov_question.h"
#include "photo/pixel_density.h"

#include "base/constants.h"

#include <math.h>

/* Is nothing said of the lens, what is far away, or seen from the air? */
static bool fov_has_no_lens(const struct fov_input *input)
{
    const double others[] = {input->lens.focal.length,
                             input->lens.pupil,
                             input->magnification,
                             input->altitude,
                             input->gsd,
                             input->converter,
                             input->crop,
                             input->sky.scale,
                             input->fx};
    bool is_bare = photo_lens_is_thin(&input->lens) && input->projection == VIEW_AUTO &&
                   isnan(input->sensor.focal) && !input->telecentric && input->gap == NULL;
    for (size_t i = 0; i < sizeof others / sizeof others[0] && is_bare; i++) {
        is_bare = isnan(others[i]);
    }
    return is_bare;
}

static bool fov_has_angle(const struct fov_input *input)
{
    return !isnan(input->horizontal) || !isnan(input->vertical) || !isnan(input->diagonal);
}

static bool fov_has_subject(const struct fov_input *input)
{
    return !isnan(input->sky.size) || !isnan(input->sky.angle) || input->sky.subject > 0;
}

/* -------- a subject alone -------- */

static bool fov_is_bare_subject(const struct fov_input *input)
{
    const struct fov_goals goals = fov_input_goals(input);
    const bool has_angle = input->sky.subject > 0 || !isnan(input->sky.angle);
    return fov_has_no_lens(input) && !fov_has_angle(input) && !isnan(input->sky.size) &&
           (has_angle || isfinite(input->distance)) && fov_goals_fields(&goals) == 0 &&
           !input->dori && input->task == 0;
}

static bool fov_bare_subject(const struct fov_input *input, struct run *run, struct error *error)
{
    struct fov_row row = fov_row_none;
    if (!sky_fill_subject(&input->sky, input->distance, &row.sky, error)) {
        return false;
    }
    row.setting.s = input->distance;
    row.density = row.object_pixel = row.speed = row.line_rate = NAN;
    run_emit(run, &row);
    return true;
}

/* -------- pixels over a field -------- */

/* So many pixels over a field, or at a density, of a sensor of which nothing else is known? */
static bool fov_is_bare_pixels(const struct fov_input *input)
{
    const struct fov_goals goals = fov_input_goals(input);
    const struct pixels_value *pixels = &input->pixels;
    const bool has_task = input->task > 0 || input->dori;
    const bool is_one = fov_goals_fields(&goals) + has_task == 1 && isnan(goals.field_diagonal) &&
                        (isnan(goals.field_height) || !isnan(pixels->high));
    return is_one && !isnan(pixels->wide) && fov_has_no_lens(input) && !fov_has_angle(input) &&
           !fov_has_subject(input) && isinf(input->distance) && input->sensor.is_fallback &&
           (isnan(input->pitch) || (input->line_scan && !isnan(goals.field_width)));
}

static bool fov_bare_pixels(const struct fov_input *input, struct run *run, struct error *error)
{
    const struct fov_goals goals = fov_input_goals(input);
    const struct pixels_value *pixels = &input->pixels;
    const bool has_pitch = !isnan(input->pitch);
    struct fov_row row = fov_row_none;
    const double wide = pixels->wide * input->squeeze;
    double density = 1 / goals.pixel;
    if (input->task > 0) {
        density = viewing_tasks[input->task - 1].density;
        row.task = fov_tasks[input->task].word;
    }
    if (!isnan(goals.field_width)) {
        density = pixels->wide / goals.field_width;
    } else if (!isnan(goals.field_height)) {
        density = pixels->high / goals.field_height / input->squeeze;
    }
    row.setting.squeeze = input->squeeze;
    row.fov.width_at_s = pixels->wide / density;
    if (!input->line_scan && !isnan(pixels->high)) {
        row.fov.height_at_s = row.fov.width_at_s * pixels->high / wide;
        row.fov.diagonal_at_s = hypot(row.fov.width_at_s, row.fov.height_at_s);
    }
    /* the density is that of any pitch */
    row.pitch = has_pitch ? input->pitch : 1;
    row.magnification = density * row.pitch * input->squeeze;
    if (input->line_scan) {
        row.sensor = arena_printf(run->arena, "a line of %.15g pixels", pixels->wide);
    } else if (isnan(pixels->high)) {
        row.sensor = arena_printf(run->arena, "%.15g pixels across, of any size", pixels->wide);
    } else {
        row.sensor = arena_printf(run->arena, "%.15g x %.15g pixels of any size", pixels->wide,
                                  pixels->high);
    }
    if (!fov_fill_pixels(input, &row, error)) {
        return false;
    }
    if (!has_pitch) {
        row.pitch = row.magnification = NAN;
    }
    run_emit(run, &row);
    return true;
}

/* One row, or one for each task. */
static bool fov_bare_tasks(const struct fov_input *input, struct run *run, struct error *error)
{
    if (!input->dori) {
        return fov_bare_pixels(input, run, error);
    }
    for (int task = 1; task <= DORI_TASKS; task++) {
        struct fov_input own = *input;
        own.task = task;
        if (!fov_bare_pixels(&own, run, error)) {
            return false;
        }
    }
    return true;
}

/* -------- a field on a sensor -------- */

/* A field and a sensor that was named: the magnification follows. */
static bool fov_is_bare_field(const struct fov_input *input)
{
    const struct fov_goals goals = fov_input_goals(input);
    return fov_goals_fields(&goals) > 0 && fov_has_no_lens(input) && !fov_has_angle(input) &&
           !fov_has_subject(input) && isinf(input->distance) && !input->sensor.is_fallback &&
           input->task == 0 && !input->dori;
}

/* -------- an angle and a field -------- */

bool fov_take_pair(struct fov_input *input)
{
    const struct fov_goals goals = fov_input_goals(input);
    double *const angles[] = {&input->horizontal, &input->vertical, &input->diagonal};
    const double fields[] = {goals.field_width, goals.field_height, goals.field_diagonal};
    struct fov_input bare = *input;
    bare.sensor.focal = NAN; /* a camera's own lens has another angle */
    if (!fov_has_no_lens(&bare) || fov_has_subject(input) || !isinf(input->distance) ||
        fov_goals_fields(&goals) != 1) {
        return false;
    }
    int pair = -1, count = 0;
    for (int i = 0; i < 3; i++) {
        count += !isnan(*angles[i]);
        pair = !isnan(*angles[i]) && !isnan(fields[i]) ? i : pair;
    }
    if (pair < 0 || count != 1 || !(*angles[pair] < PI)) {
        return false;
    }
    input->distance = fields[pair] / (2 * tan(*angles[pair] / 2));
    *angles[pair] = NAN;
    return input->is_pair = true;
}

bool fov_is_bare(const struct fov_input *input)
{
    return fov_is_bare_subject(input) || fov_is_bare_pixels(input) || fov_is_bare_field(input);
}

bool fov_bare(const struct fov_input *input, struct run *run, struct error *error)
{
    if (fov_is_bare_subject(input)) {
        return fov_bare_subject(input, run, error);
    }
    if (fov_is_bare_pixels(input)) {
        return fov_bare_tasks(input, run, error);
    }
    warnings_add(run->doubts, "the magnification alone: with a focal length (-f) the distance "
                              "follows too, with a distance (-s) the focal length");
    return fov_telecentric(input, run, error);
}
