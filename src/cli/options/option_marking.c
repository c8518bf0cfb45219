/* cli/options/option_marking.c - a power and a second number, as optical instruments are marked. */
/* SPDX-License-Identifier: MIT */
#include "cli/options/option.h"

#include "base/number.h"

#include <math.h>
#include <string.h>

#define TIMES_SIGN "\xc3\x97"

/* Step over blanks, and over this word behind them, whatever its case. */
static bool marking_skip(struct text *rest, const char *word)
{
    *rest = text_trim(*rest);
    const size_t length = strlen(word);
    if (rest->length < length || !text_same((struct text){rest->start, length}, word)) {
        return false;
    }
    *rest = text_trim((struct text){rest->start + length, rest->length - length});
    return true;
}

static bool marking_number(struct text *rest, double *number)
{
    const char *end = rest->start + rest->length;
    const char *behind = rest->length > 0 && char_is_digit(rest->start[0])
                             ? number_read(rest->start, end, NUMBER_UNSCALED, number)
                             : NULL;
    if (behind == NULL || !(*number > 0 && isfinite(*number))) {
        return false;
    }
    *rest = (struct text){behind, (size_t)(end - behind)};
    return true;
}

static bool read_marking(const struct reader *reader, const struct option *option, struct text text,
                         void *member, struct error *error)
{
    struct text rest = text_trim(text);
    struct marking_value marking = {.number = NAN};
    marking.name = arena_printf(reader->arena, "%.*s", (int)rest.length, rest.start);
    /* the maker's words before them: "Plan Apo 20x/0.75" */
    while (rest.length > 0 && !char_is_digit(rest.start[0])) {
        rest = (struct text){rest.start + 1, rest.length - 1};
    }
    const bool has_power =
        marking_number(&rest, &marking.power) &&
        (marking_skip(&rest, "x") || marking_skip(&rest, TIMES_SIGN) || rest.length == 0);
    if (has_power) {
        static const char *const between[] = {"/", "NA", "FN"};
        for (size_t i = 0; i < sizeof between / sizeof between[0]; i++) {
            marking_skip(&rest, between[i]);
        }
        if (marking_number(&rest, &marking.number)) {
            marking_skip(&rest, "mm");
        }
        rest = text_trim(rest);
    }
    if (!has_power || (rest.length > 0 && isnan(marking.number))) {
        fail(error, ERROR_USAGE, "bad %s '%.*s': it is written as %s", TYPED(option, text),
             option->value);
        if (option->no_number != NULL) {
            error_hint(error, "%s", option->no_number);
        }
        return false;
    }
    marking.behind = arena_printf(reader->arena, "%.*s", (int)rest.length, rest.start);
    *(struct marking_value *)member = marking;
    return true;
}

const struct option_kind kind_marking = {
    .name = "marking",
    .size = sizeof(struct marking_value),
    .is_list = true,
    .read = read_marking,
    OPTION_NAMED(struct marking_value, name),
    .nan_at = offsetof(struct marking_value, power),
    .nan_count = 2,
};
