/* tests/unit/test_lens_numbers.c - numbers set again and again, and compiled again. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "file/lens_file.h"
#include "lens_of.h"
#include "optics/lens_indices.h"
#include "optics/lens_numbers.h"
#include "trace/dispatch.h"
#include "trace/system.h"

static struct arena arena;

/* Has everything: a pair's digits, nd/Vd, an asphere, a decentre, a break, a mirror's medium. */
static const char *const text =
    "medium 1.1\nsurface 50.1 6.3 1.6/50 - k=-0.7 A4=1e-6\n"
    "surface -80 3 air - decenter=0.1,0.2\nbend tilt=1\n"
    "stop - 5 air 8\nsurface - 4 1.5 - A2=0.005\nsurface -35 9 mirror -\n"
    "thick 70 3 1.2 - hiatus=1\nsurface - 2 air -\n";

/* Every number that the lens has: as parameter_apply has it, and back again. */
static void check_every(void)
{
    const struct lens lens = lens_of(text, &arena);
    size_t tested = 0;
    for (size_t i = LENS_NONE; i + 1 < lens.surface_count + 1; i++) {
        for (struct parameter each = {0}; each.kind < PARAMETER_KINDS;
             each = parameter_next(each)) {
            struct error error;
            struct lens_numbers numbers;
            each.surface = i;
            if (each.kind == PARAMETER_GLASS || !parameter_check(&lens, each, &error)) {
                continue;
            }
            const double was = parameter_get(&lens, each);
            const double value = isfinite(was) ? was * 1.25 + 0.001 : 77;
            lens_numbers_open(&lens, &arena, &numbers);
            const struct arena_mark before = arena_mark(&arena);
            for (int again = 0; again < 3; again++) {
                lens_numbers_set(&numbers, each, value);
            }
            const struct arena_mark after = arena_mark(&arena);
            CHECK(after.block == before.block && after.used == before.used);
            const struct lens *other = parameter_apply(&lens, &each, &value, 1, &arena);
            CHECK(parameter_get(&numbers.lens, each) == parameter_get(other, each));
            CHECK(parameter_get(&lens, each) == was || isinf(was));
            for (size_t s = 0; s < lens.surface_count; s++) {
                const struct surface *a = &numbers.lens.surfaces[s], *b = &other->surfaces[s];
                CHECK(medium_is_same(&a->medium, &b->medium));
                CHECK(surface_base_curvature(a).hi == surface_base_curvature(b).hi);
            }
            lens_numbers_set(&numbers, each, was);
            CHECK(parameter_get(&numbers.lens, each) == was);
            tested++;
        }
    }
    CHECK(tested > 60);
}

/* A compiled lens is the one that compiling from the start gives, in the memory of the last. */
static void check_compiled(void)
{
    static const double values[] = {-0.02, 0.01, 0, 0.031};
    const struct lens lens = lens_of(text, &arena);
    const struct parameter c2 = {1, PARAMETER_CURVATURE, 0}, V1 = {0, PARAMETER_ABBE, 0};
    struct error error;
    struct lens_numbers numbers;
    lens_numbers_open(&lens, &arena, &numbers);
    struct medium *asked = ARENA_ARRAY(&arena, lens.surface_count + 1, struct medium);
    struct pair *n = ARENA_ARRAY(&arena, lens.surface_count + 1, struct pair);
    struct system_options options = system_options_default(), fresh = options;
    options.indices = n;
    const struct arena_mark mark = arena_mark(&arena);
    const struct step *first = NULL;
    for (size_t i = 0; i < sizeof values / sizeof values[0]; i++) {
        struct system again, system;
        lens_numbers_set(&numbers, c2, values[i]);
        lens_numbers_set(&numbers, V1, 50 + (double)(i / 2));
        arena_reset(&arena, mark);
        CHECK(lens_indices(&numbers.lens, 0.48, asked, n, &error));
        CHECK(system_compile(&numbers.lens, 0.48, &options, &arena, &again, &error));
        CHECK(first == NULL || again.steps == first);
        first = again.steps;
        const struct lens *other =
            parameter_apply(&lens, (struct parameter[]){c2, V1},
                            (double[]){values[i], 50 + (double)(i / 2)}, 2, &arena);
        CHECK(system_compile(other, 0.48, &fresh, &arena, &system, &error));
        CHECK(memcmp(again.steps, system.steps,
                     system.begin[system.places] * sizeof *system.steps) == 0);
        CHECK(memcmp(again.n, system.n, (lens.surface_count + 1) * sizeof *n) == 0);
    }
}

/* An index that cannot be is not taken for known when it is asked again. */
static void check_refused(void)
{
    const struct lens lens = lens_of("surface 50 6 1.6 -\nsurface -80 3 air -\n", &arena);
    struct lens_numbers numbers;
    struct error error = {0};
    struct medium asked[3] = {{.kind = MEDIUM_CONSTANT}};
    struct pair n[3];
    lens_numbers_open(&lens, &arena, &numbers);
    lens_numbers_set(&numbers, (struct parameter){0, PARAMETER_INDEX, 0}, -1);
    for (int again = 0; again < 2; again++) {
        CHECK(!lens_indices(&numbers.lens, 0.5, asked, n, &error));
        CHECK(strstr(error.message, "surface 1: ") != NULL);
    }
    lens_numbers_set(&numbers, (struct parameter){0, PARAMETER_INDEX, 0}, 1.7);
    CHECK(lens_indices(&numbers.lens, 0.5, asked, n, &error));
    CHECK(n[1].hi == 1.7 && n[2].hi == 1);
    CHECK_TEXT(numbers.lens.surfaces[0].medium.written.length == 3 ? "1.7" : "?", "1.7");
}

int main(void)
{
    check_every();
    check_compiled();
    check_refused();
    arena_free(&arena);
    return check_report();
}
