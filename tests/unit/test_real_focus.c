/* tests/unit/test_real_focus.c - sharpness by rays: of ideal lenses against similar triangles. */
/* SPDX-License-Identifier: MIT */
#include "analysis/real/real_focus.h"

#include "analysis/real/real_range.h"
#include "check.h"
#include "file/lens_file.h"

#include <math.h>

/* A lens of 50 mm with its stop, of 20 mm, this far before it: the entrance pupil. */
static void read_ideal(double before, struct lens *lens, struct arena *arena)
{
    struct error error;
    const char *text =
        arena_printf(arena, "object inf\nstop - %.17g air 20\nthick 50 3 air -\n", before);
    CHECK(lens_read("ideal", text_of(text), NULL, arena, lens, &error));
}

static const double f = 50, wide = 20;

/* Where an object is as blurred as c: X from the pupil, X1 = X/(1 +- c/(m A)). */
static double limit(double distance, double before, double c, int sign)
{
    const double m = f / (distance - f), X = distance - before;
    const double part = 1 + sign * c / (m * wide);
    return part > 0 ? X / part + before : INFINITY;
}

/* The image of an object at s, behind the last vertex, which is H'. */
static double image(double s)
{
    return isinf(s) ? f : f * s / (s - f);
}

static void check_ideal(double before, double distance, struct blur_rule rule, double tolerance)
{
    struct arena arena = {0};
    struct lens lens;
    struct real_focus focus;
    struct real_range range;
    struct error error;
    const double c = 0.03, object = isinf(distance) ? distance : distance - before;
    double hyperfocal, blur;
    read_ideal(before, &lens, &arena);
    const struct real_focus_question question = {
        .lens = {.lens = &lens, .wavelength = NAN, .fnumber = NAN},
        .rule = rule,
        .object = object,
        .c = c,
    };
    CHECK(real_focus_open(&question, &arena, &focus, &error));
    /* the principal plane lies behind the stop, which is the first vertex */
    CHECK(real_range_find(&focus, before, distance, c, &range, &error));
    const double near = isinf(distance) ? f * wide / c + before : limit(distance, before, c, 1);
    const double far = isinf(distance) ? distance : limit(distance, before, c, -1);
    CHECK_NEAR(range.near, near, tolerance * near, "near limit");
    CHECK(isinf(far) ? isinf(range.far) : fabs(range.far - far) <= tolerance * far);
    CHECK_NEAR(range.film, image(distance), 1e-12 * f, "film");
    CHECK_NEAR(range.film_near, image(near), tolerance * f, "film of the near limit");
    /* the cone behind the lens has the exit pupil for its base: f/(f - e) as wide, e f/(f-e) off */
    const double exit = wide * f / (f - before), place = -before * f / (f - before);
    const double half = c * (image(distance) - place) / exit;
    CHECK_NEAR(range.film_high - range.film, half, 1e-3 * tolerance + tolerance * half, "behind");
    CHECK_NEAR(range.film - range.film_low, half, 1e-3 * tolerance + tolerance * half, "before");
    CHECK(real_range_hyperfocal(&focus, before, c, &hyperfocal, &blur, &error));
    CHECK_NEAR(hyperfocal, f * wide / c + f, tolerance * 4e4, "hyperfocal distance");
    const double m = isinf(distance) ? 0 : f / (distance - f);
    if (m * wide < blur_rule_reach(rule)) {
        CHECK_NEAR(range.blur_at_infinity, m * wide, tolerance * m * wide + 1e-11, "of infinity");
    } else {
        CHECK(isnan(range.blur_at_infinity)); /* more than the rule can tell */
    }
    CHECK(fabs(blur) <= 1e-10);
    arena_free(&arena);
}

static void test_ideal(void)
{
    static const struct blur_rule rms = {BLUR_RMS, 0}, energy = {BLUR_ENERGY, 0.8},
                                  mtf = {BLUR_MTF, 10};
    check_ideal(0, 3000, rms, 1e-11);
    check_ideal(10, 3000, rms, 1e-11);
    check_ideal(10, 120, rms, 1e-11);
    check_ideal(-0.0, 40000, rms, 1e-11);
    check_ideal(10, INFINITY, rms, 1e-11);
    check_ideal(10, 3000, energy, 1e-6);
    check_ideal(10, 3000, mtf, 1e-9);
}

int main(void)
{
    test_ideal();
    return check_report();
}
