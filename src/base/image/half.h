/* base/image/half.h - floats of 16 bits. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_IMAGE_HALF_H
#define LENSCALC_BASE_IMAGE_HALF_H

#include <stdint.h>

/* The largest that is not rounded to infinity lies just under this. */
#define HALF_END 65520.0F

/*
 * IEEE 754's binary16: a sign, 5 bits of exponent, 10 of fraction.
 *
 * Given     value  any; above HALF_END it becomes infinity, a NaN stays one
 * Result    the nearest, ties to even
 */
uint16_t half_of_float(float value);

/* Exact. */
float half_value(uint16_t half);

#endif
