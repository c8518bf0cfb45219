/* draw/palette.c - colours that the colour-blind can tell apart. */
/* SPDX-License-Identifier: MIT */
#include "draw/palette.h"

#include <math.h>

const char *palette_colour(size_t i)
{
    static const char *const colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                          "#000000", "#e69f00", "#56b4e9"};
    return colours[i % (sizeof colours / sizeof colours[0])];
}

/* Evenly from the lowest number to the highest. */
static const unsigned char light[][3] = {{10, 8, 36},   {62, 18, 106},  {142, 36, 106},
                                         {214, 78, 62}, {248, 154, 34}, {253, 247, 190}};
static const unsigned char diverging[][3] = {
    {24, 66, 148}, {104, 160, 210}, {247, 247, 247}, {236, 142, 104}, {158, 24, 38}};

void palette_scale(bool is_signed, double share, double colour[3])
{
    const unsigned char(*list)[3] = is_signed ? diverging : light;
    const double last = is_signed ? 4 : 5;
    const double place = fmin(fmax(share, 0), 1) * last;
    const size_t below = (size_t)fmin(floor(place), last - 1);
    const double rest = place - (double)below;
    for (int i = 0; i < 3; i++) {
        colour[i] = (list[below][i] + rest * (list[below + 1][i] - list[below][i])) / 255;
    }
}
