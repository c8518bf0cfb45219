/* cli/options/nominal.c - the labels of stop series in lists, ranges and --nominal. */
/* SPDX-License-Identifier: MIT */
#include "cli/options/nominal.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The order in which a label is looked for, coarsest first. */
static const char *const series_names[] = {"full", "third", "half"};
enum { SERIES = 3 };

/* The index of a label; count if it is none. */
static size_t nominal_find(const struct lensdb_stop *stops, size_t count, double label)
{
    size_t i = 0;
    /* labels are short decimals; a fraction such as 1/125 is read the same way on both sides */
    while (i < count && !(fabs(stops[i].value - label) <= 1e-12 * label)) {
        i++;
    }
    return i;
}

bool nominal_exact(struct lensdb *db, const struct dimension *dimension, double label,
                   double *exact, struct error *error)
{
    const struct lensdb_stop *below = NULL, *above = NULL; /* the next labels of all series */
    for (size_t i = 0; i < SERIES; i++) {
        struct lensdb_stop *stops;
        size_t length;
        if (!lensdb_stops(db, dimension->series, series_names[i], &stops, &length, error)) {
            return false;
        }
        size_t found = nominal_find(stops, length, label);
        if (found < length) {
            *exact = stops[found].exact;
            return true;
        }
        for (size_t k = 0; k < length; k++) {
            const struct lensdb_stop *stop = &stops[k];
            if (stop->value < label && (below == NULL || stop->value > below->value)) {
                below = stop;
            }
            if (stop->value > label && (above == NULL || stop->value < above->value)) {
                above = stop;
            }
        }
    }
    char words[100] = "";
    if (below != NULL && above != NULL) {
        snprintf(words, sizeof words, "; its neighbours are %.*s and %.*s",
                 (int)below->label.length, below->label.start, (int)above->label.length,
                 above->label.start);
    }
    return fail(error, ERROR_USAGE, "not a label of a stop series, as --nominal needs%s", words);
}

bool nominal_between(struct lensdb *db, const struct dimension *dimension, const char *name,
                     const double ends[2], bool exact, double **values, size_t *count,
                     struct error *error)
{
    *count = 0;
    error->code = ERROR_NONE;
    for (size_t i = 0; i < SERIES; i++) {
        struct lensdb_stop *stops;
        size_t length;
        if (name != NULL && strcmp(name, series_names[i]) != 0) {
            continue;
        }
        if (!lensdb_stops(db, dimension->series, series_names[i], &stops, &length, error)) {
            return false;
        }
        size_t from = nominal_find(stops, length, ends[0]),
               to = nominal_find(stops, length, ends[1]);
        if (from < length && to < length) {
            *count = (from < to ? to - from : from - to) + 1;
            *values = ARENA_ARRAY(db->arena, *count, double);
            for (size_t k = 0; k < *count; k++) {
                const struct lensdb_stop *stop = &stops[from < to ? from + k : from - k];
                (*values)[k] = exact ? stop->exact : stop->value;
            }
            return true;
        }
        if (name != NULL) {
            return fail(error, ERROR_USAGE,
                        "an end of the range is not a label of the %s-stop series", name);
        }
    }
    return name == NULL ||
           fail(error, ERROR_USAGE, "a stop series is full, half or third, not '%s'", name);
}
