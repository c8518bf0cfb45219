/* light/bands.h - the parts in which light is carried: red, green and blue, or wavelengths. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_LIGHT_BANDS_H
#define LENSCALC_LIGHT_BANDS_H

#include "base/error.h"
#include "light/spectrum.h"

#include <stdbool.h>
#include <stddef.h>

/* So many bands at most are there; a ray carries up to BANDS_LANES of them at once. */
enum { BANDS_LEAST = 8, BANDS_MOST = 64, BANDS_LANES = 4 };

/* Many bands lie side by side between these, um; the outermost hold what is seen beyond. */
#define BANDS_FIRST 0.39
#define BANDS_LAST  0.71

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
    double white[BANDS_MOST];      /* sums over D65: of three bands sRGB, of others x + y + z */
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

/* Red, green and blue of sRGB. */
void bands_three(struct bands *bands);

/*
 * Wavelengths.
 *
 * Given     count  BANDS_LEAST to BANDS_MOST
 * Formula   bands of one width about them; the integrals of D65 and the observer over each make
 *           rgb, so that white of D65 is 1 in each. basis: means over the band, weighted by D65
 *           times x + y + z, of three smooth spectra between 0 and 1 that make 1 together and look
 *           under D65 as red, green and blue of sRGB: the programme of the source, solved anew.
 *           Means take saturation away, which rgb gives back: colours of sRGB return exactly.
 *           X and Y of each band are above 0; Z of yellow and red, nearly 0, may be below
 * Source    [Mallett19]; [CIE04]
 * Limits    sRGB of surfaces with peaks 0.05 um or steps 0.02 um wide, the light of luminance 1, is
 *           with 32 bands within 0.005 in smooth lights and in F11; with 16 0.017 and 0.034, with 8
 *           0.07 and 0.10
 * Errors    ERROR_DOMAIN: another count
 */
bool bands_many(size_t count, struct bands *bands, struct error *error);

/*
 * The shares of each band that a surface reflects.
 *
 * Given     surface  RGB, each 0 to 1, or a table of shares of 0 to 1
 *           of       receives a number for each band, 0 to 1
 *           held     receives how much of the colour they hold, unless null: 1, or the share of its
 *                    distance from grey that is left, since sRGB would have to take some of a
 *                    primary away
 * Formula   of three bands the sRGB of what it reflects of D65; where that is not within 0 to 1,
 *           the nearest to it on the way to the grey of its luminance
 * Errors    ERROR_DOMAIN: what spectrum_check finds, shares above 1, the spectrum of a light
 */
bool bands_of_surface(const struct bands *bands, const struct spectrum *surface,
                      double of[BANDS_MOST], double *held, struct error *error);

/*
 * Light of luminance 1 cd/m^2.
 *
 * Given     light  its relative spectrum, or the proportions of its RGB
 *           of     receives a number of at least 0 for each band: sum of[k] rgb[k] has luminance 1
 *           held   receives how much of the colour they hold, unless null: as of surfaces, from
 *                  white
 * Formula   the sRGB of its sums over the spectrum, with D65 as white; where one is negative, the
 *           nearest to it on the way to the white of its luminance
 *           In many bands the shares of it that they have, changed by bands_match, so that light
 *           that is seen directly has the colour of its whole spectrum
 * Errors    ERROR_DOMAIN: what spectrum_check finds; light that the eye does not see
 */
bool bands_of_light(const struct bands *bands, const struct spectrum *light, double of[BANDS_MOST],
                    double *held, struct error *error);

/*
 * The number of bands that light needs.
 *
 * Given     most  bands_off that is well enough
 *           off   receives that of the result
 * Result    the least count that has no more, or the one of all counts that has least
 */
size_t bands_needed(const struct spectrum *light, double most, double *off);

#endif
