/* commands/tool/candidates.c - what may stand at the end of a command line that is being typed. */
/* SPDX-License-Identifier: MIT */
#include "commands/tool/candidates.h"
#include "commands/commands.h"
#include "commands/tool/overview.h"

#include "cli/answer/columns.h"
#include "cli/answer/help.h"
#include "cli/question/configuration.h"
#include "cli/question/operands.h"
#include "exchange/lens_open.h"
#include "report/row.h"

#include <string.h>

/* The words, and where the candidates go. */
struct typed_words {
    struct text *words;
    size_t count; /* at least 1 */
    const struct command *command;
    const char *before; /* of the last word, stands before every candidate: "--model=" */
    struct text typed;  /* what follows that */
    struct run *run;
    struct output *output;
    const struct sheet *sheet; /* of a list; its first column has the names */
};

static char candidates_lower(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

/* Does the candidate begin with what is typed? Case does not count. */
static bool begins_as_typed(const struct typed_words *typing, const char *candidate)
{
    size_t i = 0;
    while (i < typing->typed.length &&
           candidates_lower(typing->typed.start[i]) == candidates_lower(candidate[i])) {
        i++;
    }
    return i == typing->typed.length;
}

static void candidates_offer(const struct typed_words *typing, const char *candidate,
                             const char *help)
{
    if (begins_as_typed(typing, candidate) && strpbrk(candidate, "\n\t") == NULL) {
        output_string(typing->output, typing->before);
        output_string(typing->output, candidate);
        output_string(typing->output, help != NULL ? "\t" : "");
        output_string(typing->output, help != NULL ? help : "");
        output_character(typing->output, '\n');
    }
}

/* -------- names that lists hold -------- */

static bool offer_row(struct run *run, const void *row)
{
    const struct typed_words *typing = run->driver;
    const char *name = row_text(row, &typing->sheet->columns[0]);
    if (name != NULL) {
        candidates_offer(typing, name, NULL);
    }
    /* other names are many: only who begins one sees it */
    for (size_t i = 0; i < typing->sheet->column_count && typing->typed.length > 0; i++) {
        const struct column *column = &typing->sheet->columns[i];
        bool is_other = strcmp(column->name, "aliases") == 0 && row_text(row, column) != NULL;
        struct text rest = text_of(is_other ? row_text(row, column) : "");
        while (rest.start != NULL && rest.length > 0) {
            struct text other = text_trim(text_cut(&rest, ','));
            candidates_offer(typing, arena_string(run->arena, other.start, other.length), name);
        }
    }
    return true;
}

/* The names of "lenscalc list TOPIC". */
static void offer_list(struct typed_words *typing, const char *topic)
{
    const struct command *list = command_find(text_of("list"));
    const struct option *option = &list->options[0];
    void *input = arena_array(typing->run->arena, 1, list->input_size);
    struct error ignored;
    int i = 0;
    while (strcmp(option_word(option, (size_t)i)->word, topic) != 0) {
        i++;
    }
    *(int *)((char *)input + option->offset) = i;
    struct run run = *typing->run;
    run.emit = offer_row;
    run.driver = typing;
    typing->sheet = list->choose_sheet(input, NULL);
    list->run(input, &run, &ignored); /* nothing to list is nothing to offer */
}

/* Where the names of a kind of value come from. */
static const struct {
    const struct option_kind *kind;
    const char *lists[2];
    bool or_file;
} sources[] = {
    {&kind_sensor, {"formats", "cameras"}, false}, {&kind_lens, {"lenses", NULL}, true},
    {&kind_glass, {"glasses", NULL}, false},       {&kind_film, {"films", NULL}, false},
    {&kind_scene, {"scenes", NULL}, false},        {&kind_loss, {"filters", NULL}, false},
};

static const struct word criteria[] = {
    {"d/1500", "a part of the sensor's diagonal"},
    {"2px", "pixels"},
    {"airy", "the disc of diffraction"},
    {"print", "seen on a print"},
    {NULL, NULL},
};

static const struct word planes[] = {
    {"paraxial", "the paraxial image plane"},
    {"table", "the one of the lens's table"},
    {"best", "the smallest spot"},
    {NULL, NULL},
};

static const struct word *words_of_kind(const struct option_kind *kind)
{
    if (kind == &kind_coc) {
        return criteria;
    }
    return kind == &kind_plane ? planes : NULL;
}

/* -------- what depends on the words before -------- */

/* By its letter, or by its name where `letter` is 0. */
static bool is_called(const struct option *option, char letter, struct text name)
{
    return letter != '\0' ? option->letter == letter : text_same_name(name, text_of(option->name));
}

static const struct option *find_option(const struct command *command, char letter,
                                        struct text name)
{
    const struct option *common = NULL;
    for (size_t i = 0; command_option(command, i) != NULL; i++) {
        if (is_called(command_option(command, i), letter, name)) {
            return command_option(command, i);
        }
    }
    while ((common = command_next_common(command, common)) != NULL &&
           !is_called(common, letter, name)) {
    }
    return common;
}

/* The option that a word names; `value` receives what stands behind its '=', if there is one. */
static const struct option *candidates_option_of(const struct command *command, struct text word,
                                                 struct text *value)
{
    *value = (struct text){NULL, 0};
    if (word.length == 2 && word.start[0] == '-' && word.start[1] != '-') {
        return find_option(command, word.start[1], word);
    }
    struct text name = text_behind(word, "--");
    if (name.start == NULL) {
        return NULL;
    }
    *value = name;
    name = text_cut(value, '=');
    return find_option(command, '\0', name);
}

static bool takes_value(const struct option *option)
{
    return option != NULL && option->kind != &kind_flag;
}

static bool is_operand(const struct option *option)
{
    return (option->flags & OPTION_OPERAND) != 0;
}

/* The value that an option has among the words, also as an operand; null start: none. */
static struct text candidates_value_of(const struct typed_words *typing,
                                       const struct option *wanted)
{
    struct text value;
    for (size_t i = 1; i + 1 < typing->count && wanted != NULL; i++) {
        const struct option *option =
            candidates_option_of(typing->command, typing->words[i], &value);
        if (takes_value(option) && value.start == NULL) {
            value = typing->words[++i];
        }
        bool bare = option == NULL && is_operand(wanted);
        if (option == wanted || bare) {
            return bare ? typing->words[i] : value;
        }
    }
    return (struct text){NULL, 0};
}

/* The first option of a kind that the command has. */
static const struct option *of_kind(const struct command *command, const struct option_kind *kind)
{
    size_t i = 0;
    while (command_option(command, i) != NULL && command_option(command, i)->kind != kind) {
        i++;
    }
    return command_option(command, i);
}

/* The positions of the lens that is named. */
static void offer_positions(const struct typed_words *typing)
{
    const struct option *option = of_kind(typing->command, &kind_lens);
    option = option != NULL ? option : of_kind(typing->command, &kind_lens_text);
    struct text name =
        option != NULL ? candidates_value_of(typing, option) : (struct text){NULL, 0};
    struct error ignored;
    struct lens lens;
    /* standard input belongs to the shell */
    if (name.start == NULL || text_equal(name, "-") ||
        !lens_open(typing->run->db, name, typing->run->arena, &lens, &ignored)) {
        return;
    }
    for (size_t i = 0; i < lens.position_count; i++) {
        candidates_offer(typing, lens.positions[i], NULL);
    }
    candidates_offer(typing, "all", "every position");
}

/* The kits of the user's configuration, if it can be read. */
static void offer_kits(const struct typed_words *typing)
{
    struct config_file file;
    const char *opened;
    struct error ignored;
    struct arena *arena = typing->run->arena;
    const bool is_read = configuration_open(&file, &opened, arena, &ignored);
    for (size_t i = 0; is_read && i < file.section_count; i++) {
        const struct text name = file.sections[i].section;
        if (file.sections[i].scope == CONFIG_KIT) {
            candidates_offer(typing, arena_string(arena, name.start, name.length), NULL);
        }
    }
}

/* -------- what is being typed -------- */

/* In a list only what follows the last comma is being typed. */
static void typed_item(struct typed_words *typing)
{
    const struct text typed = typing->typed;
    size_t at = typed.length;
    while (at > 0 && typed.start[at - 1] != ',') {
        at--;
    }
    typing->before =
        arena_printf(typing->run->arena, "%s%.*s", typing->before, (int)at, typed.start);
    typing->typed = (struct text){typed.start + at, typed.length - at};
}

static void offer_value(struct typed_words *typing, const struct option *option)
{
    bool is_columns = strcmp(option->name, "columns") == 0;
    bool is_position = strcmp(option->name, "position") == 0;
    bool is_file = (option->flags & OPTION_FILE) != 0;
    const bool is_column = strcmp(option->name, "value") == 0;
    const bool is_kit = strcmp(option->name, "kit") == 0;
    if (option->kind->is_list || is_columns || is_position || is_kit) {
        typed_item(typing);
    }
    for (size_t j = 0; option_word(option, j) != NULL; j++) {
        candidates_offer(typing, option_word(option, j)->word, option_word(option, j)->help);
    }
    const struct word *word = words_of_kind(option->kind);
    for (; word != NULL && word->word != NULL; word++) {
        candidates_offer(typing, word->word, word->help);
    }
    for (size_t i = 0; i < sizeof sources / sizeof sources[0]; i++) {
        bool is_this = sources[i].kind == option->kind;
        for (size_t k = 0; k < 2 && is_this && sources[i].lists[k] != NULL; k++) {
            offer_list(typing, sources[i].lists[k]);
        }
        is_file = is_file || (is_this && sources[i].or_file);
    }
    if (is_columns || is_column) {
        size_t count;
        const struct column_row *rows =
            columns_describe(typing->command, &count, typing->run->arena);
        for (size_t i = 0; i < count; i++) {
            candidates_offer(typing, rows[i].column, rows[i].label);
        }
    } else if (is_position) {
        offer_positions(typing);
    } else if (is_kit) {
        offer_kits(typing);
    }
    if (is_file) {
        output_string(typing->output, CANDIDATES_FILES "\n");
    }
}

static void offer_option(const struct typed_words *typing, const struct option *option)
{
    candidates_offer(typing, arena_printf(typing->run->arena, "--%s", option->name), option->help);
}

static void offer_commands(const struct typed_words *typing)
{
    for (size_t i = 0; commands[i] != NULL; i++) {
        candidates_offer(typing, commands[i]->name, commands[i]->summary);
    }
}

/* How many of the words before the last one are operands? */
static size_t count_operands(const struct typed_words *typing)
{
    size_t count = 0;
    for (size_t i = 1; i + 1 < typing->count; i++) {
        struct text value;
        const struct option *option =
            candidates_option_of(typing->command, typing->words[i], &value);
        bool dashed = typing->words[i].length > 1 && typing->words[i].start[0] == '-';
        i += takes_value(option) && value.start == NULL;
        count += !dashed;
    }
    return count;
}

/* The operand that the last word is; null: none. */
static const struct option *operand_of(const struct typed_words *typing)
{
    size_t before = count_operands(typing);
    for (size_t i = 0; command_option(typing->command, i) != NULL; i++) {
        const struct option *option = command_option(typing->command, i);
        bool many = (option->flags & (OPTION_MANY | OPTION_TOGETHER | OPTION_REST)) != 0;
        if (is_operand(option) && (before-- == 0 || many)) {
            return option;
        }
    }
    return NULL;
}

static void offer_operand(struct typed_words *typing)
{
    const struct option *operand = operand_of(typing);
    const struct text first = typing->count > 2 ? typing->words[1] : text_of("");
    if (typing->command == command_find(text_of("help")) && typing->count == 2) {
        offer_commands(typing);
        for (const struct topic_text *topic = help_topics; topic->name != NULL; topic++) {
            candidates_offer(typing, topic->name, topic->summary);
        }
    } else if (text_equal(first, "columns") || text_equal(first, "options")) {
        offer_commands(typing); /* of list: whose they are */
    } else if (operand != NULL && (operand->flags & OPTION_TOGETHER) != 0) {
        output_string(typing->output, CANDIDATES_FILES "\n");
    } else if (operand != NULL) {
        offer_value(typing, operand);
    } else if (command_takes_photographs(typing->command)) {
        output_string(typing->output, CANDIDATES_FILES "\n");
    }
}

void candidates_write(const char *words, struct run *run, struct output *output)
{
    struct typed_words typing = {.before = "", .run = run, .output = output};
    struct text value;
    /* the words, and the command they ask; null: that is not known */
    struct text rest = text_of(words);
    struct arena *arena = typing.run->arena;
    typing.words = ARENA_ARRAY(arena, rest.length + 1, struct text);
    char **strings = ARENA_ARRAY(arena, rest.length + 1, char *);
    while (rest.start != NULL) {
        struct text word = text_cut(&rest, OPTION_MANY_SEPARATOR);
        strings[typing.count] = arena_string(arena, word.start, word.length);
        typing.words[typing.count++] = word;
    }
    typing.typed = typing.words[typing.count - 1];
    typing.command = command_find(typing.words[0]);
    if (typing.command != NULL) {
        typing.command = command_asked(typing.command, (int)typing.count - 1, strings + 1);
    }
    if (typing.count == 1) {
        offer_commands(&typing);
        return;
    }
    if (typing.command == NULL) {
        return;
    }
    struct lensdb own = *run->db;
    struct text folder =
        candidates_value_of(&typing, find_option(typing.command, '\0', text_of("lensdb")));
    if (folder.start != NULL) {
        own = (struct lensdb){.arena = own.arena,
                              .directory = arena_string(run->arena, folder.start, folder.length)};
    }
    struct run within = *run;
    within.db = &own;
    typing.run = &within;
    const struct text last = typing.typed;
    const struct option *option =
        candidates_option_of(typing.command, typing.words[typing.count - 2], &value);
    if (typing.count > 2 && takes_value(option) && value.start == NULL) {
        offer_value(&typing, option);
        return;
    }
    option = candidates_option_of(typing.command, last, &value);
    if (takes_value(option) && value.start != NULL) {
        typing.before = arena_string(run->arena, last.start, (size_t)(value.start - last.start));
        typing.typed = value;
        offer_value(&typing, option);
    } else if (last.length > 0 && last.start[0] == '-') {
        const struct option *other = NULL;
        for (size_t i = 0; command_option(typing.command, i) != NULL; i++) {
            offer_option(&typing, command_option(typing.command, i));
        }
        while ((other = command_next_common(typing.command, other)) != NULL) {
            offer_option(&typing, other);
        }
    } else {
        offer_operand(&typing);
    }
}
