/* file/lens_surface.c - one surface line of a .lens file. */
/* SPDX-License-Identifier: MIT */
#include "file/lens_surface.h"

#include "base/constants.h"
#include "file/lens_mark.h"
#include "file/lens_words.h"

#include <string.h>

/* A surface being read: the displacement and the marks live in the arena once there is one. */
struct surface_reader {
    struct file_words *words;
    struct surface *surface;
    struct displacement *decentre;
    struct vary *varies;
    struct lens_variables *variables;
    bool stops;    /* the word stop stands there already */
    unsigned seen; /* bit i: extras[i] stands there already */
};

size_t lens_variable_find(struct lens_variables *variables, const struct file_words *words,
                          struct text name)
{
    struct lens *lens = variables->lens;
    for (size_t i = 0; i < lens->variable_count; i++) {
        if (text_identical(lens->variables[i].name, name)) {
            return i;
        }
    }
    size_t room = variables->room;
    lens->variables = arena_grow(words->arena, lens->variables, lens->variable_count,
                                 &variables->room, sizeof lens->variables[0]);
    variables->lines = arena_grow(words->arena, variables->lines, lens->variable_count, &room,
                                  sizeof variables->lines[0]);
    lens->variables[lens->variable_count] = (struct lens_variable){.name = name};
    variables->lines[lens->variable_count] = *words;
    return lens->variable_count++;
}

static bool is_name_word(struct text text)
{
    char c = text.length > 0 ? text.start[0] : '\0';
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

static bool read_radius(struct file_words *words, struct surface *surface)
{
    struct text word = file_words_next(words);
    surface->is_plane =
        text_equal(word, "-") || text_equal(word, "inf") || text_equal(word, "-inf");
    surface->radius = (struct figure){.typed = word, .variable = LENS_NONE};
    if (surface->is_plane) {
        return true;
    }
    if (!lens_words_figure(words, word, words->scale, "radius", &surface->radius)) {
        return false;
    }
    return surface->radius.value.hi != 0 ||
           file_words_fail(words, word, "the radius is 0: a plane is '-' or 'inf'");
}

/* A length, or the name of a variable, or '-' for none. */
static bool read_gap_cell(struct file_words *words, const char *what,
                          struct lens_variables *variables, struct figure *figure, bool *is_given)
{
    struct text word = file_words_next(words);
    *figure = (struct figure){.typed = word, .variable = LENS_NONE};
    *is_given = !text_equal(word, "-");
    if (!*is_given) {
        return true;
    }
    if (is_name_word(word) && !text_equal(word, "inf")) {
        figure->variable = lens_variable_find(variables, words, word);
        return true;
    }
    return lens_words_figure(words, word, words->scale, what, figure) ||
           (word.length == 0 &&
            error_hint(words->error,
                       "a surface is: radius thickness medium diameter; '-' where there is "
                       "none"));
}

/* A curvature or a coefficient was read as a plain number. */
static bool rescale(const struct file_words *words, int power, struct figure *figure)
{
    figure->value = lens_words_per_length(figure->value, words->scale, power);
    return true;
}

static bool read_curvature(struct surface_reader *reading, struct text value)
{
    struct surface *surface = reading->surface;
    if (!surface->is_plane) {
        return file_words_fail(reading->words, value,
                               "a curvature beside a radius: the radius must be '-'");
    }
    surface->has_curvature = true;
    return lens_words_figure(reading->words, value, NUMBER_UNSCALED, "curvature",
                             &surface->curvature) &&
           rescale(reading->words, 1, &surface->curvature);
}

static bool read_conic(struct surface_reader *reading, struct text value)
{
    return lens_words_figure(reading->words, value, NUMBER_UNSCALED, "conic",
                             &reading->surface->conic);
}

static struct displacement *own_displacement(struct surface_reader *reading)
{
    if (reading->decentre == NULL) {
        reading->decentre = ARENA_NEW(reading->words->arena, struct displacement);
        *reading->decentre = displacement_none;
        reading->surface->decentre = reading->decentre;
    }
    return reading->decentre;
}

static bool read_decenter(struct surface_reader *reading, struct text value)
{
    const struct vector_form form = {"decentre", 2, reading->words->scale, 0};
    return lens_words_vector(reading->words, value, &form, own_displacement(reading)->decenter);
}

static bool read_tilt(struct surface_reader *reading, struct text value)
{
    const struct vector_form form = {"tilt", 2, NUMBER_UNSCALED, RADIANS_PER_DEGREE};
    return lens_words_vector(reading->words, value, &form, own_displacement(reading)->tilt);
}

static bool read_cylinder(struct surface_reader *reading, struct text value)
{
    for (size_t i = 0; i < sizeof surface_sections / sizeof surface_sections[0]; i++) {
        const char *word = surface_sections[i].word;
        if (word != NULL && text_equal(value, word)) {
            reading->surface->curved = (enum curved)i;
            return true;
        }
    }
    return file_words_fail(reading->words, value, "a cylinder is cyl=x or cyl=y");
}

static bool read_quoted_name(struct surface_reader *reading, struct text value)
{
    bool quoted = value.length >= 2 && value.start[0] == '"';
    if (quoted && value.start[value.length - 1] != '"') {
        return file_words_fail(reading->words, value, "the name does not end with '\"'");
    }
    size_t cut = quoted ? 1 : 0;
    const char *mark = memchr(value.start + cut, '"', value.length - 2 * cut);
    if (mark != NULL) {
        return file_words_fail(reading->words, (struct text){mark, 1},
                               "a name has no quotation marks within");
    }
    reading->surface->name =
        arena_string(reading->words->arena, value.start + cut, value.length - 2 * cut);
    return true;
}

static bool read_hiatus(struct surface_reader *reading, struct text value)
{
    struct surface *surface = reading->surface;
    if (is_name_word(value)) {
        surface->hiatus = (struct figure){
            .typed = value,
            .variable = lens_variable_find(reading->variables, reading->words, value)};
        return true;
    }
    return lens_words_figure(reading->words, value, reading->words->scale, "hiatus",
                             &surface->hiatus);
}

static bool read_distortion(struct surface_reader *reading, struct text value)
{
    const struct vector_form form = {"distortion", 3, NUMBER_UNSCALED, 0};
    return lens_words_vector(reading->words, value, &form, reading->surface->distortion);
}

/* What may stand behind the diameter, and what a surface must have for it: 0 is nothing. */
static const struct {
    const char *key;
    bool (*read)(struct surface_reader *reading, struct text value);
    unsigned of;
} extras[] = {{"c", read_curvature, SURFACE_HAS_CURVE},
              {"k", read_conic, SURFACE_HAS_CURVE},
              {"decenter", read_decenter, 0},
              {"tilt", read_tilt, 0},
              {"cyl", read_cylinder, SURFACE_HAS_CURVE},
              {"name", read_quoted_name, 0},
              {"hiatus", read_hiatus, SURFACE_HAS_FOCAL},
              {"distortion", read_distortion, SURFACE_HAS_FOCAL}};

static bool refuse_twice(const struct file_words *words, struct text word, struct text key,
                         const char *sign)
{
    return file_words_fail(words, word, "'%.*s%s' is there twice", text_shown(key), key.start,
                           sign);
}

static bool read_coefficient(struct surface_reader *reading, int order, struct text value)
{
    struct figure figure = {.variable = LENS_NONE};
    if (!lens_words_figure(reading->words, value, NUMBER_UNSCALED, "coefficient", &figure)) {
        return false;
    }
    rescale(reading->words, order - 1, &figure);
    parameter_put(reading->surface, PARAMETER_COEFFICIENT, order, figure, reading->words->arena);
    return true;
}

/* R~, t~[2,10], glass~ */
static bool read_vary(struct surface_reader *reading, struct text what, struct text bounds)
{
    struct surface *surface = reading->surface;
    struct file_words *words = reading->words;
    struct vary vary = {.place = file_words_place(words, what)};
    if (!parameter_name_read(what, &vary.kind, &vary.order) ||
        !parameter_is_mark(vary.kind, surface)) {
        return file_words_fail(words, what, "'%.*s~' cannot vary: %s", text_shown_up_to(what, 20),
                               what.start, parameter_marks(surface, words->arena));
    }
    if (parameter_is_marked(vary.kind, vary.order, surface)) {
        return refuse_twice(words, what, what, "~");
    }
    if (surface->vary_count == PARAMETER_MOST_MARKS) {
        return file_words_fail(words, what, "more than %d marks", PARAMETER_MOST_MARKS);
    }
    if (reading->varies == NULL) {
        reading->varies = ARENA_ARRAY(words->arena, PARAMETER_MOST_MARKS, struct vary);
        surface->varies = reading->varies;
    }
    if (!lens_bounds_read(words, bounds, &vary)) {
        return false;
    }
    reading->varies[surface->vary_count++] = vary;
    return true;
}

/* Not a word of a surface: one of the table may have been meant. */
static bool refuse_extra(struct surface_reader *reading, struct text word, struct text key)
{
    struct nearest nearest = {.typed = key};
    for (size_t i = 0; i < sizeof extras / sizeof extras[0]; i++) {
        if (extras[i].of == 0 || surface_has(reading->surface, extras[i].of)) {
            nearest_offer(&nearest, text_of(extras[i].key));
        }
    }
    file_words_fail(reading->words, word, "unknown word '%.*s' after the diameter",
                    text_shown_up_to(word, 40), word.start);
    return nearest.best.start != NULL && error_hint(reading->words->error, "did you mean '%.*s='?",
                                                    (int)nearest.best.length, nearest.best.start);
}

/* The row of extras that the surface may have; their number if there is none. */
static size_t find_extra(const struct surface *surface, struct text key)
{
    size_t i = 0, count = sizeof extras / sizeof extras[0];
    while (i < count && !(text_equal(key, extras[i].key) &&
                          (extras[i].of == 0 || surface_has(surface, extras[i].of)))) {
        i++;
    }
    return i;
}

/* A word behind the diameter: stop, a mark (R~), or key=value. */
static bool read_extra(struct surface_reader *reading, struct text word)
{
    struct text value = word, key = text_cut(&value, '=');
    const char *tilde = memchr(word.start, '~', word.length);
    if (value.start == NULL && text_equal(word, "stop")) {
        bool again = reading->stops;
        reading->stops = reading->surface->is_stop = true;
        return !again || refuse_twice(reading->words, word, word, "");
    }
    if (tilde != NULL && (value.start == NULL || tilde < value.start)) {
        return read_vary(reading, text_between(word.start, tilde),
                         text_between(tilde + 1, word.start + word.length));
    }
    if (value.start == NULL) {
        return refuse_extra(reading, word, key);
    }
    size_t i = find_extra(reading->surface, key);
    if (i < sizeof extras / sizeof extras[0]) {
        if ((reading->seen & 1u << i) != 0) {
            return refuse_twice(reading->words, word, key, "=");
        }
        reading->seen |= 1u << i;
        return extras[i].read(reading, value);
    }
    enum parameter_kind kind;
    int order;
    if (!parameter_name_read(key, &kind, &order) || kind != PARAMETER_COEFFICIENT ||
        !parameter_suits(kind, reading->surface)) {
        return refuse_extra(reading, word, key);
    }
    return parameter_figure(reading->surface, kind, order) != NULL
               ? refuse_twice(reading->words, word, key, "=")
               : read_coefficient(reading, order, value);
}

static bool read_surface_glass(struct file_words *words, const struct medium *before,
                               struct surface *surface)
{
    struct text word = file_words_next(words);
    if (!text_equal(word, "mirror")) {
        return lens_words_medium(words, word, &surface->medium);
    }
    if (!surface_has(surface, SURFACE_MAY_MIRROR)) {
        return file_words_fail(words, word,
                               surface_has(surface, SURFACE_HAS_FOCAL)
                                   ? "a thick lens is not a mirror"
                                   : "a stop that is a mirror: write it as a surface "
                                     "with the word stop behind its diameter");
    }
    surface->kind = SURFACE_REFLECT;
    surface->medium = *before;
    return true;
}

/* The cell in place of the radius: a number or a variable, not 0. */
static bool read_focal(struct file_words *words, struct lens_variables *variables,
                       struct surface *surface)
{
    bool is_given;
    surface->is_plane = true;
    surface->radius = (struct figure){.variable = LENS_NONE};
    if (!read_gap_cell(words, "focal length", variables, &surface->focal, &is_given)) {
        return false;
    }
    bool is_number = surface->focal.variable == LENS_NONE;
    return (is_given && !(is_number && surface->focal.value.hi == 0)) ||
           file_words_fail(words, surface->focal.typed,
                           "a thick lens has a focal length other than 0");
}

static bool is_at_end(struct file_words *words)
{
    const char *at = words->at;
    const bool is = file_words_next(words).length == 0;
    words->at = at;
    return is;
}

/* Thickness, medium and diameter; an ideal lens may end before any of them. */
static bool read_cells(struct file_words *words, const struct medium *before,
                       struct lens_variables *variables, struct surface *surface)
{
    const bool may_end = surface_has(surface, SURFACE_HAS_FOCAL);
    surface->thickness.variable = surface->diameter.variable = LENS_NONE;
    surface->medium = *before;
    if (may_end && is_at_end(words)) {
        return true;
    }
    if (!read_gap_cell(words, "thickness", variables, &surface->thickness,
                       &surface->has_thickness)) {
        return false;
    }
    if (may_end && is_at_end(words)) {
        return true;
    }
    if (!read_surface_glass(words, before, surface)) {
        return false;
    }
    return (may_end && is_at_end(words)) ||
           read_gap_cell(words, "diameter", variables, &surface->diameter, &surface->has_diameter);
}

bool lens_surface_read(struct file_words *words, enum surface_kind kind,
                       const struct medium *before, struct lens_variables *variables,
                       struct surface *surface)
{
    struct surface_reader reading = {.words = words, .surface = surface, .variables = variables};
    bool is_stop = kind == SURFACE_STOP;
    *surface = (struct surface){.kind = kind, .is_stop = is_stop};
    surface->curvature.variable = surface->conic.variable = LENS_NONE;
    surface->focal.variable = surface->hiatus.variable = LENS_NONE;
    for (int i = 0; i < LENS_COEFFICIENTS; i++) {
        surface->coefficient[i].variable = LENS_NONE;
    }
    if (surface_has(surface, SURFACE_HAS_FOCAL) ? !read_focal(words, variables, surface)
                                                : !read_radius(words, surface)) {
        return false;
    }
    if (is_stop && !surface->is_plane) {
        return file_words_fail(words, surface->radius.typed,
                               "a stop is a plane: for a stop on glass put the word stop behind "
                               "the diameter of its surface");
    }
    if (!read_cells(words, before, variables, surface)) {
        return false;
    }
    if (surface->has_diameter && surface->diameter.variable == LENS_NONE &&
        !(surface->diameter.value.hi > 0)) {
        return file_words_fail(words, surface->diameter.typed, "the diameter must be above 0");
    }
    for (struct text word = file_words_next(words); word.length > 0;
         word = file_words_next(words)) {
        if (!read_extra(&reading, word)) {
            return false;
        }
    }
    return true;
}

bool lens_coordinate_break_read(struct file_words *words,
                                const struct displacement **coordinate_break)
{
    struct displacement *all = ARENA_NEW(words->arena, struct displacement);
    bool has_decenter = false, has_tilt = false;
    *all = displacement_none;
    for (struct text word = file_words_next(words); word.length > 0;
         word = file_words_next(words)) {
        struct text value = word, key = text_cut(&value, '=');
        bool decenter = text_equal(key, "decenter"), tilt = text_equal(key, "tilt");
        if (value.start == NULL || (!decenter && !tilt)) {
            return file_words_fail(words, word,
                                   "a coordinate break has decenter=x,y and tilt=ax,ay,az");
        }
        bool *seen = decenter ? &has_decenter : &has_tilt;
        if (*seen) {
            return refuse_twice(words, word, key, "=");
        }
        *seen = true;
        const struct vector_form shift = {"decentre", 2, words->scale, 0};
        const struct vector_form turn = {"tilt", 3, NUMBER_UNSCALED, RADIANS_PER_DEGREE};
        bool read = decenter ? lens_words_vector(words, value, &shift, all->decenter)
                             : lens_words_vector(words, value, &turn, all->tilt);
        if (!read) {
            return false;
        }
    }
    *coordinate_break = all;
    return true;
}
