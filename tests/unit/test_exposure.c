/* tests/unit/test_exposure.c - exposure, losses in stops, sensor exposure, brackets. */
/* SPDX-License-Identifier: MIT */
#include <stdint.h>

#include "base/constants.h"
#include "check.h"
#include "photo/bracket.h"
#include "photo/exposure.h"
#include "photo/sensitometry.h"
#include "photo/stops.h"

static const double pi = PI;
static struct error error;

#define COUNT(table) ((int)(sizeof(table) / sizeof *(table)))
#define NOTHING                                                                                    \
    {                                                                                              \
        NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN                                      \
    }
#define NO_LOSS                                                                                    \
    {                                                                                              \
        NAN, NAN, NAN, NAN, NAN, NAN                                                               \
    }

/* Fixed-seed numbers in low..high (xorshift64*). */
static double draw(double low, double high)
{
    static uint64_t state = 20240611;
    state ^= state >> 12;
    state ^= state << 25;
    state ^= state >> 27;
    return low + (high - low) * ((double)((state * 2685821657736338717u) >> 11) * 0x1p-53);
}

/* Published settings and the light that belongs to them. */
static void test_light(void)
{
    static const struct {
        double N, t, S, K, C, ev100, L, E, tolerance; /* of ev in stops, of L and E relative */
        const char *source;
    } rows[] = {
        {1, 1, 100, NAN, NAN, 0, 0.125, 2.5, 1e-14, "ISO 2720: K 12.5, C 250 at EV 0"},
        {1, 1, 100, 14, 340, 0, 0.14, 3.4, 1e-14, "ISO 2720 with K 14, C 340"},
        {16, 0.01, 100, NAN, NAN, 14.644, 3200, 64000, 5e-4, "scene-ev.tsv: sunny 16"},
        {11, 0.01, 100, NAN, NAN, 13.563, 1512.5, 30250, 5e-4, "scene-ev.tsv: looney 11"},
        {18.1, 0.01, 100, NAN, NAN, 15, 4096, 81920, 1e-3, "scene-ev.tsv: EV 15"},
        {72.41, 0.01, 100, NAN, NAN, 19, 65536, 1310720, 1e-3, "scene-ev.tsv: EV 19"},
        {0.0125, 0.01, 100, NAN, NAN, -6, 0.00195312, 0.0390625, 1e-5, "scene-ev.tsv: EV -6"},
        {16, 1.0 / 128, 400, NAN, NAN, 13, 1024, 20480, 1e-14, "APEX: Av 8 + Tv 7 = 15 at Sv 7"},
    };
    for (int i = 0; i < COUNT(rows); i++) {
        struct exposure_given given = NOTHING;
        struct exposure x;
        given.N = rows[i].N;
        given.t = rows[i].t;
        given.S = rows[i].S;
        given.K = rows[i].K;
        given.C = rows[i].C;
        CHECK(exposure_solve(&given, &x, &error));
        CHECK(x.unknown == EXPOSURE_LIGHT);
        CHECK_NEAR(x.ev100, rows[i].ev100, rows[i].tolerance * 2, rows[i].source);
        CHECK_RELATIVE(x.L, rows[i].L, rows[i].tolerance, rows[i].source);
        CHECK_RELATIVE(x.E, rows[i].E, rows[i].tolerance, rows[i].source);
    }
}

/* APEX tables: Wikipedia "APEX system"; labels are within 0.06 stop of their whole value. */
/* f/1e10 for 1e-10 s at ISO 1 wants 12.5e30 cd/m2: no logarithm costs digits on the way. */
static void test_far_light(void)
{
    struct exposure_given given = NOTHING;
    struct exposure x;
    given.N = 1e10;
    given.t = 1e-10;
    given.S = 1;
    CHECK(exposure_solve(&given, &x, &error));
    CHECK_RELATIVE(x.L, 12.5e30, 4e-16, "luminance");
    CHECK_RELATIVE(x.E, 250e30, 4e-16, "illuminance");
}

static void test_apex(void)
{
    static const double fnumbers[] = {1, 1.4, 2, 2.8, 4, 5.6, 8, 11, 16, 22, 32};
    static const double times[] = {1, 2, 4, 8, 15, 30, 60, 125, 250, 500, 1000};
    for (int i = 0; i <= 10; i++) {
        struct exposure_given given = NOTHING;
        struct exposure x;
        given.N = fnumbers[i];
        given.t = 1 / times[i];
        given.S = 3.125 * (1 << i);
        CHECK(exposure_solve(&given, &x, &error));
        CHECK_NEAR(x.Av, i, 0.1, "Av of the f-number label, Wikipedia APEX");
        CHECK_NEAR(x.Tv, i, 0.1, "Tv of the time label, Wikipedia APEX");
        CHECK_NEAR(x.Sv, i, 1e-13, "Sv, 3.125 is 0, 100 is 5: Wikipedia APEX");
        CHECK_NEAR(x.Av + x.Tv, x.ev_set, 1e-12, "Av + Tv = Ev");
        CHECK_NEAR(x.Bv + x.Sv, x.ev, 1e-12, "Bv + Sv = Ev");
        CHECK_NEAR(x.ev, x.ev_set, 1e-12, "no loss: metered is set");
    }
}

/* The slide: f/16 1/8 s = f/4 1/125 s = f/2 1/500 s. */
static void test_lecture(void)
{
    struct camera_setting a = {16, 1.0 / 8, 100}, b = {4, 1.0 / 125, 100}, c = {2, 1.0 / 500, 100};
    struct equivalent_exposure line;
    double stops = NAN;
    CHECK(exposure_stops(&a, &b, &stops, &error));
    CHECK_NEAR(stops, 0.034215715337912984, 1e-14, "log2(128/125), label of 1/128 s");
    CHECK(exposure_stops(&b, &c, &stops, &error));
    CHECK_NEAR(stops, 0, 1e-14, "f/4 1/125 is f/2 1/500 exactly");
    CHECK(exposure_stops(&c, &a, &stops, &error));
    CHECK_NEAR(stops, -0.034215715337912984, 1e-14, "the way back");
    CHECK(exposure_equivalent(11, 4, 1, &line, &error));
    CHECK_NEAR(line.t, 1.0 / 128, 1e-17, "EV 11 at f/4, slide");
    CHECK_NEAR(line.residual, 0, 1e-14, "on the series");
    CHECK(exposure_equivalent(11, 2, 3, &line, &error));
    CHECK_NEAR(line.t_series, 1.0 / 512, 1e-17, "EV 11 at f/2, slide");
    CHECK(exposure_equivalent(11, 5, 1, &line, &error));
    CHECK_NEAR(line.t, 25.0 / 2048, 1e-16, "N^2/2^EV");
    CHECK_NEAR(line.residual, log2(line.t_series / line.t), 1e-13, "definition of the residual");
    CHECK(fabs(line.residual) <= 0.5);
    CHECK(!exposure_equivalent(11, 5, 0, &line, &error));
    CHECK(!exposure_equivalent(NAN, 5, 1, &line, &error));
    CHECK(!exposure_stops(&a, &(struct camera_setting){4, 0, 100}, &stops, &error));
}

/* Every unknown, put back, is what it was. */
static void test_round_trips(void)
{
    for (int i = 0; i < 4000; i++) {
        struct exposure_given all = NOTHING, given;
        struct exposure light, x;
        all.N = exp2(draw(-1, 8));
        all.t = exp2(draw(-15, 12));
        all.S = exp2(draw(2, 18));
        all.loss = draw(0, 20);
        all.compensation = draw(-5, 5);
        CHECK(exposure_solve(&all, &light, &error));
        given = all;
        given.t = NAN;
        given.L = light.L;
        CHECK(exposure_solve(&given, &x, &error) && x.unknown == EXPOSURE_T);
        CHECK_RELATIVE(x.t, all.t, 1e-13, "t from L");
        given = all;
        given.N = NAN;
        given.E = light.E;
        CHECK(exposure_solve(&given, &x, &error) && x.unknown == EXPOSURE_N);
        CHECK_RELATIVE(x.N, all.N, 1e-13, "N from E");
        given = all;
        given.S = NAN;
        given.ev100 = light.ev100;
        CHECK(exposure_solve(&given, &x, &error) && x.unknown == EXPOSURE_S);
        CHECK_RELATIVE(x.S, all.S, 1e-13, "S from EV100");
        CHECK_NEAR(x.ev, light.ev, 1e-12, "EV at the solved speed");
        given = all;
        given.t = NAN;
        given.ev = light.ev;
        CHECK(exposure_solve(&given, &x, &error));
        CHECK_RELATIVE(x.t, all.t, 1e-13, "t from EV at ISO");
        CHECK_NEAR(x.ev_set, x.ev - all.loss - all.compensation, 1e-12, "set = metered - losses");
    }
}

/* Doubling the time is one stop, of light, of deviation and between settings. */
static void test_one_stop(void)
{
    for (int i = 0; i < 1000; i++) {
        struct exposure_given given = NOTHING;
        struct exposure one, two;
        double before = NAN, after = NAN, stops = NAN;
        given.N = exp2(draw(0, 6));
        given.t = exp2(draw(-12, 6));
        CHECK(exposure_solve(&given, &one, &error) && one.speed_assumed);
        given.t *= 2;
        CHECK(exposure_solve(&given, &two, &error));
        CHECK_NEAR(one.ev100 - two.ev100, 1, 1e-13, "doubling the time is one stop");
        given.ev100 = draw(-6, 20);
        CHECK(exposure_deviation(&given, &after, &error));
        given.t /= 2;
        CHECK(exposure_deviation(&given, &before, &error));
        CHECK_NEAR(after - before, 1, 1e-12, "doubling the time exposes one stop more");
        given.ev100 = one.ev100;
        CHECK(exposure_deviation(&given, &stops, &error));
        CHECK_NEAR(stops, 0, 1e-12, "the metered setting does not deviate");
        given.S = 800;
        CHECK(exposure_deviation(&given, &stops, &error));
        CHECK_NEAR(stops, 3, 1e-12, "three stops more speed");
        given.S = NAN;
        struct camera_setting from = {given.N, given.t, 100}, to = {given.N * 2, given.t, 800};
        CHECK(exposure_stops(&from, &to, &stops, &error));
        CHECK_NEAR(stops, 1, 1e-13, "two stops down, three up");
    }
}

static void test_refusals(void)
{
    static const struct {
        struct exposure_given given;
        enum error_code code;
        const char *names;
    } rows[] = {
        {{8, 0, 100, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN}, ERROR_DOMAIN, "exposure time 0 s"},
        {{8, 1, -100, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN}, ERROR_DOMAIN, "ISO speed -100"},
        {{INFINITY, 1, 9, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN}, ERROR_DOMAIN, "f-number"},
        {{8, NAN, 100, NAN, NAN, 0, NAN, NAN, NAN, NAN, NAN}, ERROR_DOMAIN, "luminance"},
        {{8, NAN, 100, 101, NAN, NAN, NAN, NAN, NAN, NAN, NAN}, ERROR_DOMAIN, "-100 to 100"},
        {{8, 1, 100, NAN, NAN, NAN, NAN, NAN, NAN, -1, NAN}, ERROR_DOMAIN, "light loss"},
        {{8, 1, 100, NAN, NAN, NAN, NAN, 0, NAN, NAN, NAN}, ERROR_DOMAIN, "meter constant K"},
        {{8, NAN, 100, 5, NAN, NAN, 9, NAN, NAN, NAN, NAN}, ERROR_USAGE, "illuminance"},
        {{8, NAN, 100, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN}, ERROR_USAGE, "luminance"},
        {{NAN, NAN, 100, 5, NAN, NAN, NAN, NAN, NAN, NAN, NAN}, ERROR_USAGE, "too little"},
        {{8, 1, 100, 5, NAN, NAN, NAN, NAN, NAN, NAN, NAN}, ERROR_USAGE, "nothing is left"},
        {{8, 1, NAN, NAN, 5, NAN, NAN, NAN, NAN, NAN, NAN},
         ERROR_USAGE,
         "exposure value at the ISO speed"},
        {{1e-200, NAN, 100, 0, NAN, NAN, NAN, NAN, NAN, NAN, NAN}, ERROR_DOMAIN, "f-number"},
    };
    for (int i = 0; i < COUNT(rows); i++) {
        struct exposure x;
        error.code = ERROR_NONE;
        CHECK(!exposure_solve(&rows[i].given, &x, &error));
        CHECK_NEAR(error.code, rows[i].code, 0, rows[i].names);
        CHECK(strstr(error.message, rows[i].names) != NULL);
    }
    double stops = 0;
    struct exposure x;
    struct exposure_given sunny = NOTHING;
    sunny.N = 16;
    sunny.ev100 = 15;
    CHECK(exposure_solve(&sunny, &x, &error) && x.speed_assumed && x.unknown == EXPOSURE_T);
    CHECK_NEAR(x.t, 1.0 / 128, 1e-16, "f/16 at EV 15, speed taken as 100");
    struct exposure_given given = NOTHING;
    given.N = 8;
    CHECK(!exposure_deviation(&given, &stops, &error) && error.code == ERROR_USAGE);
    given.t = 1;
    CHECK(!exposure_deviation(&given, &stops, &error) && error.code == ERROR_USAGE);
}

static void test_losses(void)
{
    static const struct {
        struct light_loss loss;
        double stops, tolerance;
        const char *source;
    } rows[] = {
        {NO_LOSS, 0, 0, "nothing in the way"},
        {{3.0, NAN, NAN, NAN, NAN, NAN}, 9.966, 5e-4, "physics.md 3: ND 3.0"},
        {{0.9, NAN, NAN, NAN, NAN, NAN}, 3, 0.011, "shuttermuse.com table: ND 0.9, 3 stops"},
        {{4.0, NAN, NAN, NAN, NAN, NAN}, 13.333, 0.05, "shuttermuse.com: ND 4.0, 13 1/3 stops"},
        {{NAN, 1024, NAN, NAN, NAN, NAN}, 10, 1e-14, "shuttermuse.com: factor 1024, 10 stops"},
        {{NAN, NAN, NAN, 0.125, NAN, NAN}, 3, 1e-14, "shuttermuse.com: 12.5 %, 3 stops"},
        {{NAN, NAN, NAN, NAN, 1, NAN}, 2, 1e-14, "1:1 is two stops (safaribooks 9780240812120)"},
        {{NAN, NAN, NAN, NAN, 0.5, NAN}, 1.169925, 1e-6, "log2 2.25, Langford: 2 1/4 at m 0.5"},
        {{NAN, NAN, NAN, NAN, 1, 0.5}, 3.169925, 1e-6, "log2 9: (1 + m/P)^2, physics.md 3"},
        {{NAN, 8, 1.5, 0.5, 1, NAN}, 7.5, 1e-14, "stops add"},
    };
    for (int i = 0; i < COUNT(rows); i++) {
        double stops = NAN;
        CHECK(light_loss(&rows[i].loss, &stops, &error));
        CHECK_NEAR(stops, rows[i].stops, rows[i].tolerance, rows[i].source);
    }
    static const struct light_loss bad[] = {
        {-0.3, NAN, NAN, NAN, NAN, NAN}, {NAN, 0.5, NAN, NAN, NAN, NAN},
        {NAN, NAN, -1, NAN, NAN, NAN},   {NAN, NAN, NAN, 1.5, NAN, NAN},
        {NAN, NAN, NAN, 0, NAN, NAN},    {NAN, NAN, NAN, NAN, -1, NAN},
        {NAN, NAN, NAN, NAN, 1, 0},      {INFINITY, NAN, NAN, NAN, NAN, NAN}};
    for (int i = 0; i < COUNT(bad); i++) {
        double stops = NAN;
        CHECK(!light_loss(&bad[i], &stops, &error) && error.code == ERROR_DOMAIN);
    }
}

static void test_lens(void)
{
    double x = NAN;
    CHECK(t_stop(2, 0.75, &x, &error));
    CHECK_NEAR(x, 2.309, 5e-4, "Wikipedia F-number: f/2.0 at 75 % is T 2.309");
    CHECK(transmittance_from_t_stop(2.656, 2.8, &x, &error));
    CHECK_NEAR(x, 0.9, 5e-4, "calculator.academy: T2.8 at 90 % is f/2.656");
    CHECK(!transmittance_from_t_stop(2.8, 2.5, &x, &error));
    CHECK(!t_stop(2, 1.3, &x, &error) && !t_stop(0, 0.5, &x, &error));
    static const struct {
        double m, factor, tolerance;
        const char *source;
    } bellows[] = {{0.5, 2.25, 1e-15, "army SS0512: bellows 18 in, lens 12 in, 8 s to 18 s"},
                   {8.0 / 12, 2.8, 0.05, "army SS0512: image 8 in, original 12 in"},
                   {27.0 / 12 - 1, 5.06, 0.005, "army SS0511: bellows 27 in, lens 12 in"}};
    for (int i = 0; i < COUNT(bellows); i++) {
        const struct light_loss loss = {NAN, NAN, NAN, NAN, bellows[i].m, 1};
        CHECK(light_loss(&loss, &x, &error));
        CHECK_NEAR(exp2(x), bellows[i].factor, bellows[i].tolerance, bellows[i].source);
    }
}

static void test_shutter(void)
{
    /* provideocoalition.com and hgb-leipzig.de, at 24 fps (their 45 deg = 1/198 is a slip) */
    static const double rows[][2] = {{360, 24}, {270, 32}, {180, 48}, {172.8, 50},
                                     {144, 60}, {90, 96},  {72, 120}};
    for (int i = 0; i < COUNT(rows); i++) {
        double angle = rows[i][0] * pi / 180;
        struct shutter t = {angle, 24, NAN}, a = {NAN, 24, 1 / rows[i][1]},
                       r = {angle, NAN, 1 / rows[i][1]};
        CHECK(shutter_solve(&t, &error) && shutter_solve(&a, &error) && shutter_solve(&r, &error));
        CHECK_RELATIVE(t.t, 1 / rows[i][1], 1e-14, "time of a shutter angle");
        CHECK_RELATIVE(a.angle, angle, 1e-14, "angle of a time");
        CHECK_RELATIVE(r.rate, 24.0, 1e-14, "frame rate");
    }
    struct shutter slow = {NAN, 24, 0.05}, wide = {7, 24, NAN}, empty = {NAN, NAN, 1},
                   still = {3, 0, NAN};
    CHECK(!shutter_solve(&slow, &error) && strstr(error.message, "432 deg exceeds 360") != NULL);
    CHECK(!shutter_solve(&wide, &error) && error.code == ERROR_DOMAIN);
    CHECK(!shutter_solve(&empty, &error) && error.code == ERROR_USAGE);
    CHECK(!shutter_solve(&still, &error) && strstr(error.message, "frame rate") != NULL);
}

static void test_sensor(void)
{
    /* colour-hdri, tests of exposure/dsc.py: T 0.9, v 0.98, 10 deg */
    static const double rows[][4] = {
        {4000, 8, 250, 0.16289371}, {2000, 5.6, 500, 0.08310904}, {1000, 2.8, 1000, 0.08310904}};
    double q = NAN, H = NAN, loss = NAN;
    CHECK(lens_q(0.9, 0.98, 10 * pi / 180, &q, &error));
    CHECK_NEAR(q, LENS_Q_STANDARD, 0.002, "Wikipedia Film speed: q = 0.65");
    for (int i = 0; i < COUNT(rows); i++) {
        CHECK(focal_plane_exposure(q, rows[i][0], rows[i][1], 1 / rows[i][2], 0, &H, &error));
        CHECK_NEAR(H, rows[i][3], 1e-8, "colour-hdri arithmetic_mean_focal_plane_exposure");
    }
    struct light_loss near = NO_LOSS;
    near.m = 0.05 / (5 - 0.05);
    CHECK(light_loss(&near, &loss, &error));
    CHECK(focal_plane_exposure(q, 18, 5.6, 0.25, loss, &H, &error));
    CHECK_RELATIVE(H / saturation_exposure(400), 0.46993364546604555, 1e-12,
                   "colour-hdri saturation_based_speed_focal_plane_exposure, 50 mm at 5 m");
    CHECK_NEAR(saturation_speed(0.78), 100, 1e-12, "ISO 12232: 78/H");
    CHECK_NEAR(log2(saturation_exposure(100) / recommended_exposure(100)), 2.963, 5e-4, "log2 7.8");
    CHECK(!lens_q(1.3, 1, 0, &q, &error) && !lens_q(1, 1, pi / 2, &q, &error));
    CHECK(strstr(error.message, "field angle 90 deg") != NULL);
    CHECK(!focal_plane_exposure(0.65, 0, 8, 1, 0, &H, &error));
    CHECK(!focal_plane_exposure(NAN, 1, 8, 1, 0, &H, &error));
    CHECK(!focal_plane_exposure(1.0, 1, 8, 1, 0, &H, &error));
}

/* The slide: sixteen one-stop shots from 30 s to 1/1000 s. */
static void test_bracket_lecture(void)
{
    struct bracket plan;
    CHECK(bracket_plan(&(struct bracket_given){30, 0.001, 1, NAN}, &plan, &error));
    CHECK_NEAR(plan.shots, 16, 0, "slide: sixteen shots");
    CHECK_NEAR(bracket_time(&plan, 0), 30, 0, "the first");
    CHECK_NEAR(plan.shortest, 30.0 / 32768, 1e-18, "15 halvings of 30 s");
    CHECK_NEAR(plan.residual, log2(30000) - 15, 1e-13, "against 1/1000 s");
    CHECK(bracket_plan(&(struct bracket_given){1.0 / 1024, 32, 1, NAN}, &plan, &error));
    CHECK_NEAR(plan.shots, 16, 0, "exact values of the labels, ends swapped");
    CHECK_NEAR(plan.residual, 0, 1e-14, "32 s to 1/1024 s is 15 stops");
    double sum = 0;
    for (int i = 0; i < plan.shots; i++) {
        sum += bracket_time(&plan, i);
        CHECK_NEAR(bracket_offset(&plan, i, 1), 5 - i, 1e-14, "offset from 1 s");
    }
    CHECK_RELATIVE(plan.total, sum, 1e-14, "total is the sum");
    CHECK_NEAR(plan.total, 64 - 1.0 / 1024, 1e-12, "geometric sum");
}

static void test_bracket(void)
{
    struct bracket plan;
    struct bracket_range range;
    int shots = 0;
    CHECK(bracket_plan(&(struct bracket_given){30, 0.001, NAN, 16}, &plan, &error));
    CHECK_RELATIVE(plan.step, log2(30000) / 15, 1e-14, "step between exact ends");
    CHECK_RELATIVE(plan.shortest, 0.001, 1e-13, "reaches the end");
    CHECK(bracket_plan(&(struct bracket_given){NAN, 0.0625, 2, 3}, &plan, &error));
    CHECK_NEAR(plan.longest, 1, 1e-15, "from the shortest");
    CHECK(bracket_plan(&(struct bracket_given){4, NAN, 2.0 / 3, 4}, &plan, &error));
    CHECK_NEAR(plan.shortest, 1, 1e-14, "three steps of 2/3 stop are two stops");
    CHECK(bracket_plan(&(struct bracket_given){1, 1, 1, NAN}, &plan, &error));
    CHECK_NEAR(plan.shots, 1, 0, "no span, one shot");
    CHECK(bracket_around(1.0 / 64, 2, 3, &plan, &error));
    CHECK_NEAR(plan.longest, 1.0 / 16, 1e-16, "+2 EV");
    CHECK_NEAR(plan.shortest, 1.0 / 256, 1e-17, "-2 EV");
    CHECK_NEAR(bracket_offset(&plan, 1, 1.0 / 64), 0, 1e-14, "the middle is metered");
    CHECK(bracket_covers(&plan, 12, &range, &error));
    CHECK_NEAR(range.covered, 16, 0, "12 + 2 x 2 stops");
    CHECK_NEAR(range.overlap, 10, 0, "12 - 2");
    CHECK(bracket_shots_needed(16, 12, 2, &shots, &error) && shots == 3);
    CHECK(bracket_shots_needed(16.1, 12, 2, &shots, &error) && shots == 4);
    CHECK(bracket_shots_needed(8, 12, 2, &shots, &error) && shots == 1);
    for (int i = 0; i < 2000; i++) {
        struct bracket_given given = {exp2(draw(-10, 6)), NAN, draw(0.1, 3), floor(draw(1, 30))};
        CHECK(bracket_plan(&given, &plan, &error));
        given.to = plan.shortest;
        given.shots = NAN;
        double sum = 0;
        for (int k = 0; k < plan.shots; k++) {
            sum += bracket_time(&plan, k);
        }
        CHECK_RELATIVE(plan.total, sum, 1e-12, "total is the sum");
        struct bracket again;
        CHECK(bracket_plan(&given, &again, &error) && again.shots == plan.shots);
        CHECK_NEAR(again.residual, 0, 1e-12, "the ends fit");
    }
}

static void test_bracket_refusals(void)
{
    static const struct bracket_given bad[] = {
        {30, 0.001, 1, 16},    {30, NAN, 1, NAN},  {0, 1, 1, NAN},     {1, 2, -1, NAN},
        {1, 2, 0.0001, NAN},   {1, 2, NAN, 1},     {1, 2, NAN, 2.5},   {1, 2, NAN, 5000},
        {1, INFINITY, 1, NAN}, {1, NAN, 100, 900}, {1, 2, 1e-310, NAN}};
    struct bracket plan;
    struct bracket_range range;
    int shots = 0;
    for (int i = 0; i < COUNT(bad); i++) {
        error.code = ERROR_NONE;
        CHECK(!bracket_plan(&bad[i], &plan, &error));
        CHECK(error.code == (i < 2 ? ERROR_USAGE : ERROR_DOMAIN));
    }
    CHECK(!bracket_around(1, 0, 3, &plan, &error) && !bracket_around(1, 1, 0, &plan, &error));
    CHECK(bracket_around(1, 1, 3, &plan, &error) && !bracket_covers(&plan, 0, &range, &error));
    CHECK(!bracket_shots_needed(20, 3, 4, &shots, &error));
    CHECK(strstr(error.message, "gaps") != NULL);
    CHECK(!bracket_shots_needed(1e9, 3, 1, &shots, &error));
}

/* Sunny 16, f/16 at 1/ISO s, and its light K 2^EV/100 with K = 12.5: not a bit beside. */
static void test_exact_rule(void)
{
    static const double speeds[] = {25, 64, 100, 125, 160, 200, 400, 3200};
    for (size_t i = 0; i < sizeof speeds / sizeof speeds[0]; i++) {
        struct exposure_given given = {.N = 16,
                                       .t = NAN,
                                       .S = speeds[i],
                                       .L = NAN,
                                       .E = NAN,
                                       .ev = NAN,
                                       .ev100 = 14.643856189774725,
                                       .K = 12.5,
                                       .C = 250};
        struct exposure x;
        struct error problem;
        CHECK(exposure_solve(&given, &x, &problem));
        CHECK_NEAR(x.t, 1 / speeds[i], 0, "1/ISO s");
        CHECK_NEAR(x.L, 3200, 0, "cd/m2");
        given.t = 1 / speeds[i];
        given.N = NAN;
        CHECK(exposure_solve(&given, &x, &problem));
        CHECK_NEAR(x.N, 16, 0, "f/16");
    }
}

/* Sunny 16: at f/16 and 1/125 s white comes half a stop below saturation, 78/100 lx s. */
static void test_white(void)
{
    CHECK_RELATIVE(exposure_white(15), 26075.945876176134, 1e-14, "81920 lx/pi");
    CHECK_NEAR(0.65 * exposure_white(15) / 125 / 256 / 0.78, 0.7071, 0.03, "[IsoSpeed06]");
}

/* EV 12, 2^12 K/100 = 512 cd/m2 and 2^12 C/100 = 10240 lx of ISO 2720 are one light. */
static void test_same_light(void)
{
    struct exposure x;
    struct exposure_given all = NOTHING;
    all.N = 8;
    all.S = 200;
    all.ev100 = 12;
    all.ev = 13;
    all.L = 512;
    all.E = 10240;
    CHECK(exposure_solve(&all, &x, &error));
    CHECK_NEAR(x.t, 64.0 / 8192, 1e-15, "four names of a light");
    all.ev100 = NAN;
    all.L = 512.3; /* 0.001 stop */
    CHECK(exposure_solve(&all, &x, &error));
    all.E = 10400; /* 0.02 stop */
    CHECK(!exposure_solve(&all, &x, &error) && error.code == ERROR_USAGE);
    CHECK(strstr(error.hint, "illuminance 10400") != NULL);
    all.E = NAN;
    all.S = NAN; /* whatever light the exposure value then is */
    all.t = 0.01;
    CHECK(!exposure_solve(&all, &x, &error));
}

int main(void)
{
    test_same_light();
    test_white();
    test_exact_rule();
    test_light();
    test_far_light();
    test_apex();
    test_lecture();
    test_round_trips();
    test_one_stop();
    test_refusals();
    test_losses();
    test_lens();
    test_shutter();
    test_sensor();
    test_bracket_lecture();
    test_bracket();
    test_bracket_refusals();
    return check_report();
}
