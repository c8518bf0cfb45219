/* light/illuminant.h - kinds of light by their names. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_LIGHT_ILLUMINANT_H
#define LENSCALC_LIGHT_ILLUMINANT_H

#include "light/spectrum.h"

#include <stdbool.h>

/* CIE's illuminants and what they stand for; a null word ends them. */
extern const struct word illuminant_words[];

/*
 * The spectrum of a light that is named.
 *
 * Given     name      one of illuminant_words; "5600K": daylight from WHITE_DAYLIGHT on, else a
 *                     black body; "blackbody 2856K", "daylight 6500K", or with ':' for the blank
 *           spectrum  receives it; tables are those of the program
 * Source    [CIE04] table T.1 (A), 3.1 (D series), T.6 (F2, F7, F11), as in colord's tables. The
 *           K of D50, D55, D65 and D75 are those of today's c2: 1.4388/1.4380 of the names'
 * Errors    ERROR_USAGE with a caret, and the name that is nearest
 */
bool spectrum_named(struct text name, struct spectrum *spectrum, struct error *error);

/* D65, the white of sRGB. */
struct spectrum spectrum_white(void);

/*
 * Illuminance of a star on a plane that faces it.
 *
 * Given     magnitude  visual
 * Result    lx, above the air
 * Formula   2.54e-6 10^(-0.4 m)
 * Source    [Allen73]; 3631 Jy, magnitude 0 of the AB scale, make 2.58e-6 lx
 */
double illuminant_star(double magnitude);

#endif
