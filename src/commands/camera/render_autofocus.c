/* commands/camera/render_autofocus.c - focused on what lies at a point of the picture. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "commands/camera/render.h"
#include "photo/distance_from.h"

bool render_autofocus_place(const char *text, double place[2], struct error *error)
{
    return (render_numbers(text, ":", false, place) && place[0] <= 1 && place[1] <= 1) ||
           fail(error, ERROR_USAGE,
                "{--autofocus} '%.40s': fractions of width and height from the upper left, 0 to 1 "
                "each, as 0.5:0.5",
                text);
}

/*
 * What the depth map has there, m. A map as large as the film sees is wider than it, or higher,
 * where the shapes differ.
 */
static double depth_at(const struct image *map, const struct sensor *film, const double place[2])
{
    const double proportion = image_proportion(map);
    const double width = fmax(film->width, proportion * film->height);
    const double x = 0.5 + (place[0] - 0.5) * film->width / width;
    const double y = 0.5 + (place[1] - 0.5) * film->height / (width / proportion);
    const double column = fmin(floor(x * (double)map->width), (double)map->width - 1);
    const double row = fmin(floor(y * (double)map->height), (double)map->height - 1);
    return (double)image_row(map, (size_t)row)[(size_t)column * map->channels];
}

bool render_check_autofocus(const struct render_input *input, struct error *error)
{
    double place[2];
    if (input->autofocus == NULL) {
        return true;
    }
    if (!render_autofocus_place(input->autofocus, place, error)) {
        return false;
    }
    if (!isnan(input->field_width)) {
        return fail(error, ERROR_USAGE,
                    "{--autofocus} and {--field-width} exclude each other: where the card ends is "
                    "known only when the lens is focused");
    }
    if (input->depth_map != NULL && !isnan(input->distance)) {
        return fail(error, ERROR_USAGE,
                    "{--autofocus} takes the distance from the depth map: not with {--distance}");
    }
    return true;
}

bool render_autofocus(const struct render_input *input, struct arena *arena,
                      struct render_input *focused, struct error *error)
{
    struct photograph_depths depths;
    double place[2];
    *focused = *input;
    if (input->autofocus == NULL || input->depth_map == NULL) {
        return true; /* a flat card lies as far away everywhere */
    }
    if (!render_autofocus_place(input->autofocus, place, error) ||
        !render_depths(input, NULL, arena, &depths, error)) {
        return false;
    }
    const double depth = depth_at(depths.map, &input->sensor.size, place);
    focused->from = FROM_SENSOR;
    focused->distance = depth * MM_PER_M;
    return (depth > 0 && isfinite(depth)) ||
           fail(error, ERROR_DOMAIN,
                isinf(depth)
                    ? "{--autofocus} %.40s: the depth map has infinity there, and pictures "
                      "take finite distances"
                    : "{--autofocus} %.40s: the depth map has no distance there",
                input->autofocus);
}

void render_say_autofocus(const struct render_input *input, double distance,
                          struct text_buffer *remarks)
{
    if (input->autofocus != NULL && isinf(distance)) {
        growing_format(remarks, "focused on infinity: nothing lies at %s\n", input->autofocus);
    } else if (input->autofocus != NULL) {
        growing_format(remarks, "focused on %.6g mm before the first vertex, what lies at %s\n",
                       distance, input->autofocus);
    }
}
