/* data/index_table.c - measured indices of refraction, as a table of the user's. */
/* SPDX-License-Identifier: MIT */
#include "data/index_table.h"

#include "data/lines.h"
#include "data/tsv.h"

#include <math.h>
#include <stdlib.h>

enum role { WAVELENGTH, INDEX, DEVIATION, WEIGHT, ROLES };

/* The names a column may have. */
static const struct {
    const char *name;
    enum role role;
    double factor; /* to um */
} names[] = {
    {"wavelength_nm", WAVELENGTH, 1e-3},
    {"wavelength", WAVELENGTH, 1e-3},
    {"nm", WAVELENGTH, 1e-3},
    {"wavelength_um", WAVELENGTH, 1},
    {"um", WAVELENGTH, 1},
    {"wl", WAVELENGTH, 1},
    {"index", INDEX, 1},
    {"n", INDEX, 1},
    {"deviation", DEVIATION, 1},
    {"sigma", DEVIATION, 1},
    {"stderr", DEVIATION, 1},
    {"weight", WEIGHT, 1},
};

/* One row while they are sorted. */
struct index_table_entry {
    double wavelength, index, deviation;
    long line;
};

struct index_table_columns {
    size_t at[ROLES]; /* TSV_MOST_COLUMNS = there is none */
    double factor;
};

static bool find_columns(const struct tsv *tsv, struct index_table_columns *columns,
                         struct error *error)
{
    for (int i = 0; i < ROLES; i++) {
        columns->at[i] = TSV_MOST_COLUMNS;
    }
    for (size_t i = 0; i < tsv->columns; i++) {
        for (size_t j = 0; j < sizeof names / sizeof names[0]; j++) {
            enum role role = names[j].role;
            if (text_same(tsv->names[i], names[j].name) && columns->at[role] == TSV_MOST_COLUMNS) {
                columns->at[role] = i;
                columns->factor = role == WAVELENGTH ? names[j].factor : columns->factor;
            }
        }
    }
    if (columns->at[WAVELENGTH] == TSV_MOST_COLUMNS || columns->at[INDEX] == TSV_MOST_COLUMNS) {
        return fail_in(error, tsv->source, tsv->line, 0, "the table has no column '%s'",
                       columns->at[INDEX] == TSV_MOST_COLUMNS ? "index" : "wavelength_nm");
    }
    return true;
}

static bool read_index_wave(struct lensdb *db, const struct tsv *tsv,
                            const struct index_table_columns *columns, double *um,
                            struct error *error)
{
    size_t at = columns->at[WAVELENGTH];
    bool is_line;
    if (!lines_find(db, tsv->cells[at], (struct number_scale){1, -3}, &is_line, um, error)) {
        return false;
    }
    if (is_line) {
        return true;
    }
    if (!tsv_number(tsv, at, um, error)) {
        return false;
    }
    /* a division keeps the decimal: 587.6 nm is 0.5876 um */
    *um = columns->factor < 1 ? *um / 1000 : *um;
    return true;
}

static bool read_index_entry(struct lensdb *db, const struct tsv *tsv,
                             const struct index_table_columns *columns,
                             struct index_table_entry *entry, struct error *error)
{
    double weight = NAN;
    entry->deviation = NAN;
    entry->line = tsv->line;
    if (!read_index_wave(db, tsv, columns, &entry->wavelength, error) ||
        !tsv_number(tsv, columns->at[INDEX], &entry->index, error)) {
        return false;
    }
    if (columns->at[DEVIATION] != TSV_MOST_COLUMNS) {
        if (!tsv_number(tsv, columns->at[DEVIATION], &entry->deviation, error)) {
            return false;
        }
        if (!(entry->deviation > 0 && isfinite(entry->deviation))) {
            return tsv_fail(tsv, columns->at[DEVIATION], error, "must be above 0");
        }
    } else if (columns->at[WEIGHT] != TSV_MOST_COLUMNS) {
        if (!tsv_number(tsv, columns->at[WEIGHT], &weight, error)) {
            return false;
        }
        if (!(weight > 0 && isfinite(weight))) {
            return tsv_fail(tsv, columns->at[WEIGHT], error, "must be above 0");
        }
        entry->deviation = 1 / sqrt(weight);
    }
    if (!(entry->wavelength > 0 && isfinite(entry->wavelength))) {
        return tsv_fail(tsv, columns->at[WAVELENGTH], error, "must be above 0");
    }
    return (entry->index > 0 && isfinite(entry->index)) ||
           tsv_fail(tsv, columns->at[INDEX], error, "must be above 0");
}

static int by_table_wave(const void *a, const void *b)
{
    const struct index_table_entry *first = a, *second = b;
    return (first->wavelength > second->wavelength) - (first->wavelength < second->wavelength);
}

static bool set_table(const char *source, struct index_table_entry *entries, size_t count,
                      struct arena *arena, struct index_table *table, struct error *error)
{
    if (count > 0) {
        qsort(entries, count, sizeof entries[0], by_table_wave);
    }
    *table = (struct index_table){count, ARENA_ARRAY(arena, count + 1, double),
                                  ARENA_ARRAY(arena, count + 1, double), NULL};
    if (count > 0 && !isnan(entries[0].deviation)) {
        table->deviation = ARENA_ARRAY(arena, count, double);
    }
    for (size_t i = 0; i < count; i++) {
        if (i > 0 && !(entries[i].wavelength > entries[i - 1].wavelength)) {
            return fail_in(error, source, entries[i].line, 0,
                           "the wavelength %.10g um is there twice", entries[i].wavelength);
        }
        table->wavelength[i] = entries[i].wavelength;
        table->index[i] = entries[i].index;
        if (table->deviation != NULL) {
            table->deviation[i] = entries[i].deviation;
        }
    }
    return true;
}

bool index_table_read(struct lensdb *db, const char *source, struct text content,
                      struct arena *arena, struct index_table *table, struct error *error)
{
    struct tsv tsv;
    struct index_table_columns columns = {.factor = 1};
    size_t count = 0, room = 0;
    struct index_table_entry *entries = NULL;
    if (!tsv_open_foreign(&tsv, source, content, error) || !find_columns(&tsv, &columns, error)) {
        return false;
    }
    while (tsv_next(&tsv, error)) {
        if (!read_index_entry(db, &tsv, &columns, ARENA_ADD(arena, entries, count, room), error)) {
            return false;
        }
    }
    return error->code == ERROR_NONE && set_table(source, entries, count, arena, table, error);
}
