/* tests/unit/test_refract.c - one surface: conjugates, exact rays, their differences. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "optics/refract.h"

#include <float.h>

#include "check.h"

#define DEGREE RADIANS_PER_DEGREE

static struct error error;

static struct refract_surface solved(double n, double n_after, double R, double z, double z_image)
{
    struct refract_surface s = {n, n_after, R, z, z_image, false};
    CHECK(refract_solve(&s, &error));
    return s;
}

static struct refract_ray traced(struct refract_surface s, double height, double angle)
{
    const struct refract_aim aim = {height, angle, false};
    struct refract_ray ray = {0};
    if (!isnan(angle) && !isnan(height)) {
        s.z = NAN;
    }
    CHECK(refract_place(&s, &aim, &ray, &error));
    s.z = ray.z;
    s.z_image = NAN;
    CHECK(refract_solve(&s, &error) && refract_through(&s, &ray, &error));
    return ray;
}

/* n'/z' = n/z + (n' - n)/R in small whole numbers. */
static void test_conjugates(void)
{
    static const struct {
        double n, n_after, R, z, z_image;
        const char *source;
    } cases[] = {
        {1, 1.5, 50, -200, 300, "1.5/300 = -1/200 + 0.5/50"},
        {1, 1.5, 50, -INFINITY, 150, "1.5/150 = 0.5/50"},
        {1, 1.5, 50, -100, INFINITY, "front focus"},
        {1, 1.5, -50, -100, -75, "-1.5/75 = -1/100 - 0.5/50"},
        {4, 3, INFINITY, -400, -300, "apparent depth under water, n = 4/3"},
        {1.5, 1, -10, -50. / 3, -25, "aplanatic points R(n + n')/n, R(n + n')/n'"},
        {1, 1.25, -20, 40, 66.66666666666667,
         "virtual object, 1.25/z' = 1/40 - 0.25/20 = 1/80 "
         "x 1.5"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        double n = cases[i].n, after = cases[i].n_after, R = cases[i].R;
        double z = cases[i].z, image = cases[i].z_image;
        if (i == 6) {
            image = 1.25 / (1 / 40. - 0.25 / 20);
        }
        double tolerance = 8 * DBL_EPSILON;
        CHECK_RELATIVE(solved(n, after, R, z, NAN).z_image, image, tolerance, cases[i].source);
        CHECK_RELATIVE(solved(n, after, R, NAN, image).z, z, tolerance, cases[i].source);
        CHECK_RELATIVE(solved(n, after, NAN, z, image).R, R, tolerance, cases[i].source);
        CHECK_RELATIVE(solved(n, NAN, R, z, image).n_after, after, tolerance, cases[i].source);
        CHECK_RELATIVE(solved(NAN, after, R, z, image).n, n, tolerance, cases[i].source);
    }
}

static double missing(unsigned bit, unsigned which, double value)
{
    return bit == which ? NAN : value;
}

/* Rays with heights and places by 50-digit arithmetic: Snell's law as vectors, lines cut. */
static void test_rays(void)
{
    static const struct {
        double n, n_after, R, z, height;
        double crossing, image, difference, transverse;
        double u, i, i_after, u_after; /* paraxial */
    } rows[] = {
        {1, 1.5, 50, -200, 10, 2.86877819032957065052e+2, 3.00000000000000000000e+2,
         -1.31221809670429349478e+1, -4.59029996037102064376e-1, 5.00000000000000000000e-2,
         2.50000000000000000000e-1, 1.66666666666666666667e-1, -3.33333333333333333333e-2},
        {1.33, 1.7, -30, -45, 8, -4.05989971334807468162e+1, -4.05835543766578249337e+1,
         -1.54427568229218825391e-2, 3.12664470566921489931e-3, 1.77777777777777777778e-1,
         -8.88888888888888888889e-2, -6.95424836601307189542e-2, 1.97124183006535947712e-1},
        {1.5, 1, -40, 60, -6, 2.53070935742887023851e+1, 2.66666666666666666667e+1,
         -1.35957309237796428159e+0, 3.16675008399805659682e-1, 1.00000000000000000000e-1,
         2.50000000000000000000e-1, 3.75000000000000000000e-1, 2.25000000000000000000e-1},
        {1, 1.6, 25, -INFINITY, 12, 6.35187693949609838350e+1, 6.66666666666666666667e+1,
         -3.14789727170568283163e+0, -6.24887780281201848086e-1, 0.00000000000000000000e+20,
         4.80000000000000000000e-1, 3.00000000000000000000e-1, -1.80000000000000000000e-1},
    };
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
        const struct refract_surface s =
            solved(rows[k].n, rows[k].n_after, rows[k].R, rows[k].z, NAN);
        const struct refract_ray ray = traced(s, rows[k].height, NAN);
        CHECK_RELATIVE(s.z_image, rows[k].image, 1e-15, "Gaussian image");
        CHECK_RELATIVE(ray.crossing, rows[k].crossing, 1e-14, "crossing");
        CHECK_RELATIVE(ray.difference, rows[k].difference, 1e-13, "difference");
        CHECK_RELATIVE(ray.transverse, rows[k].transverse, 1e-13, "transverse");
        CHECK_NEAR(ray.paraxial_slope, rows[k].u, 1e-16, "u");
        CHECK_NEAR(ray.paraxial_incidence, rows[k].i, 1e-16, "i");
        CHECK_NEAR(ray.paraxial_refraction, rows[k].i_after, 1e-16, "i'");
        CHECK_NEAR(ray.paraxial_slope_after, rows[k].u_after, 1e-16, "u'");
    }
}

/* What is solved for, put back. */
static void test_round_trip(void)
{
    unsigned state = 7;
    for (int i = 0; i < 2000; i++) {
        double x[4];
        for (int k = 0; k < 4; k++) {
            state = state * 1664525u + 1013904223u;
            x[k] = state / 4294967296.0;
        }
        double n = 1 + x[0], after = 1 + x[1], R = 400 * (x[2] - 0.5), z = 2000 * (x[3] - 0.7);
        if (fabs(after - n) < 0.01 || fabs(R) < 1 || fabs(z) < 1 || fabs(z - R) < 1) {
            continue;
        }
        double image = solved(n, after, R, z, NAN).z_image;
        double worst = 1e-12 * refract_condition(&(struct refract_surface){n, after, R, z, 0, 0}) *
                       (1 + fabs(R / (z - R)) + fabs(z / (z - R))) / fabs(after - n) *
                       (1 + fabs(image / R)) * (1 + fabs(z / image));
        for (unsigned k = 1; k < 5; k++) {
            struct refract_surface s = solved(missing(k, 1, n), missing(k, 2, after),
                                              missing(k, 3, R), missing(k, 4, z), image);
            CHECK_RELATIVE(s.n, n, worst, "n put back");
            CHECK_RELATIVE(s.n_after, after, worst, "n' put back");
            CHECK_RELATIVE(s.R, R, worst, "R put back");
            CHECK_RELATIVE(s.z, z, worst, "z put back");
        }
    }
}

/* Closed forms of exact rays. */
static void test_exact(void)
{
    /* spherical mirror, parallel ray: R (1 - 1/(2 sqrt(1 - (h/R)^2))); 3-4-5 triangle */
    struct refract_surface mirror = {1, NAN, -100, -INFINITY, NAN, true};
    struct refract_ray ray = traced(mirror, 60, NAN);
    CHECK_RELATIVE(ray.crossing, -37.5, 4 * DBL_EPSILON, "mirror, h = 0.6 R");
    CHECK_RELATIVE(ray.difference, 12.5, 8 * DBL_EPSILON, "mirror, h = 0.6 R: difference");
    CHECK_RELATIVE(ray.sag, -20.0, 4 * DBL_EPSILON, "3-4-5");
    CHECK_RELATIVE(ray.refraction, -ray.incidence, DBL_EPSILON, "law of reflection");
    /* plane, n = 1.5: sin U = 0.4, sin U' = 0.6; z' = z tan U/tan U' */
    struct refract_surface plane = {1.5, 1, INFINITY, -30, NAN, false};
    ray = traced(plane, NAN, asin(0.4));
    CHECK_RELATIVE(ray.slope_after, asin(0.6), 4 * DBL_EPSILON, "plane: Snell");
    CHECK_RELATIVE(ray.crossing, -30 * (0.4 / sqrt(0.84)) / 0.75, 4 * DBL_EPSILON, "plane");
    /* centre of curvature: unbroken */
    struct refract_surface centre = {1, 1.7, 80, 80, NAN, false};
    ray = traced(centre, 70, NAN);
    CHECK(ray.incidence == 0 && ray.refraction == 0);
    CHECK_RELATIVE(ray.slope_after, ray.slope, 4 * DBL_EPSILON, "concentric");
    CHECK_RELATIVE(ray.crossing, 80.0, 4 * DBL_EPSILON, "concentric");
    CHECK_NEAR(ray.difference, 0, 1e-13, "concentric");
    /* vertex: Snell at the axis */
    struct refract_surface s = {1, 1.5, 50, 0, NAN, false};
    ray = traced(s, NAN, 30 * DEGREE);
    CHECK_RELATIVE(sin(ray.slope_after), 1 / 3., 4 * DBL_EPSILON, "through the vertex");
    CHECK(ray.crossing == 0 && ray.height == 0 && ray.difference == 0);
    /* grazing incidence on a plane of an object almost in it: refraction at the critical angle */
    struct refract_surface graze = {1, 1.5, INFINITY, -1e-12, NAN, false};
    ray = traced(graze, 1, NAN);
    CHECK_RELATIVE(ray.incidence, 90 * DEGREE, 1e-11, "grazing");
    CHECK_RELATIVE(sin(ray.refraction), 1 / 1.5, 4 * DBL_EPSILON, "grazing");
}

/* Aplanatic points: no aberration at any height, and Abbe's sine condition n sin U/(n' sin U'). */
static void test_aplanatic(void)
{
    const double n = 1.5, after = 1, R = -10;
    struct refract_surface s = {n, after, R, R * (n + after) / n, NAN, false};
    for (double h = 0.5; h < 6.6; h += 0.5) {
        struct refract_ray ray = traced(s, h, NAN);
        CHECK_NEAR(ray.difference, 0, 4e-14, "aplanatic points");
        CHECK_RELATIVE(ray.crossing, -25.0, 1e-14, "aplanatic points");
        double ratio = n * sin(ray.slope) / (after * sin(ray.slope_after));
        CHECK_RELATIVE(ratio, 2.25, 1e-14, "sine condition: m = (n/n')^2");
    }
}

/* z' of a parallel ray: -n^2 h^2/(2 R n'(n' - n)) to third order, h^2 at any h. */
static void test_small_heights(void)
{
    struct refract_surface s = {1, 1.5, 50, -INFINITY, NAN, false};
    for (double h = 1e-1; h > 1e-9; h /= 10) {
        double third = -2. / 3 * h * h / 50;
        CHECK_RELATIVE(traced(s, h, NAN).difference, third, 4 * DBL_EPSILON + h * h / 2500,
                       "third order");
    }
    struct refract_surface near = {1.2, 1.7, -35, -90, NAN, false};
    double coefficient = traced(near, 1e-8, NAN).difference * 1e16;
    for (double h = 1e-7; h < 0.05; h *= 10) {
        CHECK_RELATIVE(traced(near, h, NAN).difference / (h * h), coefficient, 1e-13 + h * h / 100,
                       "exact - paraxial is of order h^2");
    }
}

/* The textbook's trigonometry in long double; the ray sent back; all three ways to aim. */
static void test_trigonometry(void)
{
    unsigned state = 3;
    for (int i = 0; i < 3000; i++) {
        double x[5];
        for (int k = 0; k < 5; k++) {
            state = state * 1664525u + 1013904223u;
            x[k] = state / 4294967296.0;
        }
        double n = 1 + x[0], after = 1 + x[1],
               R = copysign(10 + 90 * fabs(2 * x[2] - 1), x[2] - 0.5);
        double z = -200 * x[3] - 120, h = 0.4 * fabs(R) * (2 * x[4] - 1);
        struct refract_surface s = {n, after, R, z, NAN, false};
        const struct refract_aim aim = {h, NAN, false};
        struct refract_ray ray = {0};
        if (!refract_place(&s, &aim, &ray, &error) || !refract_solve(&s, &error) ||
            !refract_through(&s, &ray, &error)) {
            continue;
        }
        long double phi = asinl((long double)h / R), sag = 2 * R * sinl(phi / 2) * sinl(phi / 2);
        long double U = atanl(h / (sag - z)), I = U + phi, J = asinl(n * sinl(I) / after);
        long double crossing = sag - h / tanl(J - phi);
        double tolerance = 1e-14 * (1 + fabs((double)(crossing / h)) * fabs(h / R)) *
                           (1 + fabs((double)crossing) / 100);
        CHECK_RELATIVE(ray.crossing, (double)crossing, tolerance, "trigonometric crossing");
        CHECK_NEAR(ray.slope_after, (double)(J - phi), 4 * DBL_EPSILON, "trigonometric slope");
        CHECK_NEAR(ray.difference, (double)(crossing - s.z_image),
                   1e-14 * (1 + fabs(s.z_image)) * (1 + fabs(s.z_image)), "difference");
        if (fabs(ray.crossing) < 1e6) {
            struct refract_surface back = {after, n, -R, -ray.crossing, NAN, false};
            double moved = 1e-13 * (1 + fabs(z / ray.crossing)) * (1 + fabs(ray.crossing / R));
            CHECK_RELATIVE(traced(back, h, NAN).crossing, -z, moved * (1 + fabs(z / R)),
                           "sent back");
        }
        struct refract_ray other = traced(s, h, ray.slope);
        CHECK_RELATIVE(other.slope_after, ray.slope_after, 1e-12, "by height and angle");
        other = traced(s, NAN, ray.slope);
        CHECK_RELATIVE(other.height, h, 1e-12, "by object and angle");
        CHECK_RELATIVE(other.sag, (double)sag, 1e-12, "by object and angle");
    }
}

static void test_vertex_height(void)
{
    /* 3-4-5: the ray through y0 at U = atan(3/4) meets a sphere about R at height h */
    struct refract_surface s = {1, 1.5, 50, NAN, NAN, false};
    const struct refract_aim aim = {10, atan(0.75), true};
    struct refract_ray ray;
    CHECK(refract_place(&s, &aim, &ray, &error));
    CHECK_NEAR(ray.height, 10 + 0.75 * ray.sag, 1e-14, "on the line");
    CHECK_NEAR((ray.sag - 50) * (ray.sag - 50) + ray.height * ray.height, 2500, 1e-11, "on it");
    CHECK_RELATIVE(ray.z, -40 / 3., 4 * DBL_EPSILON, "crosses the axis at -y0/tan U");
}

static bool refused(struct refract_surface s, double h, double angle, bool at_vertex,
                    const char *words)
{
    const struct refract_aim aim = {h, angle, at_vertex};
    struct refract_ray ray = {0};
    error.message[0] = '\0';
    bool passed = refract_place(&s, &aim, &ray, &error) && refract_solve(&s, &error) &&
                  refract_through(&s, &ray, &error);
    return !passed && strstr(error.message, words) != NULL;
}

static void test_refusals(void)
{
    struct refract_surface glass = {1.5, 1, INFINITY, -30, NAN, false};
    CHECK(refused(glass, NAN, 45 * DEGREE, false, "critical angle 41.8103 deg"));
    struct refract_surface ball = {1, 1.5, 20, -INFINITY, NAN, false};
    CHECK(refused(ball, 21, NAN, false, "misses"));
    CHECK(refused(ball, 21, NAN, true, "misses"));
    ball.z = -10;
    CHECK(refused(ball, 19.9, NAN, false, "turned away"));
    CHECK(refused(ball, NAN, 80 * DEGREE, false, "misses"));
    CHECK(refused(ball, NAN, NAN, false, "give two"));
    CHECK(refused(ball, 1, 0.1, false, "give two"));
    ball.z = -INFINITY;
    CHECK(refused(ball, NAN, 0.1, false, "infinity"));
    struct refract_surface bad = {1, 1.5, 0, -100, NAN, false};
    CHECK(!refract_solve(&bad, &error));
    bad = (struct refract_surface){-1, 1.5, 50, -100, NAN, false};
    CHECK(!refract_solve(&bad, &error) && strstr(error.message, "above 0") != NULL);
    bad = (struct refract_surface){1, 1, NAN, -100, 50, false};
    CHECK(!refract_solve(&bad, &error) && strstr(error.message, "equal indices") != NULL);
    bad = (struct refract_surface){1, NAN, 50, -100, 50, false};
    CHECK(!refract_solve(&bad, &error) && strstr(error.message, "centre") != NULL);
    bad = (struct refract_surface){1, NAN, NAN, -100, 50, false};
    CHECK(!refract_solve(&bad, &error) && error.code == ERROR_USAGE);
    bad = (struct refract_surface){1, 1.5, NAN, 0, 50, false};
    CHECK(!refract_solve(&bad, &error) && strstr(error.message, "vertex") != NULL);
}

/* sin Ic = n'/n, tan IB = n'/n, n' = n sin I/sin I': asin(1/2), atan(1), sin 30/sin 45. */
static void test_angles(void)
{
    double n = NAN;
    CHECK_NEAR(refract_critical_angle(2, 1), 30 * DEGREE, 1e-15, "asin(1/2)");
    CHECK(isnan(refract_critical_angle(1, 2)) && isnan(refract_critical_angle(1, 1)));
    CHECK_NEAR(refract_brewster_angle(1.5, 1.5), 45 * DEGREE, 1e-15, "atan 1");
    CHECK_NEAR(refract_brewster_angle(1, sqrt(3)), 60 * DEGREE, 1e-15, "atan sqrt 3");
    CHECK(refract_index_of(1, 45 * DEGREE, 30 * DEGREE, &n, &error));
    CHECK_RELATIVE(n, sqrt(2), 1e-15, "sin 45/sin 30");
    CHECK(refract_index_of(1.5, -30 * DEGREE, -90 * DEGREE * (1 - 1e-9), &n, &error));
    CHECK_RELATIVE(n, 0.75, 1e-15, "grazing");
    CHECK(!refract_index_of(1, 30 * DEGREE, -20 * DEGREE, &n, &error));
    CHECK(!refract_index_of(1, 0, 0, &n, &error) && !refract_index_of(1, 1, 2, &n, &error));
}

int main(void)
{
    test_angles();
    test_conjugates();
    test_rays();
    test_round_trip();
    test_exact();
    test_aplanatic();
    test_small_heights();
    test_trigonometry();
    test_vertex_height();
    test_refusals();
    return check_report();
}
