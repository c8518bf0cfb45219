/* file/config_file.c - the file of defaults and kits: sections, and lines with "name = value". */
/* SPDX-License-Identifier: MIT */
#include "file/config_file.h"

#include "file/file_words.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

bool config_file_fail(const struct config_file *file, const struct config_entry *entry,
                      struct text part, struct error *error, const char *format, ...)
{
    char message[sizeof error->message];
    const size_t column = (size_t)(part.start - entry->line.start) + 1;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    fail_at(error, ERROR_DATA, entry->line, column, "%s", message);
    error_locate(error, file->source, entry->number, column);
    return error_count_characters(error, entry->line);
}

/* Does nothing more than a comment follow? */
static bool config_is_end(struct text rest)
{
    const struct text trimmed = text_trim(rest);
    return trimmed.length == 0 || trimmed.start[0] == '#';
}

static struct text config_behind(struct text line, const char *at)
{
    return text_between(at, line.start + line.length);
}

/* "[dof]", "[kit walk]": what the lines below it are for. */
static bool config_read_section(const struct config_file *file, struct config_entry *entry,
                                struct error *error)
{
    const struct text line = entry->line, typed = text_trim(line);
    const char *close = memchr(typed.start, ']', typed.length);
    if (close == NULL || !config_is_end(config_behind(line, close + 1))) {
        return config_file_fail(file, entry, typed, error,
                                "a section is [COMMAND] or [kit NAME], alone in its line");
    }
    struct text rest = text_trim(text_between(typed.start + 1, close));
    struct text kit = text_behind(rest, "kit");
    const bool is_kit = text_equal(rest, "kit") ||
                        (kit.start != NULL && (kit.start[0] == ' ' || kit.start[0] == '\t'));
    entry->scope = is_kit ? CONFIG_KIT : CONFIG_COMMAND;
    entry->section = is_kit ? text_trim(kit) : rest;
    const struct text name = entry->section;
    if (name.length > 1 && name.start[0] == '"' && name.start[name.length - 1] == '"') {
        entry->section = text_trim(text_between(name.start + 1, name.start + name.length - 1));
    }
    if (entry->section.length == 0) {
        return config_file_fail(file, entry, typed, error, "%s",
                                is_kit ? "a kit has a name: [kit NAME]"
                                       : "a section has a name: [COMMAND] or [kit NAME]");
    }
    return !is_kit || memchr(entry->section.start, ',', entry->section.length) == NULL ||
           config_file_fail(file, entry, entry->section, error,
                            "the name of a kit has no comma, which separates several of them");
}

/* The value of a line, between quotes or up to a comment. */
static bool config_read_value(const struct config_file *file, struct config_entry *entry,
                              struct text rest, struct error *error)
{
    struct text value = text_trim(rest);
    if (value.length > 0 && value.start[0] == '"') {
        const char *close = memchr(value.start + 1, '"', value.length - 1);
        if (close == NULL) {
            return config_file_fail(file, entry, value, error, "the quotes have no end");
        }
        if (!config_is_end(config_behind(entry->line, close + 1))) {
            return config_file_fail(file, entry, text_trim(config_behind(entry->line, close + 1)),
                                    error, "only a comment may follow the quotes");
        }
        entry->value = text_between(value.start + 1, close);
        return true;
    }
    for (size_t i = 0; i < value.length; i++) {
        const bool is_word = i > 0 && value.start[i - 1] != ' ' && value.start[i - 1] != '\t';
        if (value.start[i] == '#' && !is_word) {
            value.length = i;
        }
    }
    entry->value = text_trim(value);
    return entry->value.length > 0 ||
           config_file_fail(file, entry, entry->name, error, "'%.*s' has no value",
                            text_shown(entry->name), entry->name.start);
}

static bool config_read_entry(const struct config_file *file, struct config_entry *entry,
                              struct error *error)
{
    struct text rest = entry->line;
    entry->name = text_trim(text_cut(&rest, '='));
    if (rest.start == NULL || entry->name.length == 0) {
        return config_file_fail(file, entry, text_trim(entry->line), error,
                                "a line is [SECTION] or 'name = value'");
    }
    return config_read_value(file, entry, rest, error);
}

bool config_file_read(struct config_file *file, const char *source, struct text content,
                      struct arena *arena, struct error *error)
{
    struct file_words words;
    struct config_entry section = {.scope = CONFIG_ALL};
    size_t room = 0, section_room = 0;
    *file = (struct config_file){.source = source, .is_there = true};
    if (!file_words_open(&words, source, content, arena, error) ||
        !file_words_plain(source, words.rest, error)) {
        return false;
    }
    words.comment = NULL; /* between quotes there is none */
    while (file_words_line(&words)) {
        const struct text typed = text_trim(words.line);
        section.line = words.line;
        section.number = words.number;
        if (typed.length == 0 || typed.start[0] == '#') {
            continue;
        }
        if (typed.start[0] == '[') {
            if (!config_read_section(file, &section, error)) {
                return false;
            }
            *ARENA_ADD(arena, file->sections, file->section_count, section_room) = section;
            continue;
        }
        struct config_entry entry = section;
        if (!config_read_entry(file, &entry, error)) {
            return false;
        }
        *ARENA_ADD(arena, file->entries, file->count, room) = entry;
    }
    return true;
}
