/* cli/option_glass.c - read values of options about glasses. */
/* SPDX-License-Identifier: MIT */
#include "cli/option_glass.h"

#include "cli/option.h"
#include "data/glass_catalog.h"

#include <math.h>

static bool read_glass(const struct reader *reader, const struct option *option, struct text text,
                       void *member, struct error *error)
{
    (void)option;
    struct glass_record *record = ARENA_NEW(reader->arena, struct glass_record);
    if (!glass_find_medium(reader->db, text, reader->arena, record, error)) {
        return false;
    }
    *(struct glass_value *)member = (struct glass_value){
        record,
        arena_string(reader->arena, record->glass.name.start, record->glass.name.length),
    };
    return true;
}

static const char *glass_name(const struct option *option, const void *member)
{
    (void)option;
    return ((const struct glass_value *)member)->name;
}

static bool bad_interval(const struct option *option, struct text text, struct error *error)
{
    fail(error, ERROR_USAGE, "--%s '%.*s' is no range", option->name, text_shown(text), text.start);
    return error_hint(error, "say LOW..HIGH, LOW.. or ..HIGH");
}

/* One end; nothing stands for an open one. */
static bool read_end(const struct option *option, struct text text, double *end,
                     struct error *error)
{
    *end = NAN;
    if (text_trim(text).length == 0) {
        return true;
    }
    const struct dimension *dimension =
        option->dimension != NULL ? option->dimension : &dimension_number;
    return quantity_read(text, dimension, option_unit(option), end, NULL, error) ||
           error_prefix(error, "bad range in --%s: ", option->name);
}

static bool read_interval(const struct reader *reader, const struct option *option,
                          struct text text, void *member, struct error *error)
{
    struct interval_value interval;
    size_t at = 0;
    (void)reader;
    while (at + 1 < text.length && !(text.start[at] == '.' && text.start[at + 1] == '.')) {
        at++;
    }
    if (at + 1 >= text.length) {
        return bad_interval(option, text, error);
    }
    struct text high = {text.start + at + 2, text.length - at - 2};
    if (!read_end(option, (struct text){text.start, at}, &interval.low, error) ||
        !read_end(option, high, &interval.high, error)) {
        return false;
    }
    if ((isnan(interval.low) && isnan(interval.high)) || interval.low > interval.high) {
        return bad_interval(option, text, error);
    }
    *(struct interval_value *)member = interval;
    return true;
}

const struct option_kind kind_glass = {"glass", sizeof(struct glass_value), true, read_glass,
                                       glass_name};
const struct option_kind kind_interval = {"interval", sizeof(struct interval_value), false,
                                          read_interval, NULL};
