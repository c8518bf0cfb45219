/* commands/tool/cmd_help.c - lenscalc help: commands and topics. */
/* SPDX-License-Identifier: MIT */
#include "cli/answer/help.h"
#include "commands/commands.h"
#include "commands/tool/overview.h"
#include "report/terminal.h"

#include <string.h>
#include <unistd.h>

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

static void write_topic(const struct topic_text *topic, struct output *output)
{
    output_printf(output, "%s: %s\n\n", topic->name, topic->summary);
    output_wrapped(output, topic->text, help_width(output));
    if (topic->list != NULL) {
        topic->list(output);
    }
}

static bool help_explain(const struct artifact_job *job, struct output *output, struct error *error)
{
    const struct help_input *input = job->inputs[0];
    output->width = job->path == NULL ? terminal_width(STDOUT_FILENO) : 0;
    if (input->topic == NULL) {
        help_write_overview(output);
        return true;
    }
    const struct topic_text *topic = help_topic_find(input->topic);
    if (topic != NULL) {
        write_topic(topic, output);
        return true;
    }
    const struct command *command = command_find(text_of(input->topic));
    if (command == NULL) {
        return help_unknown(input->topic, error);
    }
    help_write(command, output, job->run->arena);
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
