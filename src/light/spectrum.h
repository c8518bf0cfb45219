/* light/spectrum.h - spectra of lights and surfaces, as they are named. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_LIGHT_SPECTRUM_H
#define LENSCALC_LIGHT_SPECTRUM_H

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

#endif
