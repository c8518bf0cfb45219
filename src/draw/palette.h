/* draw/palette.h - colours that the colour-blind can tell apart, on light pages, dark ones, paper. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_PALETTE_H
#define LENSCALC_DRAW_PALETTE_H

#include <stdbool.h>
#include <stddef.h>

/* The page a drawing is for; on paper also where it is printed without colours. */
enum palette_theme { PALETTE_LIGHT, PALETTE_DARK, PALETTE_PRINT };

enum { PALETTE_COLOURS = 7, PALETTE_LENGTH = 8 };

/*
 * Colour i of the light theme, as SVG has it; after seven they come again.
 *
 * Source    Okabe and Ito, Color Universal Design, 2008, without yellow, which is lost on white
 */
const char *palette_colour(size_t i);

/*
 * What a colour of the light theme, in which all is drawn, is in another one.
 *
 * Given     colour  "#000", "#0072b2"
 *           shown   receives a colour of PALETTE_LENGTH bytes with its NUL
 * Result    a colour of palette_colour, and the page: that of the theme's own table. Others on a
 *           dark page: of the same hue, L in OKLab reversed, so that black becomes nearly white and
 *           white the page; on paper greys are darker, all else stays. False: it is no such
 *           colour
 * Source    OKLab: B. Ottosson, A perceptual color space for image processing, 2020
 */
bool palette_in_theme(enum palette_theme theme, const char *colour, char shown[PALETTE_LENGTH]);

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
