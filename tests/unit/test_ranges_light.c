/* tests/unit/test_ranges_light.c - legal ranges of exposure, losses, brackets, flash, film. */
/* SPDX-License-Identifier: MIT */
#include <stddef.h>

#include "base/constants.h"
#include "photo/bracket.h"
#include "photo/exposure.h"
#include "photo/flash.h"
#include "photo/sensitometry.h"
#include "photo/stops.h"
#include "ranges.h"

static const double pi = PI;

/* What is not named is not given: named members override the NaNs. */
#pragma GCC diagnostic ignored "-Woverride-init"
#define GIVEN(...)                                                                                 \
    (&(struct exposure_given){.N = NAN,                                                            \
                              .t = NAN,                                                            \
                              .S = NAN,                                                            \
                              .ev100 = NAN,                                                        \
                              .ev = NAN,                                                           \
                              .L = NAN,                                                            \
                              .E = NAN,                                                            \
                              .K = NAN,                                                            \
                              .C = NAN,                                                            \
                              .loss = NAN,                                                         \
                              .compensation = NAN,                                                 \
                              __VA_ARGS__})
#define LOSS(...)                                                                                  \
    (&(struct light_loss){.density = NAN,                                                          \
                          .factor = NAN,                                                           \
                          .stops = NAN,                                                            \
                          .transmittance = NAN,                                                    \
                          .m = NAN,                                                                \
                          .P = NAN,                                                                \
                          __VA_ARGS__})

static void test_exposure(void)
{
    struct exposure x;
    INSIDE(exposure_solve(GIVEN(.N = 8, .t = 0.5, .ev100 = 100), &x, &error));
    INSIDE(exposure_solve(GIVEN(.N = 8, .t = 0.5, .ev100 = -100), &x, &error));
    OUTSIDE(exposure_solve(GIVEN(.N = 8, .t = 0.5, .ev100 = 100.5), &x, &error),
            "exposure value at ISO 100 100.5 lies outside -100 to 100");
    OUTSIDE(exposure_solve(GIVEN(.N = 8, .t = 0.5, .ev100 = -100.5), &x, &error),
            "exposure value at ISO 100 -100.5 lies outside -100 to 100");
    INSIDE(exposure_solve(GIVEN(.N = 8, .S = 100, .ev = 100), &x, &error));
    INSIDE(exposure_solve(GIVEN(.N = 8, .S = 100, .ev = -100), &x, &error));
    OUTSIDE(exposure_solve(GIVEN(.N = 8, .S = 100, .ev = 100.5), &x, &error),
            "exposure value at the ISO speed 100.5 lies outside -100 to 100");
    OUTSIDE(exposure_solve(GIVEN(.N = 8, .S = 100, .ev = -100.5), &x, &error),
            "exposure value at the ISO speed -100.5 lies outside -100 to 100");
    INSIDE(exposure_solve(GIVEN(.N = 8, .t = 1, .loss = 200), &x, &error));
    INSIDE(exposure_solve(GIVEN(.N = 8, .t = 1, .loss = -0.3), &x, &error));
    OUTSIDE(exposure_solve(GIVEN(.N = 8, .t = 1, .loss = 200.5), &x, &error),
            "light loss 200.5 stops lies outside -0.322 to 200 stops");
    OUTSIDE(exposure_solve(GIVEN(.N = 8, .t = 1, .loss = -0.5), &x, &error),
            "light loss -0.5 stops lies outside -0.322 to 200 stops");
    INSIDE(exposure_solve(GIVEN(.N = 8, .t = 1, .compensation = 100), &x, &error));
    INSIDE(exposure_solve(GIVEN(.N = 8, .t = 1, .compensation = -100), &x, &error));
    OUTSIDE(exposure_solve(GIVEN(.N = 8, .t = 1, .compensation = 100.5), &x, &error),
            "exposure compensation 100.5 stops lies outside -100 to 100 stops");
    OUTSIDE(exposure_solve(GIVEN(.N = 8, .t = 1, .compensation = -100.5), &x, &error),
            "exposure compensation -100.5 stops lies outside -100 to 100 stops");
    /* each positive number: far below 1 is legal, 0 is not */
    INSIDE(exposure_solve(GIVEN(.N = 0.001, .t = 0.001, .S = 0.001), &x, &error));
    INSIDE(exposure_solve(GIVEN(.N = 0.001, .L = 0.001, .K = 0.001), &x, &error));
    INSIDE(exposure_solve(GIVEN(.N = 0.001, .E = 0.001, .C = 0.001), &x, &error));
    OUTSIDE(exposure_solve(GIVEN(.N = 0, .t = 1), &x, &error),
            "f-number 0 must be above 0 and finite");
    OUTSIDE(exposure_solve(GIVEN(.N = 8, .t = 0), &x, &error),
            "exposure time 0 s must be above 0 and finite");
    OUTSIDE(exposure_solve(GIVEN(.N = 8, .t = 1, .S = 0), &x, &error),
            "ISO speed 0 must be above 0 and finite");
    OUTSIDE(exposure_solve(GIVEN(.N = 8, .L = 0), &x, &error),
            "luminance 0 cd/m^2 must be above 0 and finite");
    OUTSIDE(exposure_solve(GIVEN(.N = 8, .E = 0), &x, &error),
            "illuminance 0 lx must be above 0 and finite");
    OUTSIDE(exposure_solve(GIVEN(.N = 8, .t = 1, .K = 0), &x, &error),
            "meter constant K 0 must be above 0 and finite");
    OUTSIDE(exposure_solve(GIVEN(.N = 8, .t = 1, .C = INFINITY), &x, &error),
            "meter constant C inf must be above 0 and finite");
}

/* Two lights at once that differ are refused, whichever they are. */
static void test_lights(void)
{
    const struct exposure_given *pairs[] = {
        GIVEN(.N = 8, .ev100 = 5, .ev = 6), GIVEN(.N = 8, .ev100 = 5, .L = 5),
        GIVEN(.N = 8, .ev100 = 5, .E = 5),  GIVEN(.N = 8, .ev = 5, .L = 5),
        GIVEN(.N = 8, .ev = 5, .E = 5),     GIVEN(.N = 8, .L = 5, .E = 5)};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        struct exposure x;
        double stops = 0;
        MISUSED(exposure_solve(pairs[i], &x, &error),
                "give only one of exposure value at ISO 100, exposure value at the ISO speed, "
                "luminance and illuminance");
        MISUSED(exposure_deviation(pairs[i], &stops, &error),
                "give only one of exposure value at ISO 100, exposure value at the ISO speed, "
                "luminance and illuminance");
    }
}

static void test_exposure_parts(void)
{
    double stops = 0;
    struct equivalent_exposure line;
    struct camera_setting good = {0.001, 0.001, 0.001};
    INSIDE(exposure_deviation(GIVEN(.N = 0.001, .t = 0.001, .ev100 = 5), &stops, &error));
    MISUSED(exposure_deviation(GIVEN(.t = 1, .ev100 = 5), &stops, &error), "f-number is missing");
    MISUSED(exposure_deviation(GIVEN(.N = 8, .ev100 = 5), &stops, &error),
            "exposure time is missing");
    OUTSIDE(exposure_deviation(GIVEN(.N = 8, .t = 1, .ev100 = 101), &stops, &error),
            "exposure value at ISO 100 101 lies outside -100 to 100");
    MISUSED(exposure_deviation(GIVEN(.N = 8, .t = 1), &stops, &error),
            "give the light: scene, exposure value at ISO 100, exposure value at the ISO speed, "
            "luminance "
            "or illuminance");
    INSIDE(exposure_stops(&good, &good, &stops, &error));
    OUTSIDE(exposure_stops(&(struct camera_setting){0, 1, 1}, &good, &stops, &error),
            "f-number 0 must be above 0 and finite");
    OUTSIDE(exposure_stops(&good, &(struct camera_setting){1, 0, 1}, &stops, &error),
            "exposure time 0 s must be above 0 and finite");
    OUTSIDE(exposure_stops(&good, &(struct camera_setting){1, 1, 0}, &stops, &error),
            "ISO speed 0 must be above 0 and finite");
    INSIDE(exposure_equivalent(100, 0.001, 1, &line, &error));
    INSIDE(exposure_equivalent(-100, 0.001, 12, &line, &error));
    OUTSIDE(exposure_equivalent(100.5, 1, 1, &line, &error),
            "exposure value at ISO 100 100.5 lies outside -100 to 100");
    OUTSIDE(exposure_equivalent(-100.5, 1, 1, &line, &error),
            "exposure value at ISO 100 -100.5 lies outside -100 to 100");
    OUTSIDE(exposure_equivalent(5, 0, 1, &line, &error), "f-number 0 must be above 0 and finite");
    OUTSIDE(exposure_equivalent(5, 1, 0, &line, &error),
            "steps of the series 0 steps a stop lies outside 1 to 12 steps a stop");
    OUTSIDE(exposure_equivalent(5, 1, 13, &line, &error),
            "steps of the series 13 steps a stop lies outside 1 to 12 steps a stop");
    /* whose square no number holds */
    struct exposure x;
    OUTSIDE(exposure_solve(GIVEN(.N = 1e160, .ev100 = 0), &x, &error),
            "f-number 1e+160 is out of range: 1e-30 to 1e+30");
}

/* Losses of one and two kinds; log2 of exact powers. */
static void test_losses(void)
{
    double stops = 0;
    INSIDE(light_loss(LOSS(.stops = 100), &stops, &error));
    CHECK_NEAR(stops, 100, 0, "as given");
    OUTSIDE(light_loss(LOSS(.stops = 100.5), &stops, &error),
            "light loss 100.5 stops lies outside 0 to 100 stops");
    OUTSIDE(light_loss(LOSS(.stops = -0.5), &stops, &error),
            "light loss -0.5 stops lies outside 0 to 100 stops");
    INSIDE(light_loss(LOSS(.density = 30), &stops, &error));
    CHECK_NEAR(stops, 99.65784284662087, 1e-13, "30/log10(2)");
    OUTSIDE(light_loss(LOSS(.density = 30.5), &stops, &error), "density 30.5 lies outside 0 to 30");
    OUTSIDE(light_loss(LOSS(.density = -0.5), &stops, &error), "density -0.5 lies outside 0 to 30");
    INSIDE(light_loss(LOSS(.factor = 1e30), &stops, &error));
    INSIDE(light_loss(LOSS(.factor = 1), &stops, &error));
    CHECK_NEAR(stops, 0, 0, "a factor of 1 takes nothing");
    OUTSIDE(light_loss(LOSS(.factor = 1.5e30), &stops, &error),
            "filter factor 1.5e+30 lies outside 1 to 1e+30");
    OUTSIDE(light_loss(LOSS(.factor = 0.5), &stops, &error),
            "filter factor 0.5 lies outside 1 to 1e+30");
    INSIDE(light_loss(LOSS(.transmittance = 1), &stops, &error));
    INSIDE(light_loss(LOSS(.transmittance = 0x1p-20), &stops, &error));
    CHECK_NEAR(stops, 20, 1e-14, "one in 2^20");
    OUTSIDE(light_loss(LOSS(.transmittance = 1.5), &stops, &error),
            "transmittance 1.5 must lie above 0 and up to 1.25");
    OUTSIDE(light_loss(LOSS(.transmittance = 0), &stops, &error),
            "transmittance 0 must lie above 0 and up to 1.25");
    INSIDE(light_loss(LOSS(.m = 0), &stops, &error));
    CHECK_NEAR(stops, 0, 0, "no extension");
    INSIDE(light_loss(LOSS(.m = 0.25, .P = 0.25), &stops, &error));
    CHECK_NEAR(stops, 2, 1e-15, "(1 + m/P)^2 = 4");
    OUTSIDE(light_loss(LOSS(.m = -0.5), &stops, &error),
            "magnification -0.5 must be 0 or more and finite");
    OUTSIDE(light_loss(LOSS(.m = 1, .P = 0), &stops, &error),
            "pupil magnification 0 must be above 0 and finite");
}

static void test_lens(void)
{
    double x = 0;
    INSIDE(t_stop(0.5, 1, &x, &error));
    CHECK_NEAR(x, 0.5, 0, "all light passes");
    INSIDE(t_stop(0.5, 0.0625, &x, &error));
    CHECK_NEAR(x, 2, 1e-15, "N/sqrt(1/16)");
    OUTSIDE(t_stop(0, 0.5, &x, &error), "f-number 0 must be above 0 and finite");
    OUTSIDE(t_stop(2, 1.5, &x, &error), "transmittance 1.5 must lie above 0 and up to 1.25");
    INSIDE(transmittance_from_t_stop(0.5, 0.5, &x, &error));
    CHECK_NEAR(x, 1, 0, "T is N");
    INSIDE(transmittance_from_t_stop(0.5, 2, &x, &error));
    CHECK_NEAR(x, 0.0625, 0, "(N/T)^2");
    OUTSIDE(transmittance_from_t_stop(0, 2, &x, &error), "f-number 0 must be above 0 and finite");
    OUTSIDE(transmittance_from_t_stop(2, 0, &x, &error), "T-stop 0 must be above 0 and finite");
    OUTSIDE(transmittance_from_t_stop(2, 1.75, &x, &error),
            "T-stop 1.75 must not lie below the f-number 2");
}

static void test_shutter(void)
{
    struct shutter whole = {2 * pi, 24, NAN}, third = {NAN, 24, 1.0 / 24},
                   small = {0.001, 0.5, NAN};
    INSIDE(shutter_solve(&whole, &error));
    CHECK_RELATIVE(whole.t, 1.0 / 24, 1e-15, "360 deg is the whole frame");
    INSIDE(shutter_solve(&third, &error));
    INSIDE(shutter_solve(&small, &error));
    CHECK_RELATIVE(small.t, 3.18309886183790672e-4, 1e-15, "1e-3/pi");
    struct shutter edge = {2 * pi * (1 + 5e-13), 24, NAN}, over = {2 * pi * (1 + 1.5e-12), 24, NAN},
                   wide = {2.5 * pi, 24, NAN}, zero = {0, 24, NAN}, stopped = {1, 0, NAN},
                   instant = {1, NAN, 0}, all = {1, 24, 0.01};
    INSIDE(shutter_solve(&edge, &error));
    CHECK(!shutter_solve(&over, &error) && error.code == ERROR_DOMAIN);
    OUTSIDE(shutter_solve(&wide, &error),
            "a shutter angle of 450 deg exceeds 360 deg: the exposure "
            "is longer than the frame");
    OUTSIDE(shutter_solve(&zero, &error), "shutter angle 0 rad must be above 0 and finite");
    OUTSIDE(shutter_solve(&stopped, &error), "frame rate 0 fps must be above 0 and finite");
    OUTSIDE(shutter_solve(&instant, &error), "exposure time 0 s must be above 0 and finite");
    MISUSED(shutter_solve(&all, &error),
            "give exactly two of shutter angle, frame rate and exposure time");
}

static void test_sensor(void)
{
    double q = 0, H = 0;
    INSIDE(lens_q(1, 1, 0, &q, &error));
    CHECK_RELATIVE(q, pi / 4, 1e-15, "no loss at all");
    INSIDE(lens_q(1e-9, 1e-9, 0.5, &q, &error));
    CHECK_RELATIVE(q, 4.6584541048719195e-19, 1e-14, "pi/4 1e-18 cos^4 0.5");
    INSIDE(lens_q(1, 1, pi / 2 * (1 - 1e-12), &q, &error));
    OUTSIDE(lens_q(1.5, 1, 0, &q, &error), "transmittance 1.5 must lie above 0 and up to 1.25");
    OUTSIDE(lens_q(0, 1, 0, &q, &error), "transmittance 0 must lie above 0 and up to 1.25");
    OUTSIDE(lens_q(1, 1.5, 0, &q, &error), "vignetting 1.5 must lie above 0 and up to 1");
    OUTSIDE(lens_q(1, 0, 0, &q, &error), "vignetting 0 must lie above 0 and up to 1");
    OUTSIDE(lens_q(1, 1, pi / 2, &q, &error), "field angle 90 deg must lie from 0 to below 90 deg");
    OUTSIDE(lens_q(1, 1, -pi / 4, &q, &error),
            "field angle -45 deg must lie from 0 to below 90 deg");
    INSIDE(focal_plane_exposure(pi / 4, 0.5, 0.5, 0.25, 200, &H, &error));
    CHECK_RELATIVE(H, ldexp(pi / 8, -200), 1e-15, "q L t/N^2 2^-loss");
    INSIDE(focal_plane_exposure(0.001, 0.5, 0.5, 0.25, 0, &H, &error));
    OUTSIDE(focal_plane_exposure(0, 1, 8, 1, 0, &H, &error),
            "q 0 must lie above 0 and up to 0.9817");
    OUTSIDE(focal_plane_exposure(0.99, 1, 8, 1, 0, &H, &error),
            "q 0.99 must lie above 0 and up to 0.9817");
    OUTSIDE(focal_plane_exposure(0.5, 0, 8, 1, 0, &H, &error),
            "luminance 0 cd/m^2 must be above 0 and finite");
    OUTSIDE(focal_plane_exposure(0.5, 1, 0, 1, 0, &H, &error),
            "f-number 0 must be above 0 and finite");
    OUTSIDE(focal_plane_exposure(0.5, 1, 8, 0, 0, &H, &error),
            "exposure time 0 s must be above 0 and finite");
    OUTSIDE(focal_plane_exposure(0.5, 1, 8, 1, -0.5, &H, &error),
            "light loss -0.5 stops lies outside -0.322 to 200 stops");
    OUTSIDE(focal_plane_exposure(0.5, 1, 8, 1, 200.5, &H, &error),
            "light loss 200.5 stops lies outside -0.322 to 200 stops");
}

static bool plan_of(double from, double to, double step, double shots, struct bracket *plan)
{
    const struct bracket_given given = {from, to, step, shots};
    return bracket_plan(&given, plan, &error);
}

static void test_bracket(void)
{
    struct bracket plan;
    struct bracket_range range;
    int shots = 0;
    INSIDE(plan_of(2, 1, NAN, BRACKET_SHOTS, &plan));
    CHECK(plan.shots == 1000);
    OUTSIDE(plan_of(2, 1, NAN, 1001, &plan), "1001 shots lie outside 1 to 1000");
    OUTSIDE(plan_of(2, 1, NAN, 0.5, &plan), "0.5 shots lie outside 1 to 1000");
    OUTSIDE(plan_of(2, 1, NAN, 2.5, &plan), "number of shots 2.5 must be a whole number");
    OUTSIDE(plan_of(2, 1, NAN, 2.75, &plan), "number of shots 2.75 must be a whole number");
    INSIDE(plan_of(0.5, NAN, 0.5, 1, &plan));
    CHECK_NEAR(plan.total, 0.5, 1e-16, "one shot");
    INSIDE(plan_of(0.25, 0.25, NAN, 1, &plan));
    CHECK_NEAR(plan.step, 0, 0, "one shot has no step");
    CHECK_NEAR(plan.total, 0.25, 0, "one shot");
    INSIDE(plan_of(0.25, 0.25, NAN, 3, &plan));
    CHECK_NEAR(plan.total, 0.75, 0, "the same three times");
    INSIDE(plan_of(1, 0.25, NAN, 2, &plan));
    CHECK_NEAR(plan.step, 2, 0, "two shots reach both ends in one step");
    CHECK_NEAR(plan.total, 1.25, 1e-15, "the sum");
    OUTSIDE(plan_of(2, 0.5, NAN, 1, &plan), "one shot cannot reach from 2 s to 0.5 s");
    OUTSIDE(plan_of(0, 1, 1, NAN, &plan), "time at one end 0 s must be above 0 and finite");
    OUTSIDE(plan_of(1, 0, 1, NAN, &plan), "time at the other end 0 s must be above 0 and finite");
    OUTSIDE(plan_of(1, 2, 0, NAN, &plan), "step 0 stops must be above 0 and finite");
    OUTSIDE(plan_of(1, 2, NAN, -1, &plan), "number of shots -1 must be above 0 and finite");
    MISUSED(
        plan_of(1, 2, 1, 2, &plan),
        "time at one end, time at the other end, step and number of shots are all given: leave out "
        "one, it follows from the others");
    MISUSED(plan_of(NAN, NAN, 1, 5, &plan),
            "a bracket needs an exposure to start from: give time at one end or time at the other "
            "end");
    MISUSED(
        plan_of(1, NAN, 1, NAN, &plan),
        "give exactly three of time at one end, time at the other end, step and number of shots");
    INSIDE(bracket_around(0.001, 0.001, 1, &plan, &error));
    OUTSIDE(bracket_around(0, 1, 3, &plan, &error), "exposure time 0 s must be above 0 and finite");
    OUTSIDE(bracket_around(1, 0, 3, &plan, &error), "step 0 stops must be above 0 and finite");
    INSIDE(bracket_covers(&plan, 0.001, &range, &error));
    OUTSIDE(bracket_covers(&plan, 0, &range, &error),
            "range of a shot 0 stops must be above 0 and finite");
    INSIDE(bracket_shots_needed(0.5, 0.5, 0.5, &shots, &error));
    CHECK(shots == 1);
    INSIDE(bracket_shots_needed(1.5, 0.5, 0.5, &shots, &error));
    CHECK(shots == 3);
    INSIDE(bracket_shots_needed(2 + 0.5e-9, 1, 1, &shots, &error));
    CHECK(shots == 2);
    INSIDE(bracket_shots_needed(2 + 1.5e-9, 1, 1, &shots, &error));
    CHECK(shots == 3);
    OUTSIDE(bracket_shots_needed(0, 1, 1, &shots, &error),
            "scene range 0 stops must be above 0 and finite");
    OUTSIDE(bracket_shots_needed(5, 0, 1, &shots, &error),
            "range of a shot 0 stops must be above 0 and finite");
    OUTSIDE(bracket_shots_needed(5, 1, 0, &shots, &error),
            "step 0 stops must be above 0 and finite");
    OUTSIDE(bracket_shots_needed(5, 1, 1.5, &shots, &error),
            "step 1.5 stops leaves gaps between shots of 1 stops each");
    OUTSIDE(bracket_shots_needed(1001, 1, 1, &shots, &error), "1001 shots lie outside 1 to 1000");
    INSIDE(bracket_shots_needed(1000, 1, 1, &shots, &error));
}

#define FLASH(...)                                                                                 \
    (&(struct flash_setting){.GN = NAN,                                                            \
                             .N = NAN,                                                             \
                             .d = NAN,                                                             \
                             .S = NAN,                                                             \
                             .power = NAN,                                                         \
                             .flashes = NAN,                                                       \
                             .loss = NAN,                                                          \
                             __VA_ARGS__})

static void test_flash(void)
{
    enum flash_unknown unknown;
    double x = 0;
    INSIDE(
        flash_solve(FLASH(.GN = 0.5, .N = 0.5, .S = 0.5, .power = 0.5, .flashes = 0.5, .loss = 100),
                    &unknown, &error));
    INSIDE(flash_solve(FLASH(.GN = 0.5, .N = 0.5, .power = 1, .loss = 0), &unknown, &error));
    INSIDE(flash_solve(FLASH(.GN = 9, .N = 8, .d = 0.001), &unknown, &error));
    OUTSIDE(flash_solve(FLASH(.GN = 0, .N = 8), &unknown, &error),
            "guide number 0 mm must be above 0 and finite");
    OUTSIDE(flash_solve(FLASH(.GN = 9, .N = 0), &unknown, &error),
            "f-number 0 must be above 0 and finite");
    OUTSIDE(flash_solve(FLASH(.GN = 9, .d = 0), &unknown, &error),
            "distance 0 mm must be above 0 and finite");
    OUTSIDE(flash_solve(FLASH(.GN = 9, .N = 8, .S = 0), &unknown, &error),
            "ISO speed 0 must be above 0 and finite");
    OUTSIDE(flash_solve(FLASH(.GN = 9, .N = 8, .power = 0), &unknown, &error),
            "flash power 0 must be above 0 and finite");
    OUTSIDE(flash_solve(FLASH(.GN = 9, .N = 8, .flashes = 0), &unknown, &error),
            "number of flashes 0 must be above 0 and finite");
    OUTSIDE(flash_solve(FLASH(.GN = 9, .N = 8, .power = 1.25), &unknown, &error),
            "flash power 1.25 must lie above 0 and up to 1");
    OUTSIDE(flash_solve(FLASH(.GN = 9, .N = 8, .loss = 100.5), &unknown, &error),
            "light loss 100.5 stops lies outside 0 to 100 stops");
    OUTSIDE(flash_solve(FLASH(.GN = 9, .N = 8, .loss = -0.5), &unknown, &error),
            "light loss -0.5 stops lies outside 0 to 100 stops");
    MISUSED(flash_solve(FLASH(.GN = 9), &unknown, &error),
            "too little is given: of guide number, f-number and distance two are needed");
    OUTSIDE(flash_solve(FLASH(.GN = 1, .N = 2, .d = 2), &unknown, &error),
            "the flash would need 16 times its full power: it is 4 stops too weak");
    INSIDE(flash_solve(FLASH(.GN = 4, .N = 2, .d = 2), &unknown, &error));
    struct flash_setting many = *FLASH(.GN = 10, .N = 4, .d = 5, .S = 200, .power = 0.5, .loss = 1);
    INSIDE(flash_solve(&many, &unknown, &error));
    CHECK(unknown == FLASH_FLASHES);
    CHECK_RELATIVE(many.flashes, 8.0, 1e-15, "(N d/GN)^2 2^loss/(power S/100)");
    struct flash_setting speed =
        *FLASH(.GN = 10, .N = 4, .d = 5, .power = 0.5, .flashes = 4, .loss = 1);
    INSIDE(flash_solve(&speed, &unknown, &error));
    CHECK_RELATIVE(speed.S, 400.0, 1e-15, "100 (N d/GN)^2 2^loss/(flashes power)");
    INSIDE(flash_sum((double[]){0.003, 0.004}, 2, &x, &error));
    CHECK_RELATIVE(x, 0.005, 1e-15, "root of the sum of squares");
    OUTSIDE(flash_sum((double[]){1, 0}, 2, &x, &error),
            "guide number 0 mm must be above 0 and finite");
    MISUSED(flash_sum(NULL, 0, &x, &error), "guide number is missing");
    INSIDE(flash_bounce(0, 0.1, 0.2, &x, &error));
    CHECK_NEAR(x, 0.3, 1e-16, "up and down");
    OUTSIDE(flash_bounce(-1, 1, 1, &x, &error), "distance -1 mm must be 0 or more and finite");
    OUTSIDE(flash_bounce(1, 0, 1, &x, &error),
            "ceiling over the flash 0 mm must be above 0 and finite");
    OUTSIDE(flash_bounce(1, 1, 0, &x, &error),
            "ceiling over the subject 0 mm must be above 0 and finite");
    INSIDE(flash_falloff(0.25, 0.5, &x, &error));
    CHECK_NEAR(x, 2, 0, "twice as far");
    OUTSIDE(flash_falloff(0, 1, &x, &error), "nearest point 0 mm must be above 0 and finite");
    OUTSIDE(flash_falloff(1, 0, &x, &error), "farthest point 0 mm must be above 0 and finite");
}

static void test_light_ratios(void)
{
    double x = 0;
    INSIDE(lighting_ratio(-100, &x, &error));
    INSIDE(lighting_ratio(100, &x, &error));
    CHECK_RELATIVE(x, 0x1p100, 1e-15, "2^100 + 1");
    OUTSIDE(lighting_ratio(100.5, &x, &error),
            "key to fill 100.5 stops lies outside -100 to 100 stops");
    OUTSIDE(lighting_ratio(-100.5, &x, &error),
            "key to fill -100.5 stops lies outside -100 to 100 stops");
    INSIDE(lighting_stops(1.5, &x, &error));
    CHECK_NEAR(x, -1, 0, "log2(ratio - 1)");
    OUTSIDE(lighting_stops(1, &x, &error), "lighting ratio 1 must be above 1 and finite");
    OUTSIDE(lighting_stops(INFINITY, &x, &error), "lighting ratio inf must be above 1 and finite");
}

/* 1/4 power twice at ISO 200 through a stop: (GN/(N d))^2 1/4 2 2 1/2 = 1/2 of (5/4)^2. */
static void test_ambient(void)
{
    const struct flash_ambient good = {{10, 4, 2, 200, 0.25, 2, 1}, 0.5, 0.25, 5};
    struct flash_ambient light = good;
    struct flash_balance b;
    INSIDE(flash_against_ambient(&light, &b, &error));
    double flash = 2 * log2(1.25) - 1, ambient = 5 + 1 - 5;
    CHECK_NEAR(b.flash, flash, 1e-15, "of the flash");
    CHECK_NEAR(b.ambient, ambient, 1e-15, "EV 5, a stop by ISO 200, f/4 1/2 s is EV 5");
    CHECK_NEAR(b.flash_to_ambient, flash - ambient, 1e-15, "their difference");
    CHECK_RELATIVE(b.ratio, 1 + 0.78125 / 2, 1e-15, "to the ambient alone");
    CHECK_NEAR(b.total, log2(0.78125 + 2), 1e-15, "both");
    light.ev100 = 3;
    INSIDE(flash_against_ambient(&light, &b, &error));
    CHECK_NEAR(b.total, log2(0.78125 + 0.5), 1e-15, "the flash leads");
    light.t = light.sync = 0.25;
    INSIDE(flash_against_ambient(&light, &b, &error));
    light.sync = 0.5;
    OUTSIDE(flash_against_ambient(&light, &b, &error),
            "exposure time 0.25 s is shorter than the flash sync time 0.5 s");
    light.sync = 0;
    OUTSIDE(flash_against_ambient(&light, &b, &error),
            "flash sync time 0 s must be above 0 and finite");
    light = good;
    light.ev100 = 100;
    INSIDE(flash_against_ambient(&light, &b, &error));
    light.ev100 = -100;
    INSIDE(flash_against_ambient(&light, &b, &error));
    light.ev100 = 100.5;
    OUTSIDE(flash_against_ambient(&light, &b, &error),
            "exposure value at ISO 100 100.5 lies outside -100 to 100");
    light.ev100 = -100.5;
    OUTSIDE(flash_against_ambient(&light, &b, &error),
            "exposure value at ISO 100 -100.5 lies outside -100 to 100");
    static const struct {
        size_t at;
        const char *option;
    } members[] = {{offsetof(struct flash_ambient, flash.GN), "guide number"},
                   {offsetof(struct flash_ambient, flash.N), "f-number"},
                   {offsetof(struct flash_ambient, flash.d), "distance"},
                   {offsetof(struct flash_ambient, flash.S), "ISO speed"},
                   {offsetof(struct flash_ambient, flash.power), "flash power"},
                   {offsetof(struct flash_ambient, flash.flashes), "number of flashes"},
                   {offsetof(struct flash_ambient, t), "exposure time"}};
    for (size_t i = 0; i < sizeof members / sizeof *members; i++) {
        char message[80];
        light = good;
        memcpy((char *)&light + members[i].at, &(double){NAN}, sizeof(double));
        snprintf(message, sizeof message, "%s is missing", members[i].option);
        MISUSED(flash_against_ambient(&light, &b, &error), message);
    }
}

int main(void)
{
    test_exposure();
    test_lights();
    test_exposure_parts();
    test_losses();
    test_lens();
    test_shutter();
    test_sensor();
    test_bracket();
    test_flash();
    test_light_ratios();
    test_ambient();
    return check_report();
}
