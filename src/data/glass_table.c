/* data/glass_table.c - read the rows of a catalogue of glasses. */
/* SPDX-License-Identifier: MIT */
#include "data/glass_table.h"

#include "base/number.h"

#include <math.h>

enum glass_table_column {
    NAME,
    FORMULA,
    COEFFICIENTS,
    NEEDED,
    STATUS = NEEDED,
    FROM,
    TO,
    ND,
    VD,
    DENSITY,
    PRICE,
    EXPANSION,
    EXPANSION_HOT,
    REFERENCE,
    D0,
    D1,
    D2,
    E0,
    E1,
    RESONANCE,
    TRANSMITTANCE,
    SOURCE,
    LICENCE,
    WARNING,
    COLUMNS
};
_Static_assert((int)COLUMNS <= (int)LENSDB_MOST_COLUMNS, "room for all columns");

bool glass_table_open(struct glass_table *table, struct text catalog, enum lensdb_place place,
                      struct error *error)
{
    static const char *const names[COLUMNS] = {"name",
                                               "formula",
                                               "coefficients",
                                               "status",
                                               "from_um",
                                               "to_um",
                                               "nd",
                                               "vd",
                                               "density_g_cm3",
                                               "relative_price",
                                               "cte_m30_70",
                                               "cte_20_300",
                                               "t_ref_c",
                                               "d0",
                                               "d1",
                                               "d2",
                                               "e0",
                                               "e1",
                                               "l_tk_um",
                                               "transmittance_10mm",
                                               "source",
                                               "licence",
                                               "warning"};
    table->catalog = catalog;
    table->rows.place = place;
    return tsv_columns(&table->rows.tsv, names, COLUMNS, NEEDED, table->rows.columns, error);
}

static struct text glass_table_cell(const struct glass_table *table, enum glass_table_column column)
{
    return lensdb_table_cell(&table->rows, (int)column);
}

static bool fail_table_cell(const struct glass_table *table, enum glass_table_column column,
                            const char *what, struct error *error)
{
    return tsv_fail(&table->rows.tsv, table->rows.columns[column], error, what);
}

static bool read_table_number(const struct glass_table *table, enum glass_table_column column,
                              double *value, struct error *error)
{
    return tsv_number(&table->rows.tsv, table->rows.columns[column], value, error) &&
           (!isinf(*value) || fail_table_cell(table, column, "must be finite", error));
}

static bool read_table_terms(const struct glass_table *table, struct glass *glass,
                             struct error *error)
{
    struct text rest = glass_table_cell(table, COEFFICIENTS);
    while (rest.start != NULL && rest.length > 0) {
        struct text word = text_cut(&rest, ' ');
        if (word.length == 0) {
            continue;
        }
        if (glass->count == GLASS_MOST_COEFFICIENTS) {
            return fail_table_cell(table, COEFFICIENTS, "are more than 17 numbers", error);
        }
        struct pair *c = &glass->coefficients[glass->count++];
        if (!text_pair(word, NUMBER_UNSCALED, c) || isinf(c->hi)) {
            return fail_table_cell(table, COEFFICIENTS, "are not numbers separated by blanks",
                                   error);
        }
    }
    if (!glass_count_fits(glass->formula, glass->count)) {
        return fail_table_cell(table, COEFFICIENTS, "are not as many as the formula has", error);
    }
    for (size_t i = 2; i < glass->count && glass->formula == GLASS_POWER; i += 2) {
        double p = glass->coefficients[i].hi;
        if (!(fabs(p) <= 40) || p / 2 != floor(p / 2)) {
            return fail_table_cell(table, COEFFICIENTS,
                                   "have a power that is not even, or above 40", error);
        }
    }
    return true;
}

static bool read_table_point(struct text pair, struct glass_point *point)
{
    struct text value = pair;
    struct text at = text_cut(&value, ':');
    return value.start != NULL && text_pair(at, NUMBER_UNSCALED, &point->wavelength) &&
           text_pair(value, NUMBER_UNSCALED, &point->value) && point->wavelength.hi > 0 &&
           !isinf(point->wavelength.hi);
}

/* "um:value" pairs by rising wavelength, values from 0 to `highest`. */
static bool read_table_points(const struct glass_table *table, enum glass_table_column column,
                              double highest, struct arena *arena,
                              const struct glass_point **points, size_t *count, struct error *error)
{
    struct text rest = glass_table_cell(table, column);
    size_t most = 1;
    for (size_t i = 0; i < rest.length; i++) {
        most += rest.start[i] == ' ';
    }
    struct glass_point *all = ARENA_ARRAY(arena, most, struct glass_point);
    *count = 0;
    while (rest.start != NULL && rest.length > 0) {
        struct text pair = text_cut(&rest, ' ');
        if (pair.length == 0) {
            continue;
        }
        struct glass_point *point = &all[*count];
        if (!read_table_point(pair, point) ||
            !(point->value.hi >= 0 && point->value.hi <= highest)) {
            return fail_table_cell(table, column, "are not um:value pairs of possible values",
                                   error);
        }
        if (*count > 0 && !(point->wavelength.hi > all[*count - 1].wavelength.hi)) {
            return fail_table_cell(table, column, "do not go by rising wavelength", error);
        }
        ++*count;
    }
    *points = all;
    return true;
}

/* A table of indices holds from its first to its last entry. */
static bool read_index_table(const struct glass_table *table, struct glass *glass,
                             struct arena *arena, struct error *error)
{
    const double highest = 1e3;
    if (!read_table_points(table, COEFFICIENTS, highest, arena, &glass->table, &glass->table_count,
                           error)) {
        return false;
    }
    if (glass->table_count == 0) {
        return fail_table_cell(table, COEFFICIENTS, "are missing", error);
    }
    glass->shortest = glass->table[0].wavelength.hi;
    glass->longest = glass->table[glass->table_count - 1].wavelength.hi;
    return true;
}

static bool read_table_range(const struct glass_table *table, struct glass *glass,
                             struct error *error)
{
    if (!read_table_number(table, FROM, &glass->shortest, error) ||
        !read_table_number(table, TO, &glass->longest, error)) {
        return false;
    }
    if ((isnan(glass->shortest) && isnan(glass->longest)) ||
        (glass->shortest > 0 && glass->longest >= glass->shortest)) {
        return true;
    }
    if (table->rows.columns[FROM] == TSV_MOST_COLUMNS) {
        return fail_table_cell(
            table, TO, "is the end of a range without a beginning, the column from_um", error);
    }
    return fail_table_cell(table, FROM,
                           "is not a beginning of a range: it must be above 0 and not above to_um",
                           error);
}

static bool read_formula(const struct glass_table *table, struct glass *glass, struct arena *arena,
                         struct error *error)
{
    glass->formula = glass_formula_of(glass_table_cell(table, FORMULA));
    if (glass->formula == GLASS_FORMULAS) {
        return fail_table_cell(table, FORMULA, "is not a formula", error);
    }
    if (!read_table_range(table, glass, error)) {
        return false;
    }
    return glass->formula == GLASS_TABLE ? read_index_table(table, glass, arena, error)
                                         : read_table_terms(table, glass, error);
}

static bool read_facts(const struct glass_table *table, struct glass_record *record,
                       struct error *error)
{
    struct glass_thermal *thermal = &record->glass.thermal;
    const struct {
        enum glass_table_column column;
        double *value;
    } facts[] = {
        {ND, &record->nd},
        {VD, &record->Vd},
        {DENSITY, &record->density},
        {PRICE, &record->price},
        {EXPANSION, &record->expansion},
        {EXPANSION_HOT, &record->expansion_hot},
        {REFERENCE, &thermal->reference},
        {D0, &thermal->d0},
        {D1, &thermal->d1},
        {D2, &thermal->d2},
        {E0, &thermal->e0},
        {E1, &thermal->e1},
        {RESONANCE, &thermal->resonance},
    };
    for (size_t i = 0; i < sizeof facts / sizeof facts[0]; i++) {
        if (!read_table_number(table, facts[i].column, facts[i].value, error)) {
            return false;
        }
    }
    return true;
}

bool glass_table_read(const struct glass_table *table, bool complete, struct arena *arena,
                      struct glass_record *record, struct error *error)
{
    *record = (struct glass_record){
        .glass = {.catalog = table->catalog, .name = glass_table_cell(table, NAME)},
        .status = glass_table_cell(table, STATUS),
        .source = glass_table_cell(table, SOURCE),
        .licence = glass_table_cell(table, LICENCE),
        .place = table->rows.place,
    };
    const struct text warning = glass_table_cell(table, WARNING);
    if (record->glass.name.length == 0) {
        return fail_table_cell(table, NAME, "is missing", error);
    }
    if (warning.length > 0) {
        record->warning =
            arena_printf(arena, "%.*s:%.*s: %.*s", (int)table->catalog.length, table->catalog.start,
                         (int)record->glass.name.length, record->glass.name.start,
                         (int)warning.length, warning.start);
    }
    return read_formula(table, &record->glass, arena, error) && read_facts(table, record, error) &&
           (!complete ||
            read_table_points(table, TRANSMITTANCE, 1, arena, &record->glass.transmittance,
                              &record->glass.transmittance_count, error));
}

struct text glass_table_name(const struct glass_table *table)
{
    return glass_table_cell(table, NAME);
}
