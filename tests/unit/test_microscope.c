/* tests/unit/test_microscope.c - microscopes. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "photo/microscope.h"

#include <math.h>
#include <string.h>

static struct error error;

static struct microscope_setting objective(double magnification, double na, double index)
{
    return (struct microscope_setting){magnification, na, index, NAN, 0.55, 10, 22, 1, NAN};
}

static void test_resolution(void)
{
    struct microscope_setting s = objective(40, 0.65, 1);
    struct microscope found;
    CHECK(microscope_compute(&s, &found, &error));
    CHECK_NEAR(found.abbe * 1000, 0.423, 5e-4, "0.55/(2 x 0.65) um, by hand");
    CHECK_NEAR(found.rayleigh * 1000, 0.61 * 0.55 / 0.65, 3e-4, "0.61 l/NA");
    CHECK_NEAR(found.sparrow * 1000, 0.47 * 0.55 / 0.65, 4e-3, "0.47 l/NA");
    CHECK_NEAR(found.field, 0.55, 1e-12, "22/40 mm");
    CHECK_NEAR(found.power, 400, 1e-12, "40 x 10");
    CHECK_NEAR(found.exit_pupil, 0.8125, 1e-12, "500 x 0.65/400 mm");
    CHECK_NEAR(found.working_fnumber, 40 / 1.3, 1e-12, "M/(2 NA)");
    CHECK_NEAR(found.lowest_power, 325, 1e-12, "leica-microsystems.com: 500 NA");
    CHECK_NEAR(found.highest_power, 650, 1e-12, "leica-microsystems.com: 1000 NA");
    CHECK(isnan(found.pixel));
    s.condenser = 0.35;
    CHECK(microscope_compute(&s, &found, &error));
    CHECK_NEAR(found.rayleigh * 1000, 1.22 * 0.55, 3e-4, "1.22 l/(NA + NA_c), their sum 1");
    CHECK_NEAR(found.sparrow * 1000, 0.947 * 0.55, 3e-4, "0.947 l/(NA + NA_c)");
    s.condenser = 0.9;
    CHECK(microscope_compute(&s, &found, &error));
    CHECK_NEAR(found.abbe * 1000, 0.423, 5e-4, "a larger condenser adds nothing");
}

static void test_depth(void)
{
    static const struct {
        double na, um, tolerance;
    } waves[] = {
        /* photomacrography.net, R. Littlefield: l/NA^2 at 550 nm */
        {0.10, 55.0, 0.05},  {0.14, 28.1, 0.05},  {0.25, 8.80, 0.005},
        {0.40, 3.44, 0.005}, {0.65, 1.30, 0.005}, {0.75, 0.98, 0.005},
    };
    struct microscope found;
    for (size_t i = 0; i < sizeof waves / sizeof waves[0]; i++) {
        struct microscope_setting s = objective(10, waves[i].na, 1);
        s.pitch = 1e-12;
        CHECK(microscope_compute(&s, &found, &error));
        CHECK_NEAR(found.camera_depth * 1000, waves[i].um, waves[i].tolerance,
                   "photomacrography.net: l/NA^2");
    }
    /* microscopyu.com/tutorials/depthoffield, formula 1; e in the image */
    struct microscope_setting s = objective(4, 0.1, 1);
    s.pitch = 0.014;
    CHECK(microscope_compute(&s, &found, &error));
    CHECK_NEAR(found.camera_depth * 1000, 55 + 35, 1e-9, "0.55/0.01 + 14/(4 x 0.1) um");
    /* leica-microsystems.com, Berek: n (l/(2 NA^2) + 340 um/(NA M)) */
    CHECK_NEAR(found.eye_depth * 1000, 27.5 + 340 / 4.0, 1e-9, "0.55/0.02 + 340/(0.1 x 40) um");
    s = objective(100, 1.25, 1.5);
    s.pitch = 0.0065;
    CHECK(microscope_compute(&s, &found, &error));
    CHECK_NEAR(found.eye_depth * 1000, 1.5 * (0.176 + 0.272), 1e-9, "by hand, immersed");
    CHECK_NEAR(found.camera_depth * 1000, 1.5 * (0.352 + 0.052), 1e-9, "by hand, immersed");
}

static void test_sampling(void)
{
    struct microscope_setting s = objective(20, 0.5, 1);
    struct microscope found;
    s.pitch = 0.00345;
    CHECK(microscope_compute(&s, &found, &error));
    CHECK_NEAR(found.pixel * 1000, 0.1725, 1e-12, "3.45/20 um");
    CHECK_NEAR(found.nyquist_pitch * 1000, 5.5, 1e-9, "20 x 0.55/(4 x 0.5) um");
    CHECK_NEAR(found.pixels_per_abbe, 0.55 / 0.1725, 1e-9, "0.55 um in pixels");
    s.adapter = 0.5;
    CHECK(microscope_compute(&s, &found, &error));
    CHECK_NEAR(found.pixel * 1000, 0.345, 1e-12, "the adapter halves the magnification");
    CHECK_NEAR(found.camera_magnification, 10, 1e-12, "20 x 0.5");
    CHECK_NEAR(found.nyquist_pitch * 1000, 2.75, 1e-9, "and the pitch that is enough");
    CHECK_NEAR(microscope_magnification(20, 180, 200), 18, 1e-12,
               "20x for 200 mm is 18x with 180 mm");
    s = objective(20, 0.25, 1);
    CHECK(microscope_compute(&s, &found, &error));
    CHECK_NEAR(found.nyquist_pitch * 1000, 11, 1e-9, "20 x 0.55/(4 x 0.25) um");
}

static void test_refusals(void)
{
    struct microscope found;
    struct microscope_setting s = objective(100, 1.25, 1);
    CHECK(!microscope_compute(&s, &found, &error));
    CHECK(strstr(error.message, "below the index") != NULL);
    s = objective(100, 1, 1); /* all of half a sphere */
    CHECK(!microscope_compute(&s, &found, &error));
    s = objective(100, NAN, 1);
    CHECK(!microscope_compute(&s, &found, &error));
    s = objective(100, 0.5, 0.9);
    CHECK(!microscope_compute(&s, &found, &error));
    s = objective(-1, 0.5, 1);
    CHECK(!microscope_compute(&s, &found, &error));
}

/* The other way round: 0.61 l/NA of textbooks, and microscope_compute. */
static void test_aperture_for(void)
{
    CHECK_NEAR(microscope_aperture_for(0.516e-3, 0.55), 0.65, 1e-3, "0.61 x 0.55/0.65 is 0.516 um");
    CHECK_NEAR(microscope_aperture_for(0.218e-3, 0.5), 1.4, 2e-3, "0.61 x 0.5/1.4 is 0.218 um");
}

int main(void)
{
    test_aperture_for();
    test_resolution();
    test_depth();
    test_sampling();
    test_refusals();
    return check_report();
}
