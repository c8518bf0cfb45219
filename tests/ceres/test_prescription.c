/* tests/ceres/test_prescription.c - lenses that get the figures measured of them. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "design/prescription.h"
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
    const struct prescription_part parts[4] = {{PART_RADIUS, 0, -none, none},
                                               {PART_RADIUS, 1, -none, none},
                                               {PART_GAP, 0, -none, none},
                                               {PART_INDEX, 0, -none, none}};
    struct arena arena = {0};
    struct prescription_fit fit;
    struct error error;
    const struct lens lens = lens_of("surface 55 7 1.62 -\nsurface -100 - air -\n", &arena);
    CHECK(prescription_fit(&lens, goals, 4, parts, 4, &arena, &fit, &error));
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
    const struct prescription_part free_parts[2] = {{PART_RADIUS, 0, -none, none},
                                                    {PART_RADIUS, 1, -none, none}};
    const struct prescription_part bounded[2] = {{PART_RADIUS, 0, 99, 100.5},
                                                 {PART_GAP, 0, 4.9, 5.1}};
    struct arena arena = {0};
    struct prescription_fit fit;
    struct error error;
    const struct lens lens = lens_of("surface 100 5 1.5 -\nsurface -100 - air -\n", &arena);
    CHECK(prescription_fit(&lens, goals, 1, free_parts, 2, &arena, &fit, &error));
    CHECK(fit.is_loose);
    CHECK_RELATIVE(fit.reached[0], 101.0, 1e-9, "goal");
    /* the lens is alike from both sides: both radii change alike */
    CHECK_NEAR(fit.values[0] + fit.values[1], 0, 1e-6, "alike");
    CHECK(isnan(fit.errors[0]));
    goals[0].value = 103;
    goals[1].value = 103 * 0.2;
    CHECK(prescription_fit(&lens, goals, 2, bounded, 2, &arena, &fit, &error));
    CHECK_RELATIVE(fit.values[0], 100.5, 1e-12, "R1 at its bound");
    CHECK(fit.summary.at_bound[0] && fit.values[1] >= 4.9 && fit.values[1] <= 5.1);
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
    CHECK(!prescription_fit(&lens, &goal, 1, &part, 1, &arena, &fit, &error));
    CHECK(error.code == ERROR_DOMAIN && strstr(error.message, word) != NULL);
    arena_free(&arena);
}

int main(void)
{
    test_singlet();
    test_loose_and_bounds();
    check_refused((struct prescription_part){PART_RADIUS, 4, -none, none}, "no radius 5");
    check_refused((struct prescription_part){PART_GAP, 3, -none, none}, "no gap 4");
    check_refused((struct prescription_part){PART_RADIUS, 1, -none, none}, "no radius to vary");
    check_refused((struct prescription_part){PART_INDEX, 2, -none, none}, "no index of its own");
    check_refused((struct prescription_part){PART_RADIUS, 0, -10, 200}, "one sign");
    check_refused((struct prescription_part){PART_GAP, 0, 6, 7}, "outside its bounds");
    return check_report();
}
