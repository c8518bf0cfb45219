/* cli/answer/help.c - help from the tables that parse. */
/* SPDX-License-Identifier: MIT */
#include "cli/answer/help.h"

#include "cli/answer/complain.h"
#include "cli/question/operands.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { NAME_WIDTH = 30, WORD_WIDTH = 15, WIDTH = 80, NARROWEST = 40 };

size_t help_width(const struct output *output)
{
    return output->width >= NARROWEST && output->width < WIDTH ? output->width : WIDTH;
}

/* "-f, --focal-length LENGTH" padded, then what it is for, its unit, range and default. */
static void write_option(const struct option *option, struct output *output, struct arena *arena)
{
    char letter[8] = "    ";
    if (option->letter != '\0') {
        snprintf(letter, sizeof letter, "-%c, ", option->letter);
    }
    const char *value = option->value != NULL ? option->value : "";
    const char *name = arena_printf(arena, "  %s--%s%s%s", letter, option->name,
                                    value[0] != '\0' ? " " : "", value);
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

void help_write(const struct command *command, struct output *output, struct arena *arena)
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

int help_command(const struct command *command, struct arena *arena)
{
    struct output output;
    struct error error;
    if (!output_open(&output, NULL, arena, &error)) {
        return (int)error.code;
    }
    output.width = terminal_width(STDOUT_FILENO);
    help_write(command, &output, arena);
    if (!output_close(&output, true, &error)) {
        error_print(&error, command->name, COLOR_AUTO);
        return (int)error.code;
    }
    return 0;
}
