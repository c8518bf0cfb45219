/* exchange/writing.c - the digits and names of a lens as CODE V and OSLO files have them. */
/* SPDX-License-Identifier: MIT */
#include "exchange/writing.h"

#include "base/constants.h"
#include "file/decimal.h"
#include "file/lens_build.h"
#include "file/lens_glass.h"
#include "file/lens_unit.h"
#include "file/lens_words.h"
#include "optics/first_order.h"

#include <math.h>
#include <string.h>

void writing_begin(struct lens_writer *writing, const struct lens *lens, bool has_metres,
                   struct arena *arena)
{
    bool is_metre = strcmp(lens->unit, "m") == 0 && !has_metres;
    *writing = (struct lens_writer){
        .arena = arena, .lens = lens, .text = {.arena = arena}, .shift = is_metre ? 3 : 0};
    writing->unit = is_metre ? "mm" : lens->unit;
    writing->scale = lens_unit_scale(writing->unit);
}

/* The figure in the first position, where a variable stands for it. */
static struct figure writing_first_of(const struct lens_writer *writing,
                                      const struct figure *figure)
{
    return figure->variable != LENS_NONE ? writing->lens->variables[figure->variable].values[0]
                                         : *figure;
}

struct text writing_length(const struct lens_writer *writing, const struct figure *figure,
                           int power)
{
    const struct figure first = writing_first_of(writing, figure);
    struct arena *arena = writing->arena;
    if (first.typed.start != NULL) {
        return writing->shift == 0 || power == 0
                   ? first.typed
                   : decimal_shift(first.typed, writing->shift * power, arena);
    }
    if (power > 0) {
        return figure_computed(first.value, writing->scale, arena).typed;
    }
    struct pair plain = first.value;
    plain = pair_divide(plain, lens_words_per_length(pair_of(1), writing->scale, -power));
    return figure_computed(plain, (struct number_scale){1, 0}, arena).typed;
}

struct text writing_degrees(const struct lens_writer *writing, const struct figure *figure)
{
    return figure->typed.start != NULL
               ? figure->typed
               : figure_computed(pair_divide(figure->value, pair_of(RADIANS_PER_DEGREE)),
                                 (struct number_scale){1, 0}, writing->arena)
                     .typed;
}

struct text writing_wave(const struct lens_writer *writing, double micrometres, struct text typed,
                         int power)
{
    const char *unit = typed.length > 2 ? typed.start + typed.length - 2 : "";
    bool has_unit = typed.length > 2 && unit[1] == 'm' && (unit[0] == 'n' || unit[0] == 'u') &&
                    (typed.start[0] == '.' || (typed.start[0] >= '0' && typed.start[0] <= '9'));
    if (has_unit) {
        const struct text number = {typed.start, typed.length - 2};
        int by = power - (unit[0] == 'n' ? 3 : 0);
        return by == 0 ? number : decimal_shift(number, by, writing->arena);
    }
    char number[NUMBER_LENGTH];
    const struct text shortest = text_between(number, number_write_shortest(number, micrometres));
    return decimal_shift(shortest, power, writing->arena);
}

struct text writing_quotable(const struct lens_writer *writing, const char *string, const char *bad,
                             bool *has_lost)
{
    char *copy = arena_string(writing->arena, string, strlen(string));
    for (char *at = copy; *at != '\0'; at++) {
        bool out = strchr(bad, *at) != NULL || (unsigned char)*at < ' ';
        *has_lost = *has_lost || out;
        *at = out ? ' ' : *at;
    }
    return text_of(copy);
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
    double per_unit = lens_words_per_length(pair_of(1), writing->scale, 1).hi;
    *pupil = figure_of(first.entrance_diameter * per_unit, writing->arena);
    pupil->value = pair_of(first.entrance_diameter);
    return true;
}

/* Which glass a name means; null where nobody knows it. */
static const struct glass *meaning(const struct foreign_job *job, const char *name)
{
    struct error error;
    struct medium medium = {.kind = MEDIUM_GLASS, .written = text_of(name), .index = {1, 0}};
    bool found = job->glasses != NULL && job->glasses->find(job->glasses->context, &medium, &error);
    return found ? lens_glass_of(&medium) : NULL;
}

/* The name without '-', '_' and blanks. */
static const char *bare_name(struct text name, struct arena *arena)
{
    char *bare = arena_string(arena, name.start, name.length), *to = bare;
    for (size_t i = 0; i < name.length; i++) {
        bool keep = strchr("-_ ", name.start[i]) == NULL;
        *to = name.start[i];
        to += keep;
    }
    *to = '\0';
    return bare;
}

void writing_glass(const struct lens_writer *writing, const struct foreign_job *job,
                   const struct medium *medium, struct text *name, struct text *catalog)
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
    const char *bare = bare_name(*name, writing->arena);
    const struct glass *found = meaning(
        job, arena_printf(writing->arena, "%.*s:%s", (int)catalog->length, catalog->start, bare));
    if (found != NULL && text_identical(found->name, glass->name) &&
        text_identical(found->catalog, glass->catalog)) {
        *name = text_of(bare);
    }
}
