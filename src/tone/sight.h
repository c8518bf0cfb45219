/* tone/sight.h - what the eye sees: contrast, detail and colour by the light it is used to. */
/* SPDX-License-Identifier: MIT */
/*
 * The constants stand so in pcond of Radiance, Ward's own program for [WardLarson97], but two: the
 * veil is 0.08 there, and 0.087 here, what the 0.913 that stay in [MoonSpencer45] leave; the least
 * luminance is 1e-7 there, and here where thresholds have become level.
 */
#ifndef LENSCALC_TONE_SIGHT_H
#define LENSCALC_TONE_SIGHT_H

/* cd/m^2: what is darker counts as this. */
#define SIGHT_LEAST 1e-4

/* cd/m^2: below the first rods see alone, above the second cones. */
#define SIGHT_SCOTOPIC 0.0056
#define SIGHT_PHOTOPIC 5.6

/* Share of the light that the eye scatters over its field: 1 - 0.913. */
#define SIGHT_VEIL 0.087

/*
 * The difference of luminance that is just visible.
 *
 * Given     adaptation  La, luminance that the eye is used to, cd/m^2, > 0
 * Result    cd/m^2
 * Formula   x = log10 La; log10 dL = -2.86 for x < -3.94, (0.405 x + 1.6)^2.18 - 2.86 to -1.44,
 *           x - 0.395 to -0.0184, (0.249 x + 0.65)^2.7 - 0.72 to 1.9, x - 1.255 above
 * Source    [Ferwerda96]; as [WardLarson97] puts rods and cones together
 */
double sight_threshold(double adaptation);

/*
 * The finest grating that is seen.
 *
 * Given     adaptation  La, cd/m^2; less than SIGHT_LEAST counts as that
 * Result    cycles a degree
 * Formula   17.25 atan(1.4 log10 La + 0.35) + 25.72
 * Source    [WardLarson97], a fit to Shaler's data
 */
double sight_acuity(double adaptation);

/*
 * What rods see of a colour, so that of white they see its luminance.
 *
 * Given     rgb  linear sRGB, cd/m^2
 * Formula   Y (1.33 (1 + (Y + Z)/X) - 1.68) over that of white, not below 0
 * Source    [WardLarson97]; white: D65, where the paper leaves the scale open
 */
double sight_scotopic(const double rgb[3]);

/* Luminance of linear sRGB. */
static inline float sight_luminance(const float rgb[3])
{
    return 0.2126F * rgb[0] + 0.7152F * rgb[1] + 0.0722F * rgb[2];
}

#endif
