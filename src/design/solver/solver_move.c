/* design/solver/solver_move.c - a step of a descent and what there is behind it. */
/* SPDX-License-Identifier: MIT */
#include "design/solver/solver_descent.h"

#include <string.h>

static void bound_step(struct descent *descent, const double *from)
{
    const struct solver_problem *problem = descent->problem;
    for (size_t i = 0; i < descent->n; i++) {
        const double scale = descent_scale(descent, i), at = from[i];
        const bool is_free = descent->run->is_free[i];
        if (!is_free) {
            descent->low[i] = 0;
        } else if (problem->low != NULL) {
            descent->low[i] = (problem->low[i] - at) / scale;
        } else {
            descent->low[i] = -INFINITY;
        }
        if (!is_free) {
            descent->high[i] = 0;
        } else if (problem->high != NULL) {
            descent->high[i] = (problem->high[i] - at) / scale;
        } else {
            descent->high[i] = INFINITY;
        }
    }
}

static void damp(struct descent *descent)
{
    const size_t n = descent->n;
    memcpy(descent->damped, descent->normal, n * n * sizeof(double));
    for (size_t i = 0; i < n; i++) {
        descent->damped[i * n + i] += descent->damping * descent->diagonal[i];
    }
}

/* Set parameters that much further, and not beyond bounds by rounding. */
static void solver_move_move(const struct descent *descent, const double *from, double *to)
{
    const struct solver_problem *problem = descent->problem;
    for (size_t i = 0; i < descent->n; i++) {
        to[i] = from[i] + descent->step.d[i] * descent_scale(descent, i);
        if (problem->low != NULL &&
            (descent->step.side[i] == STEP_AT_LOW || to[i] < problem->low[i])) {
            to[i] = problem->low[i];
        }
        if (problem->high != NULL &&
            (descent->step.side[i] == STEP_AT_HIGH || to[i] > problem->high[i])) {
            to[i] = problem->high[i];
        }
        to[i] = descent->run->is_free[i] ? to[i] : from[i];
    }
}

/* By how much the step lowers the height, as far as the equations tell. */
static double promise(const struct descent *descent)
{
    const size_t n = descent->n;
    const double *d = descent->step.d;
    double sum = descent->price * descent->here.excess +
                 solver_sided_gain(&descent->sided, descent->here.residuals, d);
    for (size_t i = 0; i < n; i++) {
        double slope = descent->rest[i];
        for (size_t j = 0; j < n; j++) {
            slope += descent->normal[i * n + j] * d[j] / 2;
        }
        sum -= d[i] * slope;
    }
    for (size_t r = 0; r < descent->exact; r++) {
        double left = descent->here.residuals[descent->squares + r];
        for (size_t j = 0; j < n; j++) {
            left += descent->slopes[r * n + j] * d[j];
        }
        sum -= descent->price * fabs(left);
    }
    return sum;
}

/* Who lies on a bound stays there. */
static void hold_at_bounds(struct descent *descent)
{
    for (size_t i = 0; i < descent->n; i++) {
        if (descent->step.side[i] != STEP_FREE) {
            descent->low[i] = descent->high[i] = 0;
        }
    }
}

/* Back to where the exact residuals are 0, which bend away from the step, by its derivatives. */
static bool return_to_exact(struct descent *descent)
{
    double *d = descent->step.d, *other = descent->before;
    for (int i = 0; i < 4 && descent->there.excess > DESCENT_MET; i++) {
        const double excess = descent->there.excess;
        bound_step(descent, descent->there.parameters);
        hold_at_bounds(descent);
        descent->step.h = descent->damped;
        descent->step.g = descent->none;
        descent->step.excess = descent->there.residuals + descent->squares;
        if (!solver_step_find(&descent->step)) {
            break;
        }
        memcpy(other, descent->there.parameters, descent->n * sizeof *d);
        solver_move_move(descent, other, descent->there.parameters);
        if (!descent_measure(descent, &descent->there, NULL)) {
            return false;
        }
        if (!(descent->there.excess < excess / 2)) {
            break;
        }
    }
    return true;
}

/* Above all multipliers, so that nothing is gained by leaving the exact residuals; but what they
   were far from the end is forgotten. */
static void set_price(struct descent *descent)
{
    double most = 0;
    for (size_t r = 0; r < descent->exact; r++) {
        most = fmax(most, fmin(fabs(descent->step.multipliers[r]), 1e150));
    }
    descent->price = fmin(fmax(descent->price, 2 * most), 20 * most);
}

/*
 * Where a step gains little, in a narrow valley, it is worth one more evaluation that it follows
 * the bends of it; far from there steps are to lead elsewhere anyway.
 */
static bool creeps(const struct descent *descent, double promised)
{
    static const double little = 0.1;
    return descent->exact == 0 && descent->problem->scale != NULL &&
           promised < little * descent_height(descent, &descent->here);
}

bool descent_step(struct descent *descent, double *promised)
{
    struct solver_step *step = &descent->step;
    damp(descent);
    bound_step(descent, descent->here.parameters);
    for (size_t r = 0; r < descent->exact; r++) {
        descent->wanted[r] = descent->share * descent->here.residuals[descent->squares + r];
    }
    step->excess = descent->wanted;
    *promised = NAN;
    if (!solver_sided_find(&descent->sided, descent->here.residuals, descent->damped, descent->rest,
                           step)) {
        return false;
    }
    set_price(descent);
    *promised = promise(descent);
    if (creeps(descent, *promised)) {
        descent_bend(descent);
    }
    solver_move_move(descent, descent->here.parameters, descent->there.parameters);
    if (!descent_measure(descent, &descent->there, NULL)) {
        return false;
    }
    if (descent->there.excess > DESCENT_MET && !(descent->share < 1)) {
        memcpy(descent->move, step->multipliers, descent->exact * sizeof(double));
        const bool good = return_to_exact(descent);
        memcpy(step->multipliers, descent->move, descent->exact * sizeof(double));
        return good;
    }
    return true;
}

void descent_finish(struct descent *descent)
{
    const double excess = descent->here.excess;
    if (!(excess > DESCENT_MET)) {
        return;
    }
    memcpy(descent->there.parameters, descent->here.parameters, descent->n * sizeof(double));
    memcpy(descent->there.residuals, descent->here.residuals,
           (descent->squares + descent->exact) * sizeof(double));
    descent->there.cost = descent->here.cost;
    descent->there.excess = excess;
    damp(descent);
    if (return_to_exact(descent) && descent->there.excess < excess) {
        descent->here = descent->there;
    }
}
