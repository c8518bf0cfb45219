/* light/spectrum.h - spectra of lights and surfaces, as they are named. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_LIGHT_SPECTRUM_H
#define LENSCALC_LIGHT_SPECTRUM_H

#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>

enum spectrum_kind {
    SPECTRUM_NONE,
    SPECTRUM_RGB,       /* linear sRGB; of light by luminance, of a surface shares */
    SPECTRUM_BLACKBODY, /* of `kelvin` */
    SPECTRUM_DAYLIGHT,  /* CIE's of `kelvin` */
    SPECTRUM_TABLE
};

struct spectrum {
    enum spectrum_kind kind;
    double rgb[3];
    double kelvin;
    size_t count;             /* of a table: straight lines between its rows, 0 beyond them */
    const double *wavelength; /* um, rising */
    const double *value;      /* of light relative; of a surface 0 to 1 */
};

/* Temperatures of a black body, K; daylight goes from WHITE_DAYLIGHT to WHITE_MOST. */
enum { BLACKBODY_LEAST = 500, BLACKBODY_MOST = 100000 };

/*
 * Light of a wavelength, or of a surface the share that it reflects.
 *
 * Given     spectrum    a black body, daylight or a table that spectrum_check has passed
 *           wavelength  um
 * Result    of lights relative to 560 nm, where both formulas give 1
 * Formula   Planck's law, (0.56/l)^5 (e^(c2/(0.56 T)) - 1)/(e^(c2/(l T)) - 1), c2 = 14387.77 um K;
 *           daylight (S0 + M1 S1 + M2 S2)/100, with M1 and M2 of its chromaticity, rounded to
 *           three decimals, and straight lines between rows of 5 nm
 * Source    [CIE04] 3.1, 4.1 and table T.2
 * Limits    daylight from 0.3 to 0.83 um, 0 beyond
 */
double spectrum_at(const struct spectrum *spectrum, double wavelength);

/*
 * Is all right with its numbers?
 *
 * Errors    ERROR_DOMAIN: no spectrum at all, a temperature outside its range, numbers that are
 *           negative, NaN or infinite, of a table less than two rows or wavelengths that do not
 *           rise; of RGB and tables also if it is 0 throughout
 */
bool spectrum_check(const struct spectrum *spectrum, struct error *error);

#endif
