/* data/tsv.c - tables of lensdb: tab-separated, comments above, names in the first line. */
/* SPDX-License-Identifier: MIT */
#include "data/tsv.h"

#include "base/number.h"

#include <math.h>
#include <string.h>

static bool fail_line(const struct tsv *tsv, struct error *error, const char *what)
{
    return fail_in(error, tsv->source, tsv->line, 0, "%s", what);
}

/* The next line that is neither blank nor a comment. */
static bool tsv_next_line(struct tsv *tsv, struct text *line)
{
    while (tsv->rest.start != NULL && tsv->rest.length > 0) {
        *line = text_cut(&tsv->rest, '\n');
        tsv->line++;
        if (line->length > 0 && line->start[line->length - 1] == '\r') {
            line->length--;
        }
        if (line->length > 0 && line->start[0] != '#') {
            return true;
        }
    }
    return false;
}

/* Cut a line into cells; false if there are more than a table can have. */
static bool tsv_split(struct text line, char separator, struct text *cells, size_t *count)
{
    *count = 0;
    while (line.start != NULL) {
        if (*count == TSV_MOST_COLUMNS) {
            return false;
        }
        struct text cell = text_cut(&line, separator);
        cells[(*count)++] = separator == '\t' ? cell : text_trim(cell);
    }
    return true;
}

static bool tsv_open_table(struct tsv *tsv, const char *source, struct text content, bool foreign,
                           struct error *error)
{
    *tsv = (struct tsv){.source = source, .rest = content, .separator = '\t'};
    if (content.length >= 3 && memcmp(content.start, "\xef\xbb\xbf", 3) == 0) {
        tsv->rest = (struct text){content.start + 3, content.length - 3};
    }
    if (content.length > 0 && memchr(content.start, '\0', content.length) != NULL) {
        tsv->line = 1;
        return fail_line(tsv, error, "NUL bytes: this is not UTF-8 text (UTF-16?)");
    }
    struct text line;
    if (!tsv_next_line(tsv, &line)) {
        return fail_line(tsv, error, "the table has no line of column names");
    }
    if (foreign && memchr(line.start, '\t', line.length) == NULL) {
        tsv->separator = ',';
    }
    if (!tsv_split(line, tsv->separator, tsv->names, &tsv->columns)) {
        return fail_line(tsv, error, "the table has more than 32 columns");
    }
    for (size_t i = 0; i < tsv->columns; i++) {
        for (size_t j = 0; j < i; j++) {
            if (text_same_name(tsv->names[i], tsv->names[j])) {
                return fail_line(tsv, error, "two columns have the same name");
            }
        }
    }
    return true;
}

bool tsv_open(struct tsv *tsv, const char *source, struct text content, struct error *error)
{
    return tsv_open_table(tsv, source, content, false, error);
}

bool tsv_open_foreign(struct tsv *tsv, const char *source, struct text content, struct error *error)
{
    return tsv_open_table(tsv, source, content, true, error);
}

/* The column of this name; TSV_MOST_COLUMNS: there is none. */
static size_t tsv_column_named(const struct tsv *tsv, const char *name)
{
    size_t i = 0;
    while (i < tsv->columns && !text_equal(tsv->names[i], name)) {
        i++;
    }
    return i < tsv->columns ? i : TSV_MOST_COLUMNS;
}

bool tsv_column(const struct tsv *tsv, const char *name, size_t *column, struct error *error)
{
    *column = tsv_column_named(tsv, name);
    return *column < TSV_MOST_COLUMNS ||
           fail_in(error, tsv->source, tsv->line, 0, "the table has no column '%s'", name);
}

bool tsv_columns(const struct tsv *tsv, const char *const *names, size_t count, size_t needed,
                 size_t *columns, struct error *error)
{
    for (size_t i = 0; i < count; i++) {
        if (i >= needed) {
            columns[i] = tsv_column_named(tsv, names[i]);
        } else if (!tsv_column(tsv, names[i], &columns[i], error)) {
            return false;
        }
    }
    return true;
}

bool tsv_next(struct tsv *tsv, struct error *error)
{
    struct text line;
    size_t count;
    error->code = ERROR_NONE;
    if (!tsv_next_line(tsv, &line)) {
        return false;
    }
    if (!tsv_split(line, tsv->separator, tsv->cells, &count) || count != tsv->columns) {
        return fail_in(error, tsv->source, tsv->line, 0,
                       "the row has %zu cells where there are %zu column names", count,
                       tsv->columns);
    }
    for (size_t i = 0; i < count; i++) {
        struct text *cell = &tsv->cells[i];
        cell->length = cell->length == 1 && cell->start[0] == '-' ? 0 : cell->length;
    }
    return true;
}

bool tsv_fail(const struct tsv *tsv, size_t column, struct error *error, const char *what)
{
    struct text cell = tsv->cells[column], name = tsv->names[column];
    return fail_in(error, tsv->source, tsv->line, (size_t)(cell.start - tsv->cells[0].start) + 1,
                   "%.*s '%.*s' %s", text_shown_up_to(name, 40), name.start, text_shown(cell),
                   cell.start, what);
}

struct text tsv_cell(const struct tsv *tsv, size_t column)
{
    return column < TSV_MOST_COLUMNS ? tsv->cells[column] : text_of("");
}

bool tsv_number(const struct tsv *tsv, size_t column, double *value, struct error *error)
{
    const struct text cell = tsv_cell(tsv, column);
    *value = NAN;
    return cell.length == 0 || text_number(cell, NUMBER_UNSCALED, value) ||
           tsv_fail(tsv, column, error, "is not a number");
}
