/* draw/palette.c - colours that the colour-blind can tell apart. */
/* SPDX-License-Identifier: MIT */
#include "draw/palette.h"

const char *palette_colour(size_t i)
{
    static const char *const colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                          "#000000", "#e69f00", "#56b4e9"};
    return colours[i % (sizeof colours / sizeof colours[0])];
}
