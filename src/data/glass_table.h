/* data/glass_table.h - read the rows of a catalogue of glasses. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DATA_GLASS_TABLE_H
#define LENSCALC_DATA_GLASS_TABLE_H

#include "data/glass_catalog.h"

/* Take in the names of the columns of table->tsv, which is open. */
bool glass_table_open(struct glass_table *table, struct text catalog, enum lensdb_place place,
                      struct error *error);

/* The name in the present row. */
struct text glass_table_name(const struct glass_table *table);

/*
 * The glass in the present row.
 *
 * Given     complete  with its transmittances
 * Errors    ERROR_DATA with line and column: what is no glass
 */
bool glass_table_read(const struct glass_table *table, bool complete, struct arena *arena,
                      struct glass_record *record, struct error *error);

#endif
