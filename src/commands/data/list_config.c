/* commands/data/list_config.c - lenscalc list config: the user's defaults and kits. */
/* SPDX-License-Identifier: MIT */
#include "cli/question/arguments.h"
#include "commands/data/list.h"
#include "commands/tables.h"

struct config_row {
    const char *file, *command, *kit, *option, *value;
    long line;
};

#define ROW struct config_row

static const struct column config_columns[] = {
    {SHOWN(file), .name = "file", BRIEF, .help = "where it stands"},
    {SHOWN(line), .name = "line", BRIEF, .help = "number of its line"},
    {SHOWN(command), .name = "command", BRIEF | COLUMN_SPARSE,
     .help = "command whose default it is; all = of all that have the option"},
    {SHOWN(kit), .name = "kit", BRIEF | COLUMN_SPARSE, .help = "kit that it is of, for --kit"},
    {SHOWN(option), .name = "option", BRIEF, .help = "name of the option"},
    {SHOWN(value), .name = "value", BRIEF, .help = "its value"},
};

static bool list_config(struct list *list, struct error *error)
{
    const struct config_file *file = list->run->arguments->defaults;
    if (file == NULL || !file->is_there) {
        const bool is_known = file != NULL && file->source != NULL;
        fail(error, ERROR_DOMAIN, "no configuration is read%s%s",
             is_known ? ": there is no file " : "", is_known ? file->source : "");
        return error_hint(error, "lines as 'sensor = 35mm' in such a file are defaults; see "
                                 "lenscalc-config(5)");
    }
    for (size_t i = 0; i < file->count; i++) {
        const struct config_entry *entry = &file->entries[i];
        const char *section = list_string(list, entry->section);
        const char *command = entry->scope == CONFIG_COMMAND ? section : "all";
        const bool is_kit = entry->scope == CONFIG_KIT;
        const struct config_row row = {.file = file->source,
                                       .line = entry->number,
                                       .command = is_kit ? NULL : command,
                                       .kit = is_kit ? section : NULL,
                                       .option = list_string(list, entry->name),
                                       .value = list_string(list, entry->value)};
        list_offer(list, &row, section,
                   (const char *[]){row.option, row.value, row.command, row.kit}, 4);
    }
    return true;
}

const struct topic topic_config = {SHEET(config_columns, struct config_row), list_config, false};
