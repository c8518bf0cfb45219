/* tests/unit/test_flash.c - guide numbers and mixed light. */
/* SPDX-License-Identifier: MIT */
#include <stdint.h>

#include "check.h"
#include "photo/flash.h"

static struct error error;

#define COUNT(table) ((int)(sizeof(table) / sizeof *(table)))

static double draw(double low, double high)
{
    static uint64_t state = 1230;
    state ^= state >> 12;
    state ^= state << 25;
    state ^= state >> 27;
    return low + (high - low) * ((double)((state * 2685821657736338717u) >> 11) * 0x1p-53);
}

static const double foot = 304.8;

/* Makers' worked examples; guide numbers in m or ft become mm. */
static void test_published(void)
{
    static const struct {
        double GN, unit, N, d, S, power; /* GN and d in `unit` mm */
        double expected, tolerance;      /* of the unknown, in the same unit */
        const char *source;
    } rows[] = {
        {32, 1000, NAN, 4, NAN, NAN, 8, 1e-12, "openphotographicsociety.org: GN 32 m, 4 m"},
        {80, 304.8, NAN, 10, NAN, NAN, 8, 1e-12, "openphotographicsociety.org: 80 ft, 10 ft"},
        {80, 304.8, NAN, 20, NAN, NAN, 4, 1e-12, "Wikipedia Guide number: GN 80 ft, 20 ft, f/4"},
        {NAN, 304.8, 8, 15, NAN, NAN, 120, 1e-10, "openphotographicsociety.org: 15 ft f/8"},
        {36.0624, 1000, NAN, 9, 200, 1, 5.67, 0.005, "Kodak DCS 600: GN 51 at ISO 200, 9 m"},
        {118.087, 304.8, NAN, 30, 200, 1, 5.57, 0.005, "Kodak DCS 600: 167 ft at ISO 200, 30 ft"},
        {36.0624, 1000, 1, NAN, 800, 1, 102, 0.01, "Kodak DCS 600: GN 102 at ISO 800"},
        {36.0624, 1000, 1, NAN, 80, 1, 32.23, 0.03, "Kodak DCS 600: 51 x 0.632 at ISO 80"},
        {11, 1000, 2.8, NAN, 100, 1, 3.9, 0.05, "Pentax MZ-7: GN 11, f/2.8, 3.9 m"},
        {11, 1000, 4, NAN, 200, 1, 3.9, 0.05, "Pentax K100D: ISO 200, f/4, 3.9 m"},
        {11, 1000, NAN, 5.2, 200, 1, 3, 0.01, "Pentax K100D: ISO 200, 5.2 m, f/3"},
        {11, 1000, 1, NAN, 25, 1, 5.5, 1e-12, "Pentax MZ-7: GN 5.5 at ISO 25"},
        {11, 1000, 1, NAN, 400, 1, 22, 1e-12, "Pentax MZ-7: GN 22 at ISO 400"},
        {32, 1000, 8, NAN, 100, 0.25, 2, 1e-12, "two stops less power, half the distance"},
        {32, 1000, 8, 2, 100, NAN, 0.25, 1e-12, "power for half the distance"},
        {32, 1000, 8, 8, NAN, 1, 400, 1e-9, "ISO for double the distance"},
    };
    for (int i = 0; i < COUNT(rows); i++) {
        double unit = rows[i].unit;
        struct flash_setting s = {
            rows[i].GN * unit, rows[i].N, rows[i].d * unit, rows[i].S, rows[i].power, NAN, NAN};
        enum flash_unknown unknown = FLASH_FLASHES;
        CHECK(flash_solve(&s, &unknown, &error));
        double answers[] = {
            [FLASH_GN] = s.GN / unit, [FLASH_N] = s.N,         [FLASH_D] = s.d / unit,
            [FLASH_S] = s.S,          [FLASH_POWER] = s.power, [FLASH_FLASHES] = NAN};
        check_source(strchr(rows[i].source, ':') != NULL ? "flash" : NULL, "");
        CHECK_NEAR(answers[unknown], rows[i].expected, rows[i].tolerance, rows[i].source);
        check_source(NULL, "");
    }
}

static void test_round_trips(void)
{
    for (int i = 0; i < 4000; i++) {
        struct flash_setting all = {draw(5, 90) * 1000, exp2(draw(0, 6)),  NAN,
                                    exp2(draw(3, 14)),  exp2(-draw(0, 7)), floor(draw(1, 9)),
                                    draw(0, 4)};
        struct flash_setting s = all;
        enum flash_unknown unknown = FLASH_GN;
        CHECK(flash_solve(&s, &unknown, &error) && unknown == FLASH_D);
        all.d = s.d;
        double *members[] = {&s.GN, &s.N, &s.d, &s.S, &s.power, &s.flashes};
        const double values[] = {all.GN, all.N, all.d, all.S, all.power, all.flashes};
        for (int k = 0; k < 6; k++) {
            s = all;
            *members[k] = NAN;
            bool solved = flash_solve(&s, &unknown, &error);
            if (k == FLASH_POWER && !solved) { /* full power may round to above 1 */
                CHECK(all.power > 1 - 1e-12);
                continue;
            }
            CHECK(solved && unknown == (enum flash_unknown)k);
            CHECK_RELATIVE(*members[k], values[k], 1e-13, "solved back");
        }
        /* a whole answer stands; one with another number does not */
        s = all;
        CHECK(flash_solve(&s, &unknown, &error));
        CHECK_NEAR(s.N, all.N, 0, "an answer");
        s.d *= 1.01;
        CHECK(!flash_solve(&s, &unknown, &error) && error.code == ERROR_USAGE);
    }
}

static void test_refusals(void)
{
    static const struct {
        struct flash_setting s;
        enum error_code code;
        const char *names;
    } rows[] = {
        {{NAN, NAN, 1, 100, 1, 1, 0}, ERROR_USAGE, "guide number"},
        {{9, NAN, NAN, 100, 1, 1, 0}, ERROR_USAGE, "distance"},
        {{9, 8, 1, 100, 1, 1, 0}, ERROR_USAGE, "number of flashes"},
        {{9, 8, NAN, 100, 1.5, 1, 0}, ERROR_DOMAIN, "flash power 1.5"},
        {{9, 8, NAN, 0, 1, 1, 0}, ERROR_DOMAIN, "ISO speed 0"},
        {{9, -8, NAN, 100, 1, 1, 0}, ERROR_DOMAIN, "f-number -8"},
        {{9, 8, NAN, 100, 1, 1, -1}, ERROR_DOMAIN, "light loss"},
        {{10000, 4, 5000, 100, NAN, 1, 0}, ERROR_DOMAIN, "2 stops too weak"},
        {{1e-300, 1e300, NAN, 100, 1, 1, 0}, ERROR_DOMAIN, "guide number 1e-300"},
    };
    for (int i = 0; i < COUNT(rows); i++) {
        struct flash_setting s = rows[i].s;
        enum flash_unknown unknown;
        error.code = ERROR_NONE;
        CHECK(!flash_solve(&s, &unknown, &error));
        CHECK_NEAR(error.code, rows[i].code, 0, rows[i].names);
        CHECK(strstr(error.message, rows[i].names) != NULL);
    }
}

static void test_geometry(void)
{
    double x = NAN;
    double units[] = {30 * foot, 40 * foot};
    CHECK(flash_sum(units, 2, &x, &error));
    CHECK_RELATIVE(x, 50 * foot, 1e-15, "squares add: 30, 40, 50");
    double equal[] = {10, 10, 10, 10};
    CHECK(flash_sum(equal, 4, &x, &error));
    CHECK_NEAR(x, 20, 0, "four flashes double the guide number");
    CHECK(!flash_sum(equal, 0, &x, &error) && error.code == ERROR_USAGE);
    equal[2] = 0;
    CHECK(!flash_sum(equal, 4, &x, &error));
    CHECK(flash_bounce(3000, 1500, 2500, &x, &error));
    CHECK_NEAR(x, 5000, 1e-12, "3, 4, 5");
    CHECK(!flash_bounce(-1, 1, 1, &x, &error) && !flash_bounce(1, 0, 1, &x, &error));
    CHECK(flash_falloff(1000, 2000, &x, &error));
    CHECK_NEAR(x, 2, 0, "openphotographicsociety.org: double distance, a quarter");
    CHECK(!flash_falloff(0, 1, &x, &error));
}

/* American Society of Cinematographers, as in Wikipedia "Lighting ratio" and photocalcs.pages.dev
 */
static void test_ratio(void)
{
    static const double rows[][2] = {{0, 2}, {1, 3}, {2, 5}, {3, 9}};
    double x = NAN;
    for (int i = 0; i < COUNT(rows); i++) {
        CHECK(lighting_ratio(rows[i][0], &x, &error));
        CHECK_NEAR(x, rows[i][1], 0, "ASC (key + fill):fill");
        CHECK(lighting_stops(rows[i][1], &x, &error));
        CHECK_NEAR(x, rows[i][0], 1e-15, "ASC, stops");
    }
    CHECK(lighting_stops((800 + 200) / 200.0, &x, &error));
    CHECK_NEAR(x, 2, 1e-15, "Wikipedia: 800 fc key, 200 fc fill");
    CHECK(!lighting_stops(1, &x, &error) && !lighting_stops(NAN, &x, &error));
    CHECK(!lighting_ratio(INFINITY, &x, &error));
}

static void test_ambient(void)
{
    /* f/8 1/64 s is EV 12; GN 32 m at 4 m is right at f/8 */
    struct flash_ambient light = {{32000, 8, 4000, 100, 1, 1, NAN}, 1.0 / 64, 1.0 / 250, 12};
    struct flash_balance b;
    CHECK(flash_against_ambient(&light, &b, &error));
    CHECK_NEAR(b.flash, 0, 1e-14, "flash alone is right");
    CHECK_NEAR(b.ambient, 0, 1e-14, "ambient alone is right");
    CHECK_NEAR(b.total, 1, 1e-14, "twice the light is one stop");
    CHECK_NEAR(b.ratio, 2, 1e-14, "lit by both, by one");
    light.ev100 = 10;
    CHECK(flash_against_ambient(&light, &b, &error));
    CHECK_NEAR(b.flash_to_ambient, 2, 1e-14, "two stops less ambient");
    CHECK_NEAR(b.total, log2(1.25), 1e-14, "1 + 1/4");
    CHECK_NEAR(b.ratio, 5, 1e-13, "ASC: 2 stops are 5:1");
    light.flash.S = 400;
    light.flash.power = 0.25;
    CHECK(flash_against_ambient(&light, &b, &error));
    CHECK_NEAR(b.flash, 0, 1e-14, "four times the speed, a quarter of the power");
    CHECK_NEAR(b.ambient, 0, 1e-14, "four times the speed");
    light.flash.loss = 100;
    light.ev100 = -92; /* two stops below the flash, at ISO 400 */
    CHECK(flash_against_ambient(&light, &b, &error));
    CHECK_NEAR(b.total, -100 + log2(1 + 0.25), 1e-10, "dark, without underflow");
    light.t = 1.0 / 500;
    CHECK(!flash_against_ambient(&light, &b, &error));
    CHECK(strstr(error.message, "sync") != NULL && error.code == ERROR_DOMAIN);
    light.sync = NAN;
    CHECK(flash_against_ambient(&light, &b, &error));
    light.flash.power = NAN;
    CHECK(!flash_against_ambient(&light, &b, &error) && error.code == ERROR_USAGE);
}

/* Halves of stops by octaves, by hand: sqrt(36 x 72) half way between 35 and 140 mm. */
static void test_zoomed(void)
{
    static const struct flash_mark marks[] = {{24, 30000}, {35, 36000}, {140, 72000}};
    static const struct {
        double f, expected, tolerance;
        const char *source;
    } rows[] = {
        {24, 30000, 0, "a mark"},
        {35, 36000, 0, "a mark"},
        {140, 72000, 0, "a mark"},
        {70, 50911.688245431422, 1e-10, "36000 sqrt(2)"},
        {28.982753492378876, 32863.353450309968, 1e-10, "sqrt(24 x 35): sqrt(30 x 36)"},
    };
    static const struct flash_mark falling[] = {{35, 36000}, {24, 30000}};
    double GN;
    for (int i = 0; i < COUNT(rows); i++) {
        CHECK(flash_zoomed(marks, 3, rows[i].f, &GN, &error));
        CHECK_NEAR(GN, rows[i].expected, rows[i].tolerance, rows[i].source);
    }
    CHECK(flash_zoomed(marks, 1, 24, &GN, &error) && !(fabs(GN - 30000) > 0));
    CHECK(!flash_zoomed(marks, 3, 23, &GN, &error) && strstr(error.message, "24 to 140") != NULL);
    CHECK(!flash_zoomed(marks, 3, 141, &GN, &error));
    CHECK(!flash_zoomed(marks, 3, NAN, &GN, &error));
    CHECK(!flash_zoomed(falling, 2, 30, &GN, &error) && strstr(error.message, "rise") != NULL);
}

int main(void)
{
    test_zoomed();
    test_published();
    test_round_trips();
    test_refusals();
    test_geometry();
    test_ratio();
    test_ambient();
    return check_report();
}
