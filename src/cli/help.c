/* cli/help.c - help from the tables that parse. */
/* SPDX-License-Identifier: MIT */
#include "cli/help.h"

#include "cli/complain.h"

#include <stdio.h>
#include <string.h>

enum { NAME_WIDTH = 30 };

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
    output_printf(output, "%-*s%s%s", NAME_WIDTH, name,
                  strlen(name) >= NAME_WIDTH ? "\n                              " : "",
                  option->help);
    const struct unit *unit = option_unit(option);
    const char *separator = " (";
    if (unit != NULL && unit->name[0] != '\0') {
        output_printf(output, "%s%s", separator, unit->label);
        separator = "; ";
    }
    const char *range = option_range(option, arena);
    if (range[0] != '\0') {
        output_printf(output, "%s%s", separator, range);
        separator = "; ";
    }
    if (option->fallback != NULL) {
        output_printf(output, "%sdefault %s", separator, option->fallback);
        separator = "; ";
    }
    output_string(output, separator[0] == ';' ? ")\n" : "\n");
    for (size_t i = 0; option_word(option, i) != NULL; i++) {
        const struct word *word = option_word(option, i);
        output_printf(output, "%-*s  %-14s %s\n", NAME_WIDTH, "", word->word, word->help);
    }
}

static void write_usage(const struct command *command, struct output *output)
{
    output_printf(output, "lenscalc %s", command->name);
    for (size_t i = 0; i < command->option_count; i++) {
        const struct option *option = &command->options[i];
        if ((option->flags & OPTION_OPERAND) != 0) {
            bool many = (option->flags & (OPTION_MANY | OPTION_TOGETHER)) != 0;
            output_printf(output, " [%s]%s", option->value, many ? "..." : "");
        }
    }
    output_printf(output, " [options]: %s\n", command->summary);
}

void help_write(const struct command *command, struct output *output, struct arena *arena)
{
    write_usage(command, output);
    output_string(output, "\nExamples:\n");
    for (const struct example *example = command->examples; example->arguments != NULL; example++) {
        output_printf(output, "  lenscalc %s\n      %s\n", example->arguments, example->help);
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
    output_printf(output,
                  "\nUnits may always be written (50mm 10ft 5ft6in 1/125s); a list 1.4,2,2.8 "
                  "or a range 1..10:0.5\nsweeps an option. More in lenscalc-%s(1) and "
                  "lenscalc(1).\n",
                  command->name);
}

int help_command(const struct command *command, struct arena *arena)
{
    struct output output;
    struct error error;
    if (!output_open(&output, NULL, arena, &error)) {
        return (int)error.code;
    }
    help_write(command, &output, arena);
    if (!output_close(&output, true, &error)) {
        error_print(&error, command->name);
        return (int)error.code;
    }
    return 0;
}

void help_write_overview(struct output *output)
{
    const char *group = "";
    output_string(output, "lenscalc: optics for photographers, lens people and programmers\n\n"
                          "  lenscalc COMMAND [options]\n  lenscalc COMMAND --help\n");
    for (size_t i = 0; commands[i] != NULL; i++) {
        if (strcmp(group, commands[i]->group) != 0) {
            group = commands[i]->group;
            output_printf(output, "\n%s:\n", group);
        }
        output_printf(output, "  %-12s %s\n", commands[i]->name, commands[i]->summary);
    }
    output_string(output, "\ntopics (lenscalc help TOPIC):\n");
    for (const struct topic_text *topic = help_topics; topic->name != NULL; topic++) {
        output_printf(output, "  %-12s %s\n", topic->name, topic->summary);
    }
    output_string(output, "\nFor example:\n"
                          "  lenscalc dof -f 50mm -N 2.8 -s 3m\n"
                          "  lenscalc fov -f 24mm --sensor aps-c\n");
}

void help_short(void)
{
    fputs("usage: lenscalc COMMAND [options], for example: lenscalc dof -f 50mm -N 2.8 -s 3m\n"
          "commands:",
          stderr);
    for (size_t i = 0; commands[i] != NULL; i++) {
        fprintf(stderr, " %s", commands[i]->name);
    }
    fputs("\nmore: lenscalc help, lenscalc COMMAND --help\n", stderr);
}
