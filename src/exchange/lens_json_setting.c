/* exchange/lens_json_setting.c - what positions set anew, what follows, is wanted and allowed, in JSON. */
/* SPDX-License-Identifier: MIT */
#include "exchange/lens_json.h"
#include "file/lens_mark.h"
#include "file/lens_pickup.h"
#include "file/lens_setting.h"
#include "file/lens_tolerance.h"
#include "file/lens_unit.h"
#include "file/lens_words.h"

#include <math.h>
#include <string.h>

/* A number; a radius that is null is that of a plane. */
static bool json_set_figure(struct json_reader *reading, const struct json_value *item,
                            struct parameter parameter, struct figure *figure)
{
    const enum parameter_kind kind = parameter.kind;
    int power = (parameter_type(kind)->is & PARAMETER_IS_ANGLE) != 0
                    ? JSON_ANGLE
                    : parameter_length(kind, parameter.order);
    if (kind == PARAMETER_RADIUS && item->kind == JSON_NULL) {
        *figure = (struct figure){{INFINITY, 0}, text_of("inf"), LENS_NONE};
        return true;
    }
    if (!json_read_figure(reading, item, power, figure)) {
        return false;
    }
    return (kind != PARAMETER_RADIUS && kind != PARAMETER_FOCAL) || figure->value.hi != 0 ||
           json_wrong(reading, item, "the %s is 0", parameter_type(kind)->words);
}

static bool json_set_stop(struct json_reader *reading, const struct json_value *item, size_t *stop)
{
    const size_t count = reading->build.lens->surface_count;
    struct figure number = {.variable = LENS_NONE};
    if (!json_read_figure(reading, item, JSON_PLAIN, &number)) {
        return false;
    }
    double value = number.value.hi;
    if (!(value >= 1 && value <= (double)count && value == floor(value))) {
        return json_wrong(reading, item, "surfaces have the numbers 1 to %zu", count);
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
                            enum set_what what, struct parameter parameter)
{
    struct lens *lens = reading->build.lens;
    struct arena *arena = reading->job->arena;
    const struct set_values set = lens_setting_values(lens->position_count, arena);
    size_t i = 0;
    for (const struct json_value *item = values->first; item != NULL; item = item->next, i++) {
        bool of_text = what != SET_FIGURES && what != SET_STOPS, read = false;
        if (of_text && item->kind != JSON_STRING) {
            return json_wrong(reading, item, "%s", no_text[what]);
        }
        struct file_words words = json_place(reading, item);
        words.line = item->text;
        words.scale = lens_unit_scale("mm");
        switch (what) {
        case SET_FIGURES:
            read = json_set_figure(reading, item, parameter, &set.figures[i]);
            break;
        case SET_MEDIA:
            read = json_read_medium(reading, item, &set.media[i]);
            break;
        case SET_STOPS:
            read = json_set_stop(reading, item, &set.stops[i]);
            break;
        case SET_LIGHTS:
            read = lens_light_read(&words, item->text, &set.lights[i]);
            break;
        case SET_POINTS:
            read = lens_words_points(&words, item->text, lens->field_kind, &set.points[i]);
            break;
        }
        if (!read) {
            return false;
        }
    }
    const char *why = lens_setting_put(lens, what, parameter, &set, arena);
    return why == NULL || json_wrong(reading, values, "%s", why);
}

static bool json_setting(struct json_reader *reading, const struct json_value *object)
{
    const struct json_value *name = json_item(object, "name"),
                            *values = json_item(object, "values");
    struct parameter parameter = {0};
    enum set_what what;
    if (object->kind != JSON_OBJECT || name == NULL || name->kind != JSON_STRING ||
        values == NULL || values->kind != JSON_ARRAY) {
        return json_wrong(reading, object, "a setting has a name and an array of values");
    }
    if (!json_check_keys(reading, object, "name values") || !json_check_count(reading, values)) {
        return false;
    }
    if (lens_setting_is_word(name->text, &what)) {
        return json_set_values(reading, values, what, parameter);
    }
    if (!parameter_read(name->text, lens_setting_takes, &parameter, reading->error) ||
        !lens_setting_takes(parameter.kind)) {
        return json_wrong(reading, name, "nothing that a position sets: R3, k2, glass1");
    }
    what = parameter.kind == PARAMETER_GLASS ? SET_MEDIA : SET_FIGURES;
    return json_set_values(reading, values, what, parameter);
}

bool json_read_settings(struct json_reader *reading, const struct json_value *value)
{
    if (!json_check_array(reading, value, "settings")) {
        return false;
    }
    for (const struct json_value *item = json_first(value); item != NULL; item = item->next) {
        if (!json_setting(reading, item)) {
            return false;
        }
    }
    return true;
}

/* Texts as the lines of a .lens file in mm have them. */
static bool json_lines(struct json_reader *reading, const struct json_value *value,
                       bool (*read)(struct file_words *words, struct lens *lens))
{
    if (!json_check_array(reading, value, "texts")) {
        return false;
    }
    for (const struct json_value *item = json_first(value); item != NULL; item = item->next) {
        if (item->kind != JSON_STRING ||
            memchr(item->text.start, '\n', item->text.length) != NULL) {
            return json_wrong(reading, item, "expected a line of text here");
        }
        struct file_words words = json_place(reading, item);
        words.line = item->text;
        words.at = item->text.start;
        words.scale = lens_unit_scale("mm");
        if (!read(&words, reading->build.lens)) {
            return false;
        }
    }
    return true;
}

bool json_read_design(struct json_reader *reading, const struct json_value *pickups,
                      const struct json_value *goals, const struct json_value *tolerances)
{
    struct lens *lens = reading->build.lens;
    if (!json_lines(reading, pickups, lens_pickup_read) ||
        !json_lines(reading, goals, lens_goal_read) ||
        !json_lines(reading, tolerances, lens_tolerance_read)) {
        return false;
    }
    lens_pickups_begin(lens, reading->job->arena);
    return true;
}
