/* light/bands_needed.h - into how many bands narrow light should be divided. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_LIGHT_BANDS_NEEDED_H
#define LENSCALC_LIGHT_BANDS_NEEDED_H

#include "light/spectrum.h"

#include <stddef.h>

/*
 * The number of bands that light needs.
 *
 * Given     most  bands_off that is well enough
 *           off   receives that of the result
 * Result    the least count that has no more, or the one of all counts that has least
 */
size_t bands_needed(const struct spectrum *light, double most, double *off);

#endif
