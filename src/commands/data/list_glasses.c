/* commands/data/list_glasses.c - lenscalc list: glasses. */
/* SPDX-License-Identifier: MIT */
#include "commands/data/list.h"
#include "data/glass_catalog.h"

struct list_glasses_glass_row {
    const char *name, *catalog, *status, *formula, *source, *licence, *place, *warning;
    double nd, Vd, from, to;
};

#define GLASS(member) COLUMN(struct list_glasses_glass_row, member)

static const struct column columns[] = {
    {GLASS(name), .name = "glass", .flags = COLUMN_BRIEF, .label = "glass",
     .help = "name, as the catalogue spells it"},
    {GLASS(catalog), .name = "catalog", .flags = COLUMN_BRIEF, .label = "catalogue",
     .help = "maker's catalogue"},
    {GLASS(nd), .name = "nd", .digits = 6, .flags = COLUMN_BRIEF, .label = "nd",
     .help = "index at the d line, recomputed"},
    {GLASS(Vd), .name = "vd", .flags = COLUMN_BRIEF, .label = "Vd",
     .help = "Abbe number, recomputed"},
    {GLASS(status), .name = "status", .flags = COLUMN_BRIEF, .label = "status",
     .help = "current, obsolete, or as the source says"},
    {GLASS(from), .name = "from", .dimension = &dimension_length, .unit = "nm",
     .flags = COLUMN_ECHO, .label = "from", .help = "shortest wavelength of the formula"},
    {GLASS(to), .name = "to", .dimension = &dimension_length, .unit = "nm", .flags = COLUMN_ECHO,
     .label = "to", .help = "longest wavelength of the formula"},
    {GLASS(formula), .name = "formula", .label = "formula", .help = "form of the dispersion"},
    {GLASS(source), .name = "source", .label = "source", .help = "where the data are from"},
    {GLASS(licence), .name = "licence", .label = "licence",
     .help = "CC0, or facts (published constants)"},
    {GLASS(place), .name = "database", .label = "database",
     .help = "embedded, or the user's own folder"},
    {GLASS(warning), .name = "warning", .label = "warning",
     .help = "what is doubtful in the data, with file and line"},
};

static bool list_glasses(struct list *list, struct error *error)
{
    struct glass_catalogs catalogs;
    struct glass_record record;
    if (!glass_catalogs_open(&catalogs, list->run->db, list->run->arena, false, error)) {
        return false;
    }
    while (glass_catalogs_next(&catalogs, &record, error)) {
        struct list_glasses_glass_row row = {
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

const struct topic topic_glasses = {SHEET(columns, struct list_glasses_glass_row), list_glasses};
