/* tests/unit/test_trial_statistics.c - counted figures: exact sums, moments, percentiles, in any order. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "design/tolerance/trial_statistics.h"

#include <math.h>

static struct arena arena;

static void check_sums(void)
{
    static const double numbers[] = {1e300, 1, -1e300, 3e-310, 0x1p-1074, -2.5, 1e16, 1, -1e16};
    const size_t count = sizeof numbers / sizeof numbers[0];
    struct exact_accumulator forth = {{0}}, back = {{0}}, half = {{0}};
    for (size_t i = 0; i < count; i++) {
        exact_accumulator_add(&forth, numbers[i]);
        exact_accumulator_add(i % 2 == 0 ? &back : &half, numbers[count - 1 - i]);
    }
    exact_accumulator_join(&back, &half);
    CHECK_NEAR(exact_accumulator_value(&forth), -0.5, 1e-16,
               "by hand: what is left is 1 - 2.5 + 1");
    CHECK(exact_accumulator_value(&forth) == exact_accumulator_value(&back));
    struct exact_accumulator small = {{0}};
    exact_accumulator_add(&small, 0x1p-1074);
    exact_accumulator_add(&small, 0x1p-1074);
    CHECK(exact_accumulator_value(&small) == 0x1p-1073);
}

/* 0 .. count - 1 in hundredths about 5, in some order. */
static void fill(struct trial_statistics *tally, uint64_t count, uint64_t from, uint64_t step)
{
    for (uint64_t i = from; i < count; i += step) {
        trial_statistics_add(tally, 5 + 0.01 * (double)(i * 7919 % count));
    }
}

static void check_counts(uint64_t count, double tolerance)
{
    struct trial_statistics whole, odd, even;
    double error, counts[10];
    trial_statistics_open(5, count, &arena, &whole);
    trial_statistics_open(5, count, &arena, &odd);
    trial_statistics_open(5, count, &arena, &even);
    fill(&whole, count, 0, 1);
    fill(&odd, count, 1, 2);
    fill(&even, count, 0, 2);
    struct trial_statistics read;
    trial_statistics_open(5, count, &arena, &read);
    struct text_buffer written = {.arena = &arena};
    trial_statistics_write(&odd, &written);
    trial_statistics_write(&even, &written);
    struct text lines = growing_done(&written);
    CHECK(trial_statistics_read(&lines, &read) && trial_statistics_read(&lines, &read));
    const double n = (double)count, width = 0.01 * (n - 1);
    const struct trial_statistics_moments moments = trial_statistics_moments(&whole),
                                          joined = trial_statistics_moments(&read);
    CHECK_RELATIVE(moments.mean, 5 + width / 2, 1e-14, "the mean of 0 .. n - 1");
    CHECK_RELATIVE(moments.sd, 0.01 * sqrt(n * (n + 1) / 12), 1e-12, "their variance n (n + 1)/12");
    CHECK(moments.mean == joined.mean && moments.sd == joined.sd);
    CHECK(moments.sd_error == joined.sd_error && whole.highest == read.highest);
    CHECK_RELATIVE(moments.sd_error, moments.sd / 2 * sqrt(0.8 / n), 5e-3, "kurtosis 1.8");
    for (int i = 1; i < 10; i++) {
        const double share = 0.1 * i, at = trial_statistics_quantile(&whole, share, &error);
        CHECK_NEAR(at, 5 + share * width, tolerance * width, "evenly spread");
        CHECK_NEAR(error, 0.01 * sqrt(n * share * (1 - share)), 2 * tolerance * width, "its error");
        CHECK(at == trial_statistics_quantile(&read, share, NULL));
    }
    trial_statistics_histogram(&whole, 5, 5 + width, 10, counts);
    CHECK_NEAR(counts[3], n / 10, 2 + 1e-3 * n, "a tenth");
    arena_free(&arena);
}

/* Both signs, and what is exactly the nominal figure. */
static void check_signs(void)
{
    struct trial_statistics tally;
    const uint64_t count = TRIAL_STATISTICS_KEPT + 5;
    trial_statistics_open(1, count, &arena, &tally);
    for (uint64_t i = 0; i < count; i++) {
        trial_statistics_add(&tally, i % 4 == 0 ? 1 : i % 4 == 1 ? 3 : i % 4 == 2 ? -4 : 1.5);
    }
    CHECK_NEAR(trial_statistics_quantile(&tally, 0.1, NULL), -4, 2e-3, "the lowest quarter");
    CHECK_NEAR(trial_statistics_quantile(&tally, 0.4, NULL), 1, 1e-9, "the next");
    CHECK_NEAR(trial_statistics_quantile(&tally, 0.6, NULL), 1.5, 1e-3, "the next");
    CHECK_NEAR(trial_statistics_quantile(&tally, 0.9, NULL), 3, 1e-3, "the highest");
    arena_free(&arena);
}

/* The least that has a mean, and a deviation: by hand. */
static void check_few(void)
{
    struct trial_statistics tally;
    trial_statistics_open(5, 2, &arena, &tally);
    struct trial_statistics_moments moments = trial_statistics_moments(&tally);
    CHECK(isnan(moments.mean) && isnan(moments.sd));
    trial_statistics_add(&tally, 6);
    moments = trial_statistics_moments(&tally);
    CHECK(moments.mean == 6 && isnan(moments.sd) && isnan(moments.mean_error));
    trial_statistics_add(&tally, 9);
    moments = trial_statistics_moments(&tally);
    CHECK(moments.mean == 7.5);
    CHECK_RELATIVE(moments.sd, 3 / sqrt(2), 1e-15, "of two");
    CHECK_RELATIVE(moments.mean_error, 1.5, 1e-15, "of two");
    arena_free(&arena);
}

int main(void)
{
    check_few();
    check_sums();
    check_counts(1000, 1e-9);
    check_counts(TRIAL_STATISTICS_KEPT + 1000, 3e-4);
    check_signs();
    return check_report();
}
