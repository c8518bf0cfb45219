/* design/optimize_descend.c - down to where no step gains. */
/* SPDX-License-Identifier: MIT */
#include "design/optimize_descend.h"

#include "design/solver/solver_loss.h"
#include "design/solver/solver_step.h"

#include <math.h>
#include <string.h>

enum {
    ROUNDS = 12, /* descents, the first among them */
    SHORTER = 9  /* lengths that a step is tried at, each a quarter of the one before */
};

/* Of the merit: steps that promise less, or gain less, are none. */
static const double worth = 1e-6;

/* Of the merit at the start: what is left is rounding. */
static const double nothing = 1e-20;

/* Of the damped step of all variables, against the largest effect of one by its scale. */
static const double damping = 1e-5;

/* What the merit has where a descent ended. */
struct descent_end {
    const struct optimize_descent *descent;
    struct solver_problem problem;
    double *numbers;
    double merit;
    double *gradient, *normal; /* by variables in their scales; n x n */
    double *low, *high;        /* steps that bounds leave */
    double *d, *there, *residuals;
    struct solver_step step;
    struct merit_limit limit; /* what kept a step from being tried */
};

static double sum_of_squares(const struct merit *merit, const double *residuals)
{
    double sum = 0;
    for (size_t i = 0; i < merit->residual_count - merit->exact_count; i++) {
        const double r = solver_counted(merit->sides, i, residuals[i]);
        sum += r * r;
    }
    return sum;
}

/* The merit of numbers; NaN: there is none. */
static double merit_at(struct merit *merit, const double *numbers, double *residuals)
{
    return merit_measure(merit, numbers, residuals, NULL) ? sum_of_squares(merit, residuals) : NAN;
}

static struct descent_end descent_end_open(const struct optimize_descent *descent, double *numbers)
{
    struct merit *merit = descent->merit;
    struct arena *arena = descent->arena;
    const size_t n = merit->variable_count;
    struct descent_end end = {.descent = descent,
                              .problem = *descent->problem,
                              .numbers = numbers,
                              .gradient = ARENA_ARRAY(arena, n, double),
                              .normal = ARENA_ARRAY(arena, n * n, double),
                              .low = ARENA_ARRAY(arena, n, double),
                              .high = ARENA_ARRAY(arena, n, double),
                              .d = ARENA_ARRAY(arena, n, double),
                              .there = ARENA_ARRAY(arena, n, double),
                              .residuals = ARENA_ARRAY(arena, merit->residual_count + 1, double)};
    solver_step_open(&end.step, n, 0, arena);
    end.step.h = end.normal;
    end.step.g = end.gradient;
    end.step.low = end.low;
    end.step.high = end.high;
    end.step.d = end.d;
    end.step.side = ARENA_ARRAY(arena, n, enum step_side);
    return end;
}

/* From residuals and derivatives, as a solver leaves them. */
static void descent_end_look(struct descent_end *end, const struct solver_summary *summary)
{
    const struct merit *merit = end->descent->merit;
    const size_t n = merit->variable_count;
    const double *scale = end->problem.scale;
    memset(end->gradient, 0, n * sizeof(double));
    memset(end->normal, 0, n * n * sizeof(double));
    end->merit = sum_of_squares(merit, summary->residuals);
    for (size_t i = 0; i < merit->residual_count - merit->exact_count; i++) {
        const double *row = summary->jacobian + i * n;
        const double r = solver_counted(merit->sides, i, summary->residuals[i]);
        if (r == 0 && merit->sides[i] != SIDE_BOTH) {
            continue;
        }
        for (size_t j = 0; j < n; j++) {
            end->gradient[j] += r * row[j] * scale[j];
            for (size_t k = 0; k <= j; k++) {
                end->normal[j * n + k] += row[j] * scale[j] * row[k] * scale[k];
            }
        }
    }
    double most = 0;
    for (size_t j = 0; j < n; j++) {
        for (size_t k = 0; k < j; k++) {
            end->normal[k * n + j] = end->normal[j * n + k];
        }
        most = fmax(most, end->normal[j * n + j]);
        end->low[j] = (end->problem.low[j] - end->numbers[j]) / scale[j];
        end->high[j] = (end->problem.high[j] - end->numbers[j]) / scale[j];
    }
    for (size_t j = 0; j < n; j++) {
        end->normal[j * n + j] += damping * (most > 0 ? most : 1);
    }
}

/* What the step d takes off the merit, as far as derivatives tell. */
static double descent_end_promise(const struct descent_end *end)
{
    const size_t n = end->descent->merit->variable_count;
    double sum = 0;
    for (size_t i = 0; i < n; i++) {
        double slope = end->gradient[i];
        for (size_t j = 0; j < n && end->d[i] != 0; j++) {
            slope += end->normal[i * n + j] * end->d[j] / 2;
        }
        sum -= 2 * end->d[i] * slope;
    }
    return sum;
}

/* Go along d as far as it gains. Result: did it? */
static bool descent_end_try(struct descent_end *end, struct solver_summary *summary)
{
    struct merit *merit = end->descent->merit;
    const size_t n = merit->variable_count;
    double share = 1;
    if (!(descent_end_promise(end) > worth * end->merit)) {
        return false;
    }
    for (int i = 0; i < SHORTER; i++, share /= 4) {
        for (size_t j = 0; j < n; j++) {
            const double to = end->numbers[j] + share * end->d[j] * end->problem.scale[j];
            end->there[j] = fmin(fmax(to, end->problem.low[j]), end->problem.high[j]);
        }
        const double reached = merit_at(merit, end->there, end->residuals);
        summary->evaluations++;
        if (isnan(reached) && merit->limit->is_known) {
            end->limit = *merit->limit;
        }
        if (end->merit - reached > worth * end->merit) {
            memcpy(end->numbers, end->there, n * sizeof(double));
            end->merit = reached;
            return true;
        }
    }
    return false;
}

/* All variables at once, then each by itself. Result: does any step gain? */
static bool descent_end_gains(struct descent_end *end, struct solver_summary *summary)
{
    const size_t n = end->descent->merit->variable_count;
    end->limit.is_known = false;
    if (solver_step_find(&end->step) && descent_end_try(end, summary)) {
        return true;
    }
    for (size_t j = 0; j < n; j++) {
        const double step = -end->gradient[j] / end->normal[j * n + j];
        memset(end->d, 0, n * sizeof(double));
        end->d[j] = fmin(fmax(step, end->low[j]), end->high[j]);
        if (descent_end_try(end, summary)) {
            return true;
        }
    }
    return false;
}

/* One descent more; what it costs is added to the others. */
static bool descend_once(struct descent_end *end, struct solver_summary *summary, bool is_first,
                         struct error *error)
{
    const struct optimize_descent *descent = end->descent;
    struct solver_options options = descent->options;
    const struct solver_summary before = *summary;
    if (!is_first) {
        options.iterations -= (int)before.iterations;
    }
    if (!solver_run(&end->problem, &options, end->numbers, descent->arena, summary, error)) {
        return false;
    }
    if (!is_first) {
        summary->initial_cost = before.initial_cost;
        summary->iterations += before.iterations;
        summary->evaluations += before.evaluations;
        summary->derivatives += before.derivatives;
    }
    return true;
}

bool optimize_descend(const struct optimize_descent *descent, double *numbers,
                      struct solver_summary *summary, struct merit_limit *limit,
                      struct error *error)
{
    struct descent_end end = descent_end_open(descent, numbers);
    *limit = (struct merit_limit){.is_known = false};
    for (int round = 0; round < ROUNDS; round++) {
        if (!descend_once(&end, summary, round == 0, error)) {
            return false;
        }
        if ((summary->status != SOLVER_CONVERGED && summary->status != SOLVER_STUCK) ||
            descent->merit->exact_count > 0 || descent->problem->parameter_count == 0 ||
            summary->iterations >= descent->options.iterations) {
            return true;
        }
        descent_end_look(&end, summary);
        if (end.merit <= nothing * 2 * summary->initial_cost) {
            return true;
        }
        if (!descent_end_gains(&end, summary)) {
            *limit = end.limit;
            return true;
        }
    }
    return true;
}
