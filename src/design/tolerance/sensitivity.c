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

static struct sensitivity of_figure(const double values[SIDES], double nominal, bool is_root)
{
    double at[SIDES];
    for (int k = 0; k < SIDES; k++) {
        at[k] = is_root ? values[k] * values[k] : values[k];
    }
    const double near = (at[2] - at[3]) / (2 * part), far = (at[0] - at[1]) / 2;
    const double slope = (near - part * part * far) / (1 - part * part);
    struct sensitivity all = {.plus = values[0] - nominal, .minus = values[1] - nominal};
    if (!is_root) {
        all.linear = slope;
    } else if (nominal > 0) {
        all.linear = slope / (2 * nominal);
    } else {
        all.linear = (double)NAN;
    }
    all.quadratic = (all.plus + all.minus) / 2;
    return all;
}

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
            double values[SIDES];
            for (size_t k = 0; k < SIDES; k++) {
                values[k] = at[k * figures + f];
            }
            table[i * figures + f] = of_figure(values, nominal[f], problem->is_root[f]);
        }
    }
    return problem->error_count;
}

/* -------- what they may cost -------- */

struct inverse_search {
    const struct inverse_question *question;
    double *errors, *figures;
};

/* The worse of both ends of one error; infinite: there is no lens. 0 at least. */
static double cost_of_one(const struct inverse_search *searching, size_t i, double factor)
{
    const struct inverse_question *question = searching->question;
    double worst = 0;
    for (int side = -1; side <= 1; side += 2) {
        struct error why;
        if (!watch_add(question->problem->watch, 1)) {
            return worst; /* of no use to anybody */
        }
        const bool made = try_one(question->problem, i, side * factor, searching->errors,
                                  searching->figures, &why);
        const double cost =
            made ? question->cost(question->context, searching->figures) : (double)INFINITY;
        worst = cost > worst ? cost : worst;
    }
    return worst;
}

/* Of all errors of a tolerance. */
static double sensitivity_cost_of(const struct inverse_search *searching, size_t thing,
                                  double factor)
{
    double sum = 0;
    for (size_t i = 0; i < searching->question->problem->error_count; i++) {
        if (searching->question->thing[i] == thing) {
            const double cost = cost_of_one(searching, i, factor);
            sum += cost * cost;
        }
    }
    return sqrt(sum);
}

/* The factor between two whose cost is nearest below the share. */
static double sensitivity_factor_of(const struct inverse_search *searching, size_t i, double share)
{
    enum { HALVES = 40 };
    double low = searching->question->low[i], high = searching->question->high[i];
    for (int k = 0; k < HALVES && high > low * (1 + 1e-9); k++) {
        const double middle = sqrt(low * high);
        *(sensitivity_cost_of(searching, i, middle) > share ? &high : &low) = middle;
    }
    return low;
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
        *(sum > drop * drop ? &high : &low) = middle;
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
        if (bounds[i].tightest >= share) {
            answers[i].limit = INVERSE_TIGHTEST;
        } else if (bounds[i].loosest <= share) {
            answers[i].limit = INVERSE_LOOSEST;
        } else {
            answers[i].limit = INVERSE_FREE;
        }
        if (answers[i].limit == INVERSE_TIGHTEST) {
            answers[i].factor = question->low[i];
        } else if (answers[i].limit == INVERSE_LOOSEST) {
            answers[i].factor = question->high[i];
        } else {
            answers[i].factor = sensitivity_factor_of(&searching, i, share);
        }
        answers[i].cost = sensitivity_cost_of(&searching, i, answers[i].factor);
        sum += answers[i].cost * answers[i].cost;
    }
    return watch_is_ended(question->problem->watch) ? (double)NAN : sqrt(sum);
}
