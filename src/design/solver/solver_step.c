/* design/solver/solver_step.c - a step that stays inside bounds and keeps conditions. */
/* SPDX-License-Identifier: MIT */
#include "design/solver/solver_step.h"

#include "base/cholesky.h"
#include "design/solver/solver_loss.h"

#include <math.h>
#include <string.h>

/* The parameters that are free, and the system of them. */
struct step_system {
    size_t count;
    size_t *places;
    enum step_side *wanted;
    double *l;     /* count x count: factor of H */
    double *half;  /* exact x count: L^-1 of each condition's slopes */
    double *inner; /* exact x exact: factor of A H^-1 A^T */
    double *right; /* count */
    double *miss;  /* exact */
};

void solver_step_open(struct solver_step *step, size_t count, size_t exact, struct arena *arena)
{
    struct step_system *system = ARENA_NEW(arena, struct step_system);
    step->count = count;
    step->exact = exact;
    step->side = ARENA_ARRAY(arena, count, enum step_side);
    step->d = ARENA_ARRAY(arena, count, double);
    step->multipliers = ARENA_ARRAY(arena, exact + 1, double);
    step->system = system;
    system->places = ARENA_ARRAY(arena, count, size_t);
    system->wanted = ARENA_ARRAY(arena, count, enum step_side);
    system->l = ARENA_ARRAY(arena, count * count, double);
    system->half = ARENA_ARRAY(arena, exact * count + 1, double);
    system->inner = ARENA_ARRAY(arena, exact * exact + 1, double);
    system->right = ARENA_ARRAY(arena, count, double);
    system->miss = ARENA_ARRAY(arena, exact + 1, double);
}

static bool factor_conditions(const struct solver_step *step)
{
    const struct step_system *system = step->system;
    const size_t e = step->exact, k = system->count;
    double trace = 0;
    for (size_t r = 0; r < e; r++) {
        double *row = system->half + r * k;
        for (size_t i = 0; i < k; i++) {
            row[i] = step->slopes[r * step->count + system->places[i]];
        }
        cholesky_forward(system->l, k, row);
        for (size_t q = 0; q <= r; q++) {
            double sum = 0;
            for (size_t i = 0; i < k; i++) {
                sum += row[i] * system->half[q * k + i];
            }
            system->inner[r * e + q] = sum;
        }
        trace += system->inner[r * e + r];
    }
    for (size_t r = 0; r < e; r++) {
        /* conditions that say the same do not stop the solution */
        system->inner[r * e + r] += 1e-13 * trace + 1e-300;
    }
    return cholesky_factor(system->inner, e);
}

/* Slope of the quadratic form where d is. */
static double solver_step_slope_at(const struct solver_step *step, size_t i)
{
    double sum = step->g[i];
    for (size_t j = 0; j < step->count; j++) {
        sum += step->h[i * step->count + j] * step->d[j];
    }
    return sum;
}

/* Move what is free so that the conditions are met, the quadratic form rising least. */
static void meet_conditions(struct solver_step *step)
{
    const struct step_system *system = step->system;
    const size_t e = step->exact, k = system->count;
    /* How far the conditions are from being met at d. */
    for (size_t r = 0; r < step->exact; r++) {
        system->miss[r] = step->excess[r];
        for (size_t j = 0; j < step->count; j++) {
            system->miss[r] += step->slopes[r * step->count + j] * step->d[j];
        }
    }
    cholesky_forward(system->inner, e, system->miss);
    cholesky_backward(system->inner, e, system->miss);
    for (size_t i = 0; i < k; i++) {
        system->right[i] = 0;
    }
    for (size_t r = 0; r < e; r++) {
        step->multipliers[r] += system->miss[r];
        for (size_t i = 0; i < k; i++) {
            system->right[i] -= system->miss[r] * system->half[r * k + i];
        }
    }
    cholesky_backward(system->l, k, system->right);
    for (size_t i = 0; i < k; i++) {
        step->d[system->places[i]] += system->right[i];
    }
}

/* d of the free parameters, with the others where they are held. */
static bool solve_free(struct solver_step *step)
{
    const struct step_system *system = step->system;
    const size_t k = system->count;
    for (size_t i = 0; i < k; i++) {
        const double *row = step->h + system->places[i] * step->count;
        for (size_t j = 0; j <= i; j++) {
            system->l[i * k + j] = row[system->places[j]];
        }
    }
    if (!cholesky_factor(system->l, k) || !factor_conditions(step)) {
        return false;
    }
    for (size_t i = 0; i < k; i++) {
        step->d[system->places[i]] = 0;
    }
    for (size_t i = 0; i < k; i++) {
        system->right[i] = -solver_step_slope_at(step, system->places[i]);
    }
    cholesky_forward(system->l, k, system->right);
    cholesky_backward(system->l, k, system->right);
    for (size_t i = 0; i < k; i++) {
        step->d[system->places[i]] = system->right[i];
    }
    memset(step->multipliers, 0, step->exact * sizeof *step->multipliers);
    for (int again = 0; step->exact > 0 && again < 2; again++) {
        meet_conditions(step);
    }
    return true;
}

/* Change sides: of all that are wrong, or of the last. Result: was any? */
static bool change_sides(struct solver_step *step, bool all)
{
    enum step_side *wanted = step->system->wanted;
    bool changed = false;
    for (size_t i = 0; i < step->count; i++) {
        const double d = step->d[i], low = step->low[i], high = step->high[i];
        wanted[i] = step->side[i];
        if (step->side[i] == STEP_FREE) {
            wanted[i] = d > high ? STEP_AT_HIGH : STEP_FREE;
            wanted[i] = d < low ? STEP_AT_LOW : wanted[i];
        } else if (low < high) {
            double slope = solver_step_slope_at(step, i);
            for (size_t r = 0; r < step->exact; r++) {
                slope += step->multipliers[r] * step->slopes[r * step->count + i];
            }
            const bool is_pushed = step->side[i] == STEP_AT_LOW ? slope >= 0 : slope <= 0;
            wanted[i] = is_pushed ? step->side[i] : STEP_FREE;
        }
    }
    for (size_t i = step->count; i-- > 0 && (all || !changed);) {
        changed = changed || wanted[i] != step->side[i];
        step->side[i] = wanted[i];
    }
    return changed;
}

bool solver_step_find(struct solver_step *step)
{
    const int limit = 10 * (int)step->count + 20;
    for (int round = 0; round < limit; round++) {
        /* Who is free; the others lie at their bounds. */
        struct step_system *system = step->system;
        system->count = 0;
        for (size_t i = 0; i < step->count; i++) {
            if (step->side[i] == STEP_FREE) {
                system->places[system->count++] = i;
            } else {
                step->d[i] = step->side[i] == STEP_AT_LOW ? step->low[i] : step->high[i];
            }
        }
        if (!solve_free(step)) {
            return false;
        }
        if (!change_sides(step, round < 10)) {
            break;
        }
    }
    for (size_t i = 0; i < step->count; i++) {
        step->d[i] = fmin(fmax(step->d[i], step->low[i]), step->high[i]);
    }
    return true;
}

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

/* Slope of the whole along the way from one step to another, a share of it on; slope and bend are
   those of the quadratic form. */
static double slope_along(const struct solver_sided *sided, double slope, double bend, double share)
{
    double sum = slope + share * bend;
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
    double slope = 0, bend = 0, low = 0, high = 1;
    for (size_t i = 0; i < n; i++) {
        double at = g[i], on = 0;
        for (size_t j = 0; j < n; j++) {
            at += h[i * n + j] * from[j];
            on += h[i * n + j] * (to[j] - from[j]);
        }
        slope += (to[i] - from[i]) * at;
        bend += (to[i] - from[i]) * on;
    }
    for (size_t k = 0; k < sided->count; k++) {
        sided->carried[k] = carried(sided, k, residuals, from);
        sided->along[k] = carried(sided, k, residuals, to) - sided->carried[k];
    }
    for (int i = 0; i < 50 && slope_along(sided, slope, bend, 1) > 0; i++) {
        const double middle = (low + high) / 2;
        if (slope_along(sided, slope, bend, middle) > 0) {
            high = middle;
        } else {
            low = middle;
        }
    }
    return high;
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
        /* One step, with those that count. */
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
        if (!solver_step_find(step)) {
            return false;
        }
        /* the first step meets conditions, which no step need do that lies before it */
        const double share = round > 0 ? find_share(sided, residuals, h, g, step->d) : 1;
        for (size_t i = 0; i < n && share < 1; i++) { /* not so far; who is on its bound follows */
            const double d = sided->from[i] + share * (step->d[i] - sided->from[i]);
            step->d[i] = d;
            step->side[i] = d >= step->high[i] ? STEP_AT_HIGH : STEP_FREE;
            step->side[i] = d <= step->low[i] ? STEP_AT_LOW : step->side[i];
        }
        if (!solver_sided_choose(sided, residuals, step->d) && !(share < 1)) {
            break;
        }
        memcpy(sided->from, step->d, sided->columns * sizeof(double));
    }
    return true;
}
