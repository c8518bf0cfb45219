/* tests/unit/test_fov.c - field of view, projections, formats and circles of confusion. */
/* SPDX-License-Identifier: MIT */
#include <float.h>

#include "base/constants.h"
#include "check.h"
#include "photo/fov.h"

#define DEGREE RADIANS_PER_DEGREE

static const struct sensor full_frame = {36, 24, NAN};

static struct fov view(enum projection projection, double f, double s, double P, double squeeze)
{
    struct fov_setting a = {projection, f, s, P, squeeze};
    struct error error;
    struct fov fov = {0};
    CHECK(fov_compute(&a, &full_frame, &fov, &error));
    return fov;
}

/* 36 x 24 mm at 50 mm: 46.8, 39.6, 27.0 deg, the lecture's numbers (CS348B lecture 7). */
static void test_published(void)
{
    struct fov fov = view(RECTILINEAR, 50, INFINITY, 1, 1);
    check_source("lecture", "deg");
    CHECK_NEAR(fov.diagonal / DEGREE, 46.8, 0.05, "50 mm: diagonal angle");
    CHECK_NEAR(fov.horizontal / DEGREE, 39.6, 0.05, "50 mm: horizontal angle");
    CHECK_NEAR(fov.vertical / DEGREE, 27.0, 0.05, "50 mm: vertical angle");
    check_source(NULL, "");
    CHECK(fov.width_at_s == INFINITY);
    /* the lecture's normal lens: half angle 26.57 deg, tan = 1/2, full 53.13 deg */
    double angle;
    struct error error;
    CHECK(fov_angle(RECTILINEAR, 50, 50, &angle, &error));
    CHECK_NEAR(angle / DEGREE, 53.13010235415598, 1e-12, "film as long as f"); /* 2 atan(1/2) */
}

/* Classes of CS348B lecture 7 for lenses on 36 x 24 mm. */
static void test_kinds(void)
{
    CHECK_TEXT(view(RECTILINEAR, 200, INFINITY, 1, 1).kind, "narrow");
    CHECK_TEXT(view(RECTILINEAR, 85, INFINITY, 1, 1).kind, "medium");
    CHECK_TEXT(view(RECTILINEAR, 50, INFINITY, 1, 1).kind, "normal");
    CHECK_TEXT(view(RECTILINEAR, 28, INFINITY, 1, 1).kind, "wide");
    CHECK_TEXT(view(RECTILINEAR, 16, INFINITY, 1, 1).kind, "ultra-wide");
    CHECK_TEXT(fov_kind(19.9 * DEGREE), "narrow");
    CHECK_TEXT(fov_kind(20.1 * DEGREE), "medium");
    CHECK_TEXT(fov_kind(39.9 * DEGREE), "medium");
    CHECK_TEXT(fov_kind(40.1 * DEGREE), "normal");
    CHECK_TEXT(fov_kind(60.1 * DEGREE), "wide");
    CHECK_TEXT(fov_kind(90.1 * DEGREE), "ultra-wide");
}

/* Angles whose image height is known by heart, f = 10. */
static bool focal_length(enum projection projection, double s, double P, double dimension,
                         double angle, double *f)
{
    struct error error;
    const struct fov_setting setting = {.projection = projection, .s = s, .P = P};
    return fov_focal_length(&setting, dimension, angle, f, &error);
}

static void test_projections(void)
{
    static const struct {
        enum projection projection;
        double dimension, degrees;
        const char *source;
    } cases[] = {
        {RECTILINEAR, 20, 90, "tan 45 = 1"},
        {EQUIDISTANT, 31.415926535897932, 180, "f pi/2"},
        {EQUIDISTANT, 62.831853071795862, 360, "f pi, rounded down"},
        {EQUISOLID, 28.284271247461902, 180, "2 f sin 45"},
        {EQUISOLID, 20, 120, "2 f sin 30"},
        {EQUISOLID, 40, 360, "2 f sin 90"},
        {STEREOGRAPHIC, 40, 180, "2 f tan 45"},
        {STEREOGRAPHIC, 69.282032302755091, 240, "2 f tan 60"},
        {ORTHOGRAPHIC, 10, 60, "f sin 30"},
        {ORTHOGRAPHIC, 20, 180, "f sin 90"},
        {RECTILINEAR, 2e-9, 1e-10 * 2 / DEGREE, "small angle"},
    };
    struct error error;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        double angle = 0, f = 0;
        CHECK(fov_angle(cases[i].projection, 10, cases[i].dimension, &angle, &error));
        CHECK_RELATIVE(angle / DEGREE, cases[i].degrees, 8 * DBL_EPSILON, cases[i].source);
        CHECK(focal_length(cases[i].projection, INFINITY, 1, cases[i].dimension, angle, &f));
        CHECK_RELATIVE(f, 10.0, 16 * DBL_EPSILON, cases[i].source);
    }
    double angle;
    CHECK(!fov_angle(ORTHOGRAPHIC, 10, 20.001, &angle, &error));
    CHECK(!fov_angle(EQUISOLID, 10, 40.001, &angle, &error));
    CHECK(!fov_angle(EQUIDISTANT, 10, 62.84, &angle, &error));
    CHECK(fov_angle(STEREOGRAPHIC, 10, 1e6, &angle, &error) && angle < 360 * DEGREE);
    CHECK(!fov_angle(RECTILINEAR, NAN, 20, &angle, &error));
    CHECK(!fov_angle(RECTILINEAR, 10, 0, &angle, &error));
}

/* Breathing: at 1:1 and P = 1 the scale is 2 f; the field is as large as the sensor. */
/* Heights of 60 deg are those of half an angle of view of 120 deg; where each projection ends. */
static void test_heights(void)
{
    static const struct {
        enum projection projection;
        double at_60, last; /* r/f'; deg */
        bool is_reached;
    } cases[] = {
        {RECTILINEAR, 1.7320508075688772, 90, false},
        {EQUIDISTANT, 1.0471975511965976, 180, true},
        {EQUISOLID, 1, 180, true},
        {STEREOGRAPHIC, 1.1547005383792515, 180, false},
        {ORTHOGRAPHIC, 0.86602540378443865, 90, true},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct error error = {0};
        double height = NAN, last = cases[i].last * RADIANS_PER_DEGREE;
        CHECK(fov_height(cases[i].projection, 60 * RADIANS_PER_DEGREE, &height, &error));
        CHECK_RELATIVE(height, cases[i].at_60, 4e-16, projections[cases[i].projection].word);
        CHECK(fov_height(cases[i].projection, last, &height, &error) == cases[i].is_reached);
        CHECK(!fov_height(cases[i].projection, last * 1.000001, &height, &error));
        CHECK(error.code == ERROR_DOMAIN);
        CHECK(!fov_height(cases[i].projection, NAN, &height, &error));
        CHECK(fov_height(cases[i].projection, 0, &height, &error) && !(height > 0));
    }
}

static void test_breathing(void)
{
    struct fov fov = view(RECTILINEAR, 50, 100, 1, 1);
    CHECK_RELATIVE(fov.horizontal, 2 * atan(18. / 100), 4 * DBL_EPSILON, "angle at 1:1");
    CHECK_RELATIVE(fov.width_at_s, 36.0, 4 * DBL_EPSILON, "field at 1:1");
    CHECK_RELATIVE(fov.height_at_s, 24.0, 4 * DBL_EPSILON, "field at 1:1");
    fov = view(RECTILINEAR, 50, 100, 0.5, 1);
    CHECK_RELATIVE(fov.horizontal, 2 * atan(18. / 150), 4 * DBL_EPSILON, "angle, P = 0.5");
    /* seen from the entrance pupil, X = f(1/m + 1/P) = 150 mm before the plane */
    CHECK_RELATIVE(tan(fov.horizontal / 2), fov.width_at_s / 2 / 150, 8 * DBL_EPSILON, "pupil");
    fov = view(RECTILINEAR, 50, INFINITY, 1, 2);
    CHECK_RELATIVE(fov.horizontal, 2 * atan(36. / 50), 4 * DBL_EPSILON, "squeezed");
    CHECK_RELATIVE(fov.vertical, 2 * atan(12. / 50), 4 * DBL_EPSILON, "not squeezed");
    CHECK(isnan(view(EQUISOLID, 16, 1000, 1, 1).width_at_s));
}

/* A wanted angle or width, put back. */
static void test_inverse(void)
{
    static const double distance[] = {100, 300, 5000, 1e9, INFINITY};
    static const double pupil[] = {0.2, 0.5, 1, 2, 5};
    struct error error;
    for (int projection = 0; projection < PROJECTIONS; projection++) {
        for (int i = 0; i < 25; i++) {
            double s = distance[i / 5], P = pupil[i % 5], f = 0, wanted = 55 * DEGREE;
            CHECK(focal_length((enum projection)projection, s, P, 36, wanted, &f));
            CHECK(f < s);
            struct fov fov = view((enum projection)projection, f, s, P, 1);
            CHECK_RELATIVE(fov.horizontal, wanted, 64 * DBL_EPSILON, "angle put back");
        }
    }
    double f = 0;
    CHECK(fov_focal_length_for_field(36, 1200, 3000, &f, &error));
    CHECK_RELATIVE(view(RECTILINEAR, f, 3000, 1, 1).width_at_s, 1200.0, 1e-13, "field put back");
    CHECK(!focal_length(RECTILINEAR, INFINITY, 1, 36, 180 * DEGREE, &f));
    CHECK(!focal_length(ORTHOGRAPHIC, INFINITY, 1, 36, 181 * DEGREE, &f));
    CHECK(!focal_length(EQUIDISTANT, INFINITY, 1, 36, 361 * DEGREE, &f));
    CHECK(!focal_length(RECTILINEAR, INFINITY, 1, 36, NAN, &f));
    CHECK(!focal_length(RECTILINEAR, 0, 1, 36, 1, &f));
    CHECK(!fov_focal_length_for_field(36, 1200, INFINITY, &f, &error));
    struct fov_setting a = {RECTILINEAR, 50, 40, 1, 1};
    struct fov fov;
    CHECK(!fov_compute(&a, &full_frame, &fov, &error));
    CHECK_TEXT(error.message, "distance 40 mm lies within the focal length 50 mm: no real image");
}

static double resolved(struct coc coc, struct sensor sensor)
{
    struct error error;
    double c = NAN;
    CHECK(coc_resolve(&coc, &sensor, &c, &error));
    return c;
}

static void test_format(void)
{
    CHECK_RELATIVE(sensor_diagonal(&full_frame), 43.266615305567871, 2 * DBL_EPSILON, "12 sqrt 13");
    CHECK(sensor_crop(&full_frame) == 1);
    CHECK_RELATIVE(sensor_pitch_of(&full_frame, 24e6), 0.006, 1e-15, "6000 x 4000 pixels");
    struct sensor small = {18, 12, 0.004};
    CHECK_RELATIVE(sensor_crop(&small), 2.0, 2 * DBL_EPSILON, "half the size");
    CHECK_NEAR(resolved(coc_default, full_frame), 0.028844, 1e-6, "43.2666/1500");
    CHECK_NEAR(resolved((struct coc){.kind = COC_DIAGONAL, .value = 1730}, full_frame), 0.0250,
               5e-5, "d/1730");
    CHECK(resolved((struct coc){.kind = COC_LENGTH, .value = 0.03}, full_frame) == 0.03);
    CHECK_RELATIVE(resolved((struct coc){.kind = COC_PIXELS, .value = 2}, small), 0.008, 1e-15,
                   "two pixels");
    /* 5 lp/mm at 25 cm, 360 mm print of 36 mm: enlarged 10 times, 0.02 mm; twice from 50 cm */
    struct coc print = {.kind = COC_PRINT, .viewing = 250, .acuity = 5, .print = 360};
    CHECK_RELATIVE(resolved(print, full_frame), 0.02, 4 * DBL_EPSILON, "print");
    print.viewing = 500;
    CHECK_RELATIVE(resolved(print, full_frame), 0.04, 4 * DBL_EPSILON, "print from 50 cm");
    struct sensor tall = {24, 36, NAN};
    CHECK_RELATIVE(resolved(print, tall), 0.04, 4 * DBL_EPSILON, "long side of a tall picture");

    /* A2 is 594 x 420 mm: 36 x 24 enlarged 16.5 times, not 17.5, to fit on it; 4:3 by height */
    print = (struct coc){
        .kind = COC_PRINT, .viewing = 250, .acuity = 5, .print = 594, .print_short = 420};
    CHECK_RELATIVE(resolved(print, full_frame), 0.2 / 16.5, 4 * DBL_EPSILON, "A2, width");
    CHECK_RELATIVE(resolved(print, (struct sensor){17.3, 13, NAN}), 0.2 / (420 / 13.0),
                   4 * DBL_EPSILON, "A2, height");
    CHECK_RELATIVE(resolved(print, tall), 0.2 / 16.5, 4 * DBL_EPSILON, "A2 upright");

    /* the lecture's slide: f/64 at 0.5 um has the Airy radius 1.22 x 64 x 0.5 um = 0.03904 mm */
    struct coc airy = {.kind = COC_AIRY, .wavelength = 500e-6, .fnumber = 64};
    CHECK_NEAR(resolved(airy, full_frame), 2 * 0.03904, 3e-5, "Airy disc");

    const struct coc bad[] = {
        {.kind = COC_LENGTH, .value = -1},
        {.kind = COC_DIAGONAL, .value = 0},
        {.kind = COC_PIXELS, .value = 2},
        {.kind = COC_PRINT, .viewing = 250, .acuity = 0, .print = 360},
        {.kind = COC_PRINT, .viewing = 0, .acuity = 5, .print = 360},
        {.kind = COC_LENGTH, .value = NAN},
        {.kind = COC_AIRY, .wavelength = 500e-6, .fnumber = 0},
        {.kind = COC_AIRY, .wavelength = 0, .fnumber = 8},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        struct error error;
        double c;
        CHECK(!coc_resolve(&bad[i], &full_frame, &c, &error));
    }
    struct sensor flat = {36, 0, NAN};
    struct error error;
    CHECK(!sensor_check(&flat, &error));
}

static void test_ground(void)
{
    struct error error;
    const struct fov_setting drone = {RECTILINEAR, 8.8, INFINITY, 1, 1};
    const struct sensor inch = {13.2, 8.8, NAN};
    struct fov fov;
    CHECK(fov_compute(&drone, &inch, &fov, &error));
    struct fov_ground ground = {100e3, NAN, NAN, NAN};
    CHECK(fov_ground(&drone, &fov, 0.00241, &ground, &error));
    CHECK_NEAR(ground.sample, 1e5 / 3650.0, 0.02,
               "pix4d.com: altitude in m over 36.5 is the sample in cm (8.8 mm, 13.2 mm, 5472 px)");
    CHECK_RELATIVE(ground.width, 150e3, 1e-14, "100 m x 13.2/8.8");
    CHECK_RELATIVE(ground.height, 100e3, 1e-14, "100 m x 8.8/8.8");
    ground = (struct fov_ground){NAN, 20, NAN, NAN};
    CHECK(fov_ground(&drone, &fov, 0.0022, &ground, &error));
    CHECK_RELATIVE(ground.altitude, 80e3, 1e-14, "20 mm x 8.8/0.0022");
    /* focused at 3 f, m = 1/2: the picture is larger by 1.5, a pixel sees less by as much */
    const struct fov_setting near = {RECTILINEAR, 100, 300, 1, 1};
    CHECK(fov_compute(&near, &inch, &fov, &error));
    ground = (struct fov_ground){3000, NAN, NAN, NAN};
    CHECK(fov_ground(&near, &fov, 0.005, &ground, &error));
    CHECK_RELATIVE(ground.sample, 0.1, 1e-14, "3000 x 0.005/150");
    ground = (struct fov_ground){3000, NAN, NAN, NAN};
    CHECK(fov_ground(&near, &fov, NAN, &ground, &error));
    CHECK(isnan(ground.sample) && ground.width > 0);
    ground = (struct fov_ground){NAN, 10, NAN, NAN};
    CHECK(!fov_ground(&near, &fov, NAN, &ground, &error));
    CHECK_TEXT(error.message, "ground sample needs pixel pitch");
    ground = (struct fov_ground){1000, 10, NAN, NAN};
    CHECK(!fov_ground(&near, &fov, 0.005, &ground, &error));
    CHECK_TEXT(error.message, "give one of altitude and ground sample");
    fov.horizontal = 3.5; /* a fisheye sees beyond the horizon */
    ground = (struct fov_ground){1000, NAN, NAN, NAN};
    CHECK(fov_ground(&near, &fov, 0.005, &ground, &error) && isinf(ground.width));
}

int main(void)
{
    test_ground();
    test_published();
    test_kinds();
    test_projections();
    test_heights();
    test_breathing();
    test_inverse();
    test_format();
    return check_report();
}
