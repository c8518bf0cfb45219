/* data/lines.c - spectral lines by name. */
/* SPDX-License-Identifier: MIT */
#include "data/lines.h"

#include "base/number.h"

#include <math.h>

/* The table of one place; false with ERROR_NONE if it has none. */
static bool open_lines(struct lensdb *db, enum lensdb_place place, struct tsv *tsv, size_t *name,
                       size_t *nm, struct error *error)
{
    return lensdb_open(db, place, "lines.tsv", tsv, error) &&
           tsv_column(tsv, "name", name, error) && tsv_column(tsv, "nm", nm, error);
}

/* The wavelength in the present row, rounded once. */
static bool lines_read_line(const struct tsv *tsv, size_t nm, struct number_scale from_nm,
                            double *wavelength, struct error *error)
{
    struct text cell = tsv->cells[nm];
    return (text_number(cell, from_nm, wavelength) && *wavelength > 0 && !isinf(*wavelength)) ||
           tsv_fail(tsv, nm, error, "is not a wavelength");
}

/* Look from one place on. */
static bool find_from(struct lensdb *db, enum lensdb_place first, struct text name,
                      struct number_scale from_nm, bool *found, double *wavelength,
                      struct error *error)
{
    *found = false;
    error->code = ERROR_NONE;
    bool letter = name.length > 0 && ((name.start[0] >= 'a' && name.start[0] <= 'z') ||
                                      (name.start[0] >= 'A' && name.start[0] <= 'Z'));
    for (enum lensdb_place place = first; letter && place < LENSDB_PLACES; place++) {
        struct tsv tsv;
        size_t column, nm;
        if (open_lines(db, place, &tsv, &column, &nm, error)) {
            while (tsv_next(&tsv, error)) {
                if (text_identical(tsv.cells[column], name)) {
                    *found = true;
                    return lines_read_line(&tsv, nm, from_nm, wavelength, error);
                }
            }
        }
        if (error->code != ERROR_NONE) {
            return false;
        }
    }
    return true;
}

bool lines_find(struct lensdb *db, struct text name, struct number_scale from_nm, bool *found,
                double *wavelength, struct error *error)
{
    return find_from(db, LENSDB_USER, name, from_nm, found, wavelength, error);
}

bool lines_standard(struct text name, double *wavelength)
{
    struct lensdb embedded = {0};
    struct error ignored;
    bool found;
    return find_from(&embedded, LENSDB_EMBEDDED, name, (struct number_scale){1, -3}, &found,
                     wavelength, &ignored) &&
           found;
}

struct text lines_name(struct lensdb *db, double wavelength)
{
    for (enum lensdb_place place = LENSDB_USER; place < LENSDB_PLACES; place++) {
        struct tsv tsv;
        struct error ignored;
        size_t column, nm;
        double line;
        if (!open_lines(db, place, &tsv, &column, &nm, &ignored)) {
            continue;
        }
        while (tsv_next(&tsv, &ignored)) {
            if (lines_read_line(&tsv, nm, (struct number_scale){1, -6}, &line, &ignored) &&
                fabs(line - wavelength) <= 1e-15 * line) {
                return tsv.cells[column];
            }
        }
    }
    return (struct text){"", 0};
}
