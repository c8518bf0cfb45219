/* draw/palette.h - colours that the colour-blind can tell apart. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_PALETTE_H
#define LENSCALC_DRAW_PALETTE_H

#include <stddef.h>

/*
 * Colour i, as SVG has it; after seven they come again.
 *
 * Source    Okabe and Ito, Color Universal Design, 2008, without yellow, which is lost on white
 */
const char *palette_colour(size_t i);

#endif
