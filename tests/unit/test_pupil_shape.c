/* tests/unit/test_pupil_shape.c - areas and solid angles of pupils against closed forms. */
/* SPDX-License-Identifier: MIT */
#include "analysis/pupil_shape.h"
#include "base/constants.h"
#include "check.h"
#include "file/lens_file.h"

static const double pi = PI, degree = RADIANS_PER_DEGREE;
static const double STOP = 5, RIM = 8, GAP = 20; /* mm */

static struct pupil_shape shape_of(const char *text, struct field_point field, struct arena *arena)
{
    struct lens lens;
    struct system clipped, open;
    struct first_order first;
    struct beam beam;
    struct pupil_shape shape = {0};
    struct error error = {0};
    struct system_options options = system_options_default();
    CHECK(lens_read("t.lens", text_of(text), NULL, arena, &lens, &error));
    const struct conjugate_object object = lens_object(&lens);
    CHECK(system_compile(&lens, 0.55, &options, arena, &open, &error));
    options.clip = true;
    CHECK(system_compile(&lens, 0.55, &options, arena, &clipped, &error));
    CHECK(first_order_of_lens(&lens, 0.55, SECTION_Y, arena, &first, &error));
    CHECK(beam_of_field(&field, &object, &first, &beam, &error));
    const struct pupil_question question = {
        .clipped = &clipped, .open = &open, .beam = &beam, .first = &first, .directions = 512};
    CHECK(pupil_shape(&question, arena, &shape, &error));
    return shape;
}

/* Two holes in a row: what of the rear one is seen through the front one, shifted by d. */
static double lens_of_discs(double r, double R, double d)
{
    if (d <= R - r) {
        return pi * r * r;
    }
    double a = (d * d + r * r - R * R) / (2 * d), b = d - a;
    return r * r * acos(a / r) - a * sqrt(r * r - a * a) + R * R * acos(b / R) -
           b * sqrt(R * R - b * b);
}

/* The cat's eye of a stop behind a rim, for light from infinity. */
static void test_cats_eye(void)
{
    static const char *text = "object inf\naperture stop\nsurface - 20 air 16\nstop - 10 air 10\n"
                              "thick 100 100 air -\n";
    for (int t = -24; t <= 24; t += 6) {
        struct arena arena = {0};
        const struct field_point field = {FIELD_ANGLE, {0, t * degree}};
        const struct pupil_shape shape = shape_of(text, field, &arena);
        double shift = GAP * tan(t * degree), area = lens_of_discs(STOP, RIM, fabs(shift));
        CHECK(!shape.is_empty);
        CHECK_RELATIVE(shape.entrance.pupil.area, area, 4e-5, "area in the stop");
        CHECK_RELATIVE(shape.entrance.vertex.area, area, 4e-5, "area at the rim");
        CHECK_RELATIVE(shape.projected, area * cos(t * degree), 4e-5, "projected");
        CHECK(isnan(shape.cosine_area));
        /* light that goes up meets the stop higher than the rim by the shift */
        double low = fmax(-STOP, shift - RIM), high = fmin(STOP, shift + RIM);
        CHECK_NEAR(shape.entrance.pupil.low[1], low, 2e-3, "lower end");
        CHECK_NEAR(shape.entrance.pupil.high[1], high, 2e-3, "upper end");
        CHECK_NEAR(shape.vignetting[PUPIL_UPPER], 1 - high / STOP, 4e-4, "upper vignetting");
        CHECK_NEAR(shape.vignetting[PUPIL_LOWER], 1 + low / STOP, 4e-4, "lower vignetting");
        if (high < STOP) {
            CHECK(shape.entrance.limit[PUPIL_UPPER] == 1);
        }
        arena_free(&arena);
    }
}

/*
 * The projected solid angle of a disc of radius a that is parallel, at a height h and y aside:
 * pi/2 (1 - (h^2 + y^2 - a^2)/sqrt((h^2 + y^2 + a^2)^2 - 4 a^2 y^2)).
 */
static double solid_angle(double a, double h, double y)
{
    double sum = h * h + y * y + a * a;
    return pi / 2 * (1 - (h * h + y * y - a * a) / sqrt(sum * sum - 4 * a * a * y * y));
}

static void test_near_object(void)
{
    static const char *text = "object 60\naperture stop\nsurface - 20 air -\nstop - 10 air 10\n"
                              "thick 100 100 air -\n";
    for (int y = 0; y <= 60; y += 20) {
        struct arena arena = {0};
        const struct field_point field = {FIELD_HEIGHT, {0, y}};
        const struct pupil_shape shape = shape_of(text, field, &arena);
        CHECK(!shape.is_empty);
        CHECK_RELATIVE(shape.cosine_area, solid_angle(STOP, 80, y), 1e-9, "of a disc");
        CHECK_RELATIVE(shape.entrance.pupil.area, 25 * pi, 1e-9, "the stop itself");
        /* at the first vertex the cone is 60/80 as wide */
        CHECK_RELATIVE(shape.entrance.vertex.area, 25 * pi * 9 / 16, 1e-9, "in front of it");
        arena_free(&arena);
    }
}

/* An image of the stop: 10 before a lens of f = 100 its image is upright, 1/(1 - 0.1) as large. */
static void test_exit(void)
{
    static const char *text = "object inf\naperture stop\nstop - 10 air 10\nthick 100 100 air -\n";
    struct arena arena = {0};
    const struct field_point field = {FIELD_NONE, {0, 0}};
    const struct pupil_shape shape = shape_of(text, field, &arena);
    CHECK_NEAR(shape.exit.pupil.z, -100.0 / 9, 1e-12, "exit pupil");
    CHECK_RELATIVE(shape.exit.pupil.area, 25 * pi / 0.81, 2e-4, "its area, a polygon of 512");
    CHECK_RELATIVE(shape.exit.vertex.area, 25 * pi, 2e-4, "at the lens as wide as the beam");
    arena_free(&arena);
}

int main(void)
{
    test_cats_eye();
    test_near_object();
    test_exit();
    return check_report();
}
