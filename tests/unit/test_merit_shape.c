/* tests/unit/test_merit_shape.c - edges and air beyond radii, and between axis and edge. */
/* SPDX-License-Identifier: MIT */
#include "merit_check.h"

/* Half of it is the edge of what follows. */
#define WIDE "30"

/* A ball that is wider than its front may be: 15 mm from the axis of a radius of 14 and more. */
static const char ball[] = "wavelength d\n"
                           "object inf\n"
                           "aperture epd 4\n"
                           "surface 20 9 1.5 " WIDE "\n"
                           "surface -60 10 air " WIDE "\n";

static const char conic[] = "wavelength d\n"
                            "object inf\n"
                            "aperture epd 4\n"
                            "surface 20 9 1.5 " WIDE " k=0.4 A4=1e-6\n"
                            "surface -60 10 air " WIDE "\n";

/* Air between two surfaces that are convex to it, both as wide. */
static const char gap[] = "wavelength d\n"
                          "object inf\n"
                          "aperture epd 4\n"
                          "surface - 3 1.5 " WIDE "\n"
                          "surface 20 2 air " WIDE "\n"
                          "surface -18 3 1.5 " WIDE "\n"
                          "surface - 30 air " WIDE "\n";

/* A meniscus whose rear is narrower than its front. */
static const char meniscus[] = "wavelength d\n"
                               "object inf\n"
                               "aperture epd 4\n"
                               "surface 30 7 1.5 " WIDE "\n"
                               "surface 12 10 air 22\n";

/* The sag of a conic and A4 r^4 at r by its formula; NaN where there is none. */
static double exact_sag(double c, double k, double A4, double r)
{
    return c * r * r / (1 + sqrt(1 - (1 + k) * c * c * r * r)) + A4 * r * r * r * r;
}

/* The residual of a merit by its only variable, and its slope. */
static double shape_at(struct merit_bench *bench, double x, size_t residual, double *slope)
{
    double residuals[8] = {0}, jacobian[8] = {0};
    CHECK(bench->merit.residual_count <= 8);
    CHECK(merit_measure(&bench->merit, &x, residuals, jacobian));
    *slope = jacobian[residual];
    return residuals[residual];
}

/* Slopes by the only variable against differences with steps h, h/2 and h/4. */
static void check_slope(struct merit_bench *bench, double x, size_t residual, double h,
                        double tolerance)
{
    double d[3], slope, ignored;
    for (int i = 0; i < 3; i++, h /= 2) {
        d[i] = (shape_at(bench, x + h, residual, &ignored) -
                shape_at(bench, x - h, residual, &ignored)) /
               (2 * h);
    }
    const double first = (4 * d[1] - d[0]) / 3, second = (4 * d[2] - d[1]) / 3;
    shape_at(bench, x, residual, &slope);
    CHECK_NEAR(slope, (16 * second - first) / 15, tolerance * fmax(1, fabs(slope)), "slope");
}

/* -------- beyond the radius -------- */

/*
 * The curvature of the front through where it ends at the edge, (1+k) c^2 15^2 = 1. Before it, to
 * 0.05 of the cosine of its slope, the edge is 9 + z2 - z1 exactly; then it goes on without a jump
 * and with the slopes that differences have, to where the radius is half the edge.
 */
static void test_wall(const char *text, double k, double A4)
{
    const struct merit_case of = {"wall", text, "c1", "edge=0", 0};
    const double wall = 1 / (15 * sqrt(1 + k)), last = wall * sqrt(1 - 0.05 * 0.05);
    struct arena arena = {0};
    struct error error;
    struct merit_bench *bench = ARENA_NEW(&arena, struct merit_bench);
    double slope, before;
    CHECK(merit_bench_open(bench, &of, &arena, &error));
    for (int i = -19; i < 20; i++) {
        const double c = last * i / 20;
        const double edge = 9 + exact_sag(-1.0 / 60, 0, 0, 15) - exact_sag(c, k, A4, 15);
        CHECK_NEAR(shape_at(bench, c, 0, &slope), edge, 1e-12, "the edge that there is");
        check_slope(bench, c, 0, 1e-5, 1e-7);
    }
    /* on both sides of where the tangent begins, and of the wall */
    const double at[] = {last, wall};
    for (int i = 0; i < 2; i++) {
        double left, right;
        const double low = shape_at(bench, at[i] * (1 - 1e-12), 0, &left);
        const double high = shape_at(bench, at[i] * (1 + 1e-12), 0, &right);
        CHECK_NEAR(low, high, 1e-7, "no jump");
        CHECK_RELATIVE(left, right, 1e-7, "no kink");
        check_slope(bench, at[i] * (1 - 1e-4), 0, 1e-9, 1e-4);
        check_slope(bench, at[i] * (1 + 1e-4), 0, 1e-9, 1e-4);
    }
    before = shape_at(bench, wall, 0, &slope);
    for (int i = 1; i <= 20; i++) {
        const double c = wall * (1 + i / 20.0), edge = shape_at(bench, c, 0, &slope);
        check_slope(bench, c, 0, 1e-6, 1e-7);
        CHECK(isfinite(edge) && edge < before); /* worse, the farther it is beyond */
        before = edge;
    }
    arena_free(&arena);
}

/* The same by the conic constant: the tangent begins at another place. */
static void test_wall_of_conic(void)
{
    const struct merit_case of = {"conic", conic, "k1", "edge=0", 0};
    struct arena arena = {0};
    struct error error;
    struct merit_bench *bench = ARENA_NEW(&arena, struct merit_bench);
    double slope;
    CHECK(merit_bench_open(bench, &of, &arena, &error));
    for (int i = -8; i <= 40; i++) { /* the wall is at k = (20/15)^2 - 1 = 0.78 */
        const double k = i / 10.0 + 0.05;
        const double edge = 9 + exact_sag(-1.0 / 60, 0, 0, 15) - exact_sag(0.05, k, 1e-6, 15);
        const double mine = shape_at(bench, k, 0, &slope);
        CHECK(isfinite(mine));
        if (k < 0.77) {
            CHECK_NEAR(mine, edge, 1e-12, "the edge that there is");
        }
        check_slope(bench, k, 0, 1e-6, 1e-6);
    }
    arena_free(&arena);
}

/* Air at its rim, the second residual, through the end of the surface before it. */
static void test_wall_of_air(void)
{
    const struct merit_case of = {"air", gap, "c2", "air=0", 0};
    struct arena arena = {0};
    struct error error;
    struct merit_bench *bench = ARENA_NEW(&arena, struct merit_bench);
    double slope;
    CHECK(merit_bench_open(bench, &of, &arena, &error));
    for (int i = -18; i <= 40; i++) {
        const double c = i / 300.0 + 1e-4;
        const double air = 2 + exact_sag(-1.0 / 18, 0, 0, 15) - exact_sag(c, 0, 0, 15);
        const double mine = shape_at(bench, c, 1, &slope);
        CHECK(isfinite(mine));
        if (fabs(15 * c) < 0.998) {
            CHECK_NEAR(mine, air, 1e-12, "the air that there is");
        }
        check_slope(bench, c, 1, 1e-7, 1e-6);
        CHECK_NEAR(shape_at(bench, c, 0, &slope), 2, 1e-12, "on the axis");
    }
    arena_free(&arena);
}

/*
 * Beyond its own 11 mm the rear is flat as long as it is hollow, there its curve would leave more;
 * bent the other way it goes on. So at 15 mm: 7 + z2(11 or 15) - z1(15), through c = 1/11, where
 * there is no sphere that is 15 mm wide.
 */
static void test_bevel(void)
{
    const struct merit_case of = {"bevel", meniscus, "c2", "edge=0", 0};
    struct arena arena = {0};
    struct error error;
    struct merit_bench *bench = ARENA_NEW(&arena, struct merit_bench);
    double slope;
    CHECK(merit_bench_open(bench, &of, &arena, &error));
    for (int i = -6; i <= 9; i++) {
        const double c = i / 100.0 + 1e-4;
        const double edge = 7 + exact_sag(c, 0, 0, c > 0 ? 11 : 15) - exact_sag(1.0 / 30, 0, 0, 15);
        CHECK_NEAR(shape_at(bench, c, 0, &slope), edge, 1e-12, "edge with a bevel");
        check_slope(bench, c, 0, 1e-6, 1e-7);
    }
    arena_free(&arena);
}

/* -------- between axis and edge -------- */

/* Air of 0.3 mm between two aspheres, 3 mm wide, by five numbers. */
static const char aspheres[] = "wavelength d\n"
                               "object inf\n"
                               "aperture epd 1\n"
                               "surface - 1 1.5 3\n"
                               "surface - %.17g air 3 c=%.17g A4=%.17g\n"
                               "surface - 1 1.5 3 c=%.17g k=%.17g A6=%.17g\n"
                               "surface - 5 air 3\n";

static double aspheres_gap(const double v[6], double r)
{
    const double rear = exact_sag(v[3], v[4], 0, r) + v[5] * pow(r, 6);
    return v[0] + rear - exact_sag(v[1], 0, v[2], r);
}

/* Their air on the axis, at the edge, and the least of 20,001 places. */
struct scan {
    double axis, edge, least;
};

static struct scan scan_of(const double v[6])
{
    enum { PLACES = 20000 };
    struct scan scan = {aspheres_gap(v, 0), aspheres_gap(v, 1.5), INFINITY};
    for (int i = 0; i <= PLACES; i++) {
        scan.least = fmin(scan.least, aspheres_gap(v, 1.5 * i / PLACES));
    }
    return scan;
}

/* The second figure of air: the edge, or the least where that is clearly less than both. */
static double least_of(const double v[6])
{
    const struct scan scan = scan_of(v);
    const double lower = fmin(scan.axis, scan.edge);
    return fmax(scan.least, scan.edge - 200 * (lower - scan.least));
}

/* Numbers by chance; how often each kind of air was met. */
static void test_least(void)
{
    unsigned long long state = 5;
    int edges = 0, middles = 0, joints = 0;
    for (int turn = 0; turn < 200; turn++) {
        const double v[6] = {
            merit_between(&state, 0.05, 0.5),   merit_between(&state, -0.3, 0.3),
            merit_between(&state, -0.06, 0.06), merit_between(&state, -0.3, 0.3),
            merit_between(&state, -2, 2),       merit_between(&state, -0.03, 0.03)};
        char text[1000];
        snprintf(text, sizeof text, aspheres, v[0], v[1], v[2], v[3], v[4], v[5]);
        const struct merit_case of = {"aspheres", text, "t2 c2 A4_2 c3 k3 A6_3", "air=0", 0};
        struct arena arena = {0};
        struct error error;
        struct merit_bench *bench = ARENA_NEW(&arena, struct merit_bench);
        double residuals[2], jacobian[12];
        CHECK(merit_bench_open(bench, &of, &arena, &error));
        CHECK(bench->merit.residual_count == 2);
        CHECK(merit_measure(&bench->merit, v, residuals, jacobian));
        const struct scan scan = scan_of(v);
        CHECK_NEAR(residuals[0], v[0], 1e-14, "axis");
        CHECK_NEAR(residuals[1], least_of(v), 2e-6, "least");
        const bool is_edge = residuals[1] == scan.edge || fabs(residuals[1] - scan.edge) < 1e-12;
        const bool is_least = fabs(residuals[1] - scan.least) < 1e-7;
        edges += is_edge && !is_least;
        middles += is_least && scan.least < fmin(scan.axis, scan.edge) - 1e-3;
        joints += !is_edge && !is_least;
        /* what counts is found: no less than a part of the edge is overlooked */
        CHECK(fmin(residuals[0], residuals[1]) - scan.least <=
              0.005 * fmax(0, scan.edge - scan.axis) + 1e-9);
        for (size_t j = 0; j < 6; j++) {
            double d[2], w[6];
            memcpy(w, v, sizeof w);
            for (int i = 0; i < 2; i++) {
                double beside[2];
                w[j] = v[j] + (i == 0 ? -1e-6 : 1e-6);
                CHECK(merit_measure(&bench->merit, w, beside, NULL));
                d[i] = beside[1];
            }
            CHECK(merit_measure(&bench->merit, v, residuals, jacobian));
            const double slope = (d[1] - d[0]) / 2e-6, mine = jacobian[6 + j];
            CHECK_NEAR(mine, slope, 1e-5 * fmax(1, fabs(mine)), "slope of the least");
        }
        arena_free(&arena);
    }
    CHECK(edges > 20 && middles > 20 && joints > 0);
}

/* From air that is least on the axis to one that is least beside it, in small steps: no jump. */
static void test_joint(void)
{
    double last = NAN, most = 0;
    for (int i = 0; i <= 2000; i++) {
        const double v[6] = {0.3, 0.1 * (i - 1000) / 1000, -0.02, 0, 0, 0};
        char text[1000];
        snprintf(text, sizeof text, aspheres, v[0], v[1], v[2], v[3], v[4], v[5]);
        const struct merit_case of = {"joint", text, "c2", "air=0", 0};
        struct arena arena = {0};
        struct error error;
        struct merit_bench *bench = ARENA_NEW(&arena, struct merit_bench);
        double slope;
        CHECK(merit_bench_open(bench, &of, &arena, &error));
        const double here = shape_at(bench, v[1], 1, &slope);
        most = fmax(most, i > 0 ? fabs(here - last) : 0);
        last = here;
        arena_free(&arena);
    }
    CHECK(most < 0.002); /* of a range of 0.2 */
}

int main(void)
{
    test_wall(ball, 0, 0);
    test_wall(conic, 0.4, 1e-6);
    test_wall_of_conic();
    test_wall_of_air();
    test_bevel();
    test_least();
    test_joint();
    return check_report();
}
