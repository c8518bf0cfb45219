/* cli/question/configuration.c - the user's defaults and kits, for options that nobody typed. */
/* SPDX-License-Identifier: MIT */
#include "cli/question/configuration.h"

#include "data/whole_file.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { CONFIGURATION_MOST = 1 }; /* MiB */

/* -------- the file -------- */

/* The name of the file for the system, and for messages; null where there is nowhere to look. */
static const char *configuration_find(const char **said, bool *is_named, struct arena *arena)
{
    const char *named = getenv("LENSCALC_CONFIG"), *folder, *home, *path = NULL;
    *is_named = named != NULL && named[0] != '\0';
    *said = NULL;
    if (named != NULL) {
        path = *said = *is_named ? named : NULL;
    } else if ((folder = getenv("XDG_CONFIG_HOME")) != NULL && folder[0] == '/') {
        path = *said = ARENA_JOIN(arena, folder, "/lenscalc/config");
    } else if ((home = getenv("HOME")) != NULL && home[0] == '/') {
        *said = "~/.config/lenscalc/config";
        path = ARENA_JOIN(arena, home, "/.config/lenscalc/config");
    }
    return path;
}

bool configuration_open(struct config_file *file, const char **opened, struct arena *arena,
                        struct error *error)
{
    struct text content;
    struct stat found;
    const char *said;
    bool is_named;
    *opened = configuration_find(&said, &is_named, arena);
    *file = (struct config_file){.source = said};
    if (*opened == NULL) {
        return true;
    }
    if (large_file(*opened, CONFIGURATION_MOST, arena, &content, error)) {
        return config_file_read(file, said, content, arena, error);
    }
    if (error->code == ERROR_NONE) {
        return !is_named ||
               fail(error, ERROR_IO, "there is no file %s, which LENSCALC_CONFIG names", said);
    }
    /* whoever may not look into the folder has no defaults there */
    return !is_named && stat(*opened, &found) != 0;
}

/* -------- what its lines are for -------- */

/* Options that make sense in one question only. */
static const char of_one_question[] =
    "batch fail-fast force help kit no-config no-header output part plot resume table usage value";

/* The option of this name that a command may have a default for; null: it has none. */
static const struct option *configuration_option(const struct command *command, struct text name)
{
    const struct option *option = NULL, *common = NULL;
    for (size_t i = 0; (option = command_option(command, i)) != NULL; i++) {
        const bool is_artifact =
            i >= command->option_count && i < command->option_count + command->artifact_count;
        if (!is_artifact && option_is_named(option, name)) {
            return option;
        }
    }
    while ((common = command_next_common(command, common)) != NULL) {
        if (option_is_named(common, name)) {
            return common;
        }
    }
    return NULL;
}

static void configuration_offer(struct nearest *nearest, const struct command *command)
{
    const struct option *option = NULL, *common = NULL;
    for (size_t i = 0; (option = command_option(command, i)) != NULL; i++) {
        nearest_offer(nearest, text_of(option->name));
    }
    while ((common = command_next_common(command, common)) != NULL) {
        nearest_offer(nearest, text_of(common->name));
    }
}

/* The command of a section; null: there is none. */
static const struct command *configuration_command(const struct command *const *commands,
                                                   struct text name)
{
    size_t i = 0;
    while (commands[i] != NULL && !text_equal(name, commands[i]->name)) {
        i++;
    }
    return commands[i];
}

static bool check_section(const struct config_file *file, const struct config_entry *section,
                          const struct command *const *commands, struct error *error)
{
    const struct text name = section->section;
    const struct command *command = configuration_command(commands, name);
    if (section->scope != CONFIG_COMMAND || (command != NULL && command_has_defaults(command))) {
        return true;
    }
    if (command != NULL) {
        return config_file_fail(file, section, name, error, "%s takes no defaults", command->name);
    }
    struct nearest nearest = {.typed = name};
    for (size_t i = 0; commands[i] != NULL; i++) {
        nearest_offer(&nearest, text_of(commands[i]->name));
    }
    config_file_fail(file, section, name, error, "there is no command '%.*s'", text_shown(name),
                     name.start);
    return nearest.best.start != NULL ? error_hint(error, "did you mean [%.*s]?",
                                                   (int)nearest.best.length, nearest.best.start)
                                      : error_hint(error, "a section is [COMMAND] or [kit NAME]");
}

/* Is a line for it: for this command only, or, where that is null, for all? */
static bool is_meant(const struct command *command, const struct command *only)
{
    return only != NULL ? command == only : command_has_defaults(command);
}

/* The option that is typed with such a letter, -f, of a command that the line is for; or null. */
static const struct option *configuration_lettered(const struct command *const *commands,
                                                   const struct command *only, struct text name)
{
    const struct option *option = NULL;
    for (size_t i = 0; commands[i] != NULL && name.length == 1; i++) {
        for (size_t j = 0; (option = command_option(commands[i], j)) != NULL; j++) {
            if (is_meant(commands[i], only) && option->letter == name.start[0]) {
                return option;
            }
        }
    }
    return NULL;
}

/* Has any of the commands that the line is for this option? */
static bool check_name(const struct config_file *file, const struct config_entry *entry,
                       const struct command *const *commands, struct error *error)
{
    const struct text name = entry->name;
    const struct command *only =
        entry->scope == CONFIG_COMMAND ? configuration_command(commands, entry->section) : NULL;
    bool found = false;
    for (size_t i = 0; commands[i] != NULL && !found; i++) {
        found = is_meant(commands[i], only) && configuration_option(commands[i], name) != NULL;
    }
    if (found) {
        return true;
    }
    const struct option *lettered = configuration_lettered(commands, only, name);
    struct nearest nearest = {.typed = name};
    for (size_t i = 0; commands[i] != NULL && lettered == NULL; i++) {
        if (is_meant(commands[i], only)) {
            configuration_offer(&nearest, commands[i]);
        }
    }
    if (only != NULL) {
        config_file_fail(file, entry, name, error, "%s has no option '%.*s'", only->name,
                         text_shown(name), name.start);
    } else {
        config_file_fail(file, entry, name, error, "no command has an option '%.*s'",
                         text_shown(name), name.start);
    }
    if (lettered != NULL) {
        nearest.best = text_of(lettered->name);
    }
    return nearest.best.start != NULL &&
           error_hint(error, "did you mean '%.*s'?", (int)nearest.best.length, nearest.best.start);
}

/* May it have a default, and has it one only? */
static bool check_entry(const struct config_file *file, const struct config_entry *entry,
                        struct error *error)
{
    const struct text name = entry->name;
    if (text_lists_name(of_one_question, name)) {
        return config_file_fail(file, entry, name, error,
                                "'%.*s' is for one question, typed: it has no default",
                                (int)name.length, name.start);
    }
    if (entry->scope != CONFIG_COMMAND && text_equal(name, "columns")) {
        config_file_fail(file, entry, name, error, "each command has columns of its own");
        return error_hint(error, "put it into the section of a command, as below [dof]");
    }
    for (const struct config_entry *other = file->entries; other < entry; other++) {
        if (other->scope == entry->scope && text_same_name(other->section, entry->section) &&
            text_same_name(other->name, name)) {
            return config_file_fail(file, entry, name, error, "'%.*s' stands in line %ld already",
                                    text_shown(name), name.start, other->number);
        }
    }
    return true;
}

bool configuration_check(const struct config_file *file, const struct command *const *commands,
                         struct error *error)
{
    for (size_t i = 0; i < file->section_count; i++) {
        if (!check_section(file, &file->sections[i], commands, error)) {
            return false;
        }
    }
    for (size_t i = 0; i < file->count; i++) {
        if (!check_entry(file, &file->entries[i], error) ||
            !check_name(file, &file->entries[i], commands, error)) {
            return false;
        }
    }
    return true;
}

/* -------- what they say to a command -------- */

/* Is a kit asked for? */
static bool kit_is_used(const char *kits, struct text name)
{
    struct text rest = text_of(kits != NULL ? kits : "");
    bool found = false;
    while (rest.length > 0 && !found) {
        found = text_same_name(text_trim(text_cut(&rest, ',')), name);
    }
    return found;
}

/* Can the option have such a value: a word that it knows, a quantity that it measures? */
static bool entry_fits(const struct config_entry *entry, const struct option *option)
{
    struct text rest = entry->value;
    const struct text first = text_trim(text_cut(&rest, ','));
    struct error ignored;
    double value;
    if (option->kind == &kind_choice) {
        size_t i = 0;
        while (option_word(option, i) != NULL && !text_same(first, option_word(option, i)->word)) {
            i++;
        }
        return option_word(option, i) != NULL;
    }
    if (option->kind != &kind_quantity && option->kind != &kind_focal) {
        return true;
    }
    rest = first;
    return quantity_read(text_trim(text_cut_range(&rest)), option->dimension, option_unit(option),
                         &value, NULL, &ignored);
}

/* Is a line above all sections, or of a kit, meant for options of other commands, where this one's
   of the same name is something else, as --from of bracket is? */
static bool is_for_others(const struct config_entry *entry, const struct option *option,
                          const struct configuration_use *use)
{
    bool found = false;
    if (entry->scope == CONFIG_COMMAND || entry_fits(entry, option)) {
        return false;
    }
    for (size_t i = 0; use->commands[i] != NULL && !found; i++) {
        const struct option *other = configuration_option(use->commands[i], entry->name);
        found = other != NULL && entry_fits(entry, other);
    }
    return found;
}

static bool entry_applies(const struct config_entry *entry, const struct command *command,
                          const struct configuration_use *use)
{
    switch (entry->scope) {
    case CONFIG_KIT:
        return kit_is_used(use->kits, entry->section);
    case CONFIG_COMMAND:
        return text_equal(entry->section, command->name);
    default:
        return !(use->has_database && text_equal(entry->name, "lensdb"));
    }
}

/* "~/glass" and "./glass": the latter in the folder of the file that says so. */
static const char *path_expand(const struct configuration_use *use, struct text path)
{
    struct arena *const arena = use->arena;
    const char *home = getenv("HOME"), *end = strrchr(use->opened, '/');
    const char *typed = arena_string(arena, path.start, path.length);
    if (home != NULL && text_behind(path, "~/").start != NULL) {
        return ARENA_JOIN(arena, home, typed + 1);
    }
    if (end != NULL &&
        (text_behind(path, "./").start != NULL || text_behind(path, "../").start != NULL)) {
        const struct text folder = text_between(use->opened, end + 1);
        return ARENA_JOIN(arena, arena_string(arena, folder.start, folder.length), typed);
    }
    return typed;
}

/* The value as the option would have it typed. */
static struct text entry_text(const struct configuration_use *use, const struct config_entry *entry,
                              const struct option *option)
{
    if ((option->flags & OPTION_FILE) == 0) {
        return entry->value;
    }
    if ((option->flags & OPTION_SEVERAL) == 0) {
        return text_of(path_expand(use, entry->value));
    }
    const char *all = "";
    for (struct text rest = entry->value; rest.start != NULL;) {
        const char *path = path_expand(use, text_trim(text_cut(&rest, ',')));
        all = ARENA_JOIN(use->arena, all, *all != '\0' ? "," : "", path);
    }
    return text_of(all);
}

/* The line of an option becomes that which comes first of the two. */
static bool entry_offer(struct argument *argument, const struct config_entry *entry,
                        struct error *error)
{
    const struct config_entry *other = argument->entry;
    if (argument->is_given || (other != NULL && other->scope > entry->scope)) {
        return true; /* typed, or from a kit */
    }
    if (other != NULL && other->scope == entry->scope) {
        return fail(error, ERROR_USAGE, "the kits %.*s and %.*s both say what --%s is",
                    text_shown(other->section), other->section.start, text_shown(entry->section),
                    entry->section.start, argument->option->name);
    }
    argument->entry = entry;
    return true;
}

/* Options whose lines were found are given; a flag is, if the line says yes. */
static bool arguments_take_entries(const struct configuration_use *use, struct arguments *arguments,
                                   struct error *error)
{
    for (size_t i = 0; i < arguments->count; i++) {
        struct argument *argument = &arguments->all[i];
        const struct option *option = argument->option;
        const struct config_entry *entry = argument->entry;
        if (entry == NULL) {
            continue;
        }
        argument->text = entry_text(use, entry, option);
        argument->is_given = true;
        if (option->kind == &kind_flag) {
            const struct reader reader = {.arena = use->arena};
            if (!option_read(&reader, option, entry->value, &argument->is_given, error)) {
                return argument_blame(arguments, argument, error);
            }
            argument->text = (struct text){NULL, 0};
            argument->entry = argument->is_given ? entry : NULL;
        }
        if ((option->flags & OPTION_FILE) != 0 && text_equal(argument->text, "-")) {
            return config_file_fail(arguments->defaults, entry, entry->value, error,
                                    "standard input is for one question: it is no default");
        }
    }
    arguments_note_given(arguments);
    return true;
}

/* Each kit is there, and says something to the command. */
static bool check_kits(const struct configuration_use *use, const struct arguments *arguments,
                       struct error *error)
{
    const struct config_file *file = arguments->defaults;
    struct text rest = text_of(use->kits != NULL ? use->kits : "");
    while (rest.length > 0) {
        const struct text name = text_trim(text_cut(&rest, ','));
        struct nearest nearest = {.typed = name};
        bool is_there = false, is_used = false;
        for (size_t i = 0; i < file->section_count; i++) {
            const struct config_entry *section = &file->sections[i];
            if (section->scope == CONFIG_KIT) {
                is_there = is_there || text_same_name(section->section, name);
                nearest_offer(&nearest, section->section);
            }
        }
        for (size_t i = 0; i < file->count; i++) {
            const struct config_entry *entry = &file->entries[i];
            is_used =
                is_used || (entry->scope == CONFIG_KIT && text_same_name(entry->section, name) &&
                            configuration_option(arguments->command, entry->name) != NULL);
        }
        if (!is_there) {
            fail(error, ERROR_USAGE, "{--kit} '%.*s': %s has no section [kit %.*s]",
                 text_shown(name), name.start, file->source, text_shown(name), name.start);
            return nearest.best.start != NULL
                       ? error_hint(error, "did you mean '%.*s'?", (int)nearest.best.length,
                                    nearest.best.start)
                       : error_hint(error, "see 'lenscalc list config'");
        }
        if (!is_used) {
            return fail(error, ERROR_USAGE,
                        "{--kit} '%.*s' says nothing here: %s has none of its options",
                        text_shown(name), name.start, arguments->command->name);
        }
    }
    return true;
}

bool configuration_apply(const struct configuration_use *use, struct arguments *arguments,
                         struct error *error)
{
    const struct config_file *file = arguments->defaults;
    if (!check_kits(use, arguments, error)) {
        return false;
    }
    for (size_t i = 0; i < file->count; i++) {
        const struct config_entry *entry = &file->entries[i];
        struct argument *argument = entry_applies(entry, arguments->command, use)
                                        ? arguments_find(arguments, entry->name)
                                        : NULL;
        if (argument != NULL && (argument->is_input || argument->is_common) &&
            !is_for_others(entry, argument->option, use) && !entry_offer(argument, entry, error)) {
            return false;
        }
    }
    return arguments_take_entries(use, arguments, error);
}

const char *configuration_words(const struct arguments *arguments, struct arena *arena)
{
    const char *words = NULL;
    for (size_t i = 0; arguments->defaults != NULL && i < arguments->count; i++) {
        const struct argument *argument = &arguments->all[i];
        const struct config_entry *entry = argument->entry;
        if (entry == NULL || !argument->is_given || (argument->option->flags & OPTION_ASIDE) != 0) {
            continue;
        }
        const struct text kit = entry->section;
        const bool is_kit = entry->scope == CONFIG_KIT;
        words = arena_printf(
            arena, "%s%s%s%.*s (%s%.*s%sline %ld)",
            words != NULL ? words : arguments->defaults->source, words != NULL ? ", " : ": ",
            ARENA_JOIN(arena, argument->option->name, argument->text.length > 0 ? " " : ""),
            (int)argument->text.length, argument->text.length > 0 ? argument->text.start : "",
            is_kit ? "kit " : "", is_kit ? (int)kit.length : 0, is_kit ? kit.start : "",
            is_kit ? ", " : "", entry->number);
    }
    return words;
}
