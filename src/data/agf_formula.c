/* data/agf_formula.c - the thirteen dispersion formulas of AGF files. */
/* SPDX-License-Identifier: MIT */
#include "data/agf.h"

#include <string.h>

/* In the order of their numbers. */
static const struct {
    enum glass_formula formula;
    size_t count;
    signed char powers[8]; /* of l, of the coefficients behind the first */
} formulas[AGF_FORMULAS] = {
    {GLASS_SCHOTT, 6, {0}},
    {GLASS_SELLMEIER, 6, {0}},
    {GLASS_HERZBERGER, 6, {0}},
    {GLASS_RESONANCES, 5, {0}},
    {GLASS_CONRADY, 3, {0}},
    {GLASS_SELLMEIER, 8, {0}},
    {GLASS_RESONANCES, 4, {0}},
    {GLASS_RESONANCES, 4, {0}},
    {GLASS_RESONANCES, 5, {0}},
    {GLASS_POWER, 8, {2, -2, -4, -6, -8, -10, -12}},
    {GLASS_SELLMEIER, 10, {0}},
    {GLASS_POWER, 8, {2, -2, -4, -6, -8, 4, 6}},
    {GLASS_POWER, 9, {2, 4, -2, -4, -6, -8, -10, -12}},
};

size_t agf_formula_count(int number)
{
    return formulas[number - 1].count;
}

/* A constant, the coefficient of l^2, and p, q, c of each resonance (p l^2 + q)/(l^2 - c). */
static void set_resonances(int number, const struct pair *c, struct glass *glass)
{
    const struct pair zero = {0, 0}, negative = pair_negate(c[3]);
    const struct {
        size_t count;
        struct pair of[8];
    } all[AGF_FORMULAS + 1] = {
        [4] = {8,
               {pair_add(pair_of(1), c[0]), zero, c[1], zero, pair_multiply(c[2], c[2]), zero, c[3],
                pair_multiply(c[4], c[4])}},
        [7] = {5, {c[0], negative, zero, c[1], c[2]}},
        [8] = {5, {c[0], negative, c[1], zero, c[2]}},
        [9] = {8, {c[0], zero, c[1], zero, c[2], c[3], zero, c[4]}},
    };
    glass->count = all[number].count;
    memcpy(glass->coefficients, all[number].of, glass->count * sizeof c[0]);
}

void agf_formula_set(int number, const struct pair *coefficients, struct glass *glass)
{
    const size_t count = agf_formula_count(number);
    glass->formula = formulas[number - 1].formula;
    if (glass->formula == GLASS_RESONANCES) {
        set_resonances(number, coefficients, glass);
        return;
    }
    /* The coefficients, behind the first each beside its power where they have powers. */
    bool has_powers = glass->formula == GLASS_POWER;
    glass->count = has_powers ? 2 * count - 1 : count;
    for (size_t i = 0; i < count; i++) {
        glass->coefficients[has_powers && i > 0 ? 2 * i - 1 : i] = coefficients[i];
        if (has_powers && i > 0) {
            glass->coefficients[2 * i] = pair_of(formulas[number - 1].powers[i - 1]);
        }
    }
}
