/* design/tolerance/sensitivity.h - what each error costs alone, and what errors may cost. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_TOLERANCE_SENSITIVITY_H
#define LENSCALC_DESIGN_TOLERANCE_SENSITIVITY_H

#include "design/tolerance/second_order.h"

/* What an error at the ends of its range does to a figure: changes. */
struct sensitivity {
    double plus, minus; /* NaN: the lens has no figures then */
    double linear;      /* the derivative there is nominally, times the half range; NaN: a root of 0
                           has none, or a lens near the nominal one has no figures */
    double quadratic;   /* (plus + minus)/2 */
};

/*
 * One error after the other.
 *
 * Given     nominal  figures without errors
 *           table    receives error_count rows of figure_count
 *           failure  receives why the first that failed has no figures; null: none has
 * Result    so many errors have their rows: all, unless the watch of the problem stops it
 * Formula   linear: with D(h) = (f(h) - f(-h))/2h and h = 1/8, (D(h) - h^2 D(1))/(1 - h^2), which
 *           leaves out h^2/120 of the fifth derivative; of a root that of its square over twice
 *           the root
 */
size_t sensitivity_find(const struct second_order_problem *problem, const double *nominal,
                        struct arena *arena, struct sensitivity *table, const char **failure);

/* What is wanted of tolerances. */
struct inverse_question {
    const struct second_order_problem *problem;
    /* how much worse the lens is with these figures than without errors, in the unit of `drop` */
    double (*cost)(void *context, const double *figures);
    void *context;       /* of cost */
    double drop;         /* above 0: what all of them together may cost */
    const size_t *thing; /* of each error its tolerance: 0 .. thing_count - 1; two errors of one, as
                            its shifts along x and y, are as wide as each other */
    size_t thing_count;
    const double *low, *high; /* one a tolerance: what can be made, in units of the half range */
};

/* What keeps a tolerance from its share. */
enum inverse_limit {
    INVERSE_FREE,     /* nothing: its cost is the share */
    INVERSE_TIGHTEST, /* no shop makes it tighter: it costs more */
    INVERSE_LOOSEST   /* it need not be looser: it costs less */
};

struct inverse {
    double factor; /* of the half range that was asked */
    double cost;   /* of it alone: the worse of both ends, of several errors the root of the sum of
                      the squares */
    enum inverse_limit limit;
};

/*
 * Tolerances that cost the same each, and together a drop.
 *
 * Given     answers  receives one a tolerance
 * Result    what they cost together, the root of the sum of the squares; more than `drop` where the
 *           tightest tolerances already cost it. NaN: a tightest one makes a lens without figures,
 *           or the watch of the problem stops it
 * Formula   the share s with the sum of clamp(s, cost at the tightest, cost at the loosest)^2 =
 *           drop^2, a thousandth of the drop at least; then cost(factor) = s, the worse of both
 *           ends, by bisection: exact trials at each step
 */
double inverse_find(const struct inverse_question *question, struct arena *arena,
                    struct inverse *answers);

#endif
