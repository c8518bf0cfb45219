/* exchange/lens_json_setting.c - what the positions of a lens in JSON set anew. */
/* SPDX-License-Identifier: MIT */
#include "exchange/lens_json_reading.h"
#include "file/lens_setting.h"
#include "file/lens_unit.h"
#include "file/lens_words.h"

#include <math.h>
#include <string.h>

static bool lens_json_setting_report(struct json_reader *reading, const struct json_value *value,
                                     const char *why, struct error *error)
{
    return why == NULL || json_wrong(reading, value, error, "%s", why);
}

/* Numbers; a radius that is null is that of a plane. */
static bool lens_json_setting_read_figures(struct json_reader *reading,
                                           const struct json_value *values,
                                           struct lens_setting setting, struct error *error)
{
    struct lens *lens = reading->build.lens;
    struct arena *arena = reading->job->arena;
    const enum parameter_kind kind = setting.parameter.kind;
    bool angle = (parameter_type(kind)->is & PARAMETER_IS_ANGLE) != 0;
    int power = angle ? JSON_ANGLE : parameter_length(kind, setting.parameter.order);
    struct figure *figures = ARENA_ARRAY(arena, lens->position_count, struct figure);
    size_t i = 0;
    for (const struct json_value *item = values->first; item != NULL; item = item->next, i++) {
        if (kind == PARAMETER_RADIUS && item->kind == JSON_NULL) {
            figures[i] = (struct figure){{INFINITY, 0}, text_of("inf"), LENS_NONE};
        } else if (!json_read_figure(reading, item, power, &figures[i], error)) {
            return false;
        } else if ((kind == PARAMETER_RADIUS || kind == PARAMETER_FOCAL) &&
                   figures[i].value.hi == 0) {
            return json_wrong(reading, item, error, "the %s is 0", parameter_type(kind)->words);
        }
    }
    setting.figures = figures;
    return lens_json_setting_report(reading, values, lens_setting_add(lens, setting, arena), error);
}

static bool lens_json_setting_read_media(struct json_reader *reading,
                                         const struct json_value *values,
                                         struct lens_setting setting, struct error *error)
{
    struct lens *lens = reading->build.lens;
    struct arena *arena = reading->job->arena;
    struct medium *media = ARENA_ARRAY(arena, lens->position_count, struct medium);
    size_t i = 0;
    for (const struct json_value *item = values->first; item != NULL; item = item->next, i++) {
        if (item->kind != JSON_STRING) {
            return json_wrong(reading, item, error, "a medium is a text, as in a .lens file");
        }
        if (!json_read_medium(reading, item, &media[i], error)) {
            return false;
        }
    }
    setting.media = media;
    return lens_json_setting_report(reading, values, lens_setting_add(lens, setting, arena), error);
}

static bool lens_json_setting_read_stops(struct json_reader *reading,
                                         const struct json_value *values, struct error *error)
{
    struct lens *lens = reading->build.lens;
    size_t *stops = ARENA_ARRAY(reading->job->arena, lens->position_count, size_t), i = 0;
    for (const struct json_value *item = values->first; item != NULL; item = item->next, i++) {
        struct figure number = {.variable = LENS_NONE};
        if (!json_read_figure(reading, item, JSON_PLAIN, &number, error)) {
            return false;
        }
        double value = number.value.hi;
        if (!(value >= 1 && value <= (double)lens->surface_count && value == floor(value))) {
            return json_wrong(reading, item, error, "surfaces have the numbers 1 to %zu",
                              lens->surface_count);
        }
        stops[i] = (size_t)value - 1;
    }
    return lens_json_setting_report(reading, values,
                                    lens_setting_stops(lens, stops, reading->job->arena), error);
}

static bool lens_json_setting_read_lights(struct json_reader *reading,
                                          const struct json_value *values, struct error *error)
{
    struct lens *lens = reading->build.lens;
    struct lens_light *lights =
        ARENA_ARRAY(reading->job->arena, lens->position_count, struct lens_light);
    size_t i = 0;
    for (const struct json_value *item = values->first; item != NULL; item = item->next, i++) {
        if (item->kind != JSON_STRING) {
            return json_wrong(reading, item, error, "wavelengths of a position are a text: d,F,C");
        }
        struct file_words words = json_place(reading, item);
        words.line = item->text;
        if (!lens_light_read(&words, item->text, &lights[i], error)) {
            return false;
        }
    }
    return lens_json_setting_report(reading, values, lens_setting_lights(lens, lights), error);
}

static bool lens_json_setting_read_points(struct json_reader *reading,
                                          const struct json_value *values, struct error *error)
{
    struct lens *lens = reading->build.lens;
    struct lens_points *points =
        ARENA_ARRAY(reading->job->arena, lens->position_count, struct lens_points);
    size_t i = 0;
    for (const struct json_value *item = values->first; item != NULL; item = item->next, i++) {
        if (item->kind != JSON_STRING) {
            return json_wrong(reading, item, error, "fields of a position are a text: 0;5;7");
        }
        struct file_words words = json_place(reading, item);
        words.line = item->text;
        words.scale = lens_unit_scale("mm");
        if (!lens_words_points(&words, item->text, lens->field_kind, &points[i], error)) {
            return false;
        }
    }
    return lens_json_setting_report(reading, values, lens_setting_points(lens, points), error);
}

static bool read_setting(struct json_reader *reading, const struct json_value *object,
                         struct error *error)
{
    static const char *const keys[] = {"name", "values", NULL};
    const struct json_value *name = json_item(object, keys[0]),
                            *values = json_item(object, keys[1]);
    struct lens_setting setting = {.figures = NULL};
    if (object->kind != JSON_OBJECT || name == NULL || name->kind != JSON_STRING ||
        values == NULL || values->kind != JSON_ARRAY) {
        return json_wrong(reading, object, error, "a setting has a name and an array of values");
    }
    if (!json_check_keys(reading, object, keys, error) ||
        !json_check_count(reading, values, error)) {
        return false;
    }
    if (text_equal(name->text, "stop")) {
        return lens_json_setting_read_stops(reading, values, error);
    }
    if (text_equal(name->text, "wavelength")) {
        return lens_json_setting_read_lights(reading, values, error);
    }
    if (text_equal(name->text, "field")) {
        return lens_json_setting_read_points(reading, values, error);
    }
    if (!parameter_read(name->text, lens_setting_takes, &setting.parameter, error) ||
        !lens_setting_takes(setting.parameter.kind)) {
        return json_wrong(reading, name, error, "nothing that a position sets: R3, k2, glass1");
    }
    return setting.parameter.kind == PARAMETER_GLASS
               ? lens_json_setting_read_media(reading, values, setting, error)
               : lens_json_setting_read_figures(reading, values, setting, error);
}

bool json_read_settings(struct json_reader *reading, const struct json_value *value,
                        struct error *error)
{
    if (!json_check_array(reading, value, "settings", error)) {
        return false;
    }
    for (const struct json_value *item = json_is_null(value) ? NULL : value->first; item != NULL;
         item = item->next) {
        if (!read_setting(reading, item, error)) {
            return false;
        }
    }
    return true;
}
