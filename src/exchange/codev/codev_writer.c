/* exchange/codev/codev_writer.c - numbers, texts and materials of a CODE V file being written. */
/* SPDX-License-Identifier: MIT */
#include "exchange/codev/codev_writer.h"

#include "file/decimal.h"

#include <string.h>

enum { CODEV_LINE = 72 };

const char *const codev_aperture_words[] = {
    [APERTURE_FNUMBER] = "FNO", [APERTURE_EPD] = "EPD", [APERTURE_NA] = "NAO"};

const char *const codev_field_words[][2] = {[FIELD_ANGLE] = {"XAN", "YAN"},
                                            [FIELD_HEIGHT] = {"XOB", "YOB"},
                                            [FIELD_IMAGE] = {"XIM", "YIM"},
                                            [FIELD_REAL] = {"XRI", "YRI"}};

void codev_put_number(struct lens_writer *writing, size_t *column, const char *number)
{
    const size_t length = strlen(number);
    if (*column + length + 2 > CODEV_LINE) {
        writing_put(writing, "&\n  ");
        *column = 2;
    }
    writing_put(writing, " %s", number);
    *column += length + 1;
}

void codev_put_waves(struct lens_writer *writing, const char *command,
                     const struct lens_light *light, bool weights)
{
    size_t column = strlen(command);
    writing_put(writing, "%s", command);
    for (size_t i = 0; i < light->count; i++) {
        const struct lens_wavelength *one = &light->wavelengths[i];
        codev_put_number(writing, &column,
                         weights ? writing_weight(writing, one->weight_typed, "1")
                                 : writing_wave(writing, one->wavelength, one->typed, 3));
    }
    writing_put(writing, "\n");
}

static const char *codev_coordinate(const struct lens_writer *writing, const struct figure *field)
{
    if (field->value.hi == 0 && field->typed.start == NULL) {
        return "0.0";
    }
    return writing->lens->field_kind == FIELD_ANGLE ? writing_degrees(writing, field)
                                                    : writing_length(writing, field, 1);
}

void codev_put_fields(struct lens_writer *writing, const char *command,
                      const struct lens_points *points, enum codev_row row)
{
    size_t column = strlen(command);
    writing_put(writing, "%s", command);
    for (size_t i = 0; i < points->count; i++) {
        const struct lens_field *field = &points->fields[i];
        codev_put_number(writing, &column,
                         row == CODEV_WEIGHTS ? writing_weight(writing, field->weight_typed, "1")
                                              : codev_coordinate(writing, &field->at[row]));
    }
    writing_put(writing, "\n");
}

void codev_put_text(struct lens_writer *writing, const char *name, const char *string)
{
    bool has_lost = false;
    const char *quote = strchr(string, '\'') == NULL ? "'" : "\"";
    const char *text = writing_quotable(writing, string, quote, &has_lost);
    writing_put(writing, "%s %s%s%s\n", name, quote, text, quote);
    if (has_lost) {
        foreign_lose(writing->job, LOSS_OF_RAYS, "the double ones are left out",
                     "a text with both kinds of quotes");
    }
}

/* -------- media -------- */

/* nd = 1.ddd and Vd = vv.v as ddd.vvv; null where nd or Vd do not fit. */
static const char *codev_glass_code(const struct medium *medium, struct arena *arena)
{
    struct text abbe = medium->written, index = text_cut(&abbe, '/');
    bool fits = index.length > 2 && index.start[0] == '1' && index.start[1] == '.' &&
                medium->abbe.hi > 0 && medium->abbe.hi < 100 && abbe.length < 40 &&
                index.length < 40;
    for (size_t i = 2; fits && i < index.length; i++) {
        fits = char_is_digit(index.start[i]);
    }
    for (size_t i = 0; fits && i < abbe.length; i++) {
        fits = abbe.start[i] == '.' || char_is_digit(abbe.start[i]);
    }
    if (!fits) {
        return NULL;
    }
    struct text hundredth = decimal_shift(abbe, -2, arena);
    const char *point = memchr(hundredth.start, '.', hundredth.length);
    const int digits = (int)index.length - 2, zeros = digits < 3 ? 3 - digits : 0;
    return arena_printf(arena, "%.*s%.*s%.*s", digits, index.start + 2, zeros, "00",
                        (int)(hundredth.start + hundredth.length - point), point);
}

void codev_put_medium(struct codev_output *output, const struct medium *medium)
{
    struct lens_writer *writing = &output->writing;
    if (medium_is_air(medium)) {
        return;
    }
    if (medium->kind == MEDIUM_GLASS) {
        struct text name, catalog;
        writing_glass(writing, medium, &name, &catalog);
        const char *quote = memchr(name.start, ' ', name.length) != NULL ? "'" : "";
        writing_put(writing, " %s%.*s%s%.*s%s", quote, (int)name.length, name.start,
                    catalog.length > 0 ? "_" : "", (int)catalog.length, catalog.start, quote);
        return;
    }
    for (size_t i = 0; i < output->own_count; i++) {
        if (medium_is_same(output->own[i], medium)) {
            writing_put(writing, " 'N%zu'", i + 1);
            return;
        }
    }
    const char *code = codev_glass_code(medium, writing->arena);
    if (code != NULL) {
        writing_put(writing, " %s", code);
        return;
    }
    struct text abbe = medium->written, index = text_cut(&abbe, '/');
    writing_put(writing, " %.*s:%.*s", (int)index.length, index.start, (int)abbe.length,
                abbe.start);
    foreign_lose(writing->job, LOSS_OF_RAYS, "it is written nd:Vd",
                 "a glass whose nd is not from 1 to 2 or whose Vd is not from 0 to 100 has no "
                 "code");
}

/* -------- aspheres -------- */

bool codev_is_of_asp(int term)
{
    return term > 0 && term < LENS_EVEN;
}

bool codev_is_term_given(const struct surface *surface, int term)
{
    return (surface->coefficients >> term & 1) != 0;
}

bool codev_is_odd(const struct surface *surface)
{
    bool is_odd = false;
    for (int i = 0; i < LENS_COEFFICIENTS; i++) {
        is_odd = is_odd || (codev_is_term_given(surface, i) && !codev_is_of_asp(i) &&
                            surface->coefficient[i].value.hi != 0);
    }
    return is_odd;
}

const char *codev_coefficient_word(int order, bool is_odd, struct arena *arena)
{
    static const char letters[] = "  ABCDEFGHJ";
    return is_odd ? arena_printf(arena, "AR%d", order)
                  : arena_printf(arena, "%c", letters[order / 2]);
}
