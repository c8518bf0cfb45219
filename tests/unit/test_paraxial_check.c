/* tests/unit/test_paraxial_check.c - exact rays beside paraxial ones, both by closed forms. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/paraxial_check.h"

#include "analysis/setup/setup.h"
#include "base/constants.h"
#include "check.h"
#include "lens_of.h"

static const double degree = RADIANS_PER_DEGREE;

/* A lens made ready. */
struct bench {
    struct lens lens;
    struct setup setup;
    struct setup_light light;
    struct check_problem problem;
};

static void open_bench(const char *text, enum lens_section section, double plane,
                       struct arena *arena, struct bench *bench)
{
    struct error error = {0};
    *bench = (struct bench){.lens = lens_of(text, arena)};
    const struct setup_question question = {
        .lens = &bench->lens, .section = section, .wavelength = NAN, .fnumber = NAN};
    const bool opened = setup_open(&question, arena, &bench->setup, &error) &&
                        setup_light(&bench->setup, 0, &bench->light, &error);
    bench->problem = (struct check_problem){.first = &bench->light.first,
                                            .object = bench->setup.object,
                                            .section = section,
                                            .plane = plane,
                                            .field = bench->setup.fields[0].point};
    if (opened) {
        bench->problem.forward = setup_system(&bench->setup, 0, SETUP_OPEN, &error);
        bench->problem.backward = setup_system(&bench->setup, 0, SETUP_REVERSED, &error);
    }
    CHECK(bench->problem.forward != NULL && bench->problem.backward != NULL);
    if (bench->problem.backward == NULL) {
        printf("%s: %s\n", text, error.message);
    }
}

static void check_value(const struct bench *bench, enum check_quantity quantity, double fraction,
                        struct arena *arena, const double expected[3], const char *what)
{
    const struct check_value value = paraxial_check_at(&bench->problem, quantity, fraction, arena);
    CHECK(value.status == RAY_OK && value.surface == 0);
    CHECK_NEAR(value.paraxial, expected[0], 1e-12 * fmax(1, fabs(expected[0])), what);
    CHECK_NEAR(value.exact, expected[1], 1e-12 * fmax(1, fabs(expected[1])), what);
    if (isnan(expected[2])) {
        CHECK(isnan(value.scale));
    } else {
        CHECK_RELATIVE(value.scale, expected[2], 1e-12, what);
    }
}

/*
 * A sphere of R = 200 mm: a ray at the height h comes in at sin i = h/R, leaves at 2 i to the axis
 * and crosses it R/2cos i from the centre.
 */
static void check_mirror(enum lens_section section)
{
    const double R = 200, plane = -100;
    struct arena arena = {0};
    struct bench bench;
    open_bench("wavelength d\nobject inf\naperture stop\nsurface -200 -100 mirror 80 stop\n",
               section, plane, &arena, &bench);
    for (int k = 1; k <= 4; k++) {
        const double fraction = k / 4., h = 40 * fraction, i = asin(h / R);
        const double cross = -(R - R / (2 * cos(i))), sag = R - R * cos(i);
        const double rows[][3] = {
            [CHECK_EFL] = {100, 100 / cos(i), 100},
            [CHECK_BFL] = {-100, cross, 100},
            [CHECK_REAR_PRINCIPAL] = {0, -sag, 100},
            [CHECK_FFL] = {-100, cross, 100},
            [CHECK_FRONT_PRINCIPAL] = {0, -sag, 100},
            [CHECK_FNUMBER] = {R / (4 * h), 1 / (2 * sin(2 * i)), R / (4 * h)},
            [CHECK_TRANSVERSE] = {0, (cross - plane) * -tan(2 * i), NAN},
        };
        const enum check_quantity asked[] = {
            CHECK_EFL,     CHECK_BFL,       CHECK_REAR_PRINCIPAL, CHECK_FFL, CHECK_FRONT_PRINCIPAL,
            CHECK_FNUMBER, CHECK_TRANSVERSE};
        for (size_t q = 0; q < sizeof asked / sizeof asked[0]; q++) {
            check_value(&bench, asked[q], fraction, &arena, rows[asked[q]], "of a mirror");
            const struct check_value value =
                paraxial_check_at(&bench.problem, asked[q], fraction, &arena);
            CHECK_NEAR(value.height, h, 1e-12, "height");
            CHECK_RELATIVE(value.fnumber, 100 / (2 * h), 1e-12, "f-number");
            CHECK(isnan(value.angle));
        }
    }
    arena_free(&arena);
}

/*
 * A thick glass with flat faces between two media: n sin t is kept. The stop lies 30 mm behind the
 * first face and 12 mm before the last. From infinity at 40 degrees, or from a point 50 mm aside.
 */
static void check_slab(enum lens_section section, const double n[3], bool near)
{
    const size_t axis = section == SECTION_X ? 0 : 1;
    const double plane = 70, front = 30 * n[0] / n[1], back = 12 * n[2] / n[1];
    struct arena arena = {0};
    struct bench bench;
    open_bench(arena_printf(&arena,
                            "wavelength d\nobject %s\naperture stop\n%smedium %g\n"
                            "surface - 30 %g -\nstop - 12 %g 20\nsurface - 0 %g -\n",
                            near ? "60" : "inf", near ? "" : "focus afocal\n", n[0], n[1], n[1],
                            n[2]),
               section, plane, &arena, &bench);
    bench.problem.field = (struct field_point){near ? FIELD_HEIGHT : FIELD_ANGLE, {0, 0}};
    bench.problem.field.value[axis] = near ? -50 : 40 * degree;
    for (int kept = 0; kept < 2; kept++) {
        bench.problem.chiefs =
            kept == 0 ? NULL : ARENA_ARRAY(&arena, CHECK_CHIEFS, struct check_chief);
        for (int k = 1; k <= 4; k++) {
            const double fraction = k / 4.;
            double low = 0, high = 40 * degree, t = high * fraction, u = 0;
            for (int i = 0; i < 60; i++) { /* the chief ray of a point by halving */
                t = near ? (low + high) / 2 : t;
                u = asin(n[0] * sin(t) / n[1]);
                const bool is_below = 60 * tan(t) + 30 * tan(u) < 50 * fraction;
                low = is_below ? t : low;
                high = is_below ? high : t;
            }
            const double w = asin(n[0] * sin(t) / n[2]),
                         slope = near ? 50 * fraction / (60 + front) : tan(t);
            const double height = (12 * n[0] / n[1] + plane * n[0] / n[2]) * slope;
            const double rows[][3] = {
                [CHECK_IMAGE_HEIGHT] = {height, 12 * tan(u) + plane * tan(w), height},
                [CHECK_ANGULAR_MAGNIFICATION] = {n[0] / n[2], tan(w) / tan(t), n[0] / n[2]},
                [CHECK_ENTRANCE_PUPIL] = {front, 30 * tan(u) / tan(t), 42},
                [CHECK_EXIT_PUPIL] = {-back, -12 * tan(u) / tan(w), 42},
            };
            for (int q = CHECK_IMAGE_HEIGHT; q <= CHECK_EXIT_PUPIL; q++) {
                const enum check_quantity asked = (enum check_quantity)q;
                check_value(&bench, asked, fraction, &arena, rows[q], "of a slab");
                const struct check_value value =
                    paraxial_check_at(&bench.problem, asked, fraction, &arena);
                CHECK(near || fabs(value.angle - t) < 1e-14);
                CHECK(isnan(value.height) && isnan(value.fnumber));
            }
        }
    }
    const double exit_angle[] = {0, 0, NAN};
    if (!near) {
        check_value(&bench, CHECK_EXIT_ANGLE, 0.5, &arena, exit_angle, "it stays parallel");
    }
    arena_free(&arena);
}

/* An object 60 mm before a plane of n': its image lies 60 tan U/tan U' before it. */
static void check_near_object(double n)
{
    struct arena arena = {0};
    struct bench bench;
    open_bench(arena_printf(&arena,
                            "wavelength d\nobject 60\naperture stop\nmedium %g\n"
                            "surface - 10 1.5 40 stop\n",
                            n),
               SECTION_Y, -80, &arena, &bench);
    const double far = 60 * 1.5 / n;
    for (int k = 1; k <= 4; k++) {
        const double h = 5 * k, U = atan(h / 60), V = asin(n * sin(U) / 1.5), back = -h / tan(V);
        const double one[] = {1, 1, 1};
        const struct check_value value =
            paraxial_check_at(&bench.problem, CHECK_IMAGE, k / 4., &arena);
        CHECK_NEAR(value.paraxial, -far, 1e-12, "image");
        CHECK_NEAR(value.exact, back, 1e-11, "image");
        CHECK_NEAR(value.height, h, 1e-12, "height");
        check_value(&bench, CHECK_MAGNIFICATION, k / 4., &arena, one, "n sin U is kept");
        const double miss[] = {h - 80 * h / far, h - 80 * tan(V), NAN};
        check_value(&bench, CHECK_TRANSVERSE, k / 4., &arena, miss, "at a plane");
        const double paraxial = 1 / (2 * 1.5 * h / far), exact = 1 / (2 * 1.5 * sin(V));
        const double fnumber[] = {paraxial, exact, paraxial};
        check_value(&bench, CHECK_FNUMBER, k / 4., &arena, fnumber, "n' sin U'");
    }
    arena_free(&arena);
}

/* -------- how they shrink -------- */

static void check_orders(void)
{
    struct arena arena = {0};
    struct bench bench;
    open_bench("wavelength d\nobject inf\naperture stop\nsurface -200 -100 mirror 80 stop\n",
               SECTION_Y, -100, &arena, &bench);
    struct check_order order = paraxial_check_order(&bench.problem, CHECK_BFL, &arena);
    CHECK_NEAR(order.order, 2, 0.02, "a place goes as h^2");
    CHECK(!order.is_equal);
    /* 100 (1/cos i - 1) is 2 h^2/800; it is off by a tenth where that is as 1e-13 of 100: at about
       3e-5 of 40 mm, and rounding may be more or less */
    CHECK(order.rounding == 0 || (order.rounding > 1e-6 && order.rounding < 1e-3));
    order = paraxial_check_order(&bench.problem, CHECK_FNUMBER, &arena);
    CHECK_NEAR(order.order, 2, 0.02, "and a ratio");
    order = paraxial_check_order(&bench.problem, CHECK_TRANSVERSE, &arena);
    CHECK_NEAR(order.order, 3, 0.03, "a height as h^3");
    /* 1/cos i - 1 <= tolerance, at cos i = 1/(1 + tolerance), and sin i = h/200 */
    for (double tolerance = 1e-4; tolerance < 0.01; tolerance *= 3) {
        const double cosine = 1 / (1 + tolerance), h = 200 * sqrt(1 - cosine * cosine);
        CHECK_RELATIVE(paraxial_check_trusted(&bench.problem, CHECK_EFL, tolerance, &arena), h / 40,
                       1e-7, "as far as it is trusted");
    }
    CHECK(paraxial_check_trusted(&bench.problem, CHECK_EFL, 0.03, &arena) == 1);
    CHECK(isnan(paraxial_check_trusted(&bench.problem, CHECK_TRANSVERSE, 0.03, &arena)));
    CHECK(paraxial_check_trusted(&bench.problem, CHECK_EFL, 0, &arena) == 0);
    /* a paraboloid has the paraxial focus */
    open_bench("wavelength d\nobject inf\naperture stop\nsurface -200 -100 mirror 80 k=-1 stop\n",
               SECTION_Y, -100, &arena, &bench);
    order = paraxial_check_order(&bench.problem, CHECK_BFL, &arena);
    CHECK(order.is_equal && isnan(order.order) && order.rounding == 0);
    CHECK(paraxial_check_trusted(&bench.problem, CHECK_BFL, 1e-9, &arena) == 1);
    arena_free(&arena);
}

/* -------- which there are -------- */

static void check_which(void)
{
    static const struct {
        bool near, afocal, chief; /* chief: a stop and a field */
        const char *applies;      /* one letter a quantity, in their order */
    } rows[] = {
        {false, false, true, "yyyyynnnyyynyy"},  {true, false, true, "nnnnnyynyyynyy"},
        {false, true, true, "nnnnnnnyyyyyyy"},   {true, true, true, "nnnnnyynyyynyy"},
        {false, false, false, "yyyyynnnyynnnn"}, {false, true, false, "nnnnnnnyyynnnn"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        /* without a chief ray: no stop, or no field */
        for (int lacks = rows[i].chief ? 0 : 1; lacks < (rows[i].chief ? 1 : 4); lacks++) {
            const struct system system = {.stop = (lacks & 1) != 0 ? LENS_NONE : 0};
            const struct first_order first = {.is_afocal = rows[i].afocal};
            const struct check_problem problem = {
                .forward = &system,
                .first = &first,
                .object = {.is_infinite = !rows[i].near},
                .field = {(lacks & 2) != 0 ? FIELD_NONE : FIELD_ANGLE, {0, 0.1}}};
            for (int q = 0; q < CHECK_QUANTITIES; q++) {
                CHECK(paraxial_check_applies(&problem, (enum check_quantity)q) ==
                      (rows[i].applies[q] == 'y'));
            }
        }
    }
    /* what lies infinitely far away has no number */
    const struct system system = {.stop = 0};
    const struct first_order first = {
        .image = INFINITY, .entrance_pupil = INFINITY, .exit_pupil = -INFINITY};
    const struct check_problem problem = {
        .forward = &system, .first = &first, .plane = NAN, .field = {FIELD_ANGLE, {0, 0.1}}};
    for (int q = CHECK_IMAGE; q < CHECK_QUANTITIES; q++) {
        CHECK(!paraxial_check_applies(&problem, (enum check_quantity)q));
    }
    CHECK(!paraxial_check_applies(&problem, CHECK_QUANTITIES));
    for (int q = 0; q < CHECK_QUANTITIES; q++) {
        CHECK(paraxial_check_is_of_field((enum check_quantity)q) == (q >= CHECK_IMAGE_HEIGHT));
    }
}

int main(void)
{
    check_mirror(SECTION_X);
    check_mirror(SECTION_Y);
    static const double air[] = {1, 1.5, 1}, media[] = {1.33, 1.5, 1.2};
    check_slab(SECTION_X, air, false);
    check_slab(SECTION_Y, air, false);
    check_slab(SECTION_Y, media, false);
    check_slab(SECTION_X, air, true);
    check_slab(SECTION_Y, media, true);
    check_near_object(1);
    check_near_object(1.2);
    check_orders();
    check_which();
    return check_report();
}
