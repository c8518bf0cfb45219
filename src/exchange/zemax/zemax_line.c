/* exchange/zemax/zemax_line.c - a line of a .zmx file: its keyword and its numbers. */
/* SPDX-License-Identifier: MIT */
#include "exchange/zemax/zemax.h"
#include "file/lens_words.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

double zemax_number(const struct zemax_line *line, size_t at)
{
    return line != NULL && at < line->count ? line->numbers[at].value.hi : 0;
}

size_t zemax_wave_count(const struct zemax_file *file)
{
    const double stated = fabs(zemax_number(file->fields, 3));
    size_t count = file->wave_count;
    if (stated >= 1 && stated < (double)count) {
        count = (size_t)stated;
    }
    while (!(stated >= 1) && count > 1 &&
           file->waves[count - 1].value.hi == file->waves[count - 2].value.hi) {
        count--;
    }
    return count;
}

void zemax_remark(struct zemax_file *file, const char *format, ...)
{
    char text[200];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    lens_build_note(&file->build, text_of(text));
}

bool zemax_stands(struct zemax_file *file, const struct zemax_line *line, const char *what)
{
    if (file->configurations < 2) {
        zemax_remark(file, "line %ld: %s; the file's number is kept", line->words.number, what);
        return true;
    }
    return zemax_loss(file, line, LOSS_OF_NOTHING, "the file's number is kept", "%s", what);
}

struct zemax_line *zemax_line_of(struct zemax_file *file, struct text keyword,
                                 struct number_scale scale)
{
    struct zemax_line *line = ARENA_NEW(file->job->arena, struct zemax_line);
    struct file_words words = file->words, counting = words;
    size_t room = 0;
    while (file_words_next(&counting).length > 0) {
        room++;
    }
    line->words = words;
    line->keyword = line->begin = keyword;
    line->numbers = ARENA_ARRAY(file->job->arena, room, struct figure);
    for (struct text word = file_words_next(&words); word.length > 0;
         word = file_words_next(&words)) {
        struct figure figure = {.typed = word, .variable = LENS_NONE};
        const char *end = word.start + word.length;
        if (line->first.start == NULL) {
            line->first = word;
            line->infinite = text_same(word, "INFINITY");
        }
        bool number = pair_read(word.start, end, scale, &figure.value) == end &&
                      fabs(figure.value.hi) < 1e100;
        if (!number) {
            line->stray = word.start[0] != '"' ? word : line->stray;
            break;
        }
        line->numbers[line->count++] = figure;
    }
    return line;
}

bool zemax_all_numbers(const struct zemax_line *line)
{
    char what[100];
    struct figure figure;
    snprintf(what, sizeof what, "value behind %.*s", text_shown(line->begin), line->begin.start);
    return line->stray.start == NULL ||
           lens_words_figure(&line->words, line->stray, NUMBER_UNSCALED, what, &figure);
}

bool zemax_has_number(const struct zemax_line *line)
{
    if (line->count > 0) {
        return zemax_all_numbers(line);
    }
    return zemax_fail(line, line->first.start != NULL ? line->first : line->keyword,
                      "%.4s needs a number", line->keyword.start);
}

bool zemax_is_tilted(const struct zemax_file *file, size_t at)
{
    const struct zemax_surface *surface = &file->surfaces[at];
    bool shifted = false;
    for (size_t i = 3; i < 8; i++) {
        shifted = shifted || zemax_number(surface->shift_before, i) != 0;
    }
    return shifted || (surface->type != NULL && text_same(surface->type->first, "TILTSURF") &&
                       (zemax_number(surface->parameters[1], 1) != 0 ||
                        zemax_number(surface->parameters[2], 1) != 0));
}

struct figure zemax_parameter(const struct zemax_file *file, size_t at, size_t number)
{
    const struct zemax_surface *surface = &file->surfaces[at];
    const struct zemax_line *pickup = surface->pickups[number];
    const struct figure none = {.typed = text_of("0"), .variable = LENS_NONE};
    double from = zemax_number(pickup, 1);
    if (pickup != NULL && pickup->count >= 3 && from >= 0 && from < (double)at &&
        zemax_number(pickup, 4) == 0) {
        struct pair value = zemax_parameter(file, (size_t)from, number).value;
        value = pair_add(pair_multiply(value, pickup->numbers[2].value),
                         pickup->count > 3 ? pickup->numbers[3].value : pair_of(0));
        return figure_computed(value, NUMBER_UNSCALED, file->job->arena);
    }
    return surface->parameters[number] != NULL ? surface->parameters[number]->numbers[1] : none;
}
