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

/* By hand: about their mean of 4 they are -3, -2, 0, 4, 1; squares 30, fourth powers 354. */
static void check_moments(void)
{
    static const double figures[] = {1, 2, 4, 8, 5};
    struct trial_statistics tally;
    trial_statistics_open(3, 5, &arena, &tally);
    for (int i = 0; i < 5; i++) {
        trial_statistics_add(&tally, figures[i]);
    }
    struct trial_statistics_moments moments = trial_statistics_moments(&tally);
    const double kurtosis = 354.0 / 5 / (7.5 * 7.5);
    CHECK_RELATIVE(moments.mean, 4.0, 1e-15, "of five");
    CHECK_RELATIVE(moments.sd, sqrt(30.0 / 4), 1e-14, "of five");
    CHECK_RELATIVE(moments.mean_error, sqrt(30.0 / 4 / 5), 1e-14, "of five");
    CHECK_RELATIVE(moments.sd_error, sqrt(7.5) / 2 * sqrt((kurtosis - 1) / 5), 1e-13, "of five");
    CHECK(tally.lowest == 1 && tally.highest == 8);
    trial_statistics_open(3, 2, &arena, &tally);
    trial_statistics_add(&tally, 7);
    trial_statistics_add(&tally, 7);
    moments = trial_statistics_moments(&tally);
    CHECK(moments.sd == 0 && moments.sd_error == 0);
    double error;
    CHECK(isnan(trial_statistics_quantile(&(struct trial_statistics){.keeps = true, .nominal = 3},
                                          0.5, &error)));
    CHECK(isnan(error));
    arena_free(&arena);
}

static void check_ranks(void)
{
    struct trial_statistics tally;
    double error;
    trial_statistics_open(-2, 4, &arena, &tally);
    trial_statistics_add(&tally, 10);
    trial_statistics_add(&tally, 0);
    trial_statistics_add(&tally, 1);
    CHECK_NEAR(trial_statistics_quantile(&tally, 0.25, NULL), 0.5, 1e-14, "between ranks 0 and 1");
    CHECK_NEAR(trial_statistics_quantile(&tally, 0.75, NULL), 5.5, 1e-14, "between 1 and 2");
    CHECK_NEAR(trial_statistics_quantile(&tally, 0, NULL), 0, 1e-14, "the least");
    CHECK_NEAR(trial_statistics_quantile(&tally, 1, NULL), 10, 1e-14, "the most");
    /* one more: it is put in its order */
    trial_statistics_add(&tally, 5);
    CHECK_NEAR(trial_statistics_quantile(&tally, 0.5, &error), 3, 1e-14, "of four");
    /* ranks 1.5 -+ sqrt(4/4): 0.5 and 7.5 */
    CHECK_NEAR(error, 3.5, 1e-14, "half of what lies between");
    arena_free(&arena);
}

/* A bin's figures are spread over a 4096th of their power of 2, away from 0. */
static void check_bins(void)
{
    static const struct {
        double departure, low, high;
    } cases[] = {
        {1.5 + 0.3 * 0x1p-12, 1.5, 1.5 + 0x1p-12},
        {-1.5 - 0.3 * 0x1p-12, -1.5 - 0x1p-12, -1.5},
        {2 - 0.3 * 0x1p-12, 2 - 0x1p-12, 2},
        {-2 + 0.3 * 0x1p-12, -2, -2 + 0x1p-12},
        {12 + 0.9 * 0x1p-9, 12, 12 + 0x1p-9},
        {1, 1, 1 + 0x1p-12},
        {-0.25 - 0.1 * 0x1p-14, -0.25 - 0x1p-14, -0.25},
    };
    const uint64_t count = TRIAL_STATISTICS_KEPT + 1;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const double low = cases[i].low, high = cases[i].high, n = (double)count;
        struct trial_statistics tally;
        double error;
        trial_statistics_open(0, count, &arena, &tally);
        for (uint64_t k = 0; k < count; k++) {
            trial_statistics_add(&tally, cases[i].departure);
        }
        const double tight = 1e-3 * (high - low);
        CHECK_NEAR(trial_statistics_quantile(&tally, 0, NULL), low, tight, "where a bin begins");
        CHECK_NEAR(trial_statistics_quantile(&tally, 1, NULL), high, tight, "where it ends");
        CHECK_NEAR(trial_statistics_quantile(&tally, 0.5, &error), (low + high) / 2, tight,
                   "middle");
        CHECK_NEAR(error, (high - low) * 0.5 / sqrt(n), 2e-5 * (high - low), "its error");
        arena_free(&arena);
    }
}

/* What lies on a border counts beyond it, on the last within; what is outside counts nowhere. */
static void check_histogram(void)
{
    static const double figures[] = {-0.001, 0, 0.499, 0.5, 1.2, 1.999, 2, 2.001, 9};
    static const double expected[] = {2, 1, 1, 2};
    double counts[4];
    struct trial_statistics tally;
    trial_statistics_open(0.3, 9, &arena, &tally);
    for (int i = 0; i < 9; i++) {
        trial_statistics_add(&tally, figures[i]);
    }
    trial_statistics_histogram(&tally, 0, 2, 4, counts);
    for (int i = 0; i < 4; i++) {
        CHECK_NEAR(counts[i], expected[i], 0, "of those that are kept");
    }
    arena_free(&arena);
    /* counted, each as where the middle of its bin is */
    trial_statistics_open(0, TRIAL_STATISTICS_KEPT + 1, &arena, &tally);
    for (int i = 0; i < 9; i++) {
        for (int k = 0; k <= i; k++) {
            trial_statistics_add(&tally, figures[i] + 0.1);
        }
    }
    trial_statistics_histogram(&tally, 0.0993, 2.1005, 4, counts);
    CHECK_NEAR(counts[0], 2 + 3, 0, "those of 0 and 0.499");
    CHECK_NEAR(counts[1], 4, 0, "those of 0.5");
    CHECK_NEAR(counts[2], 5, 0, "those of 1.2");
    CHECK_NEAR(counts[3], 6 + 7, 0, "those of 1.999 and 2");
    arena_free(&arena);
}

/* Both halves, without a way through text. */
static void check_join(void)
{
    for (int counted = 0; counted < 2; counted++) {
        const uint64_t total = counted ? TRIAL_STATISTICS_KEPT + 1 : 7;
        struct trial_statistics one, other;
        trial_statistics_open(0, total, &arena, &one);
        trial_statistics_open(0, total, &arena, &other);
        for (int i = 0; i < 7; i++) {
            trial_statistics_add(i % 2 == 0 ? &one : &other, i == 3 ? -100 : i == 5 ? 50 : 2 * i);
        }
        trial_statistics_quantile(&one, 0.5, NULL);
        trial_statistics_join(&one, &other);
        CHECK(one.count == 7 && one.lowest == -100 && one.highest == 50);
        /* -100 0 2 4 8 12 50 */
        const double loose = counted ? 4e-3 : 1e-14;
        CHECK_NEAR(trial_statistics_quantile(&one, 0.5, NULL), 4, loose, "the middle of both");
        CHECK_NEAR(trial_statistics_quantile(&one, 4.0 / 6, NULL), 8, loose, "the fifth");
        CHECK_RELATIVE(trial_statistics_moments(&one).mean, -24.0 / 7, 1e-14, "their mean");
        arena_free(&arena);
    }
}

/* Is that read, which is written with one part put in place of another? */
static bool reads_with(const struct trial_statistics *written, const char *part,
                       const char *instead)
{
    struct text_buffer buffer = {.arena = &arena};
    trial_statistics_write(written, &buffer);
    const struct text lines = growing_done(&buffer);
    char *text = ARENA_ARRAY(&arena, lines.length + 100, char);
    char *copy = ARENA_ARRAY(&arena, lines.length + 1, char);
    memcpy(copy, lines.start, lines.length);
    char *at = strstr(copy, part);
    CHECK(at != NULL);
    snprintf(text, lines.length + 100, "%.*s%s%s", (int)(at - copy), copy, instead,
             at + strlen(part));
    struct trial_statistics read;
    struct text rest = text_of(text);
    trial_statistics_open(0, written->keeps ? 5 : TRIAL_STATISTICS_KEPT + 1, &arena, &read);
    const bool does = trial_statistics_read(&rest, &read);
    CHECK(read.count == (does ? written->count : 0));
    return does;
}

/* 1 and 2 are the bits 4607182418800017408 and 4611686018427387904. */
static void check_read(void)
{
    static const struct {
        const char *part, *instead;
        bool counted, reads;
    } cases[] = {
        {"tally", "tally", false, true},
        {"tally", "tallies", false, false},
        {"tally 2", "tally -1", false, false},
        {"tally 2", "tally two", false, false},
        {"tally 2", "tally 3", false, false},
        {"tally 2 46", "tally 2 4x", false, false},
        {"\n 4607182418800017408 ", "\n ", false, false},
        {"\n 4607182418800017408 ", "\n 4607182418800017408x ", false, false},
        {"\n 4607182418800017408 ", "\n 46071824188000174084607182418800017408 ", false, false},
        {"tally", "tally", true, true},
        {"tally 2", "tally 3", true, false},
        {"tally 2", "tally 1", true, false},
        /* page 1023 of 2048 bins of 4096: that of 1, and the last there may be */
        {"\n 4190208 1", "\n 16777215 1", true, true},
        {"\n 4190208 1", "\n 0 1", true, true},
        {"\n 4190208 1", "\n 16777216 1", true, false},
        {"\n 4190208 1", "\n -1 1", true, false},
        {"\n 4190208 1", "\n 4190208 0", true, false},
        {"\n 4190208 1", "\n 4190208", true, false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct trial_statistics tally;
        trial_statistics_open(0, cases[i].counted ? TRIAL_STATISTICS_KEPT + 1 : 2, &arena, &tally);
        trial_statistics_add(&tally, 1);
        trial_statistics_add(&tally, 2);
        CHECK(reads_with(&tally, cases[i].part, cases[i].instead) == cases[i].reads);
        arena_free(&arena);
    }
    struct text none = text_of("");
    struct trial_statistics tally;
    trial_statistics_open(0, 2, &arena, &tally);
    CHECK(!trial_statistics_read(&none, &tally));
    arena_free(&arena);
}

int main(void)
{
    check_few();
    check_moments();
    check_ranks();
    check_bins();
    check_histogram();
    check_join();
    check_read();
    check_sums();
    check_counts(1000, 1e-9);
    check_counts(TRIAL_STATISTICS_KEPT + 1000, 3e-4);
    check_signs();
    return check_report();
}
