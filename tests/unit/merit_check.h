/* tests/unit/merit_check.h - operands beside the analyses, derivatives beside differences. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_UNIT_MERIT_CHECK_H
#define LENSCALC_TESTS_UNIT_MERIT_CHECK_H

#include "check.h"
#include "cli/options/goals.h"
#include "design/merit/merit.h"
#include "file/lens_file.h"
#include "file/lens_glass.h"

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
    struct lens_glasses glasses;
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

/* Given     looks  its aim, f-number and rays */
static inline bool merit_bench_look(struct merit_bench *bench, const struct merit_case *of,
                                    const struct merit_question *looks, struct arena *arena,
                                    struct error *error)
{
    static struct lensdb db;
    *bench = (struct merit_bench){.arena = arena};
    db = (struct lensdb){.arena = arena};
    const struct goals_reader reader = {&db, &bench->lens, arena, "--goals", 1};
    bench->glasses = (struct lens_glasses){&db, arena};
    const struct glass_source source = lens_glass_source(&bench->glasses);
    if (!lens_read(of->name, text_of(of->text), &source, arena, &bench->lens, error) ||
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
                                            .fnumber = looks->fnumber,
                                            .from_entrance = looks->from_entrance,
                                            .rays = looks->rays};
    variables_get(&bench->variables, bench->v);
    return merit_open(&question, arena, &bench->merit, error);
}

static inline bool merit_bench_open(struct merit_bench *bench, const struct merit_case *of,
                                    struct arena *arena, struct error *error)
{
    const struct merit_question usual = {.fnumber = NAN, .rays = 36};
    return merit_bench_look(bench, of, &usual, arena, error);
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
        const double size = operand->kind == OPERAND_DISTORTION ? 100
                            : operand->kind == OPERAND_LATERAL  ? 10
                                                                : fmax(1, fabs(value) / 10);
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

/* -------- lenses by chance -------- */

/* 0 .. 1, [Knuth97] 3.3.4: line 26 of table 1. */
static inline double merit_chance(unsigned long long *state)
{
    *state = *state * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(*state >> 11) * 0x1p-53;
}

static inline double merit_between(unsigned long long *state, double low, double high)
{
    return low + (high - low) * merit_chance(state);
}

enum { MERIT_TEXT = 2000 };

/* The next words behind those that are there. */
#define MERIT_ADD(text, ...) snprintf((text) + strlen(text), MERIT_TEXT - strlen(text), __VA_ARGS__)

/*
 * A lens of weak elements with a stop among them, and names of what may vary of it.
 *
 * Given     moves  surfaces are decentred and tilted too
 */
static inline void merit_random(unsigned long long seed, bool moves, char text[MERIT_TEXT],
                                char names[MERIT_TEXT])
{
    unsigned long long state = seed * 7919 + 17;
    const int elements = 2 + (int)(merit_chance(&state) * 3), stop = 1;
    const bool near = merit_chance(&state) < 0.4;
    int surface = 0;
    text[0] = names[0] = '\0';
    MERIT_ADD(text, "wavelength d F C\nfocus paraxial\n");
    MERIT_ADD(text, near ? "object %.3f\nfield height 6\n" : "object inf\nfield angle 4\n",
              merit_between(&state, 200, 400));
    MERIT_ADD(text, near ? "aperture na 0.02\n" : "aperture epd %.3f\n",
              merit_between(&state, 5, 9));
    for (int i = 0; i < elements; i++) {
        if (i == stop) {
            MERIT_ADD(text, "stop - %.3f air 20\n", merit_between(&state, 1, 4));
            surface++;
        }
        for (int side = 0; side < 2; side++) {
            const double c = merit_between(&state, 0.002, 0.014) * (side == 0 ? 1 : -1);
            MERIT_ADD(text, "surface - %.3f ", merit_between(&state, 2, 6));
            MERIT_ADD(text, side == 0 ? "%.4f/%.1f" : "air", merit_between(&state, 1.62, 1.68),
                      merit_between(&state, 40, 48));
            MERIT_ADD(text, " 40 c=%.5f k=%.2f A4=%.3e", c, merit_between(&state, -1, 1),
                      merit_between(&state, -2e-6, 2e-6));
            if (moves && merit_chance(&state) < 0.5) {
                MERIT_ADD(text, " decenter=%.3f,%.3f tilt=%.2f,%.2f",
                          merit_between(&state, -0.2, 0.2), merit_between(&state, -0.2, 0.2),
                          merit_between(&state, -2, 2), merit_between(&state, -2, 2));
                MERIT_ADD(names, "decenter_y%d tilt_x%d ", surface + 1, surface + 1);
            }
            MERIT_ADD(text, "\n");
            MERIT_ADD(names, "c%d t%d k%d A4_%d ", surface + 1, surface + 1, surface + 1,
                      surface + 1);
            if (side == 0) {
                MERIT_ADD(names, "n%d V%d ", surface + 1, surface + 1);
            }
            surface++;
        }
    }
    names[strlen(names) - 1] = '\0';
}

/* Many of them. */
static inline void merit_check_random(const char *goals, bool moves, merit_analysis *analysis)
{
    for (unsigned long long seed = 1; seed <= 8; seed++) {
        char text[MERIT_TEXT], names[MERIT_TEXT];
        merit_random(seed, moves, text, names);
        const struct merit_case of = {"by chance", text, names, goals, 2e-9};
        merit_check(&of, analysis);
    }
}

#endif
