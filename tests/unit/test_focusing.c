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
    /* in the lens itself object and image are one, and neither is virtual */
    const struct conjugate_points there =
        image_of(&lens, (struct conjugate_ray){{0, 0}, {1, 0}}, &arena);
    CHECK(there.object == 0 && there.image == 0 && there.magnification == 1);
    CHECK(!there.object_is_virtual && !there.image_is_virtual);
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
    const struct focus_mechanism focusing = {.lens = lens,
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

/* Two thin lenses with a stop between them, as it stands after a movement e. */
struct pair_of_lenses {
    double f1, f2, before, behind, plane; /* gaps about the stop, and to the image plane */
};

/* Where the object stands, from the first lens to the left, by what it is measured from. */
static double object_of(const struct pair_of_lenses *lens, enum conjugate_from from, double s)
{
    double D = lens->before + lens->behind, f1 = lens->f1, f2 = lens->f2;
    double f = 1 / (1 / f1 + 1 / f2 - D / (f1 * f2));
    switch (from) {
    case CONJUGATE_FROM_PRINCIPAL:
        return s - f * D / f2;
    case CONJUGATE_FROM_FOCAL:
        return s + f * (1 - D / f2);
    case CONJUGATE_FROM_ENTRANCE:
        return s - lens->before / (1 - lens->before / f1);
    case CONJUGATE_FROM_SENSOR:
        return s - D - lens->plane;
    default:
        return s;
    }
}

/* Height at the image plane of a ray from the object's axial point, of slope 1. */
static double miss_of(const struct pair_of_lenses *lens, double object)
{
    double u = 1 - object / lens->f1, y = object + (lens->before + lens->behind) * u;
    return y + lens->plane * (u - y / lens->f2);
}

static struct pair_of_lenses moved_by(const struct pair_of_lenses *lens, const double weights[3],
                                      double e)
{
    return (struct pair_of_lenses){lens->f1, lens->f2, lens->before + weights[0] * e,
                                   lens->behind + weights[1] * e, lens->plane + weights[2] * e};
}

static bool is_allowed(const struct pair_of_lenses *lens, enum conjugate_from from, double s)
{
    return lens->before >= 0 && lens->behind >= 0 && lens->plane >= 0 &&
           (from != CONJUGATE_FROM_SENSOR || object_of(lens, from, s) >= 0);
}

/* Sign changes of the miss over what is allowed: as many movements as there must be. */
static size_t count_by_steps(const struct pair_of_lenses *lens, const double weights[3],
                             enum conjugate_from from, double s)
{
    size_t count = 0;
    double last = NAN;
    for (int i = -200000; i <= 200000; i++) {
        const struct pair_of_lenses at = moved_by(lens, weights, 0.03 * i + 0.0037);
        double miss =
            is_allowed(&at, from, s) ? miss_of(&at, object_of(&at, from, s)) : (double)NAN;
        count += last * miss < 0;
        last = miss;
    }
    return count;
}

static void test_all_origins(void)
{
    static const enum conjugate_from origins[] = {CONJUGATE_FROM_FRONT, CONJUGATE_FROM_PRINCIPAL,
                                                  CONJUGATE_FROM_FOCAL, CONJUGATE_FROM_ENTRANCE,
                                                  CONJUGATE_FROM_SENSOR};
    static const double weights[][3] = {
        {0, 0, 1}, {1, 0, -1}, {0, 1, 0}, {0.5, 0.25, -1}, {-1, 1, 0}};
    static const double distances[] = {180, 400, 777, 5000};
    static const struct pair_of_lenses lenses[] = {
        {100, -80, 20, 35, 130}, {60, 90, 15, 10, 30}, {-150, 70, 12, 30, 90}};
    size_t found_all = 0;
    for (size_t k = 0; k < 3 * 5 * 5 * 4; k++) {
        const struct pair_of_lenses *lens = &lenses[k / 100];
        const double *weight = weights[k / 20 % 5], s = distances[k % 4];
        struct conjugate_question question = {CONJUGATE_OBJECT, origins[k / 4 % 5], s, 0};
        struct focused found[FOCUS_SOLUTIONS];
        struct arena arena = {0};
        struct focus_gap gaps[3];
        struct error error;
        size_t gap_count = 0;
        char text[200];
        for (size_t i = 0; i < 3; i++) {
            gaps[gap_count] = (struct focus_gap){i, weight[i]};
            gap_count += weight[i] != 0;
        }
        snprintf(text, sizeof text, "thick %g %g air -\nstop - %g air 5\nthick %g %g air -\n",
                 lens->f1, lens->before, lens->behind, lens->f2, lens->plane);
        size_t count = solve(text, gaps, gap_count, lens->plane, question, &arena, found, &error);
        for (size_t i = 0; i < count; i++) {
            double e = found[i].movement.hi;
            const struct pair_of_lenses at = moved_by(lens, weight, e);
            double object = object_of(&at, question.from, s);
            double scale = fabs(object) + at.before + at.behind + at.plane;
            CHECK(is_allowed(&at, question.from, s));
            CHECK_NEAR(miss_of(&at, object) / scale, 0, 1e-11, "the image in its plane");
            CHECK_NEAR(found[i].image_plane.hi, at.plane, 1e-12 * scale, "image plane");
            const struct surface *surfaces = found[i].lens->surfaces;
            CHECK_NEAR(surfaces[0].thickness.value.hi, at.before, 1e-12 * scale, "before the stop");
            CHECK_NEAR(surfaces[1].thickness.value.hi, at.behind, 1e-12 * scale, "behind it");
            CHECK(i == 0 || fabs(e) >= fabs(found[i - 1].movement.hi));
        }
        if (question.from == CONJUGATE_FROM_FRONT || question.from == CONJUGATE_FROM_SENSOR) {
            CHECK(count == count_by_steps(lens, weight, question.from, s));
        }
        found_all += count;
        arena_free(&arena);
    }
    CHECK(found_all > 150);
}

/* What is refused, and how: an object inside the track, a plane that nothing reaches. */
static void test_refused(void)
{
    static const struct focus_gap inner[] = {{0, 1}, {1, -1}};
    static const struct focus_gap both[] = {{0, 1}, {1, 1}};
    static const struct {
        const struct focus_gap *gaps;
        struct conjugate_question question;
        double plane;
        const char *message;
    } cases[] = {
        {inner, {CONJUGATE_OBJECT, CONJUGATE_FROM_SENSOR, 259, 0}, 200, "which reaches 260 mm"},
        {inner, {CONJUGATE_OBJECT, CONJUGATE_FROM_SENSOR, 260.5, 0}, 200, "no movement brings"},
        {inner, {CONJUGATE_OBJECT, CONJUGATE_FROM_FRONT, 20, 0}, 200, "from -60 to 200 mm"},
        {both, {CONJUGATE_OBJECT, CONJUGATE_FROM_FRONT, 20, 0}, 200, "from -60 mm"},
        {inner, {CONJUGATE_IMAGE, CONJUGATE_FROM_FRONT, 20, 0}, 200, "give an object"},
        {inner, {CONJUGATE_OBJECT, CONJUGATE_FROM_FRONT, 200, 0}, INFINITY, "no image plane"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct focused found[FOCUS_SOLUTIONS];
        struct arena arena = {0};
        struct error error = {0};
        CHECK(solve(telephoto, cases[i].gaps, 2, cases[i].plane, cases[i].question, &arena, found,
                    &error) == 0);
        bool said = strstr(error.message, cases[i].message) != NULL;
        CHECK(said);
        if (!said) {
            printf("%s: %s\n", cases[i].message, error.message);
        }
        arena_free(&arena);
    }
}

static size_t find(const char *text, struct conjugate_question question,
                   struct conjugate_points points[2], struct error *error)
{
    struct arena arena = {0};
    struct lens lens;
    struct paraxial_system system;
    struct paraxial_trace trace;
    struct conjugate_ray rays[2];
    open_text(text, &arena, &lens);
    CHECK(paraxial_compile(&lens, 0.55, SECTION_Y, &arena, &system, error));
    paraxial_trace(&system, &trace);
    size_t count = conjugate_find(&system, &trace, &question, rays, error);
    for (size_t i = 0; i < count; i++) {
        conjugate_compute(&system, &trace, &rays[i], &points[i]);
    }
    arena_free(&arena);
    return count;
}

/*
 * Kepler's telescope, f1 = 100 and f2 = 50: m = -1/2 everywhere, x' = 75 - x/4 behind the last
 * lens, and from object to image 150 + 75 + 3 x/4. With equal lenses it is 400 wherever x is.
 * An ordinary lens of 100 has 450 from object to image at x = 150 and 300.
 */
static void test_total(void)
{
    static const char *kepler = "thick 100 150 air -\nthick 50 75 air -\n";
    struct conjugate_points found[2];
    struct error error = {0};
    struct conjugate_question question = {CONJUGATE_OBJECT, CONJUGATE_FROM_SENSOR, 525, 0};
    CHECK(find(kepler, question, found, &error) == 1);
    CHECK_RELATIVE(found[0].object, 400.0, 1e-14, "object");
    CHECK_RELATIVE(found[0].image, -25.0, 1e-13, "image, virtual");
    CHECK_RELATIVE(found[0].magnification, -0.5, 1e-15, "magnification");
    CHECK_RELATIVE(found[0].angular, -2.0, 1e-15, "angular magnification");
    CHECK(found[0].image_is_virtual && !found[0].object_is_virtual);
    CHECK(find("thick 100 200 air -\nthick 100 100 air -\n", question, found, &error) == 0);
    CHECK(strstr(error.message, "same distance from object to image, 400 mm") != NULL);
    question = (struct conjugate_question){CONJUGATE_MAGNIFICATION, 0, 0, -2};
    CHECK(find(kepler, question, found, &error) == 0);
    CHECK(strstr(error.message, "magnification -0.5 wherever") != NULL);
    CHECK(find(single, question, found, &error) == 1);
    CHECK_RELATIVE(found[0].object, 150.0, 1e-15, "1 + 1/|m| focal lengths");
    question = (struct conjugate_question){CONJUGATE_OBJECT, CONJUGATE_FROM_SENSOR, 450, 0};
    CHECK(find(single, question, found, &error) == 2);
    CHECK_RELATIVE(found[0].object, 300.0, 1e-15, "the smaller image first");
    CHECK_RELATIVE(found[1].object, 150.0, 1e-15, "then the larger");
    question.distance = 399;
    CHECK(find(single, question, found, &error) == 0);
    CHECK(strstr(error.message, "0 mm or less, or 400 mm or more") != NULL);
    question.distance = 400;
    CHECK(find(single, question, found, &error) == 1 && found[0].magnification == -1);
    question.distance = INFINITY;
    CHECK(find(single, question, found, &error) == 1);
    CHECK(isinf(found[0].object) && isinf(found[0].total));
    CHECK_RELATIVE(found[0].image, 100.0, 1e-15, "in the focus");
}

int main(void)
{
    test_total();
    test_all_origins();
    test_refused();
    test_compute();
    test_media();
    test_whole_lens();
    test_inner_lens();
    return check_report();
}
