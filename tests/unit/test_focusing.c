/* tests/unit/test_focusing.c - conjugates, and gaps that focus, against the lens equation. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "file/lens_file.h"
#include "optics/focusing.h"

/* A lens of f = 100 mm; 60 mm behind it one of -50: an object at infinity is imaged at 200. */
static const char *telephoto = "thick 100 60 air -\nthick -50 200 air -\n";
static const char *single = "thick 100 100 air -\n";

static void open_text(const char *text, struct arena *arena, struct lens *lens)
{
    struct error error = {0};
    CHECK(lens_read("t.lens", text_of(text), NULL, arena, lens, &error));
}

static struct conjugate_points image_of(const struct lens *lens, struct conjugate_ray ray,
                                        struct arena *arena)
{
    struct paraxial_system system;
    struct paraxial_trace trace;
    struct conjugate_points points = {0};
    struct error error;
    CHECK(paraxial_compile(lens, 0.55, SECTION_Y, arena, &system, &error));
    paraxial_trace(&system, &trace);
    conjugate_compute(&system, &trace, &ray, &points);
    return points;
}

/* 1/s' = 1/f - 1/s, m = -s'/s, dz'/dz = m^2, u'/u = 1/m. */
static void test_compute(void)
{
    static const struct {
        double object, image, magnification;
    } rows[] = {{200, 200, -1}, {300, 150, -0.5}, {150, 300, -2}, {50, -100, 2}, {-100, 50, 0.5}};
    struct arena arena = {0};
    struct lens lens;
    open_text(single, &arena, &lens);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        /* a ray of slope 1/100 from the object: y = s/100 at the lens */
        const struct conjugate_ray ray = {pair_of(rows[i].object), pair_of(1)};
        const struct conjugate_points p = image_of(&lens, ray, &arena);
        double m = rows[i].magnification;
        CHECK_RELATIVE(p.object, rows[i].object, 1e-15, "object");
        CHECK_RELATIVE(p.image, rows[i].image, 1e-15, "image");
        CHECK_RELATIVE(p.magnification, m, 1e-15, "magnification");
        CHECK_RELATIVE(p.angular, 1 / m, 1e-15, "angular magnification");
        CHECK_RELATIVE(p.longitudinal, m * m, 1e-15, "longitudinal magnification");
        CHECK_RELATIVE(p.total, rows[i].object + rows[i].image, 1e-15, "from object to image");
        CHECK_RELATIVE(p.object_focal, rows[i].object - 100, 1e-15, "from F");
        CHECK_RELATIVE(p.image_focal, rows[i].image - 100, 1e-15, "from F'");
        CHECK(p.object_is_virtual == (rows[i].object < 0));
        CHECK(p.image_is_virtual == (rows[i].image < 0));
    }
    const struct conjugate_points far =
        image_of(&lens, (struct conjugate_ray){{1, 0}, {0, 0}}, &arena);
    CHECK(isinf(far.object) && far.magnification == 0);
    CHECK_RELATIVE(far.image, 100.0, 1e-15, "image of infinity");
    const struct conjugate_points focal =
        image_of(&lens, (struct conjugate_ray){{100, 0}, {1, 0}}, &arena);
    CHECK(isinf(focal.image) && isinf(focal.magnification) && focal.angular == 0);
    arena_free(&arena);
}

/* An immersed image: n'/s' = 1/f + n/s' reads in water 1.33/s' = 0.01 - 1/s. */
static void test_media(void)
{
    struct arena arena = {0};
    struct lens lens;
    open_text("thick 100 133 1.33 -\n", &arena, &lens);
    const struct conjugate_points p =
        image_of(&lens, (struct conjugate_ray){{300, 0}, {1, 0}}, &arena);
    CHECK_RELATIVE(p.image, 1.33 * 150, 1e-15, "image in water");
    CHECK_RELATIVE(p.magnification, -0.5, 1e-15, "magnification: n s'/(n' s)");
    CHECK_RELATIVE(p.longitudinal, 1.33 * 0.25, 1e-15, "n'/n m^2");
    arena_free(&arena);
}

static size_t solve(const char *text, const struct focus_gap *gaps, size_t count, double plane,
                    struct conjugate_question question, struct arena *arena,
                    struct focused solutions[FOCUS_SOLUTIONS], struct error *error)
{
    struct lens *lens = ARENA_NEW(arena, struct lens);
    open_text(text, arena, lens);
    const struct focusing focusing = {.lens = lens,
                                      .wavelength = 0.55,
                                      .section = SECTION_Y,
                                      .image_plane = pair_of(plane),
                                      .gaps = gaps,
                                      .gap_count = count};
    return focus_solve(&focusing, &question, arena, solutions, error);
}

/*
 * The whole lens is moved. An object 300 before it has its image 150 behind: 50 out. 450 from the
 * film there are two places: s' = 150 and 300, the roots of s' + 100 s'/(s' - 100) = 450.
 */
static void test_whole_lens(void)
{
    const struct focus_gap last = {0, 1};
    struct arena arena = {0};
    struct focused found[FOCUS_SOLUTIONS];
    struct error error;
    struct conjugate_question question = {CONJUGATE_OBJECT, CONJUGATE_FROM_FRONT, 300, 0};
    CHECK(solve(single, &last, 1, 100, question, &arena, found, &error) == 1);
    CHECK_RELATIVE(found[0].movement.hi, 50.0, 1e-15, "out by f^2/(s - f)");
    CHECK_RELATIVE(found[0].image_plane.hi, 150.0, 1e-15, "the film");
    question.from = CONJUGATE_FROM_SENSOR;
    question.distance = 450;
    CHECK(solve(single, &last, 1, 100, question, &arena, found, &error) == 2);
    CHECK_RELATIVE(found[0].movement.hi, 50.0, 1e-15, "the near root");
    CHECK_RELATIVE(found[1].movement.hi, 200.0, 1e-15, "the far root");
    question = (struct conjugate_question){CONJUGATE_MAGNIFICATION, 0, 0, -0.5};
    CHECK(solve(single, &last, 1, 100, question, &arena, found, &error) == 1);
    CHECK_RELATIVE(found[0].movement.hi, 50.0, 1e-15, "half size");
    question = (struct conjugate_question){CONJUGATE_OBJECT, CONJUGATE_FROM_SENSOR, 399, 0};
    CHECK(solve(single, &last, 1, 100, question, &arena, found, &error) == 0);
    CHECK(error.code == ERROR_DOMAIN); /* nearer than 4 f */
    arena_free(&arena);
}

/*
 * The rear lens moves between the front one and the film, 260 from it. With the first image at
 * i, u = i - d: (i - u) + 50 u/(50 - u) = 260, so u^2 + (260 - i) u - 50 (260 - i) = 0.
 * For an object 1100 away i = 110, u = sqrt(13125) - 75, and the rear lens goes back by
 * 110 - u - 60 = 125 - sqrt(13125).
 */
static void test_inner_lens(void)
{
    const struct focus_gap gaps[] = {{0, 1}, {1, -1}};
    struct arena arena = {0};
    struct focused found[FOCUS_SOLUTIONS];
    struct error error;
    struct conjugate_question question = {CONJUGATE_OBJECT, CONJUGATE_FROM_FRONT, 1100, 0};
    CHECK(solve(telephoto, gaps, 2, 200, question, &arena, found, &error) >= 1);
    CHECK_NEAR(found[0].movement.hi, 10.435607626103999835, 1e-14, "125 - sqrt(13125)");
    CHECK_NEAR(found[0].image_plane.hi, 200 - 10.435607626103999835, 1e-13, "the film stays");
    question.distance = INFINITY;
    CHECK(solve(telephoto, gaps, 2, 200, question, &arena, found, &error) >= 1);
    CHECK_NEAR(found[0].movement.hi, 0, 1e-14, "it stood at infinity");
    /* the front lens alone, its image 1000/9 behind it: again 40 behind the rear one */
    const struct focus_gap front = {0, 1};
    question.distance = 1000;
    CHECK(solve(telephoto, &front, 1, 200, question, &arena, found, &error) == 1);
    CHECK_NEAR(found[0].movement.hi, 100.0 / 9, 1e-13, "1000/9 - 40 - 60");
    arena_free(&arena);
}

int main(void)
{
    test_compute();
    test_media();
    test_whole_lens();
    test_inner_lens();
    return check_report();
}
