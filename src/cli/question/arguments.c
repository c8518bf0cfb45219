/* cli/question/arguments.c - argv into the texts of options. */
/* SPDX-License-Identifier: MIT */
#include "cli/question/arguments.h"

#include "cli/question/operands.h"
#include "cli/question/trade_names.h"

#include <string.h>

struct argument *arguments_find(const struct arguments *arguments, struct text name)
{
    for (size_t i = 0; i < arguments->count; i++) {
        if (option_is_named(arguments->all[i].option, name)) {
            return &arguments->all[i];
        }
    }
    return NULL;
}

bool arguments_given(const struct arguments *arguments, const char *name)
{
    bool given = false;
    for (size_t i = 0; i < arguments->given_count && !given; i++) {
        given = strcmp(arguments->given[i], name) == 0;
    }
    return given;
}

void arguments_note_given(struct arguments *arguments)
{
    arguments->given_count = 0;
    for (size_t i = 0; i < arguments->count; i++) {
        if (arguments->all[i].is_given) {
            arguments->given[arguments->given_count++] = arguments->all[i].option->name;
        }
    }
}

void arguments_withdraw(struct arguments *arguments, struct argument *argument)
{
    argument->is_given = false;
    argument->text = (struct text){NULL, 0};
    argument->entry = NULL;
    argument->called = argument->reading = NULL;
    arguments_note_given(arguments);
}

enum argument_rank argument_rank(const struct argument *argument)
{
    static const enum argument_rank ranks[] = {
        [CONFIG_ALL] = RANK_ALL, [CONFIG_COMMAND] = RANK_COMMAND, [CONFIG_KIT] = RANK_KIT};
    return argument->entry == NULL ? RANK_TYPED : ranks[argument->entry->scope];
}

/* The argument that such a name stands for; null where the command has no such option. */
static struct argument *named_by(const struct arguments *arguments, struct text name,
                                 const struct trade_name *all, const struct trade_name **entry)
{
    for (size_t i = 0; all[i].names != NULL; i++) {
        const bool is_here =
            all[i].command == NULL || strcmp(all[i].command, arguments->command->name) == 0;
        if (is_here && text_lists_name(all[i].names, name)) {
            for (size_t j = 0; j < arguments->count; j++) {
                if (strcmp(arguments->all[j].option->name, all[i].option) == 0) {
                    *entry = &all[i];
                    return &arguments->all[j];
                }
            }
        }
    }
    return NULL;
}

/* The option of this command that may be meant, or whose column has this name; or null. */
static const struct option *meant_by(const struct arguments *arguments, struct text name,
                                     const char **words)
{
    const struct trade_name *entry = NULL;
    const struct argument *hinted = named_by(arguments, name, trade_hints, &entry);
    *words = entry != NULL ? entry->words : NULL;
    for (size_t i = 0; i < arguments->count; i++) {
        const struct option *own = arguments->all[i].option;
        if (*words == NULL && own->column != NULL && text_same_name(name, text_of(own->column))) {
            return own;
        }
    }
    return hinted != NULL ? hinted->option : NULL;
}

/* The column of an answer of this command by that name; null: there is none. */
static const struct column *column_meant(const struct command *command, struct text name)
{
    const struct sheet *const single[] = {&command->sheet, NULL};
    const struct sheet *const *sheets = command->sheets != NULL ? command->sheets : single;
    const struct trade_name *trade = trade_columns;
    while (trade->names != NULL && !text_lists_name(trade->names, name)) {
        trade++;
    }
    name = trade->names != NULL ? text_of(trade->option) : name;
    for (size_t i = 0; sheets[i] != NULL; i++) {
        for (size_t k = 0; k < sheets[i]->column_count; k++) {
            const struct column *column = &sheets[i]->columns[k];
            if (text_same_name(name, text_of(column->name)) ||
                (column->label != NULL && text_same_name(name, text_of(column->label)))) {
                return column;
            }
        }
    }
    return NULL;
}

static bool arguments_unknown(const struct arguments *arguments, struct text name,
                              const char *dashes, struct error *error)
{
    struct nearest nearest = {.typed = name};
    for (size_t i = 0; i < common_option_count; i++) {
        const char *why = command_has_no_use(arguments->command, &common_options[i]);
        if (why != NULL && option_is_named(&common_options[i], name)) {
            return fail(error, ERROR_USAGE, "--%s does nothing here: %s %s", common_options[i].name,
                        arguments->command->name, why);
        }
    }
    const struct command *other = arguments->command->other;
    for (size_t i = 1; other != NULL && i < other->option_count; i++) {
        if (option_is_named(&other->options[i], name)) {
            return fail(error, ERROR_USAGE, "--%s needs --%s", other->options[i].name,
                        other->options[0].name);
        }
    }
    for (size_t i = 0; i < arguments->count; i++) {
        nearest_offer(&nearest, text_of(arguments->all[i].option->name));
    }
    fail(error, ERROR_USAGE, "unknown option '%s%.*s'", dashes, text_shown(name), name.start);
    const char *words;
    const struct option *meant = meant_by(arguments, name, &words);
    if (words != NULL) {
        return error_hint(error, "%s", words);
    }
    if (meant != NULL) {
        return error_hint(error, "here it is '--%s': %s", meant->name, meant->help);
    }
    const struct column *column = column_meant(arguments->command, name);
    if (column != NULL) {
        return error_hint(error,
                          "it is in the answer without being asked for: leave it out, or "
                          "have it alone by --columns %s",
                          column->name);
    }
    if (nearest.best.start != NULL) {
        return error_hint(error, "did you mean '--%.*s'?", (int)nearest.best.length,
                          nearest.best.start);
    }
    return error_hint(error, "see 'lenscalc %s --help'", arguments->command->name);
}

/* The words that are left, while they are read. */
struct words {
    int count, at;
    char **all;
    struct arena *arena;
    struct argument *last; /* whose value was read last; null behind flags and operands */
};

static bool is_flag(const struct argument *argument)
{
    return argument->option->kind == &kind_flag;
}

/* One more word behind those that an argument has; they may be many. */
static void arguments_append(struct argument *argument, char between, struct text word,
                             struct arena *arena)
{
    const size_t length = argument->text.length + 1 + word.length;
    char *joined = (char *)argument->text.start;
    if (length > argument->room) {
        argument->room = 2 * length;
        joined = ARENA_ARRAY(arena, argument->room + 1, char);
        memcpy(joined, argument->text.start, argument->text.length);
    }
    joined[argument->text.length] = between;
    memcpy(joined + argument->text.length + 1, word.start, word.length);
    argument->text = (struct text){joined, length};
}

/* Is the word an option, "--seconds=3"? A value that looks like one is written behind '='. */
static bool names_option(const struct arguments *arguments, const char *word)
{
    struct text rest = text_behind(text_of(word), "--");
    return rest.start != NULL && rest.length > 0 &&
           arguments_find(arguments, text_cut(&rest, '=')) != NULL;
}

/* May it be the value of an option that goes without one? */
static bool begins_number(const char *word)
{
    return char_is_digit(word[word[0] == '.']);
}

/* Store the text of an option; `text.start` is null where none was attached to its name. */
static bool arguments_take(const struct arguments *arguments, struct argument *argument,
                           struct text text, struct words *words, struct error *error)
{
    const char *name = argument->option->name;
    const bool is_more = argument->is_given;
    if (is_more && (argument->option->flags & OPTION_SEVERAL) == 0) {
        return fail(error, ERROR_USAGE, "--%s is given twice", name);
    }
    if (is_flag(argument) && text.start != NULL) {
        return fail(error, ERROR_USAGE, "--%s takes no value", name);
    }
    if (argument->option->bare != NULL && text.start == NULL &&
        !(words->at < words->count && begins_number(words->all[words->at]))) {
        text = text_of(argument->option->bare);
    }
    if (!is_flag(argument) && text.start == NULL) {
        if (words->at == words->count || names_option(arguments, words->all[words->at])) {
            const bool is_called = argument->called != NULL;
            const struct option *option = argument->option;
            fail(error, ERROR_USAGE, "%s%s needs a value: %s", is_called ? "" : "--",
                 is_called ? argument->called : name,
                 option->value != NULL ? option->value : "VALUE");
            return option->no_number != NULL && error_hint(error, "%s", option->no_number);
        }
        text = text_of(words->all[words->at++]);
    }
    if (is_more) {
        arguments_append(argument, ',', text, words->arena);
    } else {
        argument->text = text;
    }
    argument->is_given = true;
    words->last = is_flag(argument) ? NULL : argument;
    return true;
}

/* Messages about it use the name that was typed, unless it has been given by its own. */
static void arguments_call(struct argument *argument, const struct trade_name *alias,
                           const char *dashes, struct text name, struct arena *arena)
{
    if (!argument->is_given) {
        argument->called = arena_printf(arena, "%s%.*s", dashes, text_shown(name), name.start);
        argument->reading = alias->words;
    }
}

/* Each number of a list in the form of an alias; what has a unit of its own stays. */
static struct text trade_put_form(const char *form, struct text typed, struct arena *arena)
{
    const size_t before = strcspn(form, "%");
    const char *all = "", *between = "";
    for (struct text rest = typed; rest.start != NULL; between = ",") {
        const struct text item = text_trim(text_cut(&rest, ','));
        const bool is_bare = item.length > 0 && (char_is_digit(item.start[item.length - 1]) ||
                                                 item.start[item.length - 1] == '.');
        all = is_bare ? arena_printf(arena, "%s%s%.*s%.*s%s", all, between, (int)before, form,
                                     (int)item.length, item.start, form + before + 1)
                      : arena_printf(arena, "%s%s%.*s", all, between, (int)item.length, item.start);
    }
    return text_of(all);
}

/* Take the option that an alias stands for, with the value that the alias has there. */
static bool take_alias(const struct arguments *arguments, struct argument *argument,
                       const struct trade_name *alias, struct text value, struct words *words,
                       struct error *error)
{
    if (alias->form == NULL) {
        return arguments_take(arguments, argument, value, words, error);
    }
    if (strchr(alias->form, '%') == NULL) {
        if (value.start != NULL) {
            return fail(error, ERROR_USAGE, "%s takes no value: it is --%s %s", argument->called,
                        argument->option->name, alias->form);
        }
        const bool done = arguments_take(arguments, argument, text_of(alias->form), words, error);
        words->last = NULL;
        return done;
    }
    if (value.start == NULL && words->at < words->count &&
        !names_option(arguments, words->all[words->at])) {
        value = text_of(words->all[words->at++]);
    }
    if (value.start != NULL) {
        value = trade_put_form(alias->form, value, words->arena);
    }
    return arguments_take(arguments, argument, value, words, error);
}

/* --name, --name=value, --name value */
static bool parse_long(struct arguments *arguments, struct text word, struct words *words,
                       struct error *error)
{
    struct text value = word;
    struct text name = text_cut(&value, '=');
    struct argument *argument = arguments_find(arguments, name);
    const struct trade_name *alias;
    if (argument == NULL) {
        argument = named_by(arguments, name, trade_aliases, &alias);
        if (argument == NULL) {
            return arguments_unknown(arguments, name, "--", error);
        }
        arguments_call(argument, alias, "--", name, words->arena);
        return take_alias(arguments, argument, alias, value, words, error);
    }
    return arguments_take(arguments, argument, value, words, error);
}

/* -f50mm, -f 50mm, -f=50mm; several flags may share one dash */
static bool parse_short(struct arguments *arguments, struct text word, struct words *words,
                        struct error *error)
{
    while (word.length > 0) {
        struct argument *argument = NULL;
        for (size_t i = 0; i < arguments->count && argument == NULL; i++) {
            if (arguments->all[i].option->letter == word.start[0] && word.start[0] != '\0') {
                argument = &arguments->all[i];
            }
        }
        if (argument == NULL) {
            const struct trade_name *alias;
            const struct text name = {word.start, 1};
            argument = named_by(arguments, name, trade_aliases, &alias);
            if (argument == NULL) {
                return arguments_unknown(arguments, word, "-", error);
            }
            arguments_call(argument, alias, "-", name, words->arena);
        }
        struct text rest = {word.start + 1, word.length - 1};
        if (!is_flag(argument)) {
            if (rest.length > 0 && rest.start[0] == '=') {
                rest = (struct text){rest.start + 1, rest.length - 1};
            }
            return arguments_take(arguments, argument,
                                  rest.length > 0 ? rest : (struct text){NULL, 0}, words, error);
        }
        if (!arguments_take(arguments, argument, (struct text){NULL, 0}, words, error)) {
            return false;
        }
        word = rest;
    }
    return true;
}

/* What the last value of an option is measured in; null: it is no quantity. */
static const struct dimension *measured_in(const struct option *option)
{
    if (option->kind == &kind_sensor) {
        return &dimension_length;
    }
    return option->kind == &kind_loss ? &dimension_stops : option->dimension;
}

/*
 * Does a word go on with the value before it? A unit behind a bare number does ("50" "mm"), the
 * rest of a quantity ("5" "ft" "6" "in"), and what follows the comma of a list.
 */
static bool arguments_goes_on(const struct argument *argument, struct text word,
                              struct arena *arena)
{
    const struct option *option = argument->option;
    const struct dimension *dimension = measured_in(option);
    const struct text before = argument->text;
    /* the last value of a list or range, or side of a size */
    size_t at = before.length;
    while (at > 0 && before.start[at - 1] != ',' &&
           !(at > 1 && before.start[at - 1] == '.' && before.start[at - 2] == '.') &&
           !(option->kind == &kind_sensor && (before.start[at - 1] | 0x20) == 'x')) {
        at--;
    }
    const struct text last = {before.start + at, before.length - at};
    struct error ignored;
    double value;
    if (dimension == NULL || before.length == 0 || word.length == 0) {
        return false;
    }
    if (before.start[before.length - 1] == ',') {
        return option->kind->is_list;
    }
    bool is_unit = unit_find(dimension, word) != NULL;
    if (last.length == 0 || !(is_unit || char_is_digit(word.start[0]))) {
        return false;
    }
    const char *joined = arena_printf(arena, "%.*s %.*s", (int)last.length, last.start,
                                      (int)word.length, word.start);
    return quantity_read(text_of(joined), dimension, NULL, &value, NULL, &ignored);
}

/* A word that belongs to nothing: say how it may have been meant. */
static bool unexpected(const struct arguments *arguments, const struct words *words,
                       struct text word, struct error *error)
{
    const struct example *example = arguments->command->examples;
    const struct argument *last = words->last;
    fail(error, ERROR_USAGE, "unexpected argument '%.*s'", text_shown(word), word.start);
    if (last != NULL && option_has_names(last->option)) {
        return error_hint(error, "put a value with blanks in quotes: --%s \"%.*s %.*s\"",
                          last->option->name, text_shown(last->text), last->text.start,
                          text_shown(word), word.start);
    }
    const bool is_number = word.length > 0 && strchr("+.0123456789", word.start[0]) != NULL;
    const char *values = operands_example(arguments->command, words->arena);
    const struct argument *sensor = arguments_find(arguments, text_of("sensor"));
    if (!is_number && sensor != NULL && sensor->option->kind == &kind_sensor && !sensor->is_given &&
        word.length > 0 && !char_is_digit(word.start[0]) &&
        memchr(word.start, ' ', word.length) != NULL) {
        return error_hint(error, "a camera or format by its name is --sensor \"%.*s\"",
                          text_shown(word), word.start);
    }
    if (!is_number && arguments->command->no_operand != NULL) {
        return error_hint(error, "%s", arguments->command->no_operand);
    }
    if (is_number && values != NULL) {
        return error_hint(error, "values have units, as in 'lenscalc %s', or options", values);
    }
    if (is_number && example != NULL) {
        return error_hint(error, "numbers follow their option, as in 'lenscalc %s'",
                          example->arguments);
    }
    return error_hint(error, "see 'lenscalc %s --help'", arguments->command->name);
}

/* Operands that take more than one. */
#define MORE_WORDS (OPTION_REST | OPTION_MANY | OPTION_TOGETHER)

/* Has an operand been given that takes further words? */
static bool arguments_go_on(const struct arguments *arguments)
{
    for (size_t i = 0; i < arguments->count; i++) {
        const struct argument *argument = &arguments->all[i];
        const unsigned flags = argument->option->flags;
        if (argument->is_given && (flags & OPTION_OPERAND) != 0 && (flags & MORE_WORDS) != 0) {
            return true;
        }
    }
    return false;
}

/* A word that is no option goes to the next operand that is still free. */
static bool parse_operand(struct arguments *arguments, struct text word, struct words *words,
                          struct arena *arena, struct error *error)
{
    struct argument *last = words->last;
    if (last != NULL && arguments_goes_on(last, word, arena)) {
        const char *between = last->text.start[last->text.length - 1] == ',' ? "" : " ";
        last->text = text_of(arena_printf(arena, "%.*s%s%.*s", (int)last->text.length,
                                          last->text.start, between, (int)word.length, word.start));
        return true;
    }
    const int at = words->at - 1;
    if (operand_is_photograph(arguments->command, word)) {
        arguments->photographs[arguments->photograph_count++] = words->all[at];
        words->last = NULL;
        return true;
    }
    /* behind the first of several lenses or the words of 8x42 330 ft no length is the focal one */
    const size_t used =
        arguments_go_on(arguments)
            ? 0
            : operands_read(arguments->command, words->all + at, (size_t)(words->count - at),
                            &arguments->operands[arguments->operand_count], arena);
    if (used > 0) {
        arguments->operand_count++;
        words->at = at + (int)used;
        words->last = NULL;
        return true;
    }
    for (size_t i = 0; i < arguments->count; i++) {
        struct argument *argument = &arguments->all[i];
        unsigned flags = argument->option->flags;
        if ((flags & OPTION_OPERAND) == 0) {
            continue;
        }
        if (!argument->is_given) {
            argument->is_given = true;
            argument->text = word;
            words->last = NULL;
            return true;
        }
        if ((flags & MORE_WORDS) != 0) {
            char between = (flags & OPTION_REST) != 0 ? ' ' : OPTION_MANY_SEPARATOR;
            arguments_append(argument, between, word, arena);
            words->last = NULL;
            return true;
        }
    }
    return unexpected(arguments, words, word, error);
}

/* What --color asks for: known before anything is complained about. */
static enum color_when color_of(int count, char **all)
{
    enum color_when color = COLOR_AUTO;
    for (int i = 0; i < count && strcmp(all[i], "--") != 0; i++) {
        struct text asked = text_behind(text_of(all[i]), "--color=");
        if (strcmp(all[i], "--color") == 0 && i + 1 < count) {
            asked = text_of(all[i + 1]);
        }
        for (int k = 0; asked.start != NULL && color_words[k].word != NULL; k++) {
            color = text_equal(asked, color_words[k].word) ? (enum color_when)k : color;
        }
    }
    return color;
}

/* Standard input has one reader: the batch or a lens. */
static bool check_standard_input(const struct arguments *arguments, struct error *error)
{
    const struct argument *batch = arguments_find(arguments, text_of("batch"));
    bool taken = batch != NULL && batch->is_given && text_equal(batch->text, "-");
    for (size_t i = 0; i < arguments->count && taken; i++) {
        const struct argument *argument = &arguments->all[i];
        if (argument->option->kind == &kind_lens && argument->is_given &&
            text_equal(text_trim(argument->text), "-")) {
            return fail(error, ERROR_USAGE, "--%s - and --batch - cannot both read standard input",
                        argument->option->name);
        }
    }
    return true;
}

bool arguments_parse(struct arguments *arguments, const struct command *command, int count,
                     char **all, struct arena *arena, struct error *error)
{
    struct words words = {.count = count, .all = all, .arena = arena};
    bool options_end = false;
    arguments->command = command;
    arguments->color = color_of(count, all);
    arguments->operands = ARENA_ARRAY(arena, (size_t)count + 1, struct text);
    arguments->photographs = ARENA_ARRAY(arena, (size_t)count + 1, const char *);
    size_t own = command->option_count + command->artifact_count;
    arguments->all = ARENA_ARRAY(arena, own + common_option_count, struct argument);
    for (size_t i = 0; i < own; i++) {
        arguments->all[i].option = command_option(command, i);
        arguments->all[i].is_input = i < command->option_count;
    }
    arguments->count = own;
    const struct option *common = NULL;
    while ((common = command_next_common(command, common)) != NULL) {
        arguments->all[arguments->count].option = common;
        arguments->all[arguments->count++].is_common = true;
    }
    while (words.at < words.count) {
        struct text word = text_of(words.all[words.at++]);
        bool dashed = !options_end && word.length > 1 && word.start[0] == '-';
        bool done;
        if (dashed && word.start[1] == '-' && word.length == 2) {
            options_end = true;
            continue;
        }
        if (dashed && word.start[1] == '-') {
            done = parse_long(arguments, (struct text){word.start + 2, word.length - 2}, &words,
                              error);
        } else if (dashed) {
            done = parse_short(arguments, (struct text){word.start + 1, word.length - 1}, &words,
                               error);
        } else {
            done = parse_operand(arguments, word, &words, arena, error);
        }
        if (!done) {
            return false;
        }
    }
    arguments->given = ARENA_ARRAY(arena, arguments->count, const char *);
    arguments_note_given(arguments);
    return check_standard_input(arguments, error);
}

bool argument_blame(const struct arguments *arguments, const struct argument *argument,
                    struct error *error)
{
    const struct config_entry *entry = argument->entry;
    if (entry == NULL || error->source[0] != '\0' ||
        (error->code != ERROR_USAGE && error->code != ERROR_DOMAIN)) {
        return false;
    }
    const struct error found = *error;
    struct text part = entry->value;
    if (found.caret > 0 && (size_t)found.caret <= part.length) {
        part.start += found.caret - 1;
    }
    config_file_fail(arguments->defaults, entry, part, error, "%s", found.message);
    return found.hint[0] != '\0' && error_hint(error, "%s", found.hint);
}

bool arguments_common(const struct arguments *arguments, const struct reader *reader,
                      struct common *common, struct error *error)
{
    for (size_t i = 0; i < arguments->count; i++) {
        const struct argument *argument = &arguments->all[i];
        const struct option *option = argument->option;
        if (!argument->is_common) {
            continue;
        }
        void *member = (char *)common + option->offset;
        if (argument->is_given && option->kind == &kind_flag) {
            *(bool *)member = true;
        } else if (argument->is_given || option->fallback != NULL) {
            struct text text = argument->is_given ? argument->text : text_of(option->fallback);
            if (!option_read(reader, option, text, member, error)) {
                return argument_blame(arguments, argument, error);
            }
        }
    }
    return true;
}
