/* tests/unit/test_equivalent.c - equivalent lenses, published examples and dof's formulas. */
/* SPDX-License-Identifier: MIT */
#include "photo/equivalent.h"

#include <stdint.h>
#include <stdlib.h>

#include "check.h"

#define NONE ((double)NAN)

static const struct sensor full = {36, 24, NONE}, four_thirds = {17.3, 13, NONE};

/* James, Equivalence, quoted at dpreview.com post 53107559 and 50563808; his crop factors. */
static void test_published(void)
{
    static const struct {
        double f, N, k, f_equal, N_equal, tolerance_f, tolerance_N;
        const char *source;
    } rows[] = {
        {25, 1.4, 2, 50, 2.8, 1e-12, 1e-12, "25/1.4 on 4/3 = 50/2.8 on 35 mm"},
        {25, 1.4, 2 / 1.6, 31, 1.8, 0.5, 0.06, "25/1.4 on 4/3 = 31/1.8 on Canon APS-C"},
        {25, 1.4, 2 / 1.5, 33, 1.9, 0.5, 0.06, "25/1.4 on 4/3 = 33/1.9 on APS-C"},
        {50, 2, 2, 100, 4, 1e-12, 1e-12, "50/2 on 4/3 = 100/4 on 35 mm"},
        {50, 2, 2 / 1.5, 67, 2.7, 0.5, 0.05, "50/2 on 4/3 = 67/2.7 on DX"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct equivalent_setting s = {rows[i].f, rows[i].N, 0, 1, 200, 0.015};
        struct equivalent e;
        struct error error;
        CHECK(equivalent_compute(&s, rows[i].k, EQUIVALENT_PICTURE, &e, &error));
        CHECK_NEAR(e.f, rows[i].f_equal, rows[i].tolerance_f, rows[i].source);
        CHECK_NEAR(e.N, rows[i].N_equal, rows[i].tolerance_N, rows[i].source);
        CHECK_RELATIVE(e.pupil_diameter, rows[i].f / rows[i].N, 1e-14, "the same pupil");
        CHECK_RELATIVE(e.iso, 200 * rows[i].k * rows[i].k, 1e-14, "ISO k^2");
        CHECK_RELATIVE(e.c, 0.015 * rows[i].k, 1e-14, "c scales");
        CHECK_NEAR(e.light_stops, 0, 0, "the same light");
    }
}

static void test_ratio(void)
{
    static const struct {
        enum equivalent_measure measure;
        double k;
        const char *source;
    } rows[] = {
        {EQUIVALENT_DIAGONAL, 1.99938271, "43.2666153/21.6400092"},
        {EQUIVALENT_WIDTH, 36 / 17.3, "widths"},
        {EQUIVALENT_HEIGHT, 24 / 13.0, "heights"},
        {EQUIVALENT_AREA, 1.95999, "sqrt(864/224.9)"},
    };
    double k, back;
    struct error error;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        CHECK(equivalent_ratio(&four_thirds, &full, rows[i].measure, &k, &error));
        CHECK_NEAR(k, rows[i].k, 1e-4, rows[i].source);
        CHECK(equivalent_ratio(&full, &four_thirds, rows[i].measure, &back, &error));
        CHECK_RELATIVE(k * back, 1.0, 1e-15, "there and back");
    }
    struct sensor dx = {23.7, 15.6, NONE}, bad = {0, 24, NONE};
    CHECK(equivalent_ratio(&dx, &full, EQUIVALENT_DIAGONAL, &k, &error));
    CHECK_NEAR(k, 1.525, 0.001, "Nikon DX 23.7 x 15.6: crop 1.52 (maker: 1.5x)");
    CHECK(!equivalent_ratio(&bad, &full, EQUIVALENT_WIDTH, &k, &error));
    CHECK(!equivalent_ratio(&full, &bad, EQUIVALENT_WIDTH, &k, &error));
}

static double uniform(uint64_t *state)
{
    *state = *state * 6364136223846793005U + 1442695040888963407U;
    return (double)(*state >> 11) / 9007199254740992.0;
}

/* Front and behind from the entrance pupil, lenscalc.7, photography: X eps/(1 +- eps), eps = N c/(m
 * f). */
static void field_depth(double f, double N, double c, double m, double P, double *X, double *eps)
{
    *X = f * (1 / m + 1 / P);
    *eps = N * c / (m * f);
}

/* At any finite distance: perspective, framing, depth of field, total light, exposure. */
static void test_finite(void)
{
    uint64_t state = 23;
    for (int i = 0; i < 3000; i++) {
        struct equivalent_setting s = {10 + 300 * uniform(&state),
                                       1 + 20 * uniform(&state),
                                       2 * uniform(&state) + 1e-4,
                                       0.5 + uniform(&state),
                                       400,
                                       0.01 + 0.05 * uniform(&state)};
        double k = 0.2 + 6 * uniform(&state), X, eps, X_new, eps_new;
        struct equivalent e, back;
        struct error error;
        CHECK(equivalent_compute(&s, k, EQUIVALENT_PICTURE, &e, &error));
        field_depth(s.f, s.N, s.c, s.m, s.P, &X, &eps);
        field_depth(e.f, e.N, e.c, e.m, s.P, &X_new, &eps_new);
        CHECK_RELATIVE(X_new, X, 1e-13, "same perspective");
        CHECK_RELATIVE(eps_new, eps, 1e-13, "same depth of field");
        CHECK_RELATIVE(e.f / e.N, s.f / s.N, 1e-13, "same pupil at the same distance: same light");
        double working = s.N * (1 + s.m / s.P);
        CHECK_RELATIVE(e.working_fnumber, k * working, 1e-13, "N_eff k times, at any distance");
        CHECK_RELATIVE(e.iso / (e.working_fnumber * e.working_fnumber), s.iso / (working * working),
                       1e-13, "same brightness of the picture");
        struct equivalent_setting there = {e.f, e.N, e.m, s.P, e.iso, e.c};
        CHECK(equivalent_compute(&there, 1 / k, EQUIVALENT_PICTURE, &back, &error));
        CHECK_RELATIVE(back.f, s.f, 1e-13, "back: f");
        CHECK_RELATIVE(back.N, s.N, 1e-13, "back: N");
        CHECK_RELATIVE(back.iso, s.iso, 1e-13, "back: ISO");
        CHECK(equivalent_compute(&s, k, EQUIVALENT_EXPOSURE, &e, &error));
        field_depth(e.f, e.N, e.c, e.m, s.P, &X_new, &eps_new);
        CHECK_RELATIVE(e.working_fnumber, working, 1e-13, "same exposure");
        CHECK_RELATIVE(eps_new / eps, e.field_depth_ratio, 1e-13, "depth of field changes 1/k");
        CHECK_RELATIVE(pow(2, e.light_stops), k * k, 1e-12, "total light k^2");
    }
}

static void test_refusals(void)
{
    static const struct {
        struct equivalent_setting setting;
        double k;
        const char *words;
    } rows[] = {
        {{0, 4, 0, 1, 100, 0}, 2, "focal length 0 mm"},
        {{50, 0, 0, 1, 100, 0}, 2, "f-number"},
        {{50, 4, -1, 1, 100, 0}, 2, "magnification"},
        {{50, 4, 0, NONE, 100, 0}, 2, "pupil magnification"},
        {{50, 4, 0, 1, -100, 0}, 2, "ISO speed -100"},
        {{50, 4, 0, 1, 100, -1}, 2, "circle of confusion -1"},
        {{50, 4, 0, 1, 100, 0}, 0, "formats"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct equivalent e;
        struct error error;
        CHECK(!equivalent_compute(&rows[i].setting, rows[i].k, EQUIVALENT_PICTURE, &e, &error));
        CHECK(error.code == ERROR_DOMAIN);
        check_at(strstr(error.message, rows[i].words) != NULL, __FILE__, __LINE__, rows[i].words);
    }
}

int main(void)
{
    test_published();
    test_ratio();
    test_finite();
    test_refusals();
    return check_report();
}
