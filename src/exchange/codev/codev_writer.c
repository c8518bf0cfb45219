/* exchange/codev/codev_writer.c - numbers, texts and materials of a CODE V file being written. */
/* SPDX-License-Identifier: MIT */
#include "exchange/codev/codev_writer.h"

#include "file/decimal.h"

#include <string.h>

enum { LINE = 72 };

const char *const codev_aperture_words[] = {
    [APERTURE_FNUMBER] = "FNO", [APERTURE_EPD] = "EPD", [APERTURE_NA] = "NAO"};

const char *const codev_field_words[][2] = {[FIELD_ANGLE] = {"XAN", "YAN"},
                                            [FIELD_HEIGHT] = {"XOB", "YOB"},
                                            [FIELD_IMAGE] = {"XIM", "YIM"},
                                            [FIELD_REAL] = {"XRI", "YRI"}};

static void codev_writer_put(struct codev_output *output, struct text text)
{
    growing_text(&output->writing.text, text);
}

static void codev_writer_put_string(struct codev_output *output, const char *string)
{
    codev_writer_put(output, text_of(string));
}

void codev_put_number(struct codev_output *output, size_t *column, struct text number)
{
    if (*column + number.length + 2 > LINE) {
        codev_writer_put_string(output, "&\n  ");
        *column = 2;
    }
    codev_writer_put_string(output, " ");
    codev_writer_put(output, number);
    *column += number.length + 1;
}

struct text codev_coordinate(const struct codev_output *output, const struct figure *field)
{
    const bool nothing = field->value.hi == 0 && field->typed.start == NULL;
    if (nothing) {
        return text_of("0.0");
    }
    if (output->lens->field_kind == FIELD_ANGLE) {
        return writing_degrees(&output->writing, field);
    }
    return writing_length(&output->writing, field, 1);
}

bool codev_put_text(struct codev_output *output, const char *name, const char *string,
                    struct error *error)
{
    bool has_lost = false;
    const char *quote = strchr(string, '\'') == NULL ? "'" : "\"";
    const struct text text = writing_quotable(&output->writing, string, quote, &has_lost);
    codev_writer_put_string(output, arena_printf(output->job->arena, "%s %s", name, quote));
    codev_writer_put(output, text);
    codev_writer_put_string(output, quote);
    codev_writer_put_string(output, "\n");
    return !has_lost || foreign_lose(output->job, error,
                                     "a text with both kinds of quotes" LOSS_INSTEAD
                                     "the double ones are left out");
}

/* nd = 1.ddd and Vd = vv.v as ddd.vvv; empty where nd or Vd do not fit. */
static struct text codev_writer_code_of(const struct codev_output *output,
                                        const struct medium *medium)
{
    struct text abbe = medium->written, index = text_cut(&abbe, '/');
    const char *digits = "0123456789";
    bool fits = index.length > 2 && index.start[0] == '1' && index.start[1] == '.' &&
                medium->abbe.hi > 0 && medium->abbe.hi < 100 && abbe.length < 40 &&
                index.length < 40;
    for (size_t i = 2; fits && i < index.length; i++) {
        fits = strchr(digits, index.start[i]) != NULL;
    }
    for (size_t i = 0; fits && i < abbe.length; i++) {
        fits = abbe.start[i] == '.' || strchr(digits, abbe.start[i]) != NULL;
    }
    if (!fits) {
        return (struct text){"", 0};
    }
    struct text hundredth = decimal_shift(abbe, -2, output->job->arena);
    const char *point = memchr(hundredth.start, '.', hundredth.length);
    const char *zeros = index.length == 3 ? "00" : index.length == 4 ? "0" : "";
    return text_of(arena_printf(output->job->arena, "%.*s%s%.*s", (int)index.length - 2,
                                index.start + 2, zeros,
                                (int)(hundredth.start + hundredth.length - point), point));
}

bool codev_put_medium(struct codev_output *output, const struct medium *medium, struct error *error)
{
    struct text name, catalog, code = {"", 0};
    if (medium_is_air(medium)) {
        return true;
    }
    codev_writer_put_string(output, " ");
    if (medium->kind == MEDIUM_GLASS) {
        writing_glass(&output->writing, output->job, medium, &name, &catalog);
        bool quoted = memchr(name.start, ' ', name.length) != NULL;
        codev_writer_put_string(output, quoted ? "'" : "");
        codev_writer_put(output, name);
        codev_writer_put_string(output, catalog.length > 0 ? "_" : "");
        codev_writer_put(output, catalog);
        codev_writer_put_string(output, quoted ? "'" : "");
        return true;
    }
    for (size_t i = 0; i < output->own_count; i++) {
        if (medium_is_same(output->own[i], medium)) {
            growing_format(&output->writing.text, "'N%zu'", i + 1);
            return true;
        }
    }
    code = codev_writer_code_of(output, medium);
    if (code.length > 0) {
        codev_writer_put(output, code);
        return true;
    }
    struct text abbe = medium->written, index = text_cut(&abbe, '/');
    codev_writer_put(output, index);
    codev_writer_put_string(output, ":");
    codev_writer_put(output, abbe);
    return foreign_lose(output->job, error,
                        "a glass whose nd is not from 1 to 2 or whose Vd is not from 0 to "
                        "100 has no code" LOSS_INSTEAD "it is written nd:Vd");
}

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
