/* commands/photo/fov_pixels.c - fields of view by pixels, and upright cameras. */
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
