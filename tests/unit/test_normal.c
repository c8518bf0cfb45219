/* tests/unit/test_normal.c - normal and Poisson numbers: quantiles, tails, moments. */
/* SPDX-License-Identifier: MIT */
#include "base/exponential.h"
#include "base/normal.h"
#include "base/poisson.h"
#include "base/random.h"
#include "check.h"

/* The roots of erfc(z/sqrt(2))/2 = p, each p the double it is, by mpmath 1.2.1 with 60 digits. */
static const struct quantile {
    double p, z;
} quantiles[] = {
    {0.50048828125, 0.001223939892804980180826477},
    {0.625, 0.3186393639643751630219485},
    {0.925, 1.43953147093845622906332},
    {0.9250000001, 1.439531471644893373302734},
    {0.0749, -1.440238267527963663112402},
    {0.01, -2.326347874040841093075096},
    {0.001, -3.090232306167813535358005},
    {1e-05, -4.264890793922824610233749},
    {1e-10, -6.361340902404056199100397},
    {1.3887943864964021e-11, -6.657904643501103583720578},
    {1e-12, -7.034483825301131932614176},
    {1.1102230246251565e-16, -8.209536151601386855630769},
    {0.9999999999999999, 8.209536151601386855630769},
    {1e-50, -14.93333753478848898065821},
    {1e-300, -37.04709629936119923654704},
    {0.8413447460685429, 0.9999999999999999057376864},
    {0.3, -0.5244005127080408159694544},
    {0.0625, -1.534120544352546311708399},
};

static void test_quantiles(void)
{
    CHECK(normal_quantile(0.5) == 0);
    for (size_t i = 0; i < sizeof quantiles / sizeof *quantiles; i++) {
        CHECK_RELATIVE(normal_quantile(quantiles[i].p), quantiles[i].z, 1e-15, "quantile");
    }
    /* libm's erfc goes back, where a step of p is not larger than its error */
    for (int i = 0; i < 20000; i++) {
        const double p = ((double)i + 0.5) / 20000 * 0.499, z = normal_quantile(p);
        CHECK_RELATIVE(erfc(-z / sqrt(2)) / 2, p, 1e-14, "back");
        CHECK_NEAR(normal_quantile(1 - p), -z, 1e-15 * (1 + 1 / p), "the other side");
    }
}

/* libm's are within an ulp of the truth. */
static void test_exponential(void)
{
    CHECK(natural_logarithm(1) == 0 && exponential(0) == 1);
    for (uint64_t i = 0; i < 100000; i++) {
        const struct random_pair pair = random_pair(3, i, 0);
        const double x = -708 + 1417 * pair.u, y = ldexp(1 + pair.v, (int)(1400 * pair.u) - 700);
        CHECK_RELATIVE(exponential(x), exp(x), 5e-16, "e^x");
        CHECK_RELATIVE(natural_logarithm(y), log(y), 4e-16, "ln");
        const double near_1 = 0.7 + 0.7 * pair.v;
        CHECK_RELATIVE(natural_logarithm(near_1), log(near_1), 4e-16, "ln near 1");
    }
}

/* Mean 0, variance 1, skewness 0, kurtosis 3 within 4 sigma; how many lie beyond 3 and 4. */
static void test_normal_moments(void)
{
    enum { COUNT = 400000 };
    double sum[5] = {0};
    int beyond3 = 0, beyond4 = 0;
    for (uint64_t i = 0; i < COUNT; i++) {
        const double z = normal_quantile(random_unit(5, i, 0));
        double power = 1;
        for (int k = 0; k < 5; k++) {
            sum[k] += power;
            power *= z;
        }
        beyond3 += fabs(z) > 3;
        beyond4 += fabs(z) > 4;
    }
    CHECK_NEAR(sum[1] / COUNT, 0, 4 * sqrt(1.0 / COUNT), "mean");
    CHECK_NEAR(sum[2] / COUNT, 1, 4 * sqrt(2.0 / COUNT), "variance");
    CHECK_NEAR(sum[3] / COUNT, 0, 4 * sqrt(15.0 / COUNT), "skewness");
    CHECK_NEAR(sum[4] / COUNT, 3, 4 * sqrt(96.0 / COUNT), "kurtosis");
    const double share3 = erfc(3 / sqrt(2)) * COUNT, share4 = erfc(4 / sqrt(2)) * COUNT;
    CHECK_NEAR(beyond3, share3, 4 * sqrt(share3), "beyond 3 sigma");
    CHECK_NEAR(beyond4, share4, 4 * sqrt(share4), "beyond 4 sigma");
}

/* P(at most k) from its terms, the smaller ones first; and P(more than k). */
static double lower(double mean, int k)
{
    double sum = 0, at_k = exp(k * log(mean) - mean - lgamma(k + 1.0)), term = at_k;
    for (int j = k; j >= 0 && term > 1e-30 * at_k; j--) {
        sum += term;
        term *= j / mean;
    }
    return sum;
}

static double upper(double mean, int k)
{
    double at = exp((k + 1.0) * log(mean) - mean - lgamma(k + 2.0)), sum = 0, term = at;
    for (int j = k + 2; term > 1e-30 * at; j++) {
        sum += term;
        term *= mean / j;
    }
    return sum;
}

/* The largest p whose quantile is at most k, by bisection of p or of 1 - p, whichever is small. */
static double edge(double mean, int k, bool above)
{
    double low = above ? 0x1p-53 : 1e-150, high = 0.5;
    for (int i = 0; i < 1100 && high / low > 1 + 1e-12; i++) {
        const double middle = high / low > 4 ? sqrt(low * high) : (low + high) / 2;
        const bool within = poisson_quantile(mean, above ? 1 - middle : middle) <= k;
        *(within == above ? &high : &low) = middle;
    }
    return low;
}

/* Wrong by how much of itself is the probability of a tail beyond some standard deviations? */
static void check_tails(double mean, const double worst[], const char *what)
{
    const double root = sqrt(mean);
    for (int sigmas = 1; sigmas <= 5; sigmas++) {
        const int below = (int)floor(mean - sigmas * root), over = (int)ceil(mean + sigmas * root);
        if (below > 0) {
            CHECK_RELATIVE(edge(mean, below, false), lower(mean, below), worst[sigmas], what);
        }
        CHECK_RELATIVE(edge(mean, over, true), upper(mean, over), worst[sigmas], what);
    }
}

static void test_poisson_tails(void)
{
    static const double summed[] = {0, 1e-9, 1e-9, 1e-9, 1e-8, 1e-6};
    static const double least[] = {0, 2e-5, 2e-4, 1.5e-3, 1e-2, 6e-2};
    static const double large[] = {0, 2e-8, 1e-7, 2e-6, 1e-5, 4e-5};
    check_tails(0.5, summed, "mean 0.5");
    check_tails(8, summed, "mean 8");
    check_tails(POISSON_SUMMED, summed, "the largest summed mean");
    check_tails(POISSON_SUMMED + 0.001, least, "the least expanded mean");
    check_tails(100, least, "mean 100");
    check_tails(1000, large, "mean 1000");
    /* in the middle the error is absolute */
    for (int k = 40; k <= 50; k++) {
        CHECK_NEAR(edge(POISSON_SUMMED + 0.001, k, false) - lower(POISSON_SUMMED + 0.001, k), 0,
                   k < 50 ? 2e-6 : 1, "the middle");
    }
}

/* Mean and variance are the mean, the third moment too; within 4 sigma, small and large. */
static void test_poisson_moments(void)
{
    static const double means[] = {0.01, 0.7, 5, 49.5, 50.5, 300, 20000};
    enum { COUNT = 100000 };
    for (size_t m = 0; m < sizeof means / sizeof *means; m++) {
        const double mean = means[m];
        double sum = 0, sum2 = 0, sum3 = 0;
        for (uint64_t i = 0; i < COUNT; i++) {
            const double d = poisson_quantile(mean, random_unit(11, i, (uint32_t)m)) - mean;
            sum += d;
            sum2 += d * d;
            sum3 += d * d * d;
        }
        CHECK_NEAR(sum / COUNT, 0, 4 * sqrt(mean / COUNT), "mean");
        CHECK_NEAR(sum2 / COUNT, mean, 4 * sqrt((mean + 2 * mean * mean) / COUNT), "variance");
        const double sixth = mean + 25 * mean * mean + 15 * mean * mean * mean;
        CHECK_NEAR(sum3 / COUNT, mean, 4 * sqrt(sixth / COUNT), "third moment");
    }
}

/* Ends: no light; the smallest and largest number there is; counts grow with the mean. */
static void test_poisson_ends(void)
{
    const double least = random_unit_of(0, 0), most = random_unit_of(0xffffffff, 0xffffffff);
    CHECK(poisson_quantile(0, least) == 0 && poisson_quantile(0, most) == 0);
    CHECK(poisson_quantile(1e-300, 0.5) == 0 && poisson_quantile(50.001, least) >= 0);
    /* of mean 1 P(N > 17) = 6.1e-17 < 2^-53 = 1.1e-16 < P(N > 16) = 1.1e-15: terms e^-1/k! */
    CHECK(poisson_quantile(1, 1 - 0x1p-53) == 17);
    double before = 0;
    for (int i = 1; i < 2000; i++) {
        const double now = poisson_quantile(i / 20.0, 0.3);
        CHECK(now >= before);
        before = now;
    }
    CHECK_RELATIVE(poisson_quantile(1e15, most), 1e15, 1e-6, "huge");
}

int main(void)
{
    test_quantiles();
    test_exponential();
    test_normal_moments();
    test_poisson_tails();
    test_poisson_moments();
    test_poisson_ends();
    return check_report();
}
