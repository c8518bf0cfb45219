/* base/image/half.c - floats of 16 bits. */
/* SPDX-License-Identifier: MIT */
#include "base/image/half.h"

#include "base/image/bytes.h"

#include <math.h>

uint16_t half_of_float(float value)
{
    const uint32_t bits = bytes_bits(value);
    const uint16_t sign = (uint16_t)(bits >> 16 & 0x8000);
    const float size = fabsf(value);
    if (isnan(value)) {
        return sign | 0x7e00;
    }
    if (size >= HALF_END) {
        return sign | 0x7c00;
    }
    /* in units of the last place: 2^-24 below 2^-14 */
    int exponent;
    frexp((double)size, &exponent);
    exponent = size < 0x1p-14F ? -13 : exponent;
    const double units = ldexp((double)size, 11 - exponent);
    uint32_t whole = (uint32_t)units;
    const double rest = units - whole;
    whole += rest > 0.5 || (rest >= 0.5 && whole % 2 != 0) ? 1 : 0;
    /* the leading one of a normal number counts as an exponent, and so does a carry */
    return (uint16_t)(sign | ((uint32_t)(exponent + 13) * 1024 + whole));
}

float half_value(uint16_t half)
{
    const int exponent = half >> 10 & 31, fraction = half & 1023;
    const float size = exponent == 31  ? (fraction != 0 ? NAN : INFINITY)
                       : exponent == 0 ? ldexpf((float)fraction, -24)
                                       : ldexpf((float)(1024 + fraction), exponent - 25);
    return half & 0x8000 ? -size : size;
}
