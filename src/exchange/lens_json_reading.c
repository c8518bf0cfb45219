/* exchange/lens_json_reading.c - numbers, texts and media of a lens in JSON. */
/* SPDX-License-Identifier: MIT */
#include "exchange/lens_json.h"

#include "base/constants.h"
#include "file/lens_unit.h"
#include "file/lens_words.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* The line of a value, for messages. */
struct file_words json_place(struct json_reader *reading, const struct json_value *value)
{
    const char *start = reading->content.start;
    size_t at = value->at - 1, length = reading->content.length;
    if (at < reading->line_start) {
        reading->line_start = 0;
        reading->line = 1;
    }
    const char *end = memchr(start + reading->line_start, '\n', length - reading->line_start);
    while (end != NULL && (size_t)(end - start) < at) {
        reading->line_start = (size_t)(end - start) + 1;
        reading->line++;
        end = memchr(start + reading->line_start, '\n', length - reading->line_start);
    }
    return (struct file_words){
        .source = reading->job->source,
        .error = reading->error,
        .line = text_between(start + reading->line_start, end != NULL ? end : start + length),
        .number = reading->line,
        .scale = NUMBER_UNSCALED,
        .arena = reading->job->arena};
}

bool json_wrong(struct json_reader *reading, const struct json_value *value, const char *format,
                ...)
{
    char message[200];
    const struct file_words words = json_place(reading, value);
    const struct text word = {reading->content.start + value->at - 1, 0};
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    return file_words_fail(&words, word, "%s", message);
}

bool json_check_keys(struct json_reader *reading, const struct json_value *object, const char *keys)
{
    for (const struct json_value *item = object->first; item != NULL; item = item->next) {
        struct text rest = text_of(keys);
        bool is_known = false;
        while (rest.start != NULL && !is_known) {
            is_known = text_identical(text_cut(&rest, ' '), item->key);
        }
        if (!is_known) {
            const struct file_words words = json_place(reading, item);
            foreign_loss(reading->job, &words,
                         (struct text){reading->content.start + item->at - 1, 0}, LOSS_OF_RAYS,
                         NULL, "unknown key '%.*s'", text_shown(item->key), item->key.start);
            continue;
        }
        const char *key = arena_string(reading->job->arena, item->key.start, item->key.length);
        if (json_item(object, key) != item) {
            return json_wrong(reading, item, "the key '%s' appears twice", key);
        }
    }
    return true;
}

bool json_is_null(const struct json_value *value)
{
    return value == NULL || value->kind == JSON_NULL;
}

/* A text, or null where there is none; as a .lens file can hold it. */
bool json_read_text(struct json_reader *reading, const struct json_value *value, const char **text)
{
    *text = NULL;
    if (json_is_null(value)) {
        return true;
    }
    if (value->kind != JSON_STRING) {
        return json_wrong(reading, value, "expected a text here");
    }
    *text = lens_build_string(&reading->build, value->text);
    return true;
}

/* Which of the words a text is. */
bool json_read_choice(struct json_reader *reading, const struct json_value *value,
                      const char *const *words, size_t count, int *choice)
{
    if (json_is_null(value)) {
        return true;
    }
    for (size_t i = 0; value->kind == JSON_STRING && i < count; i++) {
        if (text_equal(value->text, words[i])) {
            *choice = (int)i;
            return true;
        }
    }
    return json_wrong(reading, value, "expected one of %s .. %s here", words[0], words[count - 1]);
}

bool json_read_truth(struct json_reader *reading, const struct json_value *value, bool *truth)
{
    *truth = value->kind == JSON_BARE && text_equal(value->text, "true");
    return *truth || (value->kind == JSON_BARE && text_equal(value->text, "false")) ||
           json_wrong(reading, value, "expected true or false here");
}

static struct figure json_in_unit(const struct json_reader *reading, struct pair value, int power)
{
    static const struct figure one = {.typed = {"1", 1}, .variable = LENS_NONE};
    const char *unit = reading->build.lens->unit;
    struct arena *arena = reading->job->arena;
    if (power == JSON_LENGTH) {
        return figure_computed(value, lens_unit_scale(unit), arena);
    }
    struct figure figure = figure_computed(
        pair_divide(value, figure_per_length(one, unit, power).value), NUMBER_UNSCALED, arena);
    figure.value = value;
    return figure;
}

bool json_read_figure(struct json_reader *reading, const struct json_value *value, int power,
                      struct figure *figure)
{
    struct pair number = {0, 0};
    struct text text = value->text;
    if (value->kind != JSON_BARE || !text_pair(text, NUMBER_UNSCALED, &number) ||
        !(fabs(number.hi) < 1e100)) {
        return json_wrong(reading, value, "expected a number below 1e100 here");
    }
    if (power != JSON_PLAIN && power != JSON_ANGLE) {
        *figure = json_in_unit(reading, number, power);
        return true;
    }
    *figure = (struct figure){number, text, LENS_NONE};
    if (power == JSON_ANGLE) {
        figure->value = pair_multiply(number, pair_of(RADIANS_PER_DEGREE));
    }
    return true;
}

bool json_read_row(struct json_reader *reading, const struct json_value *value, int power,
                   struct figure *figures, size_t count, const char *what)
{
    if (json_is_null(value)) {
        return true;
    }
    if (value->kind != JSON_ARRAY || value->count != count) {
        return json_wrong(reading, value, "%s",
                          what != NULL ? what : "expected an array of numbers here");
    }
    for (const struct json_value *item = value->first; item != NULL; item = item->next) {
        if (!json_read_figure(reading, item, power, figures++)) {
            return false;
        }
    }
    return true;
}

/* An array of numbers. */
bool json_read_figures(struct json_reader *reading, const struct json_value *value, int power,
                       struct figure **figures)
{
    *figures = ARENA_ARRAY(reading->job->arena, value->count, struct figure);
    return json_read_row(reading, value, power, *figures, value->count, NULL);
}

bool json_check_array(struct json_reader *reading, const struct json_value *value, const char *what)
{
    return json_is_null(value) || value->kind == JSON_ARRAY ||
           json_wrong(reading, value, "expected an array of %s here", what);
}

bool json_check_truth(struct json_reader *reading, const struct json_value *value, bool truth,
                      const char *key, const char *other)
{
    bool said;
    if (json_is_null(value)) {
        return true;
    }
    return json_read_truth(reading, value, &said) &&
           (said == truth || json_wrong(reading, value, "%s contradicts %s", key, other));
}

bool json_check_count(struct json_reader *reading, const struct json_value *value)
{
    size_t count = reading->build.lens->position_count;
    return (value->count == count && count > 0) ||
           json_wrong(reading, value, "%zu values, but the lens has %zu positions", value->count,
                      count);
}

bool json_read_medium(struct json_reader *reading, const struct json_value *value,
                      struct medium *medium)
{
    struct foreign_job *job = reading->job;
    if (json_is_null(value)) {
        return true;
    }
    if (value->kind != JSON_STRING) {
        return json_wrong(reading, value, "a medium is a text, as in a .lens file");
    }
    struct file_words words = json_place(reading, value);
    bool table = value->text.length > 0 && value->text.start[0] == '{';
    for (size_t i = 0; i < value->text.length; i++) {
        unsigned char c = (unsigned char)value->text.start[i];
        if (c < ' ' || c == '"' || c == '#' || (c == ' ' && !table)) {
            return json_wrong(reading, value, "no medium of a .lens file");
        }
    }
    words.line = value->text;
    if (!lens_words_medium(&words, value->text, medium)) {
        return false;
    }
    if (medium->kind == MEDIUM_GLASS && job->glasses != NULL &&
        !job->glasses->find(job->glasses->context, medium, reading->error)) {
        const struct error found = *reading->error;
        json_wrong(reading, value, "%s", found.message);
        return error_hint(reading->error, "%s", found.hint);
    }
    return true;
}
