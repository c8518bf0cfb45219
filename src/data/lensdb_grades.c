/* data/lensdb_grades.c - what shops promise: tolerances by grade. */
/* SPDX-License-Identifier: MIT */
#include "data/lensdb_grades.h"

enum { GRADE, QUANTITY, VALUE, UNIT, DISTRIBUTION, CONFIDENCE, SOURCE, COLUMNS, NEEDED = UNIT + 1 };

bool lensdb_grades_open(struct lensdb_table *grades, struct lensdb *db, enum lensdb_place place,
                        struct error *error)
{
    static const char *const names[COLUMNS] = {"grade",        "quantity",   "value", "unit",
                                               "distribution", "confidence", "source"};
    return lensdb_table_open(grades, db, place, "tolerances.tsv", names, COLUMNS, NEEDED, error);
}

bool lensdb_grades_next(struct lensdb_table *grades, struct lensdb_tolerance *row,
                        struct error *error)
{
    if (!tsv_next(&grades->tsv, error)) {
        return false;
    }
    *row = (struct lensdb_tolerance){.grade = lensdb_table_cell(grades, GRADE),
                                     .quantity = lensdb_table_cell(grades, QUANTITY),
                                     .amount = lensdb_table_cell(grades, VALUE),
                                     .unit = lensdb_table_cell(grades, UNIT),
                                     .distribution = lensdb_table_cell(grades, DISTRIBUTION),
                                     .confidence = lensdb_table_cell(grades, CONFIDENCE),
                                     .source = lensdb_table_cell(grades, SOURCE),
                                     .place = grades->place,
                                     .file = grades->tsv.source,
                                     .line = grades->tsv.line};
    if (!tsv_number(&grades->tsv, grades->columns[VALUE], &row->value, error)) {
        return false;
    }
    return row->value > 0 ||
           tsv_fail(&grades->tsv, grades->columns[VALUE], error, "is not above 0");
}
