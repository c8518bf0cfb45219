/* draw/lettering.h - numbers written in pixels. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_LETTERING_H
#define LENSCALC_DRAW_LETTERING_H

#include "base/image/image.h"

/* Pixels of a letter, at size 1, and from one to the next. */
enum { LETTERING_WIDE = 3, LETTERING_HIGH = 5, LETTERING_STEP = 4 };

/*
 * Write white letters: digits and "+-./cdem"; others are left out.
 *
 * Given     image   of any channels, which all become 1
 *           x, y    the upper left corner; what lies outside is not written
 *           size    pixels of a dot
 */
void lettering_write(struct image *image, size_t x, size_t y, size_t size, const char *text);

#endif
