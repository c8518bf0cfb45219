/* data/agf_formula.c - the thirteen dispersion formulas of AGF files. */
/* SPDX-License-Identifier: MIT */
#include "data/agf.h"

static void same(const struct pair *c, const signed char *powers, size_t count, struct glass *glass)
{
    (void)powers;
    glass->count = count;
    for (size_t i = 0; i < count; i++) {
        glass->coefficients[i] = c[i];
    }
}

/* c0, then each coefficient beside its power. */
static void with_powers(const struct pair *c, const signed char *powers, size_t count,
                        struct glass *glass)
{
    glass->count = 2 * count - 1;
    glass->coefficients[0] = c[0];
    for (size_t i = 1; i < count; i++) {
        glass->coefficients[2 * i - 1] = c[i];
        glass->coefficients[2 * i] = pair_of(powers[i - 1]);
    }
}

/* One resonance of GLASS_RESONANCES: (p l^2 + q)/(l^2 - c). */
static void add_resonance(struct glass *glass, struct pair p, struct pair q, struct pair c)
{
    glass->coefficients[glass->count++] = p;
    glass->coefficients[glass->count++] = q;
    glass->coefficients[glass->count++] = c;
}

static const struct pair zero = {0, 0};

static void agf_formula_begin(struct glass *glass, struct pair constant, struct pair square)
{
    glass->coefficients[0] = constant;
    glass->coefficients[1] = square;
    glass->count = 2;
}

static void sellmeier_2(const struct pair *c, const signed char *powers, size_t count,
                        struct glass *glass)
{
    (void)powers;
    (void)count;
    agf_formula_begin(glass, pair_add(pair_of(1), c[0]), zero);
    add_resonance(glass, c[1], zero, pair_multiply(c[2], c[2]));
    add_resonance(glass, zero, c[3], pair_multiply(c[4], c[4]));
}

static void handbook_1(const struct pair *c, const signed char *powers, size_t count,
                       struct glass *glass)
{
    (void)powers;
    (void)count;
    agf_formula_begin(glass, c[0], pair_negate(c[3]));
    add_resonance(glass, zero, c[1], c[2]);
}

static void handbook_2(const struct pair *c, const signed char *powers, size_t count,
                       struct glass *glass)
{
    (void)powers;
    (void)count;
    agf_formula_begin(glass, c[0], pair_negate(c[3]));
    add_resonance(glass, c[1], zero, c[2]);
}

static void sellmeier_4(const struct pair *c, const signed char *powers, size_t count,
                        struct glass *glass)
{
    (void)powers;
    (void)count;
    agf_formula_begin(glass, c[0], zero);
    add_resonance(glass, c[1], zero, c[2]);
    add_resonance(glass, c[3], zero, c[4]);
}

/* In the order of their numbers. */
static const struct {
    enum glass_formula formula;
    size_t count;
    void (*set)(const struct pair *c, const signed char *powers, size_t count, struct glass *glass);
    signed char powers[8]; /* of l, of the coefficients behind the first */
} formulas[AGF_FORMULAS] = {
    {GLASS_SCHOTT, 6, same, {0}},
    {GLASS_SELLMEIER, 6, same, {0}},
    {GLASS_HERZBERGER, 6, same, {0}},
    {GLASS_RESONANCES, 5, sellmeier_2, {0}},
    {GLASS_CONRADY, 3, same, {0}},
    {GLASS_SELLMEIER, 8, same, {0}},
    {GLASS_RESONANCES, 4, handbook_1, {0}},
    {GLASS_RESONANCES, 4, handbook_2, {0}},
    {GLASS_RESONANCES, 5, sellmeier_4, {0}},
    {GLASS_POWER, 8, with_powers, {2, -2, -4, -6, -8, -10, -12}},
    {GLASS_SELLMEIER, 10, same, {0}},
    {GLASS_POWER, 8, with_powers, {2, -2, -4, -6, -8, 4, 6}},
    {GLASS_POWER, 9, with_powers, {2, 4, -2, -4, -6, -8, -10, -12}},
};

size_t agf_formula_count(int number)
{
    return formulas[number - 1].count;
}

void agf_formula_set(int number, const struct pair *coefficients, struct glass *glass)
{
    glass->formula = formulas[number - 1].formula;
    formulas[number - 1].set(coefficients, formulas[number - 1].powers, formulas[number - 1].count,
                             glass);
}
