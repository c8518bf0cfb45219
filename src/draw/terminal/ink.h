/* draw/terminal/ink.h - colours of drawings as a terminal shows them. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_TERMINAL_INK_H
#define LENSCALC_DRAW_TERMINAL_INK_H

#include "draw/terminal/cells.h"
#include "draw/terminal/svg_read.h"

#include <stdbool.h>

/* How much two colours differ in brightness, as eyes judge it: 0..1, of black and white 1. */
double ink_contrast(const struct svg_colour *colour, const struct svg_colour *paper);

bool ink_is_grey(const struct svg_colour *colour);

/*
 * The ink of a colour: greys are the terminal's own; others are brought to a brightness that can be
 * read on dark ground and on light.
 */
struct cell_ink ink_of_colour(const struct svg_colour *colour);

#endif
