/* draw/lettering.h - numbers written in pictures, from outlines. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_LETTERING_H
#define LENSCALC_DRAW_LETTERING_H

#include "base/image/image.h"

/*
 * Write white letters: digits and "+-./cdem²"; others are left out.
 *
 * Given     image   of any channels, which all become 1 where a letter covers a pixel
 *           x, y    where the text begins, on the base line, px; what lies outside is not written
 *           height  of a digit, px
 * Formula   letters are lines and arcs of ellipses, a ninth of the height wide; a pixel takes as
 *           much light as their edge, by its distance from the middle, covers of it
 */
void lettering_write(struct image *image, double x, double y, double height, const char *text);

/* Width of a text, px. */
double lettering_width(const char *text, double height);

#endif
