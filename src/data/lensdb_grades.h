/* data/lensdb_grades.h - what shops promise: tolerances by grade. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DATA_LENSDB_GRADES_H
#define LENSCALC_DATA_LENSDB_GRADES_H

#include "data/lensdb.h"

/* A row of tolerances.tsv. Texts point into the database. */
struct lensdb_tolerance {
    struct text grade;
    struct text quantity;     /* "radius", "element tilt": words of .lens files */
    struct text amount, unit; /* as they stand in the table; unit empty where there is none */
    struct text distribution; /* empty: not said */
    struct text confidence, source;
    double value; /* the amount as a number */
    enum lensdb_place place;
    const char *file; /* where it stands, for messages */
    long line;
};

/*
 * Begin to read it, and read its rows one by one.
 *
 * Result    open: false with ERROR_NONE if that place has no such table; next: false at the end
 *           with ERROR_NONE
 * Errors    ERROR_DATA with line and column: a bad row; as lensdb_open
 */
bool lensdb_grades_open(struct lensdb_table *grades, struct lensdb *db, enum lensdb_place place,
                        struct error *error);
bool lensdb_grades_next(struct lensdb_table *grades, struct lensdb_tolerance *row,
                        struct error *error);

#endif
