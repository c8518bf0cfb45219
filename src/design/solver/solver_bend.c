/* design/solver/solver_bend.c - steps of a descent that follow a curved valley. */
/* SPDX-License-Identifier: MIT */
#include "design/solver/solver_descent.h"

#include <string.h>

/* A share of the step, behind which the second derivative along it is looked for. */
static const double probe = 0.1;

/* What the step may bend by, of its own length. */
static const double most_bend = 0.75;

/* r'' along the step d, from r there: 2/h ((r(h d) - r)/h - J d). */
static void find_second(struct descent *descent, const double *d)
{
    const size_t n = descent->n;
    for (size_t k = 0; k < descent->squares; k++) {
        const double *row = descent->jacobian + k * n;
        double along = 0;
        for (size_t j = 0; j < n; j++) {
            along += row[j] * descent_scale(descent, j) * d[j];
        }
        const double change = descent->there.residuals[k] - descent->here.residuals[k];
        descent->second[k] = 2 / probe * (change / probe - along);
    }
    for (size_t k = 0; k < descent->sided.count; k++) {
        descent->second[descent->sided.at[k]] = 0; /* straight, as far as the step goes */
    }
}

/* The bend a with bounds that leave d + a/2 within those of d; who is on a bound stays there. */
static bool find_bend(struct descent *descent, const double *d)
{
    struct solver_step *step = &descent->step;
    for (size_t i = 0; i < descent->n; i++) {
        const bool is_held = step->side[i] != STEP_FREE;
        descent->low[i] = is_held ? 0 : 2 * (descent->low[i] - d[i]);
        descent->high[i] = is_held ? 0 : 2 * (descent->high[i] - d[i]);
    }
    descent_carry(descent, descent->second, descent->before);
    step->g = descent->before;
    return solver_step_find(step);
}

static double length(const struct descent *descent, const double *d)
{
    double sum = 0;
    for (size_t i = 0; i < descent->n; i++) {
        sum += d[i] * d[i] * descent->diagonal[i];
    }
    return sqrt(sum);
}

void descent_bend(struct descent *descent)
{
    const size_t n = descent->n;
    struct solver_step *step = &descent->step;
    double *d = descent->straight;
    memcpy(d, step->d, n * sizeof *d);
    memcpy(descent->sides, step->side, n * sizeof *descent->sides);
    for (size_t i = 0; i < n; i++) {
        descent->there.parameters[i] =
            descent->here.parameters[i] + probe * d[i] * descent_scale(descent, i);
    }
    if (!descent_measure(descent, &descent->there, NULL)) {
        return;
    }
    find_second(descent, d);
    const bool found = find_bend(descent, d);
    const bool bends = found && 2 * length(descent, step->d) <= most_bend * length(descent, d);
    for (size_t i = 0; i < n; i++) {
        step->d[i] = d[i] + (bends ? step->d[i] / 2 : 0);
    }
    memcpy(step->side, descent->sides, n * sizeof *descent->sides);
}
