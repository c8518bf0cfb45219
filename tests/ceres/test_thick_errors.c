/* tests/ceres/test_thick_errors.c - standard errors of thick lenses are those of other fields. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "design/fit/jackknife.h"
#include "subject.h"

#include <stdint.h>

enum { FIELDS = 17 };

/* Uniform in 0 .. 1, the same every time: splitmix64. */
static double draw(uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

/* The mean by least squares: its jackknife is the textbook's s/sqrt(n), of groups that of sums. */
static void test_mean(void)
{
    const double data[6] = {3, 5, 4, 8, 1, 3}, mean = 4;
    const size_t alone[6] = {0, 1, 2, 3, 4, 5}, pairs[6] = {0, 0, 1, 1, 2, 2};
    double residuals[6], jacobian[6], variance;
    struct arena arena = {0};
    for (int i = 0; i < 6; i++) {
        residuals[i] = mean - data[i];
        jacobian[i] = 1;
    }
    CHECK(jackknife_covariance(&(struct jackknife_fit){residuals, jacobian, 6, 1, alone, 6}, &arena,
                               &variance));
    /* squares 1 1 0 16 9 1 = 28; 28/(6 5) */
    CHECK_RELATIVE(variance, 28.0 / 30, 1e-14, "of the mean of six");
    CHECK(jackknife_covariance(&(struct jackknife_fit){residuals, jacobian, 6, 1, pairs, 3}, &arena,
                               &variance));
    /* means without a pair: 4, 3, 5; 2/3 (0 + 1 + 1) */
    CHECK_RELATIVE(variance, 4.0 / 3, 1e-14, "of the mean of three pairs");
    const size_t one[6] = {0, 0, 0, 0, 0, 0};
    CHECK(!jackknife_covariance(&(struct jackknife_fit){residuals, jacobian, 6, 1, one, 1}, &arena,
                                &variance));
    CHECK(isnan(variance));
    arena_free(&arena);
}

/* A line through points of which one alone fixes the slope: without it nothing does. */
static void test_leverage(void)
{
    const double residuals[4] = {0.1, -0.1, 0.05, 0};
    const double jacobian[8] = {1, 0, 1, 0, 1, 0, 1, 1};
    const size_t alone[4] = {0, 1, 2, 3};
    double covariance[4];
    struct arena arena = {0};
    CHECK(!jackknife_covariance(&(struct jackknife_fit){residuals, jacobian, 4, 2, alone, 4},
                                &arena, covariance));
    CHECK(isnan(covariance[0]) && isnan(covariance[3]));
    arena_free(&arena);
}

/* Fields drawn at random from those there are, as often as they come: Efron's bootstrap. */
static void redraw(const struct subject *subject, const double *own, uint64_t *state,
                   double *weights)
{
    size_t times[FIELDS] = {0};
    for (int i = 0; i < FIELDS; i++) {
        times[(size_t)(draw(state) * FIELDS)]++;
    }
    for (size_t i = 0; i < subject->rays.count; i++) {
        weights[i] = own[i] * (double)times[subject->field[i]];
    }
}

/*
 * What f, H and H' would be with other fields: their spread over 300 redrawn bundles, against the
 * stated standard error.
 */
static void test_bootstrap(const char *name, double fnumber, double field, size_t terms,
                           double least)
{
    enum { DRAWS = 300 };
    struct arena arena = {0};
    struct subject subject;
    struct thick_fit fit, other;
    struct error error;
    uint64_t state = 5;
    double sum[3] = {0}, squares[3] = {0};
    const struct subject_rays wanted = {
        .aperture = {APERTURE_FNUMBER, fnumber}, .field = field, .field_count = FIELDS, .rays = 18};
    CHECK(subject_open(name, &wanted, &arena, &subject, &error));
    const double *own = subject.weight;
    subject.task.distortions = terms;
    CHECK(thick_fit(&subject.task, &arena, &fit, &error));
    double *weights = ARENA_ARRAY(&arena, subject.rays.count, double);
    subject.rays.weight = weights;
    for (int k = 0; k < DRAWS; k++) {
        struct arena_mark mark = arena_mark(&arena);
        redraw(&subject, own, &state, weights);
        CHECK(subject_sum(&subject, &arena, &error));
        CHECK(thick_fit(&subject.task, &arena, &other, &error));
        for (int j = 0; j < 3; j++) {
            double off = other.parameters[j] - fit.parameters[j];
            sum[j] += off / DRAWS;
            squares[j] += off * off / DRAWS;
        }
        arena_reset(&arena, mark);
    }
    for (int j = 0; j < 3; j++) {
        double spread = sqrt(squares[j] - sum[j] * sum[j]);
        double ratio = fit.summary.standard_error[j] / spread;
        bool good = ratio > least && ratio < 1.25;
        check_at(good, __FILE__, __LINE__, "stated error over spread");
        if (!good) {
            printf("%s f/%g, %zu terms: %s: stated %.4g, spread %.4g\n", name, fnumber, terms,
                   fit.names[j], fit.summary.standard_error[j], spread);
        }
    }
    arena_free(&arena);
}

int main(void)
{
    test_mean();
    test_leverage();
    /* taken for independent rays, these were wrong by 0.05 to 24 times the spread */
    test_bootstrap("double-gauss", 2, 0.24, 0, 0.95);
    test_bootstrap("double-gauss", 2, 0.24, 2, 0.95);
    test_bootstrap("double-gauss", 8, 0.24, 2, 0.95);
    test_bootstrap("wide-35", 4, 0.6, 2, 0.95);
    test_bootstrap("cooke-triplet-50", 4, 0.3, 1, 0.95);
    /* first orders nearly cancel: 24 um of distortion against 24 um of focus */
    test_bootstrap("wide-35", 4, 0.6, 0, 0.6);
    return check_report();
}
