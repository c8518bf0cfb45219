/* base/image/srgb.c - light as sRGB encodes it. */
/* SPDX-License-Identifier: MIT */
#include "base/image/srgb.h"

#include <math.h>

double srgb_encoded(double light)
{
    return light <= 0.0031308 ? 12.92 * light : 1.055 * pow(light, 1 / 2.4) - 0.055;
}

double srgb_light(double value)
{
    return value <= 0.04045 ? value / 12.92 : pow((value + 0.055) / 1.055, 2.4);
}

uint32_t srgb_code(float value, uint32_t most, bool is_light)
{
    if (!(value > 0)) {
        return 0;
    }
    if (value >= 1) {
        return most;
    }
    const double shown = is_light ? srgb_encoded((double)value) : (double)value;
    return (uint32_t)(shown * most + 0.5);
}
