/* cli/options/option_sensor.c - read picture areas: formats, cameras, sizes. */
/* SPDX-License-Identifier: MIT */
#include "cli/options/option.h"

#include <math.h>
#include <string.h>

/* mm on 35 mm film: longer ones are no main lenses of phones and drones. */
static const double NORMAL_LENS = 40;

static const char *size_name(struct arena *arena, struct sensor size)
{
    char width[NUMBER_LENGTH + 1], height[NUMBER_LENGTH + 1];
    *number_write_shortest(width, size.width) = '\0';
    *number_write_shortest(height, size.height) = '\0';
    return arena_printf(arena, "%s x %s mm", width, height);
}

/* Cut off the width: 'x', 'X' or the sign of multiplication stands between. */
static struct text cut_width(struct text *rest)
{
    static const char sign[] = "\xc3\x97";
    for (size_t i = 0; i < rest->length; i++) {
        const char *at = rest->start + i;
        bool is_sign = i + 1 < rest->length && memcmp(at, sign, 2) == 0;
        if (is_sign || *at == 'x' || *at == 'X') {
            struct text width = text_trim((struct text){rest->start, i});
            size_t behind = i + (is_sign ? 2 : 1);
            *rest = (struct text){rest->start + behind, rest->length - behind};
            return width;
        }
    }
    struct text whole = *rest;
    *rest = (struct text){NULL, 0};
    return whole;
}

bool option_read_size(const struct option *option, struct text text, double sides[2],
                      bool *has_unit, struct error *error)
{
    struct text rest = text;
    struct text width = cut_width(&rest);
    const struct unit *unit = NULL, *other = NULL;
    error->code = ERROR_NONE;
    if (rest.start == NULL || width.length == 0 ||
        !(char_is_digit(width.start[0]) || width.start[0] == '.')) {
        return false;
    }
    struct text wrong = rest;
    bool read = quantity_read(rest, &dimension_length, NULL, &sides[1], &unit, error);
    if (read) {
        wrong = width;
        read = quantity_read(width, &dimension_length, unit, &sides[0], &other, error) &&
               quantity_read(rest, &dimension_length, other, &sides[1], NULL, error);
    }
    if (!read) {
        error_within(error, text, wrong);
        return option_blame(option, text, error);
    }
    *has_unit = unit != NULL || other != NULL;
    return true;
}

static bool sensor_size_read(const struct reader *reader, const struct option *option,
                             struct text text, struct sensor_value *sensor, struct error *error)
{
    double sides[2];
    bool has_unit;
    struct sensor *size = &sensor->size;
    if (!option_read_size(option, text, sides, &has_unit, error)) {
        return false;
    }
    *size = (struct sensor){sides[0], sides[1], NAN};
    if (!(size->width > 0 && size->height > 0) || isinf(size->width) || isinf(size->height)) {
        return fail(error, ERROR_DOMAIN, "a sensor must be wider and higher than 0 mm");
    }
    sensor->name = size_name(reader->arena, *size);
    if (!has_unit) {
        sensor->name = arena_printf(reader->arena, "%s (no unit: mm)", sensor->name);
    }
    return true;
}

/* "1/1.8", "2/3": fractions of an inch, as makers of cameras for machines write them. */
static bool is_inch_fraction(struct text text)
{
    struct text below = text;
    const struct text above = text_cut(&below, '/');
    struct error ignored;
    double a, b;
    return below.start != NULL && below.length > 0 && above.length > 0 &&
           char_is_digit(above.start[0]) && char_is_digit(below.start[0]) &&
           quantity_read(above, &dimension_number, NULL, &a, NULL, &ignored) &&
           quantity_read(below, &dimension_number, NULL, &b, NULL, &ignored) && a < b;
}

/*
 * The number of inches of "1/1.28\"", "1/1.28 inch", "1\"-type", "1/1.28"; its start is null
 * elsewhere.
 */
static struct text inches_of(struct text text)
{
    static const char *const ends[] = {"-type", " type", "\"", "\xe2\x80\xb3", "\xe2\x80\x9d", "''",
                                       "-inch", "inch",  "in"};
    struct text rest = text;
    bool any = is_inch_fraction(text);
    for (size_t i = 0; i < sizeof ends / sizeof ends[0]; i++) {
        size_t length = strlen(ends[i]);
        if (rest.length > length &&
            text_same((struct text){rest.start + rest.length - length, length}, ends[i])) {
            rest = text_trim((struct text){rest.start, rest.length - length});
            any = any || i > 1;
        }
    }
    return any && rest.length > 0 && char_is_digit(rest.start[0]) ? rest : (struct text){NULL, 0};
}

void option_sensor_of(const struct reader *reader, const struct lensdb_sensor *found,
                      struct sensor_value *sensor)
{
    *sensor = (struct sensor_value){.size = found->size};
    if (!quantity_read(found->focal, &dimension_number, NULL, &sensor->focal, NULL,
                       &(struct error){0})) {
        sensor->focal = NAN; /* unknown, or both ends of a zoom */
    }
    sensor->is_optical = inches_of(found->name).start != NULL;
    const char *size = size_name(reader->arena, found->size);
    sensor->name = arena_printf(reader->arena, "%.*s%s%.*s (%s)", (int)found->maker.length,
                                found->maker.start, found->maker.length > 0 ? " " : "",
                                (int)found->name.length, found->name.start, size);
    /* cameras with a lens that cannot be changed, and that is wide but for the long module of a
       phone or drone */
    double equivalent = NAN;
    struct error ignored;
    const bool is_long =
        quantity_read(found->equivalent, &dimension_number, NULL, &equivalent, NULL, &ignored) &&
        equivalent > NORMAL_LENS;
    sensor->is_wide =
        !is_long && (text_equal(found->class, "phone") || text_equal(found->class, "drone") ||
                     text_equal(found->class, "action"));
    sensor->fnumber = NAN;
    if (!isnan(sensor->focal)) {
        const bool has_fnumber = quantity_read(found->fnumber, &dimension_number, NULL,
                                               &sensor->fnumber, NULL, &ignored);
        sensor->fnumber = has_fnumber ? sensor->fnumber : (double)NAN;
        sensor->bare_name = sensor->name;
        sensor->with_lens = arena_printf(
            reader->arena, "%.*s, its lens %.*s mm%s%.*s)", (int)strlen(sensor->name) - 1,
            sensor->name, (int)found->focal.length, found->focal.start, has_fnumber ? " f/" : "",
            has_fnumber ? (int)found->fnumber.length : 0, found->fnumber.start);
    }
    if (text_equal(found->pitch_from, "estimate")) {
        sensor->pitch_note = "worked out from an estimated pixel count, good to about 2 %";
    }
}

/* "35mm (36 x 24 mm)", as it is printed, is read as "35mm". */
static struct text without_size(struct text text)
{
    struct text trimmed = text_trim(text);
    if (trimmed.length == 0 || trimmed.start[trimmed.length - 1] != ')') {
        return text;
    }
    struct text rest = trimmed;
    return text_trim(text_cut(&rest, '('));
}

/* An optical format: as the table has it, else by its rule. */
static bool read_optical(const struct reader *reader, const struct option *option, struct text text,
                         struct sensor_value *sensor, struct error *error)
{
    struct text number = inches_of(text);
    struct lensdb_sensor found;
    struct error ignored;
    double inches;
    error->code = ERROR_NONE;
    if (number.start == NULL) {
        return false;
    }
    const char *name = arena_printf(reader->arena, "%.*sin", (int)number.length, number.start);
    if (lensdb_find_sensor(reader->db, text_of(name), &found, &ignored)) {
        option_sensor_of(reader, &found, sensor);
        return true;
    }
    if (!quantity_read(number, &dimension_ratio, NULL, &inches, NULL, error) ||
        !sensor_optical_format(inches, &sensor->size, error)) {
        return option_blame(option, text, error);
    }
    sensor->name =
        arena_printf(reader->arena, "%s (%.4g x %.4g mm, nominal: 4:3, %d mm of diagonal an inch)",
                     name, sensor->size.width, sensor->size.height, inches >= 0.5 ? 16 : 18);
    sensor->is_optical = true;
    return true;
}

/* Words for kinds of cameras, whose picture areas differ too much for one answer. */
static const struct {
    const char *word, *message, *hint;
} kinds[] = {
    {"phone", "phones have sensors of many sizes",
     "name the phone, 'iPhone 15 Pro' (see 'lenscalc list cameras phone'), or its sensor, "
     "'1/1.28in'"},
    {"smartphone", "phones have sensors of many sizes",
     "name the phone, 'iPhone 15 Pro' (see 'lenscalc list cameras phone'), or its sensor, "
     "'1/1.28in'"},
    {"drone", "drones have sensors of many sizes",
     "name the drone, 'Mavic 3' (see 'lenscalc list cameras drone'), or its sensor, '1/1.3in'"},
    {"medium format", "medium format has several sizes",
     "say which: digital '44x33' or '54x40', film '645', '6x6', '6x7' or '6x9'"},
    {"large format", "large format has several sizes", "say which: '4x5', '5x7' or '8x10'"},
    {"crop", "cropped sensors have several sizes",
     "say which: 'aps-c', 'aps-c-canon', 'aps-h' or '4/3'"},
    {"compact", "compact cameras have sensors of several sizes",
     "say which: '1in', '1/1.7in' or '1/2.3in'"},
};

/* The shape in words: "2.39:1", "16:9", "1.85". */
static bool gate_shape_read(struct text text, double *ratio)
{
    struct error ignored;
    return text.length > 0 && char_is_digit(text.start[0]) &&
           quantity_read(text, &dimension_ratio, NULL, ratio, NULL, &ignored) &&
           (memchr(text.start, ':', text.length) != NULL ||
            memchr(text.start, '.', text.length) != NULL);
}

/* "1.5x", "x1.5", "1.5x crop": how much smaller than 35 mm, which fits several sensors. */
static bool is_crop_factor(struct text text)
{
    struct text number = text;
    struct error ignored;
    double factor;
    const char *const crop = " crop";
    if (text.length > strlen(crop) &&
        text_same(text_between(text.start + text.length - strlen(crop), text.start + text.length),
                  crop)) {
        number.length -= strlen(crop);
    }
    if (number.length > 1 && (*number.start == 'x' || *number.start == 'X')) {
        number = (struct text){number.start + 1, number.length - 1};
    } else if (number.length > 1 && strchr("xX", number.start[number.length - 1]) != NULL) {
        number.length--;
    } else if (number.length == text.length) {
        return false;
    }
    return char_is_digit(*number.start) &&
           quantity_read(number, &dimension_number, NULL, &factor, NULL, &ignored) && factor < 10;
}

static bool sensor_refuse(const struct option *option, struct text text, struct error *error)
{
    double ratio;
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        if (text_same_name(text, text_of(kinds[i].word))) {
            fail(error, ERROR_USAGE, "%s '%.*s': %s", TYPED(option, text), kinds[i].message);
            return error_hint(error, "%s", kinds[i].hint);
        }
    }
    if (is_crop_factor(text)) {
        fail(error, ERROR_USAGE, "%s '%.*s' is a crop factor, which sensors of several sizes have",
             TYPED(option, text));
        return error_hint(error, "say which: 'aps-c', 'aps-c-canon', 'aps-h', '4/3' or a camera");
    }
    if (gate_shape_read(text, &ratio)) {
        fail(error, ERROR_USAGE, "%s '%.*s' is an aspect ratio without a size",
             TYPED(option, text));
        return error_hint(error, "name the gate: 'super35 %.*s'", text_shown(text), text.start);
    }
    return error_prefix(error, "%s: ", CALLED(option));
}

/* "iPhone 15 Pro main": the camera that a phone's name alone stands for. */
static struct text without_main(struct text text)
{
    static const char *const ends[] = {" main camera", " main", " wide camera"};
    for (size_t i = 0; i < sizeof ends / sizeof ends[0]; i++) {
        const size_t length = strlen(ends[i]);
        if (text.length > length &&
            text_same((struct text){text.start + text.length - length, length}, ends[i])) {
            return (struct text){text.start, text.length - length};
        }
    }
    return text;
}

/* A name, a size or an optical format; `*begun`: one of the latter two, but with a fault. */
static bool read_whole(const struct reader *reader, const struct option *option, struct text text,
                       struct sensor_value *sensor, bool *begun, struct error *error)
{
    struct lensdb_sensor found;
    struct error own;
    *begun = false;
    text = without_main(text);
    /* names first: 6x9 is a trade name, not a size */
    if (lensdb_find_sensor(reader->db, without_size(text), &found, error)) {
        option_sensor_of(reader, &found, sensor);
        return true;
    }
    if (error->code != ERROR_USAGE) {
        return false;
    }
    if (sensor_size_read(reader, option, without_size(text), sensor, &own)) {
        return true;
    }
    bool read =
        own.code == ERROR_NONE && read_optical(reader, option, text_trim(text), sensor, &own);
    if (own.code != ERROR_NONE && !is_crop_factor(text_trim(text))) {
        *error = own;
        *begun = !read;
    }
    return read;
}

/* "super35 2.39:1": the largest part of a gate with that shape. */
static bool read_extraction(const struct reader *reader, const struct option *option,
                            struct text text, struct sensor_value *sensor)
{
    struct error ignored;
    struct sensor_value gate = {.focal = NAN};
    double ratio;
    bool begun;
    size_t at = text.length;
    while (at > 0 && text.start[at - 1] != ' ' && text.start[at - 1] != '@') {
        at--;
    }
    struct text shape = {text.start + at, text.length - at};
    if (at < 2 || !gate_shape_read(shape, &ratio)) {
        return false;
    }
    struct text name = text_trim((struct text){text.start, at - 1});
    if (!read_whole(reader, option, name, &gate, &begun, &ignored) ||
        !sensor_extract(&gate.size, ratio, &sensor->size, &ignored)) {
        return false;
    }
    sensor->pitch_note = gate.pitch_note;
    sensor->name = arena_printf(reader->arena, "%.*s (%.5g x %.5g mm of %.5g x %.5g)",
                                (int)text.length, text.start, sensor->size.width,
                                sensor->size.height, gate.size.width, gate.size.height);
    return true;
}

static bool sensor_value_read(const struct reader *reader, const struct option *option,
                              struct text text, void *member, struct error *error)
{
    struct sensor_value sensor = {.focal = NAN};
    bool begun;
    if (read_whole(reader, option, text, &sensor, &begun, error) ||
        (error->code == ERROR_USAGE &&
         read_extraction(reader, option, text_trim(without_size(text)), &sensor))) {
        sensor.is_fallback = reader->fallback;
        *(struct sensor_value *)member = sensor;
        return true;
    }
    return !begun && error->code == ERROR_USAGE && sensor_refuse(option, text_trim(text), error);
}

const struct option_kind kind_sensor = {
    .name = "sensor",
    .size = sizeof(struct sensor_value),
    .is_list = true,
    .read = sensor_value_read,
    OPTION_NAMED(struct sensor_value, name),
    .reads = READS_LENSDB,
    .nan_count = 3,
};
