/* cli/options/option_glass.c - read values of options about glasses. */
/* SPDX-License-Identifier: MIT */
#include "cli/options/option_glass.h"

#include "cli/options/option.h"
#include "data/glass_catalog.h"

#include <math.h>

static bool glass_value_read(const struct reader *reader, const struct option *option,
                             struct text text, void *member, struct error *error)
{
    struct glass_record *record = ARENA_NEW(reader->arena, struct glass_record);
    enum glass_naming naming =
        (option->flags & OPTION_CURRENT) != 0 ? GLASS_CURRENT : GLASS_ALIASES;
    if (!glass_find_medium(reader->db, text, naming, reader->arena, record, error)) {
        return false;
    }
    *(struct glass_value *)member = (struct glass_value){
        record,
        arena_string(reader->arena, record->glass.name.start, record->glass.name.length),
    };
    return true;
}

/* A single value is allowed where the option says of which size. */
static bool bad_interval(const struct option *option, struct text text, struct error *error)
{
    bool one = option->highest > option->lowest;
    fail(error, ERROR_USAGE, "%s '%.*s' is no %srange", TYPED(option, text),
         one ? "value or " : "");
    return error_hint(error, "say %sLOW..HIGH, LOW.. or ..HIGH", one ? "a number, " : "");
}

/* One end; nothing stands for an open one. */
static bool interval_end_read(const struct option *option, struct text text, double *end,
                              struct error *error)
{
    *end = NAN;
    if (text_trim(text).length == 0) {
        return true;
    }
    const struct dimension *dimension =
        option->dimension != NULL ? option->dimension : &dimension_number;
    return quantity_read(text, dimension, option_unit(option), end, NULL, error) ||
           error_prefix(error, "bad range in %s: ", CALLED(option));
}

static bool read_interval(const struct reader *reader, const struct option *option,
                          struct text text, void *member, struct error *error)
{
    struct interval_value interval = {NAN, NAN, NAN};
    size_t at = 0;
    (void)reader;
    while (at + 1 < text.length && !(text.start[at] == '.' && text.start[at + 1] == '.')) {
        at++;
    }
    if (at + 1 >= text.length) {
        /* a value to be near to */
        const struct dimension *dimension =
            option->dimension != NULL ? option->dimension : &dimension_number;
        if (text_trim(text).length == 0 || !(option->highest > option->lowest)) {
            return bad_interval(option, text, error);
        }
        struct interval_value *near = member;
        *near = interval;
        return (quantity_read(text, dimension, option_unit(option), &near->near, NULL, error) ||
                error_prefix(error, "bad value in %s: ", CALLED(option))) &&
               option_check_range(option, near->near, error);
    }
    struct text high = {text.start + at + 2, text.length - at - 2};
    if (!interval_end_read(option, (struct text){text.start, at}, &interval.low, error) ||
        !interval_end_read(option, high, &interval.high, error)) {
        return false;
    }
    if ((isnan(interval.low) && isnan(interval.high)) || interval.low > interval.high) {
        return bad_interval(option, text, error);
    }
    *(struct interval_value *)member = interval;
    return true;
}

/* "1.5..1.6", as it is typed; an end that is open is empty. */
static const char *interval_words(const struct option *option, const void *member,
                                  struct arena *arena)
{
    const struct interval_value *interval = member;
    char low[NUMBER_LENGTH + 1], high[NUMBER_LENGTH + 1];
    const struct unit *unit = option_unit(option);
    if (!isnan(interval->near)) {
        *quantity_write(low, interval->near, unit) = '\0';
        return arena_printf(arena, "%s", low);
    }
    char *const low_end = isnan(interval->low) ? low : quantity_write(low, interval->low, unit);
    char *const high_end =
        isnan(interval->high) ? high : quantity_write(high, interval->high, unit);
    *low_end = *high_end = '\0';
    const bool is_given = low[0] != '\0' || high[0] != '\0';
    return is_given ? arena_printf(arena, "%s..%s", low, high) : NULL;
}

const struct option_kind kind_glass = {
    .name = "glass",
    .size = sizeof(struct glass_value),
    .is_list = true,
    .read = glass_value_read,
    OPTION_NAMED(struct glass_value, name),
    .reads = READS_LENSDB | READS_GLASSES,
};

const struct option_kind kind_interval = {
    .name = "interval",
    .size = sizeof(struct interval_value),
    .is_list = true,
    .read = read_interval,
    .words_of = interval_words,
    .nan_count = 3,
};
