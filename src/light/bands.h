/* light/bands.h - the parts in which light is carried: red, green and blue, or wavelengths. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_LIGHT_BANDS_H
#define LENSCALC_LIGHT_BANDS_H

#include <stddef.h>

/* So many bands at most are there; a ray carries up to BANDS_LANES of them at once. */
enum { BANDS_MOST = 64, BANDS_LANES = 4 };

/*
 * Bands: three of linear sRGB, or wavelengths.
 *
 * Light that has the numbers of[k] in all bands has the linear sRGB sum of of[k] rgb[k]; white of
 * D65, luminance 1 cd/m^2, has 1 of each. A surface of the colour (r, g, b) reflects
 * r basis[k][0] + g basis[k][1] + b basis[k][2] of band k: of three bands these are unit matrices.
 */
struct bands {
    size_t count;
    double wavelength[BANDS_MOST]; /* um; NaN: of sRGB */
    double rgb[BANDS_MOST][3];     /* linear sRGB of a unit of each band */
    double basis[BANDS_MOST][3];   /* of surfaces; each 0 to 1, their sum 1 */
};

/* Those that one ray carries. */
struct lanes {
    size_t count; /* 1 .. BANDS_LANES */
    size_t band[BANDS_LANES];
};

/* Light, or shares of it, in the lanes of a ray. */
struct radiance {
    double of[BANDS_LANES];
};

#endif
