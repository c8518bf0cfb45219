/* tests/bench/camera.c - rays from the film through a lens, against the bare trace of them. */
/* SPDX-License-Identifier: MIT */
#include "analysis/setup/setup.h"
#include "base/parallel.h"
#include "base/sobol.h"
#include "camera/film/film_rays.h"
#include "clock.h"
#include "exchange/lens_open.h"
#include "trace/dispatch.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/*
 * Prints one figure a line, "name value": rays of a whole 36 x 24 mm film through the 50 mm double
 * Gauss at f/2, by four dimensions of a sequence, with each set of instructions, and the pupils of
 * several lenses. Times are of the processor, the least of many turns; those of threads by the
 * clock.
 */
enum { TURNS = 15, BLOCKS = 8192 };

static const double width = 36, height = 24;

struct fixture {
    struct arena arena;
    struct lens lens;
    struct setup setup;
    const struct system *systems[SETUP_SYSTEMS];
    struct film_lens film;
    struct exit_pupil_bounds region;
    struct sobol sobol[FILM_DIMENSIONS];
    struct film_plan plan;
};

static void stop(const struct error *error)
{
    fprintf(stderr, "camera: %s\n", error->message);
    exit(1);
}

static void set_up(struct fixture *fixture, const char *name, double fnumber)
{
    struct arena *arena = &fixture->arena;
    struct lensdb db = {.arena = arena};
    struct error error;
    const struct setup_question question = {.lens = &fixture->lens,
                                            .wavelength = NAN,
                                            .wavelengths = WAVELENGTHS_ALL,
                                            .fnumber = fnumber};
    if (!lens_open(&db, text_of(name), arena, &fixture->lens, &error) ||
        !setup_open(&question, arena, &fixture->setup, &error) ||
        !setup_place_image(&fixture->setup, &(struct plane_value){.kind = PLANE_OF_LENS}, &error)) {
        stop(&error);
    }
    const struct setup *setup = &fixture->setup;
    for (size_t w = 0; w < setup->wavelength_count; w++) {
        fixture->systems[w] = setup_system(setup, w, SETUP_CLIPPED | SETUP_REVERSED, &error);
        if (fixture->systems[w] == NULL) {
            stop(&error);
        }
    }
    fixture->film = (struct film_lens){.systems = fixture->systems,
                                       .count = setup->wavelength_count,
                                       .first = &setup->first,
                                       .film = setup->image,
                                       .reach = hypot(width, height) / 2};
    if (!exit_pupil_bounds_open(&fixture->film, arena, &fixture->region, &error)) {
        stop(&error);
    }
    fixture->plan = (struct film_plan){.sobol = fixture->sobol,
                                       .left = -width / 2,
                                       .bottom = -height / 2,
                                       .width = width,
                                       .height = height};
    for (uint32_t k = 0; k < FILM_DIMENSIONS; k++) {
        sobol_open(k, &fixture->sobol[k]);
        fixture->plan.scrambling[k] = sobol_scrambling(0, 0, k);
    }
}

static double time_region(struct fixture *fixture)
{
    double best = INFINITY;
    for (int turn = 0; turn < TURNS; turn++) {
        const struct arena_mark mark = arena_mark(&fixture->arena);
        struct exit_pupil_bounds region;
        struct error error;
        double began = processor_time();
        if (!exit_pupil_bounds_open(&fixture->film, &fixture->arena, &region, &error)) {
            stop(&error);
        }
        best = fmin(best, processor_time() - began);
        arena_reset(&fixture->arena, mark);
    }
    return best;
}

/* One thread's work: blocks of rays, made or given. */
struct work {
    const struct fixture *fixture;
    enum instruction_set set;
    bool starts; /* makes them; else the same block is traced again and again */
    struct ray_block *given;
    double arrived[2]; /* of each half */
};

static void trace_blocks(void *context, size_t begin, size_t end)
{
    struct work *work = context;
    struct arena arena = {0};
    struct film_samples samples;
    const struct rays rays = rays_new(&arena, RAYS_BLOCK);
    const struct trace_way way = {work->set, 1};
    double arrived = 0;
    for (size_t i = begin; i < end; i++) {
        if (work->starts) {
            film_rays_plan(&work->fixture->plan, NULL, (uint32_t)i, work->set, &samples);
            film_rays_start(&work->fixture->region, &samples, work->set, rays.blocks);
        } else {
            *rays.blocks = *work->given;
        }
        rays_trace(work->fixture->systems[0], &rays, &way);
        for (int k = 0; k < RAYS_BLOCK; k++) {
            arrived += rays.blocks->lost[k] == 0;
        }
    }
    work->arrived[begin > 0] = arrived;
    arena_free(&arena);
}

/* Seconds of the processor for all blocks; survivors: their share. */
static double time_rays(struct work *work, double *survivors)
{
    double best = INFINITY;
    for (int turn = 0; turn < TURNS; turn++) {
        double began = processor_time();
        trace_blocks(work, 0, BLOCKS);
        best = fmin(best, processor_time() - began);
    }
    *survivors = work->arrived[0] / BLOCKS / RAYS_BLOCK;
    return best;
}

static double time_threads(struct work *work, int threads)
{
    double best = INFINITY;
    for (int turn = 0; turn < TURNS; turn++) {
        double began = clock_time();
        parallel_for(threads, BLOCKS, BLOCKS / 2, trace_blocks, work);
        best = fmin(best, clock_time() - began);
    }
    return best;
}

int main(void)
{
    static const char *const pupils[] = {"double-gauss", "nikkor-z-58-f095", "questar-35",
                                         "fisheye-16"};
    static struct fixture fixture;
    set_up(&fixture, "cs348b-dgauss-50", 2);
    struct ray_block given;
    struct film_samples samples;
    film_rays_plan(&fixture.plan, NULL, 0, SET_BEST, &samples);
    film_rays_start(&fixture.region, &samples, SET_BEST, &given);
    struct work work = {.fixture = &fixture, .starts = true};
    double survivors, ignored;
    const double rays = (double)BLOCKS * RAYS_BLOCK, all = time_rays(&work, &survivors);
    printf("rate %.1f\nsurvivors %.2f\n", rays / all / 1e6, 100 * survivors);
    printf("threads %.2f\n", time_threads(&work, 1) / time_threads(&work, 2));
    work.starts = false;
    work.given = &given;
    printf("all/trace %.2f\n", all / time_rays(&work, &ignored));
    arena_free(&fixture.arena);
    for (size_t i = 0; i < sizeof pupils / sizeof pupils[0]; i++) {
        static struct fixture other;
        other = (struct fixture){.arena = {0}};
        set_up(&other, pupils[i], NAN);
        printf("%s %.2f\n", pupils[i], 1e3 * time_region(&other));
        arena_free(&other.arena);
    }
    return 0;
}
