/* tests/unit/test_tally.c - counted figures: exact sums, moments, percentiles, in any order. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "design/tolerance/tally.h"

#include <math.h>

static struct arena arena;

static void check_sums(void)
{
    static const double numbers[] = {1e300, 1, -1e300, 3e-310, 0x1p-1074, -2.5, 1e16, 1, -1e16};
    const size_t count = sizeof numbers / sizeof numbers[0];
    struct exact_sum forth = {{0}}, back = {{0}}, half = {{0}};
    for (size_t i = 0; i < count; i++) {
        exact_sum_add(&forth, numbers[i]);
        exact_sum_add(i % 2 == 0 ? &back : &half, numbers[count - 1 - i]);
    }
    exact_sum_join(&back, &half);
    CHECK_NEAR(exact_sum_value(&forth), -0.5, 1e-16, "by hand: what is left is 1 - 2.5 + 1");
    CHECK(exact_sum_value(&forth) == exact_sum_value(&back));
    struct exact_sum small = {{0}};
    exact_sum_add(&small, 0x1p-1074);
    exact_sum_add(&small, 0x1p-1074);
    CHECK(exact_sum_value(&small) == 0x1p-1073);
}

/* 0 .. count - 1 in hundredths about 5, in some order. */
static void fill(struct tally *tally, uint64_t count, uint64_t from, uint64_t step)
{
    for (uint64_t i = from; i < count; i += step) {
        tally_add(tally, 5 + 0.01 * (double)(i * 7919 % count));
    }
}

static void check_counts(uint64_t count, double tolerance)
{
    struct tally whole, odd, even;
    double error, counts[10];
    tally_open(5, count, &arena, &whole);
    tally_open(5, count, &arena, &odd);
    tally_open(5, count, &arena, &even);
    fill(&whole, count, 0, 1);
    fill(&odd, count, 1, 2);
    fill(&even, count, 0, 2);
    struct tally read;
    tally_open(5, count, &arena, &read);
    struct text lines = tally_write(&odd, &arena), more = tally_write(&even, &arena);
    CHECK(tally_read(&lines, &read) && tally_read(&more, &read));
    const double n = (double)count, width = 0.01 * (n - 1);
    const struct tally_moments moments = tally_moments(&whole), joined = tally_moments(&read);
    CHECK_RELATIVE(moments.mean, 5 + width / 2, 1e-14, "the mean of 0 .. n - 1");
    CHECK_RELATIVE(moments.sd, 0.01 * sqrt(n * (n + 1) / 12), 1e-12, "their variance n (n + 1)/12");
    CHECK(moments.mean == joined.mean && moments.sd == joined.sd);
    CHECK(moments.sd_error == joined.sd_error && whole.highest == read.highest);
    CHECK_RELATIVE(moments.sd_error, moments.sd / 2 * sqrt(0.8 / n), 5e-3, "kurtosis 1.8");
    for (int i = 1; i < 10; i++) {
        const double share = 0.1 * i, at = tally_quantile(&whole, share, &error);
        CHECK_NEAR(at, 5 + share * width, tolerance * width, "evenly spread");
        CHECK_NEAR(error, 0.01 * sqrt(n * share * (1 - share)), 2 * tolerance * width, "its error");
        CHECK(at == tally_quantile(&read, share, NULL));
    }
    tally_histogram(&whole, 5, 5 + width, 10, counts);
    CHECK_NEAR(counts[3], n / 10, 2 + 1e-3 * n, "a tenth");
    arena_free(&arena);
}

/* Both signs, and what is exactly the nominal figure. */
static void check_signs(void)
{
    struct tally tally;
    const uint64_t count = TALLY_KEPT + 5;
    tally_open(1, count, &arena, &tally);
    for (uint64_t i = 0; i < count; i++) {
        tally_add(&tally, i % 4 == 0 ? 1 : i % 4 == 1 ? 3 : i % 4 == 2 ? -4 : 1.5);
    }
    CHECK_NEAR(tally_quantile(&tally, 0.1, NULL), -4, 2e-3, "the lowest quarter");
    CHECK_NEAR(tally_quantile(&tally, 0.4, NULL), 1, 1e-9, "the next");
    CHECK_NEAR(tally_quantile(&tally, 0.6, NULL), 1.5, 1e-3, "the next");
    CHECK_NEAR(tally_quantile(&tally, 0.9, NULL), 3, 1e-3, "the highest");
    arena_free(&arena);
}

int main(void)
{
    check_sums();
    check_counts(1000, 1e-9);
    check_counts(TALLY_KEPT + 1000, 3e-4);
    check_signs();
    return check_report();
}
