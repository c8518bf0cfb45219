/* file/scene_colour.c - colours of a scene: of surfaces and of light. */
/* SPDX-License-Identifier: MIT */
#include "base/image/srgb.h"
#include "base/quantity.h"
#include "file/scene_reader.h"
#include "light/illuminant.h"

#include <string.h>

enum { PARTS = 3 };
#define BRIGHTEST 1e9

/* #rrggbb, as sRGB encodes it. */
static bool read_code(const struct file_words *words, struct text text, struct spectrum *spectrum)
{
    enum { DIGITS = 6, HIGHEST = 255 };
    int code[DIGITS] = {0};
    bool is_code = text.length == DIGITS + 1 && text.start[0] == '#';
    for (size_t i = 0; i < DIGITS && is_code; i++) {
        code[i] = text_hex_digit(text.start[i + 1]);
        is_code = code[i] >= 0;
    }
    if (!is_code) {
        return file_words_fail(words, text,
                               "'%.*s' is no colour of sRGB: '#' and six digits, as #4080c0",
                               text_shown(text), text.start);
    }
    spectrum->kind = SPECTRUM_RGB;
    for (size_t i = 0; i < PARTS; i++) {
        spectrum->rgb[i] = srgb_light((16 * code[2 * i] + code[2 * i + 1]) / (double)HIGHEST);
    }
    return true;
}

/* One number is a grey. */
static bool read_parts(const struct file_words *words, struct text text, struct spectrum *spectrum)
{
    struct text rest = text;
    size_t count = 0;
    spectrum->kind = SPECTRUM_RGB;
    for (; rest.start != NULL && count < PARTS; count++) {
        const struct text part = text_cut(&rest, ',');
        struct error found;
        if (!quantity_read(part, &dimension_number, NULL, &spectrum->rgb[count], NULL, &found)) {
            return file_words_fail(words, part, "'%.*s' is no part of a colour: %s",
                                   text_shown(part), part.start, found.message);
        }
        if (!(spectrum->rgb[count] >= 0 && spectrum->rgb[count] <= BRIGHTEST)) {
            return file_words_fail(words, part, "%.*s is no part of a colour: these are 0 to 1e9",
                                   text_shown(part), part.start);
        }
    }
    if (rest.start != NULL || (count != 1 && count != PARTS)) {
        return file_words_fail(words, text,
                               "a colour is one number, a grey, or red, green and blue");
    }
    for (size_t i = count; i < PARTS; i++) {
        spectrum->rgb[i] = spectrum->rgb[0];
    }
    return true;
}

static double largest(const struct spectrum *spectrum)
{
    const bool is_table = spectrum->kind == SPECTRUM_TABLE;
    const double *values = is_table ? spectrum->value : spectrum->rgb;
    double most = 0;
    for (size_t i = 0; i < (is_table ? spectrum->count : PARTS); i++) {
        most = values[i] > most ? values[i] : most;
    }
    return most;
}

/* May a surface reflect this, or a lamp give it? */
static bool check_colour_use(const struct file_words *words, struct text text,
                             enum scene_colour_use use, const struct scene_colour *colour)
{
    const struct spectrum *spectrum = &colour->spectrum;
    const bool has_numbers = spectrum->kind == SPECTRUM_RGB || spectrum->kind == SPECTRUM_TABLE;
    if (use == COLOUR_OF_SURFACE && colour->is_light) {
        return file_words_fail(words, text,
                               "'%.*s' is the colour of a light, not that of a surface",
                               text_shown(text), text.start);
    }
    if (use == COLOUR_OF_SURFACE && !(largest(spectrum) <= 1)) {
        return file_words_fail(words, text,
                               "a surface reflects at most 1 of the light, and '%.*s' says %.4g",
                               text_shown(text), text.start, largest(spectrum));
    }
    if (use == COLOUR_OF_LIGHT && has_numbers && !(largest(spectrum) > 0)) {
        return file_words_fail(words, text, "light without any colour is dark");
    }
    return true;
}

/* Of a line above, or a light that is known. */
static bool colour_named(const struct scene_reader *reader, struct text name,
                         enum scene_colour_use use, struct scene_colour *colour)
{
    const size_t found = name_table_find(&reader->colours, name);
    struct error unknown;
    if (found != NAME_NONE) {
        *colour = reader->spectra[found];
        return true;
    }
    if (spectrum_named(name, &colour->spectrum, &unknown)) {
        colour->is_light = true;
        return true;
    }
    struct nearest nearest = {.typed = name};
    for (size_t i = 0; i < reader->colours.count; i++) {
        nearest_offer(&nearest, reader->colours.names[i]);
    }
    if (use == COLOUR_OF_SURFACE || nearest.best.start != NULL) {
        return scene_word_fail(&reader->words, name, &nearest, "no line above has the colour");
    }
    file_words_fail(&reader->words, name, "%s", unknown.message);
    return unknown.hint[0] != '\0' && error_hint(reader->words.error, "%s", unknown.hint);
}

/* "0.5" and "0.2,0.5,0.1", but not "5600K". */
static bool is_colour_number(struct text text)
{
    const char last = text.start[text.length - 1];
    return strchr("0123456789.+-", text.start[0]) != NULL && last != 'K';
}

/* Any grey is white light, and who writes a number above 1 means something else by it. */
static bool check_grey_parts(const struct file_words *words, struct text text,
                             const struct spectrum *spectrum)
{
    const double least_kelvin = 100;
    if (spectrum->rgb[0] <= 1 || memchr(text.start, ',', text.length) != NULL) {
        return true;
    }
    file_words_fail(words, text,
                    "'%.*s' is no colour of light: a single number, 0 to 1, means white",
                    text_shown(text), text.start);
    return spectrum->rgb[0] >= least_kelvin &&
           error_hint(words->error, "did you mean '%.*sK'?", text_shown(text), text.start);
}

bool scene_colour_of(const struct scene_reader *reader, const struct scene_line *line,
                     enum scene_key key, enum scene_colour_use use, struct spectrum *spectrum)
{
    const struct text text = line->value[key];
    const struct file_words *words = line->words;
    struct scene_colour colour = {.spectrum = {.kind = SPECTRUM_RGB, .rgb = {1, 1, 1}}};
    if (scene_line_has(line, key)) {
        bool is_read;
        if (text.start[0] == '#') {
            is_read = read_code(words, text, &colour.spectrum);
        } else if (is_colour_number(text)) {
            is_read = read_parts(words, text, &colour.spectrum);
        } else {
            is_read = colour_named(reader, text, use, &colour);
        }
        if (!is_read || !check_colour_use(words, text, use, &colour) ||
            (use == COLOUR_OF_LIGHT && is_colour_number(text) &&
             !check_grey_parts(words, text, &colour.spectrum))) {
            return false;
        }
    }
    *spectrum = colour.spectrum;
    return true;
}

static bool read_colour(struct scene_reader *reader, const struct scene_line *line,
                        struct scene_colour *colour)
{
    *colour = (struct scene_colour){.is_light = false};
    if (scene_line_has(line, KEY_RGB)) {
        return read_parts(line->words, line->value[KEY_RGB], &colour->spectrum);
    }
    if (scene_line_has(line, KEY_TABLE)) {
        return scene_load_table(reader, line, &colour->spectrum);
    }
    return scene_line_has(line, KEY_SRGB)
               ? read_code(line->words, line->value[KEY_SRGB], &colour->spectrum)
               : colour_named(reader, line->value[KEY_SPECTRUM], COLOUR_OF_LIGHT, colour);
}

/* A name that is no light's of the program. */
static bool read_colour_name(const struct scene_reader *reader, struct text name)
{
    struct spectrum known;
    struct error unknown;
    return scene_name_check(&reader->words, &reader->colours, name, "a colour") &&
           (!spectrum_named(name, &known, &unknown) ||
            file_words_fail(&reader->words, name,
                            "'%.*s' is a light that is known: give the colour another name",
                            text_shown(name), name.start));
}

bool scene_colour_read(struct scene_reader *reader, struct text head)
{
    const uint64_t ways =
        SCENE_BIT(KEY_RGB) | SCENE_BIT(KEY_SRGB) | SCENE_BIT(KEY_SPECTRUM) | SCENE_BIT(KEY_TABLE);
    struct file_words *words = &reader->words;
    const struct text name = file_words_next(words);
    struct scene_line line;
    struct scene_colour colour;
    if (reader->colours.count == SCENE_COLOURS_MOST) {
        return file_words_fail(words, head, "more than %d colours", SCENE_COLOURS_MOST);
    }
    if (!read_colour_name(reader, name) ||
        !scene_line_read(words, &reader->units, head, (struct scene_keys){ways, 0}, &line)) {
        return false;
    }
    if (line.given == 0 || (line.given & (line.given - 1)) != 0) {
        return file_words_fail(words, head, "a colour is one of rgb=, srgb=, spectrum= and table=");
    }
    if (!read_colour(reader, &line, &colour)) {
        return false;
    }
    struct arena *arena = words->arena;
    reader->spectra = arena_grow(arena, reader->spectra, reader->colours.count,
                                 &reader->spectrum_room, sizeof colour);
    reader->spectra[reader->colours.count] = colour;
    name_table_add(&reader->colours, name, arena);
    return true;
}
