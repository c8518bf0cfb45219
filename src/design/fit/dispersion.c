/* design/fit/dispersion.c - a dispersion formula from measured indices. */
/* SPDX-License-Identifier: MIT */
#include "design/fit/dispersion.h"

#include "base/linear.h"
#include "optics/wavelength.h"

#include <math.h>
#include <string.h>

enum { MOST_PARAMETERS = 8 };

/* Values of n (or n^2) and derivatives at a wavelength, by all parameters. */
typedef double curve_function(const double *c, size_t count, double l, double *slope);

struct dispersion_curve {
    enum glass_formula formula;
    size_t least, usual, most; /* terms: resonances of Sellmeier, coefficients of the others */
    bool is_square, is_linear;
    curve_function *value;
    const char *names[MOST_PARAMETERS];
};

struct dispersion_problem {
    const struct dispersion_data *data;
    const struct dispersion_curve *curve;
    size_t count;
};

static double dispersion_sellmeier(const double *c, size_t count, double l, double *slope)
{
    double square = l * l, sum = 1;
    for (size_t i = 0; i + 1 < count; i += 2) {
        double gap = square - c[i + 1];
        slope[i] = square / gap;
        slope[i + 1] = c[i] * square / (gap * gap);
        sum += c[i] * slope[i];
    }
    return sum;
}

static double dispersion_schott(const double *c, size_t count, double l, double *slope)
{
    static const int powers[] = {0, 2, -2, -4, -6, -8};
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        slope[i] = pow(l, powers[i]);
        sum += c[i] * slope[i];
    }
    return sum;
}

static double powers_of(const double *c, size_t count, double x, double *slope)
{
    double sum = 0, power = 1;
    for (size_t i = 0; i < count; i++, power *= x) {
        slope[i] = power;
        sum += c[i] * power;
    }
    return sum;
}

static double dispersion_cauchy(const double *c, size_t count, double l, double *slope)
{
    return powers_of(c, count, 1 / (l * l), slope);
}

static double dispersion_buchdahl(const double *c, size_t count, double l, double *slope)
{
    double step = l - WAVELENGTH_D;
    return powers_of(c, count, step / (1 + 2.5 * step), slope);
}

static double dispersion_conrady(const double *c, size_t count, double l, double *slope)
{
    (void)count;
    slope[0] = 1;
    slope[1] = 1 / l;
    slope[2] = 1 / (l * l * l * sqrt(l));
    return c[0] + c[1] * slope[1] + c[2] * slope[2];
}

static const struct dispersion_curve curves[] = {
    {GLASS_SELLMEIER,
     1,
     3,
     3,
     true,
     false,
     dispersion_sellmeier,
     {"B1", "C1", "B2", "C2", "B3", "C3"}},
    {GLASS_SCHOTT, 6, 6, 6, true, true, dispersion_schott, {"a0", "a1", "a2", "a3", "a4", "a5"}},
    {GLASS_CAUCHY, 1, 3, 6, false, true, dispersion_cauchy, {"A", "B", "C", "D", "E", "F"}},
    {GLASS_BUCHDAHL,
     2,
     4,
     7,
     false,
     true,
     dispersion_buchdahl,
     {"n0", "v1", "v2", "v3", "v4", "v5", "v6"}},
    {GLASS_CONRADY, 3, 3, 3, false, true, dispersion_conrady, {"n0", "A", "B"}},
};

static double share(const struct dispersion_data *data, size_t i)
{
    return data->deviation != NULL ? 1 / data->deviation[i] : 1;
}

static bool dispersion_evaluate(void *context, const double *c, double *residuals, double *jacobian)
{
    const struct dispersion_problem *fitting = context;
    const struct dispersion_data *data = fitting->data;
    for (size_t i = 0; i < data->count; i++) {
        double slope[MOST_PARAMETERS], w = share(data, i);
        double n = fitting->curve->value(c, fitting->count, data->wavelength[i], slope);
        double inner = 1;
        if (fitting->curve->is_square) {
            if (!(n > 0)) {
                return false;
            }
            n = sqrt(n);
            inner = 1 / (2 * n);
        }
        residuals[i] = w * (n - data->index[i]);
        for (size_t j = 0; j < fitting->count && jacobian != NULL; j++) {
            jacobian[i * fitting->count + j] = w * inner * slope[j];
        }
    }
    return true;
}

/*
 * The linear parameters by least squares; of Sellmeier the strengths, with the resonances as they
 * are in c.
 */
static void dispersion_solve_linear(const struct dispersion_problem *fitting, double *c,
                                    struct arena *arena)
{
    const struct dispersion_data *data = fitting->data;
    size_t step = fitting->curve->is_linear ? 1 : 2, count = fitting->count / step;
    double *a = ARENA_ARRAY(arena, data->count * count, double);
    double *b = ARENA_ARRAY(arena, data->count, double), x[MOST_PARAMETERS];
    for (size_t i = 0; i < data->count; i++) {
        double slope[MOST_PARAMETERS], n = data->index[i];
        fitting->curve->value(c, fitting->count, data->wavelength[i], slope);
        double w = share(data, i);
        if (fitting->curve->is_square) { /* its error is that of the index times 2 n */
            w /= n;
        }
        for (size_t j = 0; j < count; j++) {
            a[i * count + j] = w * slope[step * j];
        }
        double right = fitting->curve->is_square ? n * n : n;
        b[i] = w * (fitting->curve->is_linear ? right : right - 1);
    }
    const struct linear_factors factors = linear_factor(a, data->count, count, 1e-14, arena);
    linear_solve(&factors, b, x);
    for (size_t j = 0; j < count; j++) {
        c[step * j] = x[j];
    }
}

/* Resonances in the ultraviolet as shares of the shortest wavelength, in the infrared as
   multiples of the longest; one more start a row. */
static const double resonances[][3] = {
    {0.25, 0.5, 4}, {0.3, 0.6, 6}, {0.2, 0.7, 10}, {0.4, 0.7, 3},
    {0.1, 0.4, 5},  {0.5, 0.3, 8}, {0.3, 0.45, 2}, {0.6, 0.8, 5},
};

static bool fit_from(struct dispersion_problem *fitting, double *c, struct arena *arena,
                     struct solver_summary *summary, struct error *error)
{
    const struct dispersion_data *data = fitting->data;
    const double first = data->wavelength[0], last = data->wavelength[data->count - 1];
    double low[MOST_PARAMETERS], high[MOST_PARAMETERS];
    for (size_t j = 0; j < fitting->count; j++) {
        low[j] = -INFINITY;
        high[j] = INFINITY;
        if (!fitting->curve->is_linear && j % 2 == 1) {
            /* of resonances: not in the range of the data */
            const bool is_ultraviolet = c[j] < first * first;
            low[j] = is_ultraviolet ? 0 : 1.5 * last * last;
            high[j] = is_ultraviolet ? 0.7 * first * first : 1e6 * last * last;
        }
    }
    const struct solver_problem problem = {.parameter_count = fitting->count,
                                           .residual_count = data->count,
                                           .evaluate = dispersion_evaluate,
                                           .context = fitting,
                                           .low = fitting->curve->is_linear ? NULL : low,
                                           .high = fitting->curve->is_linear ? NULL : high};
    const struct solver_options options = {
        .engine = SOLVER_CERES, .iterations = 500, .dependent = 1e-13};
    return solver_run(&problem, &options, c, arena, summary, error);
}

enum { ENOUGH = 300 }; /* measured indices to tell which start is the best */

/* At most ENOUGH of the measured indices, evenly among them, the first and the last too. */
static struct dispersion_data thinned(const struct dispersion_data *data, struct arena *arena)
{
    if (data->count <= ENOUGH) {
        return *data;
    }
    double *wavelength = ARENA_ARRAY(arena, ENOUGH, double);
    double *index = ARENA_ARRAY(arena, ENOUGH, double);
    double *deviation = data->deviation != NULL ? ARENA_ARRAY(arena, ENOUGH, double) : NULL;
    for (size_t i = 0; i < ENOUGH; i++) {
        const size_t from = i * (data->count - 1) / (ENOUGH - 1);
        wavelength[i] = data->wavelength[from];
        index[i] = data->index[from];
        if (deviation != NULL) {
            deviation[i] = data->deviation[from];
        }
    }
    return (struct dispersion_data){ENOUGH, wavelength, index, deviation};
}

/* The starts of Sellmeier: k resonances, of which the last may be in the infrared. */
static bool fit_starts(struct dispersion_problem *fitting, double *best, struct arena *arena,
                       struct solver_summary *summary, struct error *error)
{
    const struct dispersion_data *data = fitting->data;
    size_t terms = fitting->count / 2;
    double first = data->wavelength[0], last = data->wavelength[data->count - 1];
    bool found = false;
    for (size_t k = 0; k < 2 * sizeof resonances / sizeof resonances[0]; k++) {
        const double *row = resonances[k / 2];
        bool infrared = k % 2 == 0 && terms > 1;
        double c[MOST_PARAMETERS] = {0};
        for (size_t j = 0; j < terms; j++) {
            double l = j < 2 ? row[j] * first : 0.9 * row[0] * first;
            if (infrared && j + 1 == terms) {
                l = row[2] * last;
            }
            c[2 * j + 1] = l * l;
        }
        struct solver_summary one;
        dispersion_solve_linear(fitting, c, arena);
        if (fit_from(fitting, c, arena, &one, error) &&
            (!found || one.final_cost < summary->final_cost)) {
            found = true;
            *summary = one;
            memcpy(best, c, fitting->count * sizeof(double));
        }
    }
    return found;
}

/* The best of all starts; of long data by some of it, and then once by all. */
static bool fit_sellmeier(struct dispersion_problem *fitting, double *best, struct arena *arena,
                          struct solver_summary *summary, struct error *error)
{
    const struct dispersion_data few = thinned(fitting->data, arena);
    struct dispersion_problem starting = *fitting;
    starting.data = &few;
    return fit_starts(&starting, best, arena, summary, error) &&
           (few.count == fitting->data->count || fit_from(fitting, best, arena, summary, error));
}

static void dispersion_set_glass(const struct dispersion_problem *fitting, const double *c,
                                 struct dispersion_fit *fit)
{
    const struct dispersion_data *data = fitting->data;
    struct glass *glass = &fit->glass;
    *glass = glass_constant(pair_of(1));
    glass->formula = fitting->curve->formula;
    glass->count = 0;
    if (glass->formula == GLASS_BUCHDAHL) {
        glass->coefficients[glass->count++] = pair_divide(pair_of(5875618), pair_of(1e7));
    }
    for (size_t j = 0; j < fitting->count; j++) {
        glass->coefficients[glass->count++] = pair_of(c[j]);
    }
    glass->shortest = data->wavelength[0];
    glass->longest = data->wavelength[data->count - 1];
    double sum = 0;
    for (size_t i = 0; i < data->count; i++) {
        fit->residuals[i] = glass_n(glass, data->wavelength[i]) - data->index[i];
        sum += fit->residuals[i] * fit->residuals[i];
        fit->largest = fmax(fit->largest, fabs(fit->residuals[i]));
    }
    fit->rms = sqrt(sum / (double)data->count);
}

static bool check_data(const struct dispersion_data *data, struct error *error)
{
    for (size_t i = 0; i < data->count; i++) {
        double l = data->wavelength[i], n = data->index[i];
        if (!(l > 0 && isfinite(l))) {
            return fail(error, ERROR_DOMAIN, "the wavelength %.10g um is not above 0", l);
        }
        if (!(n > 0 && n < 100)) {
            return fail(error, ERROR_DOMAIN, "the index %.10g at %.10g um is not between 0 and 100",
                        n, l);
        }
        if (i > 0 && !(l > data->wavelength[i - 1])) {
            return fail(error, ERROR_DOMAIN, "the wavelength %.10g um is there twice", l);
        }
        if (!(share(data, i) > 0 && isfinite(share(data, i)))) {
            return fail(error, ERROR_DOMAIN,
                        "the deviation of the index at %.10g um is not above 0", l);
        }
    }
    return true;
}

bool dispersion_fit(const struct dispersion_data *data, enum glass_formula formula, size_t terms,
                    struct arena *arena, struct dispersion_fit *fit, struct error *error)
{
    const struct dispersion_curve *curve = NULL;
    for (size_t i = 0; i < sizeof curves / sizeof curves[0]; i++) {
        curve = curves[i].formula == formula ? &curves[i] : curve;
    }
    if (curve == NULL) {
        return fail(error, ERROR_DOMAIN, "the formula %s cannot be fitted",
                    glass_formula_name(formula));
    }
    terms = terms > 0 ? terms : curve->usual;
    if (terms < curve->least || terms > curve->most) {
        return fail(error, ERROR_DOMAIN, "the formula %s has %zu to %zu terms, not %zu",
                    glass_formula_name(formula), curve->least, curve->most, terms);
    }
    struct dispersion_problem fitting = {data, curve, curve->is_linear ? terms : 2 * terms};
    if (data->count < fitting.count) {
        return fail(error, ERROR_DOMAIN,
                    "%zu coefficients need at least as many measured indices: there are %zu",
                    fitting.count, data->count);
    }
    *fit = (struct dispersion_fit){.parameter_count = fitting.count};
    fit->parameters = ARENA_ARRAY(arena, MOST_PARAMETERS, double);
    fit->names = ARENA_ARRAY(arena, fitting.count, const char *);
    fit->residuals = ARENA_ARRAY(arena, data->count, double);
    memcpy(fit->names, curve->names, fitting.count * sizeof curve->names[0]);
    if (!check_data(data, error)) {
        return false;
    }
    if (curve->is_linear) {
        dispersion_solve_linear(&fitting, fit->parameters, arena);
    }
    if (curve->is_linear ? !fit_from(&fitting, fit->parameters, arena, &fit->summary, error)
                         : !fit_sellmeier(&fitting, fit->parameters, arena, &fit->summary, error)) {
        return false;
    }
    dispersion_set_glass(&fitting, fit->parameters, fit);
    return true;
}
