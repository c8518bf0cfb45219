/* exchange/writing.c - the digits and names of a lens as CODE V and OSLO files have them. */
/* SPDX-License-Identifier: MIT */
#include "exchange/writing.h"

#include "base/constants.h"
#include "file/decimal.h"
#include "file/lens_build.h"
#include "file/lens_glass.h"
#include "file/lens_unit.h"
#include "file/lens_words.h"
#include "optics/aperture.h"
#include "optics/first_order.h"

#include <math.h>
#include <string.h>

void writing_begin(struct lens_writer *writing, struct foreign_job *job, const struct lens *lens,
                   bool has_metres)
{
    bool is_metre = strcmp(lens->unit, "m") == 0 && !has_metres;
    const char *unit = is_metre ? "mm" : lens->unit;
    *writing = (struct lens_writer){.job = job,
                                    .arena = job->arena,
                                    .lens = lens,
                                    .unit = unit,
                                    .scale = lens_unit_scale(unit),
                                    .shift = is_metre ? 3 : 0,
                                    .text = {.arena = job->arena}};
}

static struct text writing_length_text(const struct lens_writer *writing,
                                       const struct figure *figure, int power)
{
    if (figure->variable != LENS_NONE) {
        figure = &writing->lens->variables[figure->variable].values[0];
    }
    if (figure->typed.start != NULL) {
        return writing->shift == 0 || power == 0
                   ? figure->typed
                   : decimal_shift(figure->typed, writing->shift * power, writing->arena);
    }
    if (power > 0) {
        return figure_computed(figure->value, writing->scale, writing->arena).typed;
    }
    return figure_computed(pair_divide(figure->value,
                                       lens_words_per_length(pair_of(1), writing->scale, -power)),
                           NUMBER_UNSCALED, writing->arena)
        .typed;
}

static struct text degrees_text(const struct lens_writer *writing, const struct figure *figure)
{
    return figure->typed.start != NULL
               ? figure->typed
               : figure_computed(pair_divide(figure->value, pair_of(RADIANS_PER_DEGREE)),
                                 NUMBER_UNSCALED, writing->arena)
                     .typed;
}

static const char *writing_string(const struct lens_writer *writing, struct text text)
{
    return arena_string(writing->arena, text.start, text.length);
}

const char *writing_length(const struct lens_writer *writing, const struct figure *figure,
                           int power)
{
    return writing_string(writing, writing_length_text(writing, figure, power));
}

const char *writing_half(const struct lens_writer *writing, const struct figure *figure)
{
    return writing_string(writing,
                          decimal_half(writing_length_text(writing, figure, 1), writing->arena));
}

const char *writing_degrees(const struct lens_writer *writing, const struct figure *figure)
{
    return writing_string(writing, degrees_text(writing, figure));
}

const char *writing_turned(const struct lens_writer *writing, const struct figure *figure)
{
    return writing_string(writing, decimal_negate(degrees_text(writing, figure), writing->arena));
}

const char *writing_wave(const struct lens_writer *writing, double micrometres, struct text typed,
                         int power)
{
    const char *unit = typed.length > 2 ? typed.start + typed.length - 2 : "";
    bool has_unit = typed.length > 2 && unit[1] == 'm' && (unit[0] == 'n' || unit[0] == 'u') &&
                    (typed.start[0] == '.' || char_is_digit(typed.start[0]));
    char shortest[NUMBER_LENGTH];
    const struct text number =
        has_unit ? text_between(typed.start, unit)
                 : text_between(shortest, number_write_shortest(shortest, micrometres));
    int by = has_unit && unit[0] == 'n' ? power - 3 : power;
    return writing_string(writing,
                          has_unit && by == 0 ? number : decimal_shift(number, by, writing->arena));
}

const char *writing_weight(const struct lens_writer *writing, struct text typed, const char *one)
{
    return typed.start != NULL ? writing_string(writing, typed) : one;
}

const char *writing_quotable(const struct lens_writer *writing, const char *string, const char *bad,
                             bool *has_lost)
{
    char *copy = arena_string(writing->arena, string, strlen(string));
    for (char *at = copy; *at != '\0'; at++) {
        if (strchr(bad, *at) != NULL || (unsigned char)*at < ' ') {
            *has_lost = true;
            *at = ' ';
        }
    }
    return copy;
}

void writing_lose_aperture(const struct lens_writer *writing, const struct surface *surface,
                           const struct aperture *aperture, const char *why)
{
    foreign_lose(writing->job, LOSS_OF_VIGNETTING, "left out", "surface %zu: a %s that %s: %s",
                 (size_t)(surface - writing->lens->surfaces) + 1,
                 aperture_shapes[aperture->shape].word, aperture->blocks ? "blocks" : "passes",
                 why);
}

bool writing_pupil(const struct lens_writer *writing, size_t position, struct figure *pupil)
{
    const struct lens *lens = lens_at_position(writing->lens, position, writing->arena);
    struct aperture_setting aperture = lens_aperture(lens);
    struct conjugate_object object = lens_object(lens);
    struct first_order first;
    struct error error;
    bool known = first_order_of_lens(lens, lens_primary_wavelength(lens), SECTION_Y, writing->arena,
                                     &first, &error) &&
                 first_order_aperture(&first, &object, &aperture, FIELD_NONE, 0, &error);
    if (!known || !(first.entrance_diameter > 0) || !isfinite(first.entrance_diameter)) {
        return false;
    }
    *pupil =
        figure_of(first.entrance_diameter * lens_words_per_length(pair_of(1), writing->scale, 1).hi,
                  writing->arena);
    pupil->value = pair_of(first.entrance_diameter);
    return true;
}

/* Which glass a name means; null where nobody knows it. */
static const struct glass *glass_meant(const struct foreign_job *job, const char *name)
{
    struct error error;
    struct medium medium = {.kind = MEDIUM_GLASS, .written = text_of(name), .index = {1, 0}};
    bool found = job->glasses != NULL && job->glasses->find(job->glasses->context, &medium, &error);
    return found ? lens_glass_of(&medium) : NULL;
}

void writing_glass(const struct lens_writer *writing, const struct medium *medium,
                   struct text *name, struct text *catalog)
{
    const struct glass *glass = lens_glass_of(medium);
    *name = medium->written;
    *catalog = text_cut(name, ':');
    if (name->start == NULL) {
        *name = *catalog;
        *catalog = (struct text){"", 0};
    }
    if (glass == NULL) {
        return;
    }
    *name = glass->name;
    *catalog = glass->catalog;
    /* The name without '-', '_' and blanks. */
    const struct text from = *name;
    char *bare = arena_string(writing->arena, from.start, from.length), *to = bare;
    for (size_t i = 0; i < from.length; i++) {
        bool keep = strchr("-_ ", from.start[i]) == NULL;
        *to = from.start[i];
        to += keep;
    }
    *to = '\0';
    const struct glass *found =
        glass_meant(writing->job, arena_printf(writing->arena, "%.*s:%s", (int)catalog->length,
                                               catalog->start, bare));
    if (found != NULL && text_identical(found->name, glass->name) &&
        text_identical(found->catalog, glass->catalog)) {
        *name = text_of(bare);
    }
}
