/* commands/tool/cmd_help.c - lenscalc help: commands and topics. */
/* SPDX-License-Identifier: MIT */
#include "cli/answer/help.h"
#include "cli/answer/pager.h"
#include "commands/commands.h"
#include "commands/tool/overview.h"
#include "report/terminal.h"

#include <string.h>
#include <unistd.h>

/* A line of the list of commands. */
static void write_entry(const char *name, const char *summary, struct output *output)
{
    enum { SUMMARY_AT = 15 };
    output_printf(output, "  %-12s ", name);
    output_paragraph(output, summary, SUMMARY_AT, SUMMARY_AT, help_width(output));
}

/* What there is: all commands by group. */
static void help_write_overview(struct output *output)
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

struct help_input {
    const char *topic;
};

static const struct option options[] = {
    {OPTION(struct help_input, topic), .name = "topic", .value = "COMMAND|TOPIC",
     .flags = OPTION_OPERAND, .help = "the command or topic to explain; without it all are listed"},
};

static bool help_unknown(const char *topic, struct error *error)
{
    struct nearest nearest = {.typed = text_of(topic)};
    for (size_t i = 0; commands[i] != NULL; i++) {
        nearest_offer(&nearest, text_of(commands[i]->name));
    }
    for (const struct topic_text *at = help_topics; at->name != NULL; at++) {
        nearest_offer(&nearest, text_of(at->name));
    }
    fail(error, ERROR_USAGE, "there is no command or topic '%.60s'", topic);
    if (nearest.best.start != NULL) {
        error_hint(error, "did you mean '%.*s'?", (int)nearest.best.length, nearest.best.start);
    } else {
        error_hint(error, "see 'lenscalc help' and 'lenscalc help topics'");
    }
    return false;
}

static bool help_write_page(const struct help_input *input, struct output *output,
                            struct arena *arena, struct error *error)
{
    if (input->topic == NULL) {
        help_write_overview(output);
        return true;
    }
    const struct topic_text *topic = help_topic_find(input->topic);
    if (topic != NULL) {
        output_printf(output, "%s: %s\n\n", topic->name, topic->summary);
        output_wrapped(output, topic->text, help_width(output));
        if (topic->list != NULL) {
            topic->list(output);
        }
        return true;
    }
    const struct command *command = command_find(text_of(input->topic));
    if (command == NULL) {
        return help_unknown(input->topic, error);
    }
    help_write(command, output, arena);
    return true;
}

static bool help_explain(const struct artifact_job *job, struct output *output, struct error *error)
{
    struct output page;
    output_inside(&page, job->run->arena);
    page.width = job->path == NULL ? terminal_width(STDOUT_FILENO) : 0;
    if (!help_write_page(job->inputs[0], &page, job->run->arena, error)) {
        return false;
    }
    const struct text text = output_kept(&page);
    if (job->path != NULL || !pager_show(text)) {
        output_text(output, text.start, text.length);
    }
    return true;
}

static const struct artifact artifacts[] = {{ARTIFACT_ANSWER(NULL), .make = help_explain}};

static const struct example examples[] = {
    {"help", "all commands"},
    {"help dof", "one command"},
    {"help ranges", "a topic: values, units, ranges, output, batch, status, version or topics"},
    {NULL, NULL},
};

const struct command command_help = {
    .name = "help",
    .group = "tool",
    .summary = "explain a command or a topic",
    COMMAND_ASKS(struct help_input),
    COMMAND_MAKES(artifacts),
};
