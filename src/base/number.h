/* base/number.h - decimal text to double and back, exact and fast. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_NUMBER_H
#define LENSCALC_BASE_NUMBER_H

#include "base/text.h"

#include <stdbool.h>

/* The longest text a number_write function writes (no NUL is written). */
#define NUMBER_LENGTH 32

/*
 * A unit's factor kept exact: `multiplier` x 10^`power`, so that 2.54 cm, 1 in and 25.4 mm are
 * the same double. { 1, 0 } changes nothing; m to mm is { 1, 3 }; ft to mm is { 3048, -1 }.
 */
struct number_scale {
    unsigned multiplier; /* 1 .. 10^9 */
    int power;           /* -60 .. 60 */
};

#define NUMBER_UNSCALED ((struct number_scale){1, 0})

/*
 * Read the decimal number at `at`: [+-] digits [. digits] [e [+-] digits], with at least one digit
 * before or after the point ("1." and ".5" are numbers), or [+-] inf in lower case. C locale; no
 * blanks are skipped, no hex, no nan. Time is linear in the length of the text.
 *
 * Given     at, end  the text; reads no character at or behind `end`
 *           scale    the value is multiplied by this exactly, before the one rounding
 *           value    receives the correctly rounded (nearest, ties to even) double
 * Result    the first character that does not belong to the number (an 'e' that no digit follows
 *           does not belong to it); null if there is no number, then value is unchanged.
 *           A finite text too large for a double gives +-inf in value: tell it from a typed
 *           "inf" by its first letter. A text too small gives a subnormal or +-0.
 * Source    Clinger, How to Read Floating Point Numbers Accurately, PLDI 1990 (the exact case);
 *           Lemire, Number Parsing at a Gigabyte per Second, 2021 (the 128-bit case).
 */
const char *number_read(const char *at, const char *end, struct number_scale scale, double *value);

/* The same of a whole text. Result: false where it is none, or more than a number. */
bool text_number(struct text text, struct number_scale scale, double *value);

/*
 * Write x with `digits` significant digits, 1 to 17, byte for byte what printf("%.*g") writes in
 * the C locale (trailing zeros removed, exponent of two digits or more).
 *
 * Given     to  room for NUMBER_LENGTH characters
 * Result    the end of what was written; inf is `inf` or `-inf`, -0 `-0`, NaN writes nothing
 */
char *number_write_digits(char *to, double x, int digits);

/*
 * Write x with the fewest digits that read back as the same double; of those the nearest to x.
 * Laid out as %.17g would (exponent form below 1e-4 and from 1e17 on); inf, -0 and NaN as above.
 * Source    Giulietti, The Schubfach way to render doubles, 2020.
 */
char *number_write_shortest(char *to, double x);

/*
 * Write x with `digits` significant digits, 1 to 17, as people read numbers: without an exponent
 * from 1e-6 to below 1e9, where digits of a whole number beyond those asked for are 0 (123456 to 3
 * digits: 123000).
 *
 * Given     to      room for NUMBER_LENGTH characters
 *           padded  keep zeros behind the point: 10.00, not 10
 * Result    the end of what was written; inf, -0 and NaN as above
 */
char *number_write_plain(char *to, double x, int digits, bool padded);

/*
 * Does x need more than `digits` digits, 1 to 17, to be read back as the same double? Multiplying
 * by a power of ten in the text does not change the answer. False for 0, inf and NaN.
 */
bool number_needs_more(double x, int digits);

#endif
