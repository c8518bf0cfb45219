/* tests/unit/test_visual.c - telescopes and binoculars. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "check.h"
#include "photo/visual.h"

#include <math.h>
#include <string.h>

static struct error error;

static const double degree = RADIANS_PER_DEGREE, arcsec = RADIANS_PER_DEGREE / 3600;

static struct visual_setting visual_of(double focal, double diameter, double fnumber,
                                       double eyepiece)
{
    return (struct visual_setting){focal, diameter, fnumber, 1, eyepiece, NAN, NAN};
}

static void test_solve(void)
{
    struct visual_setting s = visual_of(1200, 200, NAN, 25);
    s.barlow = 2;
    CHECK(visual_solve(&s, &error));
    CHECK_NEAR(s.power, 96, 1e-12, "1200/25 twice");
    CHECK_NEAR(s.exit_pupil, 200.0 / 96, 1e-12, "diameter over power");
    CHECK_NEAR(s.fnumber, 6, 1e-12, "1200/200");
    s = visual_of(NAN, 200, 6, NAN);
    s.exit_pupil = 2;
    CHECK(visual_solve(&s, &error));
    CHECK_NEAR(s.focal, 1200, 1e-12, "200 mm at f/6");
    CHECK_NEAR(s.power, 100, 1e-12, "200 mm over 2 mm");
    CHECK_NEAR(s.eyepiece, 12, 1e-12, "exit pupil times f-number");
    s = visual_of(NAN, 42, NAN, NAN);
    s.power = 10;
    CHECK(visual_solve(&s, &error));
    CHECK_NEAR(s.exit_pupil, 4.2, 1e-12, "backcountrychronicles.com: 10 x 42 has 4.2");
    CHECK(isnan(s.focal) && isnan(s.eyepiece));
    s = visual_of(1200, NAN, NAN, 25);
    s.exit_pupil = 4;
    CHECK(visual_solve(&s, &error));
    CHECK_NEAR(s.diameter, 192, 1e-12, "48 times the exit pupil");
    CHECK_NEAR(s.fnumber, 6.25, 1e-12, "1200/192");
    s = visual_of(NAN, 200, NAN, 25);
    s.barlow = 2;
    s.power = 96;
    CHECK(visual_solve(&s, &error));
    CHECK_NEAR(s.focal, 1200, 1e-12, "96 x 25/2");
    s = visual_of(1219, 203.2, 6, NAN);
    CHECK(visual_solve(&s, &error));
    s = visual_of(1200, 200, 5, NAN);
    CHECK(!visual_solve(&s, &error));
    CHECK(strstr(error.message, "contradict each other") != NULL);
    s = visual_of(1200, -1, NAN, NAN);
    CHECK(!visual_solve(&s, &error));
}

static void test_fields(void)
{
    static const struct {
        double power, field, apparent, width; /* deg, m at 1000 m */
        double tolerance;
        const char *source;
    } binoculars[] = {
        {8, 8.8, 63.2, NAN, 0.05, "imaging.nikon.com: 8x, 8.8 deg, ISO 14132-1: 63.2 deg"},
        {8, 7, 52.1, 122, 0.06, "Nikon 8x42, 7.0 deg: 52.1 deg, 122 m"},
    };
    for (size_t i = 0; i < sizeof binoculars / sizeof binoculars[0]; i++) {
        struct visual_field field = {NAN,  NAN, binoculars[i].field * degree, NAN, NAN, NAN,
                                     NULL, NULL};
        CHECK(visual_see(NAN, binoculars[i].power, &field, &error));
        CHECK_NEAR(field.apparent / degree, binoculars[i].apparent, binoculars[i].tolerance,
                   binoculars[i].source);
        CHECK_NEAR(field.apparent_by_ratio / degree, binoculars[i].power * binoculars[i].field,
                   1e-12, "the rule before the standard");
        CHECK_TEXT(field.apparent_from, "tangents");
    }
    struct visual_field field = {27, 68 * degree, NAN, NAN, NAN, NAN, NULL, NULL};
    CHECK(visual_see(1200, 50, &field, &error));
    CHECK_NEAR(field.true_field / degree, 57.3 * 27 / 1200, 1e-3,
               "televue.com: field stop over focal length x 57.3");
    CHECK_NEAR(field.true_by_ratio / degree, 1.36, 1e-12, "68 deg over 50");
    CHECK_NEAR(tan(field.true_by_tangent / 2) * 50, tan(34 * degree), 1e-12, "tangents, by hand");
    CHECK_TEXT(field.true_from, "field-stop");
    CHECK_TEXT(field.apparent_from, "option");
    field = (struct visual_field){NAN, 68 * degree, NAN, NAN, NAN, NAN, NULL, NULL};
    CHECK(visual_see(1200, 50, &field, &error));
    CHECK_NEAR(field.true_field / degree, 1.36, 1e-12, "without a field stop by the ratio");
    CHECK_TEXT(field.true_from, "ratio");
    CHECK(isnan(field.apparent_by_ratio));
    field = (struct visual_field){NAN, 63.2 * degree, NAN, NAN, NAN, NAN, NULL, NULL};
    CHECK(visual_see(NAN, 8, &field, &error));
    CHECK_NEAR(field.true_field / degree, 8.8, 0.01, "binoculars by the tangents, Nikon backwards");
    CHECK_TEXT(field.true_from, "tangents");
    field = (struct visual_field){NAN, PI, NAN, NAN, NAN, NAN, NULL, NULL};
    CHECK(!visual_see(NAN, 8, &field, &error));
}

static void test_light(void)
{
    const struct visual_eye eye = {7, 6};
    struct visual_setting s = visual_of(1000, 70, NAN, 10);
    struct visual_light light;
    CHECK(visual_solve(&s, &error));
    CHECK(visual_gather(&s, &eye, 0, 0.55, &light, &error));
    CHECK_NEAR(light.gain, 100, 1e-10, "ten times the diameter of the eye");
    CHECK_NEAR(light.magnitude, 11, 1e-12, "a factor of 100 is 5 magnitudes");
    CHECK_NEAR(light.lowest, 10, 1e-12, "70/7");
    CHECK_NEAR(light.highest, 140, 1e-12, "2 for each mm");
    CHECK_NEAR(light.dawes / arcsec, 116.0 / 70, 1e-9, "Dawes: 116 arcsec over mm");
    CHECK_NEAR(light.rayleigh / arcsec, 138.37 / 70, 1e-3, "1.21967 x 0.00055 rad over mm");
    CHECK_NEAR(light.matched * light.rayleigh / arcsec, 60, 1e-9, "1 arcmin");
    CHECK(visual_gather(&s, &eye, 0.5, 0.55, &light, &error));
    CHECK_NEAR(light.gain, 75, 1e-10, "half the diameter shades a quarter of the area");
    CHECK_NEAR(light.rayleigh / arcsec, 138.37 / 70, 1e-3, "and leaves the resolution");
    /* an exit pupil wider than the eye's: 7 mm of 14 */
    s = visual_of(NAN, 70, NAN, NAN);
    s.power = 5;
    CHECK(visual_solve(&s, &error));
    CHECK(visual_gather(&s, &eye, 0, 0.55, &light, &error));
    CHECK_NEAR(light.used_diameter, 35, 1e-12, "5 x 7 mm");
    CHECK_NEAR(light.gain, 25, 1e-12, "so much more light");
    CHECK_NEAR(light.dawes / arcsec, 116.0 / 35, 1e-9, "Dawes of what is used");
    CHECK_NEAR(light.rayleigh / arcsec, 138.37 / 35, 1e-3, "and Rayleigh");
    CHECK_NEAR(light.matched, 60 * 70 / 138.37, 1e-3, "the power at which all of it is used");
    CHECK(!visual_gather(&s, &eye, 0.6, 0.55, &light, &error));
    CHECK(strstr(error.message, "shades all") != NULL);
    /* each number that cannot be, by itself */
    CHECK(!visual_gather(&s, &(struct visual_eye){.pupil = -1}, 0, 0.55, &light, &error));
    CHECK(strstr(error.message, "pupil of the eye") != NULL);
    CHECK(!visual_gather(&s, &eye, -0.1, 0.55, &light, &error));
    CHECK(strstr(error.message, "obstruction") != NULL);
    CHECK(!visual_gather(&s, &eye, 1.1, 0.55, &light, &error));
    CHECK(!visual_gather(&s, &eye, 0, -0.55, &light, &error));
    s = visual_of(NAN, 50, NAN, NAN);
    s.power = 10;
    CHECK(visual_solve(&s, &error));
    CHECK(visual_gather(&s, &eye, 0, 0.55, &light, &error));
    CHECK_NEAR(light.twilight, 22.36, 5e-3, "heritagedestination.com: 10 x 50 has 22.36");
    CHECK_NEAR(light.brightness, 25, 1e-12, "backcountrychronicles.com: 10 x 50 has 25.0");
    s = visual_of(1000, NAN, NAN, 10);
    CHECK(visual_solve(&s, &error));
    CHECK(!visual_gather(&s, &eye, 0, 0.55, &light, &error));
}

static void test_lengths(void)
{
    CHECK_NEAR(visual_filter_shift(3, 1.5), 1, 1e-12, "a third of the thickness for n = 1.5");
    /* a thin eyepiece: 1/v = 1/f_e - 1/(f + f_e), from the lens */
    CHECK_NEAR(visual_eye_relief(1000, 25, 25), 1 / (1 / 25.0 - 1 / 1025.0), 1e-12,
               "image of an aperture 1025 mm before a thin lens");
}

static void test_camera(void)
{
    struct visual_camera camera;
    struct visual_camera_given given = {1000, NAN, 10, 100, 100, NAN};
    CHECK(visual_photograph(&given, &camera, &error));
    CHECK_RELATIVE(camera.focal, 9000.0, 1e-15, "astroleague.org: 100 mm behind 10 mm, 100/10 - 1");
    CHECK(isnan(camera.fnumber));
    given = (struct visual_camera_given){1000, 125, 25, 40, NAN, 50};
    CHECK(visual_photograph(&given, &camera, &error));
    CHECK_RELATIVE(camera.focal, 2000.0, 1e-15, "40 times 50 mm");
    CHECK_RELATIVE(camera.fnumber, 16.0, 1e-15, "over 125 mm");
    CHECK_RELATIVE(camera.factor, 2.0, 1e-15, "50 by 25");
    given = (struct visual_camera_given){1000, 125, 25, 40, 25, NAN};
    CHECK(!visual_photograph(&given, &camera, &error));
    given.eyepiece = NAN;
    CHECK(!visual_photograph(&given, &camera, &error));
    CHECK_RELATIVE(visual_pupil_place(250, 25), 27.5, 1e-15, "1/(1/25 - 1/275)");
    CHECK_RELATIVE(visual_pupil_place(300, -50), -125 / 3.0, 1e-15, "1/(-1/50 - 1/250)");
}

int main(void)
{
    test_camera();
    test_solve();
    test_fields();
    test_light();
    test_lengths();
    return check_report();
}
