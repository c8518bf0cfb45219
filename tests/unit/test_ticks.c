/* tests/unit/test_ticks.c - round numbers along an axis. */
/* SPDX-License-Identifier: MIT */
#include "base/arena.h"
#include "check.h"
#include "draw/ticks.h"

static void check_ticks(double low, double high, bool log)
{
    struct ticks ticks;
    if (log) {
        ticks_log(low, high, &ticks);
    } else {
        ticks_linear(low, high, &ticks);
    }
    double slack = 1e-6 * (ticks.step > 0 ? ticks.step : low);
    CHECK(ticks.count >= 3 && ticks.count <= TICKS_MOST);
    CHECK(ticks.value[0] <= low + slack);
    CHECK(ticks.value[ticks.count - 1] >= high * (1 - 1e-6) - slack);
    for (size_t i = 0; i < ticks.count; i++) {
        double v = ticks.step > 0 ? ticks.step : ticks.value[i];
        double lead = v / pow(10, floor(log10(v * (1 + 1e-9))));
        CHECK(fabs(lead - 1) < 1e-9 || fabs(lead - 2) < 1e-9 || fabs(lead - 5) < 1e-9);
        if (i > 0) {
            CHECK(ticks.value[i] > ticks.value[i - 1]);
        }
        if (i > 0 && ticks.step > 0) {
            CHECK_NEAR(ticks.value[i] - ticks.value[i - 1], ticks.step, 1e-6 * ticks.step,
                       "distance of ticks");
        }
    }
}

static void test_ticks(void)
{
    for (int power = -12; power <= 18; power++) {
        for (double size = 1; size < 10; size *= 1.07) {
            double range = size * pow(10, power);
            check_ticks(0, range, false);
            check_ticks(-range, 2.3 * range, false);
            check_ticks(7 * range, 7.3 * range, false);
            check_ticks(range, range, false);
            check_ticks(range, 3.9 * range, true);
            check_ticks(range, 60 * range, true);
            check_ticks(range, 1e5 * range, true);
        }
    }
    check_ticks(0, 0, false);
    check_ticks(1e18, 1e18 + 128, false);
    check_ticks(1e-12, 1e18, true);
    check_ticks(1e-200, 1e200, true);
}

/* ISO 517 and ISO 516: f/1 1.4 2 2.8 ..., 1/1000 1/500 1/250 1/125 1/60 ... */
static void test_stops(struct arena *arena)
{
    static const struct {
        enum ticks_kind kind;
        double low, high;
        size_t count, index;
        const char *text;
    } cases[] = {
        {TICKS_FNUMBER, 1.4, 22, 9, 4, "f/5.6"},
        {TICKS_FNUMBER, 1.5, 4.1, 5, 0, "f/1.4"},
        {TICKS_FNUMBER, 1.5, 4.1, 5, 4, "f/5.6"},
        {TICKS_FNUMBER, 0.5, 256, 10, 9, "f/256"},
        {TICKS_TIME, 1 / 1000.0, 1 / 60.0, 5, 1, "1/500"},
        {TICKS_TIME, 1 / 8000.0, 30, 10, 2, "1/500"},
        {TICKS_ISO, 90, 1600, 6, 0, "50"},
        {TICKS_ISO, 90, 1600, 6, 5, "1600"},
        {TICKS_FNUMBER, 0.1, 22, 9, 1, "0.2"}, /* no stops there */
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct ticks ticks;
        ticks_stops(cases[i].kind, cases[i].low, cases[i].high, &ticks);
        CHECK(ticks.count == cases[i].count || cases[i].low < 0.5);
        CHECK_TEXT(ticks_text(arena, &ticks, cases[i].index), cases[i].text);
        CHECK(ticks.value[0] <= cases[i].low * (1 + 1e-9));
        CHECK(ticks.value[ticks.count - 1] >= cases[i].high * (1 - 1e-9));
    }
}

static void test_tick_text(struct arena *arena)
{
    static const struct {
        double low, high;
        bool log;
        size_t index;
        const char *text;
    } cases[] = {
        {0, 1, false, 1, "0.2"},
        {0, 1, false, 5, "1.0"},
        {-1, 1, false, 0,
         "\xe2\x88\x92"
         "1.0"},
        {-1, 1, false, 2, "0"},
        {0, 4e6, false, 1,
         "0.5\xc3\x97"
         "10\xe2\x81\xb6"},
        {0, 40000, false, 8, "40000"},
        {0.5, 60, true, 1, "1"},
        {0.5, 60, true, 6, "50"},
        {1e-8, 1, true, 0, "10\xe2\x81\xbb\xe2\x81\xb8"},
    };
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct ticks ticks;
        if (cases[i].log) {
            ticks_log(cases[i].low, cases[i].high, &ticks);
        } else {
            ticks_linear(cases[i].low, cases[i].high, &ticks);
        }
        CHECK_TEXT(ticks_text(arena, &ticks, cases[i].index), cases[i].text);
    }
}

/* -------- plots -------- */

int main(void)
{
    struct arena arena = {0};
    test_ticks();
    test_tick_text(&arena);
    test_stops(&arena);
    arena_free(&arena);
    return check_report();
}
