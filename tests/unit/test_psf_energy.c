/* tests/unit/test_psf_energy.c - light within circles and squares against closed forms. */
/* SPDX-License-Identifier: MIT */
#include "analysis/image/psf_energy.h"
#include "base/constants.h"
#include "check.h"
#include "lens_of.h"

#include <math.h>
#include <string.h>

/* Cones so slow that the pupil is even to 1e-5: v = 2 pi NA r/wavelength. */
#define WAVE 587.5618e-6 /* mm */
static const double per_mm = 2 * PI * 0.005 / WAVE;

static const char dish[] = "wavelength d\nobject inf\naperture stop\n"
                           "surface -2000 -1000 mirror 10 k=-1 stop\n";
static const char ring[] = "wavelength d\nobject inf\naperture stop\n"
                           "surface -2000 -1000 mirror 10 k=-1 stop\n"
                           "block circle 4\n";

/* J0 or J1 by its integral, which the rule of midpoints has to all digits. */
static double bessel(int n, double x)
{
    enum { COUNT = 40 }; /* off by J80(x), below 1e-30 for x below 20 */
    double sum = 0;
    for (int i = 0; i < COUNT; i++) {
        const double t = PI * (i + 0.5) / COUNT;
        sum += cos(n * t - x * sin(t));
    }
    return sum / COUNT;
}

static double clear_circle(double v)
{
    return 1 - pow(bessel(0, v), 2) - pow(bessel(1, v), 2);
}

/* Of a pupil open from `inner` to 1: [BornWolf99] 8.6.2 squared and integrated. */
static double open_ring(double v, double inner)
{
    enum { COUNT = 2000 };
    double cross = 0;
    for (int i = 0; i < COUNT; i++) {
        const double t = v * (i + 0.5) / COUNT;
        cross += bessel(1, t) * bessel(1, inner * t) / t * v / COUNT;
    }
    const double square = inner * inner;
    return (clear_circle(v) + square * clear_circle(inner * v) - 4 * inner * cross) / (1 - square);
}

/* Through focus: |2 integral of J0(v r) exp(i u r^2/2) r dr|^2, [BornWolf99] 8.8.1, summed. */
static double defocused(double v, double u)
{
    enum { COUNT = 300 };
    double sum = 0;
    for (int i = 0; i < COUNT; i++) {
        const double at = v * (i + 0.5) / COUNT;
        double re = 0, im = 0;
        for (int j = 0; j < COUNT; j++) {
            const double r = (j + 0.5) / COUNT, wave = 2 * bessel(0, at * r) * r / COUNT;
            re += wave * cos(u * r * r / 2);
            im += wave * sin(u * r * r / 2);
        }
        sum += (re * re + im * im) * at * v / COUNT / 2;
    }
    return sum;
}

/* Airy's disc over a square, half the side v. */
static double clear_square(double v)
{
    enum { COUNT = 120 };
    double sum = 0;
    for (int i = 0; i < COUNT * COUNT; i++) {
        const double x = v * (i % COUNT + 0.5) / COUNT, y = v * (i / COUNT + 0.5) / COUNT;
        const double r = hypot(x, y);
        sum += pow(2 * bessel(1, r) / r, 2);
    }
    return 4 * sum * pow(v / COUNT, 2) / (4 * PI);
}

static void find(const char *text, double plane, const double *radii, size_t count,
                 struct psf_energy *shares)
{
    struct arena arena = {0};
    struct lens lens = lens_of(text, &arena);
    struct setup setup = {0};
    struct error error = {0};
    const struct field_point axis = {FIELD_NONE, {0, 0}};
    const struct setup_question asked = {.lens = &lens, .wavelength = NAN, .fnumber = NAN};
    const struct plane_value at = {PLANE_AT, plane};
    const struct psf_energy_question question = {
        .bundle = {.setup = &setup, .field = &axis, .clip = true},
        .farthest = radii[count - 1],
        .has_limit = true};
    struct psf_energy_image image;
    const bool found = setup_open(&asked, &arena, &setup, &error) &&
                       setup_place_image(&setup, &at, &error) &&
                       psf_energy_open(&question, &arena, &image, &error);
    CHECK(found);
    if (found) {
        psf_energy_find(&image, radii, count, shares, &arena);
    } else {
        printf("%s\n", error.message);
        memset(shares, 0, count * sizeof *shares);
    }
    arena_free(&arena);
}

enum { COUNT = 4 };
static const double radii[COUNT] = {0.02, 0.06, 0.1, 0.18}; /* v: 1.07, 3.2, 5.3, 9.6 */

static void test_clear(void)
{
    struct psf_energy shares[COUNT];
    find(dish, -1000, radii, COUNT, shares);
    for (size_t i = 0; i < COUNT; i++) {
        const double v = per_mm * radii[i];
        CHECK_NEAR(shares[i].encircled, clear_circle(v), 1e-4, "1 - J0^2 - J1^2");
        CHECK_NEAR(shares[i].limit, clear_circle(v), 1e-4,
                   "the limit of a perfect image is itself");
        CHECK_NEAR(shares[i].ensquared, clear_square(v), 2e-4, "Airy's disc over a square");
        CHECK(fabs(shares[i].encircled - clear_circle(v)) < shares[i].error);
    }
}

static void test_obscured(void)
{
    struct psf_energy shares[COUNT];
    find(ring, -1000, radii, COUNT, shares);
    for (size_t i = 0; i < COUNT; i++) {
        CHECK_NEAR(shares[i].encircled, open_ring(per_mm * radii[i], 0.4), 2e-4,
                   "of a ring, 0.4 obscured");
    }
}

/* About a wave of defocus at the rim: of the sphere about a plane z behind, 5^2/2 (1/f - 1/z). */
static void test_defocused(void)
{
    struct psf_energy shares[COUNT];
    const double z = 1047, wave = 12.5 * (1 / 1000. - 1 / z);
    find(dish, -z, radii, COUNT, shares);
    for (size_t i = 0; i < COUNT; i++) {
        const double v = per_mm * radii[i] * 1000 / z;
        CHECK_NEAR(shares[i].encircled, defocused(v, 4 * PI * wave / WAVE), 2e-4, "out of focus");
        CHECK_NEAR(shares[i].limit, clear_circle(v), 2e-4, "of the same cone in focus");
    }
}

int main(void)
{
    test_clear();
    test_obscured();
    test_defocused();
    return check_report();
}
