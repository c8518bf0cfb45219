/* tests/unit/solver_cases.h - either solver against certified values, bounds, losses, refusals. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_UNIT_SOLVER_CASES_H
#define LENSCALC_TESTS_UNIT_SOLVER_CASES_H

#include "check.h"
#include "design/solver/solver.h"
#include "nist.h"

#include <stdint.h>

static bool nist_residuals(void *context, const double *b, double *residuals, double *jacobian)
{
    const struct nist *nist = context;
    for (size_t i = 0; i < nist->points; i++) {
        double slope[NIST_PARAMETERS];
        residuals[i] = nist->model(b, nist->data[i][1], slope) - nist->data[i][0];
        for (size_t j = 0; j < nist->parameters && jacobian != NULL; j++) {
            jacobian[i * nist->parameters + j] = slope[j];
        }
    }
    return true;
}

/* Certified to 11 digits: at least 8 of them from both starts. */
static void test_nist(enum solver_engine engine)
{
    for (size_t k = 0; k < sizeof nist_problems / sizeof nist_problems[0]; k++) {
        for (int s = 0; s < 2; s++) {
            struct nist nist = nist_problems[k];
            const struct solver_problem problem = {.parameter_count = nist.parameters,
                                                   .residual_count = nist.points,
                                                   .evaluate = nist_residuals,
                                                   .context = &nist};
            const struct solver_options options = {
                .engine = engine, .iterations = 2000, .function = 1e-18};
            struct arena arena = {0};
            struct solver_summary summary;
            struct error error;
            double b[NIST_PARAMETERS];
            memcpy(b, nist.start[s], sizeof b);
            CHECK(solver_run(&problem, &options, b, &arena, &summary, &error));
            CHECK(summary.status == SOLVER_CONVERGED);
            char what[80];
            check_source(engine == SOLVER_DLS ? "nist" : NULL, "");
            snprintf(what, sizeof what, "%s, start %d: sum of squares", nist.name, s + 1);
            CHECK_RELATIVE(2 * summary.final_cost, nist.squares, 1e-10, what);
            CHECK(summary.degrees_of_freedom == nist.points - nist.parameters);
            for (size_t i = 0; i < nist.parameters; i++) {
                snprintf(what, sizeof what, "%s, start %d: b%zu", nist.name, s + 1, i + 1);
                CHECK_RELATIVE(b[i], nist.certified[i], 2e-10, what);
                snprintf(what, sizeof what, "%s, start %d: error of b%zu", nist.name, s + 1, i + 1);
                CHECK_RELATIVE(summary.standard_error[i], nist.error[i], 1e-9, what);
            }
            check_source(NULL, "");
            arena_free(&arena);
        }
    }
}

/* x_i = 3, and a steep wall from sum x_i = 4 on; another, x_1 = -5, is behind the start. */
enum { WALL_PARAMETERS = 3 };
static bool wall(void *context, const double *x, double *r, double *jacobian)
{
    const double w = *(const double *)context;
    r[WALL_PARAMETERS] = -4 * w;
    r[WALL_PARAMETERS + 1] = w * (x[0] + 5);
    for (int i = 0; i < WALL_PARAMETERS; i++) {
        r[i] = x[i] - 3;
        r[WALL_PARAMETERS] += w * x[i];
        for (int k = 0; k < WALL_PARAMETERS && jacobian != NULL; k++) {
            jacobian[k * WALL_PARAMETERS + i] = k == i ? 1 : 0;
        }
        if (jacobian != NULL) {
            jacobian[WALL_PARAMETERS * WALL_PARAMETERS + i] = w;
            jacobian[(WALL_PARAMETERS + 1) * WALL_PARAMETERS + i] = i == 0 ? w : 0;
        }
    }
    return true;
}

/*
 * By symmetry x - 3 = t with t = -w^2 (3 n + n t - 4). Walls that a step runs into, and those that
 * it leaves, are part of it: what is linear is found at once, however steep.
 */
static void test_sides(enum solver_engine engine)
{
    enum { N = WALL_PARAMETERS };
    static const enum solver_side sides[N + 2] = {[N] = SIDE_ABOVE, [N + 1] = SIDE_BELOW};
    static const double starts[] = {0, 10, -20};
    double w = 1000;
    for (int s = 0; s < 3; s++) {
        const struct solver_problem problem = {.parameter_count = N,
                                               .residual_count = N + 2,
                                               .evaluate = wall,
                                               .context = &w,
                                               .scale = (const double[N]){1, 1, 1},
                                               .sides = sides};
        const struct solver_options options = {.engine = engine};
        const double t = -w * w * (3 * N - 4) / (1 + N * w * w);
        struct arena arena = {0};
        struct solver_summary summary;
        struct error error;
        double x[N] = {starts[s], starts[s], starts[s]};
        CHECK(solver_run(&problem, &options, x, &arena, &summary, &error));
        CHECK_NEAR(x[0], 3 + t, 1e-9, "before a wall");
        CHECK_NEAR(x[2], 3 + t, 1e-9, "before a wall");
        CHECK_RELATIVE(2 * summary.final_cost, N * t * t + t * t / (w * w), 1e-9, "its cost");
        CHECK(engine != SOLVER_DLS || summary.iterations <= 12);
        arena_free(&arena);
    }
}

/* Rosenbrock's valley as least squares: (10 (y - x^2), 1 - x). */
static bool rosenbrock(void *context, const double *p, double *r, double *jacobian)
{
    (void)context;
    r[0] = 10 * (p[1] - p[0] * p[0]);
    r[1] = 1 - p[0];
    if (jacobian != NULL) {
        const double all[4] = {-20 * p[0], 10, -1, 0};
        memcpy(jacobian, all, sizeof all);
    }
    return true;
}

/* With x <= 0.5 the best is (0.5, 0.25); with y <= 0.25 too; with y >= 0.5, x <= 0.5 a corner
   is the best nearby: from x < 0 engines may end at (-0.699, 0.5), which is lower. */
static void test_bounds(enum solver_engine engine)
{
    const struct solver_options usual = {.engine = engine};
    static const struct {
        double low[2], high[2], start[2], best[2];
        bool at_bound[2];
    } cases[] = {
        {{-5, -5}, {0.5, 5}, {-1.2, 1}, {0.5, 0.25}, {true, false}},
        {{-5, 0.5}, {0.5, 5}, {0.4, 2}, {0.5, 0.5}, {true, true}},
        {{-INFINITY, -INFINITY}, {INFINITY, INFINITY}, {-1.2, 1}, {1, 1}, {false, false}},
        {{-5, -5}, {5, 5}, {-5, -5}, {1, 1}, {false, false}},
        {{0, 0}, {2, 2}, {0, 2}, {1, 1}, {false, false}},
        /* starts held at the wrong bound and has to leave it */
        {{0.2, -5}, {0.9, 5}, {0.2, 5}, {0.9, 0.81}, {true, false}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const struct solver_problem problem = {.parameter_count = 2,
                                               .residual_count = 2,
                                               .evaluate = rosenbrock,
                                               .low = cases[i].low,
                                               .high = cases[i].high};
        struct arena arena = {0};
        struct solver_summary summary;
        struct error error;
        double p[2] = {cases[i].start[0], cases[i].start[1]};
        CHECK(solver_run(&problem, &usual, p, &arena, &summary, &error));
        CHECK(summary.status == SOLVER_CONVERGED);
        for (int j = 0; j < 2; j++) {
            CHECK_NEAR(p[j], cases[i].best[j], 1e-10, "parameter in bounds");
            CHECK(summary.at_bound[j] == cases[i].at_bound[j]);
            CHECK(isnan(summary.standard_error[j]) || !cases[i].at_bound[j]);
        }
        arena_free(&arena);
    }
}

/* A line y = a + b x through points of which some are far off. */
struct line {
    double x[12], y[12];
    double a_factor; /* of the second parameter's derivative: 0 makes it undetermined */
};

static bool line_residuals(void *context, const double *p, double *r, double *jacobian)
{
    const struct line *line = context;
    for (int i = 0; i < 12; i++) {
        r[i] = p[0] + line->a_factor * p[1] * line->x[i] - line->y[i];
        if (jacobian != NULL) {
            jacobian[2 * i] = 1;
            jacobian[2 * i + 1] = line->a_factor * line->x[i];
        }
    }
    return true;
}

static struct line true_line(void)
{
    struct line line = {.a_factor = 1};
    for (int i = 0; i < 12; i++) {
        line.x[i] = i;
        line.y[i] = 2 + 3 * i;
    }
    return line;
}

/* Where the derivative of the loss's sum is 0: checked by the condition itself. */
static void test_losses(enum solver_engine engine)
{
    const struct solver_options usual = {.engine = engine};
    static const enum solver_loss losses[] = {LOSS_HUBER, LOSS_SOFT_L1, LOSS_CAUCHY};
    for (int k = 0; k < 3; k++) {
        struct line line = true_line();
        struct solver_block blocks[12];
        line.y[3] += 50;
        line.y[9] -= 80;
        for (int i = 0; i < 12; i++) {
            blocks[i] = (struct solver_block){1, losses[k], 0.5};
        }
        const struct solver_problem problem = {.parameter_count = 2,
                                               .residual_count = 12,
                                               .evaluate = line_residuals,
                                               .context = &line,
                                               .blocks = blocks,
                                               .block_count = 12};
        struct arena arena = {0};
        struct solver_summary summary;
        struct error error;
        double p[2] = {0, 0}, sums[2] = {0, 0};
        CHECK(solver_run(&problem, &usual, p, &arena, &summary, &error));
        CHECK(summary.status == SOLVER_CONVERGED);
        CHECK_NEAR(p[0], 2, 0.7, "robust intercept");
        CHECK_NEAR(p[1], 3, 0.1, "robust slope");
        for (int i = 0; i < 12; i++) {
            double r = p[0] + p[1] * line.x[i] - line.y[i], t = r * r / 0.25;
            double weight = k == 0 ? fmin(1, 1 / sqrt(t)) : k == 1 ? 1 / sqrt(1 + t) : 1 / (1 + t);
            sums[0] += weight * r;
            sums[1] += weight * r * line.x[i];
        }
        CHECK_NEAR(sums[0], 0, 1e-6, "stationary in the intercept");
        CHECK_NEAR(sums[1], 0, 1e-5, "stationary in the slope");
        arena_free(&arena);
    }
}

/* (X^T X)^-1 of x = 0..11 by hand: n = 12, sum x = 66, sum x^2 = 506, determinant 1716. */
static void test_covariance(enum solver_engine engine)
{
    const struct solver_options usual = {.engine = engine};
    struct line line = true_line();
    const double noise[12] = {1, -1, 1, -1, 1, -1, 1, -1, 1, -1, 1, -1};
    for (int i = 0; i < 12; i++) {
        line.y[i] += noise[i];
    }
    const struct solver_problem problem = {
        .parameter_count = 2, .residual_count = 12, .evaluate = line_residuals, .context = &line};
    struct arena arena = {0};
    struct solver_summary summary;
    struct error error;
    double p[2] = {0, 0};
    CHECK(solver_run(&problem, &usual, p, &arena, &summary, &error));
    double variance = 2 * summary.final_cost / 10;
    CHECK_RELATIVE(summary.covariance[0], variance * 506 / 1716, 1e-12, "var a");
    CHECK_RELATIVE(summary.covariance[1], -variance * 66 / 1716, 1e-12, "cov a b");
    CHECK_RELATIVE(summary.covariance[3], variance * 12 / 1716, 1e-12, "var b");
    CHECK(summary.rank == 2 && !summary.undetermined[0] && !summary.undetermined[1]);
    /* a parameter that nothing depends on is named, and the other keeps its error */
    line.a_factor = 0;
    p[0] = p[1] = 0;
    CHECK(solver_run(&problem, &usual, p, &arena, &summary, &error));
    CHECK(summary.rank == 1 && summary.undetermined[1] && !summary.undetermined[0]);
    CHECK(isnan(summary.standard_error[1]) && summary.standard_error[0] > 0);
    arena_free(&arena);
}

/* Counts the iterations; stops at the third. */
static bool stop_at_three(void *context, const struct solver_progress *progress)
{
    double *least = context;
    CHECK(progress->cost <= *least);
    *least = progress->cost;
    return progress->iteration < 3;
}

static void test_interrupt(enum solver_engine engine)
{
    const struct solver_problem problem = {
        .parameter_count = 2, .residual_count = 2, .evaluate = rosenbrock};
    double least = INFINITY;
    const struct solver_options options = {
        .engine = engine, .progress = stop_at_three, .progress_context = &least};
    struct arena arena = {0};
    struct solver_summary summary;
    struct error error;
    double p[2] = {-1.2, 1}, r[2];
    CHECK(solver_run(&problem, &options, p, &arena, &summary, &error));
    CHECK(summary.status == SOLVER_STOPPED && summary.iterations == 3);
    rosenbrock(NULL, p, r, NULL);
    CHECK_NEAR((r[0] * r[0] + r[1] * r[1]) / 2, least, 1e-15, "the best so far is kept");
    const struct solver_options few = {.engine = engine, .iterations = 2};
    double q[2] = {-1.2, 1};
    CHECK(solver_run(&problem, &few, q, &arena, &summary, &error));
    CHECK(summary.status == SOLVER_LIMIT && summary.iterations == 2);
    CHECK(summary.final_cost <= summary.initial_cost);
    arena_free(&arena);
}

/* No value where x < 0.8: steps into it are taken back. */
static bool partial(void *context, const double *p, double *r, double *jacobian)
{
    (void)context;
    double root = sqrt(p[0] - 0.8);
    r[0] = root - 0.1;
    if (jacobian != NULL) {
        jacobian[0] = 0.5 / root;
    }
    return true;
}

static void test_holes(enum solver_engine engine)
{
    const struct solver_options usual = {.engine = engine};
    const struct solver_problem problem = {
        .parameter_count = 1, .residual_count = 1, .evaluate = partial};
    struct arena arena = {0};
    struct solver_summary summary;
    struct error error;
    double p[1] = {50};
    CHECK(solver_run(&problem, &usual, p, &arena, &summary, &error));
    CHECK_NEAR(p[0], 0.81, 1e-8, "found across the hole");
    p[0] = 0.5;
    CHECK(!solver_run(&problem, &usual, p, &arena, &summary, &error));
    CHECK(strstr(error.message, "cannot begin") != NULL);
    arena_free(&arena);
}

static void check_refused(struct solver_problem problem, double x, double y, const char *word)
{
    struct arena arena = {0};
    struct solver_summary summary;
    struct error error;
    double p[2] = {x, y};
    CHECK(!solver_run(&problem, NULL, p, &arena, &summary, &error));
    CHECK(error.code == ERROR_DOMAIN);
    CHECK(strstr(error.message, word) != NULL);
    arena_free(&arena);
}

static void test_refusals(void)
{
    const double low[2] = {0, 0}, high[2] = {1, 1}, crossed[2] = {-1, 1};
    const struct solver_block bad_scale[1] = {{2, LOSS_HUBER, 0}}, short_block[1] = {{1, 0, 0}};
    const struct solver_problem sound = {
        .parameter_count = 2, .residual_count = 2, .evaluate = rosenbrock};
    struct solver_problem problem = sound;
    check_refused(problem, NAN, 0, "begins at nan");
    check_refused(problem, 0, INFINITY, "begins at inf");
    problem.low = low;
    problem.high = crossed;
    check_refused(problem, 0, 0, "bounds");
    problem.high = high;
    check_refused(problem, 2, 0, "outside its bounds");
    problem = sound;
    problem.residual_count = 1;
    check_refused(problem, 0, 0, "do not fix");
    problem.residual_count = 0;
    check_refused(problem, 0, 0, "nothing to fit");
    problem = sound;
    problem.blocks = bad_scale;
    problem.block_count = 1;
    check_refused(problem, 0, 0, "scale");
    problem.blocks = short_block;
    check_refused(problem, 0, 0, "blocks have 1");
}

static inline void test_solver(enum solver_engine engine)
{
    CHECK(solver_has(engine));
    test_nist(engine);
    test_sides(engine);
    test_bounds(engine);
    test_losses(engine);
    test_covariance(engine);
    test_interrupt(engine);
    test_holes(engine);
    test_refusals();
}

#endif
