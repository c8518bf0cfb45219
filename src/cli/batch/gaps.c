/* cli/batch/gaps.c - rows of a batch to which a question lacks something: said once. */
/* SPDX-License-Identifier: MIT */
#include "cli/batch/gaps.h"

#include "cli/batch/photographs.h"

#include <string.h>

bool gaps_add(struct gaps *gaps, const struct error *failure)
{
    for (size_t i = 0; i < gaps->count; i++) {
        struct gap *gap = &gaps->all[i];
        if (strcmp(gap->message, failure->message) == 0) {
            gap->last = failure->line;
            memcpy(gap->last_source, failure->source, sizeof gap->last_source);
            gap->more++;
            return false;
        }
    }
    if (gaps->count < GAPS_MOST) {
        struct gap *gap = &gaps->all[gaps->count++];
        memcpy(gap->message, failure->message, sizeof gap->message);
        memcpy(gap->source, failure->source, sizeof gap->source);
        gap->first = failure->line;
        gap->more = 0;
    }
    return true;
}

/* "'FNumber', 'Model'": the columns that have a value in the row, or those that have none. */
static const char *columns_in_words(const struct batch *batch, const void *input, bool filled)
{
    const char *words = "";
    for (size_t i = 0; i < batch->column_count; i++) {
        const struct batch_column *column = &batch->columns[i];
        if (column->option != NULL && !column->is_ignored && !column->is_infinite &&
            batch_is_filled(batch, column->option, input) == filled) {
            words =
                arena_printf(batch->reader->arena, "%s%s'%.*s'", words, *words != '\0' ? ", " : "",
                             text_shown(column->name), column->name.start);
        }
    }
    return words;
}

/* The option that a message mentions i-th, by its name or as a quantity; null: it is none. */
static const struct option *mentioned_option(const struct error *failure, int i,
                                             const struct arguments *arguments)
{
    const struct mention *mention = &failure->in_message.all[i];
    const struct text words = {failure->message + mention->at, (size_t)mention->length};
    const struct text name = text_behind(words, "--");
    for (size_t k = 0; k < arguments->count; k++) {
        const struct option *option = arguments->all[k].option;
        if (arguments->all[k].is_input &&
            (name.start != NULL ? text_equal(name, option->name)
                                : option_is_quantity(option, words))) {
            return option;
        }
    }
    return NULL;
}

/* "--distance": the options that the message asks for; those that a column leaves empty, or all. */
static const char *lacking_options(const struct error *failure, const struct batch *batch,
                                   const void *input, bool has_column)
{
    const char *words = "";
    for (int i = 0; i < failure->in_message.count; i++) {
        const struct option *option = mentioned_option(failure, i, batch->arguments);
        if (option != NULL && !arguments_given(batch->arguments, option->name) &&
            !batch_is_filled(batch, option, input) &&
            (!has_column || batch_has(batch, option->name))) {
            words = arena_printf(batch->reader->arena, "%s%s--%s", words,
                                 *words != '\0' ? " or " : "", option->name);
        }
    }
    return words;
}

void gaps_explain(struct error *failure, const struct batch *batch, const void *input)
{
    struct arena *arena = batch->reader->arena;
    const char *filled = columns_in_words(batch, input, true);
    const char *empty = columns_in_words(batch, input, false);
    const char *options = lacking_options(failure, batch, input, true);
    if (*empty == '\0' && *lacking_options(failure, batch, input, false) == '\0') {
        return; /* too much is given, not too little */
    }
    const char *unsaid = *empty != '\0' ? "empty cells do not" : "no column does, for all rows";
    const char *lack = batch->photographs != NULL ? photographs_lack(batch) : NULL;
    if (batch->photographs != NULL) {
        unsaid = "photographs do not";
    }
    failure->more =
        arena_printf(arena, "    known here: %s%s%s\n%s%s%s    an option says what %s%s%s\n",
                     *filled != '\0' ? filled : "nothing", *empty != '\0' ? "; empty: " : "", empty,
                     lack != NULL ? "    " : "", lack != NULL ? lack : "", lack != NULL ? "\n" : "",
                     unsaid, *options != '\0' ? ": " : "", options);
}

/* "distance_m or s_m": what columns of an option are called. */
static const char *option_columns(const struct option *option, struct arena *arena)
{
    const struct unit *unit = option_unit(option);
    const bool has_unit = unit != NULL && unit->name[0] != '\0';
    const char *behind = has_unit ? ARENA_JOIN(arena, "_", unit->name) : "";
    char *name = arena_string(arena, option->name, strlen(option->name));
    for (char *c = name; *c != '\0'; c++) {
        *c = *c == '-' ? '_' : *c;
    }
    return option->letter != '\0'
               ? arena_printf(arena, "%s%s or %c%s", name, behind, option->letter, behind)
               : arena_printf(arena, "%s%s", name, behind);
}

void gaps_refuse(struct error *failure, const struct batch *batch)
{
    struct arena *arena = batch->reader->arena;
    const struct error lack = *failure;
    const char *names = "", *wanted = "";
    enum { MOST_NAMES = 8 };
    for (size_t i = 0; i < batch->column_count && i < MOST_NAMES; i++) {
        const struct text name = batch->columns[i].name;
        names = arena_printf(arena, "%s%s'%.*s'", names, i > 0 ? ", " : "", text_shown(name),
                             name.start);
    }
    for (int i = 0; i < lack.in_message.count; i++) {
        const struct option *option = mentioned_option(&lack, i, batch->arguments);
        if (option != NULL) {
            wanted = arena_printf(arena, "%s%s%s", wanted, *wanted != '\0' ? ", " : "",
                                  option_columns(option, arena));
        }
    }
    fail(failure, ERROR_DATA, "no column means anything to %s: %s%s",
         batch->arguments->command->name, names, batch->column_count > MOST_NAMES ? ", ..." : "");
    error_locate(failure, batch->source, batch->header_line, 0);
    const char *known =
        *wanted != '\0' ? ARENA_JOIN(arena, "    columns that it would know: ", wanted, "\n") : "";
    failure->more =
        arena_printf(arena, "    %s\n%s    an option says it for all rows\n", lack.message, known);
}

void gaps_refuse_values(struct error *error, const struct batch *batch, struct text line)
{
    struct arena *arena = batch->reader->arena;
    const struct command *command = batch->arguments->command;
    enum { MOST_NAMES = 6 };
    const char *names = "";
    int count = 0;
    for (size_t i = 0; i < command->option_count && count < MOST_NAMES; i++) {
        const struct option *option = &command->options[i];
        /* those with letters are what most questions are made of */
        if (option->letter != '\0' && option->dimension != NULL &&
            !arguments_given(batch->arguments, option->name)) {
            names = arena_printf(arena, "%s%s%s", names, count > 0 ? ", " : "",
                                 option_columns(option, arena));
            count++;
        }
    }
    fail(error, ERROR_DATA, "the first row has values, where names of columns are expected: %.*s",
         text_shown(line), line.start);
    error->more = arena_printf(arena, "    columns that %s would know: %s%s\n", command->name,
                               names, count == MOST_NAMES ? ", ..." : "");
}

bool gaps_rest(const struct gaps *gaps, size_t i, const char *source, struct error *rest)
{
    const struct gap *gap = &gaps->all[i];
    if (i >= gaps->count || gap->more == 0) {
        return false;
    }
    if (gap->first == 0) { /* files of one row each */
        fail(rest, ERROR_ROWS, "%zu more %s like it, the last of them %s", gap->more,
             gap->more == 1 ? "photograph fails" : "photographs fail", gap->last_source);
        error_locate(rest, gap->source, 0, 0);
        return true;
    }
    fail(rest, ERROR_ROWS, "%zu more %s like line %ld, the last of them line %ld", gap->more,
         gap->more == 1 ? "row fails" : "rows fail", gap->first, gap->last);
    error_locate(rest, source, 0, 0);
    return true;
}
