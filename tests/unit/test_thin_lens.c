/* tests/unit/test_thin_lens.c - thin lenses and mirrors from their conjugates. */
/* SPDX-License-Identifier: MIT */
#include "optics/thin_lens.h"

#include "check.h"

#include <math.h>

static struct error error;

/* Exact fractions, from 1/s + 1/s' = 1/f and m = -s'/s by hand. */
static void test_power(void)
{
    static const double no = NAN, infinite = INFINITY;
    static const struct {
        struct thin_lens_given given;
        double focal;
        const char *source;
    } cases[] = {
        {{5, 12, no, no}, 60.0 / 17, "5 * 12/(5 + 12)"},
        {{10, -6, no, no}, -15, "an object before a diverging lens"},
        {{-10, 190, no, no}, -190.0 / 18, "a virtual object"},
        {{infinite, 12, no, no}, 12, "a far object"},
        {{12, infinite, no, no}, 12, "an image at infinity"},
        {{12, no, 0.032, no}, -0.384 * 12 / (12 - 0.384), "keratometer [OpenStax16] ex. 2.2"},
        {{12, no, 1.5, no}, 36, "makeup mirror, 0.360 m [OpenStax16] ch. 2.2"},
        {{no, 300, -11, no}, 25, "s = 300/11, 1/f = 11/300 + 1/300"},
        {{no, no, -1, 100}, 25, "1:1 at four focal lengths"},
        {{no, no, -4, 100}, 16, "s = 20, s' = 80"},
        {{no, no, -0.25, 100}, 16, "the same, turned around"},
        {{no, no, 0.5, 10}, -20, "s = 20, s' = -10"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct pair power;
        CHECK(thin_lens_power(&cases[i].given, &power, &error));
        CHECK_RELATIVE(1 / power.hi, cases[i].focal, 1e-15, cases[i].source);
    }
}

static void test_refusals(void)
{
    static const double no = NAN;
    static const struct {
        struct thin_lens_given given;
        const char *message;
    } cases[] = {
        {{5, no, no, no}, "too little is given"},
        {{5, 12, -2, no}, "one too many"},
        {{5, no, no, 20}, "wants magnification"},
        {{0, 5, no, no}, "object 0"},
        {{5, 0, no, no}, "image 0"},
        {{5, no, 0, no}, "neither 0 nor inf"},
        {{INFINITY, no, 2, no}, "finite distance"},
        {{no, no, -1, -5}, "must be above 0"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct pair power;
        error = (struct error){0};
        CHECK(!thin_lens_power(&cases[i].given, &power, &error));
        CHECK(strstr(error.message, cases[i].message) != NULL);
    }
}

/* 25 cm/f with the image at infinity, one more with it at the near point. */
static void test_magnifier(void)
{
    CHECK_NEAR(thin_lens_magnifier(100, 250), 2.5, 0, "[OpenStax16] ch. 2.7");
    CHECK_RELATIVE(thin_lens_magnifier(1 / (1 / 100.0 + 1 / 250.0), 250), 3.5, 1e-15,
                   "[OpenStax16] ch. 2.7");
}

/* Jiskha's and others' mirrors that throw an image on a screen. */
static void test_mirror(void)
{
    CHECK_RELATIVE(mirror_object(4200, -5.2), 1000.0, 1e-15, "5.2 m - 1 m: 4.2 m apart");
    CHECK_RELATIVE(mirror_object(657.74, 0.40625), 467.73, 1e-4, "19 cm behind: 46.77 + 19 cm");
    CHECK(isinf(mirror_object(1, -1)));
}

int main(void)
{
    test_mirror();
    test_power();
    test_refusals();
    test_magnifier();
    return check_report();
}
