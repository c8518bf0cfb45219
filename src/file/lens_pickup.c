/* file/lens_pickup.c - pick-ups of a .lens file. */
/* SPDX-License-Identifier: MIT */
#include "file/lens_pickup.h"

#include "base/constants.h"
#include "file/lens_build.h"
#include "file/lens_mark.h"
#include "file/lens_words.h"
#include "optics/pickup.h"

#include <math.h>

/* A sum of one number of the lens and one plain number, while it is read. */
struct sum {
    const struct file_words *words;
    struct text rest;
    struct lens_pickup *pickup;
    bool has_from, has_offset;
};

static bool lens_pickup_is_name(char c)
{
    return ((c | 32) >= 'a' && (c | 32) <= 'z') || char_is_digit(c) || c == '_';
}

static struct text lens_pickup_cut(struct sum *sum, size_t length)
{
    const struct text head = {sum->rest.start, length};
    sum->rest = text_trim((struct text){sum->rest.start + length, sum->rest.length - length});
    return head;
}

/* The plain number that the rest begins with; its length is 0 where there is none. */
static struct text cut_factor(struct sum *sum)
{
    double ignored;
    const char *end = sum->rest.start + sum->rest.length;
    bool digits =
        sum->rest.length > 0 && (char_is_digit(*sum->rest.start) || *sum->rest.start == '.');
    const char *behind =
        digits ? number_read(sum->rest.start, end, NUMBER_UNSCALED, &ignored) : NULL;
    return lens_pickup_cut(sum, behind != NULL ? (size_t)(behind - sum->rest.start) : 0);
}

/* Digits of the term with its sign, so that it is written as it was typed. */
static bool read_term_figure(struct sum *sum, bool minus, struct text digits, bool is_factor,
                             struct figure *figure)
{
    const struct parameter what = sum->pickup->what;
    bool read = is_factor ? lens_words_figure(sum->words, digits, NUMBER_UNSCALED, "factor", figure)
                          : lens_words_number(sum->words, digits, what.kind, what.order, figure);
    *figure = read && minus ? figure_negate(*figure, sum->words->arena) : *figure;
    return read;
}

static bool read_term(struct sum *sum, bool minus)
{
    struct lens_pickup *pickup = sum->pickup;
    const struct text digits = cut_factor(sum);
    if (digits.length > 0 && sum->rest.length > 0 && *sum->rest.start == '*') {
        lens_pickup_cut(sum, 1);
    }
    size_t length = 0;
    while (length < sum->rest.length && lens_pickup_is_name(sum->rest.start[length])) {
        length++;
    }
    const struct text name = lens_pickup_cut(sum, length);
    const struct text at = name.length > 0 || digits.length == 0 ? name : digits;
    if (at.length == 0) {
        return file_words_fail(sum->words, at, "a pick-up is written R6 = -R3 or t9 = 0.5 t4 + 2");
    }
    if (name.length > 0 ? sum->has_from : sum->has_offset) {
        return file_words_fail(sum->words, at,
                               "a second %s: a pick-up is a factor times one number of the lens, "
                               "plus one plain number",
                               name.length > 0 ? "number that is followed" : "plain number");
    }
    if (name.length == 0) {
        sum->has_offset = true;
        return read_term_figure(sum, minus, digits, false, &pickup->offset);
    }
    sum->has_from = true;
    return lens_words_parameter(sum->words, name, NULL, &pickup->from) &&
           read_term_figure(sum, minus, digits.length > 0 ? digits : text_of("1"), true,
                            &pickup->factor);
}

static bool read_sum(struct sum *sum)
{
    const struct text whole = sum->rest;
    do {
        bool is_signed =
            sum->rest.length > 0 && (*sum->rest.start == '-' || *sum->rest.start == '+');
        bool minus = is_signed && *sum->rest.start == '-';
        if (!is_signed && sum->rest.start != whole.start) {
            return file_words_fail(sum->words, sum->rest, "expected '+' or '-' here");
        }
        lens_pickup_cut(sum, is_signed ? 1 : 0);
        if (!read_term(sum, minus)) {
            return false;
        }
    } while (sum->rest.length > 0);
    return sum->has_from ||
           file_words_fail(sum->words, whole, "a pick-up follows a number of the lens: R6 = -R3");
}

bool lens_pickup_read(struct file_words *words, struct lens *lens)
{
    struct lens_pickup pickup = {.factor = figure_of(1, words->arena), .offset = figure_zero()};
    struct text value = file_words_rest(words), name = text_trim(text_cut(&value, '='));
    if (value.start == NULL) {
        return file_words_fail(words, name, "a pick-up is written R6 = -R3 or t9 = 0.5 t4 + 2");
    }
    struct sum sum = {.words = words, .rest = text_trim(value), .pickup = &pickup};
    if (!lens_words_parameter(words, name, NULL, &pickup.what) || !read_sum(&sum)) {
        return false;
    }
    bool plain = pickup.factor.value.hi == 1 && pickup.offset.value.hi == 0;
    if (pickup.what.kind == PARAMETER_GLASS && !plain) {
        return file_words_fail(words, name, "a glass follows another as it is: %.*s = glass1",
                               text_shown(name), name.start);
    }
    if (!(fabs(pickup.factor.value.hi) > 0)) {
        return file_words_fail(words, name, "the factor is 0: nothing is followed");
    }
    const char *against = lens_pickup_add(lens, pickup, words->arena);
    return against == NULL || file_words_fail(words, name, "%s", against);
}

void lens_pickup_write(const struct lens_pickup *pickup, const char *unit, struct text_buffer *text)
{
    const double factor = pickup->factor.value.hi, offset = pickup->offset.value.hi;
    struct figure apart = pickup->offset;
    growing_format(text, "%s = ", parameter_mark_write(pickup->what, text->arena));
    if (factor == -1) {
        growing_string(text, "-");
    } else if (factor != 1) {
        lens_number_write(text, &pickup->factor, PARAMETER_CONIC, 0,
                          unit); /* a number without a unit */
        growing_string(text, " ");
    }
    growing_string(text, parameter_mark_write(pickup->from, text->arena));
    if (offset != 0) {
        growing_string(text, offset < 0 ? " - " : " + ");
        apart = offset < 0 ? figure_negate(apart, text->arena) : apart;
        lens_number_write(text, &apart, pickup->what.kind, pickup->what.order, unit);
    }
}

/* What the file has where a pick-up goes. */
struct before {
    struct figure figure; /* not typed: there is none */
    struct text medium;
    double number;
};

static struct before lens_pickup_look(const struct lens *lens, struct parameter what)
{
    const struct surface *surface = &lens->surfaces[what.surface];
    const struct figure *figure = parameter_figure(surface, what.kind, what.order);
    struct before before = {.medium = surface->medium.written};
    before.figure = figure != NULL ? *figure : (struct figure){.variable = LENS_NONE};
    before.number = what.kind == PARAMETER_GLASS ? 0 : parameter_get(lens, what);
    return before;
}

static const char *order_warning(const struct lens_pickup *pickup, const struct before *was,
                                 const struct before *is, struct arena *arena)
{
    const char *name = parameter_mark_write(pickup->what, arena);
    bool is_angle = (parameter_type(pickup->what.kind)->is & PARAMETER_IS_ANGLE) != 0;
    double unit = is_angle ? RADIANS_PER_DEGREE : 1;
    if (pickup->what.kind == PARAMETER_GLASS) {
        return text_identical(was->medium, is->medium)
                   ? NULL
                   : arena_printf(arena, "%s is %.*s by its pick-up, not the %.*s of the file",
                                  name, text_shown(is->medium), is->medium.start,
                                  text_shown(was->medium), was->medium.start);
    }
    bool in_medium = was->figure.typed.start == NULL &&
                     (pickup->what.kind == PARAMETER_INDEX || pickup->what.kind == PARAMETER_ABBE);
    double rounding = INFINITY;
    if (in_medium) {
        rounding = 1e-6 * fabs(was->number);
    } else if (was->figure.typed.start != NULL) {
        rounding = figure_rounding(&was->figure);
    }
    return fabs(is->number - was->number) <= rounding + 1e-12 * fabs(was->number)
               ? NULL
               : arena_printf(arena, "%s is %.10g by its pick-up, not the %.10g of the file", name,
                              is->number / unit, was->number / unit);
}

void lens_pickups_begin(struct lens *lens, struct arena *arena)
{
    if (lens->pickup_count == 0) {
        return;
    }
    struct before *all = ARENA_ARRAY(arena, lens->pickup_count, struct before);
    for (size_t i = 0; i < lens->pickup_count; i++) {
        all[i] = lens_pickup_look(lens, lens->pickups[i].what);
    }
    lens_pickups_put(lens, lens_at_position(lens, 0, arena), arena);
    for (size_t i = 0; i < lens->pickup_count; i++) {
        struct lens_pickup *pickup = &lens->pickups[i];
        const struct parameter what = pickup->what;
        const struct before is = lens_pickup_look(lens, what);
        const struct figure *typed = &all[i].figure;
        pickup->warning = order_warning(pickup, &all[i], &is, arena);
        if (typed->typed.start != NULL && typed->value.hi == is.figure.value.hi &&
            typed->value.lo == is.figure.value.lo) {
            parameter_put(&lens->surfaces[what.surface], what.kind, what.order, *typed, arena);
        }
    }
}
