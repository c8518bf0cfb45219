/* commands/data/list_glasses.c - lenscalc list: glasses. */
/* SPDX-License-Identifier: MIT */
#include "commands/data/list.h"
#include "commands/tables.h"
#include "data/glass_catalog.h"

struct list_glasses_glass_row {
    const char *name, *catalog, *status, *formula, *source, *licence, *place, *warning;
    double nd, Vd, from, to;
};

#define ROW struct list_glasses_glass_row

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

const struct topic topic_glasses = {SHEET(columns, struct list_glasses_glass_row), list_glasses,
                                    false};
