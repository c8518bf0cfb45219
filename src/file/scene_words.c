/* file/scene_words.c - one line of a .scene file: key=value words, each read as its kind. */
/* SPDX-License-Identifier: MIT */
#include "file/scene_reader.h"

#include "base/constants.h"
#include "base/quantity.h"

#include <math.h>
#include <string.h>

static const struct unit candelas[] = {
    {"cd", "cd", {1, 0}, 1, "candela", "candela"},
    {"kcd", "kcd", {1, 3}, 1, NULL, "kilocandela"},
    {"mcd", "mcd", {1, -3}, 1, NULL, "millicandela"},
};
static const struct dimension intensity = {.name = "luminous intensity",
                                           .units = candelas,
                                           .unit_count = sizeof candelas / sizeof candelas[0]};
static const struct unit lumens[] = {
    {"lm", "lm", {1, 0}, 1, "lumen", "lumen"},
    {"klm", "klm", {1, 3}, 1, NULL, "kilolumen"},
    {"mlm", "mlm", {1, -3}, 1, NULL, "millilumen"},
};
static const struct dimension flux = {
    .name = "luminous flux", .units = lumens, .unit_count = sizeof lumens / sizeof lumens[0]};

/* A million km, the speed of light, and what no lamp exceeds. */
#define FARTHEST  1e12
#define SMALLEST  1e-6
#define FASTEST   299792458e3
#define BRIGHTEST 1e15
#define DARKEST   1e-15

static const struct scene_words_form {
    const char *name;
    const struct dimension *dimension; /* null: a text */
    size_t least, most;                /* numbers */
    double low, high;
    const char *range;
} forms[SCENE_KEYS] = {
    [KEY_AT] = {"at", &dimension_length, 3, 3, -FARTHEST, FARTHEST, "-1e9 m to 1e9 m"},
    [KEY_LOOK] = {"look", &dimension_length, 3, 3, -FARTHEST, FARTHEST, "-1e9 m to 1e9 m"},
    [KEY_UP] = {"up", &dimension_number, 3, 3, -1e9, 1e9, "-1e9 to 1e9"},
    [KEY_NORMAL] = {"normal", &dimension_number, 3, 3, -1e9, 1e9, "-1e9 to 1e9"},
    [KEY_TURN] = {"turn", &dimension_angle, 3, 3, -100, 100, "-5729 deg to 5729 deg"},
    [KEY_MOVE] = {"move", &dimension_speed, 3, 3, -FASTEST, FASTEST,
                  "-299792458 m/s to 299792458 m/s"},
    [KEY_SPIN] = {"spin", &dimension_rotation, 1, 1, -5e7 * RADIANS_PER_DEGREE,
                  5e7 * RADIANS_PER_DEGREE, "-5e7 deg/s to 5e7 deg/s"},
    [KEY_AXIS] = {"axis", &dimension_number, 3, 3, -1e9, 1e9, "-1e9 to 1e9"},
    [KEY_FOCUS] = {"focus", &dimension_length, 1, 1, SMALLEST, INFINITY, "1 nm to inf"},
    [KEY_FROM] = {.name = "from"},
    [KEY_RADIUS] = {"radius", &dimension_length, 1, 1, SMALLEST, FARTHEST, "1 nm to 1e9 m"},
    [KEY_SIZE] = {"size", &dimension_length, 1, 3, SMALLEST, FARTHEST, "1 nm to 1e9 m"},
    [KEY_REPEAT] = {"repeat", &dimension_length, 1, 1, SMALLEST, FARTHEST, "1 nm to 1e9 m"},
    [KEY_SCALE] = {"scale", &dimension_number, 1, 1, 1e-9, 1e9, "1e-9 to 1e9"},
    [KEY_RGB] = {.name = "rgb"},
    [KEY_SRGB] = {.name = "srgb"},
    [KEY_SPECTRUM] = {.name = "spectrum"},
    [KEY_TABLE] = {.name = "table"},
    [KEY_COLOUR] = {.name = "colour"},
    [KEY_TEXTURE] = {.name = "texture"},
    [KEY_ROUGHNESS] = {"roughness", &dimension_number, 1, 1, 0.001, 1, "0.001 to 1"},
    [KEY_INDEX] = {"index", &dimension_number, 1, 1, 1, 3, "1 to 3"},
    [KEY_EMISSION] = {.name = "emission"},
    [KEY_LUMINANCE] = {"luminance", &dimension_luminance, 1, 1, DARKEST, BRIGHTEST,
                       "1e-15 cd/m2 to 1e15 cd/m2"},
    [KEY_MATERIAL] = {.name = "material"},
    [KEY_FILE] = {.name = "file"},
    [KEY_ILLUMINANCE] = {"illuminance", &dimension_illuminance, 1, 1, DARKEST, BRIGHTEST,
                         "1e-15 lx to 1e15 lx"},
    [KEY_INTENSITY] = {"intensity", &intensity, 1, 1, DARKEST, BRIGHTEST, "1e-15 cd to 1e15 cd"},
    [KEY_POWER] = {"power", &flux, 1, 1, DARKEST, BRIGHTEST, "1e-15 lm to 1e15 lm"},
    [KEY_MAGNITUDE] = {"magnitude", &dimension_number, 1, 1, -30, 40, "-30 to 40"},
    [KEY_DIAMETER] = {"diameter", &dimension_angle, 1, 1, 1e-5 * RADIANS_PER_DEGREE,
                      177 * RADIANS_PER_DEGREE, "1e-5 deg to 177 deg"},
    [KEY_TOWARDS] = {"towards", &dimension_number, 3, 3, -1e9, 1e9, "-1e9 to 1e9"},
    [KEY_ELEVATION] = {"elevation", &dimension_angle, 1, 1, -1.5707963267948968, 1.5707963267948968,
                       "-90 deg to 90 deg"},
    [KEY_AZIMUTH] = {"azimuth", &dimension_angle, 1, 1, -100, 100, "-5729 deg to 5729 deg"},
};

static const struct unit *bare_scene_unit(const struct scene_units *units,
                                          const struct dimension *dimension)
{
    if (dimension == &dimension_length) {
        return &units->length;
    }
    if (dimension == &dimension_speed) {
        return &units->speed;
    }
    if (dimension == &dimension_angle) {
        return unit_find(dimension, text_of("deg"));
    }
    if (dimension == &dimension_rotation) {
        return unit_find(dimension, text_of("deg/s"));
    }
    return NULL;
}

bool scene_word_fail(const struct file_words *words, struct text word, const struct nearest *meant,
                     const char *what)
{
    file_words_fail(words, word, "%s '%.*s'", what, text_shown(word), word.start);
    return meant->best.start != NULL && error_hint(words->error, "did you mean '%.*s'?",
                                                   (int)meant->best.length, meant->best.start);
}

bool scene_name_check(const struct file_words *words, const struct name_table *index,
                      struct text name, const char *what)
{
    const char first = name.length > 0 ? name.start[0] : '\0';
    if (name.length == 0) {
        return file_words_fail(words, name, "%s needs a name", what);
    }
    if (char_is_digit(first) || strchr("#.+-", first) != NULL ||
        memchr(name.start, '=', name.length) != NULL ||
        memchr(name.start, '"', name.length) != NULL) {
        return file_words_fail(words, name,
                               "'%.*s' cannot be a name: it begins as a number or a colour does, "
                               "or has '=' or a quotation mark",
                               text_shown(name), name.start);
    }
    return name_table_find(index, name) == NAME_NONE ||
           file_words_fail(words, name, "'%.*s' is there twice", text_shown(name), name.start);
}

/* One number of a value; `text` is a part of the line. */
static bool read_scene_number(const struct scene_line *line, const struct scene_words_form *form,
                              struct text text, const struct unit *unit, double *value)
{
    enum { LONGEST = 60 }; /* what messages show whole, so that carets are counted from its start */
    struct error found;
    if (text.length > LONGEST) {
        return file_words_fail(line->words, text, "%s= has a number of %zu letters", form->name,
                               text.length);
    }
    if (text.length == 0) {
        return file_words_fail(line->words, text, "a number of %s= is missing", form->name);
    }
    if (!quantity_read(text, form->dimension, unit, value, NULL, &found)) {
        const size_t caret = found.caret > 0 ? (size_t)found.caret - 1 : 0;
        const struct text wrong = {text.start + (caret < text.length ? caret : text.length), 1};
        file_words_fail(line->words, wrong, "%s=: %s", form->name, found.message);
        return found.hint[0] != '\0' && error_hint(line->words->error, "%s", found.hint);
    }
    return (*value >= form->low && *value <= form->high) ||
           file_words_fail(line->words, text, "%s=%.*s is not within %s", form->name,
                           text_shown(text), text.start, form->range);
}

static bool read_scene_numbers(const struct scene_units *units, enum scene_key key,
                               struct scene_line *line)
{
    const struct scene_words_form *form = &forms[key];
    const struct unit *unit = bare_scene_unit(units, form->dimension);
    struct text rest = line->value[key];
    for (size_t i = 0; rest.start != NULL; i++) {
        const struct text part = text_cut(&rest, ',');
        if (i == form->most) {
            return file_words_fail(line->words, part, "%s= has more than %zu number%s", form->name,
                                   form->most, form->most == 1 ? "" : "s");
        }
        if (!read_scene_number(line, form, part, unit, &line->number[key][i])) {
            return false;
        }
        line->count[key] = i + 1;
    }
    return line->count[key] >= form->least ||
           file_words_fail(line->words, line->value[key],
                           "%s= needs %zu numbers with commas between, and has %zu", form->name,
                           form->least, line->count[key]);
}

/* Not a key of such a line. */
static bool scene_words_refuse(const struct scene_line *line, struct text word, uint64_t allowed)
{
    struct text rest = word;
    const struct text name = text_cut(&rest, '=');
    struct nearest nearest = {.typed = name};
    for (size_t i = 0; i < SCENE_KEYS; i++) {
        if (text_equal(name, forms[i].name) && (allowed & SCENE_BIT(i)) != 0) {
            return file_words_fail(line->words, word, "%s= has no value", forms[i].name);
        }
        if (text_equal(name, forms[i].name)) {
            return file_words_fail(line->words, word, "'%s=' does not belong to '%.*s'",
                                   forms[i].name, text_shown(line->head), line->head.start);
        }
        if ((allowed & SCENE_BIT(i)) != 0) {
            nearest_offer(&nearest, text_of(forms[i].name));
        }
    }
    file_words_fail(line->words, word, "unknown word '%.*s'", text_shown(word), word.start);
    return nearest.best.start != NULL && error_hint(line->words->error, "did you mean '%.*s='?",
                                                    (int)nearest.best.length, nearest.best.start);
}

/* Take the quotation marks off a value: all of it stands between them, or it has none. */
static bool take_quotes(const struct scene_line *line, struct text *value)
{
    size_t marks = 0;
    for (size_t i = 0; i < value->length; i++) {
        marks += value->start[i] == '"';
    }
    if (marks == 0) {
        return true;
    }
    if (marks != 2 || value->start[0] != '"' || value->start[value->length - 1] != '"') {
        return file_words_fail(line->words, *value,
                               "quotation marks stand around a whole value, as \"a name\"");
    }
    *value = (struct text){value->start + 1, value->length - 2};
    return true;
}

static bool read_scene_word(const struct scene_units *units, struct text word, uint64_t allowed,
                            struct scene_line *line)
{
    struct text value = word;
    const struct text name = text_cut(&value, '=');
    size_t key = 0;
    while (key < SCENE_KEYS &&
           !((allowed & SCENE_BIT(key)) != 0 && text_equal(name, forms[key].name))) {
        key++;
    }
    if (key == SCENE_KEYS || value.start == NULL) {
        return scene_words_refuse(line, word, allowed);
    }
    if (scene_line_has(line, (enum scene_key)key)) {
        return file_words_fail(line->words, word, "'%s=' is there twice", forms[key].name);
    }
    if (!take_quotes(line, &value)) {
        return false;
    }
    if (value.length == 0) {
        return file_words_fail(line->words, value, "%s= has no value", forms[key].name);
    }
    line->given |= SCENE_BIT(key);
    line->value[key] = value;
    return forms[key].dimension == NULL || read_scene_numbers(units, (enum scene_key)key, line);
}

bool scene_line_read(struct file_words *words, const struct scene_units *units, struct text head,
                     struct scene_keys keys, struct scene_line *line)
{
    *line = (struct scene_line){.words = words, .head = head};
    for (struct text word = file_words_next(words); word.length > 0;
         word = file_words_next(words)) {
        if (!read_scene_word(units, word, keys.allowed, line)) {
            return false;
        }
    }
    for (size_t i = 0; i < SCENE_KEYS; i++) {
        if ((keys.needed & ~line->given & SCENE_BIT(i)) != 0) {
            return file_words_fail(words, head, "'%.*s' lacks %s=", text_shown(head), head.start,
                                   forms[i].name);
        }
    }
    return true;
}

bool scene_line_direction(const struct scene_line *line, enum scene_key key, struct vector *way)
{
    *way = scene_line_vector(line, key);
    const double length = vector_length(*way);
    if (!(length >= 1e-9)) {
        return scene_line_fail(line, key, "%s= is a direction, and has no length", forms[key].name);
    }
    *way = vector_times(1 / length, *way);
    return true;
}
