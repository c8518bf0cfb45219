/* tests/ceres/test_prescription.c - lenses that get the figures measured of them. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "design/fit/prescription.h"
#include "file/lens_file.h"
#include "optics/first_order.h"

static struct lens lens_of(const char *text, struct arena *arena)
{
    struct lens lens;
    struct error error;
    CHECK(lens_read("test.lens", text_of(text), NULL, arena, &lens, &error));
    return lens;
}

static const double none = INFINITY;

/* A thick singlet by the lensmaker's formula: R1 60, R2 -90, t 8, n 1.6. */
static void test_singlet(void)
{
    double P1 = 0.6 / 60, P2 = -0.6 / -90, t = 8, n = 1.6, P = P1 + P2 - t / n * P1 * P2;
    const struct prescription_goal goals[4] = {
        {GOAL_EFL, 1 / P, 1, 0.55, NAN},
        {GOAL_BFL, (1 - t / n * P1) / P, 1, 0.55, NAN},
        {GOAL_FFL, -(1 - t / n * P2) / P, 1, 0.55, NAN},
        {GOAL_LENGTH, 8, 1, 0.55, NAN},
    };
    const struct prescription_part parts[4] = {{{0, PARAMETER_RADIUS, 0}, -none, none},
                                               {{1, PARAMETER_RADIUS, 0}, -none, none},
                                               {{0, PARAMETER_THICKNESS, 0}, -none, none},
                                               {{0, PARAMETER_INDEX, 0}, -none, none}};
    struct arena arena = {0};
    struct prescription_fit fit;
    struct error error;
    const struct lens lens = lens_of("surface 55 7 1.62 -\nsurface -100 - air -\n", &arena);
    CHECK(prescription_fit(&lens, &(struct prescription_task){goals, 4, parts, 4, {0}}, &arena,
                           &fit, &error));
    CHECK(fit.summary.status == SOLVER_CONVERGED);
    for (int g = 0; g < 4; g++) {
        CHECK_RELATIVE(fit.reached[g], goals[g].value, 1e-11, "goal");
    }
    CHECK_RELATIVE(fit.values[0], 60.0, 1e-8, "R1");
    CHECK_RELATIVE(fit.values[1], -90.0, 1e-8, "R2");
    CHECK_RELATIVE(fit.values[2], 8.0, 1e-9, "t");
    CHECK_RELATIVE(fit.values[3], 1.6, 1e-9, "n");
    /* and the lens that is written has them */
    struct first_order first;
    const struct lens all = prescription_apply(&lens, parts, 4, &fit, &arena);
    struct text text = lens_write(&all, &arena);
    struct lens again;
    CHECK(lens_read("again.lens", text, NULL, &arena, &again, &error));
    CHECK(first_order_of_lens(&again, 0.55, SECTION_Y, &arena, &first, &error));
    CHECK_RELATIVE(first.efl, goals[0].value, 1e-11, "efl of the new lens");
    CHECK_RELATIVE(first.bfl, goals[1].value, 1e-11, "bfl of the new lens");
    arena_free(&arena);
}

/* Fewer goals than parts: met, and no part moves more than it must; bounds hold. */
static void test_loose_and_bounds(void)
{
    struct prescription_goal goals[2] = {{GOAL_EFL, 101, 1, 0.55, NAN},
                                         {GOAL_HEIGHT, 101 * 0.2, 1, 0.55, 0.19739555984988}};
    const struct prescription_part free_parts[2] = {{{0, PARAMETER_RADIUS, 0}, -none, none},
                                                    {{1, PARAMETER_RADIUS, 0}, -none, none}};
    const struct prescription_part bounded[2] = {{{0, PARAMETER_RADIUS, 0}, 99, 100.5},
                                                 {{0, PARAMETER_THICKNESS, 0}, 4.9, 5.1}};
    struct arena arena = {0};
    struct prescription_fit fit;
    struct error error;
    const struct lens lens = lens_of("surface 100 5 1.5 -\nsurface -100 - air -\n", &arena);
    CHECK(prescription_fit(&lens, &(struct prescription_task){goals, 1, free_parts, 2, {0}}, &arena,
                           &fit, &error));
    CHECK(fit.is_loose);
    CHECK_RELATIVE(fit.reached[0], 101.0, 1e-9, "goal");
    /* the lens is alike from both sides: both radii change alike */
    CHECK_NEAR(fit.values[0] + fit.values[1], 0, 1e-6, "alike");
    CHECK(isnan(fit.errors[0]));
    goals[0].value = 103;
    goals[1].value = 103 * 0.2;
    CHECK(prescription_fit(&lens, &(struct prescription_task){goals, 2, bounded, 2, {0}}, &arena,
                           &fit, &error));
    CHECK_RELATIVE(fit.values[0], 100.5, 1e-12, "R1 at its bound");
    CHECK(fit.summary.at_bound[0] && fit.values[1] >= 4.9 && fit.values[1] <= 5.1);
    arena_free(&arena);
}

/*
 * What is not fixed moves least, each against its size: two curvatures of a thin lens, its power
 * 0.5 (c1 - c2), and two lengths that add up. A curvature has at least the size 1e-4, a length 0.1.
 */
static void test_sizes(void)
{
    static const double curvature[][2] = {{0.02, -0.005}, {0.02, 0}};
    const struct prescription_part radii[2] = {{{0, PARAMETER_RADIUS, 0}, -none, none},
                                               {{1, PARAMETER_RADIUS, 0}, -none, none}};
    const struct prescription_part lengths[2] = {{{0, PARAMETER_THICKNESS, 0}, -none, none},
                                                 {{1, PARAMETER_THICKNESS, 0}, -none, none}};
    struct arena arena = {0};
    struct prescription_fit fit;
    struct error error;
    for (int i = 0; i < 2; i++) {
        const double *c = curvature[i], power = 0.5 * (c[0] - c[1]) * 1.01;
        const double size[2] = {c[0] * c[0], fmax(c[1] * c[1], 1e-8)};
        const double more = (power / 0.5 - c[0] + c[1]) / (size[0] + size[1]);
        const struct prescription_goal goal = {GOAL_EFL, 1 / power, 1, 0.55, NAN};
        const struct lens lens = lens_of(i == 0 ? "surface 50 0 1.5 -\nsurface -200 - air -\n"
                                                : "surface 50 0 1.5 -\nsurface - - air -\n",
                                         &arena);
        CHECK(prescription_fit(&lens, &(struct prescription_task){&goal, 1, radii, 2, {0}}, &arena,
                               &fit, &error));
        CHECK_NEAR((1 / fit.values[0] - c[0]) / (size[0] * more), 1, 1e-3, "c1");
        CHECK_NEAR((1 / fit.values[1] - c[1]) / (-size[1] * more), 1, 1e-3, "c2");
    }
    const struct prescription_goal goal = {GOAL_LENGTH, 2.33, 1, 0.55, NAN};
    const struct lens lens =
        lens_of("surface 50 2 1.5 -\nsurface -50 0.01 1.6 -\nsurface - - air -\n", &arena);
    CHECK(prescription_fit(&lens, &(struct prescription_task){&goal, 1, lengths, 2, {0}}, &arena,
                           &fit, &error));
    CHECK_NEAR(fit.values[0], 2 + 0.32 * 4 / 4.01, 1e-5, "t1");
    CHECK_NEAR(fit.values[1], 0.01 + 0.32 * 0.01 / 4.01, 1e-5, "t2");
    arena_free(&arena);
}

/* Power of a Mangin mirror by hand: in through R1, back from R2, out through R1. */
static double mangin_power(double n, double R1, double R2, double t)
{
    const double powers[3] = {(n - 1) / R1, -2 * n / R2, (n - 1) / R1};
    double y = 1, v = 0;
    for (int i = 0; i < 3; i++) {
        v -= y * powers[i];
        y += i < 2 ? v * t / n : 0;
    }
    return -v;
}

/* The glass of a Mangin mirror is passed twice, and the index on both ways is one number. */
static void test_mangin(void)
{
    double P = mangin_power(1.6, -60, -90, 6);
    const struct prescription_goal goal = {GOAL_EFL, 1 / P, 1, 0.55, NAN};
    const struct prescription_part part = {{0, PARAMETER_INDEX, 0}, -none, none};
    struct arena arena = {0};
    struct prescription_fit fit;
    struct error error;
    struct first_order first;
    const struct lens lens =
        lens_of("surface -60 6 1.5 -\nsurface -90 -6 mirror -\nsurface -60 - air -\n", &arena);
    CHECK(prescription_fit(&lens, &(struct prescription_task){&goal, 1, &part, 1, {0}}, &arena,
                           &fit, &error));
    CHECK_RELATIVE(fit.reached[0], 1 / P, 1e-11, "efl");
    CHECK_RELATIVE(fit.values[0], 1.6, 1e-9, "n");
    CHECK(fit.summary.iterations <= 8); /* the derivative is that of both ways */
    const struct lens all = prescription_apply(&lens, &part, 1, &fit, &arena);
    CHECK(first_order_of_lens(&all, 0.55, SECTION_Y, &arena, &first, &error));
    CHECK_RELATIVE(first.efl, 1 / P, 1e-11, "efl of the new lens");
    arena_free(&arena);
}

static const char double_gauss[] =
    "surface 58.95 7.52 1.67 -\nsurface 169.66 .24 air -\nsurface 38.55 8.05 1.67 -\n"
    "surface 81.54 6.55 1.699 -\nsurface 25.5 11.41 air -\nstop - 9 air 34.2\n"
    "surface -28.99 2.36 1.603 -\nsurface 81.54 12.13 1.658 -\nsurface -40.77 .38 air -\n"
    "surface 874.13 6.44 1.717 -\nsurface -79.46 - air -\n";

/*
 * Power is linear in a curvature, so that a lens turns from positive to negative through no power
 * at all: no way leads there over ever shorter focal lengths. Radii by exact rational arithmetic
 * from P = P(0) + c (P(1) - P(0)).
 */
static void test_through_afocal(void)
{
    const struct prescription_goal goals[3] = {{GOAL_EFL, -100, 0.01, 0.55, NAN},
                                               {GOAL_EFL, 101, 0.01, 0.55, NAN},
                                               {GOAL_HEIGHT, -20, 0.01, 0.55, 0.19739555984988}};
    const double radii[3] = {-26.134793179408963, 59.219775782694242, -26.134793179408963};
    const struct prescription_part part = {{0, PARAMETER_RADIUS, 0}, -none, none};
    struct arena arena = {0};
    struct prescription_fit fit;
    struct error error;
    const struct lens lens = lens_of(double_gauss, &arena);
    for (int g = 0; g < 3; g++) {
        CHECK(prescription_fit(&lens, &(struct prescription_task){&goals[g], 1, &part, 1, {0}},
                               &arena, &fit, &error));
        CHECK_RELATIVE(fit.reached[0], goals[g].value, 1e-11, "goal");
        CHECK_RELATIVE(fit.values[0], radii[g], 1e-11, "R1");
    }
    arena_free(&arena);
}

/* A plane plate is where a lens may begin: 2 c (n - 1) - c^2 t (n - 1)^2/n = 1/f, symmetric. */
static void test_from_plate(void)
{
    const struct prescription_goal goals[1] = {{GOAL_EFL, 100, 0.01, 0.55, NAN}};
    const struct prescription_part parts[2] = {{{0, PARAMETER_RADIUS, 0}, -none, none},
                                               {{1, PARAMETER_RADIUS, 0}, -none, none}};
    struct arena arena = {0};
    struct prescription_fit fit;
    struct error error;
    const struct lens lens = lens_of("surface - 5 1.5 -\nsurface - - air -\n", &arena);
    double c = (1 - sqrt(1 - 5 * 0.01 / 1.5)) / (5 * 0.5 / 1.5);
    CHECK(prescription_fit(&lens, &(struct prescription_task){goals, 1, parts, 2, {0}}, &arena,
                           &fit, &error));
    CHECK_RELATIVE(fit.reached[0], 100.0, 1e-9, "efl");
    double bfl = 100 * (1 - 5 / 1.5 * 0.5 * c);
    const struct prescription_goal both[2] = {goals[0], {GOAL_BFL, bfl, 0.01, 0.55, NAN}};
    CHECK(prescription_fit(&lens, &(struct prescription_task){both, 2, parts, 2, {0}}, &arena, &fit,
                           &error));
    CHECK_RELATIVE(fit.values[0], 1 / c, 1e-9, "R1");
    CHECK_RELATIVE(fit.values[1], -1 / c, 1e-9, "R2");
    arena_free(&arena);
}

/* A thin lens before an ideal one of f2 = 80, a gap between: 1/f = 1/f1 + 1/f2 - t/(f1 f2). */
static void test_ideal(void)
{
    const struct prescription_goal goal = {GOAL_EFL, 75, 0.01, 0.55, NAN};
    const struct prescription_part part = {{0, PARAMETER_THICKNESS, 0}, -none, none};
    struct arena arena = {0};
    struct prescription_fit fit;
    struct error error;
    const struct lens lens = lens_of("thick 100 20 air -\nthick 80 - air -\n", &arena);
    CHECK(prescription_fit(&lens, &(struct prescription_task){&goal, 1, &part, 1, {0}}, &arena,
                           &fit, &error));
    CHECK_RELATIVE(fit.values[0], (1.0 / 100 + 1.0 / 80 - 1.0 / 75) * 8000, 1e-9, "gap");
    arena_free(&arena);
}

/* What one radius cannot do is as near as it gets, and is not far: 101 and 99 meet at 100. */
static void test_contradiction(void)
{
    const struct prescription_goal goals[2] = {{GOAL_EFL, 101, 0.1, 0.55, NAN},
                                               {GOAL_EFL, 99, 0.1, 0.55, NAN}};
    const struct prescription_part part = {{0, PARAMETER_RADIUS, 0}, -none, none};
    struct arena arena = {0};
    struct prescription_fit fit;
    struct error error;
    const struct lens lens = lens_of(double_gauss, &arena);
    CHECK(prescription_fit(&lens, &(struct prescription_task){goals, 2, &part, 1, {0}}, &arena,
                           &fit, &error));
    /* weights f^2/deviation: P = (101^4/101 + 99^4/99)/(101^4 + 99^4) */
    double up = pow(101, 4), down = pow(99, 4);
    CHECK_RELATIVE(fit.reached[0], (up + down) / (up / 101 + down / 99), 1e-10, "between");
    arena_free(&arena);
}

static void check_bad_goal(struct prescription_goal goal, const char *word)
{
    const struct prescription_part part = {{0, PARAMETER_RADIUS, 0}, -none, none};
    struct arena arena = {0};
    struct prescription_fit fit;
    struct error error;
    const struct lens lens = lens_of(double_gauss, &arena);
    CHECK(!prescription_fit(&lens, &(struct prescription_task){&goal, 1, &part, 1, {0}}, &arena,
                            &fit, &error));
    CHECK(error.code == ERROR_DOMAIN && strstr(error.message, word) != NULL);
    arena_free(&arena);
}

static void check_refused(struct prescription_part part, const char *word)
{
    const struct prescription_goal goal = {GOAL_EFL, 100, 1, 0.55, NAN};
    struct arena arena = {0};
    struct prescription_fit fit;
    struct error error;
    const struct lens lens = lens_of(
        "surface 100 5 1.5 -\nstop - 5 air 3\nsurface -100 5 {d 1.5} -\nsurface 50 - air -\n",
        &arena);
    CHECK(!prescription_fit(&lens, &(struct prescription_task){&goal, 1, &part, 1, {0}}, &arena,
                            &fit, &error));
    CHECK(error.code == ERROR_DOMAIN && strstr(error.message, word) != NULL);
    arena_free(&arena);
}

int main(void)
{
    test_singlet();
    test_loose_and_bounds();
    test_sizes();
    test_mangin();
    test_through_afocal();
    test_from_plate();
    test_ideal();
    test_contradiction();
    check_bad_goal((struct prescription_goal){GOAL_EFL, 0, 1, 0.55, NAN}, "focal length of 0");
    check_bad_goal((struct prescription_goal){GOAL_HEIGHT, 0, 1, 0.55, 0.1}, "height of 0");
    check_bad_goal((struct prescription_goal){GOAL_HEIGHT, 5, 1, 0.55, 0}, "on the axis");
    check_refused((struct prescription_part){{4, PARAMETER_RADIUS, 0}, -none, none}, "no radius 5");
    check_refused((struct prescription_part){{3, PARAMETER_THICKNESS, 0}, -none, none},
                  "no thickness 4");
    check_refused((struct prescription_part){{1, PARAMETER_RADIUS, 0}, -none, none},
                  "no radius to vary");
    check_refused((struct prescription_part){{2, PARAMETER_INDEX, 0}, -none, none},
                  "no index of its own");
    check_refused((struct prescription_part){{0, PARAMETER_RADIUS, 0}, -10, 200}, "one sign");
    check_refused((struct prescription_part){{0, PARAMETER_THICKNESS, 0}, 6, 7},
                  "outside its bounds");
    return check_report();
}
