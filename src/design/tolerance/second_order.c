/* design/tolerance/second_order.c - figures of a lens to second order in its errors. */
/* SPDX-License-Identifier: MIT */
#include "design/tolerance/second_order.h"

#include "base/instruction_set.h"

#include <math.h>
#include <string.h>

/* -------- developing -------- */

/* Half a half range: small against what is expected, and large against rounding. */
static const double step = 0.5;

/* What is known on the way. */
struct expansion {
    const struct second_order_problem *problem;
    double *errors;        /* of the lens looked at last */
    double *middle;        /* figures, as squares where they are roots, of the nominal lens, */
    double *above, *below; /* one step along each error: a row each, */
    double *up, *down;     /* and of two lenses more */
    struct error *error;
};

/* Two errors of this size; i may be j. */
static bool second_order_look(const struct expansion *developing, size_t i, size_t j, double size,
                              double *figures)
{
    const struct second_order_problem *problem = developing->problem;
    if (!watch_add(problem->watch, 1)) {
        return fail(developing->error, ERROR_DOMAIN,
                    "interrupted before all pairs of errors were looked at: no figures");
    }
    memset(developing->errors, 0, problem->error_count * sizeof(double));
    if (problem->error_count > 0) {
        developing->errors[i] = developing->errors[j] = size;
    }
    if (!problem->trial(problem->context, developing->errors, figures, developing->error)) {
        return i == j ? error_prefix(developing->error,
                                     "%s of %g times its tolerance: ", problem->names[i], size)
                      : error_prefix(developing->error,
                                     "%s and %s of %g times their tolerances: ", problem->names[i],
                                     problem->names[j], size);
    }
    for (size_t f = 0; f < problem->figure_count; f++) {
        figures[f] *= problem->is_root[f] ? figures[f] : 1;
    }
    return true;
}

static bool develop(const struct expansion *developing, struct second_order_form *forms)
{
    if (!second_order_look(developing, 0, 0, 0, developing->middle)) {
        return false;
    }
    for (size_t f = 0; f < developing->problem->figure_count; f++) {
        forms[f].value = developing->middle[f];
    }
    for (size_t i = 0; i < developing->problem->error_count; i++) {
        const size_t figures = developing->problem->figure_count,
                     n = developing->problem->error_count;
        double *above = developing->above + i * figures, *below = developing->below + i * figures;
        if (!second_order_look(developing, i, i, step, above) ||
            !second_order_look(developing, i, i, -step, below) ||
            !second_order_look(developing, i, i, 2 * step, developing->up) ||
            !second_order_look(developing, i, i, -2 * step, developing->down)) {
            return false;
        }
        for (size_t f = 0; f < figures; f++) {
            forms[f].slope[i] =
                (8 * (above[f] - below[f]) - (developing->up[f] - developing->down[f])) /
                (12 * step);
            forms[f].curve[i * n + i] =
                (above[f] + below[f] - 2 * developing->middle[f]) / (step * step);
        }
        for (size_t j = 0; j < i; j++) {
            if (!second_order_look(developing, i, j, step, developing->up) ||
                !second_order_look(developing, i, j, -step, developing->down)) {
                return false;
            }
            for (size_t f = 0; f < figures; f++) {
                const size_t b = j * figures + f;
                const double one = above[f] + below[f];
                const double other = developing->above[b] + developing->below[b];
                const double bend = developing->up[f] + developing->down[f] - one - other +
                                    2 * developing->middle[f];
                forms[f].curve[i * n + j] = forms[f].curve[j * n + i] = bend / (2 * step * step);
            }
        }
    }
    return true;
}

/* -------- trials -------- */

/* Row after row: slope i, then what p_0 .. p_i are multiplied with. */
static size_t rows_size(size_t n)
{
    return n + n * (n + 1) / 2;
}

bool second_order_open(const struct second_order_problem *problem, struct arena *arena,
                       struct second_order *differential, struct error *error)
{
    const size_t n = problem->error_count, figures = problem->figure_count;
    const struct expansion developing = {.problem = problem,
                                         .errors = ARENA_ARRAY(arena, n + 1, double),
                                         .middle = ARENA_ARRAY(arena, figures, double),
                                         .above = ARENA_ARRAY(arena, n * figures, double),
                                         .below = ARENA_ARRAY(arena, n * figures, double),
                                         .up = ARENA_ARRAY(arena, figures, double),
                                         .down = ARENA_ARRAY(arena, figures, double),
                                         .error = error};
    *differential =
        (struct second_order){.error_count = n,
                              .figure_count = figures,
                              .judged_count = problem->judged_count,
                              .is_root = problem->is_root,
                              .forms = ARENA_ARRAY(arena, figures, struct second_order_form),
                              .rows = ARENA_ARRAY(arena, figures * rows_size(n), double)};
    for (size_t f = 0; f < figures; f++) {
        differential->forms[f].slope = ARENA_ARRAY(arena, n, double);
        differential->forms[f].curve = ARENA_ARRAY(arena, n * n, double);
    }
    if (!develop(&developing, differential->forms)) {
        return false;
    }
    double *row = differential->rows;
    for (size_t f = 0; f < figures; f++) {
        const struct second_order_form *form = &differential->forms[f];
        for (size_t i = 0; i < n; i++) {
            *row++ = form->slope[i];
            for (size_t j = 0; j <= i; j++) {
                *row++ = form->curve[i * n + j] * (j == i ? 0.5 : 1);
            }
        }
    }
    return true;
}

void second_order_trials(const struct second_order *differential, const double *errors,
                         double *figures)
{
    kernel_differential *kernel = KERNEL_FOR(SET_BEST, kernel_differential);
    const size_t n = differential->error_count;
    for (size_t f = 0; f < differential->figure_count; f++) {
        double *to = figures + f * SECOND_ORDER_LANES;
        for (size_t l = 0; l < SECOND_ORDER_LANES; l++) {
            to[l] = differential->forms[f].value;
        }
        kernel(differential->rows + f * rows_size(n), n, errors, to);
        for (size_t l = 0; l < SECOND_ORDER_LANES && differential->is_root[f]; l++) {
            to[l] = sqrt(to[l] > 0 ? to[l] : 0);
        }
    }
}

/* -------- who makes it spread -------- */

/* The coefficient of a form, or its mean over all. */
static double second_order_mean_of(const struct second_order *differential, size_t figure, size_t i,
                                   size_t j)
{
    const size_t n = differential->error_count, all = differential->judged_count;
    const size_t first = figure == LENS_NONE ? 0 : figure;
    const size_t end = figure == LENS_NONE ? all : figure + 1;
    double sum = 0;
    for (size_t f = first; f < end; f++) {
        const struct second_order_form *form = &differential->forms[f];
        sum += j == LENS_NONE ? form->slope[i] : form->curve[i * n + j];
    }
    return sum / (double)(end - first);
}

double second_order_shares(const struct second_order *differential,
                           const struct perturbation_moments *moments, size_t figure,
                           struct second_order_share *shares)
{
    const size_t n = differential->error_count;
    double variance = 0;
    memset(shares, 0, n * sizeof *shares);
    for (size_t i = 0; i < n; i++) {
        const double v = moments[i].second, w = moments[i].fourth;
        const double slope = second_order_mean_of(differential, figure, i, LENS_NONE);
        const double curve = second_order_mean_of(differential, figure, i, i);
        shares[i].first = slope * slope * v + curve * curve * (w - v * v) / 4;
        shares[i].total += shares[i].first;
        variance += shares[i].first;
        for (size_t j = 0; j < i; j++) {
            const double cross = second_order_mean_of(differential, figure, i, j);
            const double both = cross * cross * v * moments[j].second;
            shares[i].total += both;
            shares[j].total += both;
            variance += both;
        }
    }
    for (size_t i = 0; i < n && variance > 0; i++) {
        shares[i].first /= variance;
        shares[i].total /= variance;
    }
    return sqrt(variance);
}
