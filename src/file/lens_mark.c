/* file/lens_mark.c - what of a .lens file the designer may change, and wants. */
/* SPDX-License-Identifier: MIT */
#include "file/lens_mark.h"

#include "base/constants.h"
#include "file/lens_unit.h"
#include "file/lens_words.h"

#include <math.h>
#include <string.h>

bool lens_bounds_are_sound(const struct vary *mark)
{
    double low = mark->low.value.hi, high = mark->high.value.hi;
    bool through_plane =
        (mark->kind == PARAMETER_RADIUS || mark->kind == PARAMETER_FOCAL) && low > 0 && high < 0;
    return low <= high || through_plane;
}

static bool read_mark_bound(const struct file_words *words, struct text text,
                            const struct vary *mark, struct figure *figure)
{
    const bool below = text_equal(text, "-inf");
    if (below || text_equal(text, "inf")) {
        *figure = (struct figure){{below ? -INFINITY : INFINITY, 0}, text, LENS_NONE};
        return true;
    }
    return lens_words_number(words, text, mark->kind, mark->order, figure);
}

bool lens_bounds_read(const struct file_words *words, struct text bounds, struct vary *mark)
{
    if (bounds.length == 0) {
        return true;
    }
    if (mark->kind == PARAMETER_GLASS) {
        return file_words_fail(words, bounds,
                               "a glass has no bounds: it stays within the map of optical glasses");
    }
    struct text high = {bounds.start + 1, bounds.length >= 2 ? bounds.length - 2 : 0};
    struct text low = text_cut(&high, ',');
    if (bounds.start[0] != '[' || bounds.start[bounds.length - 1] != ']' || high.start == NULL) {
        return file_words_fail(words, bounds, "bounds are written [low,high]");
    }
    if (!read_mark_bound(words, low, mark, &mark->low) ||
        !read_mark_bound(words, high, mark, &mark->high)) {
        return false;
    }
    mark->has_bounds = true;
    return lens_bounds_are_sound(mark) ||
           file_words_fail(words, bounds, "the lower bound is above the upper");
}

void lens_number_write(struct text_buffer *text, const struct figure *figure,
                       enum parameter_kind kind, int order, const char *unit)
{
    int length = parameter_length(kind, order);
    bool angle = (parameter_type(kind)->is & PARAMETER_IS_ANGLE) != 0;
    if (figure->typed.start != NULL) {
        growing_text(text, figure->typed);
    } else if (angle) {
        growing_number(text, figure->value.hi / RADIANS_PER_DEGREE);
    } else {
        growing_number(text, figure->value.hi / pow(lens_unit_mm(unit), length));
    }
}

void lens_mark_write(const struct vary *mark, const char *name, const char *unit,
                     struct text_buffer *text)
{
    growing_format(text, "%s~", name);
    if (mark->has_bounds) {
        growing_string(text, "[");
        lens_number_write(text, &mark->low, mark->kind, mark->order, unit);
        growing_string(text, ",");
        lens_number_write(text, &mark->high, mark->kind, mark->order, unit);
        growing_string(text, "]");
    }
}

/* 15.2, 15.2~, 15.2~[10,20] */
static bool read_marked(const struct file_words *words, struct text word, struct figure *value,
                        const struct vary **mark)
{
    struct text bounds = word, number = text_cut(&bounds, '~');
    if (!lens_words_figure(words, number, words->scale, "value", value)) {
        return false;
    }
    if (bounds.start == NULL) {
        *mark = NULL;
        return true;
    }
    struct vary *made = ARENA_NEW(words->arena, struct vary);
    *made = (struct vary){.kind = PARAMETER_THICKNESS, .place = file_words_place(words, word)};
    *mark = made;
    return lens_bounds_read(words, bounds, made);
}

bool lens_let_read(struct file_words *words, size_t positions, struct lens_variable *variable,
                   size_t *count)
{
    struct figure *values = ARENA_ARRAY(words->arena, positions + 1, struct figure);
    const struct vary **marks = ARENA_ARRAY(words->arena, positions + 1, const struct vary *);
    bool is_marked = false;
    *count = 0;
    for (struct text word = file_words_next(words); word.length > 0 || *count == 0;
         word = file_words_next(words)) {
        size_t at = *count < positions ? *count : positions;
        if (!read_marked(words, word, &values[at], &marks[at])) {
            return false;
        }
        is_marked = is_marked || marks[at] != NULL;
        ++*count;
    }
    variable->values = values;
    variable->varies = is_marked ? marks : NULL;
    return true;
}

bool lens_let_check(const struct file_words *words, const struct lens *lens, size_t word)
{
    const struct lens_variable *one = &lens->variables[word];
    const struct text name = one->name;
    if (one->values == NULL) {
        file_words_fail(words, name, "'%.*s' is not a number, and no line with 'let' gives it any",
                        text_shown(name), name.start);
        return error_hint(words->error, "a zoom has 'position wide tele' and 'let %.*s 2.4 8.3'",
                          text_shown(name), name.start);
    }
    for (size_t i = 0; i < lens->surface_count && one->varies != NULL; i++) {
        const struct figure *gap = parameter_figure(&lens->surfaces[i], PARAMETER_THICKNESS, 0);
        const struct figure *focal = parameter_figure(&lens->surfaces[i], PARAMETER_FOCAL, 0);
        if ((gap != NULL && gap->variable == word) || (focal != NULL && focal->variable == word)) {
            return true;
        }
    }
    return one->varies == NULL ||
           file_words_fail(words, name,
                           "'%.*s' is marked, but stands for no thickness and no focal length",
                           text_shown(name), name.start);
}

bool lens_goal_read(struct file_words *words, struct lens *lens)
{
    const struct text text = file_words_rest(words);
    if (text.length == 0) {
        return file_words_fail(words, text, "the goal is missing: efl = 100");
    }
    struct lens_goal *all = ARENA_COPY(words->arena, lens->goals, lens->goal_count, 1);
    all[lens->goal_count++] = (struct lens_goal){
        .text = text_of(arena_string(words->arena, text.start, text.length)),
        .source = words->source,
        .line = words->number,
        .column = text_column(words->line, (size_t)(text.start - words->line.start))};
    lens->goals = all;
    return true;
}
