/* design/solver/solver_sided.c - residuals that count on one side of 0 only, within a step. */
/* SPDX-License-Identifier: MIT */
#include "design/solver/solver_sided.h"

#include "design/solver/solver_loss.h"

#include <string.h>

void solver_sided_open(const struct solver_problem *problem, struct arena *arena,
                       struct solver_sided *sided)
{
    const size_t n = problem->parameter_count, m = problem->residual_count;
    *sided = (struct solver_sided){.sides = problem->sides, .columns = n};
    for (size_t i = 0; i < m && problem->sides != NULL; i++) {
        sided->count += problem->sides[i] != SIDE_BOTH;
    }
    if (sided->count == 0) {
        return;
    }
    sided->at = ARENA_ARRAY(arena, sided->count, size_t);
    sided->slopes = ARENA_ARRAY(arena, sided->count * n, double);
    sided->counts = ARENA_ARRAY(arena, sided->count, bool);
    sided->carried = ARENA_ARRAY(arena, sided->count, double);
    sided->along = ARENA_ARRAY(arena, sided->count, double);
    sided->from = ARENA_ARRAY(arena, n, double);
    sided->h = ARENA_ARRAY(arena, n * n, double);
    sided->g = ARENA_ARRAY(arena, n, double);
    for (size_t i = 0, k = 0; i < m; i++) {
        if (problem->sides[i] != SIDE_BOTH) {
            sided->at[k++] = i;
        }
    }
}

void solver_sided_set(struct solver_sided *sided, const double *jacobian)
{
    const size_t n = sided->columns;
    for (size_t k = 0; k < sided->count; k++) {
        memcpy(sided->slopes + k * n, jacobian + sided->at[k] * n, n * sizeof *jacobian);
    }
}

static double counted(const struct solver_sided *sided, size_t k, double residual)
{
    return solver_counted(sided->sides, sided->at[k], residual);
}

/* Where the step leads. */
static double carried(const struct solver_sided *sided, size_t k, const double *residuals,
                      const double *d)
{
    double there = residuals[sided->at[k]];
    for (size_t j = 0; j < sided->columns; j++) {
        there += sided->slopes[k * sided->columns + j] * d[j];
    }
    return there;
}

void solver_sided_pull(const struct solver_sided *sided, const double *residuals, double *gradient)
{
    for (size_t k = 0; k < sided->count; k++) {
        const double r = counted(sided, k, residuals[sided->at[k]]);
        for (size_t j = 0; j < sided->columns && r != 0; j++) {
            gradient[j] += r * sided->slopes[k * sided->columns + j];
        }
    }
}

double solver_sided_gain(const struct solver_sided *sided, const double *residuals, const double *d)
{
    double sum = 0;
    for (size_t k = 0; k < sided->count; k++) {
        const double here = counted(sided, k, residuals[sided->at[k]]);
        const double there = counted(sided, k, carried(sided, k, residuals, d));
        sum += (here * here - there * there) / 2;
    }
    return sum;
}

/* One step, with those that count. */
static bool sided_bound_find(struct solver_sided *sided, const double *residuals, const double *h,
                             const double *g, struct solver_step *step)
{
    const size_t n = sided->columns;
    memcpy(sided->h, h, n * n * sizeof *h);
    memcpy(sided->g, g, n * sizeof *g);
    for (size_t k = 0; k < sided->count; k++) {
        const double *row = sided->slopes + k * n;
        for (size_t i = 0; i < n && sided->counts[k]; i++) {
            sided->g[i] += residuals[sided->at[k]] * row[i];
            for (size_t j = 0; j < n && row[i] != 0; j++) { /* most know few parameters */
                sided->h[i * n + j] += row[i] * row[j];
            }
        }
    }
    step->h = sided->h;
    step->g = sided->g;
    return solver_step_find(step);
}

/* Who counts where d leads. Result: are they others than before? */
static bool solver_sided_choose(struct solver_sided *sided, const double *residuals,
                                const double *d)
{
    bool changed = false;
    for (size_t k = 0; k < sided->count; k++) {
        const bool counts = counted(sided, k, carried(sided, k, residuals, d)) != 0;
        changed = changed || counts != sided->counts[k];
        sided->counts[k] = counts;
    }
    return changed;
}

/* Slope of the whole along the way from one step to another, a share of it on. */
struct solver_sided_way {
    double slope, bend; /* of the quadratic form */
};

static double solver_sided_slope_at(const struct solver_sided *sided,
                                    const struct solver_sided_way *way, double share)
{
    double sum = way->slope + share * way->bend;
    for (size_t k = 0; k < sided->count; k++) {
        sum += sided->along[k] * counted(sided, k, sided->carried[k] + share * sided->along[k]);
    }
    return sum;
}

/* The share of the way from `from` to `to` where the whole is smallest. */
static double find_share(struct solver_sided *sided, const double *residuals, const double *h,
                         const double *g, const double *to)
{
    const size_t n = sided->columns;
    const double *from = sided->from;
    struct solver_sided_way way = {0, 0};
    for (size_t i = 0; i < n; i++) {
        double at = g[i], on = 0;
        for (size_t j = 0; j < n; j++) {
            at += h[i * n + j] * from[j];
            on += h[i * n + j] * (to[j] - from[j]);
        }
        way.slope += (to[i] - from[i]) * at;
        way.bend += (to[i] - from[i]) * on;
    }
    for (size_t k = 0; k < sided->count; k++) {
        sided->carried[k] = carried(sided, k, residuals, from);
        sided->along[k] = carried(sided, k, residuals, to) - sided->carried[k];
    }
    double low = 0, high = 1;
    for (int i = 0; i < 50 && solver_sided_slope_at(sided, &way, 1) > 0; i++) {
        const double middle = (low + high) / 2;
        if (solver_sided_slope_at(sided, &way, middle) > 0) {
            high = middle;
        } else {
            low = middle;
        }
    }
    return high;
}

/* Not so far; who is on its bound follows. */
static void solver_sided_cut(const struct solver_sided *sided, double share,
                             struct solver_step *step)
{
    for (size_t i = 0; i < sided->columns; i++) {
        const double d = sided->from[i] + share * (step->d[i] - sided->from[i]);
        step->d[i] = d;
        if (d <= step->low[i]) {
            step->side[i] = STEP_AT_LOW;
        } else if (d >= step->high[i]) {
            step->side[i] = STEP_AT_HIGH;
        } else {
            step->side[i] = STEP_FREE;
        }
    }
}

bool solver_sided_find(struct solver_sided *sided, const double *residuals, const double *h,
                       const double *g, struct solver_step *step)
{
    enum { ROUNDS = 60 };
    if (sided->count == 0) {
        step->h = h;
        step->g = g;
        return solver_step_find(step);
    }
    memset(sided->from, 0, sided->columns * sizeof(double));
    solver_sided_choose(sided, residuals, sided->from);
    for (int round = 0; round < ROUNDS; round++) {
        if (!sided_bound_find(sided, residuals, h, g, step)) {
            return false;
        }
        /* the first step meets conditions, which no step need do that lies before it */
        const double share = round > 0 ? find_share(sided, residuals, h, g, step->d) : 1;
        if (share < 1) {
            solver_sided_cut(sided, share, step);
        }
        if (!solver_sided_choose(sided, residuals, step->d) && !(share < 1)) {
            break;
        }
        memcpy(sided->from, step->d, sided->columns * sizeof(double));
    }
    return true;
}
