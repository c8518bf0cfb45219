/* tests/unit/test_tilt.c - tilted lens: published settings, and rays traced through a thin lens. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "photo/tilt.h"

#include <stdint.h>
#include <stdlib.h>

#include "check.h"

#define NONE ((double)NAN)

static const double degree = RADIANS_PER_DEGREE;

/* Merklinger, View Camera, July/August 1996, the examples with a 150 mm Symmar; feet and degrees
   as printed, rounded to what a tripod and a tilt scale show. */
static void test_hinge_rule(void)
{
    static const struct {
        double f, J_feet, tilt_degrees, tolerance;
        const char *source;
    } rows[] = {
        {150, 4.2, 7, 0.3, "J 4.2 ft: the tilt was, near enough, 7 degrees"},
        {150, 2.03, 14, 0.2, "14 degrees: just over 2 feet"},
        {150, 7, 4, 0.1, "4 degrees: J of 7 feet"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct tilt_given g = {rows[i].f, 11,   0.1,        NONE, rows[i].J_feet * 304.8,
                               NONE,      NONE, 90 * degree};
        struct tilt t;
        struct error error;
        CHECK(tilt_solve(&g, &t, &error));
        CHECK_NEAR(t.tilt / degree, rows[i].tilt_degrees, rows[i].tolerance, rows[i].source);
    }
}

/* Merklinger, View Camera, September/October 1996: 150 mm at f/11, c = 0.1 mm: H about 67 feet; at
   the hyperfocal distance the field extends J on either side of the plane. */
/* A level plane of focus never meets the sensor's normal, whatever the tilt is rounded to. */
static void test_level(void)
{
    struct error error;
    for (int k = 1; k <= 1000; k++) {
        struct tilt t;
        const struct tilt_given g = {150, 22, 0.1, NAN, 150 + 3.7 * k, NAN, NAN, PI / 2};
        CHECK(tilt_solve(&g, &t, &error));
        CHECK(isinf(t.distance));
        CHECK_RELATIVE(sin(t.tilt), 150 / g.hinge, 1e-14, "Merklinger's hinge rule");
    }
}

static void test_wedge(void)
{
    struct tilt_given g = {150, 11, 0.1, 7 * degree, NONE, NONE, NONE, 90 * degree};
    struct tilt t;
    struct error error;
    CHECK(tilt_solve(&g, &t, &error));
    CHECK_NEAR(t.hyperfocal / 304.8, 67, 0.5, "Merklinger 1996 II: about 67 feet");
    double at_H = t.half_height * t.hyperfocal / t.hinge;
    CHECK_NEAR(at_H, 1, 0.01, "J on either side at H, v' about f (cos 7 = 0.9925)");
    CHECK_RELATIVE(at_H, t.f / t.image, 1e-14, "(J/H0)(f/v') exactly");
    CHECK_RELATIVE(1 / tan(t.near_angle) - 1 / tan(t.angle), t.half_height, 1e-12, "cot near");
    CHECK_RELATIVE(1 / tan(t.angle) - 1 / tan(t.far_angle), t.half_height, 1e-12, "cot far");
    CHECK_RELATIVE(t.image, 150 / cos(7 * degree), 1e-14, "psi = 90: v' = f/cos a");
    CHECK_NEAR(1e-9 * t.distance, INFINITY, 0, "level plane: nothing sharp straight ahead");
}

static double uniform(uint64_t *state)
{
    *state = *state * 6364136223846793005U + 1442695040888963407U;
    return (double)(*state >> 11) / 9007199254740992.0;
}

struct vector {
    double x, y, z;
};

static double dot(struct vector a, struct vector b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* Trace from a subject point through a point of the tilted thin lens to the sensor at z = v. The
   lens changes slopes against its own axis by -height/f; nothing here knows of image points. */
static struct vector trace(struct vector point, struct vector at, double tilt, double f, double v)
{
    struct vector axis = {0, sin(tilt), cos(tilt)}, up = {0, cos(tilt), -sin(tilt)};
    struct vector ray = {at.x - point.x, at.y - point.y, at.z - point.z};
    double along = dot(ray, axis);
    double slope_x = ray.x / along - at.x / f;
    double slope_y = dot(ray, up) / along - dot(at, up) / f;
    struct vector out = {slope_x, slope_y * up.y + axis.y, slope_y * up.z + axis.z};
    double t = (v - at.z) / out.z;
    return (struct vector){at.x + t * out.x, at.y + t * out.y, v};
}

/* Width of the blur along the tilt axis: the two rim rays beside the lens centre. */
static double blur_of(const struct tilt *t, double u, double y)
{
    struct vector point = {0, y, -u};
    double r = t->f / t->N / 2;
    struct vector left = trace(point, (struct vector){-r, 0, 0}, t->tilt, t->f, t->image);
    struct vector right = trace(point, (struct vector){r, 0, 0}, t->tilt, t->f, t->image);
    return fabs(right.x - left.x);
}

/* Points of the plane of focus are sharp, points of both limits have blur/c = 1.000. */
static void test_traced(void)
{
    uint64_t state = 31;
    int traced = 0;
    for (int i = 0; i < 4000; i++) {
        double f = 20 + 300 * uniform(&state), N = 2 + 30 * uniform(&state);
        double c = 0.02 + 0.08 * uniform(&state), tilt = (uniform(&state) - 0.5) * 60 * degree;
        double ahead = f * (2 + 100 * uniform(&state)), rise = (uniform(&state) - 0.5) * 1.5;
        struct tilt_given g = {f, N, c, tilt, NONE, NONE, ahead, NONE};
        struct tilt t;
        struct error error;
        CHECK(tilt_solve(&g, &t, &error));
        struct tilt_reach r = tilt_along(&t, rise);
        if (!(r.sharp < 1e4 * f && r.far < 1e4 * f)) {
            continue;
        }
        traced++;
        CHECK_NEAR(blur_of(&t, r.sharp, r.sharp * rise), 0, 1e-10, "sharp by rays");
        CHECK_NEAR(blur_of(&t, r.near, r.near * rise) / c, 1, 1e-8, "near limit: blur/c = 1.000");
        CHECK_NEAR(blur_of(&t, r.far, r.far * rise) / c, 1, 1e-8, "far limit: blur/c = 1.000");
        CHECK_NEAR(r.front, r.sharp - r.near, 1e-11 * r.far, "front");
        CHECK_NEAR(r.behind, r.far - r.sharp, 1e-11 * r.far, "behind");
        CHECK(r.near < r.sharp && r.sharp < r.far);
        /* any other ray from the sharp point meets the same place: across the tilt too */
        struct vector p = {0, r.sharp * rise, -r.sharp};
        double h = f / N / 2;
        struct vector top = {0, h * cos(tilt), -h * sin(tilt)}, middle = {0, 0, 0};
        struct vector a = trace(p, top, tilt, f, t.image), b = trace(p, middle, tilt, f, t.image);
        CHECK_NEAR(a.y, b.y, 1e-9 * f, "sharp across the tilt");
    }
    CHECK(traced > 2000);
}

/* Every given combination leads back to the same camera. */
static void test_round_trips(void)
{
    uint64_t state = 37;
    for (int i = 0; i < 3000; i++) {
        double f = 20 + 300 * uniform(&state), tilt = (uniform(&state) * 40 + 0.5) * degree;
        if (i % 2) {
            tilt = -tilt;
        }
        struct tilt_given g = {f,   8, 0.03, tilt, NONE, NONE, f * (1.6 + 90 * uniform(&state)),
                               NONE};
        struct tilt t, other;
        struct error error;
        CHECK(tilt_solve(&g, &t, &error));
        struct tilt_given ways[] = {{f, 8, 0.03, NONE, t.hinge, t.image, NONE, NONE},
                                    {f, 8, 0.03, tilt, NONE, NONE, NONE, t.angle},
                                    {f, 8, 0.03, NONE, t.hinge, NONE, NONE, t.angle}};
        for (int w = 0; w < 3; w++) {
            CHECK(tilt_solve(&ways[w], &other, &error));
            CHECK_RELATIVE(other.tilt, tilt, 1e-12, "tilt back");
            CHECK_RELATIVE(other.image, t.image, 1e-11, "image back");
            CHECK_RELATIVE(other.angle, t.angle, 1e-11, "angle back");
            CHECK_RELATIVE(1 / other.distance, 1 / t.distance, 1e-9, "distance back");
        }
        /* two points of the plane give the camera back; one of them may be far away */
        double low = (uniform(&state) - 1) * 0.3, high = low + 0.05 + 0.3 * uniform(&state);
        struct tilt_reach a = tilt_along(&t, low), b = tilt_along(&t, high);
        struct tilt_point p = {a.sharp, low}, q = {b.sharp, high};
        double tilt_back, image_back;
        if (isinf(a.sharp) || isinf(b.sharp)) {
            continue;
        }
        CHECK(tilt_through(f, &p, &q, &tilt_back, &image_back, &error));
        CHECK_RELATIVE(tilt_back, tilt, 1e-9, "tilt from two points");
        CHECK_RELATIVE(image_back, t.image, 1e-9, "image from two points");
    }
}

/* Scheimpflug line, hinge line: on all the planes they should be on. */
static void test_lines(void)
{
    struct tilt_given g = {90, 5.6, 0.03, 8 * degree, NONE, NONE, 2000, NONE};
    struct tilt t;
    struct error error;
    CHECK(tilt_solve(&g, &t, &error));
    CHECK_NEAR(t.A * -t.image + t.B * t.scheimpflug, t.f, 1e-10, "Scheimpflug line is sharp");
    CHECK_NEAR(t.image * cos(t.tilt) - t.scheimpflug * sin(t.tilt), 0, 1e-11,
               "Scheimpflug line lies in the lens plane");
    CHECK_NEAR(t.hinge * t.B, t.f, 1e-12, "hinge line, u = 0, on every plane of sharpness");
    CHECK_RELATIVE(90 / sin(8 * degree), t.hinge, 1e-14, "cobwood.co.uk: J = focal length/sin");
}

/* Without tilt the limits are the usual ones: near, far = s f^2/(f^2 +- N c (s - f)). */
static void test_untilted(void)
{
    double f = 50, N = 8, c = 0.03, s = 3000;
    struct tilt_given g = {f, N, c, 0, NONE, NONE, s, NONE};
    struct tilt t;
    struct error error;
    CHECK(tilt_solve(&g, &t, &error));
    struct tilt_reach r = tilt_along(&t, 0.3);
    CHECK_RELATIVE(r.near, s * f * f / (f * f + N * c * (s - f)), 1e-14,
                   "lenscalc.7, photography, P = 1");
    CHECK_RELATIVE(r.far, s * f * f / (f * f - N * c * (s - f)), 1e-13,
                   "lenscalc.7, photography, P = 1");
    CHECK_RELATIVE(r.sharp, s, 1e-14, "sharp at s");
    CHECK(isinf(t.hinge) && isinf(t.scheimpflug) && isinf(t.half_height));
    g.tilt = 1e-9; /* thin limit */
    CHECK(tilt_solve(&g, &t, &error));
    CHECK_RELATIVE(tilt_along(&t, 0.3).near, r.near, 1e-6, "small tilts join on");
}

static void test_sampler(void)
{
    struct error error;
    double tilt, image;
    /* the ground 1.5 m below the lens: J = 1.5 m, horizon sharp, plane level */
    struct tilt_point near = {2000, -0.75}, horizon = {(double)INFINITY, 0};
    CHECK(tilt_through(24, &near, &horizon, &tilt, &image, &error));
    CHECK_RELATIVE(tilt, asin(24 / 1500.0), 1e-13, "hinge rule: 24 mm, 1.5 m above the ground");
    CHECK_NEAR(tilt / degree, 0.92, 0.005, "the same in degrees, 24/1500 = 0.016 rad");
    CHECK_RELATIVE(image, 24 / cos(tilt), 1e-13, "level plane: v' = f/cos a");
    struct tilt_point same = {500, -0.75}, close = {20, 0.2}, closer = {10, 0.0};
    CHECK(!tilt_through(24, &near, &same, &tilt, &image, &error));
    CHECK(strstr(error.message, "same direction") != NULL);
    CHECK(!tilt_through(24, &close, &closer, &tilt, &image, &error));
    struct tilt_point behind = {-100, 0.2};
    CHECK(!tilt_through(24, &near, &behind, &tilt, &image, &error));
}

/* Image circles: getdpi forum 75775, GFX 100S (43.8 x 32.9 mm) shifted 15 mm sideways: 80.8 mm. */
static void test_coverage(void)
{
    struct tilt_given g = {50, 8, 0.03, 0, NONE, 50, NONE, NONE};
    struct tilt t;
    struct tilt_coverage cover, rotated;
    struct error error;
    CHECK(tilt_solve(&g, &t, &error));
    CHECK(tilt_coverage(&t, &(struct tilt_frame){43.8, 32.9, 0, 15}, &cover, &error));
    CHECK_NEAR(cover.circle, 80.8, 0.05, "getdpi 75775: 80.8 mm");
    CHECK(tilt_coverage(&t, &(struct tilt_frame){36, 24, 0, 0}, &cover, &error));
    CHECK_NEAR(cover.circle, 43.2666, 1e-4, "the diagonal");
    CHECK(tilt_coverage(&t, &(struct tilt_frame){36, 24, 11, 0}, &cover, &error));
    CHECK(tilt_coverage(&t, &(struct tilt_frame){36, 24, -11, 0}, &rotated, &error));
    CHECK_NEAR(cover.circle, rotated.circle, 1e-12, "up or down, the same circle");
    const struct tilt level = {.f = 50, .image = 50};
    double limit;
    CHECK(
        tilt_shift_limit(&level, cover.circle, &(struct tilt_frame){36, 24, 0, 0}, &limit, &error));
    CHECK_NEAR(limit, 11, 1e-12, "and back: 11 mm");
    CHECK(tilt_shift_limit(&level, 80.80, &(struct tilt_frame){32.9, 43.8, 0, 0}, &limit, &error));
    CHECK_NEAR(limit, 15, 0.01, "getdpi 75775: 15 mm along the long side");
    CHECK(!tilt_shift_limit(&level, 40, &(struct tilt_frame){36, 24, 0, 0}, &limit, &error));
    /* a tilt moves the axis over the sensor by v' tan a: a rise by as much brings it back */
    g.tilt = 10 * degree;
    CHECK(tilt_solve(&g, &t, &error));
    CHECK(tilt_coverage(&t, &(struct tilt_frame){36, 24, 0, 0}, &cover, &error));
    CHECK(tilt_coverage(&t, &(struct tilt_frame){36, 24, -50 * tan(g.tilt), 0}, &rotated, &error));
    CHECK(rotated.circle < cover.circle && cover.circle > 43.27);
    g.tilt = 80 * degree;
    CHECK(tilt_solve(&g, &t, &error));
    CHECK(!tilt_coverage(&t, &(struct tilt_frame){36, 36, 0, 0}, &cover, &error));
}

static void test_refusals(void)
{
    static const struct {
        struct tilt_given given;
        enum error_code code;
        const char *words;
    } rows[] = {
        {{150, 11, 0.1, PI / 2, NONE, 160, NONE, NONE}, ERROR_DOMAIN, "-90 to 90"},
        {{150, 11, 0.1, -2, NONE, 160, NONE, NONE}, ERROR_DOMAIN, "-90 to 90"},
        {{150, 11, 0.1, NONE, 149, 160, NONE, NONE}, ERROR_DOMAIN, "150 mm on either side"},
        {{150, 11, 0.1, NONE, 0, 160, NONE, NONE}, ERROR_DOMAIN, "hinge 0 mm"},
        {{150, 11, 0.1, 0.1, NONE, 0, NONE, NONE}, ERROR_DOMAIN, "image distance 0 mm"},
        {{150, 11, 0.1, 0.1, NONE, NONE, 150, NONE}, ERROR_DOMAIN, "more than f/cos(tilt)"},
        {{150, 11, 0.1, 0.1, NONE, NONE, NONE, 0.1}, ERROR_DOMAIN, "cannot be reached"},
        {{150, 11, 0.1, -0.1, NONE, NONE, NONE, 1.5}, ERROR_DOMAIN, "cannot be reached"},
        {{150, 11, 0.1, 0, NONE, NONE, NONE, 1.5}, ERROR_DOMAIN, "needs a tilt"},
        {{150, 11, 14, 0.1, NONE, 160, NONE, NONE}, ERROR_DOMAIN, "circle of confusion 14 mm"},
        {{0, 11, 0.1, 0.1, NONE, 160, NONE, NONE}, ERROR_DOMAIN, "focal length"},
        {{150, NONE, 0.1, 0.1, NONE, 160, NONE, NONE}, ERROR_DOMAIN, "f-number"},
        {{150, 11, 0.1, NONE, NONE, 160, NONE, NONE}, ERROR_USAGE, "tilt and hinge"},
        {{150, 11, 0.1, 0.1, 1000, 160, NONE, NONE}, ERROR_USAGE, "tilt and hinge"},
        {{150, 11, 0.1, 0.1, NONE, NONE, NONE, NONE},
         ERROR_USAGE,
         "distance and angle of the plane of focus"},
        {{150, 11, 0.1, 0.1, NONE, 160, 3000, NONE},
         ERROR_USAGE,
         "distance and angle of the plane of focus"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct tilt t;
        struct error error = {.code = ERROR_NONE};
        CHECK(!tilt_solve(&rows[i].given, &t, &error));
        CHECK(error.code == rows[i].code);
        check_at(strstr(error.message, rows[i].words) != NULL, __FILE__, __LINE__, rows[i].words);
    }
}

int main(void)
{
    test_hinge_rule();
    test_level();
    test_wedge();
    test_traced();
    test_round_trips();
    test_lines();
    test_untilted();
    test_sampler();
    test_coverage();
    test_refusals();
    return check_report();
}
