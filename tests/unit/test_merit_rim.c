/* tests/unit/test_merit_rim.c - rays through a stop of the size of the exact marginal ray. */
/* SPDX-License-Identifier: MIT */
#include "merit_check.h"

/* By far more than paraxial beams: the marginal ray is 5 % off in the stop. */
static const char fast[] = "wavelength d F C\n"
                           "field angle 0 3\n"
                           "aperture f/5.6 real\n"
                           "focus paraxial\n"
                           "surface 40 8 1.62/60 -\n"
                           "surface -300 18 air - k=0.4\n"
                           "stop - 6 air -\n"
                           "surface -40 2 1.7/30 -\n"
                           "surface 90 20 air - A4=1e-6\n";

static const char near[] = "wavelength d F\n"
                           "object 150\n"
                           "field height 0 3\n"
                           "aperture na 0.12 real\n"
                           "focus paraxial\n"
                           "surface 60 6 1.6/50 -\n"
                           "surface -90 12 air -\n"
                           "stop - 10 air -\n"
                           "surface 90 5 1.65/40 -\n"
                           "surface -80 90 air -\n";

/* A lens beside the axis: the marginal ray is beside it, too. */
static const char aside[] = "wavelength d F\n"
                            "field angle 0 3\n"
                            "aperture f/8 real\n"
                            "focus paraxial\n"
                            "surface 40 8 1.62/60 -\n"
                            "surface -300 18 air - decenter=0.2,0.1\n"
                            "stop - 6 air -\n"
                            "surface -40 2 1.7/30 -\n"
                            "surface 90 20 air -\n";

static const struct merit_case cases[] = {
    {"fast", fast, "R1 R2 t2 t3 R4 n1 k2 A4_5", "poly", 2e-6},
    {"fast opd", fast, "R1 t2 R4", "opd", 2e-6},
    {"aside", aside, "R1 R2 t2 n1", "spot", 2e-6},
    {"near", near, "R1 R2 t2 t3 R4 n4", "spot", 2e-6},
    {"edges", fast, "R1 t2 R5", "edge > 1, air > 1", 2e-6},
};

/* Derivatives of residuals beside differences of them, without the term h^2. */
static void check_derivatives(const struct merit_case *of)
{
    struct arena arena = {0};
    struct error error;
    struct merit_bench *bench = ARENA_NEW(&arena, struct merit_bench);
    const bool open = merit_bench_open(bench, of, &arena, &error);
    CHECK(open);
    if (!open) {
        printf("    %s: %s\n", of->name, error.message);
        arena_free(&arena);
        return;
    }
    const size_t m = bench->merit.residual_count, n = bench->count;
    double *jacobian = ARENA_ARRAY(&arena, m * n, double);
    double *beside = ARENA_ARRAY(&arena, 4 * m, double);
    double *residuals = ARENA_ARRAY(&arena, m, double);
    CHECK(merit_measure(&bench->merit, bench->v, residuals, jacobian));
    for (size_t j = 0; j < n; j++) {
        const double h = merit_step(bench, j) / 4, at[] = {-h, h, -h / 2, h / 2};
        double largest = 0;
        for (size_t k = 0; k < 4; k++) {
            double v[MERIT_MOST];
            memcpy(v, bench->v, sizeof v);
            v[j] += at[k];
            CHECK(merit_measure(&bench->merit, v, &beside[k * m], NULL));
        }
        for (size_t i = 0; i < m; i++) {
            largest = fmax(largest, fabs(jacobian[i * n + j]));
        }
        for (size_t i = 0; i < m; i++) {
            const double wide = (beside[m + i] - beside[i]) / (2 * h);
            const double narrow = (beside[3 * m + i] - beside[2 * m + i]) / h;
            CHECK_NEAR(jacobian[i * n + j], (4 * narrow - wide) / 3,
                       of->tolerance * largest + 1e-11, bench->list[j].name);
        }
    }
    /* the stop is as the exact ray has it, and nothing paraxial has changed */
    const struct merit_place *place = &bench->merit.places[0];
    CHECK(place->stop != NULL);
    if (place->stop == NULL) {
        printf("    %s: %s\n", of->name, bench->merit.why.message);
        arena_free(&arena);
        return;
    }
    const double paraxial = fabs(place->setup.first.stop_radius);
    CHECK(fabs(place->stop[0].value / paraxial - 1) > 1e-3);
    double radius;
    CHECK(setup_marginal_stop(&place->setup, &radius, &error));
    merit_measure(&bench->merit, bench->v, residuals, NULL);
    CHECK_NEAR(place->stop[0].value, radius, 1e-12 * radius, of->name);
    arena_free(&arena);
}

int main(void)
{
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        check_derivatives(&cases[i]);
    }
    return check_report();
}
