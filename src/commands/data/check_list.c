/* commands/data/check_list.c - the lens files of folders. */
/* SPDX-License-Identifier: MIT */
#include "commands/data/check_files.h"

#include "data/folder.h"
#include "exchange/lens_formats.h"

static void check_list_append(struct check_list *list, struct check_item item)
{
    list->items =
        arena_grow(list->arena, list->items, list->count, &list->room, sizeof list->items[0]);
    list->items[list->count++] = item;
}

/* A folder and those below; as deep as a path can be. */
static void add_folder(struct check_list *list, const char *path, struct name_table *seen)
{
    struct folder_entry *entries;
    size_t count;
    struct error error;
    if (!folder_read(path, seen, list->arena, &entries, &count, &error)) {
        const char *problem = arena_printf(list->arena, "%s", error.message);
        check_list_append(list, (struct check_item){.path = path, .problem = problem});
        return;
    }
    for (size_t i = 0; i < count; i++) {
        const struct folder_entry *entry = &entries[i];
        if (entry->kind == FOLDER_FOLDER) {
            add_folder(list, entry->path, seen);
        } else if (foreign_ends_as_lens(text_of(entry->path))) {
            check_list_append(list, (struct check_item){.path = entry->path});
        }
    }
}

void check_list_add(struct check_list *list, struct text path)
{
    const char *name = arena_string(list->arena, path.start, path.length);
    struct name_table seen = {0};
    if (folder_exists(name)) {
        add_folder(list, name, &seen);
    } else {
        check_list_append(list, (struct check_item){.path = name, .is_named = true});
    }
}
