/* cli/question/operands.c - values that stand without their options: dof 50mm f/2.8 3m. */
/* SPDX-License-Identifier: MIT */
#include "cli/question/operands.h"

#include "exchange/metadata/photo_file.h"

#include <math.h>
#include <string.h>

/* In the order in which they are tried: the first length is the focal length. */
static const struct {
    const char *option, *example;
} operand_options[] = {
    {"focal-length", "50mm"}, {TELESCOPE, "1200mm"}, {"aperture", "f/2.8"},
    {"distance", "3m"},       {DIAMETER, "200mm"},   {"metered-at", "f/16"},
    {"time", "1/125"},        {"iso", "iso400"},     {"ev", "EV12"},
};
enum {
    OPERAND_FOCAL,
    OPERAND_DISTANCE = 3,
    OPERAND_DIAMETER,
    OPERAND_OPTIONS = sizeof operand_options / sizeof operand_options[0]
};

static const struct option *operand_named(const struct command *command, const char *name)
{
    for (size_t k = 0; k < command->option_count; k++) {
        if (strcmp(command->options[k].name, name) == 0) {
            return command->options[k].dimension != NULL ? &command->options[k] : NULL;
        }
    }
    return NULL;
}

static bool command_has_operands(const struct command *command)
{
    for (size_t i = 0; i < command->option_count; i++) {
        if ((command->options[i].flags & OPTION_OPERAND) != 0) {
            return true;
        }
    }
    return false;
}

/* Option i, if a command has it and a value of its dimension means it: beside words of its own, as
   the name of a lens, a focal length alone. */
static const struct option *operand_option(const struct command *command, size_t i)
{
    const char *name = operand_options[i].option;
    const bool is_telescope = operand_named(command, TELESCOPE) != NULL;
    if (command_has_operands(command) && i != OPERAND_FOCAL && !is_telescope) {
        return NULL;
    }
    /* the plans of time lapses and brackets have times of several kinds, and neither of these */
    const bool is_unclear = strcmp(name, "time") == 0 &&
                            operand_named(command, "aperture") == NULL &&
                            operand_named(command, "distance") == NULL;
    return is_unclear ? NULL : operand_named(command, name);
}

/* Common options are found by their names. */
static bool command_has_batch(const struct command *command)
{
    const struct option *common = command_next_common(command, NULL);
    while (common != NULL && strcmp(common->name, "batch") != 0) {
        common = command_next_common(command, common);
    }
    return common != NULL;
}

bool command_takes_photographs(const struct command *command)
{
    bool any = false;
    for (size_t i = 0; i < OPERAND_OPTIONS && !any; i++) {
        any = operand_option(command, i) != NULL;
    }
    any = any || operand_named(command, "time") != NULL;
    return any && text_equal(text_of(command->group), "photography") &&
           !command_has_operands(command) && command_has_batch(command);
}

bool operand_is_photograph(const struct command *command, struct text word)
{
    return photo_ending(word) != NULL && command_takes_photographs(command);
}

/* Is a value written as only those of one dimension are: with its unit, its prefix, as 1/125? */
static bool operand_shows(struct text value, const struct dimension *dimension)
{
    struct error ignored;
    double number;
    const struct unit *typed;
    if (value.length == 0 || !quantity_read(value, dimension, NULL, &number, &typed, &ignored)) {
        return false;
    }
    if (isinf(number)) {
        return dimension == &dimension_length; /* a distance: nothing else is infinite */
    }
    const bool has_prefix = !char_is_digit(value.start[0]) && strchr("+-.", value.start[0]) == NULL;
    const bool is_fraction =
        dimension == &dimension_time && memchr(value.start, '/', value.length) != NULL;
    return typed != NULL || has_prefix || is_fraction;
}

/* The end of a range without the step, factor, count or series behind it. */
static struct text operand_range_end(struct text last)
{
    size_t i = 1;
    while (i < last.length && strchr(":#*", last.start[i]) == NULL &&
           !(last.start[i] == '/' && char_is_digit(last.start[i - 1]) && i + 1 < last.length &&
             !char_is_digit(last.start[i + 1]))) {
        i++;
    }
    return (struct text){last.start, i < last.length ? i : last.length};
}

/* The same of a list or a range: one of its values says what all are, as in 24..70mm. */
static bool operand_is_of(struct text word, const struct option *option)
{
    bool found = false;
    while (word.start != NULL && !found) {
        struct text last = text_cut(&word, ',');
        const struct text first = text_cut_range(&last);
        found = operand_shows(first, option->dimension) ||
                operand_shows(operand_range_end(last), option->dimension);
    }
    return found;
}

/* A pinhole: no film lies so near behind one, and no subject in front of it. */
static bool operand_is_hole(const struct command *command, struct text word)
{
    static const double WIDEST = 3; /* mm */
    const struct option *diameter = operand_named(command, DIAMETER);
    struct text first = text_cut(&word, ',');
    struct error ignored;
    double length;
    first = text_cut_range(&first);
    return diameter != NULL && operand_named(command, TELESCOPE) == NULL &&
           quantity_read(first, &dimension_length, option_unit(diameter), &length, NULL,
                         &ignored) &&
           length < WIDEST;
}

/* The first option of which values are written so, of those that are left; else their count. */
static size_t operand_find(const struct command *command, struct text word, const bool *is_taken)
{
    const bool is_telescope = operand_named(command, TELESCOPE) != NULL;
    const bool is_hole = operand_is_hole(command, word);
    size_t i = 0;
    for (; i < OPERAND_OPTIONS; i++) {
        const struct option *option = operand_option(command, i);
        const bool is_diameter = i == OPERAND_DIAMETER;
        const bool is_length = is_diameter || i == OPERAND_FOCAL || i == OPERAND_DISTANCE;
        /* of an option that the command has, and whose values are like it in size */
        const bool is_apt = !is_length || is_telescope || is_hole == is_diameter;
        if (option != NULL && is_apt && !is_taken[i] && operand_is_of(word, option)) {
            break;
        }
    }
    return i;
}

/* Is it one value in two words, "50" "mm" or "5ft" "6in"? */
static bool operand_is_one(const struct command *command, struct text words)
{
    bool found = false;
    for (size_t i = 0; i < OPERAND_OPTIONS && !found; i++) {
        const struct option *option = operand_option(command, i);
        found = option != NULL && operand_shows(words, option->dimension);
    }
    return found;
}

size_t operands_read(const struct command *command, char *const *words, size_t count,
                     struct text *operand, struct arena *arena)
{
    static const bool none_taken[OPERAND_OPTIONS];
    const char *joined = words[0];
    size_t used = 1;
    while (used < count) {
        const char *more = arena_printf(arena, "%s %s", joined, words[used]);
        if (!operand_is_one(command, text_of(more))) {
            break;
        }
        joined = more;
        used++;
    }
    *operand = text_of(joined);
    return operand_find(command, *operand, none_taken) < OPERAND_OPTIONS ? used : 0;
}

/* All options that it could be a value of have theirs. */
static bool operand_refuse(const struct command *command, struct text word, struct error *error)
{
    const char *names[2] = {NULL, NULL};
    for (size_t i = 0, count = 0; i < OPERAND_OPTIONS && count < 2; i++) {
        const struct option *option = operand_option(command, i);
        if (option != NULL && operand_is_of(word, option)) {
            names[count++] = option->name;
        }
    }
    if (names[1] == NULL) {
        return fail(error, ERROR_USAGE, "'%.*s' is one value too many: --%s has one already",
                    text_shown(word), word.start, names[0]);
    }
    return fail(error, ERROR_USAGE, "'%.*s' is one value too many: --%s and --%s have theirs",
                text_shown(word), word.start, names[0], names[1]);
}

/* Is one of them a length, and no more? */
static bool operands_have_one_length(const struct text *operands, size_t count,
                                     const struct option *length)
{
    size_t found = 0;
    for (size_t i = 0; i < count; i++) {
        found += operand_is_of(operands[i], length);
    }
    return found == 1;
}

bool operands_settle(const struct command *command, const struct text *operands, size_t count,
                     bool has_focal, const struct option **options, struct error *error)
{
    bool is_taken[OPERAND_OPTIONS] = {false};
    is_taken[OPERAND_FOCAL] =
        has_focal && operand_option(command, OPERAND_DISTANCE) != NULL &&
        operands_have_one_length(operands, count, operand_option(command, OPERAND_DISTANCE));
    for (size_t i = 0; i < count; i++) {
        const size_t found = operand_find(command, operands[i], is_taken);
        if (found == OPERAND_OPTIONS) {
            return operand_refuse(command, operands[i], error);
        }
        is_taken[found] = true;
        options[i] = operand_option(command, found);
    }
    return true;
}

const char *operands_example(const struct command *command, struct arena *arena)
{
    enum { MOST = 3 };
    const char *example = NULL;
    size_t count = 0;
    for (size_t i = 0; i < OPERAND_OPTIONS && count < MOST; i++) {
        if (operand_option(command, i) != NULL) {
            example = ARENA_JOIN(arena, count > 0 ? example : command->name, " ",
                                 operand_options[i].example);
            count++;
        }
    }
    return count > 1 ? example : NULL;
}

const char *operands_usage(const struct command *command, struct arena *arena)
{
    const char *usage = "";
    for (size_t i = 0; i < OPERAND_OPTIONS; i++) {
        if (operand_option(command, i) != NULL) {
            usage = arena_printf(arena, "%s [%s]", usage, operand_options[i].example);
        }
    }
    if (command_takes_photographs(command)) {
        usage = arena_printf(arena, "%s [PHOTO.jpg...]", usage);
    }
    return usage;
}
