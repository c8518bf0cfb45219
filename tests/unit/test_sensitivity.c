/* tests/unit/test_sensitivity.c - costs of single errors, by functions that are known. */
/* SPDX-License-Identifier: MIT */
#include "check.h"

#include "design/tolerance/sensitivity.h"

enum { ERRORS = 4 };

/* sqrt(1 + 0.2 p0 + p1^2), and 5 + p0 - 3 p2 + p2^2 + p2^3/2; too much of p3 is no lens. */
static bool trial(void *context, const double *p, double *figures, struct error *why)
{
    (void)context;
    figures[0] = sqrt(1 + 0.2 * p[0] + p[1] * p[1]);
    figures[1] = 5 + p[0] - 3 * p[2] + p[2] * p[2] + p[2] * p[2] * p[2] / 2;
    return p[3] < 0.75 || fail(why, ERROR_DOMAIN, "a ray is lost");
}

static const bool is_root[] = {true, false};
static const char *const names[ERRORS] = {"R1", "R2", "t1", "t2"};
static const struct second_order_problem problem = {
    .trial = trial, .error_count = ERRORS, .figure_count = 2, .is_root = is_root, .names = names};

static void check_table(void)
{
    struct arena arena = {0};
    struct sensitivity table[ERRORS][2];
    const double nominal[] = {1, 5};
    const char *failure;
    sensitivity_find(&problem, nominal, &arena, table[0], &failure);
    CHECK_NEAR(table[0][0].plus, sqrt(1.2) - 1, 1e-15, "plus");
    CHECK_NEAR(table[0][0].minus, sqrt(0.8) - 1, 1e-15, "minus");
    CHECK_NEAR(table[0][0].linear, 0.1, 1e-15, "linear");
    CHECK_NEAR(table[0][0].quadratic, (sqrt(1.2) + sqrt(0.8)) / 2 - 1, 1e-15, "quadratic");
    CHECK_NEAR(table[1][0].linear, 0, 1e-15, "linear");
    CHECK(table[1][0].plus == table[1][0].minus);
    CHECK_NEAR(table[2][1].linear, -3, 1e-13, "linear");
    CHECK_NEAR(table[2][1].quadratic, 1, 1e-14, "quadratic");
    CHECK_NEAR(table[2][1].plus, -1.5, 1e-14, "plus");
    CHECK_NEAR(table[2][1].minus, 3.5, 1e-14, "minus");
    CHECK(isnan(table[3][0].plus) && isnan(table[3][0].linear) && table[3][0].minus == 0);
    CHECK_TEXT(failure, "t2 of 1 times its tolerance: a ray is lost");
    /* a root of 0 has no derivative; its changes are what they are */
    const double zero[] = {0, 5};
    sensitivity_find(&problem, zero, &arena, table[0], &failure);
    CHECK(isnan(table[0][0].linear));
    CHECK_NEAR(table[0][0].plus, sqrt(1.2), 1e-15, "plus");
    CHECK_NEAR(table[2][1].linear, -3, 1e-13, "linear");
    arena_free(&arena);
}

/* Whoever stops the work after its fifth trial. */
static void look(struct watch *watch)
{
    atomic_store(&watch->is_ended, atomic_load(&watch->done) > 5);
}

/* Only rows that are complete count: of four trials each. */
static void check_stopped(void)
{
    struct arena arena = {0};
    struct watch watch = {.is_busy = ATOMIC_FLAG_INIT, .look = look};
    struct second_order_problem watched = problem;
    struct sensitivity table[ERRORS][2];
    const double nominal[] = {1, 5};
    const char *failure;
    watched.watch = &watch;
    CHECK(sensitivity_find(&watched, nominal, &arena, table[0], &failure) == 1);
    CHECK(atomic_load(&watch.done) == 6);
    CHECK(sensitivity_find(&problem, nominal, &arena, table[0], &failure) == ERRORS);
    arena_free(&arena);
}

/* How much the second figure is off. */
static double off(void *context, const double *figures)
{
    (void)context;
    return fabs(figures[1] - 5);
}

static bool linear(void *context, const double *p, double *figures, struct error *why)
{
    (void)context;
    (void)why;
    figures[0] = 0;
    figures[1] = 5 + 1 * p[0] - 2 * p[1] + 4 * p[2] + 100 * p[3];
    return true;
}

static bool bent(void *context, const double *p, double *figures, struct error *why)
{
    (void)context;
    (void)why;
    figures[0] = 0;
    figures[1] = 5 + 2 * p[0] + p[0] * p[0];
    return true;
}

/* Four of slopes 1, 2, 4 and 100 that cost 2 together. */
static void check_inverse(void)
{
    struct second_order_problem of = problem;
    of.trial = linear;
    struct arena arena = {0};
    struct inverse answers[ERRORS];
    const double wide[] = {1e-6, 1e-6, 1e-6, 1e-6}, far[] = {1e6, 1e6, 1e6, 1e6};
    const size_t thing[] = {0, 1, 2, 3}, pairs[] = {0, 0, 1, 1};
    struct inverse_question question = {.problem = &of,
                                        .cost = off,
                                        .drop = 2,
                                        .thing = thing,
                                        .thing_count = ERRORS,
                                        .low = wide,
                                        .high = far};
    const double slopes[] = {1, 2, 4, 100};
    CHECK_NEAR(inverse_find(&question, &arena, answers), 2, 1e-6, "free");
    for (size_t i = 0; i < ERRORS; i++) {
        CHECK(answers[i].limit == INVERSE_FREE);
        CHECK_RELATIVE(answers[i].factor, 1 / slopes[i], 1e-6, "an even share");
        CHECK_NEAR(answers[i].cost, 1, 1e-6, "which it costs");
    }
    /* the last costs 1.2 at least, the first 0.3 at most: 2^2 - 1.2^2 - 0.3^2 is left for two */
    const double low[] = {1e-6, 1e-6, 1e-6, 0.012}, high[] = {0.3, 1e6, 1e6, 1e6};
    const double share = sqrt((4 - 1.44 - 0.09) / 2);
    question.low = low;
    question.high = high;
    CHECK_NEAR(inverse_find(&question, &arena, answers), 2, 1e-6, "limited");
    CHECK(answers[0].limit == INVERSE_LOOSEST && answers[0].factor == 0.3);
    CHECK(answers[3].limit == INVERSE_TIGHTEST && answers[3].factor == 0.012);
    CHECK_NEAR(answers[0].cost, 0.3, 1e-12, "of the loosest");
    CHECK_NEAR(answers[3].cost, 1.2, 1e-12, "of the tightest");
    CHECK_NEAR(answers[1].cost, share, 1e-6, "of the rest");
    CHECK_RELATIVE(answers[1].factor, share / 2, 1e-6, "the rest");
    CHECK_RELATIVE(answers[2].factor, share / 4, 1e-6, "the rest");
    /* two errors of one tolerance cost the root of the sum of their squares */
    question.thing = pairs;
    question.thing_count = 2;
    question.low = wide;
    question.high = far;
    CHECK_NEAR(inverse_find(&question, &arena, answers), 2, 1e-6, "pairs");
    CHECK_RELATIVE(answers[0].factor, sqrt(2) / sqrt(1 + 4), 1e-6, "of 1 and 2");
    CHECK_RELATIVE(answers[1].factor, sqrt(2) / sqrt(16 + 10000), 1e-6, "of 4 and 100");
    question.thing = thing;
    question.thing_count = ERRORS;
    question.low = low;
    question.high = high;
    /* what cannot be had: all at their tightest */
    question.drop = 1;
    CHECK_NEAR(inverse_find(&question, &arena, answers), 1.2, 1e-5, "too much");
    CHECK(answers[3].limit == INVERSE_TIGHTEST && answers[3].factor == 0.012);
    CHECK_RELATIVE(answers[1].factor, 1e-3 / 2, 1e-6, "a thousandth of the drop");
    /* what costs nothing is as loose as can be, whatever the others cost */
    const double near[] = {0.3, 1e-5, 1e6, 1e6};
    question.high = near;
    inverse_find(&question, &arena, answers);
    CHECK(answers[1].limit == INVERSE_LOOSEST && answers[1].factor == 1e-5);
    /* of two unlike ends the worse: 5 + 2 p + p^2 costs 3 p where p is 1, and 1 at -1 */
    of.trial = bent;
    question.drop = 8;
    question.high = far;
    question.thing_count = 1;
    CHECK_NEAR(inverse_find(&question, &arena, answers), 8, 1e-6, "bent");
    CHECK_RELATIVE(answers[0].factor, 2.0, 1e-6, "2 p + p^2 = 8");
    /* without figures at the tightest there is no answer, at the loosest alone there is */
    of.trial = trial;
    const double loose[] = {1e-6, 1e-6, 1e-6, 0.74}, lost[] = {1e-6, 1e-6, 1e-6, 0.75};
    question.thing_count = ERRORS;
    question.low = loose;
    CHECK(isfinite(inverse_find(&question, &arena, answers)));
    CHECK(answers[3].limit == INVERSE_FREE && answers[3].cost == 0);
    CHECK_RELATIVE(answers[3].factor, 0.75, 1e-6, "where figures end");
    question.low = lost;
    CHECK(isnan(inverse_find(&question, &arena, answers)));
    struct watch watch = {.is_busy = ATOMIC_FLAG_INIT, .look = look};
    of.trial = linear;
    question.low = low;
    of.watch = &watch;
    CHECK(isnan(inverse_find(&question, &arena, answers)));
    arena_free(&arena);
}

int main(void)
{
    check_table();
    check_stopped();
    check_inverse();
    return check_report();
}
