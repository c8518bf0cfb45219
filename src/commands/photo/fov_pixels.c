/* commands/photo/fov_pixels.c - fields of view by pixels, upright cameras, subjects alone. */
/* SPDX-License-Identifier: MIT */
#include "commands/photo/fov_question.h"

#include "base/constants.h"

#include <math.h>

bool fov_take_pixels(struct fov_input *input, struct error *error)
{
    static const double ANY_PITCH = 1e-6; /* mm; so small that the lens focuses at infinity */
    const struct pixels_value *pixels = &input->pixels;
    const bool is_counted = !isnan(pixels->wide), is_sensor = !input->sensor.is_fallback;
    double pitch = input->pitch;
    const bool is_angle =
        !isnan(input->horizontal) || !isnan(input->vertical) || !isnan(input->diagonal);
    if (isnan(input->fx) && isnan(pitch) && !is_sensor && is_angle && !isnan(pixels->high) &&
        photo_lens_is_thin(&input->lens) && isnan(input->lens.focal.length)) {
        input->is_bare = true; /* an angle and pixels: fx is what there is to know */
        input->pitch = ANY_PITCH;
        return true;
    }
    /* rows of other commands bring both, which then say the same */
    if (isnan(input->fx) || !isnan(input->lens.focal.length)) {
        return true;
    }
    if (isnan(pitch)) {
        pitch = is_sensor && is_counted ? input->sensor.size.width / pixels->wide
                                        : input->sensor.size.pitch;
    }
    if (isnan(pitch) && is_counted && !isnan(pixels->high)) {
        input->is_bare = true;
        input->pitch = pitch = ANY_PITCH;
    }
    if (isnan(pitch)) {
        return fail(error, ERROR_USAGE,
                    "{--fx} needs the pixels: {--pixels} 1280x720, {--pitch}, or a camera as "
                    "{--sensor}");
    }
    const double image = input->fx * pitch * input->squeeze;
    input->lens.focal.length = 1 / (1 / image + 1 / input->distance);
    return true;
}

void fov_hold_upright(struct fov_input *input, struct arena *arena)
{
    struct sensor_value *sensor = &input->sensor;
    struct pixels_value *pixels = &input->pixels;
    if (!input->portrait) {
        return;
    }
    const double width = sensor->size.width, wide = pixels->wide;
    sensor->size.width = sensor->size.height;
    sensor->size.height = width;
    sensor->name = arena_printf(arena, "%s, upright", sensor->name);
    if (!isnan(pixels->high)) {
        pixels->wide = pixels->high;
        pixels->high = wide;
    }
}

bool fov_is_bare_subject(const struct fov_input *input)
{
    const struct fov_goals goals = fov_input_goals(input);
    const double others[] = {
        input->lens.focal.length, input->lens.pupil, input->magnification, input->horizontal,
        input->vertical,          input->diagonal,   input->altitude,      input->gsd,
        input->converter,         input->crop,       input->sky.scale,     input->fx};
    const bool has_angle = input->sky.subject > 0 || !isnan(input->sky.angle);
    bool is_bare = !isnan(input->sky.size) && (has_angle || isfinite(input->distance)) &&
                   photo_lens_is_thin(&input->lens) && isnan(input->sensor.focal) &&
                   fov_goals_fields(&goals) == 0 && !input->dori && input->task == 0;
    for (size_t i = 0; i < sizeof others / sizeof others[0] && is_bare; i++) {
        is_bare = isnan(others[i]);
    }
    return is_bare;
}

bool fov_bare_subject(const struct fov_input *input, struct run *run, struct error *error)
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
