/* data/tsv.h - tables of lensdb: tab-separated, comments above, names in the first line. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DATA_TSV_H
#define LENSCALC_DATA_TSV_H

#include "base/error.h"
#include "base/text.h"

#include <stdbool.h>
#include <stddef.h>

enum { TSV_MOST_COLUMNS = 32 };

/* A table being read. Texts point into the file's content. */
struct tsv {
    const char *source; /* for messages */
    struct text rest;   /* what is still to read */
    long line;          /* of the present row, 1-based */
    struct text names[TSV_MOST_COLUMNS];
    struct text cells[TSV_MOST_COLUMNS];
    size_t columns;
    char separator;
};

/*
 * Begin to read: passes over comments and reads the names. A BOM and CRLF are accepted.
 *
 * Errors    ERROR_DATA with line and column: no names, too many or two columns of one name, NUL
 *           bytes (a file in UTF-16)
 */
bool tsv_open(struct tsv *tsv, const char *source, struct text content, struct error *error);

/*
 * The same for a table that somebody else wrote: where the names have no tab, commas separate, and
 * cells may have blanks around them.
 */
bool tsv_open_foreign(struct tsv *tsv, const char *source, struct text content,
                      struct error *error);

/*
 * The column of this name.
 *
 * Errors    ERROR_DATA: there is none
 */
bool tsv_column(const struct tsv *tsv, const char *name, size_t *column, struct error *error);

/* Those of these names, of which the first `needed` must be there; else TSV_MOST_COLUMNS. */
bool tsv_columns(const struct tsv *tsv, const char *const *names, size_t count, size_t needed,
                 size_t *columns, struct error *error);

/*
 * Read the next row into cells; a cell "-" is empty (length 0).
 *
 * Result    false at the end, with error->code ERROR_NONE, or for a bad row
 * Errors    ERROR_DATA: the row has not as many cells as there are names
 */
bool tsv_next(struct tsv *tsv, struct error *error);

/* A cell of the present row; empty of the column TSV_MOST_COLUMNS. */
struct text tsv_cell(const struct tsv *tsv, size_t column);

/*
 * A cell as a number; NaN where it is empty, or the column TSV_MOST_COLUMNS. ERROR_DATA with line
 * and column if it is none.
 */
bool tsv_number(const struct tsv *tsv, size_t column, double *value, struct error *error);

/* Report something wrong with a cell of the present row. Returns false. */
bool tsv_fail(const struct tsv *tsv, size_t column, struct error *error, const char *what);

#endif
