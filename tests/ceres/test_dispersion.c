/* tests/ceres/test_dispersion.c - dispersion formulas from indices. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "design/fit/dispersion.h"

enum { POINTS = 30 };

/* SCHOTT N-BK7: Sellmeier coefficients of its data sheet. */
static double n_bk7(double l)
{
    double x = l * l;
    return sqrt(1 + 1.03961212 * x / (x - 0.00600069867) + 0.231792344 * x / (x - 0.0200179144) +
                1.01046945 * x / (x - 103.560653));
}

/* The older formula, with coefficients of the size of BK7's. */
static double by_schott(double l)
{
    double x = 1 / (l * l);
    return sqrt(2.2718929 - 1.0108077e-2 * l * l + 1.0592509e-2 * x + 2.0816965e-4 * x * x -
                7.6472538e-6 * x * x * x + 4.9240991e-7 * x * x * x * x);
}

static double by_cauchy(double l)
{
    return 1.5046 + 0.0042 / (l * l) - 1e-4 / (l * l * l * l);
}

static double by_buchdahl(double l)
{
    double w = (l - 0.5875618) / (1 + 2.5 * (l - 0.5875618));
    return 1.62 + w * (-0.06 + w * (0.05 - 0.1 * w));
}

static double by_conrady(double l)
{
    return 1.6 + 0.009 / l + 0.0008 / (l * l * l * sqrt(l));
}

static double table_l[POINTS], table_n[POINTS];

static struct dispersion_data data_of(double (*index)(double), double from, double to)
{
    for (int i = 0; i < POINTS; i++) {
        table_l[i] = from + (to - from) * i / (POINTS - 1);
        table_n[i] = index(table_l[i]);
    }
    return (struct dispersion_data){POINTS, table_l, table_n, NULL};
}

/* Between the points too: the formula as the program evaluates it. */
static double worst(const struct glass *glass, double (*index)(double), double from, double to)
{
    double largest = 0;
    for (int i = 0; i <= 500; i++) {
        double l = from + (to - from) * i / 500;
        largest = fmax(largest, fabs(glass_n(glass, l) - index(l)));
    }
    return largest;
}

static void test_recovered(void)
{
    static const struct {
        enum glass_formula formula;
        size_t terms;
        double (*index)(double);
        double from, to;
    } cases[] = {
        {GLASS_SELLMEIER, 3, n_bk7, 0.33, 2.3},     {GLASS_SCHOTT, 6, by_schott, 0.35, 1.1},
        {GLASS_CAUCHY, 3, by_cauchy, 0.4, 0.8},     {GLASS_CAUCHY, 6, by_cauchy, 0.4, 0.8},
        {GLASS_BUCHDAHL, 4, by_buchdahl, 0.4, 0.8}, {GLASS_CONRADY, 3, by_conrady, 0.4, 0.8},
        {GLASS_SCHOTT, 0, by_schott, 0.4, 0.7},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct arena arena = {0};
        struct dispersion_fit fit;
        struct error error;
        const struct dispersion_data data = data_of(cases[i].index, cases[i].from, cases[i].to);
        CHECK(dispersion_fit(&data, cases[i].formula, cases[i].terms, &arena, &fit, &error));
        CHECK_NEAR(worst(&fit.glass, cases[i].index, cases[i].from, cases[i].to), 0, 1e-10,
                   "indices of the formula's own");
        CHECK(fit.rms < 1e-10 && fit.largest >= fit.rms);
        CHECK(fit.glass.shortest == data.wavelength[0]);
        CHECK(fit.glass.longest == data.wavelength[POINTS - 1]);
        arena_free(&arena);
    }
}

/* The coefficients themselves, where they are well determined. */
static void test_coefficients(void)
{
    struct arena arena = {0};
    struct dispersion_fit fit;
    struct error error;
    const struct dispersion_data data = data_of(by_cauchy, 0.4, 0.8);
    CHECK(dispersion_fit(&data, GLASS_CAUCHY, 3, &arena, &fit, &error));
    CHECK_RELATIVE(fit.parameters[0], 1.5046, 1e-12, "A");
    CHECK_RELATIVE(fit.parameters[1], 0.0042, 1e-10, "B");
    CHECK_RELATIVE(fit.parameters[2], -1e-4, 1e-9, "C");
    CHECK_TEXT(fit.names[2], "C");
    arena_free(&arena);
}

/* A term more never makes it worse; weights pull the fit to where they are. */
static void test_terms_and_weights(void)
{
    struct arena arena = {0};
    struct dispersion_fit fit;
    struct error error;
    double before = INFINITY, deviation[POINTS];
    struct dispersion_data data = data_of(n_bk7, 0.4, 1.0);
    for (size_t terms = 1; terms <= 6; terms++) {
        CHECK(dispersion_fit(&data, GLASS_CAUCHY, terms, &arena, &fit, &error));
        CHECK(fit.rms < before);
        before = fit.rms;
    }
    for (int i = 0; i < POINTS; i++) {
        deviation[i] = i == 0 ? 1e-9 : 1e-4;
    }
    data.deviation = deviation;
    CHECK(dispersion_fit(&data, GLASS_CAUCHY, 2, &arena, &fit, &error));
    CHECK_NEAR(fit.residuals[0], 0, 1e-8, "the certain one is met");
    CHECK(fabs(fit.residuals[1]) > 1e-6);
    arena_free(&arena);
}

static void check_refused(struct dispersion_data data, enum glass_formula formula, size_t terms,
                          const char *word)
{
    struct arena arena = {0};
    struct dispersion_fit fit;
    struct error error;
    CHECK(!dispersion_fit(&data, formula, terms, &arena, &fit, &error));
    CHECK(error.code == ERROR_DOMAIN && strstr(error.message, word) != NULL);
    arena_free(&arena);
}

static void test_refusals(void)
{
    struct dispersion_data data = data_of(n_bk7, 0.4, 0.7);
    const double zero[POINTS] = {0};
    check_refused(data, GLASS_SCHOTT, 5, "6 to 6 terms");
    check_refused(data, GLASS_TABLE, 0, "cannot be fitted");
    data.count = 4;
    check_refused(data, GLASS_SCHOTT, 0, "there are 4");
    data.count = POINTS;
    data.deviation = zero;
    check_refused(data, GLASS_CAUCHY, 0, "deviation");
    data.deviation = NULL;
    table_n[3] = NAN;
    check_refused(data, GLASS_CAUCHY, 0, "index nan");
    table_n[3] = 1.5;
    table_l[3] = table_l[2];
    check_refused(data, GLASS_CAUCHY, 0, "twice");
}

/* Cauchy's formula through scattered indices of unlike deviations: 50-digit normal equations. */
static const double scattered_l[] = {0.4, 0.4358, 0.4861, 0.5461, 0.5876, 0.6438, 0.7065, 0.8521};
static const double scattered_n[] = {1.5268344, 1.5237925, 1.5204176, 1.5177586,
                                     1.5159822, 1.5141324, 1.51249,   1.5100307};
static const double scattered_s[] = {0.0003868, 0.0002967, 0.0001366, 0.0001233,
                                     0.0002107, 0.0002232, 0.0003407, 0.000132};
enum { SCATTERED = sizeof scattered_l / sizeof scattered_l[0] };
static const struct dispersion_data scattered = {SCATTERED, scattered_l, scattered_n, scattered_s};

static void test_weighted(void)
{
    static const double expected[] = {1.5040961930208215, 0.0045301293123741993,
                                      -0.00014931354325075516};
    static const double errors[] = {0.00029338876619530734, 0.00019089251340657098,
                                    2.8781964061247019e-5};
    struct arena arena = {0};
    struct dispersion_fit fit;
    struct error error;
    CHECK(dispersion_fit(&scattered, GLASS_CAUCHY, 3, &arena, &fit, &error));
    for (size_t i = 0; i < 3; i++) {
        CHECK_RELATIVE(fit.parameters[i], expected[i], 1e-10, "coefficient");
        CHECK_RELATIVE(fit.summary.standard_error[i], errors[i], 1e-9, "standard error");
    }
    CHECK_RELATIVE(fit.summary.rms, 0.68101430569007704, 1e-9, "rms of the shares");
    CHECK(fit.summary.degrees_of_freedom == SCATTERED - 3);
    CHECK_RELATIVE(fit.rms, 0.00012676768832235572, 1e-9, "rms");
    CHECK_RELATIVE(fit.largest, 0.0002574590600724621, 1e-9, "largest");
    arena_free(&arena);
}

/* Squares of what the fit has left over, each over its deviation. */
static double cost_of(const struct dispersion_fit *fit, size_t which, double change)
{
    struct glass glass = fit->glass;
    size_t first = glass.count - fit->parameter_count; /* behind the d line of Buchdahl's formula */
    double sum = 0;
    glass.coefficients[first + which] = pair_of(fit->parameters[which] + change);
    for (size_t i = 0; i < SCATTERED; i++) {
        double off = (glass_n(&glass, scattered_l[i]) - scattered_n[i]) / scattered_s[i];
        sum += off * off;
    }
    return sum;
}

/* At the end every coefficient stands in the middle of its valley. */
static void test_valley(void)
{
    static const struct {
        enum glass_formula formula;
        size_t terms;
    } cases[] = {{GLASS_SELLMEIER, 1}, {GLASS_CAUCHY, 2},  {GLASS_CAUCHY, 4},
                 {GLASS_BUCHDAHL, 3},  {GLASS_CONRADY, 3}, {GLASS_SCHOTT, 6}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct arena arena = {0};
        struct dispersion_fit fit;
        struct error error;
        CHECK(dispersion_fit(&scattered, cases[i].formula, cases[i].terms, &arena, &fit, &error));
        for (size_t j = 0; j < fit.parameter_count; j++) {
            double h = 0.01 * fit.summary.standard_error[j], here = cost_of(&fit, j, 0);
            double up = cost_of(&fit, j, h), down = cost_of(&fit, j, -h);
            CHECK(up > here && down > here);
            CHECK_NEAR((up - down) / (up + down - 2 * here), 0, 0.02, "the middle");
        }
        /* what is linear was there from the start: to rounding, of squares nearly */
        const double start = fit.summary.initial_cost / fit.summary.final_cost - 1;
        CHECK(cases[i].formula == GLASS_SELLMEIER || fabs(start) < 1e-7);
        arena_free(&arena);
    }
}

/* Of long data all counts at the end, whatever the starts were chosen by. */
static void test_long(void)
{
    enum { MANY = 4001, STEP = 10, FEW = (MANY - 1) / STEP + 1 };
    static double l[MANY], n[MANY], few_l[FEW], few_n[FEW];
    struct arena arena = {0};
    struct error error;
    for (int i = 0; i < MANY; i++) {
        l[i] = 0.4 + 0.6 * i / (MANY - 1);
        n[i] = n_bk7(l[i]) + 1e-6 * sin(17.0 * i); /* as good as scatter */
        few_l[i / STEP] = i % STEP == 0 ? l[i] : few_l[i / STEP];
        few_n[i / STEP] = i % STEP == 0 ? n[i] : few_n[i / STEP];
    }
    struct dispersion_fit all, some;
    const struct dispersion_data data = {MANY, l, n, NULL}, thin = {FEW, few_l, few_n, NULL};
    CHECK(dispersion_fit(&data, GLASS_SELLMEIER, 3, &arena, &all, &error));
    CHECK(dispersion_fit(&thin, GLASS_SELLMEIER, 3, &arena, &some, &error));
    double cost_all = 0, cost_some = 0;
    for (int i = 0; i < MANY; i++) {
        cost_all += pow(glass_n(&all.glass, l[i]) - n[i], 2);
        cost_some += pow(glass_n(&some.glass, l[i]) - n[i], 2);
    }
    CHECK(cost_all < cost_some);
    CHECK_NEAR(sqrt(cost_all / MANY), 1e-6 / sqrt(2), 2e-8, "the scatter");
    arena_free(&arena);
}

int main(void)
{
    test_long();
    test_weighted();
    test_valley();
    test_recovered();
    test_coefficients();
    test_terms_and_weights();
    test_refusals();
    return check_report();
}
