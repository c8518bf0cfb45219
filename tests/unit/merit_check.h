/* tests/unit/merit_check.h - operands beside the analyses, derivatives beside differences. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_UNIT_MERIT_CHECK_H
#define LENSCALC_TESTS_UNIT_MERIT_CHECK_H

#include "check.h"
#include "cli/goals.h"
#include "design/merit.h"
#include "file/lens_file.h"

/* A lens, what varies of it, and what is wanted. */
struct merit_case {
    const char *name, *text, *variables, *goals;
    double tolerance;
};

/* One of the figures of an operand as an analysis has it, of a lens in one position. */
typedef double merit_analysis(const struct lens *lens, const struct operand *operand, size_t at,
                              struct arena *arena);

enum { MERIT_MOST = 64 };

struct merit_bench {
    struct arena *arena;
    struct lens lens;
    struct variable list[MERIT_MOST];
    size_t count;
    struct variables variables;
    struct goals goals;
    struct merit merit;
    double v[MERIT_MOST];
};

static inline bool merit_read_variables(struct merit_bench *bench, const char *names,
                                        struct error *error)
{
    struct text rest = text_of(names);
    while (rest.start != NULL) {
        const struct text name = text_trim(text_cut(&rest, ' '));
        struct variable *variable = &bench->list[bench->count++];
        *variable = (struct variable){.position = LENS_NONE, .low = -INFINITY, .high = INFINITY};
        if (!parameter_read(name, NULL, &variable->what, error)) {
            return false;
        }
        variable->name = arena_string(bench->arena, name.start, name.length);
    }
    return true;
}

static inline bool merit_bench_open(struct merit_bench *bench, const struct merit_case *of,
                                    struct arena *arena, struct error *error)
{
    static struct lensdb db;
    *bench = (struct merit_bench){.arena = arena};
    db = (struct lensdb){.arena = arena};
    const struct goals_reader reader = {&db, &bench->lens, arena, "--goals", 1};
    if (!lens_read(of->name, text_of(of->text), NULL, arena, &bench->lens, error) ||
        !merit_read_variables(bench, of->variables, error) ||
        !goals_read(&reader, text_of(of->goals), &bench->goals, error) ||
        !variables_open(&bench->lens, bench->list, bench->count, arena, &bench->variables, error)) {
        return false;
    }
    const struct merit_question question = {.lens = &bench->lens,
                                            .variables = &bench->variables,
                                            .variable_count = bench->count,
                                            .operands = bench->goals.list,
                                            .operand_count = bench->goals.count,
                                            .fnumber = NAN};
    variables_get(&bench->variables, bench->v);
    return merit_open(&question, arena, &bench->merit, error);
}

/* A residual, and what says its figure. */
struct merit_one {
    struct merit_bench *bench;
    merit_analysis *analysis;
    const struct merit_slot *slot;
    size_t at;
};

/* The analysis with one number changed by `step`. */
static inline double merit_beside(const struct merit_one *one, size_t variable, double step)
{
    struct merit_bench *bench = one->bench;
    const struct merit_slot *slot = one->slot;
    double v[MERIT_MOST];
    memcpy(v, bench->v, sizeof v);
    v[variable] += step;
    const struct merit_place *place = &bench->merit.places[slot->place];
    const struct lens *lens = variables_put(&bench->variables, v, place->position);
    struct lens alone = *lens;
    alone.position_count = 0;
    return one->analysis(&alone, slot->operand, one->at, bench->arena);
}

/* Central differences with steps h, h/2, h/4, without the terms h^2 and h^4. */
static inline double merit_difference(const struct merit_one *one, size_t variable, double h)
{
    double d[3];
    for (int i = 0; i < 3; i++, h /= 2) {
        d[i] = (merit_beside(one, variable, h) - merit_beside(one, variable, -h)) / (2 * h);
    }
    const double first = (4 * d[1] - d[0]) / 3, second = (4 * d[2] - d[1]) / 3;
    return (16 * second - first) / 15;
}

/* A step that changes the lens a little: R by its curvature. */
static inline double merit_step(const struct merit_bench *bench, size_t variable)
{
    const struct parameter what = bench->list[variable].what;
    const double v = fabs(bench->v[variable]);
    switch (what.kind) {
    case PARAMETER_RADIUS:
    case PARAMETER_CURVATURE:
        return 2e-5;
    case PARAMETER_COEFFICIENT:
        return what.order == 2 ? 2e-5 : 1e-4 * pow(10, 1 - what.order);
    case PARAMETER_TILT_X:
    case PARAMETER_TILT_Y:
        return 1e-3;
    case PARAMETER_FOCAL:
        return 1e-3 * v;
    case PARAMETER_THICKNESS:
        return fmax(1e-2 * v, 0.1);
    default:
        return fmax(1e-3 * v, 1e-2);
    case PARAMETER_INDEX:
        return 1e-3;
    }
}

/* One residual with its row. */
static inline void merit_check_one(const struct merit_one *one, const struct merit_case *of,
                                   double residual, const double *row)
{
    const struct merit_bench *bench = one->bench;
    const struct operand *operand = one->slot->operand;
    const double value = merit_beside(one, 0, 0);
    const double got = bench->merit.values[one->slot->first + one->at];
    CHECK_NEAR(got, value, 1e-11 * fmax(1, fabs(value)), operand->name);
    CHECK_NEAR(residual, (value - operand->target) / operand->deviation,
               1e-10 * fmax(1, fabs(value)) / operand->deviation, operand->name);
    for (size_t j = 0; j < bench->count; j++) {
        const double h = merit_step(bench, j);
        const double slope = merit_difference(one, j, h), mine = row[j] * operand->deviation;
        /* of scale; and what is left of the differences where they cancel */
        const double size = operand->kind == OPERAND_DISTORTION ? 100 : fmax(1, fabs(value) / 10);
        const double scale = fmax(fabs(slope), 1e-4 / h * size);
        const bool near = fabs(mine - slope) <= of->tolerance * scale;
        CHECK(near);
        if (!near) {
            printf("    %s: %s by %s is %.15g, differences have %.15g\n", of->name, operand->name,
                   bench->list[j].name, mine, slope);
        }
    }
}

/* All operands of a case by all its variables. */
static inline void merit_check(const struct merit_case *of, merit_analysis *analysis)
{
    struct arena arena = {0};
    struct error error;
    struct merit_bench *bench = ARENA_NEW(&arena, struct merit_bench);
    bool open = merit_bench_open(bench, of, &arena, &error);
    CHECK(open);
    if (!open) {
        printf("    %s: %s\n", of->name, error.message);
        arena_free(&arena);
        return;
    }
    const struct merit *merit = &bench->merit;
    double *residuals = ARENA_ARRAY(&arena, merit->residual_count, double);
    double *jacobian = ARENA_ARRAY(&arena, merit->residual_count * bench->count, double);
    bool done = merit_evaluate(&bench->merit, bench->v, residuals, jacobian);
    CHECK(done);
    for (size_t s = 0; s < merit->slot_count && done; s++) {
        const struct merit_slot *slot = &merit->slots[s];
        for (size_t i = 0; i < slot->count; i++) {
            const struct merit_one one = {bench, analysis, slot, i};
            merit_check_one(&one, of, residuals[slot->first + i],
                            &jacobian[(slot->first + i) * bench->count]);
        }
    }
    if (!done) {
        printf("    %s: %s\n", of->name, merit->why.message);
    }
    arena_free(&arena);
}

#endif
