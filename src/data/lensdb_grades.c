/* data/lensdb_grades.c - what shops promise: tolerances by grade. */
/* SPDX-License-Identifier: MIT */
#include "data/lensdb_grades.h"

enum { GRADE, QUANTITY, VALUE, UNIT, DISTRIBUTION, CONFIDENCE, SOURCE, COLUMNS, NEEDED = UNIT + 1 };

bool lensdb_grades_open(struct lensdb_grades *grades, struct lensdb *db, enum lensdb_place place,
                        struct error *error)
{
    static const char *const names[COLUMNS] = {"grade",        "quantity",   "value", "unit",
                                               "distribution", "confidence", "source"};
    grades->place = place;
    if (!lensdb_open(db, place, "tolerances.tsv", &grades->tsv, error)) {
        return false;
    }
    for (int i = 0; i < COLUMNS; i++) {
        struct error missing;
        if (!tsv_column(&grades->tsv, names[i], &grades->columns[i], &missing)) {
            grades->columns[i] = TSV_MOST_COLUMNS;
            if (i < NEEDED) {
                *error = missing;
                return false;
            }
        }
    }
    return true;
}

static struct text lensdb_grades_cell_of(const struct lensdb_grades *grades, int column)
{
    const size_t at = grades->columns[column];
    return at < TSV_MOST_COLUMNS ? grades->tsv.cells[at] : (struct text){"", 0};
}

bool lensdb_grades_next(struct lensdb_grades *grades, struct lensdb_tolerance *row,
                        struct error *error)
{
    if (!tsv_next(&grades->tsv, error)) {
        return false;
    }
    *row = (struct lensdb_tolerance){.grade = lensdb_grades_cell_of(grades, GRADE),
                                     .quantity = lensdb_grades_cell_of(grades, QUANTITY),
                                     .amount = lensdb_grades_cell_of(grades, VALUE),
                                     .unit = lensdb_grades_cell_of(grades, UNIT),
                                     .distribution = lensdb_grades_cell_of(grades, DISTRIBUTION),
                                     .confidence = lensdb_grades_cell_of(grades, CONFIDENCE),
                                     .source = lensdb_grades_cell_of(grades, SOURCE),
                                     .place = grades->place,
                                     .file = grades->tsv.source,
                                     .line = grades->tsv.line};
    if (!tsv_number(&grades->tsv, grades->columns[VALUE], &row->value, error)) {
        return false;
    }
    return row->value > 0 ||
           tsv_fail(&grades->tsv, grades->columns[VALUE], error, "is not above 0");
}
