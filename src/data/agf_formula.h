/* data/agf_formula.h - the thirteen dispersion formulas of AGF files. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DATA_AGF_FORMULA_H
#define LENSCALC_DATA_AGF_FORMULA_H

#include "optics/glass.h"

enum { AGF_FORMULAS = 13, AGF_COEFFICIENTS = 10 };

/* How many numbers behind CD formula 1 .. 13 uses. */
size_t agf_formula_count(int number);

/*
 * Give a glass one of the formulas that agf_read lists.
 *
 * Given     number        1 .. 13
 *           coefficients  AGF_COEFFICIENTS numbers
 *           glass         receives formula, count and coefficients
 */
void agf_formula_set(int number, const struct pair *coefficients, struct glass *glass);

#endif
