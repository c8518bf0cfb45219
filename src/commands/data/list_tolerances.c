/* commands/data/list_tolerances.c - lenscalc list: what shops promise. */
/* SPDX-License-Identifier: MIT */
#include "commands/data/list.h"
#include "commands/tables.h"
#include "data/lensdb_grades.h"

struct tolerance_row {
    const char *grade, *quantity, *unit, *distribution, *confidence, *source, *place;
    double value;
};

#define ROW struct tolerance_row

static const struct column columns[] = {
    {SHOWN(grade), .name = "grade", BRIEF, .help = "name for --grade of tolerance"},
    {SHOWN(quantity), .name = "quantity", BRIEF,
     .help = "of every surface, or of every element; radius in fringes: of planes"},
    {SHOWN(value), .name = "value", BRIEF | COLUMN_ECHO, .dimension = &dimension_number,
     .help = "plus and minus"},
    {SHOWN(unit), .name = "unit", BRIEF,
     .help = "of the value; a fringe is half a wave of 546.07 nm"},
    {SHOWN(distribution), .name = "distribution", .help = "between the limits"},
    {SHOWN(confidence), .name = "confidence", BRIEF, .help = "sourced, or recall (from memory)"},
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
        if (list_matches(list, row.grade, (const char *[]){row.grade, row.quantity}, 2)) {
            list_row(list, &row);
        }
    }
    return error->code == ERROR_NONE;
}

const struct topic topic_tolerances = {
    {columns, sizeof columns / sizeof columns[0], sizeof(struct tolerance_row)},
    list_tolerances,
    true};
