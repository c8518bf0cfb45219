/* tests/stress/family_solver.c - both solvers on the regressions of NIST, from anywhere near. */
/* SPDX-License-Identifier: MIT */
#include "stress.h"

#include "design/solver/solver.h"

#include <complex.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/*
 * Models as NIST writes them, of complex numbers: with i 1e-30 added to a parameter the imaginary
 * part is the derivative by it to the last digit.
 */
typedef double complex number;
enum { MOST_PARAMETERS = 9, MOST_POINTS = 250 };

struct regression {
    char name[16];
    size_t parameters, points, predictors;
    double squares, start[2][MOST_PARAMETERS], certified[MOST_PARAMETERS], error[MOST_PARAMETERS];
    double data[MOST_POINTS][3]; /* y, x1, x2 */
    number (*model)(const number *b, const double *x);
};

static number bennett(const number *b, const double *x)
{
    return b[0] * cpow(b[1] + x[0], -1 / b[2]);
}

static number growth(const number *b, const double *x)
{
    return b[0] * (1 - cexp(-b[1] * x[0]));
}

static number chwirut(const number *b, const double *x)
{
    return cexp(-b[0] * x[0]) / (b[1] + b[2] * x[0]);
}

static number power_law(const number *b, const double *x)
{
    return b[0] * cpow(x[0], b[1]);
}

static number enso(const number *b, const double *x)
{
    const number turn = 2 * acos(-1) * x[0];
    return b[0] + b[1] * ccos(turn / 12) + b[2] * csin(turn / 12) + b[4] * ccos(turn / b[3]) +
           b[5] * csin(turn / b[3]) + b[7] * ccos(turn / b[6]) + b[8] * csin(turn / b[6]);
}

static number eckerle(const number *b, const double *x)
{
    const number z = (x[0] - b[2]) / b[1];
    return b[0] / b[1] * cexp(-0.5 * z * z);
}

static number two_peaks(const number *b, const double *x)
{
    const number z = (x[0] - b[3]) / b[4], w = (x[0] - b[6]) / b[7];
    return b[0] * cexp(-b[1] * x[0]) + b[2] * cexp(-z * z) + b[5] * cexp(-w * w);
}

static number cubics(const number *b, const double *x)
{
    const double t = x[0];
    return (b[0] + t * (b[1] + t * (b[2] + t * b[3]))) / (1 + t * (b[4] + t * (b[5] + t * b[6])));
}

static number quadratics(const number *b, const double *x)
{
    const double t = x[0];
    return (b[0] + t * (b[1] + t * b[2])) / (1 + t * (b[3] + t * b[4]));
}

static number lanczos(const number *b, const double *x)
{
    return b[0] * cexp(-b[1] * x[0]) + b[2] * cexp(-b[3] * x[0]) + b[4] * cexp(-b[5] * x[0]);
}

static number mgh09(const number *b, const double *x)
{
    const double t = x[0];
    return b[0] * (t * t + t * b[1]) / (t * t + t * b[2] + b[3]);
}

static number mgh10(const number *b, const double *x)
{
    return b[0] * cexp(b[1] / (x[0] + b[2]));
}

static number mgh17(const number *b, const double *x)
{
    return b[0] + b[1] * cexp(-x[0] * b[3]) + b[2] * cexp(-x[0] * b[4]);
}

static number misra1b(const number *b, const double *x)
{
    return b[0] * (1 - 1 / ((1 + b[1] * x[0] / 2) * (1 + b[1] * x[0] / 2)));
}

static number misra1c(const number *b, const double *x)
{
    return b[0] * (1 - 1 / csqrt(1 + 2 * b[1] * x[0]));
}

static number misra1d(const number *b, const double *x)
{
    return b[0] * b[1] * x[0] / (1 + b[1] * x[0]);
}

static number nelson(const number *b, const double *x)
{
    return b[0] - b[1] * x[0] * cexp(-b[2] * x[1]);
}

static number rat42(const number *b, const double *x)
{
    return b[0] / (1 + cexp(b[1] - b[2] * x[0]));
}

static number rat43(const number *b, const double *x)
{
    return b[0] / cpow(1 + cexp(b[1] - b[2] * x[0]), 1 / b[3]);
}

static number roszman(const number *b, const double *x)
{
    return b[0] - b[1] * x[0] - catan(b[2] / (x[0] - b[3])) / acos(-1);
}

static const struct {
    const char *name;
    number (*model)(const number *b, const double *x);
} models[] = {
    {"Bennett5", bennett},  {"BoxBOD", growth},    {"Chwirut1", chwirut}, {"Chwirut2", chwirut},
    {"DanWood", power_law}, {"ENSO", enso},        {"Eckerle4", eckerle}, {"Gauss1", two_peaks},
    {"Gauss2", two_peaks},  {"Gauss3", two_peaks}, {"Hahn1", cubics},     {"Kirby2", quadratics},
    {"Lanczos1", lanczos},  {"Lanczos2", lanczos}, {"Lanczos3", lanczos}, {"MGH09", mgh09},
    {"MGH10", mgh10},       {"MGH17", mgh17},      {"Misra1a", growth},   {"Misra1b", misra1b},
    {"Misra1c", misra1c},   {"Misra1d", misra1d},  {"Nelson", nelson},    {"Rat42", rat42},
    {"Rat43", rat43},       {"Roszman1", roszman}, {"Thurber", cubics},
};
enum { REGRESSIONS = sizeof models / sizeof models[0] };

/* -------- reading -------- */

static double next_number(FILE *file)
{
    char word[40] = "";
    return fscanf(file, "%39s", word) == 1 ? strtod(word, NULL) : (double)NAN;
}

/* False: the file ends, or is not what it should be. */
static bool read_regression(FILE *file, struct regression *one)
{
    if (fscanf(file, "%15s", one->name) != 1) {
        return false;
    }
    one->parameters = (size_t)next_number(file);
    one->points = (size_t)next_number(file);
    one->predictors = (size_t)next_number(file);
    one->squares = next_number(file);
    if (one->parameters > MOST_PARAMETERS || one->points > MOST_POINTS || one->predictors > 2) {
        return false;
    }
    for (size_t i = 0; i < one->parameters; i++) {
        one->start[0][i] = next_number(file);
        one->start[1][i] = next_number(file);
        one->certified[i] = next_number(file);
        one->error[i] = next_number(file);
    }
    for (size_t i = 0; i < one->points; i++) {
        for (size_t k = 0; k <= one->predictors; k++) {
            one->data[i][k] = next_number(file);
        }
    }
    for (size_t i = 0; i < REGRESSIONS; i++) {
        one->model = strcmp(models[i].name, one->name) == 0 ? models[i].model : one->model;
    }
    if (one->model == nelson) { /* of the logarithm of y */
        for (size_t i = 0; i < one->points; i++) {
            one->data[i][0] = log(one->data[i][0]);
        }
    }
    return one->model != NULL;
}

/* All of them, read once; null: they are not there. */
static const struct regression *regressions(void)
{
    static struct regression all[REGRESSIONS];
    static size_t count;
    if (count == 0) {
        FILE *file = fopen("tests/stress/nist.txt", "r");
        char line[200];
        for (int i = 0; i < 3 && file != NULL; i++) {
            (void)!fgets(line, sizeof line, file);
        }
        while (file != NULL && count < REGRESSIONS && read_regression(file, &all[count])) {
            count++;
        }
        if (file != NULL) {
            (void)fclose(file);
        }
    }
    return count == REGRESSIONS ? all : NULL;
}

/* -------- a trial -------- */

static bool evaluate(void *context, const double *b, double *residuals, double *jacobian)
{
    const struct regression *one = context;
    const double step = 1e-30;
    number at[MOST_PARAMETERS];
    bool good = true;
    for (size_t j = 0; j < one->parameters; j++) {
        at[j] = b[j];
    }
    for (size_t i = 0; i < one->points; i++) {
        residuals[i] = creal(one->model(at, one->data[i] + 1)) - one->data[i][0];
        good = good && isfinite(residuals[i]);
        for (size_t j = 0; j < one->parameters && jacobian != NULL; j++) {
            at[j] = b[j] + step * I;
            jacobian[i * one->parameters + j] = cimag(one->model(at, one->data[i] + 1)) / step;
            at[j] = b[j];
        }
    }
    return good;
}

/* The largest cosine between the residuals and a derivative: 0 at a minimum. */
static double steepness(const struct regression *one, const struct solver_summary *summary)
{
    double most = 0;
    for (size_t j = 0; j < one->parameters; j++) {
        double product = 0, slope = 0, square = 0;
        for (size_t i = 0; i < one->points; i++) {
            const double d = summary->jacobian[i * one->parameters + j], r = summary->residuals[i];
            product += d * r;
            slope += d * d;
            square += r * r;
        }
        most = fmax(most, slope > 0 ? fabs(product) / sqrt(slope * square) : 0);
    }
    return most;
}

/* Terms of a sum that may change places: `count` of them, each of these parameters. */
static const struct exchange {
    number (*model)(const number *b, const double *x);
    size_t count, size, term[3][3];
    bool is_width; /* the last of a term counts by its square */
} exchanges[] = {{lanczos, 3, 2, {{0, 1}, {2, 3}, {4, 5}}, false},
                 {two_peaks, 2, 3, {{2, 3, 4}, {5, 6, 7}}, true},
                 {enso, 2, 3, {{4, 5, 3}, {7, 8, 6}}, false},
                 {mgh17, 2, 2, {{1, 3}, {2, 4}}, false}};

/* Into the order of the certified ones. */
static void exchange_terms(const struct regression *one, double *b)
{
    for (size_t k = 0; k < sizeof exchanges / sizeof exchanges[0]; k++) {
        const struct exchange *these = &exchanges[k];
        for (size_t i = 0; these->model == one->model && i < these->count; i++) {
            const size_t key = these->term[i][1];
            size_t best = i;
            for (size_t j = i + 1; j < these->count; j++) {
                const bool is_nearer = fabs(b[these->term[j][1]] - one->certified[key]) <
                                       fabs(b[these->term[best][1]] - one->certified[key]);
                best = is_nearer ? j : best;
            }
            for (size_t m = 0; m < these->size; m++) {
                const double other = b[these->term[best][m]];
                b[these->term[best][m]] = b[these->term[i][m]];
                b[these->term[i][m]] = other;
            }
            const size_t width = these->term[i][these->size - 1];
            b[width] = these->is_width ? fabs(b[width]) : b[width];
        }
    }
}

/* Is there a parameter that nothing depends on, to 9 digits: the end of a plateau? */
static bool is_idle(const struct regression *one, const struct solver_summary *summary,
                    const double *b)
{
    double square = 0;
    for (size_t i = 0; i < one->points; i++) {
        square += summary->residuals[i] * summary->residuals[i];
    }
    for (size_t j = 0; j < one->parameters; j++) {
        double slope = 0;
        for (size_t i = 0; i < one->points; i++) {
            const double d = summary->jacobian[i * one->parameters + j] * b[j];
            slope += d * d;
        }
        if (slope <= 1e-18 * square) {
            return true;
        }
    }
    return false;
}

/* The first trials are those of NIST; then starts about the second one, nearer or farther. */
static void draw_start(struct trial *trial, const struct regression *one, double *b)
{
    const unsigned long turn = trial->number / (2 * REGRESSIONS);
    for (size_t j = 0; j < one->parameters; j++) {
        const double away = one->start[1][j] - one->certified[j];
        b[j] = turn < 2 ? one->start[1 - turn][j]
                        : one->certified[j] + trial_between(trial, -0.5, 1.2) * away;
    }
}

void try_nist(struct trial *trial)
{
    const struct regression *all = regressions();
    if (!trial_verdict(trial, all != NULL, "tests/stress/nist.txt is not there")) {
        return;
    }
    struct regression one = all[trial->number % REGRESSIONS];
    const enum solver_engine engine =
        trial->number / REGRESSIONS % 2 == 0 ? SOLVER_DLS : SOLVER_CERES;
    double b[MOST_PARAMETERS], residuals[MOST_POINTS];
    draw_start(trial, &one, b);
    if (!solver_has(engine) || !evaluate(&one, b, residuals, NULL)) {
        trial_skip(trial);
        return;
    }
    char *text = arena_array(&trial->arena, 400, 1);
    int length =
        snprintf(text, 400, "%s by %s from", one.name, engine == SOLVER_DLS ? "dls" : "ceres");
    for (size_t j = 0; j < one.parameters; j++) {
        length += snprintf(text + length, 400 - (size_t)length, " %.17g", b[j]);
    }
    snprintf(text + length, 400 - (size_t)length, "\n");
    trial->about = text;
    const struct solver_problem problem = {.parameter_count = one.parameters,
                                           .residual_count = one.points,
                                           .evaluate = evaluate,
                                           .context = &one};
    const struct solver_options options = {.engine = engine, .iterations = 3000, .function = 1e-18};
    struct solver_summary summary;
    struct error error = {0};
    if (!trial_verdict(trial, solver_run(&problem, &options, b, &trial->arena, &summary, &error),
                       "%s", error.message)) {
        return;
    }
    const double squares = 2 * summary.final_cost;
    if (squares > one.squares * (1 + 1e-6)) { /* another minimum, or none, and it has to say so */
        const double steep = steepness(&one, &summary);
        const bool is_flat = summary.rank < one.parameters || is_idle(&one, &summary, b);
        /* who starts so far away may need more steps than this, but says so */
        const bool is_unfinished = summary.status == SOLVER_LIMIT && one.model == mgh10;
        trial_verdict(trial, summary.status != SOLVER_CONVERGED || is_flat || steep < 1e-4,
                      "%s at %.11g, not %.11g, where the slope is %g", summary.message, squares,
                      one.squares, steep);
        trial_verdict(trial, is_flat || is_unfinished || trial->number >= 4 * REGRESSIONS,
                      "%s at %.11g, not %.11g", summary.message, squares, one.squares);
        return;
    }
    exchange_terms(&one, b);
    for (size_t j = 0; j < one.parameters; j++) {
        char what[30];
        snprintf(what, sizeof what, "%s b%zu", one.name, j + 1);
        trial_figure(trial, what, fabs(b[j] - one.certified[j]), fabs(one.certified[j]), 0);
    }
}
