/* cli/question/comma.c - commas that part a list where something else may be meant. */
/* SPDX-License-Identifier: MIT */
#include "cli/question/comma.h"

#include <string.h>

/*
 * What is marked on binoculars or an objective has no comma within, and every one of a list its own
 * "x": 10x50 6,5deg and 40x/0,65 have a decimal comma.
 */
static bool comma_check_markings(const struct option *option, struct text text, struct arena *arena,
                                 struct error *error)
{
    for (size_t i = 1; option->kind == &kind_marking && i + 1 < text.length; i++) {
        struct text rest = {text.start + i + 1, text.length - i - 1};
        if (text.start[i] != ',' || !char_is_digit(text.start[i - 1]) ||
            !char_is_digit(text.start[i + 1])) {
            continue;
        }
        const struct text item = text_cut(&rest, ',');
        if (memchr(item.start, 'x', item.length) == NULL) {
            fail(error, ERROR_USAGE,
                 "%s '%.*s' has a decimal comma: commas part the items of a "
                 "list",
                 TYPED(option, text));
            return error_hint(error, "write it with a point: %s",
                              arena_printf(arena, "%.*s.%.*s", (int)i, text.start,
                                           (int)(text.length - i - 1), text.start + i + 1));
        }
    }
    return true;
}

/* "ND1000" without its numbers, "ND": how a filter is written. */
static bool filters_are_written_alike(struct text a, struct text b)
{
    const bool first = a.length > 0 && char_is_digit(a.start[0]);
    return b.length > 0 && first == char_is_digit(b.start[0]);
}

/* A list of filters is one of questions; of different kinds they may be meant together. */
static void comma_doubt_filters(const struct reader *reader, const struct option *option,
                                struct text text)
{
    struct text rest = text;
    const struct text first = text_trim(text_cut(&rest, ','));
    bool is_alike = true;
    while (rest.start != NULL && is_alike) {
        is_alike = filters_are_written_alike(first, text_trim(text_cut(&rest, ',')));
    }
    if (option->kind == &kind_loss && !is_alike && reader->doubts != NULL) {
        warnings_add(reader->doubts,
                     "%s %.*s is a list, a row for each filter alone; stacked ones are joined "
                     "by '+', as in ND1000+2stops",
                     TYPED(option, text));
    }
}

bool comma_check(const struct reader *reader, const struct option *option, struct text text,
                 struct error *error)
{
    comma_doubt_filters(reader, option, text);
    return comma_check_markings(option, text, reader->arena, error);
}
