/* tests/fuzz/fuzz_config.c - the file of defaults and kits: the input is the file. */
/* SPDX-License-Identifier: MIT */
#include "cli/question/configuration.h"
#include "commands/commands.h"
#include "fuzz.h"

static void require_inside(struct text text, const char *content, size_t size)
{
    REQUIRE(text.length == 0 ||
            (text.start >= content && text.start + text.length <= content + size));
}

static void require_failure(const struct error *error)
{
    fuzz_require_error(error);
    REQUIRE(error->code == ERROR_DATA && error->line >= 1 && error->column >= 1);
}

/* What is wrong with a value is said at its place, whatever the option is. */
static void require_applied(struct config_file *file, struct arena *arena)
{
    const struct command *command = command_find(text_of("dof"));
    const struct configuration_use use = {
        .commands = commands, .opened = "fuzz/config", .kits = "a, b", .arena = arena};
    struct lensdb db = {.arena = arena};
    const struct reader reader = {.db = &db, .arena = arena};
    struct arguments arguments = {0};
    struct common common = {0};
    struct error error = {0};
    REQUIRE(arguments_parse(&arguments, command, 0, NULL, arena, &error));
    arguments.defaults = file;
    if (!configuration_apply(&use, &arguments, &error) ||
        !arguments_common(&arguments, &reader, &common, &error)) {
        fuzz_require_error(&error);
    } else {
        configuration_words(&arguments, arena);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *content = fuzz_copy(data, size);
    struct arena arena = {0};
    struct config_file file;
    struct error error = {0};
    if (!config_file_read(&file, "fuzz.conf", (struct text){content, size}, &arena, &error)) {
        require_failure(&error);
    } else {
        for (size_t i = 0; i < file.count; i++) {
            const struct config_entry *entry = &file.entries[i];
            require_inside(entry->line, content, size);
            require_inside(entry->name, content, size);
            require_inside(entry->value, content, size);
            REQUIRE(entry->name.length > 0 && entry->number >= 1);
            REQUIRE((entry->scope == CONFIG_ALL) == (entry->section.length == 0));
        }
        if (!configuration_check(&file, commands, &error)) {
            require_failure(&error);
        } else {
            require_applied(&file, &arena);
        }
    }
    arena_free(&arena);
    free(content);
    return 0;
}
