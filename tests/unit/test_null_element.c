/* tests/unit/test_null_element.c - elements that are taken out and put in elsewhere. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "design/null_element.h"
#include "file/lens_file.h"

#include <string.h>

static const char text[] = "lens Three\n"
                           "aperture epd 4\n"
                           "surface - 3 1.5/60 - c=0.01\n"
                           "surface - 5 air - c=-0.02\n"
                           "surface - 1 1.6/40 - c=-0.03\n"
                           "surface - 6 air - c=0.04\n"
                           "stop - 2 air -\n"
                           "surface - 4 1.7/50 - c=0.05\n"
                           "surface - 40 air - c=-0.06\n";

enum { NUMBERS = 17 };

/* Curvatures, thicknesses and glasses of all three elements. */
static void open_all(struct arena *arena, struct lens *lens, struct variables *variables)
{
    static const size_t fronts[] = {0, 2, 5};
    struct variable list[NUMBERS];
    struct error error;
    size_t count = 0;
    CHECK(lens_read("three", text_of(text), NULL, arena, lens, &error));
    for (size_t i = 0; i < 3; i++) {
        const struct parameter what[] = {
            {fronts[i], PARAMETER_CURVATURE, 0}, {fronts[i] + 1, PARAMETER_CURVATURE, 0},
            {fronts[i], PARAMETER_THICKNESS, 0}, {fronts[i], PARAMETER_INDEX, 0},
            {fronts[i], PARAMETER_ABBE, 0},      {fronts[i] + 1, PARAMETER_THICKNESS, 0}};
        for (size_t k = 0; k < (i < 2 ? 6 : 5); k++) {
            const bool is_gap = what[k].kind == PARAMETER_THICKNESS;
            list[count++] = (struct variable){.what = what[k],
                                              .position = LENS_NONE,
                                              .low = is_gap ? 0.5 : -INFINITY,
                                              .high = is_gap ? 50 : INFINITY,
                                              .name = "x"};
        }
    }
    CHECK(variables_open(lens, list, count, arena, variables, &error));
}

/* Of the lens with these numbers the curvature of a surface, and a thickness. */
static double curvature_of(struct variables *variables, const double *numbers, size_t surface)
{
    const struct lens *lens = variables_put(variables, numbers, 0);
    return parameter_get(lens, (struct parameter){surface, PARAMETER_CURVATURE, 0});
}

static double thickness_of(struct variables *variables, const double *numbers, size_t surface)
{
    const struct lens *lens = variables_put(variables, numbers, 0);
    return parameter_get(lens, (struct parameter){surface, PARAMETER_THICKNESS, 0});
}

int main(void)
{
    struct arena arena = {0};
    struct lens lens;
    struct variables variables;
    struct null_elements elements;
    double numbers[NUMBERS], moved[NUMBERS];
    bool is_null[NUMBERS], found = false;
    open_all(&arena, &lens, &variables);
    null_elements_open(&variables, &arena, &elements);
    CHECK(elements.count == 3);
    CHECK(elements.move_count == 12); /* each of 3, on either side of 2 others */
    variables_get(&variables, numbers);
    for (size_t i = 0; i < elements.move_count; i++) {
        const struct null_move *move = &elements.moves[i];
        /* the first taken out, and put in behind the last: the others move on */
        if (move->taken != 0 || move->put != 2 || !move->is_behind) {
            continue;
        }
        found = true;
        null_elements_move(&elements, move, numbers, moved, is_null);
        CHECK_NEAR(curvature_of(&variables, moved, 0), -0.03, 1e-15, "first: front");
        CHECK_NEAR(curvature_of(&variables, moved, 1), 0.04, 1e-15, "first: rear");
        CHECK_NEAR(thickness_of(&variables, moved, 0), 1, 1e-15, "first: thickness");
        CHECK_NEAR(curvature_of(&variables, moved, 2), 0.05, 1e-15, "second: front");
        /* the meniscus has the curvature of the surface beside it, and the least thickness */
        CHECK_NEAR(curvature_of(&variables, moved, 5), -0.06, 1e-15, "null: front");
        CHECK_NEAR(curvature_of(&variables, moved, 6), -0.06, 1e-15, "null: rear");
        CHECK_NEAR(thickness_of(&variables, moved, 5), 0.5, 1e-15, "null: thickness");
        CHECK_NEAR(variables_put(&variables, moved, 0)->surfaces[5].medium.index.hi, 1.7, 1e-12,
                   "null: its neighbour's glass");
        size_t own = 0;
        for (size_t j = 0; j < variables.count; j++) {
            own += is_null[j];
        }
        CHECK(own == 5); /* its last gap does not vary */
        null_elements_bend(&elements, move, -1, moved);
        CHECK_NEAR(curvature_of(&variables, moved, 5), -0.06, 1e-15, "bent: inner side");
        CHECK(curvature_of(&variables, moved, 6) < -0.06);
    }
    CHECK(found);
    arena_free(&arena);
    return check_report();
}
