/* data/number_table.c - rows of numbers become columns. */
/* SPDX-License-Identifier: MIT */
#include "data/number_table.h"

#include "data/whole_file.h"

#include <math.h>

bool number_table_parse(const char *path, struct text content, const char *first,
                        struct arena *arena, struct number_table *table, struct error *error)
{
    struct tsv tsv;
    if (!tsv_open_foreign(&tsv, path, content, error)) {
        return false;
    }
    if (!text_equal(tsv.names[0], first)) {
        return fail_in(error, path, tsv.line, 0, "the first column is '%.*s', not '%s'",
                       text_shown(tsv.names[0]), tsv.names[0].start, first);
    }
    *table = (struct number_table){.columns = tsv.columns};
    size_t room[TSV_MOST_COLUMNS] = {0}, line_room = 0;
    for (size_t k = 0; k < tsv.columns; k++) {
        const struct text name = tsv.names[k];
        table->names[k] = arena_printf(arena, "%.*s", text_shown(name), name.start);
    }
    for (; tsv_next(&tsv, error); table->rows++) {
        table->line =
            arena_grow(arena, table->line, table->rows, &line_room, sizeof table->line[0]);
        table->line[table->rows] = tsv.line;
        for (size_t k = 0; k < tsv.columns; k++) {
            double **column = &table->column[k];
            *column = arena_grow(arena, *column, table->rows, &room[k], sizeof **column);
            if (!tsv_number(&tsv, k, &(*column)[table->rows], error)) {
                return false;
            }
            if (isnan((*column)[table->rows])) {
                return tsv_fail(&tsv, k, error, "is no number");
            }
        }
    }
    return error->code == ERROR_NONE;
}

bool number_table_read(const char *path, const char *first, struct arena *arena,
                       struct number_table *table, struct error *error)
{
    struct text content;
    if (!whole_file(path, arena, &content, error)) {
        return error->code == ERROR_NONE && fail(error, ERROR_IO, "there is no file %.200s", path);
    }
    return number_table_parse(path, content, first, arena, table, error);
}
