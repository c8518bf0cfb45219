/* tests/bench/spots.c - rays of converged spots, and aimed rays, against the bare trace of them. */
/* SPDX-License-Identifier: MIT */
#include "analysis/pupil/quadrature.h"
#include "analysis/setup/setup.h"
#include "base/constants.h"
#include "clock.h"
#include "exchange/lens_open.h"
#include "trace/dispatch.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/*
 * Prints one figure a line, "name value": nine spots of the double Gauss (0, 10 and 14 degrees at
 * d, F and C; chief rays are known) at f/2 without clipping, with the rays that 1e-6 wants, and
 * through its rims, doubled once, with those that 1e-4 wants; and rays aimed at the stop. Times
 * are of the processor, the least of many turns.
 */
enum { FIELDS = 3, COLOURS = 3, SPOTS = FIELDS * COLOURS, TURNS = 200, AIMED = 3000 };

struct fixture {
    struct arena arena;
    struct lens lens;
    struct setup setup;
    struct beam beams[FIELDS];
    struct aim aims[SPOTS];
    struct stop_beam pupils[SPOTS];
};

static void stop(const struct error *error)
{
    fprintf(stderr, "spots: %s\n", error->message);
    exit(1);
}

static void set_up(struct fixture *fixture, double fnumber, unsigned which)
{
    static const double degrees[FIELDS] = {0, 10, 14};
    struct arena *arena = &fixture->arena;
    struct lensdb db = {.arena = arena};
    struct setup_field fields[FIELDS];
    struct error error;
    for (size_t f = 0; f < FIELDS; f++) {
        fields[f] = (struct setup_field){{FIELD_ANGLE, {0, degrees[f] * RADIANS_PER_DEGREE}}, 1};
    }
    const struct setup_question question = {.lens = &fixture->lens,
                                            .wavelength = NAN,
                                            .wavelengths = WAVELENGTHS_ALL,
                                            .fnumber = fnumber,
                                            .fields = fields,
                                            .field_count = FIELDS};
    if (!lens_open(&db, text_of("double-gauss"), arena, &fixture->lens, &error) ||
        !setup_open(&question, arena, &fixture->setup, &error) ||
        !setup_place_image(&fixture->setup, &(struct plane_value){.kind = PLANE_PARAXIAL},
                           &error)) {
        stop(&error);
    }
    for (size_t i = 0; i < SPOTS; i++) {
        const size_t f = i / COLOURS, g = i % COLOURS;
        const struct system *open =
            setup_system(&fixture->setup, g, SETUP_OPEN | SETUP_IMAGE, &error);
        const struct system *system = setup_system(&fixture->setup, g, which | SETUP_IMAGE, &error);
        if (!setup_beam(&fixture->setup, &fields[f].point, &fixture->beams[f], &error) ||
            !aim_open(open, &fixture->beams[f], arena, &fixture->aims[i], &error)) {
            stop(&error);
        }
        fixture->pupils[i] = stop_beam_of_stop(&fixture->aims[i], system, WEIGHT_PUPIL);
    }
}

/* Seconds of all spots, each filled with `rays` and then as often doubled. */
static double time_spots(struct fixture *fixture, size_t rays, int doubled)
{
    double best = INFINITY;
    for (int turn = 0; turn < TURNS; turn++) {
        double began = processor_time();
        for (size_t i = 0; i < SPOTS; i++) {
            const struct arena_mark mark = arena_mark(&fixture->arena);
            struct quadrature_region region = quadrature_open(&fixture->pupils[i], &fixture->arena);
            for (int k = 0; k <= doubled; k++) {
                const struct quadrature all = quadrature_fill(&region, rays << k, &fixture->arena);
                rays_trace(fixture->pupils[i].system, &all.rays, NULL);
            }
            arena_reset(&fixture->arena, mark);
        }
        best = fmin(best, processor_time() - began);
    }
    return best;
}

/* Seconds that the bare trace of their rays takes. */
static double time_trace(struct fixture *fixture, size_t rays)
{
    double best = INFINITY;
    struct quadrature all[SPOTS];
    struct rays copy = rays_new(&fixture->arena, 4 * rays);
    for (size_t i = 0; i < SPOTS; i++) {
        all[i] = quadrature_make(&fixture->pupils[i], rays, &fixture->arena);
    }
    for (int turn = 0; turn < TURNS; turn++) {
        double spent = 0;
        for (size_t i = 0; i < SPOTS; i++) {
            const size_t blocks = rays_blocks(&all[i].rays);
            memcpy(copy.blocks, all[i].rays.blocks, blocks * sizeof *copy.blocks);
            copy.count = all[i].rays.count;
            double began = processor_time();
            rays_trace(fixture->pupils[i].system, &copy, NULL);
            spent += processor_time() - began;
        }
        best = fmin(best, spent);
    }
    return best;
}

/* An aimed ray, in bare traces of one through the whole lens. */
static double time_aim(struct fixture *fixture)
{
    const struct aim *aim = &fixture->aims[SPOTS - 1];
    struct sample sample;
    struct error error;
    double aimed = INFINITY, traced = INFINITY;
    if (!sample_make(PATTERN_SOBOL, AIMED, 0, &fixture->arena, &sample, &error)) {
        stop(&error);
    }
    struct rays rays = rays_new(&fixture->arena, sample.count);
    for (int turn = 0; turn < TURNS / 4; turn++) {
        double began = processor_time();
        aim_rays(aim, sample.points, sample.count, &rays);
        aimed = fmin(aimed, processor_time() - began);
        began = processor_time();
        rays_trace(aim->system, &rays, NULL);
        traced = fmin(traced, processor_time() - began);
    }
    return aimed / traced;
}

int main(void)
{
    static struct fixture whole, clipped;
    set_up(&whole, 2, SETUP_OPEN);
    set_up(&clipped, NAN, SETUP_CLIPPED);
    double seconds = time_spots(&whole, 105, 0);
    printf("whole/trace %.2f\nwhole %.3f\n", seconds / time_trace(&whole, 105), 1e3 * seconds);
    seconds = time_spots(&clipped, 60, 1);
    printf("clipped %.3f\n", 1e3 * seconds);
    printf("aim/trace %.2f\n", time_aim(&whole));
    arena_free(&whole.arena);
    arena_free(&clipped.arena);
    return 0;
}
