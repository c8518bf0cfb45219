/* design/solver/solver_descent.c - what a descent knows where it stands. */
/* SPDX-License-Identifier: MIT */
#include "design/solver/solver_descent.h"

#include "design/solver/solver_loss.h"
#include "design/solver/solver_normal.h"

#include <string.h>

/*
 * Second-order damping: the damping of a parameter follows the second derivatives of the residuals
 * by it, as the change of the gradient tells that the normal equations do not explain; a share of
 * each step's goes into the mean. At first all are alike in natural scales.
 */
static const double newest = 0.2, first_diagonal = 3e-4, first_damping = 1e-5;

/* Of parameters without scales, which are damped as their derivatives are large. */
static const double plain_damping = 1e-3;

/* A parameter that moved less than this share of the one that moved most tells little. */
static const double least_move = 0.01;

bool descent_measure(struct descent *descent, struct place *place, double *jacobian)
{
    const struct solver_problem *problem = descent->problem;
    descent->run->evaluations++;
    descent->run->derivatives += jacobian != NULL;
    place->cost = place->excess = NAN;
    if (!problem->evaluate(problem->context, place->parameters, place->residuals, jacobian)) {
        return false;
    }
    place->cost =
        solver_cost(problem, place->residuals, jacobian != NULL ? descent->weights : NULL);
    for (size_t k = 0; k < descent->sided.count && jacobian != NULL; k++) {
        descent->weights[descent->sided.at[k]] = 0; /* they are added by themselves */
    }
    place->excess = 0;
    for (size_t i = 0; i < descent->exact; i++) {
        place->excess += fabs(place->residuals[descent->squares + i]);
    }
    return isfinite(place->cost) && isfinite(place->excess);
}

double descent_height(const struct descent *descent, const struct place *place)
{
    return place->cost + descent->price * (place->excess > DESCENT_MET ? place->excess : 0);
}

/* Derivatives here times residuals there. */
static struct solver_rows solver_descent_rows_of(const struct descent *descent,
                                                 const double *residuals)
{
    return (struct solver_rows){
        .rows = descent->squares,
        .columns = descent->n,
        .jacobian = descent->jacobian,
        .residuals = residuals,
        .room = descent->room,
        .weights =
            descent->problem->blocks != NULL || descent->sided.count > 0 ? descent->weights : NULL};
}

/* Without natural scales a parameter is measured by the largest effect that it had so far. */
static void set_scales(struct descent *descent)
{
    const size_t n = descent->n;
    for (size_t i = 0; i < n && descent->problem->scale == NULL; i++) {
        const double effect = sqrt(descent->normal[i * n + i]);
        if (effect > 0 && !(descent->scale[i] <= 1 / effect)) {
            descent->scale[i] = 1 / effect;
        }
    }
}

void descent_set_equations(struct descent *descent)
{
    const size_t n = descent->n;
    const struct solver_rows rows = solver_descent_rows_of(descent, descent->here.residuals);
    solver_normal(&rows, descent->normal, descent->rest);
    set_scales(descent);
    solver_sided_set(&descent->sided, descent->jacobian);
    for (size_t i = 0; i < descent->sided.count * n; i++) {
        descent->sided.slopes[i] *= descent_scale(descent, i % n);
    }
    for (size_t i = 0; i < n; i++) {
        descent->rest[i] *= descent_scale(descent, i);
        for (size_t j = 0; j < n; j++) {
            descent->normal[i * n + j] *= descent_scale(descent, i) * descent_scale(descent, j);
        }
    }
    memcpy(descent->gradient, descent->rest, n * sizeof(double));
    solver_sided_pull(&descent->sided, descent->here.residuals, descent->gradient);
    for (size_t r = 0; r < descent->exact; r++) {
        for (size_t j = 0; j < n; j++) {
            descent->slopes[r * n + j] =
                descent->jacobian[(descent->squares + r) * n + j] * descent_scale(descent, j);
        }
    }
}

/* The pull of the exact residuals, by their multipliers, on top of a gradient. */
static void add_pull(const struct descent *descent, double *gradient)
{
    for (size_t i = 0; i < descent->n; i++) {
        for (size_t r = 0; r < descent->exact; r++) {
            gradient[i] += descent->step.multipliers[r] * descent->slopes[r * descent->n + i];
        }
    }
}

void descent_carry(const struct descent *descent, const double *residuals, double *into)
{
    const struct solver_rows rows = solver_descent_rows_of(descent, residuals);
    solver_normal(&rows, NULL, into);
    for (size_t i = 0; i < descent->n; i++) {
        into[i] *= descent_scale(descent, i);
    }
    solver_sided_pull(&descent->sided, residuals, into);
    add_pull(descent, into);
}

void descent_learn(struct descent *descent, const double *explained, const double *from)
{
    double most = 0;
    for (size_t i = 0; i < descent->n; i++) {
        descent->move[i] = (descent->here.parameters[i] - from[i]) / descent_scale(descent, i);
        most = fmax(most, fabs(descent->move[i]));
    }
    const double little = least_move * most;
    memcpy(descent->none, descent->gradient, descent->n * sizeof(double));
    add_pull(descent, descent->none);
    for (size_t i = 0; i < descent->n; i++) {
        const double moved = descent->move[i], change = descent->none[i] - explained[i];
        const double second = fabs(change * moved) / (moved * moved + little * little);
        if (isfinite(second)) {
            descent->diagonal[i] += newest * (second - descent->diagonal[i]);
        }
    }
    memset(descent->none, 0, descent->n * sizeof(double));
}

void descent_open(struct descent *descent, struct arena *arena)
{
    const size_t n = descent->n, m = descent->squares + descent->exact;
    struct place *places[2] = {&descent->here, &descent->there};
    for (int i = 0; i < 2; i++) {
        places[i]->parameters = ARENA_ARRAY(arena, n, double);
        places[i]->residuals = ARENA_ARRAY(arena, m + 1, double);
    }
    descent->jacobian = ARENA_ARRAY(arena, m * n, double);
    descent->weights = ARENA_ARRAY(arena, m + 1, double);
    descent->scale = ARENA_ARRAY(arena, n, double);
    descent->normal = ARENA_ARRAY(arena, n * n, double);
    descent->damped = ARENA_ARRAY(arena, n * n, double);
    descent->slopes = ARENA_ARRAY(arena, descent->exact * n + 1, double);
    double **const each[] = {&descent->rest, &descent->gradient, &descent->diagonal, &descent->low,
                             &descent->high, &descent->none,     &descent->before};
    for (size_t i = 0; i < sizeof each / sizeof each[0]; i++) {
        *each[i] = ARENA_ARRAY(arena, n, double);
    }
    descent->move = ARENA_ARRAY(arena, n + descent->exact, double);
    descent->wanted = ARENA_ARRAY(arena, descent->exact + 1, double);
    descent->second = ARENA_ARRAY(arena, m + 1, double);
    descent->straight = ARENA_ARRAY(arena, n, double);
    descent->sides = ARENA_ARRAY(arena, n, enum step_side);
    solver_sided_open(descent->problem, arena, &descent->sided);
    descent->room = solver_normal_room(n, arena);
    solver_step_open(&descent->step, n, descent->exact, arena);
    descent->step.low = descent->low;
    descent->step.high = descent->high;
    descent->step.slopes = descent->slopes;
}

void descent_begin(struct descent *descent)
{
    const bool learns = descent->problem->scale != NULL;
    double most = 0;
    for (size_t i = 0; i < descent->n; i++) {
        most = fmax(most, descent->normal[i * descent->n + i]);
    }
    most = most > 0 ? most : 1;
    const double diagonal = learns ? first_diagonal : 1;
    for (size_t i = 0; i < descent->n; i++) {
        descent->diagonal[i] = diagonal * most;
    }
    descent->damping = (learns ? first_damping : plain_damping) / diagonal;
    descent->growth = 2;
    descent->share = 1;
}
