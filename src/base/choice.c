/* base/choice.c - a word that is none of those that may stand there. */
/* SPDX-License-Identifier: MIT */
#include "base/choice.h"

#include <stdio.h>

void choice_offer(struct choice *choice, const char *word)
{
    const size_t room = sizeof choice->all - choice->length;
    const int length =
        snprintf(choice->all + choice->length, room, "%s%s", choice->length > 0 ? ", " : "", word);
    choice->length += length > 0 && (size_t)length < room ? (size_t)length : 0;
    choice->nearest.typed = text_trim(choice->typed);
    nearest_offer(&choice->nearest, text_of(word));
}

bool choice_refuse(const struct choice *choice, struct error *error)
{
    const struct text typed = choice->typed, best = choice->nearest.best;
    fail(error, ERROR_USAGE, "'%.*s' is none of %s", text_shown(typed), typed.start, choice->all);
    return best.start != NULL &&
           error_hint(error, "did you mean '%.*s'?", (int)best.length, best.start);
}
