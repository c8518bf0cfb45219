/* cli/options/nominal.c - the labels of stop series in lists, ranges and --nominal. */
/* SPDX-License-Identifier: MIT */
#include "cli/options/nominal.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The order in which a label is looked for, coarsest first. */
static const char *const series_names[] = {"full", "third", "half"};
enum { SERIES = 3 };

struct series {
    struct lensdb_stop *stops;
    size_t count;
};

static bool nominal_load(struct lensdb *db, const struct dimension *dimension, const char *name,
                         struct series *series, struct error *error)
{
    return lensdb_stops(db, dimension->series, name, &series->stops, &series->count, error);
}

/* The index of a label; count if it is none. */
static size_t nominal_find(const struct series *series, double label)
{
    size_t i = 0;
    /* labels are short decimals; a fraction such as 1/125 is read the same way on both sides */
    while (i < series->count && !(fabs(series->stops[i].value - label) <= 1e-12 * label)) {
        i++;
    }
    return i;
}

/* The labels next below and above a value among all series, for a message. */
struct neighbours {
    const struct lensdb_stop *below, *above;
};

static void nominal_look_around(const struct series *series, double value, struct neighbours *found)
{
    for (size_t i = 0; i < series->count; i++) {
        const struct lensdb_stop *stop = &series->stops[i];
        if (stop->value < value && (found->below == NULL || stop->value > found->below->value)) {
            found->below = stop;
        }
        if (stop->value > value && (found->above == NULL || stop->value < found->above->value)) {
            found->above = stop;
        }
    }
}

bool nominal_exact(struct lensdb *db, const struct dimension *dimension, double label,
                   double *exact, struct error *error)
{
    struct neighbours around = {0};
    for (size_t i = 0; i < SERIES; i++) {
        struct series series;
        if (!nominal_load(db, dimension, series_names[i], &series, error)) {
            return false;
        }
        size_t found = nominal_find(&series, label);
        if (found < series.count) {
            *exact = series.stops[found].exact;
            return true;
        }
        nominal_look_around(&series, label, &around);
    }
    const struct lensdb_stop *below = around.below, *above = around.above;
    char words[100] = "";
    if (below != NULL && above != NULL) {
        snprintf(words, sizeof words, "; its neighbours are %.*s and %.*s",
                 (int)below->label.length, below->label.start, (int)above->label.length,
                 above->label.start);
    }
    return fail(error, ERROR_USAGE, "not a label of a stop series, as --nominal needs%s", words);
}

static bool is_series(const char *name)
{
    for (size_t i = 0; i < SERIES; i++) {
        if (strcmp(series_names[i], name) == 0) {
            return true;
        }
    }
    return false;
}

static void nominal_collect(struct lensdb *db, const struct series *series, size_t from, size_t to,
                            bool exact, double **values, size_t *count)
{
    *count = (from < to ? to - from : from - to) + 1;
    *values = ARENA_ARRAY(db->arena, *count, double);
    for (size_t i = 0; i < *count; i++) {
        const struct lensdb_stop *stop = &series->stops[from < to ? from + i : from - i];
        (*values)[i] = exact ? stop->exact : stop->value;
    }
}

bool nominal_between(struct lensdb *db, const struct nominal_range *range, double **values,
                     size_t *count, struct error *error)
{
    const char *name = range->series;
    *count = 0;
    error->code = ERROR_NONE;
    if (name != NULL && !is_series(name)) {
        return fail(error, ERROR_USAGE, "a stop series is full, half or third, not '%s'", name);
    }
    for (size_t i = 0; i < SERIES; i++) {
        struct series series;
        if (name != NULL && strcmp(name, series_names[i]) != 0) {
            continue;
        }
        if (!nominal_load(db, range->dimension, series_names[i], &series, error)) {
            return false;
        }
        size_t from = nominal_find(&series, range->first), to = nominal_find(&series, range->last);
        if (from < series.count && to < series.count) {
            nominal_collect(db, &series, from, to, range->exact, values, count);
            return true;
        }
        if (name != NULL) {
            return fail(error, ERROR_USAGE,
                        "an end of the range is not a label of the %s-stop series", name);
        }
    }
    return true;
}
