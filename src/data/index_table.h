/* data/index_table.h - measured indices of refraction, as a table of the user's. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DATA_INDEX_TABLE_H
#define LENSCALC_DATA_INDEX_TABLE_H

#include "base/arena.h"
#include "base/error.h"
#include "data/lensdb.h"

#include <stddef.h>

/* By rising wavelength. */
struct index_table {
    size_t count;
    double *wavelength; /* um */
    double *index;
    double *deviation; /* standard deviation of the index; null where the table has none */
};

/*
 * Read a table: comma or tab between the columns, comments with '#', names in the first line.
 *
 * Given     content  a column wavelength_nm (or wavelength, nm) or wavelength_um (or um, wl, in um
 *                    as refractiveindex.info writes), numbers or names of lines; a column index (or
 *                    n); perhaps deviation (or sigma, stderr), or weight, which is 1/deviation^2.
 *                    Others are passed over
 * Errors    ERROR_DATA with line and column: no such columns, what is no number, a wavelength or
 *           index not above 0, a deviation or weight not above 0, a wavelength twice
 */
bool index_table_read(struct lensdb *db, const char *source, struct text content,
                      struct arena *arena, struct index_table *table, struct error *error);

#endif
