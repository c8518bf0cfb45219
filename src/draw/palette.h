/* draw/palette.h - colours that the colour-blind can tell apart. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_PALETTE_H
#define LENSCALC_DRAW_PALETTE_H

#include <stdbool.h>
#include <stddef.h>

/*
 * Colour i, as SVG has it; after seven they come again.
 *
 * Source    Okabe and Ito, Color Universal Design, 2008, without yellow, which is lost on white
 */
const char *palette_colour(size_t i);

/*
 * Colours for numbers.
 *
 * Given     is_signed  blue below 0, white at 0 (0.5), red above; else dark to bright, the
 *           brightness growing with the number
 *           share      of the scale, 0..1, cut to that
 *           colour     receives R, G, B as sRGB encodes them, 0..1
 */
void palette_scale(bool is_signed, double share, double colour[3]);

#endif
