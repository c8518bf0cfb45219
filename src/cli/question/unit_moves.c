/* cli/question/unit_moves.c - values whose unit says that they are another option's. */
/* SPDX-License-Identifier: MIT */
#include "cli/question/unit_moves.h"

#include <string.h>

static const struct unit_move {
    const char *from, *to;
    const struct dimension *dimension; /* of which the value is there, with a unit */
} unit_moves[] = {
    {"aperture", "diameter", &dimension_length},
    {"focal-length", "fx", &dimension_pixels},
    {"sensor", "pixels", &dimension_pixels},
};

/* "200mm", and of "1280x720px" what stands behind the x. */
static bool text_has_unit_of(struct text text, const struct dimension *dimension)
{
    struct text last = text_trim(text);
    for (size_t i = last.length; i > 0; i--) {
        if (last.start[i - 1] == 'x' && i < last.length && char_is_digit(last.start[i])) {
            last = (struct text){last.start + i, last.length - i};
            break;
        }
    }
    double value;
    const struct unit *unit;
    struct error ignored;
    return last.length > 0 && !char_is_digit(last.start[last.length - 1]) &&
           quantity_read(last, dimension, NULL, &value, &unit, &ignored) && unit != NULL;
}

void unit_moves_apply(struct arguments *arguments)
{
    for (size_t i = 0; i < sizeof unit_moves / sizeof unit_moves[0]; i++) {
        const struct unit_move *move = &unit_moves[i];
        struct argument *from = arguments_find(arguments, text_of(move->from));
        struct argument *to = arguments_find(arguments, text_of(move->to));
        if (from != NULL && to != NULL && from->is_given && !to->is_given &&
            text_has_unit_of(from->text, move->dimension)) {
            to->text = from->text;
            to->is_given = true;
            to->entry = from->entry;
            arguments_withdraw(arguments, from);
        }
    }
}
