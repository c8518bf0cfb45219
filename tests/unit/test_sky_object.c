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

/*
 * Equatorial radii of the Astronomical Almanac 2001, as astronomy.sierracollege.edu has them, at
 * the least of mean distances: those of VSOP87 from the Sun, as ERFA has them. Sun and moon: Meeus,
 * Astronomical Algorithms, ch. 55.
 */
static void test_sizes(void)
{
    static const struct {
        const char *word;
        double radius, distance; /* km, au */
    } planets[] = {
        {"mercury", 2439.7, 0.387098}, {"venus", 6051.8, 0.723330}, {"mars", 3397, 1.523679},
        {"jupiter", 71492, 5.202603},  {"saturn", 60268, 9.554909}, {"uranus", 25559, 19.218446},
        {"neptune", 24764, 30.110387},
    };
    const double au = 149597870.7, arcsec = DEGREES_PER_RADIAN * 3600;
    check_source("almanac", "arcsec");
    for (size_t i = 0; i < sizeof planets / sizeof planets[0]; i++) {
        char what[80];
        const double size = 2 * planets[i].radius / (au * fabs(planets[i].distance - 1)) * arcsec;
        snprintf(what, sizeof what, "%s at its nearest: size", planets[i].word);
        CHECK_NEAR(arcsec_of(planets[i].word), size, 2e-3 * size, what);
    }
    CHECK_NEAR(arcsec_of("sun"), 2 * 959.63, 1, "the sun: size");
    CHECK_NEAR(arcsec_of("moon"), 2 * 0.272481 * 6378.14 / 384400 * arcsec, 0.3, "the moon: size");
    check_source(NULL, "");
    CHECK_NEAR(arcsec_of("saturn-rings") / arcsec_of("saturn"), 136775.0 / 60268, 1e-6,
               "[NSSDC] the outer edge of the A ring over the equatorial radius");
}

/*
 * The longer sizes of a list that is not [Frommert]'s, from which the program has its own: The
 * Messier List in rtmalone/AstroObservationPrograms, with 85.6 arcsec for the ring nebula.
 */
static void test_deep_sky(void)
{
    static const struct {
        const char *word;
        double arcmin, tolerance;
    } objects[] = {
        {"andromeda", 178, 1e-9},    {"triangulum", 73, 1e-9},   {"whirlpool", 11, 1e-9},
        {"pleiades", 110, 1e-9},     {"orion-nebula", 85, 1e-9}, {"dumbbell", 8, 1e-9},
        {"ring-nebula", 1.43, 0.04},
    };
    for (size_t i = 0; i < sizeof objects / sizeof objects[0]; i++) {
        CHECK_NEAR(arcsec_of(objects[i].word) / 60, objects[i].arcmin, objects[i].tolerance,
                   objects[i].word);
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

/* Who is as tall as the moon is wide, and from where. */
static void test_distance(void)
{
    const double half_degree = 0.5 * RADIANS_PER_DEGREE;
    CHECK_RELATIVE(sky_distance(60e3, half_degree), 6875449.0, 1e-6,
                   "60 m/(2 tan 0.25 deg), asked: 6875 m");
    CHECK_RELATIVE(sky_distance(2000, PI / 2), 1000.0, 1e-15, "tan 45 deg is 1");
    CHECK_RELATIVE(sky_subtended(2000, 1000), PI / 2, 1e-15, "the same");
    CHECK_RELATIVE(sky_subtended(60e3, sky_distance(60e3, half_degree)), half_degree, 1e-14,
                   "back");
}

int main(void)
{
    test_distance();
    test_sizes();
    test_deep_sky();
    test_words();
    test_images();
    return check_report();
}
