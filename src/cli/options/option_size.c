/* cli/options/option_size.c - read sizes of fields: 100x75mm. */
/* SPDX-License-Identifier: MIT */
#include "cli/options/option.h"

#include <math.h>

static bool size_value_read(const struct reader *reader, const struct option *option,
                            struct text text, void *member, struct error *error)
{
    struct size_value *size = member;
    double sides[2];
    bool has_unit = false;
    (void)reader;
    if (!option_read_size(option, text_trim(text), sides, &has_unit, error)) {
        if (error->code == ERROR_NONE) {
            fail(error, ERROR_USAGE, "%s '%.*s' is no size of two sides", TYPED(option, text));
            error_hint(error, "say 100x75mm");
        }
        return false;
    }
    if (!has_unit) {
        fail(error, ERROR_USAGE, "%s '%.*s' has no unit", TYPED(option, text));
        return error_hint(error, "say %.*smm or %.*sm", text_shown(text), text.start,
                          text_shown(text), text.start);
    }
    *size = (struct size_value){sides[0], sides[1]};
    return (sides[0] > 0 && sides[1] > 0 && isfinite(sides[0]) && isfinite(sides[1])) ||
           fail(error, ERROR_DOMAIN, "%s '%.*s': both sides must be above 0 and finite",
                TYPED(option, text));
}

static const char *size_words(const struct option *option, const void *member, struct arena *arena)
{
    const struct size_value *size = member;
    (void)option;
    return isnan(size->width) ? NULL
                              : arena_printf(arena, "%.15gx%.15gmm", size->width, size->height);
}

const struct option_kind kind_size = {
    .name = "size",
    .size = sizeof(struct size_value),
    .is_list = true,
    .read = size_value_read,
    .words_of = size_words,
    .nan_count = 2,
};
