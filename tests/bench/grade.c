/* tests/bench/grade.c - what each error of a grade does alone, against making a lens ready. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "cli/options/tolerances.h"
#include "clock.h"
#include "design/tolerance/sensitivity.h"
#include "design/tolerance/tolerance_trial.h"
#include "exchange/lens_open.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/*
 * Prints one figure a line, "name value", ms: all sensitivities of the double Gauss with the grade
 * `precision`, of its fields and wavelengths with best focus, by 21 rays each of the whole pupil
 * and of what passes; and what making it ready takes before. Times are of the processor, the least
 * of many turns.
 */
enum { TURNS = 60, RAYS = 21 };

struct fixture {
    struct arena arena;
    struct lens lens;
    struct perturbations perturbations;
    struct tolerance_question question;
    struct tolerance tolerance;
    struct second_order_problem problem;
    double *nominal;
};

static void stop(const struct error *error)
{
    fprintf(stderr, "grade: %s\n", error->message);
    exit(1);
}

static void ask(struct fixture *fixture, bool clips)
{
    struct arena *arena = &fixture->arena;
    struct lensdb db = {.arena = arena};
    struct error error;
    const char *assumed;
    if (!lens_open(&db, text_of("double-gauss"), arena, &fixture->lens, &error)) {
        stop(&error);
    }
    const struct tolerances_reader reader = {&fixture->lens, &db, arena};
    if (!tolerances_of(&reader, "precision", NULL, &fixture->perturbations, &assumed, &error)) {
        stop(&error);
    }
    size_t *positions = ARENA_ARRAY(arena, 1, size_t);
    fixture->question =
        (struct tolerance_question){.view = {.lens = &fixture->lens,
                                             .fnumber = NAN,
                                             .clip = clips,
                                             .pattern = PATTERN_GAUSS,
                                             .rays = RAYS,
                                             .positions = positions,
                                             .position_count = 1},
                                    .perturbations = fixture->perturbations.list,
                                    .perturbation_count = fixture->perturbations.count,
                                    .criterion = {.kind = CRITERION_SPOT, .name = "spot"},
                                    .refocus = REFOCUS_BEST};
}

static double opened(struct fixture *fixture)
{
    struct error error;
    const double before = processor_time();
    if (!tolerance_open(&fixture->question, &fixture->arena, &fixture->tolerance, &error)) {
        stop(&error);
    }
    return processor_time() - before;
}

static double found(struct fixture *fixture)
{
    struct arena *arena = &fixture->arena;
    const char *failure;
    fixture->problem = tolerance_problem(&fixture->tolerance, NULL, arena, &fixture->nominal);
    const struct second_order_problem *problem = &fixture->problem;
    struct sensitivity *table =
        ARENA_ARRAY(arena, problem->error_count * problem->figure_count, struct sensitivity);
    const double before = processor_time();
    sensitivity_find(problem, fixture->nominal, arena, table, &failure);
    return processor_time() - before;
}

static void measure(const char *name, bool clips)
{
    double least[2] = {INFINITY, INFINITY};
    struct fixture fixture = {.arena = {0}};
    for (int turn = 0; turn < TURNS; turn++) {
        ask(&fixture, clips);
        least[0] = fmin(least[0], opened(&fixture));
        least[1] = fmin(least[1], found(&fixture));
        arena_free(&fixture.arena);
    }
    printf("%sopening %.9g\n%ssensitivities %.9g\n", name, 1e3 * least[0], name, 1e3 * least[1]);
}

int main(void)
{
    measure("", false);
    measure("clipped-", true);
    return 0;
}
