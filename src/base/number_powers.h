/* base/number_powers.h - powers of ten to 128 bits and the rounding of products with them. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_NUMBER_POWERS_H
#define LENSCALC_BASE_NUMBER_POWERS_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

__extension__ typedef unsigned __int128 uint128;

enum {
    NUMBER_POWER_MIN = -342, /* a 64-bit integer times less than this is no double but 0 */
    NUMBER_POWER_MAX = 340,  /* shows 17 digits of the smallest double */
    NUMBER_POWER_EXACT = 55, /* 10^0 to 10^55 are exact: 5^55 < 2^128 */
};

/* Eight characters as one word, the first in the low byte whatever the machine's byte order. */
static inline uint64_t number_load_eight(const char *at)
{
    uint64_t eight;
    memcpy(&eight, at, sizeof eight);
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    eight = __builtin_bswap64(eight);
#endif
    return eight;
}

static inline void number_store_eight(char *to, uint64_t eight)
{
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    eight = __builtin_bswap64(eight);
#endif
    memcpy(to, &eight, sizeof eight);
}

/* The first 128 binary digits of a power of ten, the rest cut off; `high` has its top bit set. */
struct number_power {
    uint64_t high, low;
};

extern const struct number_power number_powers[NUMBER_POWER_MAX - NUMBER_POWER_MIN + 1];

static inline bool number_power_is_exact(int power)
{
    return power >= 0 && power <= NUMBER_POWER_EXACT;
}

/* floor(log2(10^power)); the constant is log2(10) x 2^19, checked for |power| <= 400. */
static inline int number_log2_of_power10(int power)
{
    return (power * 1741647) >> 19;
}

/* floor(log10(2^power)); the constant is log10(2) x 2^22, checked for -1100 <= power < 1030. */
static inline int number_log10_of_power2(int power)
{
    return (power * 1262611) >> 22;
}

/*
 * The first 64 of the 192 bits of factor x 10^power, for the top bit of the factor set: the truth
 * is in [result, result + 2) times 2^(floor(log2(10^power)) + 1). Nearly always that is enough.
 */
static inline uint64_t number_multiply_high(uint64_t factor, int power)
{
    return (uint64_t)((uint128)factor * number_powers[power - NUMBER_POWER_MIN].high >> 64);
}

/*
 * Divide what is in [high, high + slack) by 2^drop, 1 to 63, and round to nearest. False if the
 * interval touches a tie.
 */
static inline bool number_round_high(uint64_t high, uint64_t slack, int drop, uint64_t *rounded)
{
    const uint64_t half = (uint64_t)1 << (drop - 1);
    const uint64_t rest = high & (half + half - 1);
    *rounded = (high >> drop) + (rest > half);
    /* above a tie the difference wraps around: no branch on a coin toss */
    return half - rest >= slack;
}

/*
 * factor x 10^power as an integer `top` times 2^(floor(log2(10^power)) - 63), known from below:
 * the true quotient is in [top, top + slack), and it is top itself if `exact`.
 */
struct number_product {
    uint128 top;
    uint128 slack; /* 1 or 2 for a known factor */
    bool exact;
};

/* The first 128 of the 192 bits. */
static inline struct number_product number_multiply(uint64_t factor, int power)
{
    const struct number_power *ten = &number_powers[power - NUMBER_POWER_MIN];
    const uint128 low = (uint128)factor * ten->low;
    const uint128 top = (uint128)factor * ten->high + (uint64_t)(low >> 64);
    const bool exact = number_power_is_exact(power);
    return (struct number_product){top, exact ? 1 : 2, exact && (uint64_t)low == 0};
}

/*
 * Divide the product by 2^drop, 1 to 127, and round to nearest, ties to even. False if `slack` is
 * too wide to tell on which side of a tie the truth is. The result has to fit into 64 bits.
 */
static inline bool number_round(struct number_product product, int drop, uint64_t *rounded)
{
    const uint128 half = (uint128)1 << (drop - 1);
    const uint128 rest = product.top & (half + half - 1);
    const uint64_t whole = (uint64_t)(product.top >> drop);
    bool up = rest > half;
    if (rest == half) {
        /* something was cut off above a known factor's tie; of an unknown factor it may be zeros */
        up = !product.exact || (whole & 1) != 0;
        if (product.slack > 2)
            return false;
    }
    *rounded = whole + up;
    return rest >= half || rest + product.slack <= half;
}

#endif
