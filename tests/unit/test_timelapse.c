/* tests/unit/test_timelapse.c - plans of time-lapses, by hand. */
/* SPDX-License-Identifier: MIT */
#include "photo/timelapse.h"

#include "base/constants.h"
#include "check.h"

#define NONE ((double)NAN)

/* shots, interval, event, clip, rate, time, gap, star angle, frame, card */
static const struct plan {
    struct timelapse_given given;
    long shots;
    double interval, event, clip, rate;
    const char *source;
} plans[] = {
    {{NONE, NONE, 7200, 20, NONE, NONE, 1, NONE, NONE, NONE}, 480, 15, 7200, 20, 24, "2 h in 20 s"},
    {{NONE, 5, 3600, NONE, NONE, NONE, 1, NONE, NONE, NONE}, 720, 5, 3600, 30, 24, "3600/5"},
    {{NONE, 7, 3600, NONE, 25, NONE, 1, NONE, NONE, NONE},
     514,
     7,
     3598,
     20.56,
     25,
     "514 whole intervals of 7 s in an hour"},
    {{NONE, 4, NONE, 10, 30, 2, 1, NONE, NONE, NONE}, 300, 4, 1200, 10, 30, "10 s at 30 fps"},
    {{NONE, NONE, 600, 33.3, 30, NONE, 1, NONE, NONE, NONE},
     999,
     600 / 999.0,
     600,
     33.3,
     30,
     "33.3 x 30 rounds to 999, not 1000"},
    {{NONE, 5, 3600, 36, NONE, NONE, 1, NONE, NONE, NONE}, 720, 5, 3600, 36, 20, "720 frames/36 s"},
    {{100, 10, NONE, NONE, NONE, NONE, 1, NONE, NONE, NONE},
     100,
     10,
     1000,
     100 / 24.0,
     24,
     "shots and interval"},
    {{NONE, NONE, 10800, NONE, NONE, 30, 1, NONE, NONE, NONE},
     348,
     31,
     10788,
     14.5,
     24,
     "3 h of 30 s exposures, 1 s between: floor(10800/31)"},
    {{NONE, NONE, NONE, NONE, NONE, NONE, 1, NONE, 40e6, 64e9},
     1600,
     NONE,
     NONE,
     1600 / 24.0,
     24,
     "64 GB of 40 MB"},
    {{1, NONE, NONE, NONE, NONE, 8, 0.5, NONE, NONE, NONE}, 1, 8.5, 8.5, 1 / 24.0, 24, "one shot"},
};

static void test_plans(void)
{
    struct error error;
    for (size_t i = 0; i < sizeof plans / sizeof plans[0]; i++) {
        const struct plan *p = &plans[i];
        struct timelapse plan;
        CHECK(timelapse_solve(&p->given, &plan, &error));
        CHECK_NEAR((double)plan.shots, (double)p->shots, 0, p->source);
        CHECK_RELATIVE(plan.rate, p->rate, 1e-14, p->source);
        CHECK_RELATIVE(plan.clip, p->clip, 1e-14, p->source);
        CHECK(isnan(plan.interval) == isnan(p->interval));
        if (!isnan(p->interval)) {
            CHECK_RELATIVE(plan.interval, p->interval, 1e-14, p->source);
            CHECK_RELATIVE(plan.event, p->event, 1e-14, p->source);
            CHECK_RELATIVE(plan.speed_up, p->event / p->clip, 1e-13, p->source);
        }
        CHECK(plan.rate_assumed == (isnan(p->given.rate) && p->rate == TIMELAPSE_RATE));
    }
}

/* Astrophotographers' rule: the sky turns by 15 degrees in an hour of stars, 1/24 of a turn. */
static void test_star_angle(void)
{
    struct error error;
    struct timelapse plan;
    /* 30 deg in 86164.0989/12 = 7180.34 s; 7150.34/31 = 230.66: 231 steps, 232 shots */
    const struct timelapse_given g = {NONE, NONE, NONE, NONE, NONE, 30, 1, PI / 6, NONE, NONE};
    CHECK(timelapse_solve(&g, &plan, &error));
    CHECK_NEAR((double)plan.shots, 232, 0, "231 steps of 31 s");
    CHECK_RELATIVE(plan.span, 7191.0, 1e-14, "231 x 31 + 30 s");
    CHECK_RELATIVE(plan.star_angle, 2 * PI * 7191.0 / 86164.098903691, 1e-13, "of a stellar day");
    /* with the number of shots the interval follows: (7180.34 - 30)/99 */
    const struct timelapse_given few = {100, NONE, NONE, NONE, NONE, 30, 1, PI / 6, NONE, NONE};
    CHECK(timelapse_solve(&few, &plan, &error));
    CHECK_RELATIVE(plan.interval, (86164.098903691 / 12 - 30) / 99, 1e-13, "99 steps");
    CHECK_RELATIVE(plan.star_angle, PI / 6, 1e-13, "exactly as wanted");
}

static void test_storage(void)
{
    struct error error;
    struct timelapse plan;
    const struct timelapse_given g = {NONE, 5, 3600, NONE, NONE, NONE, 1, NONE, 25e6, 16e9};
    CHECK(timelapse_solve(&g, &plan, &error));
    CHECK_RELATIVE(plan.space, 18e9, 1e-15, "720 x 25 MB");
    CHECK_NEAR(plan.card_shots, 640, 0, "16 GB/25 MB");
    CHECK_NEAR(plan.cards, 2, 0, "720 shots on cards of 640");
    CHECK_RELATIVE(plan.card_time, 3200.0, 1e-15, "640 x 5 s");
    CHECK(isnan(plan.pause) && isnan(plan.shutter_angle));
}

static void test_shutter(void)
{
    struct error error;
    struct timelapse plan;
    const struct timelapse_given g = {300, 4, NONE, NONE, NONE, 2, 1, NONE, NONE, NONE};
    CHECK(timelapse_solve(&g, &plan, &error));
    CHECK_RELATIVE(plan.shutter_angle, PI, 1e-15, "half of the interval is exposed");
    CHECK_RELATIVE(plan.pause, 2.0, 1e-15, "the other half");
    const struct timelapse_given tight = {300, 4, NONE, NONE, NONE, 3, 1, NONE, NONE, NONE};
    CHECK(timelapse_solve(&tight, &plan, &error));
}

static const struct refusal {
    struct timelapse_given given;
    enum error_code code;
    const char *message;
} refusals[] = {
    {{NONE, NONE, 3600, NONE, NONE, NONE, 1, NONE, NONE, NONE},
     ERROR_USAGE,
     "give number of shots, clip length, or event length with interval or exposure time"},
    {{100, 5, 3600, NONE, NONE, NONE, 1, NONE, NONE, NONE},
     ERROR_DOMAIN,
     "100 shots at interval 5 s take 500 s: that is not the event length"},
    {{NONE, 5, 3600, 30, 30, NONE, 1, NONE, NONE, NONE},
     ERROR_DOMAIN,
     "720 shots at frame rate 30 fps make a clip of 24 s: that is not clip length 30 s"},
    {{10, 5, NONE, NONE, NONE, 4.5, 1, NONE, NONE, NONE},
     ERROR_DOMAIN,
     "exposure time 4.5 s and gap 1 s do not fit into the interval 5 s: it must be at least 5.5 s"},
    {{2.5, NONE, NONE, NONE, NONE, NONE, 1, NONE, NONE, NONE},
     ERROR_DOMAIN,
     "number of shots 2.5 must be a whole number, 1 to 1e+09"},
    {{NONE, 10, 5, NONE, NONE, NONE, 1, NONE, NONE, NONE},
     ERROR_DOMAIN,
     "interval 10 s is longer than the event length"},
    {{NONE, NONE, 60, NONE, NONE, 9, 1, 0.1, NONE, NONE},
     ERROR_USAGE,
     "give only one of event length and star angle"},
    {{NONE, NONE, NONE, NONE, NONE, NONE, 1, 0.1, NONE, NONE},
     ERROR_USAGE,
     "star angle needs exposure time"},
    {{9, NONE, NONE, NONE, NONE, NONE, 1, NONE, NONE, 1e9}, ERROR_USAGE, "card needs frame size"},
    {{9, NONE, NONE, NONE, NONE, NONE, 1, NONE, 2e9, 1e9},
     ERROR_DOMAIN,
     "frame size 2000000000 B is larger than the card, 1000000000 B"},
    {{NONE, 1e-6, 1e6, NONE, NONE, NONE, 1, NONE, NONE, NONE},
     ERROR_DOMAIN,
     "1e+12 shots are out of range: 1 to 1e+09"},
    {{NONE, 0, 60, NONE, NONE, NONE, 1, NONE, NONE, NONE},
     ERROR_DOMAIN,
     "interval 0 s must be above 0 and finite"},
    {{1, NONE, NONE, NONE, NONE, 30, 1, 0.1, NONE, NONE},
     ERROR_DOMAIN,
     "1 shots at interval 31 s take 31 s: that is not the star angle"},
};

static void test_refusals(void)
{
    for (size_t i = 0; i < sizeof refusals / sizeof refusals[0]; i++) {
        struct error error = {.code = ERROR_NONE};
        struct timelapse plan;
        CHECK(!timelapse_solve(&refusals[i].given, &plan, &error));
        CHECK(error.code == refusals[i].code);
        CHECK_TEXT(error.message, refusals[i].message);
    }
}

int main(void)
{
    test_plans();
    test_star_angle();
    test_storage();
    test_shutter();
    test_refusals();
    return check_report();
}
