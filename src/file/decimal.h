/* file/decimal.h - exact arithmetic on the digits of a number as it is typed. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_DECIMAL_H
#define LENSCALC_FILE_DECIMAL_H

#include "base/arena.h"
#include "base/text.h"

/*
 * The digits of a number times 2, times 1/2, or with the other sign; exact, whatever their number.
 *
 * Given     typed  a decimal number as number_read takes it, with or without an exponent
 * Result    in the arena; trailing zeros behind the point go where a digit was added
 */
struct text decimal_double(struct text typed, struct arena *arena);
struct text decimal_half(struct text typed, struct arena *arena);
struct text decimal_negate(struct text typed, struct arena *arena);

/* The digits times a power of ten, from -60 to 60, without an exponent unless there is one. */
struct text decimal_shift(struct text typed, int power, struct arena *arena);

#endif
