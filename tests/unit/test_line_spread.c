/* tests/unit/test_line_spread.c - lines, edges and square bars against closed forms. */
/* SPDX-License-Identifier: MIT */
#include "analysis/image/line_spread.h"
#include "base/constants.h"
#include "base/lagrange.h"
#include "check.h"
#include "lens_of.h"

#include <math.h>
#include <string.h>

/* A cone so slow that the pupil is even to 1e-5, on the axis, and with coma off it. */
static const double wave = 587.5618e-6, aperture = 0.005; /* mm */
static const char dish[] = "wavelength d\nobject inf\naperture stop\n"
                           "surface -2000 -1000 mirror 10 k=-1 stop\n";
static const char fast[] = "wavelength d\nobject inf\naperture stop\nfield angle 0 0.2\n"
                           "surface -200 -100 mirror 20 k=-1 stop\n";

struct opened {
    struct arena arena;
    struct lens lens;
    struct setup setup;
    struct mtf_question asked;
    struct mtf_source contrast;
    struct line_spread_image image;
};

static bool open(const char *text, const struct field_point *field, struct opened *opened)
{
    struct error error = {0};
    memset(opened, 0, sizeof *opened);
    opened->lens = lens_of(text, &opened->arena);
    const struct setup_field at = {.point = *field};
    const struct setup_question of = {
        .lens = &opened->lens, .wavelength = NAN, .fnumber = NAN, .fields = &at, .field_count = 1};
    const struct plane_value plane = {PLANE_PARAXIAL, NAN};
    opened->asked = (struct mtf_question){
        .bundle = {.setup = &opened->setup, .field = field, .clip = true}, .error = 1e-7};
    const struct line_spread_question question = {.bundle = opened->asked.bundle, .farthest = NAN};
    const bool found = setup_open(&of, &opened->arena, &opened->setup, &error) &&
                       setup_place_image(&opened->setup, &plane, &error) &&
                       mtf_open(&opened->asked, &opened->arena, &opened->contrast, &error) &&
                       line_spread_open(&question, &opened->arena, &opened->image, &error);
    CHECK(found);
    if (!found) {
        printf("%s\n", error.message);
    }
    return found;
}

/* A line's image through a clear circle: the integral over chords 2 h long of (2 sin(k h)/k)^2. */
static double circle_line(double x)
{
    enum { CHORDS = 300 };
    const double k = 2 * PI * aperture * x / wave;
    double sum = 0;
    for (int i = 0; i < CHORDS; i++) {
        const double angle = PI * ((i + 0.5) / CHORDS - 0.5), h = cos(angle);
        const double wide = fabs(k) > 1e-9 ? 2 * sin(k * h) / k : 2 * h;
        sum += wide * wide * h * PI / CHORDS;
    }
    return aperture / wave * sum / PI;
}

/* Its integral from `low` to `high`. */
static double circle_between(double low, double high)
{
    enum { STEPS = 8 };
    double sum = 0;
    for (int i = 0; i < STEPS; i++) {
        sum += circle_line(low + (high - low) * (i + 0.5) / STEPS) * (high - low) / STEPS;
    }
    return sum;
}

static void test_circle(void)
{
    static const double places[] = {0, 0.01, 0.03, 0.06, 0.11};
    static struct opened opened;
    const struct field_point axis = {FIELD_NONE, {0, 0}};
    double edge = 0.5, before = 0;
    if (!open(dish, &axis, &opened)) {
        return;
    }
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        const struct line_spread here = line_spread_at(&opened.image, places[i]);
        const struct line_spread there = line_spread_at(&opened.image, -places[i]);
        for (int k = 0; k < 20; k++) {
            const double step = (places[i] - before) / 20;
            edge += circle_between(before + k * step, before + (k + 1) * step);
        }
        before = places[i];
        CHECK_NEAR(here.line[MTF_TANGENTIAL], circle_line(places[i]), 2e-3, "of 14.4 a mm");
        CHECK_NEAR(there.line[MTF_SAGITTAL], circle_line(places[i]), 2e-3, "both directions");
        CHECK_NEAR(here.edge[MTF_TANGENTIAL], edge, 2e-5, "of an edge");
        CHECK_NEAR(there.edge[MTF_SAGITTAL], 1 - edge, 2e-5, "on the other side");
    }
    /* half of 16 NA/(3 pi wavelength) where the chords' integral is half of 16/3 */
    const struct line_spread_widths widths = line_spread_widths_find(&opened.image);
    CHECK_NEAR(circle_line(widths.line[0] / 2), circle_line(0) / 2, 2e-3, "half maximum");
    CHECK_NEAR(circle_line(0), 16 * aperture / (3 * PI * wave), 1e-4, "of the chords");
    arena_free(&opened.arena);
}

/* With coma the functions are the transform of the contrast and its phase. */
static void test_transform(void)
{
    enum { NODES = 400 };
    static const double places[] = {-0.004, -0.001, 0, 0.002, 0.005};
    static struct opened opened;
    const struct field_point field = {FIELD_ANGLE, {0, 0.2 * PI / 180}};
    if (!open(fast, &field, &opened)) {
        return;
    }
    for (size_t d = 0; d < MTF_DIRECTIONS; d++) {
        double lines[5] = {0}, edges[5] = {0.5, 0.5, 0.5, 0.5, 0.5};
        for (int i = 0; i < NODES; i++) {
            const double width = opened.contrast.cutoff[d] / NODES, f = (i + 0.5) * width;
            struct mtf mtf;
            struct error error;
            if (!mtf_find(&opened.contrast, f, &opened.arena, &mtf, &error) ||
                isnan(mtf.phase[d])) {
                continue;
            }
            for (int k = 0; k < 5; k++) {
                const double angle = 2 * PI * f * places[k] + mtf.phase[d];
                lines[k] += 2 * mtf.contrast[d] * cos(angle) * width;
                edges[k] += mtf.contrast[d] * sin(angle) * width / (PI * f);
            }
        }
        for (int k = 0; k < 5; k++) {
            const struct line_spread here = line_spread_at(&opened.image, places[k]);
            CHECK_NEAR(here.line[d], lines[k], 2e-3 * lines[2], "the transform of the MTF");
            CHECK_NEAR(here.edge[d], edges[k], 5e-4, "and its integral");
        }
    }
    arena_free(&opened.arena);
}

/* Bars of half a period, one about x = 0: the light there less that of a gap's middle. */
static void test_square(void)
{
    static const double frequencies[] = {2, 5, 9, 15};
    static struct opened opened;
    const struct field_point axis = {FIELD_NONE, {0, 0}};
    if (!open(dish, &axis, &opened)) {
        return;
    }
    for (size_t i = 0; i < sizeof frequencies / sizeof *frequencies; i++) {
        const double period = 1 / frequencies[i];
        double contrast = 0;
        struct mtf mtf;
        struct error error;
        for (int bar = -60; bar <= 60; bar++) {
            for (int part = -10; part < 10; part++) {
                const double low = (bar / 2. + part / 40.) * period;
                contrast += (bar % 2 == 0 ? 1 : -1) * circle_between(low, low + period / 40);
            }
        }
        const bool found =
            mtf_square_find(&opened.contrast, frequencies[i], NAN, &opened.arena, &mtf, &error);
        CHECK(found);
        CHECK_NEAR(mtf.contrast[0], contrast, 3e-3, "bars added up by the line's image");
        CHECK_NEAR(mtf.limit[0], contrast, 3e-3, "which is perfect");
    }
    /* beyond a third of the cut-off the fundamental alone: 4/pi of the sine's */
    const double high = 0.5 * opened.contrast.cutoff[0];
    struct mtf sine, square, none;
    struct error error;
    CHECK(mtf_find(&opened.contrast, high, &opened.arena, &sine, &error) &&
          mtf_square_find(&opened.contrast, high, NAN, &opened.arena, &square, &error) &&
          mtf_square_find(&opened.contrast, high, 1 / high, &opened.arena, &none, &error));
    CHECK_RELATIVE(square.contrast[0], 4 / PI * sine.contrast[0], 1e-9, "[Coltman54]");
    CHECK_NEAR(none.contrast[0], 0, 1e-12, "pixels as wide as a period");
    arena_free(&opened.arena);
}

/* Polynomials of degree 7, which eight samples have. */
static void test_lagrange(void)
{
    double samples[12];
    for (int i = 0; i < 12; i++) {
        samples[i] = pow(i - 5, 7);
    }
    CHECK_NEAR(lagrange_value(samples, 12, 4.3, LAGRANGE_MOST), pow(-0.7, 7), 1e-9, "between");
    CHECK_NEAR(lagrange_value(samples, 12, 0.4, LAGRANGE_MOST), pow(-4.6, 7), 1e-8, "at an end");
    CHECK_NEAR(lagrange_integral(samples, 12, 6, 6.5, LAGRANGE_MOST), (pow(1.5, 8) - 1) / 8, 1e-8,
               "its integral");
    for (int i = 0; i < 12; i++) {
        samples[i] = pow(i - 5, 3);
    }
    CHECK_NEAR(lagrange_value(samples, 12, 4.3, LAGRANGE_FEW), pow(-0.7, 3), 1e-12, "through four");
}

int main(void)
{
    test_lagrange();
    test_circle();
    test_transform();
    test_square();
    return check_report();
}
