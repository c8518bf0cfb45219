/* base/number_short.h - decimal text of up to seven characters to a number, without a loop. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_NUMBER_SHORT_H
#define LENSCALC_BASE_NUMBER_SHORT_H

#include <stddef.h>

#include "base/number_powers.h"

enum { NUMBER_SHORT_DIGITS = 7 };

/* mantissa / 10^decimals */
struct number_short {
    uint32_t mantissa;
    unsigned decimals; /* 0 .. NUMBER_SHORT_DIGITS */
};

/*
 * The number of eight digit values in bytes, the most significant in the low one: pairs, then
 * fours, then all, each in one multiplication.
 * Source: Lemire, Quickly parsing eight digits (lemire.me, 2018).
 */
static inline uint32_t number_of_eight(uint64_t digits)
{
    const uint64_t lanes = 0x000000ff000000ff;
    digits = digits * 10 + (digits >> 8);
    digits = (digits & lanes) * (100 + ((uint64_t)1000000 << 32)) +
             (digits >> 16 & lanes) * (1 + ((uint64_t)10000 << 32));
    return (uint32_t)(digits >> 32);
}

/*
 * Most numbers in files end within eight characters, such as "85", "2.8" or "1234.56": these are
 * read without a loop and without a branch on their form, which no processor could guess.
 *
 * Given     at  eight readable characters
 * Result    the character behind the number, which may still be an exponent's 'e'; null if the
 *           first eight characters are not digits, with or without a point, and one more character
 */
static inline const char *number_read_short(const char *at, struct number_short *number)
{
    const uint64_t digits = number_load_eight(at) ^ 0x3030303030303030;
    /* the top bit of each byte that is no digit; right up to the first one that is no point */
    const uint64_t others = ((digits + 0x7676767676767676) | digits) & 0x8080808080808080;
    /* in bits, as all below; with eight digits any place will do */
    const unsigned first = (unsigned)__builtin_ctzll(others | (uint64_t)1 << 63) & ~7U;
    const unsigned point = (digits >> first & 0xff) == ('.' ^ '0');
    const uint64_t stops = others & (others - point);
    if (stops == 0)
        return NULL;
    const unsigned stop = (unsigned)__builtin_ctzll(stops) & ~7U;
    const unsigned used = stop - 8 * point;
    if (used == 0)
        return NULL;
    /* close the gap of the point; without one only what is shifted out is changed */
    const uint64_t joined = digits ^ ((digits ^ digits >> 8) & ~(uint64_t)0 << first);
    number->mantissa = number_of_eight(joined << (64 - used));
    number->decimals = (used - first) / 8;
    return at + stop / 8;
}

#endif
