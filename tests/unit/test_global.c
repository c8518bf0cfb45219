/* tests/unit/test_global.c - functions of many minima whose lowest is known. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "check.h"
#include "design/solver/escape.h"
#include "design/solver/global.h"

#include <math.h>
#include <string.h>

enum { N = 3 };

/* Rastrigin's: sum x^2 + 10 (1 - cos 2 pi x) = sum x^2 + (sqrt(20) sin pi x)^2; 0 at 0. */
static bool rastrigin(void *context, const double *x, double *residuals, double *jacobian)
{
    (void)context;
    if (jacobian != NULL) {
        memset(jacobian, 0, sizeof(double) * 2 * N * N);
    }
    for (size_t j = 0; j < N; j++) {
        residuals[j] = x[j];
        residuals[N + j] = sqrt(20) * sin(PI * x[j]);
        if (jacobian != NULL) {
            jacobian[j * N + j] = 1;
            jacobian[(N + j) * N + j] = sqrt(20) * PI * cos(PI * x[j]);
        }
    }
    return true;
}

/* Griewank's: 1 + sum x^2/4000 - prod cos(x_j/sqrt j), its last two terms one square. */
static bool griewank(void *context, const double *x, double *residuals, double *jacobian)
{
    double product = 1;
    (void)context;
    for (size_t j = 0; j < N; j++) {
        residuals[j] = x[j] / sqrt(4000);
        product *= cos(x[j] / sqrt((double)(j + 1)));
    }
    residuals[N] = sqrt(1 - product + 1e-12);
    if (jacobian != NULL) {
        memset(jacobian, 0, sizeof(double) * (N + 1) * N);
        for (size_t j = 0; j < N; j++) {
            const double root = sqrt((double)(j + 1));
            double others = 1;
            for (size_t i = 0; i < N; i++) {
                others *= i == j ? 1 : cos(x[i] / sqrt((double)(i + 1)));
            }
            jacobian[j * N + j] = 1 / sqrt(4000);
            jacobian[N * N + j] = others * sin(x[j] / root) / root / 2 / residuals[N];
        }
    }
    return true;
}

struct landscape {
    const char *name;
    solver_function *function;
    size_t residuals;
    double low, high, scale;
};

static const struct landscape landscapes[] = {
    {"Rastrigin", rastrigin, 2 * N, -5.12, 5.12, 0.4},
    {"Griewank", griewank, N + 1, -60, 60, 4},
};

/* The lowest of so many starts; how many ends they have in all. */
static double lowest(const struct landscape *of, int starts, int escapes, uint64_t seed,
                     size_t *ends)
{
    double low[N], high[N], scale[N], least = INFINITY;
    for (size_t j = 0; j < N; j++) {
        low[j] = of->low;
        high[j] = of->high;
        scale[j] = of->scale;
    }
    const struct solver_problem problem = {.parameter_count = N,
                                           .residual_count = of->residuals,
                                           .evaluate = of->function,
                                           .low = low,
                                           .high = high,
                                           .scale = scale};
    const struct global_search search = {
        .problem = &problem, .low = low, .high = high, .seed = seed, .escapes = escapes};
    *ends = 0;
    for (int i = 0; i < starts; i++) {
        struct arena arena = {0};
        struct global_chain chain;
        double x[N];
        global_start(&search, (uint32_t)i, x);
        global_descend(&search, (uint32_t)i, x, &arena, &chain);
        *ends += chain.count;
        for (size_t k = 0; k < chain.count; k++) {
            least = fmin(least, 2 * chain.minima[k].cost);
        }
        arena_free(&arena);
    }
    return least;
}

static void test_landscapes(void)
{
    static const struct {
        int starts, escapes;
        double most;
    } asked[] = {{20, 24, 1e-20}, {20, 6, 1.0001e-12}};
    for (size_t i = 0; i < sizeof landscapes / sizeof landscapes[0]; i++) {
        size_t ends, bare;
        const double least = lowest(&landscapes[i], asked[i].starts, asked[i].escapes, 2, &ends);
        CHECK(least <= asked[i].most);
        lowest(&landscapes[i], asked[i].starts, 0, 2, &bare);
        CHECK(bare == (size_t)asked[i].starts); /* all of them have an end */
        CHECK(ends > 3 * bare);                 /* and ways out lead to other ones */
        CHECK(lowest(&landscapes[i], 4, 2, 2, &ends) == lowest(&landscapes[i], 4, 2, 2, &bare));
        CHECK(ends == bare);
    }
}

/* No start depends on who was asked before; all lie within. */
static void test_starts(void)
{
    double low[300], high[300], scale[300], x[300], y[300];
    for (size_t j = 0; j < 300; j++) {
        low[j] = -(double)j;
        high[j] = 1;
        scale[j] = 1;
    }
    const struct solver_problem problem = {.parameter_count = 300, .scale = scale};
    const struct global_search search = {.problem = &problem, .low = low, .high = high, .seed = 3};
    size_t halves = 0;
    for (uint32_t i = 0; i < 16; i++) {
        global_start(&search, i, x);
        global_start(&search, i + 1, y);
        CHECK(memcmp(x, y, sizeof x) != 0);
        global_start(&search, i, y);
        CHECK(memcmp(x, y, sizeof x) == 0);
        for (size_t j = 0; j < 300; j++) {
            CHECK(x[j] > low[j] && x[j] < high[j]);
        }
        halves += x[1] > 0;
    }
    CHECK(halves == 8); /* as many in each half: scrambling keeps that */
}

/* A valley along x + y = 1, its exact residual x = 2 y. */
static bool valley(void *context, const double *x, double *residuals, double *jacobian)
{
    (void)context;
    residuals[0] = x[0] + x[1] - 1;
    residuals[1] = x[0] - 2 * x[1];
    if (jacobian != NULL) {
        memcpy(jacobian, (const double[]){1, 1, 1, -2}, 4 * sizeof(double));
    }
    return true;
}

static void test_hill(void)
{
    static const double scale[] = {2, 0.5}, at[] = {1, 1};
    const struct solver_problem problem = {.parameter_count = 2,
                                           .residual_count = 2,
                                           .exact_count = 1,
                                           .evaluate = valley,
                                           .scale = scale};
    const struct escape_hill hill = {at, 9, 2};
    struct escape escape = {&problem, &hill, 1};
    const struct solver_problem raised = escape_problem(&escape);
    double r[3], jacobian[6];
    CHECK(raised.residual_count == 3 && raised.exact_count == 1);
    /* 1 off in the first, 2 scales of the second: d^2 = 1 + 4, and 3 exp(-5/8) */
    CHECK(raised.evaluate(raised.context, (const double[]){3, 2}, r, jacobian));
    CHECK_NEAR(r[0], 4, 0, "the problem's own");
    CHECK_NEAR(r[1], 1.605784285557, 1e-12, "3 exp(-5/8)");
    CHECK_NEAR(r[2], -1, 0, "the exact one, last");
    CHECK_NEAR(jacobian[2], -1.605784285557 * 2 / 16, 1e-12, "by x: -r dx/(2 2)^2");
    CHECK_NEAR(jacobian[3], -1.605784285557 * 1 / 1, 1e-12, "by y: -r dy/(0.5 2)^2");
    CHECK_NEAR(jacobian[5], -2, 0, "of the exact one by y");
    CHECK(raised.evaluate(raised.context, (const double[]){1000, 2}, r, NULL) && r[1] == 0);
    CHECK_NEAR(escape_distance(&problem, (const double[]){3, 2}, at), sqrt(5), 1e-15, "distance");
}

int main(void)
{
    test_landscapes();
    test_starts();
    test_hill();
    return check_report();
}
