/* cli/answer/help.h - help from the tables that parse. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_ANSWER_HELP_H
#define LENSCALC_CLI_ANSWER_HELP_H

#include "cli/question/command.h"

/* Examples, then options with units, defaults and ranges, on standard output. The exit status. */
int help_command(const struct command *command, struct arena *arena);

/* The same into an output. */
void help_write(const struct command *command, struct output *output, struct arena *arena);

/* What there is: all commands by group. */
void help_write_overview(struct output *output);

/* What all commands have in common, by topic; ends with a null name. */
struct topic_text {
    const char *name, *summary, *text;
    void (*list)(struct output *output); /* writes what follows the text; null = nothing does */
};

/* Columns of help: 80, or those of a narrower terminal. */
size_t help_width(const struct output *output);

extern const struct topic_text help_topics[];

/* The topic of this name; null if there is none. */
const struct topic_text *help_topic_find(const char *name);

/* Short help for who typed the name alone, on standard error. */
void help_short(void);

#endif
