/* tests/bench/fit.c - a thick lens fitted to 1000 exact rays; what a ray costs by each model. */
/* SPDX-License-Identifier: MIT */
#include "clock.h"
#include "design/fit/ray_data.h"
#include "design/fit/thick.h"
#include "exchange/lens_open.h"
#include "trace/dispatch.h"
#include "trace/system.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Prints one figure a line, "name value"; times are the best of TURNS. */
enum { TURNS = 200 };

static void need(bool good, const struct error *error)
{
    if (!good) {
        fprintf(stderr, "fit: %s\n", error->message);
        exit(1);
    }
}

/* ns a ray by a thick lens's map; the thin lens is the same map with H and H' in one plane. */
static double time_map(const struct thick_rays *rays, const struct thick_lens *lens)
{
    double best = INFINITY, sum = 0;
    for (int turn = 0; turn < TURNS; turn++) {
        double start = clock_time();
        for (size_t i = 0; i < rays->count; i++) {
            const struct slope_ray in = {rays->x[i], rays->y[i], rays->p[i], rays->q[i]};
            const struct slope_ray out = thick_lens_map(lens, in);
            sum += out.x + out.y + out.p + out.q;
        }
        best = fmin(best, clock_time() - start);
    }
    if (!isfinite(sum)) {
        puts("not finite");
    }
    return 1e9 * best / (double)rays->count;
}

/* ns a ray by exact tracing, with clear apertures. */
static double time_exact(const struct lens *lens, const struct first_order *first,
                         struct arena *arena)
{
    struct error error;
    struct system system;
    struct system_options options = system_options_default();
    options.clip = true;
    options.stop_radius = first->stop_radius;
    need(system_compile(lens, 0.5875618, &options, arena, &system, &error), &error);
    double best = INFINITY;
    enum { COUNT = 1024 };
    for (int turn = 0; turn < TURNS; turn++) {
        struct arena_mark mark = arena_mark(arena);
        struct rays rays = rays_new(arena, COUNT);
        for (size_t i = 0; i < COUNT; i++) {
            const struct ray ray = {.point = {0, (double)i * 20 / COUNT, 0}, .cosine = {0, 0, 1}};
            rays_set(&rays, i, system.index_first, &ray);
        }
        double start = clock_time();
        rays_trace(&system, &rays, NULL);
        best = fmin(best, clock_time() - start);
        arena_reset(arena, mark);
    }
    return 1e9 * best / COUNT;
}

/* The double Gauss at the d line, fields to 14 degrees, nothing clipped. */
struct subject {
    struct lens lens;
    struct setup setup;
    struct ray_data_request request;
    size_t count;           /* of rays */
    struct thick_rays part; /* the last that were traced */
    struct thick_fit fit;
    double trace_time, fit_time; /* s */
};

static void open_subject(struct subject *subject, struct arena *arena)
{
    static const struct setup_field fields[] = {{{FIELD_ANGLE, {0, 0}}, 1},
                                                {{FIELD_ANGLE, {0, 0.06}}, 1},
                                                {{FIELD_ANGLE, {0, 0.12}}, 1},
                                                {{FIELD_ANGLE, {0, 0.18}}, 1},
                                                {{FIELD_ANGLE, {0, 0.24}}, 1}};
    struct error error;
    struct lensdb db = {.arena = arena};
    need(lens_open(&db, text_of("double-gauss"), arena, &subject->lens, &error), &error);
    const struct setup_question question = {.lens = &subject->lens,
                                            .wavelength = 0.5875618,
                                            .fnumber = NAN,
                                            .fields = fields,
                                            .field_count = 5,
                                            .field_policy = FIELDS_SPREAD};
    need(setup_open(&question, arena, &subject->setup, &error), &error);
    subject->request = (struct ray_data_request){
        .setup = &subject->setup, .pattern = PATTERN_SQUARE, .ray_count = 200, .no_clip = true};
    subject->trace_time = subject->fit_time = INFINITY;
}

/* Trace and fit once; what is in the arena stays until the next turn. */
static void run_once(struct subject *subject, struct arena *work)
{
    const struct first_order *first = &subject->setup.first;
    struct error error;
    struct ray_data ray_data;
    const struct ray_part *part;
    struct thick_sums sums = thick_sums_open(subject->setup.field_count,
                                             subject->setup.wavelength_count, INFINITY, work);
    double trace_time = 0, fit_time = 0, start = clock_time();
    need(ray_data_open(&subject->request, work, &ray_data, &error), &error);
    while ((part = ray_data_next(&ray_data)) != NULL) {
        trace_time += clock_time() - start;
        start = clock_time();
        need(thick_sums_add(&sums, &part->rays, &error), &error);
        fit_time += clock_time() - start;
        subject->part = part->rays;
        start = clock_time();
    }
    subject->trace_time = fmin(subject->trace_time, trace_time + clock_time() - start);
    subject->count = sums.count;
    const struct thick_task task = {
        .sums = &sums,
        .group_count = 1,
        .index_object = ray_data.index_object,
        .index_image = ray_data.index_image,
        .planes = {first->image, first->exit_pupil},
        .plane_weights = {1, THICK_PUPIL_WEIGHT},
        .focus_weight = THICK_FOCUS_WEIGHT,
        .object = INFINITY,
        .start = {first->efl, first->front_principal, first->rear_principal, 1, 1, {0}, INFINITY}};
    start = clock_time();
    need(thick_fit(&task, work, &subject->fit, &error), &error);
    subject->fit_time = fmin(subject->fit_time, fit_time + clock_time() - start);
}

int main(void)
{
    struct arena arena = {0}, work = {0};
    struct subject subject;
    open_subject(&subject, &arena);
    for (int turn = 0; turn < TURNS; turn++) {
        arena_reset(&work, (struct arena_mark){0});
        run_once(&subject, &work);
    }
    const struct thick_lens *thick = &subject.fit.lenses[0];
    struct thick_lens thin = *thick;
    thin.front = subject.setup.first.length + thin.rear;
    printf("count %zu\niterations %ld\n", subject.count, subject.fit.summary.iterations);
    printf("fit %.1f\nrays %.1f\n", 1e6 * subject.fit_time, 1e6 * subject.trace_time);
    printf("exact %.2f\n", time_exact(&subject.lens, &subject.setup.first, &arena));
    printf("thick %.2f\nthin %.2f\n", time_map(&subject.part, thick),
           time_map(&subject.part, &thin));
    return 0;
}
