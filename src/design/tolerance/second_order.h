/* design/tolerance/second_order.h - figures of a lens to second order in its errors. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_TOLERANCE_SECOND_ORDER_H
#define LENSCALC_DESIGN_TOLERANCE_SECOND_ORDER_H

#include "base/arena.h"
#include "base/error.h"
#include "base/watch.h"
#include "design/tolerance/perturbation.h"

#include <stdbool.h>
#include <stddef.h>

/* What a lens does that is made with errors. */
struct second_order_problem {
    /* errors in units of their half ranges; the same figures whatever was asked before */
    bool (*trial)(void *context, const double *errors, double *figures, struct error *why);
    void *context;
    size_t error_count, figure_count;
    size_t judged_count; /* the first of the figures: those that matter */
    const bool *is_root; /* of each figure: it is the root of a sum of squares, such as an RMS */
    const char *const *names; /* of each error, for messages */
    struct watch *watch;      /* counts trials, and is asked before each; or null */
};

/* A function of errors p to second order: value + slope.p + p.curve p/2. */
struct second_order_form {
    double value;
    double *slope; /* one an error */
    double *curve; /* row by row, symmetric */
};

/* The lens as quadratic forms; of figures that are roots those of their squares. */
struct second_order {
    size_t error_count, figure_count, judged_count;
    const bool *is_root;
    struct second_order_form *forms; /* one a figure */
    double *rows;                    /* internal: of the forms, for second_order_trials */
};

/*
 * Develop about the nominal lens.
 *
 * Given     problem  its trials have compensated already: what they are left with is developed
 * Formula   with steps of h = 1/2 and 2h of the half range: slope (8 (f(h) - f(-h)) - (f(2h) -
 *           f(-2h)))/(12 h), curve (f(h) - 2 f(0) + f(-h))/h^2; of two errors (f(h, h) + f(-h, -h)
 *           - f(h, 0) - f(-h, 0) - f(0, h) - f(0, -h) + 2 f(0, 0))/(2 h^2). Squares of what is
 *           nearly linear are nearly quadratic: what is left out is of the fifth order in the
 *           slope and of the fourth in the curve
 * Source    [Hopkins66], [Rimmer70]: the variance of a wave front is a quadratic form of all
 *           perturbations, products of different ones included. They take first derivatives of
 *           the wave front for it; here its second ones, and those of rays, are in it
 * Errors    ERROR_DOMAIN: a lens with one or two errors of half their range has no figures; or the
 *           watch stops it
 */
bool second_order_open(const struct second_order_problem *problem, struct arena *arena,
                       struct second_order *differential, struct error *error);

/* Trials are made so many at once. */
enum { SECOND_ORDER_LANES = 32 };

/*
 * Figures of SECOND_ORDER_LANES trials.
 *
 * Given     errors   error_count rows of lanes
 *           figures  receives figure_count rows of lanes; a square that is below 0 to second order
 *                    counts as 0
 */
void second_order_trials(const struct second_order *differential, const double *errors,
                         double *figures);

/* What of the spread of a figure one error makes: shares of its variance. */
struct second_order_share {
    double first; /* by itself */
    double total; /* with what it does together with others: those count for both */
};

/*
 * Who makes a figure spread; of a root, its square.
 *
 * Given     moments  of the errors, independent of each other
 *           figure   LENS_NONE: the mean of those that are judged
 *           shares   receives one an error; all 0 where nothing spreads
 * Result    the standard deviation of the form
 * Formula   with the moments v = <p^2>, w = <p^4>: first g_i^2 v_i + h_ii^2 (w_i - v_i^2)/4, and
 *           in the total also h_ij^2 v_i v_j of every j
 * Source    Sobol's indices of a quadratic form; derived here
 */
double second_order_shares(const struct second_order *differential,
                           const struct perturbation_moments *moments, size_t figure,
                           struct second_order_share *shares);

/* Internal: one variant an instruction set; a row of coefficients after the other. */
typedef void kernel_differential(const double *rows, size_t count, const double *errors,
                                 double *sums);
kernel_differential kernel_differential_sse2, kernel_differential_avx2, kernel_differential_avx512;

#endif
