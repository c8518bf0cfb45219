/* file/lines.c - spectral lines by name. */
/* SPDX-License-Identifier: MIT */
#include "file/lines.h"

#include "base/number.h"

#include <math.h>
#include <string.h>

/* The table of one place; false with ERROR_NONE if it has none. */
static bool open_lines(struct lensdb *db, enum lensdb_place place, struct tsv *tsv, size_t *name,
                       size_t *nm, struct error *error)
{
    return lensdb_open(db, place, "lines.tsv", tsv, error) &&
           tsv_column(tsv, "name", name, error) && tsv_column(tsv, "nm", nm, error);
}

/* The wavelength in the present row, mm, rounded once. */
static bool read_line(const struct tsv *tsv, size_t nm, double *wavelength, struct error *error)
{
    struct text cell = tsv->cells[nm];
    const char *end = cell.start + cell.length;
    if (number_read(cell.start, end, (struct number_scale){1, -6}, wavelength) != end ||
        !(*wavelength > 0) || isinf(*wavelength)) {
        return tsv_fail(tsv, nm, error, "is no wavelength");
    }
    return true;
}

bool lines_find(struct lensdb *db, struct text name, bool *found, double *wavelength,
                struct error *error)
{
    *found = false;
    error->code = ERROR_NONE;
    bool letter = name.length > 0 && ((name.start[0] >= 'a' && name.start[0] <= 'z') ||
                                      (name.start[0] >= 'A' && name.start[0] <= 'Z'));
    for (enum lensdb_place place = LENSDB_USER; letter && place < LENSDB_PLACES; place++) {
        struct tsv tsv;
        size_t column, nm;
        if (open_lines(db, place, &tsv, &column, &nm, error)) {
            while (tsv_next(&tsv, error)) {
                struct text cell = tsv.cells[column];
                if (cell.length == name.length &&
                    memcmp(cell.start, name.start, name.length) == 0) {
                    *found = true;
                    return read_line(&tsv, nm, wavelength, error);
                }
            }
        }
        if (error->code != ERROR_NONE) {
            return false;
        }
    }
    return true;
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
            if (read_line(&tsv, nm, &line, &ignored) && fabs(line - wavelength) <= 1e-15 * line) {
                return tsv.cells[column];
            }
        }
    }
    return (struct text){"", 0};
}
