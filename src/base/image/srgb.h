/* base/image/srgb.h - light as sRGB encodes it. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_IMAGE_SRGB_H
#define LENSCALC_BASE_IMAGE_SRGB_H

#include <stdbool.h>
#include <stdint.h>

/*
 * Given     light  of one channel, 1 = white
 *           value  encoded, 0..1
 * Formula   12.92 light up to 0.0031308, else 1.055 light^(1/2.4) - 0.055; and back, from 0.04045
 * Source    [IEC99] 5.2
 * Limits    encoding goes with pow, whose last bit differs between processors
 */
double srgb_encoded(double light);
double srgb_light(double value);

/*
 * The nearest whole number for a value in 0..1, which is cut to that.
 *
 * Given     value   no NaN
 *           most    the number of 1: 255, 65535
 *           is_light  encode it first: no float lies so near to the light where one number
 *                   becomes the next that the last bit of pow could matter
 */
uint32_t srgb_code(float value, uint32_t most, bool is_light);

#endif
