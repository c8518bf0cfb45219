/* tests/unit/test_survey.c - surveys from the air, and projectors. */
/* SPDX-License-Identifier: MIT */
#include <float.h>

#include "base/constants.h"
#include "check.h"
#include "photo/fov.h"
#include "photo/projector.h"
#include "photo/survey.h"

#define FOOT   304.8
#define FOOT_L 3.4262590996353905 /* cd/m2, 1/pi cd/ft2 */
#define NOTHING                                                                                    \
    {                                                                                              \
        NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN                                                \
    }

static struct fov_ground ground_of(double f, const struct sensor *sensor, struct fov_ground ground)
{
    const struct fov_setting lens = {RECTILINEAR, f, INFINITY, 1, 1};
    struct error error;
    struct fov fov;
    CHECK(fov_compute(&lens, sensor, &fov, &error));
    CHECK(fov_ground(&lens, &fov, sensor->pitch, &ground, &error));
    return ground;
}

/* PIX4Dmapper, article 202557469, and its calculator sheet. */
static void test_ground(void)
{
    const struct sensor small = {6.17, 4.63, 6.17 / 4000}, canon = {13.125, 9.84375, 13.125 / 4608};
    check_source("pix4d", "m");
    CHECK_NEAR(ground_of(5, &small, (struct fov_ground){NAN, 50, NAN, NAN}).altitude / 1000, 162.07,
               0.005, "5 cm with 5 mm: altitude");
    const struct fov_ground below =
        ground_of(15.4, &canon, (struct fov_ground){100000, NAN, NAN, NAN});
    CHECK_NEAR(below.width / 1000, 85, 0.5, "15.4 mm at 100 m: ground width");
    CHECK_NEAR(below.height / 1000, 64, 0.5, "15.4 mm at 100 m: ground height");
    check_source("pix4d", "cm");
    CHECK_NEAR(below.sample / 10, 1.85, 0.005, "15.4 mm at 100 m: ground sample");
    check_source(NULL, "");
}

static void test_flight(void)
{
    struct error error;
    struct survey_plan plan;
    /* engineered.at, overlap of aerial photos: 48.9 deg, 80 %, 50 m: 9.09 m from one to the next */
    struct survey_flight a = NOTHING;
    a.along = 2 * 50000 * tan(48.9 / 2 * RADIANS_PER_DEGREE);
    a.overlap = 0.8;
    check_source("pix4d", "m");
    CHECK(survey_solve(&a, &plan, &error));
    CHECK_NEAR(plan.base / 1000, 9.09, 0.005, "48.9 deg at 50 m: photo spacing");
    check_source(NULL, "");
    CHECK(isnan(plan.speed) && isnan(plan.interval) && isnan(plan.spacing));

    a = (struct survey_flight){100e3, 150e3, 20, 0.75, 0.6, 10e3, NAN, 0.5, 0.004};
    CHECK(survey_solve(&a, &plan, &error));
    CHECK_RELATIVE(plan.base, 25e3, 1e-15, "a quarter of 100 m");
    CHECK_RELATIVE(plan.spacing, 60e3, 1e-15, "two fifths of 150 m");
    CHECK_RELATIVE(plan.interval, 2.5, 1e-15, "25 m at 10 m/s");
    CHECK_RELATIVE(plan.longest, 0.001, 1e-15, "half of 2 cm at 10 m/s");
    CHECK_RELATIVE(plan.moved, 2.0, 1e-15, "4 cm by 2 cm");
    a.speed = NAN;
    a.interval = 5;
    CHECK(survey_solve(&a, &plan, &error));
    CHECK_RELATIVE(plan.speed, 5e3, 1e-15, "25 m in 5 s");
    CHECK_RELATIVE(plan.longest, 0.002, 1e-15, "half of 2 cm at 5 m/s");
    a.speed = 1;
    CHECK(!survey_solve(&a, &plan, &error));
    CHECK_TEXT(error.message, "give one of speed and interval: overlap gives the other");
    a.speed = a.overlap = NAN;
    CHECK(!survey_solve(&a, &plan, &error));
    CHECK_TEXT(error.message, "interval needs overlap");
    a.interval = NAN;
    CHECK(survey_solve(&a, &plan, &error));
    CHECK_RELATIVE(plan.speed, 2.5e3, 1e-15, "half of 2 cm in 1/250 s");
    CHECK_RELATIVE(plan.moved, 0.5, 1e-15, "at which the time is the longest");
    CHECK(isnan(plan.interval));
    a.time = NAN;
    a.overlap = 1;
    CHECK(!survey_solve(&a, &plan, &error));
}

/* A projector of which nothing is known but the shape of its image. */
static struct projector blank(void)
{
    return (struct projector){NAN, NAN, 16 / 9.0, NAN, NAN, NAN, 1, NAN, NAN, NAN};
}

static void test_throw(void)
{
    struct error error;
    struct projector a = blank();
    a.throw_ratio = 1.5;
    a.diagonal = sqrt(337) * 100; /* 1600 x 900 mm */
    CHECK(projector_solve(&a, &error));
    CHECK_RELATIVE(a.width, 1600.0, 4 * DBL_EPSILON, "16 of 16:9");
    CHECK_RELATIVE(a.height, 900.0, 4 * DBL_EPSILON, "9 of 16:9");
    CHECK_RELATIVE(a.distance, 2400.0, 4 * DBL_EPSILON, "R W");
    CHECK(isnan(a.luminance) && isnan(a.flux));
    a = blank();
    a.throw_ratio = 2;
    a.distance = 3200;
    CHECK(projector_solve(&a, &error));
    CHECK_RELATIVE(a.width, 1600.0, 4 * DBL_EPSILON, "D/R");
    a = blank();
    a.distance = 3200;
    a.height = 900;
    CHECK(projector_solve(&a, &error));
    CHECK_RELATIVE(a.throw_ratio, 2.0, 4 * DBL_EPSILON, "D/W");
    CHECK_RELATIVE(a.diagonal, sqrt(337) * 100, 4 * DBL_EPSILON, "Pythagoras");
    a.throw_ratio = NAN;
    CHECK(!projector_solve(&a, &error));
    a = blank();
    /* either of the two beside a brightness: 1.44 m2 of 100 lx are 144 lm */
    a.flux = 144;
    a.illuminance = 100;
    a.throw_ratio = 2;
    CHECK(projector_solve(&a, &error));
    CHECK_RELATIVE(a.width, 1600.0, 4 * DBL_EPSILON, "by its light");
    CHECK_RELATIVE(a.distance, 3200.0, 4 * DBL_EPSILON, "R W");
    a = blank();
    a.flux = 144;
    a.illuminance = 100;
    a.distance = 3200;
    CHECK(projector_solve(&a, &error));
    CHECK_RELATIVE(a.width, 1600.0, 4 * DBL_EPSILON, "by its light");
    CHECK_RELATIVE(a.throw_ratio, 2.0, 4 * DBL_EPSILON, "D/W");
    a = blank();
    a.throw_ratio = 2;
    CHECK(!projector_solve(&a, &error));
    a.distance = a.width = 1;
    CHECK(!projector_solve(&a, &error));
    CHECK_TEXT(error.message, "image size, throw ratio and distance: two of them give the third, "
                              "leave one out");
    a.throw_ratio = NAN;
    a.distance = -1;
    CHECK(!projector_solve(&a, &error));
}

static void test_brightness(void)
{
    struct error error;
    struct projector a = blank();
    /* htrgroup.com, sufficient brightness: 1000 lm on 6 ft of 16:9 are 49.4 fL */
    check_source("projectors", "fL");
    a.width = 6 * FOOT;
    a.flux = 1000;
    CHECK(projector_solve(&a, &error));
    CHECK_NEAR(a.luminance / FOOT_L, 49.4, 0.05, "1000 lm on 6 ft: luminance");
    /* calculatorlib.com: 2000 lm on 8 x 4.5 ft are 55.56 fL, 190.33 nits */
    a = blank();
    a.width = 8 * FOOT;
    a.flux = 2000;
    CHECK(projector_solve(&a, &error));
    CHECK_NEAR(a.luminance / FOOT_L, 55.56, 0.005, "2000 lm on 8 ft: luminance");
    check_source("projectors", "cd/m2");
    CHECK_NEAR(a.luminance, 190.33, 0.05, "2000 lm on 8 ft: luminance");
    /* htrgroup.com: 16 fL of 1000 lm want about 10.5 ft */
    check_source("projectors", "ft");
    a = blank();
    a.luminance = 16 * FOOT_L;
    a.flux = 1000;
    CHECK(projector_solve(&a, &error));
    CHECK_NEAR(a.width / FOOT, 10.5, 0.05, "16 fL of 1000 lm: image width");
    check_source(NULL, "");
    a = blank();
    a.aspect = 1.5;
    a.width = 3000;
    a.illuminance = 500;
    a.gain = 1.3;
    CHECK(projector_solve(&a, &error));
    CHECK_RELATIVE(a.flux, 3000.0, 4 * DBL_EPSILON, "500 lx on 6 m2");
    CHECK_RELATIVE(a.luminance, 650 / PI, 4 * DBL_EPSILON, "G E/pi");
    a.flux = a.illuminance = a.height = a.diagonal = NAN;
    CHECK(projector_solve(&a, &error));
    CHECK_RELATIVE(a.flux, 3000.0, 8 * DBL_EPSILON, "of that luminance on 6 m2");
    a = blank();
    a.width = 3000;
    a.luminance = a.illuminance = 9;
    CHECK(!projector_solve(&a, &error));
    a.illuminance = NAN;
    a.flux = 100;
    CHECK(!projector_solve(&a, &error));
    CHECK_TEXT(error.message, "image size, luminous flux and brightness: two of them give the "
                              "third, leave one out");
    a.luminance = NAN;
    a.height = 9;
    CHECK(!projector_solve(&a, &error));
}

int main(void)
{
    test_ground();
    test_flight();
    test_throw();
    test_brightness();
    return check_report();
}
