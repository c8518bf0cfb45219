/* tests/unit/test_second_order.c - quadratic forms of figures, by functions that are quadratic. */
/* SPDX-License-Identifier: MIT */
#include "check.h"

#include "base/processor.h"
#include "base/random.h"
#include "design/tolerance/second_order.h"
#include "optics/surface.h"

#include <string.h>

enum { ERRORS = 7, FIGURES = 3, RESIDUALS = 5 };

/* Some number between -1 and 1. */
static double number(uint64_t which)
{
    return 2 * random_unit(7, which, 0) - 1;
}

/* The root of a sum of squares of linear functions; a quadratic function; one that is cubic. */
static bool trial(void *context, const double *p, double *figures, struct error *why)
{
    (void)context;
    double sum = 0;
    for (uint64_t k = 0; k < RESIDUALS; k++) {
        double residual = number(k);
        for (uint64_t i = 0; i < ERRORS; i++) {
            residual += 0.1 * number(100 + k * ERRORS + i) * p[i];
        }
        sum += residual * residual;
    }
    figures[0] = sqrt(sum);
    figures[1] = 3;
    figures[2] = 2 + 0.5 * p[0] + 0.25 * p[0] * p[0] * p[0];
    for (uint64_t i = 0; i < ERRORS; i++) {
        figures[1] += number(200 + i) * p[i];
        for (uint64_t j = 0; j <= i; j++) {
            figures[1] += number(300 + i * ERRORS + j) * p[i] * p[j];
        }
    }
    return p[1] < 5 || fail(why, ERROR_DOMAIN, "too much");
}

static const bool is_root[FIGURES] = {true, false, false};
static const char *const names[ERRORS] = {"R1", "R2", "R3", "t1", "t2", "t3", "t4"};
static const struct second_order_problem problem = {.trial = trial,
                                                    .error_count = ERRORS,
                                                    .figure_count = FIGURES,
                                                    .judged_count = FIGURES,
                                                    .is_root = is_root,
                                                    .names = names};

static void check_trials(void)
{
    struct arena arena = {0};
    struct second_order differential;
    struct error error = {.code = ERROR_NONE};
    CHECK(second_order_open(&problem, &arena, &differential, &error));
    double errors[ERRORS * SECOND_ORDER_LANES], figures[FIGURES * SECOND_ORDER_LANES];
    for (size_t i = 0; i < ERRORS * (size_t)SECOND_ORDER_LANES; i++) {
        errors[i] = number(1000 + i);
    }
    second_order_trials(&differential, errors, figures);
    for (size_t l = 0; l < SECOND_ORDER_LANES; l++) {
        double p[ERRORS], expected[FIGURES];
        for (size_t i = 0; i < ERRORS; i++) {
            p[i] = errors[i * SECOND_ORDER_LANES + l];
        }
        CHECK(trial(NULL, p, expected, &error));
        for (size_t f = 0; f < 2; f++) {
            CHECK_NEAR(figures[f * SECOND_ORDER_LANES + l], expected[f], 1e-12, "a trial");
        }
    }
    /* of a cubic function the slope has no error */
    CHECK_NEAR(differential.forms[2].slope[0], 0.5, 1e-14, "slope");
    arena_free(&arena);
}

/* Every set of instructions gives the same bits. */
static void check_sets(void)
{
    enum { COUNT = 20 };
    static double rows[COUNT * (COUNT + 3) / 2], errors[COUNT * SECOND_ORDER_LANES];
    double sums[3][SECOND_ORDER_LANES] = {{0}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        rows[i] = number(i);
    }
    for (size_t i = 0; i < sizeof errors / sizeof *errors; i++) {
        errors[i] = number(5000 + i);
    }
    kernel_differential_sse2(rows, COUNT, errors, sums[0]);
    if (processor_has_avx2()) {
        kernel_differential_avx2(rows, COUNT, errors, sums[1]);
        CHECK(memcmp(sums[0], sums[1], sizeof sums[0]) == 0);
    }
    if (processor_has_avx512()) {
        kernel_differential_avx512(rows, COUNT, errors, sums[2]);
        CHECK(memcmp(sums[0], sums[2], sizeof sums[0]) == 0);
    }
}

/*
 * p0 + 2 p1 + 3 p0 p1 + p2^2 of evenly spread numbers: variances 1/3, 4/3, 9/9 and 1/5 - 1/9, by
 * hand.
 */
static bool by_hand(void *context, const double *p, double *figures, struct error *why)
{
    (void)context;
    (void)why;
    figures[0] = p[0] + 2 * p[1] + 3 * p[0] * p[1] + p[2] * p[2];
    return true;
}

static void check_shares(void)
{
    const struct second_order_problem simple = {.trial = by_hand,
                                                .error_count = 4,
                                                .figure_count = 1,
                                                .judged_count = 1,
                                                .is_root = is_root + 1,
                                                .names = names};
    const struct perturbation_moments even = {1.0 / 3, 1.0 / 5};
    const struct perturbation_moments moments[4] = {even, even, even, even};
    struct arena arena = {0};
    struct second_order differential;
    struct second_order_share shares[4];
    struct error error = {.code = ERROR_NONE};
    CHECK(second_order_open(&simple, &arena, &differential, &error));
    const double all = 1.0 / 3 + 4.0 / 3 + 1 + 4.0 / 45;
    const double deviation = second_order_shares(&differential, moments, LENS_NONE, shares);
    CHECK_NEAR(deviation * deviation, all, 1e-13, "variance");
    CHECK_NEAR(shares[0].first, 1 / 3.0 / all, 1e-13, "first");
    CHECK_NEAR(shares[0].total, 4 / 3.0 / all, 1e-13, "total");
    CHECK_NEAR(shares[1].first, 4 / 3.0 / all, 1e-13, "first");
    CHECK_NEAR(shares[1].total, 7 / 3.0 / all, 1e-13, "total");
    CHECK_NEAR(shares[2].first, 4 / 45.0 / all, 1e-13, "first");
    CHECK_NEAR(shares[2].total, 4 / 45.0 / all, 1e-13, "total");
    CHECK_NEAR(shares[3].total, 0, 1e-13, "of what does nothing");
    arena_free(&arena);
}

/* Two that are judged, p0 + p0^2 and 3 p0 - p0 p1, and one beside them, 4 p1. */
static bool three(void *context, const double *p, double *figures, struct error *why)
{
    (void)context;
    (void)why;
    figures[0] = p[0] + p[0] * p[0];
    figures[1] = 3 * p[0] - p[0] * p[1];
    figures[2] = 4 * p[1];
    return true;
}

/* The mean of the judged is 2 p0 + p0^2/2 - p0 p1/2: variances 4/3, (1/5 - 1/9)/4 and 1/36. */
static void check_judged(void)
{
    static const bool none[3] = {false, false, false};
    const struct second_order_problem judged = {.trial = three,
                                                .error_count = 2,
                                                .figure_count = 3,
                                                .judged_count = 2,
                                                .is_root = none,
                                                .names = names};
    const struct perturbation_moments even = {1.0 / 3, 1.0 / 5}, moments[2] = {even, even};
    struct arena arena = {0};
    struct second_order differential;
    struct second_order_share shares[2];
    struct error error = {.code = ERROR_NONE};
    CHECK(second_order_open(&judged, &arena, &differential, &error));
    const double alone = 4.0 / 3 + 1.0 / 45, both = 1.0 / 36, all = alone + both;
    double deviation = second_order_shares(&differential, moments, LENS_NONE, shares);
    CHECK_NEAR(deviation, sqrt(all), 1e-13, "deviation of the mean");
    CHECK_NEAR(shares[0].first, alone / all, 1e-13, "first of the mean");
    CHECK_NEAR(shares[0].total, 1, 1e-13, "total of the mean");
    CHECK_NEAR(shares[1].first, 0, 1e-13, "first of the mean");
    CHECK_NEAR(shares[1].total, both / all, 1e-13, "total of the mean");
    deviation = second_order_shares(&differential, moments, 1, shares);
    CHECK_NEAR(deviation, sqrt(3 + 1 / 9.0), 1e-13, "deviation of one");
    CHECK_NEAR(shares[0].first, 27 / 28.0, 1e-13, "first of one");
    deviation = second_order_shares(&differential, moments, 2, shares);
    CHECK_NEAR(deviation, 4 / sqrt(3), 1e-13, "deviation of one that is not judged");
    CHECK_NEAR(shares[1].first, 1, 1e-13, "all of it by the second");
    /* unlike moments: 9 v + w', of 3 p0 - p0 p1 with v of p1 alone */
    const struct perturbation_moments unlike[2] = {{0.5, 0.4}, {0.2, 0.1}};
    deviation = second_order_shares(&differential, unlike, 1, shares);
    CHECK_NEAR(deviation * deviation, 9 * 0.5 + 0.5 * 0.2, 1e-13, "of unlike errors");
    CHECK_NEAR(shares[1].total, 0.1 / 4.6, 1e-13, "of unlike errors");
    arena_free(&arena);
}

/* The root of 1 - 1.5 p, of 0 beyond: its square is developed as 1 - 19/12 p, by hand. */
static bool ending(void *context, const double *p, double *figures, struct error *why)
{
    (void)context;
    (void)why;
    figures[0] = sqrt(fmax(1 - 1.5 * p[0], 0));
    return true;
}

static void check_ending(void)
{
    const struct second_order_problem ends = {.trial = ending,
                                              .error_count = 1,
                                              .figure_count = 1,
                                              .judged_count = 1,
                                              .is_root = is_root,
                                              .names = names};
    struct arena arena = {0};
    struct second_order differential;
    struct error error = {.code = ERROR_NONE};
    double errors[SECOND_ORDER_LANES], figures[SECOND_ORDER_LANES];
    CHECK(second_order_open(&ends, &arena, &differential, &error));
    for (size_t l = 0; l < SECOND_ORDER_LANES; l++) {
        errors[l] = (double)l / SECOND_ORDER_LANES;
    }
    second_order_trials(&differential, errors, figures);
    for (size_t l = 0; l < SECOND_ORDER_LANES; l++) {
        CHECK_NEAR(figures[l], sqrt(fmax(1 - 19 / 12.0 * errors[l], 0)), 1e-13, "0 at least");
    }
    arena_free(&arena);
}

static bool never(void *context, const double *p, double *figures, struct error *why)
{
    figures[0] = p[1];
    (void)context;
    return p[1] == 0 || fail(why, ERROR_DOMAIN, "a ray is lost");
}

static void check_failure(void)
{
    struct second_order_problem simple = problem;
    struct arena arena = {0};
    struct second_order differential;
    struct error error = {.code = ERROR_NONE};
    simple.trial = never;
    simple.figure_count = 1;
    CHECK(!second_order_open(&simple, &arena, &differential, &error));
    CHECK_TEXT(error.message, "R2 of 0.5 times its tolerance: a ray is lost");
    arena_free(&arena);
}

static void look(struct watch *watch)
{
    atomic_store(&watch->is_ended, true);
}

static void check_stopped(void)
{
    struct watch watch = {.is_busy = ATOMIC_FLAG_INIT, .look = look};
    struct second_order_problem watched = problem;
    struct arena arena = {0};
    struct second_order differential;
    struct error error = {.code = ERROR_NONE};
    watched.watch = &watch;
    CHECK(!second_order_open(&watched, &arena, &differential, &error));
    CHECK(strstr(error.message, "interrupted before") != NULL);
    arena_free(&arena);
}

int main(void)
{
    check_trials();
    check_sets();
    check_shares();
    check_judged();
    check_ending();
    check_failure();
    check_stopped();
    return check_report();
}
