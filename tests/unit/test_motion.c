/* tests/unit/test_motion.c - blur of moving subjects and unsteady cameras. */
/* SPDX-License-Identifier: MIT */
#include <stdint.h>

#include "base/constants.h"
#include "check.h"
#include "photo/motion.h"

static const double pi = PI;
static struct error error;

#define COUNT(table) ((int)(sizeof(table) / sizeof *(table)))

static double draw(double low, double high)
{
    static uint64_t state = 8192;
    state ^= state >> 12;
    state ^= state << 25;
    state ^= state >> 27;
    return low + (high - low) * ((double)((state * 2685821657736338717u) >> 11) * 0x1p-53);
}

static struct motion across(double v, double t, double m, double blur)
{
    return (struct motion){v, t, m, blur, pi / 2, INFINITY, 0};
}

static void test_published(void)
{
    struct motion belt = across(500, 0.0001, 0.1, NAN);
    struct blur_size size;
    CHECK(motion_solve(&belt, &error));
    CHECK_NEAR(belt.blur, 0.005, 1e-15, "vision-bench MVF-019: 500 mm/s, 100 us, 50 um / 10");
    CHECK(blur_measure(belt.blur, 0.005, NAN, &size, &error));
    CHECK_NEAR(size.pixels, 1, 1e-12, "vision-bench MVF-019: one pixel of 50 um on the belt");
    CHECK(isnan(size.circles));
    struct motion time = across(500, NAN, 0.1, 100.0 / 1920 * 0.1);
    CHECK(motion_solve(&time, &error));
    CHECK_NEAR(time.t, 104.167e-6, 5e-10, "aetrixelec.com: 100 mm on 1920 px, 500 mm/s, 1 px");
    struct motion fast = across(2000, NAN, 1, 0.05);
    CHECK(motion_solve(&fast, &error));
    CHECK_NEAR(fast.t, 25e-6, 1e-18, "vision-bench MVF-019: 2000 mm/s allows 25 us");
    double m = NAN;
    CHECK(motion_magnification(50, 5050, &m, &error));
    CHECK_NEAR(m, 0.01, 1e-17, "50/(5050 - 50)");
    CHECK(motion_magnification(50, INFINITY, &m, &error));
    CHECK_NEAR(m, 0, 0, "infinity");
    CHECK(!motion_magnification(50, 40, &m, &error) && error.code == ERROR_DOMAIN);
    CHECK(strstr(error.message, "no real image") != NULL);
    struct rolling_skew skew;
    CHECK(rolling_shutter(4096 / 0.5, 0.015, 2160, &skew, &error));
    CHECK_NEAR(skew.shift, 123, 0.5, "toolsforfilm.com: 4096 px in 0.5 s, 15 ms, 123 px");
    CHECK_NEAR(tan(skew.angle), skew.shift / 2160, 1e-15, "lean");
    CHECK(!rolling_shutter(-1, 1, 1, &skew, &error) && !rolling_shutter(1, 0, 1, &skew, &error));
}

/* Project the subject before and after through the lens centre: an independent calculation. */
static void test_projection(void)
{
    for (int i = 0; i < 4000; i++) {
        double f = exp2(draw(3, 9)), s = f * exp2(draw(1.2, 9)), m = f / (s - f), b = m * s;
        double a = draw(0, pi), x = draw(0.001, 0.5) * s, h = draw(-20, 20);
        struct motion motion = {x / 0.02, 0.02, m, NAN, a, s, h};
        CHECK(motion_solve(&motion, &error));
        double X = h / m;
        double after = b * (X + x * sin(a)) / (s - x * cos(a));
        CHECK_NEAR(motion.blur, fabs(after - h), 1e-10 * (fabs(h) + b), "central projection");
        if (!(motion.blur > 0.01)) {
            continue;
        }
        struct motion t = motion, v = motion;
        t.t = NAN;
        v.v = NAN;
        CHECK(motion_solve(&t, &error) && motion_solve(&v, &error));
        CHECK_RELATIVE(t.t, 0.02, 1e-10, "time put back");
        CHECK_RELATIVE(v.v, motion.v, 1e-10, "speed put back");
        struct motion axis = {motion.v, 0.02, m, NAN, draw(0.1, 3), s, 0};
        CHECK(motion_solve(&axis, &error));
        axis.m = NAN;
        CHECK(motion_solve(&axis, &error));
        CHECK_RELATIVE(axis.m, m, 1e-12, "magnification put back");
    }
}

static void test_special(void)
{
    struct motion one = across(1000, 0.01, 0.02, NAN), two = across(1000, 0.02, 0.02, NAN);
    CHECK(motion_solve(&one, &error) && motion_solve(&two, &error));
    CHECK_RELATIVE(two.blur, 2 * one.blur, 1e-15, "double time, double blur");
    CHECK_NEAR(one.blur, 0.2, 1e-15, "v t m");
    struct motion slanted = {1000, 0.01, 0.02, NAN, pi / 6, NAN, 0};
    CHECK(motion_solve(&slanted, &error));
    CHECK_NEAR(slanted.blur, 0.1, 1e-15, "30 deg, far away: half");
    struct motion straight = {1000, NAN, 0.02, 0.1, 0, 5000, 0};
    CHECK(motion_solve(&straight, &error));
    CHECK_NEAR(straight.t, INFINITY, 0, "straight at the camera, on the axis: never");
    struct motion away = {1000, NAN, 0.02, 30, pi, 5000, 10};
    CHECK(motion_solve(&away, &error));
    CHECK_NEAR(away.t, INFINITY, 0, "receding: the image shrinks by its own height at most");
    struct motion hit = {1000, 6, 0.02, NAN, 0, 5000, 1};
    CHECK(!motion_solve(&hit, &error) && strstr(error.message, "reaches the lens in 5 s") != NULL);
    struct motion none = {NAN, 1, 0.02, 0.1, 0, 5000, 0};
    CHECK(!motion_solve(&none, &error) && strstr(error.message, "no speed") != NULL);
}

static void test_refusals(void)
{
    static const struct {
        struct motion motion;
        enum error_code code;
        const char *names;
    } rows[] = {
        {{1, 1, 1, 1, 1, NAN, 0}, ERROR_USAGE, "blur"},
        {{1, NAN, 1, NAN, 1, NAN, 0}, ERROR_USAGE, "speed"},
        {{0, 1, 1, NAN, 1, NAN, 0}, ERROR_DOMAIN, "speed 0"},
        {{1, 0, 1, NAN, 1, NAN, 0}, ERROR_DOMAIN, "exposure time 0"},
        {{1, 1, 1, NAN, 4, NAN, 0}, ERROR_DOMAIN, "angle of the motion 229.183"},
        {{1, 1, 1, NAN, NAN, NAN, 0}, ERROR_DOMAIN, "angle of the motion"},
        {{1, 1, 1, NAN, 1, -5, 0}, ERROR_DOMAIN, "distance"},
        {{1, 1, 1, NAN, 1, 5, NAN}, ERROR_DOMAIN, "image height"},
        {{1, 1, NAN, 1, 1, 5, 3}, ERROR_USAGE, "image height"},
        {{1, 1, NAN, 1, 0, 5, 0}, ERROR_DOMAIN, "magnification"},
    };
    for (int i = 0; i < COUNT(rows); i++) {
        struct motion motion = rows[i].motion;
        error.code = ERROR_NONE;
        CHECK(!motion_solve(&motion, &error));
        CHECK_NEAR(error.code, rows[i].code, 0, rows[i].names);
        CHECK(strstr(error.message, rows[i].names) != NULL);
    }
    struct blur_size size;
    CHECK(!blur_measure(1, 0, NAN, &size, &error) && strstr(error.message, "pixel pitch") != NULL);
    CHECK(!blur_measure(1, 1, -1, &size, &error) &&
          strstr(error.message, "circle of confusion") != NULL);
}

static void test_shake(void)
{
    struct shake shake = {100, pi / 180, 0.01, NAN, 0};
    CHECK(shake_solve(&shake, &error));
    CHECK_NEAR(shake.blur, 0.0174532925, 1e-10, "1 deg/s over 1/100 s at 100 mm: 0.01 deg");
    /* the linear rule against the chord on the sensor, as its header promises */
    CHECK_NEAR(2 * 100 * tan(0.11 / 2) / (100 * 0.11) - 1, 0.11 * 0.11 / 12, 2e-6, "6.3 deg");
    for (int i = 0; i < 2000; i++) {
        struct shake all = {exp2(draw(3, 10)), exp2(draw(-9, 3)), exp2(draw(-12, 3)), NAN,
                            draw(0, 2)};
        CHECK(shake_solve(&all, &error));
        struct shake f = all, omega = all, t = all;
        f.f = omega.omega = t.t = NAN;
        CHECK(shake_solve(&f, &error) && shake_solve(&omega, &error) && shake_solve(&t, &error));
        CHECK_RELATIVE(f.f, all.f, 1e-14, "f put back");
        CHECK_RELATIVE(omega.omega, all.omega, 1e-14, "omega put back");
        CHECK_RELATIVE(t.t, all.t, 1e-14, "t put back");
    }
    struct shake full = {1, 1, 1, 1, 0}, negative = {1, 1, NAN, 1, -1},
                 huge = {1, 1, NAN, 1, INFINITY}, still = {1, 0, 1, NAN, 0};
    CHECK(!shake_solve(&full, &error) && error.code == ERROR_USAGE);
    CHECK(!shake_solve(&negative, &error) && error.code == ERROR_DOMAIN);
    CHECK(!shake_solve(&huge, &error) && error.code == ERROR_DOMAIN);
    CHECK(!shake_solve(&still, &error) && strstr(error.message, "rotation") != NULL);
    double t = NAN;
    CHECK(handheld_time(50, 1.5, 0, &t, &error));
    CHECK_NEAR(t, 1.0 / 75, 1e-17, "one over 75");
    CHECK(handheld_time(200, 1, 3, &t, &error));
    CHECK_NEAR(t, 1.0 / 25, 1e-16, "three stops of stabiliser");
    CHECK(!handheld_time(0, 1, 0, &t, &error) && !handheld_time(50, 1, -1, &t, &error));
}

/* The camera turns by omega t: what stands still moves f (1 + m) omega t, as shake says. */
static void test_panning(void)
{
    for (int i = 0; i < 1000; i++) {
        double f = exp2(draw(4, 9)), s = f * exp2(draw(1.5, 9)), m = f / (s - f);
        struct panning_shot pan = {draw(100, 50000), draw(0.1, 3), exp2(draw(-9, -2)), f, s,
                                   draw(0.01, 2)};
        struct panning_blur blur;
        CHECK(panning_solve(&pan, &blur, &error));
        struct shake turn = {f, blur.rate * pan.track, pan.t, NAN, m};
        struct motion moved = {pan.v, pan.t, m, NAN, pan.angle, INFINITY, 0};
        CHECK(shake_solve(&turn, &error) && motion_solve(&moved, &error));
        CHECK_RELATIVE(blur.background, turn.blur, 1e-13, "background turns with the camera");
        CHECK_NEAR(blur.subject, fabs(moved.blur - turn.blur), 1e-12 * moved.blur, "the rest");
    }
    struct panning_blur blur;
    struct panning_shot exact = {10000, pi / 2, 0.01, 100, 10100, 1};
    CHECK(panning_solve(&exact, &blur, &error));
    CHECK_NEAR(blur.subject, 0, 0, "followed exactly");
    CHECK_NEAR(blur.background, 1, 1e-14, "m = 0.01, 100 mm of path");
    exact.track = -1;
    CHECK(!panning_solve(&exact, &blur, &error));
    exact.track = 1;
    exact.angle = 4;
    CHECK(!panning_solve(&exact, &blur, &error) &&
          strstr(error.message, "angle of the motion") != NULL);
    exact.angle = 1;
    exact.s = 90;
    CHECK(!panning_solve(&exact, &blur, &error));
}

int main(void)
{
    test_published();
    test_projection();
    test_special();
    test_refusals();
    test_shake();
    test_panning();
    return check_report();
}
