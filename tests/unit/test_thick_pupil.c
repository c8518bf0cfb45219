/* tests/unit/test_thick_pupil.c - a pupil fitted to rays by normal equations; errors of rays. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "design/fit/thick.h"

/* x, y, p, q before the lens, place in the stop, weight: near place 7.5, radius 11 (1 + 0.36 s). */
static const double rays[][7] = {
    {-0.9181, 1.8429, -0.262, 0.044, -0.26, 0.208, 0.34},
    {-8.745, 13.5235, 0.337, -0.241, -0.531, 0.991, 1.59},
    {2.0892, 11.2255, 0.139, -0.349, 0.27, 0.736, 2.11},
    {5.2713, -6.5634, -0.436, 0.258, 0.182, -0.397, 1.58},
    {3.3515, 7.1852, 0.219, 0.379, 0.428, 0.842, 1.5},
    {-13.3128, -11.6362, 0.436, 0.379, -0.805, -0.728, 1.48},
    {-0.855, -1.0323, 0.127, -0.199, 0.014, -0.228, 1.88},
    {7.2782, 7.1065, 0.404, 0.182, 0.858, 0.713, 0.74},
    {7.3984, -1.8938, 0.361, 0.465, 0.809, 0.138, 2.55},
};
enum { RAYS = sizeof rays / sizeof rays[0] };

/* place, radius, a, their standard errors, rms; without and with spherical aberration. */
static const double expected[2][7] = {
    {7.4110762852291596, 12.003439601296168, 0.0, 0.15419826852047043, 0.085582758923005631, 0.0,
     0.28318127266702584},
    {7.44568905253762, 11.170737824961125, 0.31619214900348138, 0.080856662349100411,
     0.13404786475517306, 0.051567880686313065, 0.14347242720462338},
};

/* On one side the rays above, on the other all of them 3 times as large. */
static void check_fit(bool exit, bool aberration)
{
    struct arena arena = {0};
    double column[7][RAYS], larger[2][RAYS];
    struct thick_pupil pupil;
    struct error error;
    for (size_t i = 0; i < RAYS; i++) {
        for (size_t k = 0; k < 7; k++) {
            column[k][i] = rays[i][k];
        }
        larger[0][i] = 3 * rays[i][0];
        larger[1][i] = 3 * rays[i][1];
    }
    const struct thick_rays all = {.count = RAYS,
                                   .x = larger[0],
                                   .y = larger[1],
                                   .p = column[2],
                                   .q = column[3],
                                   .x_out = column[0],
                                   .y_out = column[1],
                                   .p_out = column[2],
                                   .q_out = column[3],
                                   .stop_x = column[4],
                                   .stop_y = column[5],
                                   .weight = column[6]};
    const double *e = expected[aberration], k = exit ? 1 : 3;
    struct thick_pupil_sums sums = {.rows = 0};
    thick_pupil_add(&all, exit, &sums);
    CHECK(thick_fit_pupil(&sums, exit, aberration, &arena, &pupil, &error));
    CHECK_NEAR(pupil.place, k * e[0], 1e-12, "place");
    CHECK_NEAR(pupil.radius, k * e[1], 1e-12, "radius");
    CHECK_NEAR(pupil.spherical_aberration, e[2], 1e-12, "spherical aberration");
    CHECK_NEAR(pupil.place_error, k * e[3], 1e-12, "its error");
    CHECK_NEAR(pupil.radius_error, k * e[4], 1e-12, "its error");
    CHECK_NEAR(pupil.spherical_aberration_error, e[5], 1e-12, "its error");
    CHECK_NEAR(pupil.rms, k * e[6], 1e-12, "rms");
    arena_free(&arena);
}

/* Rays of the axis alone, parallel: the place is open. */
static void test_open(void)
{
    static const double zero[3] = {0, 0, 0}, x[3] = {1, 2, -3}, stop[3] = {0.1, 0.2, -0.3};
    const struct thick_rays all = {
        .count = 3, .x = x, .y = zero, .p = zero, .q = zero, .stop_x = stop, .stop_y = zero};
    struct arena arena = {0};
    struct thick_pupil pupil;
    struct error error = {0};
    struct thick_pupil_sums sums = {.rows = 0};
    thick_pupil_add(&all, false, &sums);
    CHECK(!thick_fit_pupil(&sums, false, false, &arena, &pupil, &error));
    CHECK(strstr(error.message, "entrance pupil") != NULL);
    arena_free(&arena);
}

/*
 * Rays of one slope through an ideal lens in air, f = 50, H at 4 and H' at -3, as they are and
 * shifted by known amounts: x_out - 3 u' is the height at H, x + 4 u.
 */
static void test_errors(void)
{
    enum { COUNT = 3 };
    static const double x[COUNT] = {1, -2, 0.5}, y[COUNT] = {3, 0.25, -4};
    static const double p[COUNT] = {0.1, -0.05, 0}, q[COUNT] = {0.02, 0.2, -0.1};
    static const double off_x[COUNT] = {0.3, -0.1, 0}, off_p[COUNT] = {0.01, 0.02, -0.05};
    static const double weight[COUNT] = {1, 2, 5}, plane = 20;
    static const size_t group[COUNT] = {0, 1, 1};
    const struct thick_lens lenses[2] = {{.focal = 50,
                                          .front = 4,
                                          .rear = -3,
                                          .index_object = 1,
                                          .index_image = 1,
                                          .object = INFINITY},
                                         {.focal = 40,
                                          .front = 4,
                                          .rear = -3,
                                          .index_object = 1,
                                          .index_image = 1,
                                          .object = INFINITY}};
    double x_out[COUNT], y_out[COUNT], p_out[COUNT], q_out[COUNT], dx[COUNT], dy[COUNT];
    double sum = 0;
    for (int i = 0; i < COUNT; i++) {
        double h = x[i] + 4 * p[i], k = y[i] + 4 * q[i], f = group[i] == 0 ? 50 : 40;
        p_out[i] = p[i] - h / f + off_p[i];
        q_out[i] = q[i] - k / f;
        x_out[i] = h + 3 * (p_out[i] - off_p[i]) + off_x[i];
        y_out[i] = k + 3 * q_out[i] - 0.125;
        double far = off_x[i] + plane * off_p[i];
        sum += weight[i] * (far * far + 0.125 * 0.125);
    }
    struct thick_rays all = {.count = COUNT,
                             .x = x,
                             .y = y,
                             .p = p,
                             .q = q,
                             .x_out = x_out,
                             .y_out = y_out,
                             .p_out = p_out,
                             .q_out = q_out,
                             .weight = weight,
                             .group = group};
    const struct ray_model models[2] = {ray_model_of_thick(MODEL_FITTED, lenses[0], plane),
                                        ray_model_of_thick(MODEL_FITTED, lenses[1], plane)};
    thick_errors(&all, models, dx, dy);
    for (int i = 0; i < COUNT; i++) {
        CHECK_NEAR(dx[i], -(off_x[i] + plane * off_p[i]), 1e-14, "dx");
        CHECK_NEAR(dy[i], 0.125, 1e-14, "dy");
    }
    struct thick_score score = {.largest = 0};
    thick_score_add(&all, models, 0, &score);
    CHECK_NEAR(score.rms[0], sqrt(sum / 8), 1e-14, "rms");
}

int main(void)
{
    test_errors();
    for (int k = 0; k < 4; k++) {
        check_fit(k % 2 != 0, k / 2 != 0);
    }
    test_open();
    return check_report();
}
