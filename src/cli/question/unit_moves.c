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

/* "200mm"; of "1280x720px" what stands behind the x, of a list or range the last one. */
static bool text_has_unit_of(struct text text, const struct dimension *dimension)
{
    struct text last = text_trim(text);
    for (size_t i = last.length; i > 0; i--) {
        const char c = last.start[i - 1];
        const bool is_side = c == 'x' && i < last.length && char_is_digit(last.start[i]);
        const bool is_end = c == '.' && i > 1 && last.start[i - 2] == '.';
        if (is_side || is_end || c == ',' || c == ':') {
            last = text_trim((struct text){last.start + i, last.length - i});
            break;
        }
    }
    double value;
    const struct unit *unit;
    struct error ignored;
    return last.length > 0 && !char_is_digit(last.start[last.length - 1]) &&
           quantity_read(last, dimension, NULL, &value, &unit, &ignored) && unit != NULL;
}

void unit_moves_apply(struct arguments *arguments, struct arena *arena)
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
            to->called =
                from->called != NULL ? from->called : arena_printf(arena, "--%s", move->from);
            arguments_withdraw(arguments, from);
        }
    }
}
