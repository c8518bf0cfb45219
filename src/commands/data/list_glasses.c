/* commands/data/list_glasses.c - lenscalc list: glasses, tolerances. */
/* SPDX-License-Identifier: MIT */
#include "commands/data/list.h"
#include "commands/tables.h"
#include "data/glass_catalog.h"
#include "data/lensdb_facts.h"

struct glass_row {
    const char *name, *catalog, *status, *formula, *source, *licence, *place, *warning;
    double nd, Vd, from, to;
};

#define ROW struct glass_row

static const struct column columns[] = {
    {SHOWN(name), .name = "glass", BRIEF, .help = "name, as the catalogue spells it"},
    {SHOWN(catalog), .name = "catalog", BRIEF, .label = "catalogue", .help = "maker's catalogue"},
    {SHOWN(nd), .name = "nd", BRIEF, .digits = 6, .help = "index at the d line, recomputed"},
    {SHOWN(Vd), .name = "vd", BRIEF, .label = "Vd", .help = "Abbe number, recomputed"},
    {SHOWN(status), .name = "status", BRIEF, .help = "current, obsolete, or as the source says"},
    {LENGTH(from, "nm"), .name = "from", .flags = COLUMN_ECHO,
     .help = "shortest wavelength of the formula"},
    {LENGTH(to, "nm"), .name = "to", .flags = COLUMN_ECHO,
     .help = "longest wavelength of the formula"},
    {SHOWN(formula), .name = "formula", .help = "form of the dispersion"},
    {SHOWN(source), .name = "source", .help = "where the data are from"},
    {SHOWN(licence), .name = "licence", .help = "CC0, or facts (published constants)"},
    {SHOWN(place), .name = "database", .help = "embedded, or the user's own folder"},
    {SHOWN(warning), .name = "warning", .help = "what is doubtful in the data, with file and line"},
};

static bool list_glasses(struct list *list, struct error *error)
{
    struct glass_catalogs catalogs;
    struct glass_record record;
    if (!glass_catalogs_open(&catalogs, list->run->db, list->run->arena, false, error)) {
        return false;
    }
    while (glass_catalogs_next(&catalogs, &record, error)) {
        struct glass_row row = {
            .name = list_string(list, record.glass.name),
            .catalog = list_string(list, record.glass.catalog),
            .status = list_string(list, record.status),
            .formula = glass_formula_name(record.glass.formula),
            .source = list_string(list, record.source),
            .licence = list_string(list, record.licence),
            .place = list_place(record.place),
            .warning = record.warning,
            .from = record.glass.shortest / 1000,
            .to = record.glass.longest / 1000,
        };
        if (list_matches(list, row.catalog, (const char *[]){row.name, row.catalog}, 2)) {
            struct glass_abbe abbe = glass_abbe(&record.glass);
            row.nd = abbe.nd;
            row.Vd = abbe.Vd;
            list_row(list, &row);
        }
    }
    return error->code == ERROR_NONE;
}

const struct topic topic_glasses = {SHEET(columns, struct glass_row), list_glasses, false};

/* -------- tolerances -------- */

struct tolerance_row {
    const char *grade, *quantity, *unit, *distribution, *confidence, *source, *place;
    double value;
};

#undef ROW
#define ROW struct tolerance_row

static const struct column tolerance_columns[] = {
    {SHOWN(grade), .name = "grade", BRIEF, .help = "name for --grade of tolerance"},
    {SHOWN(quantity), .name = "quantity", BRIEF,
     .help = "of every surface, or of every element; radius in fringes: of planes"},
    {SHOWN(value), .name = "value", BRIEF | COLUMN_ECHO, .dimension = &dimension_number,
     .help = "plus and minus"},
    {SHOWN(unit), .name = "unit", BRIEF,
     .help = "of the value; a fringe is half a wave of 546.07 nm"},
    {SHOWN(distribution), .name = "distribution", .help = "between the limits"},
    {SHOWN(confidence), .name = "confidence", BRIEF, .help = "sourced or approx"},
    {SHOWN(source), .name = "source", BRIEF, .help = "the table that the value is from"},
    {SHOWN(place), .name = "database", .help = "embedded, or the user's own folder"},
};

static bool list_tolerances(struct list *list, struct error *error)
{
    struct lensdb_table grades;
    struct lensdb_tolerance one;
    bool open = lensdb_grades_open(&grades, list->run->db, list->place, error);
    while (open && lensdb_grades_next(&grades, &one, error)) {
        const struct tolerance_row row = {
            .grade = list_string(list, one.grade),
            .quantity = list_string(list, one.quantity),
            .unit = list_string(list, one.unit),
            .distribution = list_string(list, one.distribution),
            .confidence = list_string(list, one.confidence),
            .source = list_string(list, one.source),
            .place = list_place(one.place),
            .value = one.value,
        };
        list_offer(list, &row, row.grade, (const char *[]){row.grade, row.quantity}, 2);
    }
    return error->code == ERROR_NONE;
}

const struct topic topic_tolerances = {SHEET(tolerance_columns, struct tolerance_row),
                                       list_tolerances, true};
