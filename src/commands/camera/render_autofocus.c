/* commands/camera/render_autofocus.c - focused on what lies at a point of the picture. */
/* SPDX-License-Identifier: MIT */
#include "commands/camera/render.h"
#include "photo/distance_from.h"

#include <stdlib.h>

/* Fractions of width and height, from the upper left. */
struct place {
    double x, y;
};

static bool read_place(const char *text, struct place *place, struct error *error)
{
    char *end;
    place->x = strtod(text, &end);
    const bool has_colon = end != text && *end == ':';
    const char *second = has_colon ? end + 1 : text;
    place->y = strtod(second, &end);
    return (has_colon && end != second && *end == '\0' && place->x >= 0 && place->x <= 1 &&
            place->y >= 0 && place->y <= 1) ||
           fail(error, ERROR_USAGE,
                "{--autofocus} '%.40s': fractions of width and height from the upper left, 0 to 1 "
                "each, as 0.5:0.5",
                text);
}

/*
 * What the depth map has there, m. A map as large as the film sees is wider than it, or higher,
 * where the shapes differ.
 */
static double depth_at(const struct image *map, const struct sensor *film, struct place place)
{
    const double proportion = (double)map->width / (double)map->height;
    const double width = fmax(film->width, proportion * film->height);
    const double x = 0.5 + (place.x - 0.5) * film->width / width;
    const double y = 0.5 + (place.y - 0.5) * film->height / (width / proportion);
    const double column = fmin(floor(x * (double)map->width), (double)map->width - 1);
    const double row = fmin(floor(y * (double)map->height), (double)map->height - 1);
    return (double)image_row(map, (size_t)row)[(size_t)column * map->channels];
}

bool render_check_autofocus(const struct render_input *input, struct error *error)
{
    struct place place;
    if (input->autofocus == NULL) {
        return true;
    }
    if (!read_place(input->autofocus, &place, error)) {
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
    struct place place;
    *focused = *input;
    if (input->autofocus == NULL || input->depth_map == NULL) {
        return true; /* a flat card lies as far away everywhere */
    }
    if (!read_place(input->autofocus, &place, error) ||
        !render_depths(input, NULL, arena, &depths, error)) {
        return false;
    }
    const double depth = depth_at(depths.map, &input->sensor.size, place);
    focused->from = FROM_SENSOR;
    focused->distance = depth * 1000;
    return (depth > 0 && isfinite(depth)) ||
           fail(error, ERROR_DOMAIN,
                isinf(depth)
                    ? "{--autofocus} %.40s: the depth map has infinity there, and pictures "
                      "take finite distances"
                    : "{--autofocus} %.40s: the depth map has no distance there",
                input->autofocus);
}

void render_say_autofocus(const struct render_input *input, double distance,
                          struct growing *remarks)
{
    if (input->autofocus != NULL) {
        growing_format(remarks, "focused on %.6g mm before the first vertex, what lies at %s\n",
                       distance, input->autofocus);
    }
}
