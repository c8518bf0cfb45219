/* tests/unit/test_stars.c - star trails and the rules against them. */
/* SPDX-License-Identifier: MIT */
#include <stdint.h>

#include "base/constants.h"
#include "check.h"
#include "photo/stars.h"

static const double pi = PI;
static struct error error;

#define COUNT(table) ((int)(sizeof(table) / sizeof *(table)))

static double draw(double low, double high)
{
    static uint64_t state = 86164;
    state ^= state >> 12;
    state ^= state << 25;
    state ^= state >> 27;
    return low + (high - low) * ((double)((state * 2685821657736338717u) >> 11) * 0x1p-53);
}

static void test_rules(void)
{
    double t = NAN;
    CHECK(star_rule_time(500, 50, 1, &t, &error));
    CHECK_NEAR(t, 10, 1e-15, "cag-creations.com: 500 rule at 50 mm is 10 s");
    CHECK(star_rule_time(500, 24, 1, &t, &error));
    CHECK_NEAR(t, 21, 0.2, "tools.gera.services: 24 mm, about 21 s");
    CHECK(star_rule_time(600, 50, 1, &t, &error));
    CHECK_NEAR(t, 12, 1e-15, "cloudynights.com/topic/327290: 600 rule at 50 mm is 12 s");
    CHECK(star_rule_time(500, 50, 2, &t, &error));
    CHECK_NEAR(t, 5, 1e-15, "crop 2");
    CHECK(npf_simple_time(200, 4, 0.00375, &t, &error));
    CHECK_NEAR(t, 1.26, 0.005, "theprimecalculator.com: 200 mm f/4, 3.75 um, 1.26 s");
    CHECK(npf_simple_time(24, 2.8, 0.0033, &t, &error));
    CHECK_NEAR(t, 8.208, 5e-4, "detect_meteors test_calculate_npf_rule: 24 mm f/2.8, 3.3 um");
    CHECK(npf_full_time(24, 2.8, 0.0043, 0, 1, &t, &error));
    CHECK_NEAR(t, (47.32 + 2.4 + 58.91) / 24, 1e-12, "Michaud's full formula, by hand");
    CHECK(npf_full_time(24, 2.8, 0.0043, pi / 3, 3, &t, &error));
    CHECK_NEAR(t, 6 * (47.32 + 2.4 + 58.91) / 24, 1e-11, "k = 3, declination 60 deg");
    CHECK(four_minus_crop_time(20, 1, &t, &error));
    CHECK_NEAR(t, 15, 1e-14, "webastro.net 186159: 300 for 35 mm");
    CHECK(four_minus_crop_time(1, 1.6, &t, &error));
    CHECK_NEAR(t, 240, 1e-12, "webastro.net 186159: 240 for APS-C Canon");
    CHECK(four_minus_crop_time(1, 2, &t, &error));
    CHECK_NEAR(t, 200, 1e-12, "webastro.net 186159: 200 for Micro 4/3");
}

static void test_published(void)
{
    struct star_time time;
    struct star_trail trail;
    CHECK_RELATIVE(STELLAR_RATE, 2 * pi / STELLAR_DAY, 1e-15, "IERS stellar day");
    CHECK_NEAR(STELLAR_RATE, 7.2921e-5, 2e-10, "physics.md 3");
    CHECK(star_time(1000, 0, 0.0078, &time, &error));
    CHECK_NEAR(time.exact, 0.107, 0.0005, "alphadxd.fr: 1000 mm, 7.8 um, 0.107 s");
    CHECK(star_trail(18, 0, 1, &trail, &error));
    CHECK_RELATIVE(trail.linear / 0.0052, 15 * 18 / (206 * 5.2), 0.005,
                   "ericbogatin.com: 18 mm, 5.2 um, 15 arcsec/s (rounded constants)");
    CHECK_RELATIVE(trail.rotation * 180 * 3600 / pi, 15.04, 0.0005, "15.04 arcsec a second");
    /* Michaud, futura-sciences.com 284039: a pixel takes 13.7 p/(f cos dec) s */
    for (int deg = -80; deg <= 80; deg += 20) {
        double dec = deg * pi / 180;
        CHECK(star_time(50, dec, 0.0043, &time, &error));
        CHECK_RELATIVE(time.linear, 13.7 * 4.3 / (50 * cos(dec)), 0.001, "Michaud, one pixel");
        CHECK_RELATIVE(time.exact, time.linear, 1e-7, "short trails are straight");
    }
    CHECK(star_trail(50, 0, STELLAR_DAY / 4, &trail, &error));
    CHECK_RELATIVE(trail.chord, 100 * tan(pi / 4), 1e-14, "equator: 2 f tan(w t/2), six hours");
    CHECK_NEAR(trail.rotation, pi / 2, 1e-15, "a quarter turn");
    CHECK_NEAR(trail.separation, pi / 2, 1e-15, "a quarter of the sky");
    CHECK(star_trail(50, 0, STELLAR_DAY / 2 * (1 + 1e-9), &trail, &error));
    CHECK_NEAR(trail.chord, INFINITY, 0, "twelve hours: both ends on the horizon of the lens");
    CHECK(star_trail(50, pi / 2, 3600, &trail, &error));
    CHECK_NEAR(trail.linear + trail.chord + trail.arc, 0, 1e-13, "at the pole nothing moves");
    CHECK_NEAR(trail.rotation, STELLAR_RATE * 3600, 1e-15, "but everything turns");
}

/* Turn the sky as vectors, project on the sensor: an independent calculation. */
static double projected(double f, double dec, double t, double *separation)
{
    double x[2], y[2], unit[2][3];
    for (int end = 0; end < 2; end++) {
        double H = (end ? 0.5 : -0.5) * STELLAR_RATE * t;
        double star[3] = {cos(dec) * cos(H), cos(dec) * sin(H), sin(dec)};
        double axis[3] = {cos(dec), 0, sin(dec)}, up[3] = {-sin(dec), 0, cos(dec)};
        double depth = star[0] * axis[0] + star[2] * axis[2];
        x[end] = f * star[1] / depth;
        y[end] = f * (star[0] * up[0] + star[2] * up[2]) / depth;
        memcpy(unit[end], star, sizeof star);
    }
    double dx = unit[1][0] - unit[0][0], dy = unit[1][1] - unit[0][1];
    *separation = 2 * asin(hypot(dx, dy) / 2);
    return hypot(x[1] - x[0], y[1] - y[0]);
}

static void test_projection(void)
{
    for (int i = 0; i < 4000; i++) {
        double f = exp2(draw(3, 10)), dec = draw(-1.57, 1.57), t = exp2(draw(2, 15));
        double separation = NAN, worst = NAN;
        struct star_trail trail;
        struct star_time time;
        CHECK(star_trail(f, dec, t, &trail, &error));
        CHECK_RELATIVE(trail.chord, projected(f, dec, t, &separation), 1e-11, "vectors");
        CHECK_RELATIVE(trail.separation, separation, 1e-11, "vectors, in the sky");
        CHECK_RELATIVE(trail.linear, f * trail.arc, 1e-15, "linear is f times the arc");
        CHECK(star_time(f, dec, trail.chord, &time, &error));
        struct star_trail again;
        /* past its widest the chord shrinks: then an earlier time has the same chord */
        CHECK(time.exact <= t * (1 + 1e-9));
        CHECK(star_trail(f, dec, fmin(time.exact, STELLAR_DAY), &again, &error));
        CHECK_RELATIVE(again.chord, trail.chord, 1e-9, "time put back");
        double back = NAN;
        CHECK(star_focal_length(dec, t, trail.chord, &back, &error));
        CHECK_RELATIVE(back, f, 1e-12, "focal length put back");
        CHECK(star_trail_worst(f, dec, t, 0, &worst, &error));
        CHECK_RELATIVE(worst, trail.linear, 1e-13, "a frame of one point");
        CHECK(star_trail_worst(f, dec, t, 21.63, &worst, &error));
        CHECK(worst >= trail.linear);
    }
}

/* Image of a direction turned about the pole by `angle`, per focal length, from the place u, w. */
static void turn(double dec, double angle, const double place[2], double image[2])
{
    double p[3] = {0, cos(dec), sin(dec)}, d[3] = {place[0], place[1], 1}, out[3];
    double along = p[1] * d[1] + p[2] * d[2], c = cos(angle), s = sin(angle);
    const double across[3] = {p[1] * d[2] - p[2] * d[1], p[2] * d[0], -p[1] * d[0]};
    for (int i = 0; i < 3; i++) {
        out[i] = d[i] * c + across[i] * s + p[i] * along * (1 - c); /* Rodrigues */
    }
    image[0] = out[0] / out[2];
    image[1] = out[1] / out[2];
}

/* The longest of many trails in a disc: the sky turned about the pole, and projected. */
static double longest(double dec, double slope, double t)
{
    double most = 0;
    for (int r = 0; r <= 40; r++) {
        for (int k = 0; k < 720; k++) {
            double angle = k * pi / 360, before[2], behind[2];
            const double place[2] = {slope * r / 40 * cos(angle), slope * r / 40 * sin(angle)};
            turn(dec, STELLAR_RATE * t / 2, place, behind);
            turn(dec, -STELLAR_RATE * t / 2, place, before);
            most = fmax(most, hypot(behind[0] - before[0], behind[1] - before[1]));
        }
    }
    return most;
}

static void test_worst(void)
{
    static const double decs[] = {0, 10, -30, 45, 60, 80, 90}, slopes[] = {0.2, 0.9, 2};
    for (int i = 0; i < COUNT(decs); i++) {
        for (int k = 0; k < COUNT(slopes); k++) {
            double worst = NAN, dec = decs[i] * pi / 180;
            CHECK(star_trail_worst(20, dec, 1, 20 * slopes[k], &worst, &error));
            /* the directions are half a degree apart: 1e-5 of the speed at the most */
            CHECK_RELATIVE(worst, 20 * longest(dec, slopes[k], 1), 2e-5, "the sky turned");
        }
    }
}

/* Chord against linear differ in second order of the time. */
static void test_limit(void)
{
    for (int deg = -75; deg <= 75; deg += 25) {
        double dec = deg * pi / 180, previous = 0;
        for (int k = 0; k < 5; k++) {
            double t = 4000 / (double)(1 << k);
            struct star_trail trail;
            CHECK(star_trail(35, dec, t, &trail, &error));
            double relative = trail.chord / trail.linear - 1;
            if (k > 0) {
                CHECK_RELATIVE(previous / relative, 4.0, 0.02, "half the time, a quarter apart");
            }
            previous = relative;
        }
    }
    struct star_trail one, two;
    CHECK(star_trail(35, 0.5, 10, &one, &error) && star_trail(35, 0.5, 20, &two, &error));
    CHECK_RELATIVE(two.linear, 2 * one.linear, 1e-15, "double time, double trail");
}

static void test_refusals(void)
{
    struct star_time time;
    struct star_trail trail;
    double x = NAN;
    static const double poles[] = {90, -90};
    for (int i = 0; i < COUNT(poles); i++) {
        double dec = poles[i] * pi / 180;
        CHECK(!star_time(50, dec, 0.01, &time, &error) && error.code == ERROR_DOMAIN);
        CHECK(strstr(error.message, "90 deg is a pole") != NULL);
        CHECK(!npf_full_time(50, 2, 0.004, dec, 1, &x, &error) && error.code == ERROR_DOMAIN);
        CHECK(!star_focal_length(dec, 10, 0.01, &x, &error) && error.code == ERROR_DOMAIN);
    }
    CHECK(star_time(50, 89.9999 * pi / 180, 0.01, &time, &error));
    CHECK_NEAR(time.exact, INFINITY, 0, "a circle of 0.2 um radius never trails 10 um");
    CHECK(!star_time(50, 91 * pi / 180, 0.01, &time, &error));
    CHECK(strstr(error.message, "declination 91 deg lies outside -90 to 90") != NULL);
    CHECK(!star_time(50, NAN, 0.01, &time, &error) && !star_time(50, 0, 0, &time, &error));
    CHECK(!star_time(0, 0, 0.01, &time, &error) && !star_time(NAN, 0, 0.01, &time, &error));
    CHECK(!star_trail(50, 0, 0, &trail, &error) && !star_trail(50, 2, 1, &trail, &error));
    CHECK(!star_trail(50, 0, 90000, &trail, &error));
    CHECK(strstr(error.message, "turn of the sky") != NULL);
    CHECK(!star_trail_worst(50, 0, 1, -1, &x, &error));
    CHECK(!star_rule_time(0, 50, 1, &x, &error) && !star_rule_time(500, 50, 0, &x, &error));
    CHECK(!npf_simple_time(50, 0, 0.004, &x, &error) && !npf_simple_time(50, 2, -1, &x, &error));
    CHECK(!npf_full_time(50, 2, 0.004, 0, 0, &x, &error));
    CHECK(!four_minus_crop_time(50, 4, &x, &error) && !four_minus_crop_time(0, 1, &x, &error));
}

int main(void)
{
    test_rules();
    test_published();
    test_projection();
    test_worst();
    test_limit();
    test_refusals();
    return check_report();
}
