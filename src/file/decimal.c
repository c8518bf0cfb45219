/* file/decimal.c - exact arithmetic on the digits of a number as it is typed. */
/* SPDX-License-Identifier: MIT */
#include "file/decimal.h"

#include <stdbool.h>
#include <string.h>

/* A number taken apart: sign, digits, how many of them stand before the point, exponent. */
struct decimal {
    bool is_negative;
    char *digits; /* with room for more in front and behind */
    size_t count;
    long before; /* may lie outside of the digits */
    struct text exponent;
};

enum { DECIMAL_ROOM = 80 };

static struct decimal decimal_take_apart(struct text typed, struct arena *arena)
{
    char *room = arena_array(arena, typed.length + 2 * DECIMAL_ROOM, 1);
    struct decimal decimal = {
        .digits = room + DECIMAL_ROOM, .before = -1, .exponent = {typed.start + typed.length, 0}};
    for (size_t i = 0; i < typed.length; i++) {
        char c = typed.start[i];
        if (c == '-' || c == '+') {
            decimal.is_negative = c == '-';
        } else if (c == '.') {
            decimal.before = (long)decimal.count;
        } else if (c >= '0' && c <= '9') {
            decimal.digits[decimal.count++] = c;
        } else {
            decimal.exponent = text_between(typed.start + i, typed.start + typed.length);
            break;
        }
    }
    decimal.before = decimal.before < 0 ? (long)decimal.count : decimal.before;
    return decimal;
}

static struct text put_together(struct decimal decimal, struct arena *arena)
{
    while (decimal.before > 1 && decimal.count > 1 && decimal.digits[0] == '0') {
        decimal.digits++;
        decimal.count--;
        decimal.before--;
    }
    char *start = arena_array(arena, decimal.count + decimal.exponent.length + 4 * DECIMAL_ROOM, 1);
    char *at = start;
    if (decimal.is_negative) {
        *at++ = '-';
    }
    if (decimal.before <= 0) {
        *at++ = '0';
        *at++ = '.';
        for (long i = decimal.before; i < 0; i++) {
            *at++ = '0';
        }
    }
    for (size_t i = 0; i < decimal.count; i++) {
        *at++ = decimal.digits[i];
        if ((long)i + 1 == decimal.before && i + 1 < decimal.count) {
            *at++ = '.';
        }
    }
    for (long i = (long)decimal.count; i < decimal.before; i++) {
        *at++ = '0';
    }
    memcpy(at, decimal.exponent.start, decimal.exponent.length);
    return text_between(start, at + decimal.exponent.length);
}

static void decimal_multiply(struct decimal *decimal, int factor)
{
    int carry = 0;
    for (size_t i = decimal->count; i-- > 0;) {
        int product = (decimal->digits[i] - '0') * factor + carry;
        decimal->digits[i] = (char)('0' + product % 10);
        carry = product / 10;
    }
    if (carry > 0) {
        *--decimal->digits = (char)('0' + carry);
        decimal->count++;
        decimal->before++;
    }
}

struct text decimal_double(struct text typed, struct arena *arena)
{
    struct decimal decimal = decimal_take_apart(typed, arena);
    decimal_multiply(&decimal, 2);
    return put_together(decimal, arena);
}

struct text decimal_half(struct text typed, struct arena *arena)
{
    struct decimal decimal = decimal_take_apart(typed, arena);
    decimal_multiply(&decimal, 5);
    decimal.before--;
    while ((long)decimal.count > decimal.before && decimal.count > 1 &&
           decimal.digits[decimal.count - 1] == '0') {
        decimal.count--;
    }
    return put_together(decimal, arena);
}

struct text decimal_negate(struct text typed, struct arena *arena)
{
    struct decimal decimal = decimal_take_apart(typed, arena);
    bool is_zero = true;
    for (size_t i = 0; i < decimal.count; i++) {
        is_zero = is_zero && decimal.digits[i] == '0';
    }
    decimal.is_negative = !is_zero && !decimal.is_negative;
    return put_together(decimal, arena);
}

struct text decimal_shift(struct text typed, int power, struct arena *arena)
{
    struct decimal decimal = decimal_take_apart(typed, arena);
    decimal.before += power;
    return put_together(decimal, arena);
}
