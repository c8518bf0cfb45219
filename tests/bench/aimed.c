/* tests/bench/aimed.c - rays aimed anew as a lens changes, and their derivatives. */
/* SPDX-License-Identifier: MIT */
#include "trace/aim/aimed.h"
#include "analysis/setup/setup.h"
#include "base/constants.h"
#include "clock.h"
#include "exchange/lens_open.h"
#include "trace/aim/sample.h"
#include "trace/dispatch.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/*
 * Prints one figure a line, "name value", in bare traces of the same rays: 128 of a field of the
 * double Gauss at 10 degrees, aimed at the stop as the lens changes (from one wavelength to another
 * and back) and traced; and, once they are aimed, traced with all derivatives of x and y. Times are
 * of the processor, the least of many turns.
 */
enum { COLOURS = 2, TURNS = 200, AGAIN = 20 };

struct fixture {
    struct arena arena;
    struct lens lens;
    struct setup setup;
    const struct system *systems[COLOURS];
    struct aimed_beam beam;
    struct aimed_work work;
    struct aimed aimed;
    struct derivative_layout layout;
    double *gradient;
};

static void stop(const struct error *error)
{
    fprintf(stderr, "aimed: %s\n", error->message);
    exit(1);
}

static void set_up(struct fixture *fixture)
{
    struct arena *arena = &fixture->arena;
    struct lensdb db = {.arena = arena};
    struct setup_field field = {{FIELD_ANGLE, {0, 10 * RADIANS_PER_DEGREE}}, 1};
    struct sample sample;
    struct error error;
    const struct setup_question question = {.lens = &fixture->lens,
                                            .wavelength = NAN,
                                            .wavelengths = WAVELENGTHS_ALL,
                                            .fnumber = 2,
                                            .fields = &field,
                                            .field_count = 1};
    if (!lens_open(&db, text_of("double-gauss"), arena, &fixture->lens, &error) ||
        !setup_open(&question, arena, &fixture->setup, &error) ||
        !setup_place_image(&fixture->setup, &(struct plane_value){.kind = PLANE_PARAXIAL},
                           &error) ||
        !setup_beam(&fixture->setup, &field.point, &fixture->beam.beam, &error) ||
        !sample_make(PATTERN_SOBOL, RAYS_BLOCK, 0, arena, &sample, &error)) {
        stop(&error);
    }
    for (size_t g = 0; g < COLOURS; g++) {
        fixture->systems[g] = setup_system(&fixture->setup, g, SETUP_OPEN | SETUP_IMAGE, &error);
        if (fixture->systems[g] == NULL) {
            stop(&error);
        }
    }
    fixture->beam.count = RAYS_BLOCK;
    aimed_work_open(fixture->systems[0], arena, &fixture->work);
    aimed_open(&fixture->beam, 1, true, &fixture->work, &fixture->aimed);
    derivative_layout(fixture->systems[0], 0, arena, &fixture->layout);
    fixture->gradient = ARENA_ARRAY(arena, fixture->layout.rows * RAYS_BLOCK, double);
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        fixture->aimed.x[i] = sample.points[i].x;
        fixture->aimed.y[i] = sample.points[i].y;
    }
}

static void aim(struct fixture *fixture, size_t colour)
{
    const struct arena_mark mark = arena_mark(&fixture->arena);
    struct error error;
    if (!aimed_at_stop(&fixture->aimed, fixture->systems[colour], &fixture->arena, &error)) {
        stop(&error);
    }
    arena_reset(&fixture->arena, mark);
}

static void derive(struct fixture *fixture)
{
    static struct ray_block end, adjoint;
    static struct aimed_rates rates;
    aimed_trace(&fixture->aimed, true, &end);
    for (int output = 0; output < 2; output++) {
        memset(&adjoint, 0, sizeof adjoint);
        for (int lane = 0; lane < RAYS_BLOCK; lane++) {
            (output == 0 ? adjoint.x : adjoint.y)[lane] = 1;
        }
        aimed_sweep(&fixture->aimed, &fixture->layout, fixture->aimed.system->places, &adjoint,
                    fixture->gradient, &rates);
    }
}

int main(void)
{
    static struct fixture fixture;
    static struct ray_block end;
    set_up(&fixture);
    struct rays rays = rays_new(&fixture.arena, RAYS_BLOCK);
    double traced = INFINITY, aimed = INFINITY, derived = INFINITY;
    for (int turn = 0; turn < TURNS; turn++) {
        double began = processor_time();
        for (size_t i = 0; i < AGAIN; i++) {
            aim(&fixture, i % COLOURS);
            aimed_trace(&fixture.aimed, false, &end);
        }
        aimed = fmin(aimed, processor_time() - began);
        began = processor_time();
        for (int i = 0; i < AGAIN; i++) {
            derive(&fixture);
        }
        derived = fmin(derived, processor_time() - began);
        began = processor_time();
        for (int i = 0; i < AGAIN; i++) {
            *rays.blocks = *fixture.work.start;
            rays_trace(fixture.aimed.system, &rays, NULL);
        }
        traced = fmin(traced, processor_time() - began);
    }
    printf("aimed_anew %.2f\naimed_derivatives %.2f\n", aimed / traced, derived / traced);
    arena_free(&fixture.arena);
    return 0;
}
