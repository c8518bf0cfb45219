/* light/colour.h - colours as numbers: sRGB and XYZ, whites, and how one becomes another. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_LIGHT_COLOUR_H
#define LENSCALC_LIGHT_COLOUR_H

#include "base/error.h"

#include <stdbool.h>

struct colour {
    double part[3]; /* X, Y, Z, or R, G, B proportional to light */
};

/* Rows by columns; of a colour it makes another. */
struct colour_matrix {
    double at[3][3];
};

/*
 * Linear sRGB to XYZ of the 2 degree observer; white is (1, 1, 1) and (0.9505, 1, 1.0890), D65.
 *
 * Source    [IEC99] 5.3
 */
extern const struct colour_matrix colour_xyz_of_srgb;

/* Y of a linear sRGB. */
static inline double colour_luminance(const double rgb[3])
{
    const double *y = colour_xyz_of_srgb.at[1];
    return y[0] * rgb[0] + y[1] * rgb[1] + y[2] * rgb[2];
}

/* The largest share of the way from a grey, 0 to `most`, to a colour that stays within these. */
double colour_share_within(const double rgb[3], double grey, double most);

/* Go that share of the way. */
void colour_move_from_grey(double rgb[3], double grey, double share);

struct colour colour_turned(const struct colour_matrix *matrix, struct colour colour);

/* Of the second after the first. */
struct colour_matrix colour_product(const struct colour_matrix *second,
                                    const struct colour_matrix *first);

/* It must have one: the caller's promise. */
struct colour_matrix colour_inverse(const struct colour_matrix *matrix);

enum { WHITE_LEAST = 1667, WHITE_MOST = 25000, WHITE_DAYLIGHT = 4000 };

/*
 * White light of a colour temperature.
 *
 * Given     kelvin  WHITE_LEAST to WHITE_MOST; as CIE's names of daylight mean it, 6504 is D65
 * Result    X, Y = 1, Z
 * Formula   from WHITE_DAYLIGHT on daylight: x = a cubic in 1/T, y = -3 x^2 + 2.87 x - 0.275;
 *           below a black body: x a cubic in 1/T, y a cubic in x
 * Source    [CIE04] (daylight); [Kim02] (black body)
 * Errors    ERROR_DOMAIN: outside its range
 * Limits    the two lie 0.007 in y apart where they meet; of a black body x and y are within 6e-4
 */
bool colour_white(double kelvin, struct colour *white, struct error *error);

/* CIE's standard illuminant A, a tungsten lamp, and the white of sRGB, daylight: Y = 1. */
struct colour colour_tungsten(void);
struct colour colour_daylight(void);

/*
 * White balance: what makes a white of the picture that of sRGB.
 *
 * Given     white   X, Y, Z of the light that shall look white, above 0; its amount doesn't matter
 * Result    a matrix for linear sRGB that turns this white to equal parts, Y as it was
 * Formula   B^-1 diag(B white_sRGB/B white) B in XYZ, with Bradford's B (without its exponent for
 *           blue), between the matrices of sRGB
 * Source    [Finlayson00]; [Lam85]
 * Errors    ERROR_DOMAIN: a colour that no white has: one that B makes 0 or less
 */
bool colour_balance(struct colour white, struct colour_matrix *matrix, struct error *error);

/*
 * Colours of other primaries as linear sRGB; white stays white.
 *
 * Given     primaries  x, y of red, green, blue and white
 * Formula   columns are X, Y, Z of red, green and blue, of amounts that make the white of Y = 1;
 *           then colour_balance of this white, in sRGB. Those of sRGB, within 5e-4, change nothing
 * Source    [SMPTE93] 3.3
 * Errors    ERROR_DOMAIN: primaries on one line or a y of 0, that make no white; colour_balance
 */
bool colour_of_primaries(const double (*primaries)[2], struct colour_matrix *matrix,
                         struct error *error);

#endif
