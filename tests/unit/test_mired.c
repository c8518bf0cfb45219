/* tests/unit/test_mired.c - conversion filters, and shutters under lamps on the mains. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "check.h"
#include "photo/flicker.h"
#include "photo/mired.h"

static struct error error;

/* Nikon's manuals of the Z 9 and D6, White Balance: 1000 K at 4000 K are 83 mired, at 7000 K 24. */
static void test_mired(void)
{
    static const struct {
        double from, to, shift;
        const char *source;
    } shifts[] = {
        {4000, 3000, 83, "Nikon: 4000 K - 3000 K"},
        {7000, 6000, 24, "Nikon: 7000 K - 6000 K"},
        {3200, 5500, -131, "80A: tungsten light for daylight film"},
        {3400, 5500, -112, "80B"},
        {3800, 5500, -81, "80C"},
        {4200, 5500, -56, "80D"},
        {5500, 3200, 131, "85B: daylight for film of type B"},
        {5500, 3400, 112, "85"},
        {5500, 3800, 81, "85C"},
        {2800, 3200, -45, "82C"},
        {3400, 3200, 18, "81A"},
    };
    for (size_t i = 0; i < sizeof shifts / sizeof shifts[0]; i++) {
        double shift, back;
        CHECK(mired_shift(shifts[i].from, shifts[i].to, &shift, &error));
        CHECK_NEAR(shift, shifts[i].shift, 0.51, shifts[i].source);
        CHECK(mired_filtered(shifts[i].from, shift, &back, &error));
        CHECK_RELATIVE(back, shifts[i].to, 1e-14, shifts[i].source);
    }
    /* 5500 K behind an 85B: what Wien's law has at both temperatures, over the same at 555 nm */
    CHECK_RELATIVE(mired_transmittance(131, 0.45), 0.4527535029620536, 1e-7, "blue");
    CHECK_RELATIVE(mired_transmittance(131, 0.65), 1.642703113628989, 1e-7, "red");
    CHECK_NEAR(mired_transmittance(-131, 0.555), 1, 0, "555 nm");
    double x;
    CHECK(!mired_shift(100, 5500, &x, &error));
    CHECK_TEXT(error.message, "colour temperature 100 K lies outside 500 to 100000 K");
    CHECK(!mired_shift(5500, 1e6, &x, &error));
    CHECK(mired_filtered(10000, -99, &x, &error)); /* 1 of 100 mired is left */
    CHECK_RELATIVE(x, 1e6, 1e-12, "1 mired");
    CHECK(!mired_filtered(10000, -100, &x, &error));
    CHECK(!mired_filtered(10000, -131, &x, &error));
    CHECK(strstr(error.message, "bluer than any") != NULL);
}

static void test_flicker(void)
{
    struct flicker f;
    CHECK(flicker_check(50, 1 / 50.0, 24, &f, &error));
    CHECK(f.is_free && !f.is_steady && f.longest == 4);
    CHECK_RELATIVE(flicker_angle(50, 24, 2), 172.8 * RADIANS_PER_DEGREE, 1e-14,
                   "172.8 deg at 24 fps under 50 Hz");
    CHECK_RELATIVE(flicker_angle(60, 24, 2), 144.0 * RADIANS_PER_DEGREE, 1e-14,
                   "144 deg at 24 fps under 60 Hz");
    for (long n = 1; n <= 4; n++) {
        CHECK_RELATIVE(flicker_angle(60, 25, n), 75.0 * (double)n * RADIANS_PER_DEGREE, 1e-14,
                       "tumgag.com, flicker free equation: 75, 150, 225, 300 deg at 25 fps");
    }
    CHECK(flicker_check(60, NAN, 25, &f, &error));
    CHECK(f.longest == 4 && isnan(f.nearest) && !f.is_steady && !f.is_free);
    /* 180 deg at 24 fps under 50 Hz: 2.083 pulses */
    CHECK(flicker_check(50, 1 / 48.0, 24, &f, &error));
    CHECK(!f.is_free);
    CHECK_RELATIVE(f.pulses, 100 / 48.0, 1e-15, "2 x 50 Hz/48");
    CHECK_RELATIVE(f.nearest, 0.02, 1e-15, "1/50 s");
    /* cinematography.com topic 13437: any number that divides evenly into 2 x 60 Hz */
    static const double rates[] = {1, 2, 3, 4, 5, 6, 8, 10, 12, 15, 20, 24, 30, 40, 60};
    for (size_t i = 0; i < sizeof rates / sizeof rates[0]; i++) {
        CHECK(flicker_check(60, 1 / 300.0, rates[i], &f, &error));
        CHECK(f.is_steady && !f.is_free);
    }
    CHECK(flicker_check(60, 1 / 48.0, 25, &f, &error) && !f.is_steady);
    CHECK(flicker_check(50, 1 / 500.0, 240, &f, &error));
    CHECK(f.longest == 0 && isnan(f.nearest) && !f.is_steady && !f.is_free);
    CHECK(flicker_check(50, 1 / 500.0, NAN, &f, &error));
    CHECK_RELATIVE(f.nearest, 0.01, 1e-15, "a picture: one pulse at least");
    CHECK(flicker_check(60, 1 / 125.0, NAN, &f, &error) && !f.is_free);
    CHECK(flicker_check(60, 1 / 60.0, NAN, &f, &error) && f.is_free);
    CHECK(!flicker_check(0, 1, NAN, &f, &error));
    CHECK_TEXT(error.message, "mains frequency 0 Hz must be above 0 and finite");
}

int main(void)
{
    test_mired();
    test_flicker();
    return check_report();
}
