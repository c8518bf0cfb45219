/* data/number_table.h - a user's file of numbers in columns with names. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DATA_NUMBER_TABLE_H
#define LENSCALC_DATA_NUMBER_TABLE_H

#include "base/arena.h"
#include "base/error.h"
#include "data/tsv.h"

struct number_table {
    size_t columns, rows;
    const char *names[TSV_MOST_COLUMNS];
    double *column[TSV_MOST_COLUMNS];
    long *line; /* of each row in the file, from 1 */
};

/*
 * Read one: tabs or commas between the columns, their names in the first line, comments above.
 *
 * Given     first  what its first column must be called, as "angle_deg"
 * Errors    ERROR_IO: there is no such file, or it cannot be read; ERROR_DATA with line and column:
 *           another first column, cells without a number; as tsv_open_foreign
 */
bool number_table_read(const char *path, const char *first, struct arena *arena,
                       struct number_table *table, struct error *error);

/* The same of a file that is there already. */
bool number_table_parse(const char *path, struct text content, const char *first,
                        struct arena *arena, struct number_table *table, struct error *error);

#endif
