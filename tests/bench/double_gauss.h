/* tests/bench/double_gauss.h - the lens of plain.h as lenscalc traces it, and how long that takes. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BENCH_DOUBLE_GAUSS_H
#define LENSCALC_BENCH_DOUBLE_GAUSS_H

#include "clock.h"
#include "exchange/lens_open.h"
#include "plain.h"
#include "trace/dispatch.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TURNS = 60, RAYS = PLAIN_RAYS };

static const char gauss[] = "medium 1\nfield angle 0\naperture stop\n"
                            "surface 58.950 7.520 1.670 50.4\nsurface 169.660 0.240 air 50.4\n"
                            "surface 38.550 8.050 1.670 46.0\nsurface 81.540 6.550 1.699 46.0\n"
                            "surface 25.500 11.410 air 36.0\nstop - 9.000 air 34.2\n"
                            "surface -28.990 2.360 1.603 34.0\nsurface 81.540 12.130 1.658 40.0\n"
                            "surface -40.770 0.380 air 40.0\nsurface 874.130 6.440 1.717 40.0\n"
                            "surface -79.460 72.228 air 40.0\n";

static struct ray ray_of(size_t i)
{
    const struct plain_ray ray = plain_start(i);
    const double length = sqrt(ray.l * ray.l + ray.m * ray.m + ray.n * ray.n);
    return (struct ray){.point = {ray.x, ray.y, ray.z},
                        .cosine = {ray.l / length, ray.m / length, ray.n / length}};
}

struct fixture {
    struct arena arena;
    struct lens lens;
    struct system system;
    struct rays start, rays;
};

static void set_up(struct fixture *fixture, const char *text, bool clip, bool path, size_t count)
{
    struct error error;
    struct system_options options = system_options_default();
    options.clip = clip;
    options.path = path;
    options.image = 72.2;
    if (!lens_read("bench", text_of(text), NULL, &fixture->arena, &fixture->lens, &error) ||
        !system_compile(&fixture->lens, 0.5875618, &options, &fixture->arena, &fixture->system,
                        &error)) {
        fprintf(stderr, "bench: %s\n", error.message);
        exit(1);
    }
    fixture->start = rays_new(&fixture->arena, count);
    fixture->rays = rays_new(&fixture->arena, count);
    for (size_t i = 0; i < count; i++) {
        struct ray ray = ray_of(i);
        rays_set(&fixture->start, i, 1, &ray);
    }
}

/* Seconds for all rays; rays are set anew each time, as any use of them does. */
static double time_rays(struct fixture *fixture, const struct trace_way *way, int repeat)
{
    double best = 1e9;
    size_t bytes = rays_blocks(&fixture->start) * sizeof(struct ray_block);
    for (int turn = 0; turn < TURNS; turn++) {
        double began = clock_time();
        for (int again = 0; again < repeat; again++) {
            memcpy(fixture->rays.blocks, fixture->start.blocks, bytes);
            rays_trace(&fixture->system, &fixture->rays, way);
        }
        best = fmin(best, (clock_time() - began) / repeat);
    }
    return best;
}

static inline double million(const struct fixture *fixture, double seconds)
{
    return (double)fixture->rays.count * (double)fixture->system.places / seconds / 1e6;
}

/* The double Gauss with something behind the numbers of every curved surface. */
static char *gauss_with(struct arena *arena, const char *extra)
{
    char *text = arena_array(arena, 4096, 1), *to = text;
    for (const char *line = gauss; *line != '\0';) {
        size_t length = strcspn(line, "\n");
        bool curved = strncmp(line, "surface", 7) == 0;
        to += sprintf(to, "%.*s%s\n", (int)length, line, curved ? extra : "");
        line += length + 1;
    }
    return text;
}

#endif
