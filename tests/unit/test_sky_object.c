/* tests/unit/test_sky_object.c - sizes in the sky and of their images. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "check.h"
#include "photo/sky_object.h"

#include <math.h>
#include <string.h>

static struct error error;

static double arcsec_of(const char *word)
{
    for (int i = 1; sky_objects[i].word != NULL; i++) {
        if (strcmp(sky_objects[i].word, word) == 0) {
            return sky_angle(i) * DEGREES_PER_RADIAN * 3600;
        }
    }
    return NAN;
}

static void test_sizes(void)
{
    static const struct {
        const char *word;
        double arcsec, tolerance;
        const char *source;
    } sizes[] = {
        {"moon", 1865.2, 0.6, "Allen's Astrophysical Quantities: 31'05.2 at the mean distance"},
        {"sun", 1919.3, 1, "Allen's Astrophysical Quantities: 31'59.26 at 1 au"},
        {"mercury", 10.97, 0.1, "NSSDC fact sheet: 11.0 at inferior conjunction"},
        {"venus", 60.2, 0.3, "NSSDC fact sheet: 60.2 at inferior conjunction"},
        {"mars", 17.9, 0.1, "NSSDC fact sheet: 17.9 at opposition"},
        {"jupiter", 46.9, 0.1, "NSSDC fact sheet: 46.9 at opposition"},
        {"saturn", 19.5, 0.1, "NSSDC fact sheet: 19.5 at opposition"},
        {"saturn-rings", 44.2, 0.1, "136 775 km by hand"},
        {"uranus", 3.9, 0.05, "NSSDC fact sheet: 3.9 at opposition"},
        {"neptune", 2.3, 0.06, "NSSDC fact sheet: 2.3 at opposition"},
        {"andromeda", 178 * 60, 1e-9, "M31, 178 x 63 arcmin"},
        {"ring-nebula", 84, 1e-9, "M57, 1.4 x 1 arcmin"},
    };
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        CHECK_NEAR(arcsec_of(sizes[i].word), sizes[i].arcsec, sizes[i].tolerance, sizes[i].source);
    }
}

/* Every word has its size: the two tables stand side by side. */
static void test_words(void)
{
    int count = 0;
    for (int i = 1; sky_objects[i].word != NULL; i++) {
        CHECK(sky_angle(i) > 0);
        count++;
    }
    CHECK_NEAR(count, 18, 0, "words of the table");
}

static void test_images(void)
{
    struct fov_setting setting = {RECTILINEAR, 1000, INFINITY, 1, 1};
    const double arcsec = 1 / (DEGREES_PER_RADIAN * 3600);
    double image;
    CHECK_NEAR(0.00376 / fov_scale(&setting) / arcsec, 206.265 * 3.76 / 1000, 1e-6,
               "206.265 p/f: 3.76 um at 1000 mm");
    CHECK(sky_image(&setting, 31.0883 * 60 * arcsec, &image, &error));
    CHECK_NEAR(image, 1000 / 110.58, 1e-3, "small angle: f/110.6 for 31.09 arcmin");
    CHECK(sky_image(&setting, PI / 2, &image, &error));
    CHECK_NEAR(image, 2000, 1e-9, "90 deg, rectilinear: 2 f tan 45 deg");
    setting.projection = EQUIDISTANT;
    CHECK(sky_image(&setting, PI / 2, &image, &error));
    CHECK_NEAR(image, 1000 * PI / 2, 1e-9, "90 deg, equidistant: f t");
    setting.s = 2000;
    setting.P = 2;
    CHECK_NEAR(fov_scale(&setting), 1500, 1e-9, "life size with P = 2: f (1 + 1/2)");
    setting.projection = RECTILINEAR;
    CHECK(!sky_image(&setting, PI, &image, &error));
    CHECK(strstr(error.message, "lies beyond the rectilinear projection") != NULL);
}

int main(void)
{
    test_sizes();
    test_words();
    test_images();
    return check_report();
}
