/* exchange/codev/codev_glass.c - the glasses of a CODE V file: names, codes, its own catalogue. */
/* SPDX-License-Identifier: MIT */
#include "exchange/codev/codev.h"

#include "exchange/own_glass.h"
#include "file/decimal.h"

#include <math.h>
#include <string.h>

bool codev_catalog(struct codev *codev)
{
    struct commands *commands = &codev->commands;
    if (codev->what == 'P') { /* PRV, END */
        codev->in_catalog = !codev->in_catalog;
        return commands_end(commands, 1);
    }
    size_t count = commands->count - 1;
    codev->catalog_waves = ARENA_ARRAY(commands->job->arena, count + 1, struct text);
    codev->catalog_wave_count = count;
    for (size_t i = 0; i < count; i++) {
        struct figure wave;
        codev->catalog_waves[i] = commands->words[i + 1].text;
        if (!commands_figure(commands, i + 1, false, "wavelength", &wave)) {
            return false;
        }
    }
    return true;
}

bool codev_private_glass(struct codev *codev)
{
    struct commands *commands = &codev->commands;
    size_t count = commands->count - 1;
    struct codev_private *one =
        ARENA_ADD(commands->job->arena, codev->privates, codev->private_count, codev->private_room);
    *one = (struct codev_private){.name = commands->words[0]};
    const struct command_word first = commands_word(commands, 1);
    bool is_formula =
        first.text.length > 0 && !char_is_digit(first.text.start[0]) && first.text.start[0] != '.';
    if (is_formula) {
        return true; /* refused where a surface has it */
    }
    if (count == 0 || count != codev->catalog_wave_count) {
        return commands_fail(commands, &commands->words[count > 0 ? 1 : 0],
                             "%zu indices for %zu wavelengths of PWL", count,
                             codev->catalog_wave_count);
    }
    double *wavelengths = ARENA_ARRAY(commands->job->arena, count, double);
    for (size_t i = 1; i <= count; i++) {
        struct figure index;
        if (!commands_figure(commands, i, false, "index", &index)) {
            return false;
        }
        text_number(codev->catalog_waves[i - 1], (struct number_scale){1, -3}, &wavelengths[i - 1]);
        one->rounding = fmax(one->rounding, own_glass_rounding(&index));
    }
    one->wavelengths = wavelengths;
    one->count = count;
    one->medium =
        sequence_indices(codev->job->arena, codev->catalog_waves, "nm", &commands->words[1], count);
    return true;
}

/* The last one of this name; null if there is none. */
static const struct codev_private *find_private(const struct codev *codev, struct text name)
{
    for (size_t i = codev->private_count; i-- > 0;) {
        const struct text known = codev->privates[i].name.text;
        if (text_same(name, arena_string(codev->job->arena, known.start, known.length))) {
            return &codev->privates[i];
        }
    }
    return NULL;
}

/* 517642, 516800.641670: the digits of nd - 1, and of Vd/100 (six digits without a point: Vd/10) */
static const char *medium_of_code(struct text code, struct arena *arena)
{
    size_t point = 0, dots = 0;
    for (size_t i = 0; i < code.length; i++) {
        if (code.start[i] == '.') {
            point = i;
            dots++;
        } else if (!char_is_digit(code.start[i])) {
            return NULL;
        }
    }
    struct text index = {code.start, dots == 1 ? point : 3}, abbe = {NULL, 0};
    if (dots == 1) {
        abbe = (struct text){code.start + point + 1, code.length - point - 1};
        abbe = decimal_shift(abbe, 2 - (int)abbe.length, arena);
    } else if (dots == 0 && code.length == 6) {
        abbe = decimal_shift((struct text){code.start + 3, 3}, -1, arena);
    }
    bool sound = index.length >= 1 && index.length < 40 && abbe.length > 0 && abbe.length < 40;
    return sound ? arena_printf(arena, "1.%.*s/%.*s", (int)index.length, index.start,
                                (int)abbe.length, abbe.start)
                 : NULL;
}

/* 1.5168:64.17, 1.5 */
static const char *medium_of_numbers(struct text text, struct arena *arena)
{
    double number, Vd;
    struct text abbe = text, index = text_cut(&abbe, ':');
    if (!text_number(index, NUMBER_UNSCALED, &number)) {
        return NULL;
    }
    if (abbe.start == NULL) {
        return number < 10 ? arena_string(arena, text.start, text.length) : NULL;
    }
    return text_number(abbe, NUMBER_UNSCALED, &Vd)
               ? arena_printf(arena, "%.*s/%.*s", (int)index.length, index.start, (int)abbe.length,
                              abbe.start)
               : NULL;
}

/* NAME_CATALOG, or a name that one catalogue has; false with ERROR_NONE where there is none. */
static bool codev_named_glass(struct codev *codev, const struct file_words *place, struct text text,
                              struct medium *medium)
{
    size_t cut = text.length;
    while (cut > 0 && text.start[cut - 1] != '_') {
        cut--;
    }
    const struct text catalog = {text.start + cut, text.length - cut};
    const struct foreign_name named = {.name = {text.start, cut > 1 ? cut - 1 : text.length},
                                       .catalogs = &catalog,
                                       .catalog_count = cut > 1};
    return foreign_glass(codev->job, place, &named, medium, codev->commands.error);
}

/* A private glass may have the name of a catalogue's. */
static bool compare_private(struct codev *codev, const struct codev_private *own,
                            struct sequence_surface *surface)
{
    struct error *error = codev->commands.error;
    const struct own_glass glass = {.job = codev->job,
                                    .build = &codev->build,
                                    .name = surface->glass.text,
                                    .wavelengths = own->wavelengths,
                                    .count = own->count,
                                    .rounding = own->rounding};
    const struct file_words place = commands_place(&codev->commands, &surface->glass);
    struct medium found;
    if (codev->job->glasses == NULL) {
        return true;
    }
    if (codev_named_glass(codev, &place, surface->glass.text, &found)) {
        own_glass_compare(&glass, &found, &surface->medium);
        return true;
    }
    error->code = codev->job->glass_numbers == GLASS_NUMBERS_CATALOG ? error->code : ERROR_NONE;
    return error->code == ERROR_NONE;
}

bool codev_find_glass(struct codev *codev, struct sequence_surface *surface)
{
    struct arena *arena = codev->job->arena;
    const struct text text = surface->glass.text;
    const struct file_words place = commands_place(&codev->commands, &surface->glass);
    if (text.length == 0 || text_same(text, "AIR")) {
        return true;
    }
    const struct codev_private *own = find_private(codev, text);
    if (own != NULL && own->medium == NULL) {
        return commands_fail(&codev->commands, &surface->glass,
                             "the glass '%.*s' has a formula that lenscalc does not know",
                             text_shown(text), text.start);
    }
    const char *made = own != NULL ? own->medium : medium_of_numbers(text, arena);
    made = made != NULL ? made : medium_of_code(text, arena);
    if (made != NULL) {
        return sequence_medium(&codev->commands, &surface->glass, made, &surface->medium) &&
               (own == NULL || compare_private(codev, own, surface));
    }
    if (codev_named_glass(codev, &place, text, &surface->medium)) {
        return true;
    }
    return codev->commands.error->code == ERROR_NONE &&
           foreign_lack(codev->job, &place, text, &surface->medium,
                        arena_printf(codev->job->arena, "glass '%.*s' is in no catalogue",
                                     text_shown(text), text.start));
}
