/* commands/data/list_tolerances.c - lenscalc list: what shops promise. */
/* SPDX-License-Identifier: MIT */
#include "commands/data/list.h"
#include "data/lensdb_grades.h"

struct tolerance_row {
    const char *grade, *quantity, *unit, *distribution, *confidence, *source, *place;
    double value;
};

static const struct column columns[] = {
    {COLUMN(struct tolerance_row, grade), .name = "grade", .flags = COLUMN_BRIEF, .label = "grade",
     .help = "name for --grade of tolerance"},
    {COLUMN(struct tolerance_row, quantity), .name = "quantity", .flags = COLUMN_BRIEF,
     .label = "quantity",
     .help = "of every surface, or of every element; radius in fringes: of "
             "planes"},
    {COLUMN(struct tolerance_row, value), .dimension = &dimension_number, .name = "value",
     .flags = COLUMN_BRIEF | COLUMN_ECHO, .label = "value", .help = "plus and minus"},
    {COLUMN(struct tolerance_row, unit), .name = "unit", .flags = COLUMN_BRIEF, .label = "unit",
     .help = "of the value; a fringe is half a wave of 546.07 nm"},
    {COLUMN(struct tolerance_row, distribution), .name = "distribution", .label = "distribution",
     .help = "between the limits"},
    {COLUMN(struct tolerance_row, confidence), .name = "confidence", .flags = COLUMN_BRIEF,
     .label = "confidence", .help = "sourced, or recall (from memory)"},
    {COLUMN(struct tolerance_row, source), .name = "source", .flags = COLUMN_BRIEF,
     .label = "source", .help = "the table that the value is from"},
    {COLUMN(struct tolerance_row, place), .name = "database", .label = "database",
     .help = "embedded, or the user's own folder"},
};

static bool list_tolerances(struct list *list, struct error *error)
{
    for (int place = 0; place < LENSDB_PLACES; place++) {
        struct lensdb_grades grades;
        struct lensdb_tolerance one;
        bool open = lensdb_grades_open(&grades, list->run->db, (enum lensdb_place)place, error);
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
        if (error->code != ERROR_NONE) {
            return false;
        }
    }
    return true;
}

const struct topic topic_tolerances = {
    {columns, sizeof columns / sizeof columns[0], sizeof(struct tolerance_row)}, list_tolerances};
