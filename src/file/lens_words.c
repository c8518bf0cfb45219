/* file/lens_words.c - the numbers of a .lens file, its fields, wavelengths and media. */
/* SPDX-License-Identifier: MIT */
#include "file/lens_words.h"

#include "base/constants.h"
#include "base/quantity.h"
#include "base/units.h"
#include "data/lines.h"
#include "optics/wavelength.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool lens_words_figure(const struct file_words *words, struct text text, struct number_scale scale,
                       const char *what, struct figure *figure)
{
    const char *end = text.start + text.length;
    *figure = (struct figure){.typed = text, .variable = LENS_NONE};
    const char *behind = text.length > 0 ? pair_read(text.start, end, scale, &figure->value) : NULL;
    if (text.length == 0) {
        return file_words_fail(words, text, "the %s is missing", what);
    }
    if (behind != end) {
        struct text wrong = {behind != NULL ? behind : text.start, 1};
        file_words_fail(words, wrong, "the %s '%.*s' is not a number", what, text_shown(text),
                        text.start);
        return behind != NULL && *behind == ',' &&
               error_hint(words->error, "the decimal separator must be a point");
    }
    return fabs(figure->value.hi) < 1e100 ||
           file_words_fail(words, text, "the %s must be finite and below 1e100", what);
}

struct pair lens_words_per_length(struct pair value, struct number_scale scale, int power)
{
    struct pair unit = {1, 0}, ten = {10, 0};
    for (int i = 0; i < power; i++) {
        unit = pair_multiply(unit, pair_of(scale.multiplier));
        for (int j = 0; j < scale.power; j++) {
            unit = pair_multiply(unit, ten);
        }
        for (int j = 0; j > scale.power; j--) {
            unit = pair_divide(unit, ten);
        }
    }
    return pair_divide(value, unit);
}

bool lens_words_number(const struct file_words *words, struct text text, enum parameter_kind kind,
                       int order, struct figure *figure)
{
    int length = parameter_length(kind, order);
    if (!lens_words_figure(words, text, length == 1 ? words->scale : NUMBER_UNSCALED,
                           parameter_type(kind)->words, figure)) {
        return false;
    }
    if (length < 0) {
        figure->value = lens_words_per_length(figure->value, words->scale, -length);
    }
    if ((parameter_type(kind)->is & PARAMETER_IS_ANGLE) != 0) {
        figure->value = pair_multiply(figure->value, pair_of(RADIANS_PER_DEGREE));
    }
    return true;
}

bool lens_words_parameter(const struct file_words *words, struct text name,
                          bool (*takes)(enum parameter_kind kind), struct parameter *parameter)
{
    struct error *error = words->error;
    if (parameter_read(name, takes, parameter, error)) {
        return true;
    }
    const struct error found = *error;
    file_words_fail(words, name, "%s", found.message);
    return found.hint[0] != '\0' && error_hint(error, "%s", found.hint);
}

bool lens_words_figures(struct file_words *words, struct number_scale scale, const char *what,
                        struct figure **figures, size_t *count)
{
    size_t room = 0;
    *figures = NULL;
    *count = 0;
    for (struct text word = file_words_next(words); word.length > 0 || *count == 0;
         word = file_words_next(words)) {
        if (!lens_words_figure(words, word, scale, what,
                               ARENA_ADD(words->arena, *figures, *count, room))) {
            return false;
        }
    }
    return true;
}

/* x,y:weight with x and weight left out where they are 0 and 1. */
static bool read_field_point(const struct file_words *words, struct text word, enum field_kind kind,
                             struct lens_field *field)
{
    const bool angle = kind == FIELD_ANGLE;
    struct text weight = word, y = text_cut(&weight, ':'), x = text_cut(&y, ',');
    struct figure figure = {.value = {1, 0}};
    const struct text coordinates[2] = {x, y};
    *field = lens_field_none;
    for (int i = 0; i < 2; i++) {
        /* a lone number is y */
        struct text text = y.start != NULL ? coordinates[i] : x;
        if ((i == 1 || y.start != NULL) &&
            !lens_words_figure(words, text, angle ? NUMBER_UNSCALED : words->scale, "field",
                               &field->at[i])) {
            return false;
        }
    }
    if (angle) {
        const char *wrong = lens_field_from_degrees(field);
        if (wrong != NULL) {
            return file_words_fail(words, word, "%s", wrong);
        }
    }
    if (weight.start != NULL &&
        !lens_words_figure(words, weight, NUMBER_UNSCALED, "weight", &figure)) {
        return false;
    }
    if (!(figure.value.hi >= 0)) {
        return file_words_fail(words, weight, "a weight is not below 0");
    }
    field->weight = figure.value.hi;
    field->weight_typed = weight;
    return true;
}

bool lens_words_fields(struct file_words *words, enum field_kind kind, struct lens_field **fields,
                       size_t *count)
{
    size_t room = 0;
    *fields = NULL;
    *count = 0;
    for (struct text word = file_words_next(words); word.length > 0 || *count == 0;
         word = file_words_next(words)) {
        if (!read_field_point(words, word, kind, ARENA_ADD(words->arena, *fields, *count, room))) {
            return false;
        }
    }
    return true;
}

bool lens_words_points(const struct file_words *words, struct text list, enum field_kind kind,
                       struct lens_points *points)
{
    size_t room = 0;
    *points = (struct lens_points){NULL, 0};
    while (list.start != NULL) {
        const struct text word = text_cut(&list, ';');
        if (!read_field_point(words, word, kind,
                              ARENA_ADD(words->arena, points->fields, points->count, room))) {
            return false;
        }
    }
    return true;
}

bool lens_words_wavelength(const struct file_words *words, struct text text, double *wavelength)
{
    static const char *const units[] = {"nm", "um"};
    if (lines_standard(text, wavelength)) {
        return true;
    }
    const char *end = text.start + text.length;
    double bare;
    const char *behind =
        text.length > 0 ? number_read(text.start, end, NUMBER_UNSCALED, &bare) : NULL;
    if (behind == NULL) {
        return file_words_fail(words, text,
                               "'%.*s' is not a wavelength: a line such as d F C, "
                               "or a number with nm or um",
                               text_shown(text), text.start);
    }
    struct text unit = text_between(behind, end);
    for (size_t i = 0; i < sizeof units / sizeof units[0]; i++) {
        if (text_equal(unit, units[i])) {
            number_read(text.start, end, unit_find(&dimension_wavelength_um, unit)->scale,
                        wavelength);
            return (*wavelength >= WAVELENGTH_SHORTEST && *wavelength <= WAVELENGTH_LONGEST) ||
                   file_words_fail(words, text, "the wavelength is not within 1 nm to 100 mm");
        }
    }
    file_words_fail(words, unit,
                    unit.length == 0 ? "the wavelength %.*s has no unit: nm or um"
                                     : "the wavelength %.*s has an unknown unit: nm or um",
                    text_shown(text), text.start);
    return unit.length == 0 && error_hint(words->error, "did you mean '%.*s%s'?", text_shown(text),
                                          text.start, bare < 100 ? "um" : "nm");
}

bool lens_words_light(const struct file_words *words, struct text word,
                      struct lens_wavelength *wavelength)
{
    struct text weight = word, name = text_cut(&weight, ':');
    struct figure figure = {.value = {1, 0}};
    if (!lens_words_wavelength(words, name, &wavelength->wavelength) ||
        (weight.start != NULL &&
         !lens_words_figure(words, weight, NUMBER_UNSCALED, "weight", &figure))) {
        return false;
    }
    if (!(figure.value.hi >= 0)) {
        return file_words_fail(words, weight, "a weight is not below 0");
    }
    wavelength->typed = name;
    wavelength->weight = figure.value.hi;
    wavelength->weight_typed = weight;
    return true;
}

static bool read_point_index(const struct file_words *words, struct text text, const char *what,
                             struct pair *value)
{
    struct figure figure;
    if (!lens_words_figure(words, text, NUMBER_UNSCALED, what, &figure)) {
        return false;
    }
    if (!(figure.value.hi > 0)) {
        return file_words_fail(words, text, "the %s %.*s is not above 0", what, text_shown(text),
                               text.start);
    }
    *value = figure.value;
    return true;
}

static int points_by_wavelength(const void *a, const void *b)
{
    double left = ((const struct index_point *)a)->wavelength;
    double right = ((const struct index_point *)b)->wavelength;
    return (left > right) - (left < right);
}

/* {587.56nm 1.5168, F 1.5224} */
static bool read_table(const struct file_words *words, struct text text, struct medium *medium)
{
    if (text.length < 2 || text.start[text.length - 1] != '}') {
        return file_words_fail(words, text, "the table of indices does not end with '}'");
    }
    struct text rest = {text.start + 1, text.length - 2};
    size_t most = 1;
    for (size_t i = 0; i < rest.length; i++) {
        most += rest.start[i] == ',';
    }
    struct index_point *points = ARENA_ARRAY(words->arena, most, struct index_point);
    size_t count = 0;
    while (rest.start != NULL) {
        struct text entry = text_trim(text_cut(&rest, ','));
        struct text index = entry, name = text_cut(&index, ' ');
        index = index.start != NULL
                    ? text_trim(index)
                    : text_between(name.start + name.length, name.start + name.length);
        if (!lens_words_wavelength(words, name, &points[count].wavelength) ||
            !read_point_index(words, index, "index", &points[count].index)) {
            return false;
        }
        count++;
    }
    qsort(points, count, sizeof points[0], points_by_wavelength);
    for (size_t i = 1; i < count; i++) {
        if (!(points[i].wavelength > points[i - 1].wavelength)) {
            return file_words_fail(words, text, "the table has one wavelength twice");
        }
    }
    medium->kind = MEDIUM_TABLE;
    medium->points = points;
    medium->point_count = count;
    return true;
}

bool lens_words_medium(const struct file_words *words, struct text text, struct medium *medium)
{
    *medium = (struct medium){.kind = MEDIUM_GLASS, .written = text, .index = {1, 0}};
    if (text.length == 0) {
        return file_words_fail(words, text, "the medium is missing");
    }
    if (text.start[0] == '{') {
        return read_table(words, text, medium);
    }
    if (text_equal(text, "air")) {
        medium->kind = MEDIUM_CONSTANT;
        return true;
    }
    const bool is_number = text.start[0] != '\0' && strchr("0123456789.+-", text.start[0]) != NULL;
    if (!is_number) {
        /* marks hold words together that are read apart when the name is written again */
        for (size_t i = 0; i < text.length; i++) {
            if (text.start[i] == '"' || text.start[i] == '{') {
                return file_words_fail(words, (struct text){text.start + i, 1},
                                       "the name of a glass has no '%c'", text.start[i]);
            }
        }
        return true;
    }
    struct text abbe = text, index = text_cut(&abbe, '/');
    medium->kind = abbe.start != NULL ? MEDIUM_MODEL : MEDIUM_CONSTANT;
    return read_point_index(words, index, "index", &medium->index) &&
           (abbe.start == NULL || read_point_index(words, abbe, "Abbe number", &medium->abbe));
}

bool lens_words_vector(const struct file_words *words, struct text text,
                       const struct vector_form *form, struct figure *figures)
{
    struct text rest = text;
    for (size_t i = 0; i < form->count && rest.start != NULL; i++) {
        if (!lens_words_figure(words, text_cut(&rest, ','), form->scale, form->what, &figures[i])) {
            return false;
        }
        if (form->factor != 0) {
            figures[i].value = pair_multiply(figures[i].value, pair_of(form->factor));
        }
    }
    return rest.start == NULL || file_words_fail(words, rest, "the %s has more than %zu numbers",
                                                 form->what, form->count);
}
