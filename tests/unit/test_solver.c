/* tests/unit/test_solver.c - damped least squares against certified values and classic problems. */
/* SPDX-License-Identifier: MIT */
#include "base/processor.h"
#include "classics.h"
#include "design/solver/solver_normal.h"
#include "design/solver/solver_step.h"
#include "solver_cases.h"

static void test_classics(void)
{
    for (size_t i = 0; i < sizeof classics / sizeof classics[0]; i++) {
        CHECK_NEAR(classic_minimum(&classics[i], SOLVER_DLS), classics[i].minimum,
                   classics[i].within, classics[i].name);
    }
}

/* Sums of products by hand, and the same bits with every instruction set. */
static void test_normal(void)
{
    enum { COLUMNS = 11, MOST = 300 };
    static double jacobian[MOST * COLUMNS], residuals[MOST], weights[MOST];
    struct arena arena = {0};
    for (size_t i = 0; i < MOST * COLUMNS; i++) {
        jacobian[i] = sin((double)i);
        residuals[i / COLUMNS] = cos(3.0 * (double)(i / COLUMNS));
        weights[i / COLUMNS] = 1 + 0.5 * sin(7.0 * (double)(i / COLUMNS));
    }
    for (size_t count = 1; count <= MOST; count = 2 * count + 1) {
        for (int weighted = 0; weighted < 2; weighted++) {
            const struct solver_rows rows = {count,
                                             COLUMNS,
                                             jacobian,
                                             residuals,
                                             weighted == 1 ? weights : NULL,
                                             solver_normal_room(COLUMNS, &arena)};
            double normal[3][COLUMNS * COLUMNS], gradient[3][COLUMNS];
            kernel_normal_sse2(&rows, normal[0], gradient[0]);
            solver_normal(&rows, normal[1], gradient[1]);
            if (processor_has_avx2()) {
                kernel_normal_avx2(&rows, normal[2], gradient[2]);
                CHECK(memcmp(normal[0], normal[2], sizeof normal[0]) == 0);
                CHECK(memcmp(gradient[0], gradient[2], sizeof gradient[0]) == 0);
            }
            CHECK(memcmp(normal[0], normal[1], sizeof normal[0]) == 0);
            CHECK(memcmp(gradient[0], gradient[1], sizeof gradient[0]) == 0);
            double corner = 0, last = 0;
            for (size_t r = 0; r < count; r++) {
                const double w = weighted == 1 ? weights[r] : 1;
                corner += w * jacobian[r * COLUMNS] * jacobian[r * COLUMNS + 10];
                last += w * jacobian[r * COLUMNS + 10] * residuals[r];
            }
            CHECK_NEAR(normal[0][10], corner, 1e-12, "normal equations");
            CHECK_NEAR(normal[0][10 * COLUMNS], corner, 1e-12, "their other half");
            CHECK_NEAR(gradient[0][10], last, 1e-12, "gradient");
        }
    }
    arena_free(&arena);
}

/* y = a + b x through (0, 0), (1, 1), (2, 3). */
static bool straight(void *context, const double *p, double *r, double *jacobian)
{
    (void)context;
    for (int i = 0; i < 3; i++) {
        r[i] = p[0] + p[1] * i - (i < 2 ? i : 3);
        if (jacobian != NULL) {
            jacobian[2 * i] = 1;
            jacobian[2 * i + 1] = i;
        }
    }
    return true;
}

/* One more point than parameters is enough to tell their errors: sums of squares by hand. */
static void test_one_degree(void)
{
    const struct solver_problem problem = {
        .parameter_count = 2, .residual_count = 3, .evaluate = straight};
    const struct solver_options options = {.engine = SOLVER_DLS};
    struct arena arena = {0};
    struct solver_summary summary;
    struct error error;
    double p[2] = {0, 0};
    CHECK(solver_run(&problem, &options, p, &arena, &summary, &error));
    CHECK(summary.degrees_of_freedom == 1);
    CHECK_NEAR(p[0], -1.0 / 6, 1e-12, "a");
    CHECK_NEAR(p[1], 1.5, 1e-12, "b");
    CHECK_NEAR(summary.standard_error[0], sqrt(5.0 / 36), 1e-12, "error of a");
    CHECK_NEAR(summary.standard_error[1], sqrt(1.0 / 12), 1e-12, "error of b");
    arena_free(&arena);
}

/* Planes a.x = b, of which those from WALLS_FIRST on count on one side only. */
enum { WALLS = 40, WALLS_ACROSS = 4 };
struct walls {
    double a[WALLS][WALLS_ACROSS], b[WALLS];
};

static bool walls_residuals(void *context, const double *x, double *r, double *jacobian)
{
    const struct walls *walls = context;
    for (int k = 0; k < WALLS; k++) {
        r[k] = -walls->b[k];
        for (int i = 0; i < WALLS_ACROSS; i++) {
            r[k] += walls->a[k][i] * x[i];
        }
    }
    if (jacobian != NULL) {
        memcpy(jacobian, walls->a, sizeof walls->a);
    }
    return true;
}

/*
 * Where walls stand close, a step that runs into one leaves another: what is linear on each side is
 * found at once all the same. At the least sum the gradient of what counts there is 0.
 */
static void test_many_walls(void)
{
    enum solver_side sides[WALLS] = {SIDE_BOTH};
    const struct solver_options options = {.engine = SOLVER_DLS};
    struct arena arena = {0};
    uint32_t word = 5;
    for (int k = WALLS_ACROSS; k < WALLS; k++) {
        sides[k] = k % 2 == 0 ? SIDE_ABOVE : SIDE_BELOW;
    }
    for (int trial = 0; trial < 100; trial++) {
        struct walls walls = {.b = {0}};
        for (int k = 0; k < WALLS; k++) {
            const double steep = k < WALLS_ACROSS ? 0.01 : 1;
            for (int i = 0; i <= WALLS_ACROSS; i++) {
                word = word * 1664525U + 1013904223U;
                const double one = ldexp(word, -31) - 1;
                *(i < WALLS_ACROSS ? &walls.a[k][i] : &walls.b[k]) = steep * one;
            }
        }
        const struct solver_problem problem = {.parameter_count = WALLS_ACROSS,
                                               .residual_count = WALLS,
                                               .evaluate = walls_residuals,
                                               .context = &walls,
                                               .scale = (const double[]){1, 1, 1, 1},
                                               .sides = sides};
        struct solver_summary summary;
        struct error error;
        double x[WALLS_ACROSS] = {5, -5, 5, -5}, r[WALLS];
        CHECK(solver_run(&problem, &options, x, &arena, &summary, &error));
        walls_residuals(&walls, x, r, NULL);
        for (int i = 0; i < WALLS_ACROSS; i++) {
            double gradient = 0;
            for (int k = 0; k < WALLS; k++) {
                const bool counts = sides[k] == SIDE_BOTH || (sides[k] == SIDE_ABOVE) == (r[k] > 0);
                gradient += counts ? r[k] * walls.a[k][i] : 0;
            }
            CHECK_NEAR(gradient, 0, 1e-9, "the gradient between walls");
        }
        CHECK(summary.iterations <= 12);
        arena_free(&arena);
    }
}

/*
 * One step among walls, of which some of Newton's steps go round in circles: where it ends, the sum
 * of squares rises to all sides, along bounds and away from them.
 */
static void test_sided_step(void)
{
    enum { ACROSS = 4, MANY = 12 };
    enum solver_side sides[MANY];
    double h[ACROSS * ACROSS] = {0};
    struct arena arena = {0};
    uint32_t word = 3;
    for (int k = 0; k < MANY; k++) {
        sides[k] = k % 2 == 0 ? SIDE_ABOVE : SIDE_BELOW;
    }
    const struct solver_problem problem = {
        .parameter_count = ACROSS, .residual_count = MANY, .sides = sides};
    for (int trial = 0; trial < 1000; trial++) {
        struct solver_sided sided;
        struct solver_step step = {.low = (const double[]){-INFINITY, -1, -0.1, -INFINITY},
                                   .high = (const double[]){INFINITY, 1, INFINITY, 0.2}};
        double residuals[MANY], g[ACROSS];
        solver_sided_open(&problem, &arena, &sided);
        solver_step_open(&step, ACROSS, 0, &arena);
        for (int k = 0; k < MANY; k++) {
            for (int i = 0; i <= ACROSS; i++) {
                word = word * 1664525U + 1013904223U;
                *(i < ACROSS ? &sided.slopes[k * ACROSS + i] : &residuals[k]) =
                    ldexp(word, -31) - 1;
            }
        }
        for (int i = 0; i < ACROSS; i++) {
            h[i * ACROSS + i] = 1e-4;
            g[i] = 0.01 * residuals[i];
        }
        CHECK(solver_sided_find(&sided, residuals, h, g, &step));
        for (int i = 0; i < ACROSS; i++) {
            const double *d = step.d;
            double rise = g[i] + h[i * ACROSS + i] * d[i];
            for (int k = 0; k < MANY; k++) {
                const double *a = sided.slopes + (size_t)k * ACROSS;
                const double r =
                    residuals[sided.at[k]] + a[0] * d[0] + a[1] * d[1] + a[2] * d[2] + a[3] * d[3];
                rise += (sides[k] == SIDE_ABOVE) == (r > 0) ? r * a[i] : 0;
            }
            CHECK(d[i] >= step.low[i] && d[i] <= step.high[i]);
            CHECK((d[i] <= step.low[i] && rise > 0) || (d[i] >= step.high[i] && rise < 0) ||
                  fabs(rise) < 1e-9);
        }
        arena_free(&arena);
    }
}

/* (x - 3)^2, with derivatives up to 1 only: the best that has them is just there. */
static bool smooth_up_to_1(void *context, const double *x, double *residuals, double *jacobian)
{
    (void)context;
    residuals[0] = x[0] - 3;
    if (jacobian != NULL) {
        jacobian[0] = x[0] <= 1 ? 1 : NAN;
    }
    return jacobian == NULL || x[0] <= 1;
}

static void test_no_derivatives(void)
{
    const struct solver_problem problem = {.parameter_count = 1,
                                           .residual_count = 1,
                                           .evaluate = smooth_up_to_1,
                                           .scale = (const double[]){1}};
    const struct solver_options options = {.engine = SOLVER_DLS};
    struct arena arena = {0};
    struct solver_summary summary;
    struct error error;
    double x = 0;
    CHECK(solver_run(&problem, &options, &x, &arena, &summary, &error));
    CHECK(x > 0.99 && x <= 1 && isfinite(summary.final_cost));
    arena_free(&arena);
}

/* 3, met on its side, and a condition that is off by 2. */
static bool three_residuals(void *context, const double *x, double *residuals, double *jacobian)
{
    (void)context;
    (void)x;
    (void)jacobian;
    residuals[0] = 3;
    residuals[1] = -1;
    residuals[2] = -2;
    return true;
}

/* Where nothing is left to vary a lean answer says how good it is; another is refused. */
static void test_no_parameters(void)
{
    static const enum solver_side sides[] = {SIDE_BOTH, SIDE_ABOVE, SIDE_BOTH};
    const struct solver_problem problem = {
        .residual_count = 3, .exact_count = 1, .evaluate = three_residuals, .sides = sides};
    struct solver_options options = {.engine = SOLVER_DLS, .lean = true};
    struct arena arena = {0};
    struct solver_summary summary;
    struct error error;
    double none[1] = {0};
    CHECK(solver_run(&problem, &options, none, &arena, &summary, &error));
    CHECK(summary.status == SOLVER_CONVERGED && summary.iterations == 0);
    CHECK(summary.final_cost == 4.5 && summary.excess == 2);
    options.lean = false;
    CHECK(!solver_run(&problem, &options, none, &arena, &summary, &error));
    arena_free(&arena);
}

int main(void)
{
    test_normal();
    test_no_parameters();
    test_no_derivatives();
    test_sided_step();
    test_one_degree();
    test_many_walls();
    test_solver(SOLVER_DLS);
    test_classics();
    return check_report();
}
