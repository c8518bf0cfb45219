/* exchange/lens_json_setting.c - what the positions of a lens in JSON set anew. */
/* SPDX-License-Identifier: MIT */
#include "exchange/lens_json_reading.h"
#include "file/lens_setting.h"
#include "file/lens_unit.h"
#include "file/lens_words.h"

#include <math.h>
#include <string.h>

/* A number; a radius that is null is that of a plane. */
static bool json_set_figure(struct json_reader *reading, const struct json_value *item,
                            struct parameter parameter, struct figure *figure, struct error *error)
{
    const enum parameter_kind kind = parameter.kind;
    bool angle = (parameter_type(kind)->is & PARAMETER_IS_ANGLE) != 0;
    int power = angle ? JSON_ANGLE : parameter_length(kind, parameter.order);
    if (kind == PARAMETER_RADIUS && item->kind == JSON_NULL) {
        *figure = (struct figure){{INFINITY, 0}, text_of("inf"), LENS_NONE};
        return true;
    }
    if (!json_read_figure(reading, item, power, figure, error)) {
        return false;
    }
    return (kind != PARAMETER_RADIUS && kind != PARAMETER_FOCAL) || figure->value.hi != 0 ||
           json_wrong(reading, item, error, "the %s is 0", parameter_type(kind)->words);
}

static bool json_set_stop(struct json_reader *reading, const struct json_value *item, size_t *stop,
                          struct error *error)
{
    const size_t count = reading->build.lens->surface_count;
    struct figure number = {.variable = LENS_NONE};
    if (!json_read_figure(reading, item, JSON_PLAIN, &number, error)) {
        return false;
    }
    double value = number.value.hi;
    if (!(value >= 1 && value <= (double)count && value == floor(value))) {
        return json_wrong(reading, item, error, "surfaces have the numbers 1 to %zu", count);
    }
    *stop = (size_t)value - 1;
    return true;
}

/* What is wrong where a value is no text. */
static const char *const no_text[] = {[SET_MEDIA] = "a medium is a text, as in a .lens file",
                                      [SET_LIGHTS] = "wavelengths of a position are a text: d,F,C",
                                      [SET_POINTS] = "fields of a position are a text: 0;5;7"};

/* The values of all positions. */
static bool json_set_values(struct json_reader *reading, const struct json_value *values,
                            enum set_what what, struct parameter parameter, struct error *error)
{
    struct lens *lens = reading->build.lens;
    struct arena *arena = reading->job->arena;
    const struct set_values set = lens_setting_values(lens->position_count, arena);
    size_t i = 0;
    for (const struct json_value *item = values->first; item != NULL; item = item->next, i++) {
        bool of_text = what != SET_FIGURES && what != SET_STOPS, read = false;
        if (of_text && item->kind != JSON_STRING) {
            return json_wrong(reading, item, error, "%s", no_text[what]);
        }
        struct file_words words = json_place(reading, item);
        words.line = item->text;
        words.scale = lens_unit_scale("mm");
        switch (what) {
        case SET_FIGURES:
            read = json_set_figure(reading, item, parameter, &set.figures[i], error);
            break;
        case SET_MEDIA:
            read = json_read_medium(reading, item, &set.media[i], error);
            break;
        case SET_STOPS:
            read = json_set_stop(reading, item, &set.stops[i], error);
            break;
        case SET_LIGHTS:
            read = lens_light_read(&words, item->text, &set.lights[i], error);
            break;
        case SET_POINTS:
            read = lens_words_points(&words, item->text, lens->field_kind, &set.points[i], error);
            break;
        }
        if (!read) {
            return false;
        }
    }
    const char *why = lens_setting_put(lens, what, parameter, &set, arena);
    return why == NULL || json_wrong(reading, values, error, "%s", why);
}

static bool read_setting(struct json_reader *reading, const struct json_value *object,
                         struct error *error)
{
    static const char *const keys[] = {"name", "values", NULL};
    const struct json_value *name = json_item(object, keys[0]),
                            *values = json_item(object, keys[1]);
    struct parameter parameter = {0};
    enum set_what what;
    if (object->kind != JSON_OBJECT || name == NULL || name->kind != JSON_STRING ||
        values == NULL || values->kind != JSON_ARRAY) {
        return json_wrong(reading, object, error, "a setting has a name and an array of values");
    }
    if (!json_check_keys(reading, object, keys, error) ||
        !json_check_count(reading, values, error)) {
        return false;
    }
    if (lens_setting_is_word(name->text, &what)) {
        return json_set_values(reading, values, what, parameter, error);
    }
    if (!parameter_read(name->text, lens_setting_takes, &parameter, error) ||
        !lens_setting_takes(parameter.kind)) {
        return json_wrong(reading, name, error, "nothing that a position sets: R3, k2, glass1");
    }
    what = parameter.kind == PARAMETER_GLASS ? SET_MEDIA : SET_FIGURES;
    return json_set_values(reading, values, what, parameter, error);
}

bool json_read_settings(struct json_reader *reading, const struct json_value *value,
                        struct error *error)
{
    if (!json_check_array(reading, value, "settings", error)) {
        return false;
    }
    for (const struct json_value *item = json_first(value); item != NULL; item = item->next) {
        if (!read_setting(reading, item, error)) {
            return false;
        }
    }
    return true;
}
