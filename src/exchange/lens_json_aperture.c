/* exchange/lens_json_aperture.c - the apertures of a surface in JSON. */
/* SPDX-License-Identifier: MIT */
#include "exchange/lens_json_reading.h"
#include "optics/aperture.h"

#include <string.h>

/* Two lengths, as x and y. */
static bool read_two(struct json_reader *reading, const struct json_value *value,
                     struct figure pair[2], struct error *error)
{
    struct figure *figures = NULL;
    if (json_is_null(value)) {
        return true;
    }
    if (value->kind != JSON_ARRAY || value->count != 2) {
        return json_wrong(reading, value, error, "expected x and y here");
    }
    if (!json_read_figures(reading, value, JSON_LENGTH, &figures, error)) {
        return false;
    }
    memcpy(pair, figures, 2 * sizeof *pair);
    return true;
}

static bool lens_json_aperture_read_sizes(struct json_reader *reading,
                                          const struct json_value *object,
                                          struct aperture *aperture, struct error *error)
{
    const struct json_value *sizes = json_item(object, "size_mm");
    struct figure *figures = NULL;
    size_t count = (size_t)aperture_sizes(aperture->shape);
    if ((json_is_null(sizes) ? 0 : sizes->count) != count) {
        return json_wrong(reading, json_is_null(sizes) ? object : sizes, error,
                          "a %s has %zu sizes", aperture_shapes[aperture->shape].word, count);
    }
    if (count > 0) {
        if (!json_read_figures(reading, sizes, JSON_LENGTH, &figures, error)) {
            return false;
        }
        memcpy(aperture->size, figures, count * sizeof *figures);
    }
    return true;
}

static bool lens_json_aperture_read_points(struct json_reader *reading,
                                           const struct json_value *value,
                                           struct aperture *aperture, struct error *error)
{
    if (json_is_null(value)) {
        return true;
    }
    if (!json_check_array(reading, value, "corners", error)) {
        return false;
    }
    struct figure(*points)[2] = arena_array(reading->job->arena, value->count, sizeof *points);
    for (const struct json_value *item = value->first; item != NULL; item = item->next) {
        if (!read_two(reading, item, points[aperture->point_count++], error)) {
            return false;
        }
    }
    aperture->points = (const struct figure(*)[2])points;
    return true;
}

static bool lens_json_aperture_read_arms(struct json_reader *reading,
                                         const struct json_value *value, struct aperture *aperture,
                                         struct error *error)
{
    struct figure figure;
    if (json_is_null(value)) {
        return true;
    }
    if (!json_read_figure(reading, value, JSON_PLAIN, &figure, error)) {
        return false;
    }
    double count = figure.value.hi;
    aperture->arms = count >= 1 && count <= APERTURE_MOST_ARMS ? (unsigned)count : 0;
    return (double)aperture->arms == count ||
           json_wrong(reading, value, error, "a spider has 1 to %d arms", APERTURE_MOST_ARMS);
}

static bool lens_json_aperture_read_shape(struct json_reader *reading,
                                          const struct json_value *object,
                                          struct aperture *aperture, struct error *error)
{
    const char *words[APERTURE_SHAPES];
    const struct json_value *shape = json_item(object, "shape"),
                            *blocks = json_item(object, "blocks");
    int choice = 0;
    bool dark = false;
    for (size_t i = 0; i < APERTURE_SHAPES; i++) {
        words[i] = aperture_shapes[i].word;
    }
    if (shape == NULL || blocks == NULL) {
        return json_wrong(reading, object, error, "an aperture has \"shape\" and \"blocks\"");
    }
    if (!json_read_choice(reading, shape, words, APERTURE_SHAPES, &choice, error) ||
        !json_read_truth(reading, blocks, &dark, error)) {
        return false;
    }
    *aperture = aperture_of((enum aperture_shape)choice, dark);
    return true;
}

static bool lens_json_aperture_read_aperture(struct json_reader *reading,
                                             const struct json_value *object,
                                             struct aperture *aperture, struct error *error)
{
    static const char *const keys[] = {"shape",     "blocks",      "size_mm",  "arms",
                                       "points_mm", "decenter_mm", "turn_deg", NULL};
    const struct json_value *turn = json_item(object, "turn_deg");
    struct error wrong;
    if (object->kind != JSON_OBJECT) {
        return json_wrong(reading, object, error, "an aperture is an object");
    }
    if (!json_check_keys(reading, object, keys, error) ||
        !lens_json_aperture_read_shape(reading, object, aperture, error) ||
        !lens_json_aperture_read_sizes(reading, object, aperture, error) ||
        !lens_json_aperture_read_arms(reading, json_item(object, "arms"), aperture, error) ||
        !lens_json_aperture_read_points(reading, json_item(object, "points_mm"), aperture, error) ||
        !read_two(reading, json_item(object, "decenter_mm"), aperture->decenter, error) ||
        (!json_is_null(turn) &&
         !json_read_figure(reading, turn, JSON_ANGLE, &aperture->turn, error))) {
        return false;
    }
    return aperture_check(aperture, &wrong) ||
           json_wrong(reading, object, error, "%s", wrong.message);
}

bool json_read_apertures(struct json_reader *reading, const struct json_value *value,
                         struct surface *surface, struct error *error)
{
    if (json_is_null(value)) {
        return true;
    }
    if (!json_check_array(reading, value, "apertures", error)) {
        return false;
    }
    struct aperture *all = ARENA_ARRAY(reading->job->arena, value->count, struct aperture);
    surface->apertures = all;
    for (const struct json_value *item = value->first; item != NULL; item = item->next) {
        if (!lens_json_aperture_read_aperture(reading, item, &all[surface->aperture_count++],
                                              error)) {
            return false;
        }
    }
    return true;
}
