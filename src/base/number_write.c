/* base/number_write.c - double to decimal text, to a given or to the least number of digits. */
/* SPDX-License-Identifier: MIT */
#include "base/number.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "base/number_powers.h"

enum {
    MOST_DIGITS = 17,
    FEW_DIGITS = 8,      /* one word of characters */
    LEAST_EXPONENT = -4, /* of a number written without an exponent */
    LEAST_PLAIN = -6,    /* the same where people read it */
    MOST_PLAIN = 8,
    FIELD_MASK = 0x7ff,
};

/* clang-format off */
static const uint64_t tens[] = {
    1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000, 1000000000, 10000000000,
    100000000000, 1000000000000, 10000000000000, 100000000000000, 1000000000000000,
    10000000000000000, 100000000000000000
};
/* clang-format on */

static const uint64_t zeros = 0x3030303030303030; /* eight times '0' */

/* 10^(index + LEAST_EXPONENT) */
static const double small_tens[] = {1e-4, 1e-3, 1e-2, 1e-1, 1e0, 1e1, 1e2,  1e3,
                                    1e4,  1e5,  1e6,  1e7,  1e8, 1e9, 1e10, 1e11};

/*
 * Where things stand in a number without exponent, by its decimal exponent - LEAST_EXPONENT. A
 * table, since branches on it would be guesses; what is written behind the end does no harm.
 */
static const struct number_write_layout {
    int ahead; /* characters before the digits: 0. 0.0 0.00 0.000 */
    int whole; /* digits before the point; 8 for a point behind the end */
    int least; /* characters from the first digit on */
} layouts[] = {{5, 8, 0}, {4, 8, 0}, {3, 8, 0}, {2, 8, 0}, {0, 1, 1}, {0, 2, 2},
               {0, 3, 3}, {0, 4, 4}, {0, 5, 5}, {0, 6, 6}, {0, 7, 7}, {0, 8, 8}};

/* The parts of a finite double other than 0: significand x 2^exponent. */
struct number_write_parts {
    uint64_t significand;
    int exponent;
    bool narrow_below; /* a power of two whose lower neighbour is nearer than the upper one */
};

/* A decimal number: its integer x 10^(exponent - length + 1), so that exponent is that of %e. */
struct number_write_decimal {
    uint64_t integer; /* below 10^17 */
    int length;       /* of the integer, in digits */
    int exponent;
};

/* The characters of MOST_DIGITS digits, the first in the low byte of a word. */
struct characters {
    uint64_t first;  /* digits 0 to 7 */
    uint64_t second; /* digits 8 to 15 */
    char last;       /* digit 16 */
    int count;       /* of digits up to the last that is not 0 */
};

static inline struct number_write_parts parts_of(uint64_t bits)
{
    const uint64_t fraction = bits & (((uint64_t)1 << 52) - 1);
    const int field = (int)(bits >> 52) & FIELD_MASK;
    if (field == 0) {
        return (struct number_write_parts){fraction, -1074, false};
    }
    return (struct number_write_parts){fraction | (uint64_t)1 << 52, field - 1075,
                                       fraction == 0 && field > 1};
}

/*
 * The eight digits of n < 10^8 as eight bytes, the first digit in the low one: split n by 10^4,
 * both halves by 10^2 and all quarters by 10 at once, in lanes of one word. The multipliers are
 * 2^20 / 100 and 2^10 / 10 rounded up, exact for four and for two digits.
 * Source: Khuong, How to print integers really fast (pvk.ca, 2017).
 */
static inline uint64_t eight_digits(uint32_t n)
{
    const uint64_t fours = n / 10000 | (uint64_t)(n % 10000) << 32;
    const uint64_t hundreds = ((fours * 10486) >> 20) & 0x0000007f0000007f;
    const uint64_t twos = hundreds | (fours - hundreds * 100) << 16;
    const uint64_t tenths = ((twos * 103) >> 10) & 0x000f000f000f000f;
    return tenths | (twos - tenths * 10) << 8;
}

/* How many of the eight digits are left without the zeros at the end; at least one is not 0. */
static inline int significant_digits(uint64_t eight)
{
    return 8 - __builtin_clzll(eight) / 8;
}

static inline struct characters characters_of(struct number_write_decimal decimal)
{
    const uint64_t all = decimal.integer * tens[MOST_DIGITS - decimal.length];
    const uint32_t behind = (uint32_t)(all % 1000000000);
    struct characters digits = {eight_digits((uint32_t)(all / 1000000000)),
                                eight_digits(behind / 10), (char)('0' + behind % 10), MOST_DIGITS};
    if (behind == 0) {
        digits.count = significant_digits(digits.first);
    } else if (digits.last == '0') {
        digits.count = 8 + significant_digits(digits.second);
    }
    digits.first |= zeros;
    digits.second |= zeros;
    return digits;
}

/* All digits; `to` has room for MOST_DIGITS. */
static inline void store_digits(char *to, const struct characters *digits)
{
    number_store_eight(to, digits->first);
    number_store_eight(to + 8, digits->second);
    to[16] = digits->last;
}

/*
 * All digits with a point behind the first `whole` ones, 1 or more and fewer than digits->count;
 * `to` has room for MOST_DIGITS + 1.
 */
static inline void store_with_point(char *to, const struct characters *digits, int whole)
{
    const uint128 head = (uint128)digits->second << 64 | digits->first;
    const uint128 ahead = head & ~(uint128)0 >> (128 - 8 * whole);
    const uint128 shifted = ahead | (head ^ ahead) << 8;
    number_store_eight(to, (uint64_t)shifted);
    number_store_eight(to + 8, (uint64_t)(shifted >> 64));
    to[16] = (char)(digits->second >> 56); /* pushed out of the 16 by the point */
    to[17] = digits->last;
    to[whole] = '.';
}

/* As %g does: fixed from 1e-4 to below 10^precision, no zeros at the end. */
static inline char *number_write_lay_out(char *to, struct number_write_decimal decimal,
                                         int precision)
{
    const struct characters digits = characters_of(decimal);
    const int exponent = decimal.exponent;
    if (exponent >= 0 && exponent < precision) {
        if (digits.count > exponent + 1) {
            store_with_point(to, &digits, exponent + 1);
            return to + digits.count + 1;
        }
        store_digits(to, &digits);
        return to + exponent + 1;
    }
    if (exponent < 0 && exponent >= LEAST_EXPONENT) {
        memcpy(to, "0.000000", 8);
        to += 1 - exponent;
        store_digits(to, &digits);
        return to + digits.count;
    }
    store_with_point(to, &digits, 1);
    to += digits.count + (digits.count > 1);
    *to++ = 'e';
    *to++ = exponent < 0 ? '-' : '+';
    const unsigned size = (unsigned)(exponent < 0 ? -exponent : exponent);
    if (size >= 100) {
        *to++ = (char)('0' + size / 100);
    }
    *to++ = (char)('0' + size / 10 % 10);
    *to++ = (char)('0' + size % 10);
    return to;
}

/*
 * Round to `digits` digits: scale by the power of ten that leaves so many before the point. False
 * if 128 bits do not tell a tie from its neighbourhood, as for 1234565 to 6 digits, since 10^-1 is
 * not exact in binary.
 */
static inline bool round_to_digits(struct number_write_parts parts, int digits,
                                   struct number_write_decimal *decimal)
{
    const int shift = __builtin_clzll(parts.significand);
    const uint64_t factor = parts.significand << shift;
    const int exponent = parts.exponent - shift;

    decimal->length = digits;
    /*
     * floor(log10(factor x 2^(log2 - 63))), top bit of the factor set: that of the power of two, or
     * one more from the next power of ten on, if that lies in the same octave. No branch: it would
     * be a coin toss.
     */
    const int log2 = exponent + 63;
    const int below = number_log10_of_power2(log2);
    const uint64_t next = number_powers[below + 1 - NUMBER_POWER_MIN].high;
    const int same_octave = number_log2_of_power10(below + 1) == log2;
    /* a power that is not exact lies above its first 64 bits, which have more than 53 that count */
    const int reached = (factor > next) | ((factor == next) & number_power_is_exact(below + 1));
    decimal->exponent = below + (same_octave & reached);
    const int power = digits - 1 - decimal->exponent;
    const int drop = -1 - number_log2_of_power10(power) - exponent;
    const uint64_t high = number_multiply_high(factor, power);
    if (!number_round_high(high, 2, drop, &decimal->integer) &&
        !number_round(number_multiply(factor, power), drop + 64, &decimal->integer)) {
        return false;
    }
    if (decimal->integer == tens[digits]) {
        decimal->integer /= 10;
        decimal->exponent++;
    }
    return true;
}

/* factor x ten / 2^128, where the last bit also says whether anything is behind it. */
static inline uint64_t multiply_to_odd(uint64_t factor, struct number_power ten)
{
    const uint128 low = (uint128)factor * ten.low;
    const uint128 all = (uint128)factor * ten.high + (uint64_t)(low >> 64);
    /* `ten` is rounded up: one unit in the word behind is that error, not a digit */
    return (uint64_t)(all >> 64) | ((uint64_t)all > 1);
}

/*
 * The shortest decimal inside the interval that rounds to x, the nearest to x of these.
 * With 10^k <= the width of the interval < 10^(k+1), it holds a multiple of 10^k and at most one of
 * 10^(k+1): try the two neighbours of x among the latter, then those among the former.
 * Everything is scaled by 4 / 10^k so that the halves of the unit in the last place are integers.
 * Source: Giulietti, The Schubfach way to render doubles, 2020.
 */
static struct number_write_decimal find_shortest(struct number_write_parts x)
{
    const int narrow = x.narrow_below;
    /* floor(log10(2^exponent)), of 3/4 of it if narrow: log10(4/3) x 2^22 = 524031 */
    const int k = (x.exponent * 1262611 - (narrow ? 524031 : 0)) >> 22;
    const int shift = x.exponent + number_log2_of_power10(-k) + 1;
    struct number_power ten = number_powers[-k - NUMBER_POWER_MIN];
    if (!number_power_is_exact(-k)) {
        ten.low++;
        ten.high += ten.low == 0;
    }
    const uint64_t four = 4 * x.significand;
    const uint64_t value = multiply_to_odd(four << shift, ten);
    uint64_t lower = multiply_to_odd((four - 2 + (uint64_t)narrow) << shift, ten);
    uint64_t upper = multiply_to_odd((four + 2) << shift, ten);
    /* the ends of the interval round to the even neighbour */
    lower += x.significand & 1;
    upper -= x.significand & 1;

    const uint64_t floor = value / 4;
    const uint64_t floor_tens = floor / 10 * 10;
    const bool tens_below = lower <= 4 * floor_tens;
    const bool tens_above = 4 * floor_tens + 40 <= upper;
    if (floor >= 10 && tens_below != tens_above) {
        return (struct number_write_decimal){floor_tens + (tens_above ? 10 : 0), 0, k};
    }

    const bool below = lower <= 4 * floor;
    const bool above = 4 * floor + 4 <= upper;
    bool up = above;
    if (below == above) { /* the nearer one, of two equally near ones the even */
        up = value > 4 * floor + 2 || (value == 4 * floor + 2 && (floor & 1) != 0);
    }
    return (struct number_write_decimal){floor + up, 0, k};
}

/* Give the decimal its length; its exponent was that of the last digit. */
static inline struct number_write_decimal with_length(struct number_write_decimal decimal)
{
    int bits = 63 - __builtin_clzll(decimal.integer);
    decimal.length = number_log10_of_power2(bits) + 1;
    decimal.length += decimal.integer >= tens[decimal.length];
    decimal.exponent += decimal.length - 1;
    return decimal;
}

/* The sign, and all of a number that has no digits to compute; `*done` if that is all. */
static inline char *write_special(char *to, uint64_t bits, bool *done)
{
    const uint64_t magnitude = bits & ~((uint64_t)1 << 63);
    const uint64_t infinity = (uint64_t)FIELD_MASK << 52;
    *done = magnitude == 0 || magnitude >= infinity;
    if (magnitude > infinity) {
        return to;
    }
    if (bits != magnitude) {
        *to++ = '-';
    }
    if (magnitude == infinity) {
        memcpy(to, "inf", 3);
        return to + 3;
    }
    *to = '0';
    return to + *done;
}

/*
 * Most numbers: FEW_DIGITS at most, and no exponent. Scaled to an integer below 10^8 by an exact
 * power of ten they are wrong by 2^-27 at most. Null if this is none of them, or too near to a tie
 * or to the next power of ten.
 */
static inline char *write_few(char *to, double x, uint64_t bits, int digits)
{
    const double size = fabs(x);
    if (!(size >= 1e-4 && size < 1e8)) {
        return NULL;
    }
    int exponent = number_log10_of_power2((int)(bits >> 52 & FIELD_MASK) - 1023);
    exponent += size >= small_tens[exponent + 1 - LEAST_EXPONENT];
    if (exponent >= digits) {
        return NULL;
    }
    const double scaled = size * small_tens[digits - 1 - exponent - LEAST_EXPONENT];
    const double shifted = scaled + 0x1p52; /* its last bits are the rounded integer */
    uint64_t integer;
    memcpy(&integer, &shifted, sizeof integer);
    integer &= 0xffffffff;
    if (!(fabs(scaled - (shifted - 0x1p52)) < 0.5 - 0x1p-26) || integer == tens[digits]) {
        return NULL;
    }

    const uint64_t word = eight_digits((uint32_t)(integer * tens[FEW_DIGITS - digits]));
    const int count = significant_digits(word);
    const uint64_t characters = word | zeros;
    const struct number_write_layout layout = layouts[exponent - LEAST_EXPONENT];
    *to = '-';
    to += bits >> 63;
    memcpy(to, "0.000000", 8);
    to += layout.ahead;
    number_store_eight(to, characters);
    number_store_eight(to + layout.whole + 1, characters >> 4 * layout.whole >> 4 * layout.whole);
    to[layout.whole] = '.';
    const int end = count + (count > layout.whole);
    return to + (end > layout.least ? end : layout.least);
}

/* As round_to_digits, by the C library: ties that 128 bits do not settle. */
static struct number_write_decimal round_slowly(double x, int digits)
{
    struct number_write_decimal decimal = {0, digits, 0};
    char text[NUMBER_LENGTH];
    snprintf(text, sizeof text, "%.*e", digits - 1, x);
    const char *at = text;
    for (; *at != 'e'; at++) {
        if (*at >= '0' && *at <= '9') {
            decimal.integer = 10 * decimal.integer + (uint64_t)(*at - '0');
        }
    }
    const bool below = *++at == '-';
    while (*++at != '\0') {
        decimal.exponent = 10 * decimal.exponent + (*at - '0');
    }
    decimal.exponent = below ? -decimal.exponent : decimal.exponent;
    return decimal;
}

/* Out of line, so that few digits need not make room for it. */
__attribute__((noinline)) static char *write_many(char *to, double x, uint64_t bits, int digits)
{
    bool done;
    char *at = write_special(to, bits, &done);
    if (done) {
        return at;
    }
    struct number_write_decimal decimal;
    if (!round_to_digits(parts_of(bits), digits, &decimal)) {
        decimal = round_slowly(x, digits);
    }
    return number_write_lay_out(at, decimal, digits);
}

char *number_write_digits(char *to, double x, int digits)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    char *end = digits <= FEW_DIGITS ? write_few(to, x, bits, digits) : NULL;
    return end != NULL ? end : write_many(to, x, bits, digits);
}

char *number_write_shortest(char *to, double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    bool done;
    char *at = write_special(to, bits, &done);
    if (done) {
        return at;
    }
    return number_write_lay_out(at, with_length(find_shortest(parts_of(bits))), MOST_DIGITS);
}

char *number_write_plain(char *to, double x, int digits, bool padded)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    bool done;
    char *at = write_special(to, bits, &done);
    if (done) {
        return at;
    }
    struct number_write_decimal decimal;
    if (!round_to_digits(parts_of(bits), digits, &decimal)) {
        decimal = round_slowly(x, digits);
    }
    const int exponent = decimal.exponent;
    if (exponent < LEAST_PLAIN || exponent > MOST_PLAIN) {
        return number_write_lay_out(at, decimal, digits);
    }
    char text[MOST_DIGITS + 1];
    const struct characters all = characters_of(decimal);
    store_digits(text, &all);
    int kept = padded ? digits : all.count;
    if (exponent < 0) {
        memcpy(at, "0.000000", 8);
        at += 1 - exponent;
        memcpy(at, text, (size_t)kept);
        return at + kept;
    }
    for (int i = 0; i <= exponent; i++) {
        *at++ = i < digits ? text[i] : '0';
    }
    if (kept > exponent + 1) {
        *at++ = '.';
        memcpy(at, text + exponent + 1, (size_t)(kept - exponent - 1));
        at += kept - exponent - 1;
    }
    return at;
}

bool number_needs_more(double x, int digits)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    const uint64_t size = bits & ~((uint64_t)1 << 63);
    if (size == 0 || size >= (uint64_t)FIELD_MASK << 52) {
        return false;
    }
    const struct number_write_decimal decimal = with_length(find_shortest(parts_of(size)));
    const int over = decimal.length - digits;
    return over > 0 && decimal.integer % tens[over] != 0;
}
