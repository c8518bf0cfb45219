/* tests/ceres/test_dispersion.c - dispersion formulas from indices. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "design/dispersion.h"

enum { POINTS = 30 };

/* SCHOTT N-BK7, data sheet 2014: Sellmeier coefficients. */
static double n_bk7(double l)
{
    double x = l * l;
    return sqrt(1 + 1.03961212 * x / (x - 0.00600069867) + 0.231792344 * x / (x - 0.0200179144) +
                1.01046945 * x / (x - 103.560653));
}

static double table_l[POINTS], table_n[POINTS];

static struct dispersion_data bk7_data(double from, double to)
{
    for (int i = 0; i < POINTS; i++) {
        table_l[i] = from + (to - from) * i / (POINTS - 1);
        table_n[i] = n_bk7(table_l[i]);
    }
    return (struct dispersion_data){POINTS, table_l, table_n, NULL};
}

/* Between the points too. */
static double worst(const struct glass *glass, double from, double to)
{
    double largest = 0;
    for (int i = 0; i <= 500; i++) {
        double l = from + (to - from) * i / 500;
        largest = fmax(largest, fabs(glass_n(glass, l) - n_bk7(l)));
    }
    return largest;
}

static void test_sellmeier(void)
{
    struct arena arena = {0};
    struct dispersion_fit fit;
    struct error error;
    const struct dispersion_data data = bk7_data(0.33, 2.3);
    CHECK(dispersion_fit(&data, GLASS_SELLMEIER, 3, &arena, &fit, &error));
    CHECK_NEAR(worst(&fit.glass, 0.33, 2.3), 0, 1e-10, "N-BK7 from its own indices");
    printf("worst %.3g rms %.3g iterations %d status %d\n", worst(&fit.glass, 0.33, 2.3), fit.rms,
           fit.summary.iterations, fit.summary.status);
    CHECK(fit.glass.shortest == 0.33 && fit.glass.longest == 2.3);
    arena_free(&arena);
}

int main(void)
{
    test_sellmeier();
    for (int f = 0; f < 5; f++) {
        const enum glass_formula all[] = {GLASS_SELLMEIER, GLASS_SCHOTT, GLASS_CAUCHY,
                                          GLASS_BUCHDAHL, GLASS_CONRADY};
        for (size_t terms = 1; terms < 8; terms++) {
            struct arena arena = {0};
            struct dispersion_fit fit;
            struct error error;
            const struct dispersion_data data = bk7_data(0.4, 0.7);
            if (dispersion_fit(&data, all[f], terms, &arena, &fit, &error)) {
                printf("%d %zu worst %.3g\n", all[f], terms, worst(&fit.glass, 0.4, 0.7));
            }
            arena_free(&arena);
        }
    }
    return check_report();
}
