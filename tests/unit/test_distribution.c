/* tests/unit/test_distribution.c - how numbers of makers are spread: quantiles, moments, ends. */
/* SPDX-License-Identifier: MIT */
#include "base/distribution.h"
#include "base/random.h"
#include "check.h"

/* Inverses of the distribution functions, by mpmath 1.3.0 with 40 digits; each p is a double. */
static const struct quantile {
    enum distribution distribution;
    double sigmas, p, x;
} quantiles[] = {
    {DISTRIBUTION_TRUNCATED, 0.5, 0.00048828125, -0.99893797977762254028},
    {DISTRIBUTION_TRUNCATED, 0.5, 0.0625, -0.86620393696409285867},
    {DISTRIBUTION_TRUNCATED, 0.5, 0.25, -0.48462626489335274576},
    {DISTRIBUTION_TRUNCATED, 0.5, 0.4990234375, -0.0018747081610919851038},
    {DISTRIBUTION_TRUNCATED, 0.5, 0.6875, 0.36190934661736597359},
    {DISTRIBUTION_TRUNCATED, 0.5, 0.99951171875, 0.99893797977762254028},
    {DISTRIBUTION_TRUNCATED, 0.5, 9.094947017729282e-13, -0.99999999999802157065},
    {DISTRIBUTION_TRUNCATED, 1, 0.00048828125, -0.99862332443913876182},
    {DISTRIBUTION_TRUNCATED, 1, 0.0625, -0.83690371076510954908},
    {DISTRIBUTION_TRUNCATED, 1, 0.25, -0.44177054668658128752},
    {DISTRIBUTION_TRUNCATED, 1, 0.4990234375, -0.0016711421682516466874},
    {DISTRIBUTION_TRUNCATED, 1, 0.6875, 0.32657224278264957129},
    {DISTRIBUTION_TRUNCATED, 1, 0.99951171875, 0.99862332443913876182},
    {DISTRIBUTION_TRUNCATED, 1, 9.094947017729282e-13, -0.99999999999743397687},
    {DISTRIBUTION_TRUNCATED, 2, 0.00048828125, -0.99572065018449633046},
    {DISTRIBUTION_TRUNCATED, 2, 0.0625, -0.69453291864304688555},
    {DISTRIBUTION_TRUNCATED, 2, 0.25, -0.3195559554356364148},
    {DISTRIBUTION_TRUNCATED, 2, 0.4990234375, -0.0011682510759704387956},
    {DISTRIBUTION_TRUNCATED, 2, 0.6875, 0.2324084397152475366},
    {DISTRIBUTION_TRUNCATED, 2, 0.99951171875, 0.99572065018449633046},
    {DISTRIBUTION_TRUNCATED, 2, 9.094947017729282e-13, -0.99999999999196057684},
    {DISTRIBUTION_TRUNCATED, 3, 0.00048828125, -0.96829950251184772408},
    {DISTRIBUTION_TRUNCATED, 3, 0.0625, -0.50819542675273681988},
    {DISTRIBUTION_TRUNCATED, 3, 0.25, -0.22412243168768623149},
    {DISTRIBUTION_TRUNCATED, 3, 0.4990234375, -0.00081375760826841852953},
    {DISTRIBUTION_TRUNCATED, 3, 0.6875, 0.16244901049515275996},
    {DISTRIBUTION_TRUNCATED, 3, 0.99951171875, 0.96829950251184772408},
    {DISTRIBUTION_TRUNCATED, 3, 9.094947017729282e-13, -0.9999999999317787097},
    {DISTRIBUTION_TRUNCATED, 6, 0.00048828125, -0.54953212979710118824},
    {DISTRIBUTION_TRUNCATED, 6, 0.0625, -0.2556867562222036866},
    {DISTRIBUTION_TRUNCATED, 6, 0.25, -0.11241495810729210658},
    {DISTRIBUTION_TRUNCATED, 6, 0.4990234375, -0.0004079802690467613805},
    {DISTRIBUTION_TRUNCATED, 6, 0.6875, 0.081462735011604534219},
    {DISTRIBUTION_TRUNCATED, 6, 0.99951171875, 0.54953212979710118824},
    {DISTRIBUTION_TRUNCATED, 6, 9.094947017729282e-13, -0.99997506297862865134},
    {DISTRIBUTION_PARABOLIC, 1, 0.00048828125, -0.99967437314532723023},
    {DISTRIBUTION_PARABOLIC, 1, 0.0625, -0.9564655913861945506},
    {DISTRIBUTION_PARABOLIC, 1, 0.25, -0.79370052598409973738},
    {DISTRIBUTION_PARABOLIC, 1, 0.4990234375, -0.125},
    {DISTRIBUTION_PARABOLIC, 1, 0.6875, 0.72112478515370419116},
    {DISTRIBUTION_PARABOLIC, 1, 0.99951171875, 0.99967437314532723023},
    {DISTRIBUTION_PARABOLIC, 1, 9.094947017729282e-13, -0.9999999999993936702},
    {DISTRIBUTION_NORMAL, 2.5, 0.00048828125, -1.3188773382767853367},
    {DISTRIBUTION_NORMAL, 2.5, 0.0625, -0.61364821774101852468},
    {DISTRIBUTION_NORMAL, 2.5, 0.25, -0.26979590007843269728},
    {DISTRIBUTION_NORMAL, 2.5, 0.4990234375, -0.00097915264764427098177},
    {DISTRIBUTION_NORMAL, 2.5, 0.6875, 0.19551056444586779956},
    {DISTRIBUTION_NORMAL, 2.5, 0.99951171875, 1.3188773382767853367},
    {DISTRIBUTION_NORMAL, 2.5, 9.094947017729282e-13, -2.8190801026657634901},
};

static void test_quantiles(void)
{
    for (size_t i = 0; i < sizeof quantiles / sizeof *quantiles; i++) {
        const struct quantile *one = &quantiles[i];
        const struct spread spread = spread_of(one->distribution, one->sigmas);
        const double wide = one->sigmas > 3 ? 1e-8 : 1e-14;
        CHECK_NEAR(spread_quantile(&spread, one->p), one->x, wide, "quantile");
    }
    const struct spread uniform = spread_of(DISTRIBUTION_UNIFORM, 2);
    CHECK(spread_quantile(&uniform, 0.75) == 0.5 && spread_quantile(&uniform, 0.125) == -0.75);
    const struct spread ends = spread_of(DISTRIBUTION_TWO_POINT, 2);
    CHECK(spread_quantile(&ends, 0.4999999999) == -1 && spread_quantile(&ends, 0.5000000001) == 1);
}

/* By mpmath; the others by hand. */
static const struct variance {
    enum distribution distribution;
    double sigmas, variance, fourth;
} variances[] = {
    {DISTRIBUTION_TRUNCATED, 0.5, 0.32235661840324679371, 0.190636039242208318268},
    {DISTRIBUTION_TRUNCATED, 1, 0.29112509477279321119, 0.164500379091172844764},
    {DISTRIBUTION_TRUNCATED, 2, 0.19343532588748081179, 0.0885118203030914206412},
    {DISTRIBUTION_TRUNCATED, 3, 0.10814854718472683073, 0.0330869518018579965316},
    {DISTRIBUTION_TRUNCATED, 6, 0.027777775752483490507, 0.0023148126207460036049},
    {DISTRIBUTION_UNIFORM, 2, 1.0 / 3, 1.0 / 5},
    {DISTRIBUTION_NORMAL, 2, 0.25, 3.0 / 16},
    {DISTRIBUTION_NORMAL, 4, 0.0625, 3.0 / 256},
    {DISTRIBUTION_TWO_POINT, 2, 1, 1},
    {DISTRIBUTION_PARABOLIC, 2, 3.0 / 5, 3.0 / 7},
};

/*
 * The moments of many numbers are those of the distribution: E x = 0 exactly, as p and 1 - p are
 * taken together; E x^2 within 4 of its own standard errors.
 */
static void test_moments(void)
{
    enum { COUNT = 100000 };
    for (size_t i = 0; i < sizeof variances / sizeof *variances; i++) {
        const struct variance *one = &variances[i];
        const struct spread spread = spread_of(one->distribution, one->sigmas);
        double squares = 0, fourths = 0;
        CHECK_RELATIVE(spread_variance(&spread), one->variance, 1e-13, "variance");
        CHECK_RELATIVE(spread_fourth(&spread), one->fourth, 1e-11, "fourth power");
        for (uint64_t k = 0; k < COUNT; k++) {
            const double p = random_unit(7, k, (uint32_t)i);
            const double x = spread_quantile(&spread, p);
            squares += x * x;
            fourths += x * x * x * x;
            CHECK_NEAR(spread_quantile(&spread, 1 - p), -x, 1e-9, "odd");
            CHECK(one->distribution == DISTRIBUTION_NORMAL || (x >= -1 && x <= 1));
        }
        const double mean = squares / COUNT, error = sqrt(fourths / COUNT - mean * mean + 1e-30);
        CHECK_NEAR(mean, one->variance, 4 * error / sqrt(COUNT) + 1e-15, "variance of numbers");
    }
}

/* The first and the last number that random_unit gives: finite, and within the range. */
static void test_ends(void)
{
    for (int i = 0; i < DISTRIBUTIONS; i++) {
        const struct spread spread = spread_of((enum distribution)i, DISTRIBUTION_SIGMAS_MOST);
        const double low = spread_quantile(&spread, 0x1p-53), near = i == DISTRIBUTION_NORMAL;
        CHECK(low >= -1 - near && low < -0.99);
        CHECK_NEAR(spread_quantile(&spread, 1 - 0x1p-53), -low, 1e-15, "the other end");
    }
}

/* One word each. */
static void test_words(void)
{
    int count = 0;
    while (distribution_words[count].word != NULL) {
        count++;
    }
    CHECK(count == DISTRIBUTIONS);
    CHECK_TEXT(distribution_words[DISTRIBUTION_TWO_POINT].word, "two-point");
}

int main(void)
{
    test_words();
    test_quantiles();
    test_moments();
    test_ends();
    return check_report();
}
