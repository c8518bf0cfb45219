/* cli/question/settle.c - values that name no option, or another one than they belong to. */
/* SPDX-License-Identifier: MIT */
#include "cli/question/settle.h"

#include "cli/question/operands.h"
#include "cli/question/operands_telescope.h"
#include "cli/question/unit_moves.h"

bool arguments_settle(struct arguments *arguments, struct arena *arena, struct error *error)
{
    const size_t count = arguments->operand_count;
    unit_moves_apply(arguments, arena);
    if (count == 0) {
        return true;
    }
    const struct option **options = ARENA_ARRAY(arena, count, const struct option *);
    const bool has_focal = arguments->photograph_count > 0 ||
                           arguments_given(arguments, "focal-length") ||
                           arguments_given(arguments, "lens");
    if (!operands_settle(arguments->command, arguments->operands, count, has_focal, options,
                         error) ||
        !operands_tell_telescope(arguments, arguments->operands, count, options, error)) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        struct argument *argument = arguments_find(arguments, text_of(options[i]->name));
        const struct text word = arguments->operands[i];
        if (argument->is_given && argument->entry == NULL) {
            fail(error, ERROR_USAGE, "'%.*s' stands for --%s, which is given as well",
                 text_shown(word), word.start, options[i]->name);
            return error_hint(error, "name the option that it belongs to");
        }
        argument->is_given = true;
        argument->entry = NULL;
        argument->text = word;
    }
    arguments_note_given(arguments);
    return true;
}
