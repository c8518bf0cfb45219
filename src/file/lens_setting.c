/* file/lens_setting.c - what the positions of a .lens file set anew: the lines with `set`. */
/* SPDX-License-Identifier: MIT */
#include "file/lens_setting.h"

#include "base/constants.h"
#include "file/lens_words.h"

#include <math.h>
#include <string.h>

bool lens_words_glass(const struct file_words *words, const struct glass_source *glasses,
                      struct medium *medium)
{
    struct error *error = words->error;
    if (medium->kind != MEDIUM_GLASS || glasses == NULL || medium->glass_index != NULL ||
        glasses->find(glasses->context, medium, error)) {
        return true;
    }
    const struct error found = *error;
    file_words_fail(words, medium->written, "%s", found.message);
    return error_hint(error, "%s", found.hint);
}

/* Why the first value is not what the surface has; null where it is. */
static const char *against_surface(const struct surface *surface,
                                   const struct lens_setting *setting, struct arena *arena)
{
    const struct parameter *one = &setting->parameter;
    const char *name = parameter_write(*one, arena);
    if (setting->media != NULL) {
        if (surface_reflects(surface) || surface->kind == SURFACE_STOP) {
            return arena_printf(arena, "%s: a mirror or a stop has no glass of its own", name);
        }
        if (medium_is_same(&setting->media[0], &surface->medium)) {
            return NULL;
        }
        return arena_printf(arena, "%s: the first position has not the medium of its surface",
                            name);
    }
    const struct figure *figure = parameter_figure(surface, one->kind, one->order);
    bool plane = one->kind == PARAMETER_RADIUS && surface->is_plane && !surface->has_curvature &&
                 isinf(setting->figures[0].value.hi);
    if (figure == NULL && !plane) {
        return arena_printf(arena, "%s: its surface has no number of this kind to set", name);
    }
    if (figure != NULL && figure->variable != LENS_NONE) {
        return arena_printf(arena, "%s is a variable, which has its numbers by 'let'", name);
    }
    return plane || (figure->value.hi == setting->figures[0].value.hi &&
                     figure->value.lo == setting->figures[0].value.lo)
               ? NULL
               : arena_printf(arena, "%s: the first position has not the number of its surface",
                              name);
}

static bool is_same_parameter(struct parameter a, struct parameter b)
{
    return a.surface == b.surface && a.kind == b.kind && a.order == b.order;
}

static const char *lens_setting_add(struct lens *lens, struct lens_setting setting,
                                    struct arena *arena)
{
    const struct parameter one = setting.parameter;
    const char *name = parameter_write(one, arena);
    if (one.surface >= lens->surface_count) {
        return arena_printf(arena, "%s: the lens has %zu surfaces", name, lens->surface_count);
    }
    const struct surface *surface = &lens->surfaces[one.surface];
    if (!parameter_suits(one.kind, surface)) {
        return arena_printf(arena, "%s: its surface has no %s", name,
                            parameter_type(one.kind)->words);
    }
    for (size_t i = 0; i < lens->setting_count; i++) {
        if (is_same_parameter(lens->settings[i].parameter, one)) {
            return arena_printf(arena, "%s is set twice", name);
        }
    }
    const char *against = against_surface(surface, &setting, arena);
    if (against != NULL) {
        return against;
    }
    struct lens_setting *all = ARENA_COPY(arena, lens->settings, lens->setting_count, 1);
    all[lens->setting_count++] = setting;
    lens->settings = all;
    return NULL;
}

static const char *lens_setting_stops(struct lens *lens, const size_t *stops, struct arena *arena)
{
    for (size_t i = 0; i < lens->position_count; i++) {
        if (stops[i] >= lens->surface_count) {
            return arena_printf(arena, "stop: the lens has %zu surfaces", lens->surface_count);
        }
    }
    if (lens->stops != NULL || lens->stop != stops[0]) {
        return lens->stops != NULL ? "stop is set twice"
                                   : "stop: in the first position it is not the surface that "
                                     "bears the word stop";
    }
    lens->stops = stops;
    return NULL;
}

static const char *lens_setting_points(struct lens *lens, const struct lens_points *points)
{
    const struct lens_points *first = &points[0];
    bool same = first->count == lens->field_count;
    for (size_t i = 0; same && i < first->count; i++) {
        same = lens_field_is_same(&first->fields[i], &lens->fields[i]);
    }
    if (lens->points != NULL || !same) {
        return lens->points != NULL ? "field is set twice"
                                    : "field: the first position has not that of the lens";
    }
    lens->points = points;
    return NULL;
}

static const char *lens_setting_lights(struct lens *lens, const struct lens_light *lights)
{
    const struct lens_light *first = &lights[0];
    bool same = first->count == lens->wavelength_count;
    for (size_t i = 0; same && i < first->count; i++) {
        const struct lens_wavelength *a = &first->wavelengths[i], *b = &lens->wavelengths[i];
        same = a->wavelength == b->wavelength && a->weight == b->weight;
    }
    if (lens->lights != NULL || !same) {
        return lens->lights != NULL ? "wavelength is set twice"
                                    : "wavelength: the first position has not those of the lens";
    }
    lens->lights = lights;
    return NULL;
}

/* The next value of the line: there is one for each position and no more. */
static bool next_set_word(struct file_words *words, const struct lens *lens, size_t at,
                          struct text *word)
{
    *word = file_words_next(words);
    if ((word->length > 0) == (at < lens->position_count)) {
        return true;
    }
    return file_words_fail(words, *word, "one value for each of the %zu positions",
                           lens->position_count);
}

static bool read_set_number(struct file_words *words, struct text word, struct parameter parameter,
                            struct figure *figure)
{
    const struct parameter_type *type = parameter_type(parameter.kind);
    bool flat = text_equal(word, "inf") || text_equal(word, "-inf") || text_equal(word, "-");
    if (parameter.kind == PARAMETER_RADIUS && flat) {
        *figure = (struct figure){{INFINITY, 0}, text_of("inf"), LENS_NONE};
        return true;
    }
    *figure = (struct figure){.variable = LENS_NONE};
    if (!lens_words_number(words, word, parameter.kind, parameter.order, figure)) {
        return false;
    }
    return (parameter.kind != PARAMETER_RADIUS && parameter.kind != PARAMETER_FOCAL) ||
           figure->value.hi != 0 || file_words_fail(words, word, "the %s is 0", type->words);
}

/* The number of a surface, which is kept from 0. */
static bool read_set_stop(struct file_words *words, struct text word, const struct lens *lens,
                          size_t *stop)
{
    struct figure number = {.variable = LENS_NONE};
    if (!lens_words_figure(words, word, NUMBER_UNSCALED, "surface", &number)) {
        return false;
    }
    double value = number.value.hi;
    if (!(value >= 1 && value <= (double)lens->surface_count && value == floor(value))) {
        return file_words_fail(words, word, "surfaces have the numbers 1 to %zu",
                               lens->surface_count);
    }
    *stop = (size_t)value - 1;
    return true;
}

const char *lens_light_write(const struct lens_light *light, struct arena *arena)
{
    const char *all = "";
    for (size_t i = 0; i < light->count; i++) {
        const struct lens_wavelength *one = &light->wavelengths[i];
        struct text weight = one->weight_typed;
        all = arena_printf(arena, "%s%s%.*s%s%.*s", all, i > 0 ? "," : "", (int)one->typed.length,
                           one->typed.start, weight.start != NULL ? ":" : "", (int)weight.length,
                           weight.start != NULL ? weight.start : "");
    }
    return all;
}

bool lens_light_read(const struct file_words *words, struct text list, struct lens_light *light)
{
    size_t room = 0;
    *light = (struct lens_light){NULL, 0};
    while (list.start != NULL) {
        const struct text one = text_cut(&list, ',');
        if (!lens_words_light(words, one,
                              ARENA_ADD(words->arena, light->wavelengths, light->count, room))) {
            return false;
        }
    }
    return true;
}

bool lens_setting_is_word(struct text name, enum set_what *what)
{
    static const struct {
        const char *name;
        enum set_what what;
    } words[] = {{"stop", SET_STOPS}, {"wavelength", SET_LIGHTS}, {"field", SET_POINTS}};
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        if (text_equal(name, words[i].name)) {
            *what = words[i].what;
            return true;
        }
    }
    return false;
}

struct set_values lens_setting_values(size_t positions, struct arena *arena)
{
    return (struct set_values){.figures = ARENA_ARRAY(arena, positions, struct figure),
                               .media = ARENA_ARRAY(arena, positions, struct medium),
                               .stops = ARENA_ARRAY(arena, positions, size_t),
                               .lights = ARENA_ARRAY(arena, positions, struct lens_light),
                               .points = ARENA_ARRAY(arena, positions, struct lens_points)};
}

const char *lens_setting_put(struct lens *lens, enum set_what what, struct parameter parameter,
                             const struct set_values *values, struct arena *arena)
{
    struct lens_setting setting = {.parameter = parameter};
    switch (what) {
    case SET_STOPS:
        return lens_setting_stops(lens, values->stops, arena);
    case SET_LIGHTS:
        return lens_setting_lights(lens, values->lights);
    case SET_POINTS:
        return lens_setting_points(lens, values->points);
    default:
        setting.figures = what == SET_FIGURES ? values->figures : NULL;
        setting.media = what == SET_MEDIA ? values->media : NULL;
        return lens_setting_add(lens, setting, arena);
    }
}

/* The values of all positions, and what speaks against them. */
static bool read_set_values(struct file_words *words, struct text name, enum set_what what,
                            struct parameter parameter, const struct glass_source *glasses,
                            struct lens *lens)
{
    const size_t count = lens->position_count;
    const struct set_values values = lens_setting_values(count, words->arena);
    struct text word;
    bool read = true;
    for (size_t i = 0; i < count && read; i++) {
        if (!next_set_word(words, lens, i, &word)) {
            return false;
        }
        switch (what) {
        case SET_FIGURES:
            read = read_set_number(words, word, parameter, &values.figures[i]);
            break;
        case SET_MEDIA:
            read = lens_words_medium(words, word, &values.media[i]) &&
                   lens_words_glass(words, glasses, &values.media[i]);
            break;
        case SET_STOPS:
            read = read_set_stop(words, word, lens, &values.stops[i]);
            break;
        case SET_LIGHTS:
            read = lens_light_read(words, word, &values.lights[i]);
            break;
        case SET_POINTS:
            read = lens_words_points(words, word, lens->field_kind, &values.points[i]);
            break;
        }
    }
    if (!read || !next_set_word(words, lens, count, &word)) {
        return false;
    }
    const char *why = lens_setting_put(lens, what, parameter, &values, words->arena);
    return why == NULL || file_words_fail(words, name, "%s", why);
}

bool lens_setting_takes(enum parameter_kind kind)
{
    return kind != PARAMETER_INDEX && kind != PARAMETER_ABBE;
}

bool lens_setting_read(struct file_words *words, const struct glass_source *glasses,
                       struct lens *lens)
{
    struct error *error = words->error;
    struct text name = file_words_next(words);
    struct parameter parameter = {0};
    enum set_what what;
    if (lens->position_count == 0) {
        return file_words_fail(words, name, "'set' needs a line with 'position' before it");
    }
    if (lens_setting_is_word(name, &what)) {
        return read_set_values(words, name, what, parameter, glasses, lens);
    }
    if (!parameter_read(name, lens_setting_takes, &parameter, error)) {
        const struct error found = *error;
        file_words_fail(words, name, "%s", found.message);
        return found.hint[0] != '\0' && error_hint(error, "%s", found.hint);
    }
    if (!lens_setting_takes(parameter.kind)) {
        return file_words_fail(words, name,
                               "the positions set a medium as a whole: glass%zu 1.5/60 1.6/40",
                               parameter.surface + 1);
    }
    what = parameter.kind == PARAMETER_GLASS ? SET_MEDIA : SET_FIGURES;
    return read_set_values(words, name, what, parameter, glasses, lens);
}
