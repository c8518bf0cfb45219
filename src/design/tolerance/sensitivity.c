/* design/tolerance/sensitivity.c - what each error costs alone, and what errors may cost. */
/* SPDX-License-Identifier: MIT */
#include "design/tolerance/sensitivity.h"

#include <math.h>
#include <string.h>

/* -------- what each costs -------- */

/* Figures of a lens with one error. */
static bool try_one(const struct second_order_problem *problem, size_t i, double size,
                    double *errors, double *figures, struct error *why)
{
    memset(errors, 0, problem->error_count * sizeof(double));
    errors[i] = size;
    if (problem->trial(problem->context, errors, figures, why)) {
        return true;
    }
    for (size_t f = 0; f < problem->figure_count; f++) {
        figures[f] = NAN;
    }
    return false;
}

/* The whole range and little of it, up and down. */
enum { SIDES = 4 };
static const double part = 1.0 / 8;
static const double sides[SIDES] = {1, -1, part, -part};

size_t sensitivity_find(const struct second_order_problem *problem, const double *nominal,
                        struct arena *arena, struct sensitivity *table, const char **failure)
{
    const size_t figures = problem->figure_count;
    double *errors = ARENA_ARRAY(arena, problem->error_count, double);
    double *at = ARENA_ARRAY(arena, SIDES * figures, double);
    *failure = NULL;
    for (size_t i = 0; i < problem->error_count; i++) {
        for (int k = 0; k < SIDES; k++) {
            struct error why;
            if (!watch_add(problem->watch, 1)) {
                return i;
            }
            if (!try_one(problem, i, sides[k], errors, at + (size_t)k * figures, &why) &&
                *failure == NULL) {
                *failure = arena_printf(arena, "%s of %g times its tolerance: %s",
                                        problem->names[i], sides[k], why.message);
            }
        }
        for (size_t f = 0; f < figures; f++) {
            struct sensitivity *all = &table[i * figures + f];
            const bool is_root = problem->is_root[f];
            double values[SIDES];
            for (size_t k = 0; k < SIDES; k++) {
                const double value = at[k * figures + f];
                values[k] = is_root ? value * value : value;
            }
            const double near = (values[2] - values[3]) / (2 * part);
            const double far = (values[0] - values[1]) / 2;
            const double slope = (near - part * part * far) / (1 - part * part);
            all->plus = at[f] - nominal[f];
            all->minus = at[figures + f] - nominal[f];
            all->linear = slope;
            if (is_root) {
                all->linear = nominal[f] > 0 ? slope / (2 * nominal[f]) : (double)NAN;
            }
            all->quadratic = (all->plus + all->minus) / 2;
        }
    }
    return problem->error_count;
}

/* -------- what they may cost -------- */

struct inverse_search {
    const struct inverse_question *question;
    double *errors, *figures;
};

/* Of all errors of a tolerance, of each the worse of both ends, 0 at least; infinite: there is no
   lens. */
static double sensitivity_cost_of(const struct inverse_search *searching, size_t thing,
                                  double factor)
{
    const struct inverse_question *question = searching->question;
    double sum = 0;
    for (size_t i = 0; i < question->problem->error_count; i++) {
        double worst = 0;
        for (int side = -1; side <= 1 && question->thing[i] == thing; side += 2) {
            struct error why;
            if (!watch_add(question->problem->watch, 1)) {
                break; /* of no use to anybody */
            }
            const bool made = try_one(question->problem, i, side * factor, searching->errors,
                                      searching->figures, &why);
            const double cost =
                made ? question->cost(question->context, searching->figures) : (double)INFINITY;
            worst = cost > worst ? cost : worst;
        }
        sum += worst * worst;
    }
    return sqrt(sum);
}

/* Costs at both limits. */
struct bounds {
    double tightest, loosest;
};

/* What a tolerance costs that is as near to a share as its limits allow. */
static double limited(const struct bounds *bounds, double share)
{
    return fmax(fmin(share, bounds->loosest), bounds->tightest);
}

/* The share with which they cost the drop together: their sum of squares grows with it. */
static double sensitivity_share_of(const struct bounds *bounds, size_t count, double drop)
{
    enum { HALVES = 60 };
    const double least = 1e-3; /* of the drop: nothing is made better for less */
    double low = least * drop, high = drop;
    for (int k = 0; k < HALVES; k++) {
        const double middle = (low + high) / 2;
        double sum = 0;
        for (size_t i = 0; i < count; i++) {
            sum += limited(&bounds[i], middle) * limited(&bounds[i], middle);
        }
        if (sum > drop * drop) {
            high = middle;
        } else {
            low = middle;
        }
    }
    return low;
}

double inverse_find(const struct inverse_question *question, struct arena *arena,
                    struct inverse *answers)
{
    const size_t n = question->thing_count;
    const struct inverse_search searching = {
        question, ARENA_ARRAY(arena, question->problem->error_count, double),
        ARENA_ARRAY(arena, question->problem->figure_count, double)};
    struct bounds *bounds = ARENA_ARRAY(arena, n, struct bounds);
    double sum = 0;
    for (size_t i = 0; i < n; i++) {
        bounds[i].tightest = sensitivity_cost_of(&searching, i, question->low[i]);
        bounds[i].loosest = sensitivity_cost_of(&searching, i, question->high[i]);
        if (isinf(bounds[i].tightest)) {
            return NAN;
        }
    }
    const double share = sensitivity_share_of(bounds, n, question->drop);
    for (size_t i = 0; i < n; i++) {
        struct inverse *answer = &answers[i];
        answer->limit = INVERSE_FREE;
        if (bounds[i].tightest >= share) {
            answer->limit = INVERSE_TIGHTEST;
            answer->factor = question->low[i];
        } else if (bounds[i].loosest <= share) {
            answer->limit = INVERSE_LOOSEST;
            answer->factor = question->high[i];
        } else {
            /* the factor between two whose cost is nearest below the share */
            enum { HALVES = 40 };
            double low = question->low[i], high = question->high[i];
            for (int k = 0; k < HALVES && high > low * (1 + 1e-9); k++) {
                const double middle = sqrt(low * high);
                if (sensitivity_cost_of(&searching, i, middle) > share) {
                    high = middle;
                } else {
                    low = middle;
                }
            }
            answer->factor = low;
        }
        answer->cost = sensitivity_cost_of(&searching, i, answer->factor);
        sum += answer->cost * answer->cost;
    }
    return watch_is_ended(question->problem->watch) ? (double)NAN : sqrt(sum);
}
