/* cli/question/configuration.h - the user's defaults and kits, for options that nobody typed. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_QUESTION_CONFIGURATION_H
#define LENSCALC_CLI_QUESTION_CONFIGURATION_H

#include "cli/question/arguments.h"
#include "file/config_file.h"

/*
 * Find and read the file of defaults: LENSCALC_CONFIG, else lenscalc/config in XDG_CONFIG_HOME or
 * ~/.config. An empty LENSCALC_CONFIG reads none.
 *
 * Given     file    receives its lines, and its name as messages have it: "~/.config/..."
 *           opened  receives its name for the system
 * Errors    ERROR_IO: it cannot be read, or LENSCALC_CONFIG names none; as config_file_read
 */
bool configuration_open(struct config_file *file, const char **opened, struct arena *arena,
                        struct error *error);

/*
 * Does every line stand for an option that there is?
 *
 * Given     commands  all there are; ends with null
 * Errors    ERROR_DATA with line and column: no such command or option, one that cannot have a
 *           default, a name twice
 */
bool configuration_check(const struct config_file *file, const struct command *const *commands,
                         struct error *error);

/* What else decides which lines count. */
struct configuration_use {
    const struct command *const *commands; /* all there are; ends with null */
    const char *opened;                    /* the file, in whose folder "./" is */
    const char *kits;                      /* of --kit, separated by commas; null: none */
    bool has_database; /* LENSCALC_DB is set, before which a default lensdb gives way */
    struct arena *arena;
};

/*
 * Give options that are not typed their values from arguments->defaults: those of a kit, else of
 * the command's section, else of all commands. They count as given, but give way where idle_yield
 * and idle_check say.
 *
 * Errors    ERROR_USAGE: an unknown kit, one that says nothing to the command, two with one option;
 *           ERROR_DATA: a flag that is neither yes nor no
 */
bool configuration_apply(const struct configuration_use *use, struct arguments *arguments,
                         struct error *error);

/*
 * What took part in an answer: "~/.config/lenscalc/config: sensor Fuji X-T5 (line 1)", or null.
 */
const char *configuration_words(const struct arguments *arguments, struct arena *arena);

#endif
