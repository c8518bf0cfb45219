/* draw/terminal/ink.c - colours of drawings as a terminal shows them. */
/* SPDX-License-Identifier: MIT */
#include "draw/terminal/ink.h"

#include "base/image/srgb.h"

#include <math.h>

/* Luminance of sRGB, 0..1 [IEC99]. */
static double colour_brightness(const struct svg_colour *colour)
{
    static const double weights[] = {0.2126, 0.7152, 0.0722};
    double sum = 0;
    for (size_t k = 0; k < 3; k++) {
        sum += weights[k] * srgb_light(colour->part[k]);
    }
    return sum;
}

double ink_contrast(const struct svg_colour *colour, const struct svg_colour *paper)
{
    return fabs(cbrt(colour_brightness(colour)) - cbrt(colour_brightness(paper)));
}

bool ink_is_grey(const struct svg_colour *colour)
{
    const double *part = colour->part;
    const double most = fmax(fmax(part[0], part[1]), part[2]);
    return most - fmin(fmin(part[0], part[1]), part[2]) < 0.12;
}

struct cell_ink ink_of_colour(const struct svg_colour *colour)
{
    static const double darkest = 0.16, brightest = 0.4;
    struct cell_ink ink = {.is_set = !colour->is_none && !ink_is_grey(colour)};
    const double brightness = colour_brightness(colour);
    const double wanted = fmin(fmax(brightness, darkest), brightest);
    for (size_t k = 0; k < 3 && ink.is_set; k++) {
        double light = srgb_light(colour->part[k]);
        /* darker in proportion; brighter towards white */
        light = wanted < brightness
                    ? light * wanted / brightness
                    : light + (1 - light) * (wanted - brightness) / (1 - brightness);
        ink.part[k] = (unsigned char)lround(255 * srgb_encoded(fmin(fmax(light, 0), 1)));
    }
    return ink;
}
