/* commands/tool/overview.c - what there is: commands by group, and topics of help. */
/* SPDX-License-Identifier: MIT */
#include "commands/tool/overview.h"

#include "cli/answer/help.h"
#include "commands/commands.h"

#include <string.h>
#include <unistd.h>

/* A line of the list of commands. */
static void write_entry(const char *name, const char *summary, struct output *output)
{
    enum { SUMMARY_AT = 15 };
    output_printf(output, "  %-12s ", name);
    output_paragraph(output, summary, SUMMARY_AT, SUMMARY_AT, help_width(output));
}

void help_write_overview(struct output *output)
{
    const char *group = "";
    output_string(output, "lenscalc: optics for photographers, lens designers and programmers\n\n"
                          "  lenscalc COMMAND [options]\n  lenscalc COMMAND --help\n");
    for (size_t i = 0; commands[i] != NULL; i++) {
        if (strcmp(group, commands[i]->group) != 0) {
            group = commands[i]->group;
            output_printf(output, "\n%s:\n", group);
        }
        write_entry(commands[i]->name, commands[i]->summary, output);
    }
    output_string(output, "\ntopics (lenscalc help TOPIC):\n");
    for (const struct topic_text *topic = help_topics; topic->name != NULL; topic++) {
        write_entry(topic->name, topic->summary, output);
    }
    output_string(output, "\nFor example:\n"
                          "  lenscalc dof -f 50mm -N 2.8 -s 3m\n"
                          "  lenscalc fov -f 24mm --sensor aps-c\n");
}

void help_short(void)
{
    struct arena arena = {0};
    struct output output;
    output_begin(&output, STDERR_FILENO, &arena);
    output_wrapped(&output,
                   "usage: lenscalc COMMAND [options], for example:\n"
                   "  lenscalc dof -f 50mm -N 2.8 -s 3m",
                   help_width(&output));
    const char *line = "commands:";
    for (size_t i = 0; commands[i] != NULL; i++) {
        line = arena_printf(&arena, "%s %s", line, commands[i]->name);
    }
    output_paragraph(&output, line, 0, 2, help_width(&output));
    output_wrapped(&output, "more: lenscalc help, lenscalc COMMAND --help", help_width(&output));
    output_flush(&output);
    arena_free(&arena);
}
