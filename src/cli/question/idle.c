/* cli/question/idle.c - options that would say nothing beside what else is asked. */
/* SPDX-License-Identifier: MIT */
#include "cli/question/idle.h"

#include "cli/question/command.h"

#include <stdio.h>
#include <string.h>

/* What is asked, as the checks below look at it. */
struct idle {
    const struct sweep *sweep; /* null: values are not known yet */
    const struct arguments *arguments;
    const struct option_query *asking;
    const void *input;
};

/* The values of an option that are known before a batch is read. */
static const char *idle_values_of(const struct idle *idle, const struct option *option,
                                  size_t *count)
{
    const struct axis *axis = sweep_axis(idle->sweep, option->name);
    *count = axis != NULL ? axis->count : 1;
    return axis != NULL ? axis->values : (const char *)idle->input + option->offset;
}

/* Has any circle of confusion that is asked for a value that the option serves? */
static bool serves_any(const struct idle *idle, const struct option *server)
{
    bool found = false;
    for (size_t i = 0; i < idle->arguments->command->option_count && !found; i++) {
        const struct argument *argument = &idle->arguments->all[i];
        const struct option *option = argument->option;
        if (option->kind != &kind_coc) {
            continue;
        }
        /* those of a batch are not known yet; an assumed one gives way to what this implies */
        found = asking_in_rows(idle->asking, option->name) ||
                (!argument->is_given && option->fallback != NULL);
        size_t count;
        const char *values = idle_values_of(idle, option, &count);
        for (size_t k = 0; k < count && !found; k++) {
            found = server->serves((const void *)(values + k * option->kind->size));
        }
    }
    return found;
}

/* A condition as `wants` has it: "pattern", "pattern=sobol" or "pattern!=few". */
struct condition {
    const struct argument *argument;
    struct text value; /* empty: any will do */
    bool is_other;     /* any but this */
};

/* The first of the conditions, which is taken off the list. */
static struct condition next_condition(const struct idle *idle, const char **list)
{
    const char *end = *list + strcspn(*list, "|");
    const char *name_end = *list + strcspn(*list, "!=|");
    struct condition condition = {arguments_find(idle->arguments, text_between(*list, name_end)),
                                  text_between(end, end), *name_end == '!'};
    if (name_end < end) {
        condition.value = text_between(name_end + (condition.is_other ? 2 : 1), end);
    }
    *list = *end == '|' ? end + 1 : end;
    return condition;
}

/* Does it hold for any value that is asked for, or assumed? */
static bool idle_holds(const struct idle *idle, const struct condition *condition)
{
    const struct option *option = condition->argument->option;
    bool given = asking_given(idle->asking, option->name), found = false;
    if (condition->value.length == 0 || asking_in_rows(idle->asking, option->name)) {
        return given; /* values of a batch are not known yet */
    }
    if (!given && option->fallback == NULL) {
        return false;
    }
    size_t count;
    const char *values = idle_values_of(idle, option, &count);
    for (size_t i = 0; i < count && !found; i++) {
        const char *name = option_value_name(option, values + i * option->kind->size);
        bool same = name != NULL && text_same(condition->value, name);
        found = same != condition->is_other;
    }
    return found;
}

/* Is one of them asked for? If not, they are put into words: "--lens or --coc airy". */
static bool has_wanted(const struct idle *idle, const char *wants, char *words, size_t size)
{
    size_t length = 0;
    while (*wants != '\0') {
        struct condition condition = next_condition(idle, &wants);
        if (idle_holds(idle, &condition)) {
            return true;
        }
        const struct option *option = condition.argument->option;
        const bool is_operand = (option->flags & OPTION_OPERAND) != 0;
        int printed =
            snprintf(words + length, size - length, "%s%s%s%s%s%.*s", length > 0 ? " or " : "",
                     is_operand ? "" : "--", is_operand ? option->value : option->name,
                     condition.value.length > 0 ? " " : "", condition.is_other ? "other than " : "",
                     text_shown(condition.value), condition.value.start);
        length += printed > 0 && (size_t)printed < size - length ? (size_t)printed : 0;
    }
    return false;
}

/* Is anything asked for that reads such data? */
static bool reads_any(const struct idle *idle, unsigned data)
{
    const struct command *command = idle->arguments->command;
    unsigned found = command->reads;
    for (size_t i = 0; i < command->option_count; i++) {
        const struct option *option = &command->options[i];
        const bool counts = option->fallback != NULL || asking_given(idle->asking, option->name);
        found |= counts ? option->kind->reads : 0;
    }
    return (found & data) != 0;
}

/* Common options that say how data are read. */
static const struct {
    const char *name, *what;
    unsigned data;
} readings[] = {{"lossy", "lens", READS_LENSES},
                {"glass-numbers", "lens", READS_LENSES},
                {"stop-size", "lens", READS_LENSES},
                {"agf", "lens or glass", READS_GLASSES}};

/* Of each line one option leaves the others of the configuration nothing to say: options that the
   rows of a batch may have side by side, and formats, which are refused elsewhere. */
static const char *const rivals[] = {"lens focal-length", "format csv tsv json jsonl value",
                                     "columns table plot value"};

/* The option of a list that is asked for; null: none is. */
static struct argument *idle_any_of(const struct idle *idle, const char *list,
                                    const struct option *except)
{
    struct text rest = text_of(list != NULL ? list : "");
    while (rest.length > 0) {
        /* a common one that the command has no use for is not there */
        struct argument *found = arguments_find(idle->arguments, text_cut(&rest, ' '));
        if (found != NULL && found->option != except &&
            asking_given(idle->asking, found->option->name)) {
            return found;
        }
    }
    return NULL;
}

/* The one of two options that exclude each other which is of the configuration, and gives way;
   null: both were meant. */
static struct argument *idle_weaker(struct argument *a, struct argument *b)
{
    /* what only a column of a batch gives is typed, too */
    const enum argument_rank of_a = a->is_given ? argument_rank(a) : RANK_TYPED;
    const enum argument_rank of_b = b->is_given ? argument_rank(b) : RANK_TYPED;
    if (of_a == of_b) {
        return NULL;
    }
    return of_a < of_b ? a : b;
}

/* An option of the configuration that has to give way to another; null: none has. */
static struct argument *idle_yielding(const struct idle *idle, struct argument *argument)
{
    const struct option *option = argument->option;
    struct argument *other = idle_any_of(idle, option->excludes, option);
    struct argument *yielding = other != NULL ? idle_weaker(argument, other) : NULL;
    for (size_t i = 0; i < sizeof rivals / sizeof rivals[0] && yielding == NULL; i++) {
        if (text_lists(rivals[i], text_of(option->name))) {
            other = idle_any_of(idle, rivals[i], option);
            yielding = other != NULL ? idle_weaker(argument, other) : NULL;
        }
    }
    return yielding;
}

void idle_yield(struct arguments *arguments, const struct option_query *asking)
{
    const struct idle idle = {.arguments = arguments, .asking = asking};
    for (size_t i = 0; i < arguments->count; i++) {
        struct argument *yielding =
            arguments->all[i].is_given ? idle_yielding(&idle, &arguments->all[i]) : NULL;
        if (yielding != NULL) {
            arguments_withdraw(arguments, yielding);
            i = (size_t)-1; /* the others anew, without it */
        }
    }
}

/* Common options that say how drawings look. */
static const char dressing[] = "theme title subtitle";

/* Is a drawing asked for? If not, the options that ask for one are put into words. */
static bool draws_any(const struct idle *idle, char *words, size_t size)
{
    const struct command *command = idle->arguments->command;
    size_t length = 0;
    bool draws = command->run == NULL && option_draws(&command->artifacts[0].option);
    for (size_t i = 0; i < idle->arguments->count && !draws; i++) {
        const struct option *option = idle->arguments->all[i].option;
        if (option_draws(option)) {
            draws = idle->arguments->all[i].is_given;
            const int printed = snprintf(words + length, size - length, "%s--%s",
                                         length > 0 ? " or " : "", option->name);
            length += printed > 0 && (size_t)printed < size - length ? (size_t)printed : 0;
        }
    }
    return draws;
}

static bool check_option(const struct idle *idle, const struct option *option, struct error *error)
{
    char words[120] = "";
    const struct argument *other = idle_any_of(idle, option->excludes, option);
    if (other != NULL) {
        return fail(error, ERROR_USAGE, "{--%s} and {--%s} exclude each other%s%s", option->name,
                    other->option->name, option->why != NULL ? ": " : "",
                    option->why != NULL ? option->why : "");
    }
    if (option->wants != NULL && !has_wanted(idle, option->wants, words, sizeof words)) {
        fail(error, ERROR_USAGE, "{--%s} needs %s", option->name, words);
        return option->no_number != NULL && error_hint(error, "%s", option->no_number);
    }
    const char *stop = idle->arguments->command->stop_size_wants;
    if (strcmp(option->name, "stop-size") == 0 && stop != NULL &&
        !has_wanted(idle, stop, words, sizeof words)) {
        return fail(error, ERROR_USAGE, "{--%s} needs %s", option->name, words);
    }
    if (text_lists(dressing, text_of(option->name)) && !draws_any(idle, words, sizeof words)) {
        return fail(error, ERROR_USAGE, "{--%s} needs %s", option->name, words);
    }
    if (option->serves != NULL && !serves_any(idle, option)) {
        return fail(error, ERROR_USAGE, "{--%s} does nothing here: it is for {--coc} %s",
                    option->name, option->served);
    }
    for (size_t i = 0; i < sizeof readings / sizeof readings[0]; i++) {
        if (strcmp(option->name, readings[i].name) == 0 && !reads_any(idle, readings[i].data)) {
            return fail(error, ERROR_USAGE, "{--%s} does nothing here: no %s is read", option->name,
                        readings[i].what);
        }
    }
    return true;
}

/* What a check that failed blames may be of the configuration: the option itself, or the circle of
   confusion that it does not serve. */
static struct argument *idle_blamed(const struct idle *idle, struct argument *argument)
{
    if (argument->entry != NULL) {
        return argument;
    }
    for (size_t i = 0; argument->option->serves != NULL && i < idle->arguments->count; i++) {
        struct argument *other = &idle->arguments->all[i];
        if (other->option->kind == &kind_coc && other->entry != NULL) {
            return other;
        }
    }
    return NULL;
}

bool idle_check(const struct sweep *sweep, struct arguments *arguments,
                const struct option_query *asking, const void *input, bool *withdrawn,
                struct error *error)
{
    const struct idle idle = {sweep, arguments, asking, input};
    const bool has_defaults = arguments->defaults != NULL && arguments->defaults->is_there;
    *withdrawn = false;
    for (size_t i = 0; i < arguments->count; i++) {
        struct argument *argument = &arguments->all[i];
        struct argument *yielding = NULL;
        if (!argument->is_given) {
            continue;
        }
        if (has_defaults) {
            yielding = idle_yielding(&idle, argument);
        }
        if (yielding == NULL && !check_option(&idle, argument->option, error)) {
            yielding = idle_blamed(&idle, argument);
            if (yielding == NULL) {
                return false;
            }
        }
        if (yielding != NULL) {
            arguments_withdraw(arguments, yielding);
            *withdrawn = true;
            i = (size_t)-1; /* the others anew, without it */
        }
    }
    return true;
}
