/* cli/question/arguments.h - argv into the texts of options. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_QUESTION_ARGUMENTS_H
#define LENSCALC_CLI_QUESTION_ARGUMENTS_H

#include "cli/question/command.h"
#include "file/config_file.h"
#include "report/terminal.h"

/* An option and what was typed for it, or stands for it in the configuration. */
struct argument {
    const struct option *option;
    bool is_input;  /* of the command's input struct */
    bool is_common; /* of struct common; if neither, of an artifact */
    bool is_given;
    struct text text; /* empty for a flag */
    size_t room;      /* characters behind its start that are its own; 0: it is a word as typed */
    const struct config_entry *entry; /* of the configuration; null: it was typed */
    const char *called;  /* "--bellows", a name of the trade that was typed; null: its own */
    const char *reading; /* what is said beside the answer of how that name was read; or null */
};

/* All options of a command: its own first, those of its artifacts, then the common ones. */
struct arguments {
    const struct command *command;
    struct argument *all;
    size_t count;
    const char **given; /* their names: few, and each row of a sweep asks for several */
    size_t given_count;
    struct text *operands; /* values without their options, see cli/question/operands.h */
    size_t operand_count;
    const char **photographs; /* files that stand without an option, too */
    size_t photograph_count;
    bool is_hyperfocal;    /* "--distance hyperfocal": --far inf of rows without a distance */
    enum color_when color; /* of messages, also of those about these words */
    const struct config_file *defaults; /* of the user's; null: nobody looked for any */
};

/*
 * Find the options in the words behind the command's name. Values that stand without theirs wait
 * for arguments_settle.
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

/* Note the names of those that are given, after some were added or taken away. */
void arguments_note_given(struct arguments *arguments);

/* One that comes from the configuration is not given after all. */
void arguments_withdraw(struct arguments *arguments, struct argument *argument);

/* Who has the last word: what was typed, then a kit, then the command's own default. */
enum argument_rank { RANK_ALL, RANK_COMMAND, RANK_KIT, RANK_TYPED };
enum argument_rank argument_rank(const struct argument *argument);

/* Say at which line of the defaults a value is wrong; of a typed one nothing. Returns false. */
bool argument_blame(const struct arguments *arguments, const struct argument *argument,
                    struct error *error);

/*
 * The common options into their struct.
 *
 * Errors    as option_read
 */
bool arguments_common(const struct arguments *arguments, const struct reader *reader,
                      struct common *common, struct error *error);

#endif
