/* cli/options/tolerances.h - how well a lens is made: --grade, --tolerances, or the lines of its file. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_OPTIONS_TOLERANCES_H
#define LENSCALC_CLI_OPTIONS_TOLERANCES_H

#include "data/lensdb.h"
#include "design/tolerance/perturbation.h"

struct tolerances_reader {
    const struct lens *lens; /* in all its positions */
    struct lensdb *db;       /* for the table of grades */
    struct arena *arena;
};

/* The grade that is asked for; of a lens that nothing is said of `precision`; null: none. */
const char *tolerances_grade(const struct lens *lens, const char *grade, const char *file);

/*
 * What may be wrong with the lens.
 *
 * Given     grade  null: none
 *           file   of lines with `tolerance`, which take the place of those of the lens; null:
 *                  those of the lens
 * Result    `assumed` receives in words what was used: "grade precision, but R1, t3 of the lens"
 * Errors    as lens_grade_read, lens_tolerances_read, perturbations_of; ERROR_IO: there is no such
 *           file
 */
bool tolerances_of(const struct tolerances_reader *reader, const char *grade, const char *file,
                   struct perturbations *perturbations, const char **assumed, struct error *error);

#endif
