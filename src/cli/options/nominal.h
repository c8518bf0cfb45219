/* cli/options/nominal.h - the labels of stop series in lists, ranges and --nominal. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_OPTIONS_NOMINAL_H
#define LENSCALC_CLI_OPTIONS_NOMINAL_H

#include "base/error.h"
#include "base/quantity.h"
#include "data/lensdb.h"

/*
 * The exact value behind a label: 5.6 is 5.65685...; full stops first, then thirds, then halves
 * (1.2 and 13 are labels of both: they mean the third stop).
 *
 * Errors    ERROR_USAGE: no series has this label; the neighbours are named
 */
bool nominal_exact(struct lensdb *db, const struct dimension *dimension, double label,
                   double *exact, struct error *error);

/*
 * All labels between two labels of one series, in the order from the first end to the last.
 *
 * Given     name   "full", "half", "third", or null: the coarsest that has both labels
 *           exact  give exact values instead of the labels
 * Result    *count values in the database's arena; 0 with error->code ERROR_NONE if the ends are
 *           no labels and no series was named
 * Errors    ERROR_USAGE: no such series, or an end is none of its labels
 */
bool nominal_between(struct lensdb *db, const struct dimension *dimension, const char *name,
                     const double ends[2], bool exact, double **values, size_t *count,
                     struct error *error);

#endif
