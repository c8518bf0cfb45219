/* cli/question/arguments.h - argv into the texts of options. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_QUESTION_ARGUMENTS_H
#define LENSCALC_CLI_QUESTION_ARGUMENTS_H

#include "cli/question/command.h"
#include "report/terminal.h"

/* An option and what was typed for it. */
struct argument {
    const struct option *option;
    bool is_input;  /* of the command's input struct */
    bool is_common; /* of struct common; if neither, of an artifact */
    bool is_given;
    struct text text; /* empty for a flag */
    size_t room;      /* characters behind its start that are its own; 0: it is a word as typed */
};

/* All options of a command: its own first, those of its artifacts, then the common ones. */
struct arguments {
    const struct command *command;
    struct argument *all;
    size_t count;
    const char **given; /* their names: few, and each row of a sweep asks for several */
    size_t given_count;
    enum color_when color; /* of messages, also of those about these words */
};

/*
 * Find the options in the words behind the command's name.
 *
 * Errors    ERROR_USAGE: unknown option (with a suggestion), a value that is missing or too much,
 *           an option given twice, a word that belongs to nothing
 */
bool arguments_parse(struct arguments *arguments, const struct command *command, int count,
                     char **words, struct arena *arena, struct error *error);

/* The option of this name; null if the command has none. */
struct argument *arguments_find(const struct arguments *arguments, struct text name);

/* Was the option of exactly this name given? */
bool arguments_given(const struct arguments *arguments, const char *name);

/*
 * The common options into their struct.
 *
 * Errors    as option_read
 */
bool arguments_common(const struct arguments *arguments, const struct reader *reader,
                      struct common *common, struct error *error);

#endif
