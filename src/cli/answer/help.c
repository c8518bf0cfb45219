/* cli/answer/help.c - help from the tables that parse. */
/* SPDX-License-Identifier: MIT */
#include "cli/answer/help.h"

#include "cli/answer/complain.h"
#include "cli/answer/pager.h"
#include "cli/question/operands.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { NAME_WIDTH = 30, WORD_WIDTH = 15, WIDTH = 80, NARROWEST = 40 };

size_t help_width(const struct output *output)
{
    return output->width >= NARROWEST && output->width < WIDTH ? output->width : WIDTH;
}

/* "  -f, --focal-length LENGTH" */
static const char *option_words(const struct option *option, struct arena *arena)
{
    char letter[8] = "    ";
    if (option->letter != '\0') {
        snprintf(letter, sizeof letter, "-%c, ", option->letter);
    }
    const char *value = option->value != NULL ? option->value : "";
    return arena_printf(arena, "  %s--%s%s%s", letter, option->name, value[0] != '\0' ? " " : "",
                        value);
}

/* Its words padded, then what it is for, its unit, range and default. */
static void write_option(const struct option *option, struct output *output, struct arena *arena)
{
    const char *name = option_words(option, arena);
    output_printf(output, "%-*s", NAME_WIDTH, name);
    if (strlen(name) >= NAME_WIDTH) {
        output_printf(output, "\n%*s", NAME_WIDTH, "");
    }
    /* "(mm; above 0 mm; default 50)": unit, range and default of an option; "" if it has none */
    const struct unit *unit = option_unit(option);
    const char *range = option_range(option, arena), *facts = "";
    if (unit != NULL && unit->name[0] != '\0') {
        facts = arena_printf(arena, " (%s", unit->label);
    }
    if (range[0] != '\0') {
        facts = arena_printf(arena, "%s%s%s", facts, facts[0] != '\0' ? "; " : " (", range);
    }
    if (option->fallback != NULL) {
        facts = arena_printf(arena, "%s%sdefault %s", facts, facts[0] != '\0' ? "; " : " (",
                             option->fallback);
    }
    output_paragraph(
        output, arena_printf(arena, "%s%s%s", option->help, facts, facts[0] != '\0' ? ")" : ""),
        NAME_WIDTH, NAME_WIDTH, help_width(output));
    for (size_t i = 0; option_word(option, i) != NULL; i++) {
        const struct word *word = option_word(option, i);
        enum { WORD_AT = NAME_WIDTH + 2, HELP_AT = WORD_AT + WORD_WIDTH };
        output_printf(output, "%*s%-*s ", WORD_AT, "", WORD_WIDTH - 1, word->word);
        size_t length = strlen(word->word);
        output_paragraph(output, word->help, length < WORD_WIDTH ? HELP_AT : WORD_AT + 1 + length,
                         HELP_AT, help_width(output));
    }
}

/* The words of an example, in lines that a shell reads as one. */
static void write_example(const char *words, struct output *output)
{
    enum { BEGINS = sizeof "  lenscalc " - 1, INDENT = 6 };
    size_t room = help_width(output) - BEGINS;
    output_string(output, "  lenscalc ");
    while (strlen(words) > room) {
        /* the last place before which a shell lets a line end */
        size_t end = 0;
        char quote = '\0';
        for (size_t i = 0; words[i] != '\0' && i < room - 2; i++) {
            if (words[i] == quote) {
                quote = '\0';
            } else if (quote == '\0' && (words[i] == '"' || words[i] == '\'')) {
                quote = words[i];
            } else if (quote == '\0' && words[i] == ' ' && words[i + 1] == '-') {
                end = i;
            }
        }
        if (end == 0) {
            break;
        }
        output_printf(output, "%.*s \\\n%*s", (int)end, words, INDENT, "");
        words += end + 1;
        room = help_width(output) - INDENT;
    }
    output_printf(output, "%s\n", words);
}

static void help_write_usage(const struct command *command, struct output *output,
                             struct arena *arena)
{
    const char *usage = arena_printf(arena, "lenscalc %s", command->name);
    for (size_t i = 0; i < command->option_count; i++) {
        const struct option *option = &command->options[i];
        if ((option->flags & OPTION_OPERAND) != 0) {
            bool many = (option->flags & (OPTION_MANY | OPTION_TOGETHER)) != 0;
            usage = arena_printf(arena, "%s [%s]%s", usage, option->value, many ? "..." : "");
        }
    }
    output_paragraph(output,
                     arena_printf(arena, "%s%s [options]: %s", usage,
                                  operands_usage(command, arena), command->summary),
                     0, 2, help_width(output));
}

/* What an option is for, in so many characters: no more than its first clause. */
static void write_clause(const struct option *option, size_t room, struct output *output)
{
    const char *const help = option->help;
    const size_t whole = strcspn(help, ";:");
    size_t length = whole, clause = 0, word = 0;
    for (size_t i = 1; i < whole && whole > room && i + sizeof " ..." <= room; i++) {
        if (help[i] == ' ') {
            word = i;
            clause = help[i - 1] == ',' || help[i + 1] == '(' ? i : clause;
        }
    }
    if (whole > room) {
        length = clause > 0 ? clause : word;
    }
    const bool is_cut = whole > room && clause == 0;
    while (length > 0 && strchr(" ,", help[length - 1]) != NULL) {
        length--;
    }
    output_printf(output, "%.*s%s\n", (int)length, help, is_cut ? " ..." : "");
}

static void help_write_brief(const struct command *command, struct output *output,
                             struct arena *arena)
{
    help_write_usage(command, output, arena);
    output_character(output, '\n');
    for (const struct example *example = command->examples; example->arguments != NULL; example++) {
        write_example(example->arguments, output);
    }
    output_character(output, '\n');
    for (size_t i = 0; command_option(command, i) != NULL; i++) {
        const struct option *option = command_option(command, i);
        const char *name = option_words(option, arena);
        const size_t at = strlen(name) < NAME_WIDTH ? NAME_WIDTH : strlen(name) + 1;
        output_printf(output, "%-*s", (int)at, name);
        write_clause(option, help_width(output) - at, output);
    }
    output_character(output, '\n');
    output_wrapped(output,
                   arena_printf(arena,
                                "All about them: lenscalc %s --help. Options of every command, as "
                                "--csv: lenscalc help options.",
                                command->name),
                   help_width(output));
}

void help_write_common(struct output *output)
{
    for (size_t i = 0; i < common_option_count; i++) {
        write_option(&common_options[i], output, output->arena);
    }
}

void help_write(const struct command *command, struct output *output, struct arena *arena)
{
    help_write_usage(command, output, arena);
    output_string(output, "\nExamples:\n");
    for (const struct example *example = command->examples; example->arguments != NULL; example++) {
        write_example(example->arguments, output);
        output_spaces(output, 6);
        output_paragraph(output, example->help, 6, 6, help_width(output));
    }
    output_string(output, "\nOptions:\n");
    for (size_t i = 0; command_option(command, i) != NULL; i++) {
        write_option(command_option(command, i), output, arena);
    }
    output_string(output, "\nCommon options:\n");
    const struct option *common = NULL;
    while ((common = command_next_common(command, common)) != NULL) {
        write_option(common, output, arena);
    }
    output_character(output, '\n');
    output_wrapped(
        output,
        arena_printf(arena,
                     "Units may always be written (50mm 10ft 5ft6in 1/125s); a list 1.4,2,2.8 or a "
                     "range 1..10:0.5 sweeps an option. More in lenscalc-%s(1) and lenscalc(1).",
                     command->name),
        help_width(output));
}

int help_command(const struct command *command, bool is_brief, struct arena *arena)
{
    struct output page, output;
    struct error error;
    output_inside(&page, arena);
    page.width = terminal_width(STDOUT_FILENO);
    if (is_brief) {
        help_write_brief(command, &page, arena);
    } else {
        help_write(command, &page, arena);
    }
    const struct text text = output_kept(&page);
    if (!is_brief && pager_show(text)) {
        return 0;
    }
    if (!output_open(&output, NULL, arena, &error)) {
        return (int)error.code;
    }
    output_text(&output, text.start, text.length);
    if (!output_close(&output, true, &error)) {
        error_print(&error, command->name, COLOR_AUTO);
        return (int)error.code;
    }
    return 0;
}
