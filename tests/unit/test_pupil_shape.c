/* tests/unit/test_pupil_shape.c - areas and solid angles of pupils against closed forms. */
/* SPDX-License-Identifier: MIT */
#include "analysis/pupil/pupil_shape.h"
#include "base/constants.h"
#include "check.h"
#include "file/lens_file.h"
#include "two_discs.h"

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

static struct pupil_shape film_shape_of(const char *text, const double film[2], double h,
                                        struct arena *arena)
{
    struct lens lens;
    struct system clipped, open;
    struct first_order first;
    struct pupil_shape shape = {0};
    struct error error = {0};
    struct system_options options = system_options_default();
    options.reverse = true;
    CHECK(lens_read("t.lens", text_of(text), NULL, arena, &lens, &error));
    CHECK(system_compile(&lens, 0.55, &options, arena, &open, &error));
    options.clip = true;
    CHECK(system_compile(&lens, 0.55, &options, arena, &clipped, &error));
    CHECK(first_order_of_lens(&lens, 0.55, SECTION_Y, arena, &first, &error));
    const struct beam beam = beam_from_film((double[3]){film[0], film[1], h}, 1);
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

/*
 * Parallel light behind a sphere of R = 8, n = 1.5, whose paraxial focus is 24 mm behind it. A ray
 * at h meets the plane at z at h - (z - sag) tan(i - i'), with sin i = h/R. At 23.5 the rays of the
 * edge are the outermost, and where the fold ends is known; at 20 those of h = 4 are.
 */
static void test_fold(void)
{
    static const char *const texts[] = {
        "object inf\naperture stop\nstop - 0 air 10\nsurface 8 23.5 1.5 -\nsurface - - 1.5 -\n",
        "object inf\naperture stop\nstop - 0 air 10\nsurface 8 20 1.5 -\nsurface - - 1.5 -\n"};
    const double turn = asin(STOP / 8) - asin(STOP / 12), sag = 8 - sqrt(64 - STOP * STOP);
    const double edge = (23.5 - sag) * tan(turn) - STOP;
    struct arena arena = {0};
    const struct field_point field = {FIELD_NONE, {0, 0}};
    struct pupil_extent extent = shape_of(texts[0], field, &arena).exit.vertex;
    CHECK(extent.folds && isnan(extent.area));
    for (int k = 0; k < 2; k++) {
        CHECK_NEAR(extent.high[k], edge, 1e-9, "the edge is farther out than the fold");
        CHECK_NEAR(extent.low[k], -edge, 1e-9, "the edge is farther out than the fold");
    }
    extent = shape_of(texts[1], field, &arena).exit.vertex;
    CHECK(extent.folds && isnan(extent.area));
    for (int k = 0; k < 2; k++) {
        CHECK(isnan(extent.high[k]) && isnan(extent.low[k]));
    }
    arena_free(&arena);
}

/* Light along the plane does not cross it: from 89.9 degrees on. A stop seen from its edge. */
static void test_grazing(void)
{
    static const char *const texts[] = {
        "object inf\naperture stop\nstop - 10 air 10\nthick 100 100 air -\n",
        "object inf\naperture stop\nsurface - -10 mirror 10 stop\n"};
    struct arena arena = {0};
    for (int i = 0; i < 4; i++) {
        const double angle = i % 2 == 0 ? 89.85 : 89.95;
        const struct field_point field = {FIELD_ANGLE, {0, angle * degree}};
        const struct pupil_shape shape = shape_of(texts[i / 2], field, &arena);
        const struct pupil_extent *planes[] = {&shape.entrance.pupil, &shape.exit.vertex};
        for (int k = 0; k < 2; k++) {
            const double high = planes[k]->high[0], low = planes[k]->low[0];
            CHECK(angle < 89.9 ? fabs(high - STOP) < 1e-6 : isnan(high));
            CHECK(angle < 89.9 ? fabs(low + STOP) < 1e-6 : isnan(low));
        }
    }
    arena_free(&arena);
}

/* The extent is the region, scaled about the origin by m and moved. */
static void check_extent(const struct pupil_extent *extent, const struct region *region, double m,
                         const double shift[2], const char *what)
{
    for (int k = 0; k < 2; k++) {
        CHECK_NEAR(extent->high[k], m * region->high[k] + shift[k], 1e-4, what);
        CHECK_NEAR(extent->low[k], m * region->low[k] + shift[k], 1e-4, what);
        CHECK_NEAR(extent->centre[k], m * region->centre[k] + shift[k], 1e-5, what);
    }
    CHECK_RELATIVE(extent->area, m * m * region->area, 1e-6, what);
    CHECK(!extent->folds);
}

static void check_ends(const struct pupil_side *side, const struct pupil_shape *shape,
                       const struct region *region, size_t stop, size_t rim)
{
    for (int i = 0; i < PUPIL_ENDS; i++) {
        double far = i < 2 ? region->high[i] : -region->low[i - 2];
        CHECK_NEAR(shape->vignetting[i], 1 - far / STOP, 2e-5, "vignetting");
        CHECK(side->limit[i] == stop || side->limit[i] == rim);
        CHECK(side->limit[i] != stop || region->by_first[i]);
        CHECK(side->limit[i] != rim || region->by_second[i]);
    }
}

/* A ray through a point of the plane of the vertex, with slopes behind it along the light. */
static void check_chief(const struct ray *chief, const double at[2], const double slope[2],
                        double light_direction)
{
    double length = sqrt(1 + slope[0] * slope[0] + slope[1] * slope[1]);
    for (int k = 0; k < 2; k++) {
        CHECK_NEAR(chief->point[k], at[k], 1e-9, "chief ray's place");
        CHECK_NEAR(chief->cosine[k], slope[k] / length, 1e-9, "chief ray's direction");
    }
    CHECK_NEAR(chief->cosine[2], light_direction / length, 1e-9, "chief ray's direction");
}

/*
 * A rim, the stop 20 behind it and an ideal lens 10 behind that, f = 100: for light of slopes p, q
 * the rim stands 20 (p, q) aside in the plane of the stop.
 */
static void test_skew_field(void)
{
    static const char *const texts[] = {"object inf\naperture stop\nsurface - 20 air 16\n"
                                        "stop - 10 air 10\nthick 100 100 air -\n",
                                        "object inf\naperture stop\nsurface - 20 air 16\n"
                                        "stop - 10 air 10\nthick 100 150 1.5 -\n"};
    for (int i = 0; i < 12; i++) {
        struct arena arena = {0};
        double t = (3 + 2 * (i % 5)) * degree, turn = (10 + 30 * i) * degree;
        const struct field_point field = {FIELD_ANGLE,
                                          {atan(tan(t) * sin(turn)), atan(tan(t) * cos(turn))}};
        const struct pupil_shape shape = shape_of(texts[i % 2], field, &arena);
        const double n = i % 2 == 0 ? 1 : 1.5; /* behind the lens */
        const double slope[2] = {tan(t) * sin(turn), tan(t) * cos(turn)};
        const struct region region = region_of((struct disc){0, 0, STOP},
                                               (struct disc){GAP * slope[0], GAP * slope[1], RIM});
        const double zero[2] = {0, 0}, front[2] = {-GAP * slope[0], -GAP * slope[1]};
        const double lens[2] = {10 * slope[0], 10 * slope[1]};
        CHECK(shape.has_chief && shape.status == RAY_OK && shape.surface == 0);
        check_extent(&shape.entrance.pupil, &region, 1, zero, "entrance pupil");
        check_extent(&shape.entrance.vertex, &region, 1, front, "at the rim");
        CHECK_NEAR(shape.exit.pupil.z, -n / 0.09, 1e-12, "n'/z' = 1/100 - 1/10");
        check_extent(&shape.exit.pupil, &region, 1 / 0.9, zero, "exit pupil");
        check_extent(&shape.exit.vertex, &region, 1, lens, "at the lens");
        CHECK_RELATIVE(shape.projected, region.area * cos(t), 1e-6, "projected");
        check_ends(&shape.entrance, &shape, &region, 2, 1);
        check_ends(&shape.exit, &shape, &region, 2, 1);
        check_chief(&shape.entrance.chief, front, slope, 1);
        check_chief(&shape.exit.chief, lens, (double[2]){0.9 / n * slope[0], 0.9 / n * slope[1]},
                    1);
        /* the stop as the point sees it: what of a shift lies along the beam is not seen */
        double s = sin(t), sx = sin(turn), sy = cos(turn);
        for (size_t k = 0; k < shape.count; k++) {
            double x = STOP * shape.stop[k][0], y = STOP * shape.stop[k][1];
            double x2 = shape.across[k][0], y2 = shape.across[k][1], along = s * (x * sx + y * sy);
            CHECK_NEAR(x2 * x2 + y2 * y2, x * x + y * y - along * along, 1e-7, "across the beam");
            CHECK(fabs(hypot(x, y) - STOP) < 1e-6 ||
                  fabs(hypot(x - GAP * slope[0], y - GAP * slope[1]) - RIM) < 1e-6);
        }
        arena_free(&arena);
    }
}

/*
 * From the film: a rim in the last vertex, the stop 30 before it, an ideal lens of f = 100 that is
 * 20 before the stop. From a point h behind the rim this stands in the plane of the stop as a disc
 * of (h + 30)/h its size, -30/h of the way aside. Through the lens the stop is seen 25 behind it,
 * 5/4 as large.
 */
static void test_from_film(void)
{
    static const char *text = "object inf\naperture stop\nthick 100 20 air -\nstop - 30 air 10\n"
                              "surface - 60 air 12\n";
    for (int i = 0; i < 10; i++) {
        struct arena arena = {0};
        double h = 60 + 5 * i, off = 2.5 * i, turn = (20 + 75 * i) * degree;
        const double film[2] = {off * sin(turn), off * cos(turn)};
        const struct pupil_shape shape = film_shape_of(text, film, h, &arena);
        double far = h + 30, wide = far / h, gone = -30 / far;
        const struct region region =
            region_of((struct disc){0, 0, STOP},
                      (struct disc){-30 / h * film[0], -30 / h * film[1], 6 * wide});
        const double zero[2] = {0, 0}, rear[2] = {30 / far * film[0], 30 / far * film[1]};
        const double lens[2] = {-20 / far * film[0], -20 / far * film[1]};
        CHECK(shape.has_chief && !shape.is_empty);
        CHECK_NEAR(shape.exit.pupil.z, -30, 1e-12, "exit pupil's place");
        CHECK_NEAR(shape.entrance.pupil.z, 25, 1e-12, "entrance pupil's place");
        check_extent(&shape.exit.pupil, &region, 1, zero, "exit pupil");
        check_extent(&shape.exit.vertex, &region, h / far, rear, "at the rim");
        check_extent(&shape.entrance.pupil, &region, 1.25, zero, "entrance pupil");
        check_extent(&shape.entrance.vertex, &region, (h + 50) / far, lens, "at the lens");
        check_ends(&shape.entrance, &shape, &region, 2, 3);
        check_ends(&shape.exit, &shape, &region, 2, 3);
        check_chief(&shape.exit.chief, rear, (double[2]){gone / 30 * film[0], gone / 30 * film[1]},
                    -1);
        check_chief(&shape.entrance.chief, lens,
                    (double[2]){0.8 * gone / 30 * film[0], 0.8 * gone / 30 * film[1]}, -1);
        if (region.by_first[0] && region.by_first[1] && region.by_first[2] && region.by_first[3] &&
            off < 5) {
            CHECK_RELATIVE(shape.cosine_area, solid_angle(STOP, far, off), 1e-8, "solid angle");
        }
        arena_free(&arena);
    }
}

/* Farther and farther aside, until the two holes only just overlap; the chief ray is in none. */
static void test_narrow(void)
{
    static const char *text = "object inf\naperture stop\nsurface - 20 air 16\nstop - 10 air 10\n"
                              "thick 100 100 air -\n";
    static const double shifts[] = {8.5, 10, 12, 12.7, 12.97, 12.999, 13.001, 15};
    for (size_t i = 0; i < sizeof shifts / sizeof shifts[0]; i++) {
        struct arena arena = {0};
        double t = atan(shifts[i] / GAP), turn = 0.3 + 2.1 * (double)i;
        const struct field_point field = {FIELD_ANGLE,
                                          {atan(tan(t) * sin(turn)), atan(tan(t) * cos(turn))}};
        const struct pupil_shape shape = shape_of(text, field, &arena);
        CHECK(shape.is_empty == (shifts[i] > 13));
        CHECK(shape.has_chief && shape.status == RAY_CLIPPED && shape.surface == 1);
        if (!shape.is_empty) {
            const struct region region =
                region_of((struct disc){0, 0, STOP},
                          (struct disc){shifts[i] * sin(turn), shifts[i] * cos(turn), RIM});
            CHECK_RELATIVE(shape.entrance.pupil.area, region.area, 1e-6, "area");
            CHECK_NEAR(shape.entrance.pupil.centre[0], region.centre[0], 1e-5, "centroid");
            CHECK_NEAR(shape.entrance.pupil.centre[1], region.centre[1], 1e-5, "centroid");
        }
        arena_free(&arena);
    }
}

/*
 * A disc of the radius 2 blocks the stop off its middle, 20 behind the first face and 10 before an
 * ideal lens of f = 100; from infinity along slopes, or from a point 60 before the first face.
 */
static void test_blocked(void)
{
    static const char *const texts[] = {
        "object inf\naperture stop\nsurface - 20 air -\nstop - 10 air 10\n"
        "block circle 4 decenter=1.5,-0.7\nthick 100 100 air -\n",
        "object 60\naperture stop\nsurface - 20 air -\nstop - 10 air 10\n"
        "block circle 4 decenter=1.5,-0.7\nthick 100 100 air -\n"};
    const double clear = 25 - 4, centre[2] = {-4 * 1.5 / clear, 4 * 0.7 / clear};
    for (int i = 0; i < 6; i++) {
        struct arena arena = {0};
        const bool near = i % 2 == 1;
        const double slope[2] = {0.05 * i, 0.2 - 0.06 * i}, object[2] = {3. * i, 7 - 2. * i};
        const struct field_point far = {FIELD_ANGLE, {atan(slope[0]), atan(slope[1])}},
                                 point = {FIELD_HEIGHT, {object[0], object[1]}};
        const struct pupil_shape shape = shape_of(texts[i % 2], near ? point : far, &arena);
        /* a point s of the stop is at m s + shift in the plane of the first face, and the lens */
        const double front = near ? 0.75 : 1, lens = near ? 9 / 8. : 1;
        CHECK_RELATIVE(shape.entrance.pupil.area, clear * pi, 1e-8, "of the stop");
        CHECK_RELATIVE(shape.entrance.vertex.area, front * front * clear * pi, 1e-8, "before it");
        CHECK_RELATIVE(shape.exit.pupil.area, clear * pi / 0.81, 1e-8, "its image");
        CHECK_RELATIVE(shape.exit.vertex.area, lens * lens * clear * pi, 1e-8, "at the lens");
        for (int k = 0; k < 2; k++) {
            const double before = near ? 0.25 * object[k] : -20 * slope[k];
            const double behind = near ? -object[k] / 8 : 10 * slope[k];
            CHECK_NEAR(shape.entrance.pupil.centre[k], centre[k], 1e-8, "centroid");
            CHECK_NEAR(shape.entrance.vertex.centre[k], front * centre[k] + before, 1e-8, "before");
            CHECK_NEAR(shape.exit.pupil.centre[k], centre[k] / 0.9, 1e-8, "of its image");
            CHECK_NEAR(shape.exit.vertex.centre[k], lens * centre[k] + behind, 1e-8, "behind");
        }
        arena_free(&arena);
    }
}

/* Nothing arrives: the surface that is in the way of the chief ray. No stop, no radius: refused. */
static void test_nothing(void)
{
    struct arena arena = {0};
    static const char *text = "object inf\naperture stop\nsurface - 20 air 16\nstop - 10 air 10\n"
                              "thick 100 100 air -\n";
    const struct field_point field = {FIELD_ANGLE, {20 * degree, 30 * degree}};
    const struct pupil_shape shape = shape_of(text, field, &arena);
    CHECK(shape.is_empty && shape.has_chief);
    CHECK(shape.status == RAY_CLIPPED && shape.surface == 1);
    arena_free(&arena);
}

int main(void)
{
    test_skew_field();
    test_from_film();
    test_blocked();
    test_nothing();
    test_narrow();
    test_cats_eye();
    test_near_object();
    test_exit();
    test_grazing();
    test_fold();
    return check_report();
}
