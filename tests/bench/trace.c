/* tests/bench/trace.c - exact rays: lanes of each instruction set against a plain loop. */
/* SPDX-License-Identifier: MIT */
#include "base/parallel.h"
#include "clock.h"
#include "divider.h"
#include "exchange/lens_open.h"
#include "plain.h"
#include "trace/derivative.h"
#include "trace/dispatch.h"
#include "trace/tangent.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/*
 * Prints one figure a line, "name value": million ray-surfaces a second of the double Gauss with
 * clipping (12 surfaces with stop and image), plain and by instruction set, ratios in one run,
 * what features cost, and the gain of two threads; plain.h has the plain loop.
 */
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
    return (struct ray){.point = {ray.x, ray.y, ray.z}, .cosine = {ray.l, ray.m, ray.n}};
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

static double million(const struct fixture *fixture, double seconds)
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

static double cost(const char *extra, bool path, double base)
{
    struct fixture fixture = {0};
    char *text = gauss_with(&fixture.arena, extra);
    set_up(&fixture, text, true, path, RAYS);
    double seconds = time_rays(&fixture, NULL, 5);
    arena_free(&fixture.arena);
    return seconds / base;
}

/* A lens of a telephone, with aspheres all over. */
static double phone(void)
{
    struct fixture fixture = {0};
    struct lensdb db = {.arena = &fixture.arena};
    struct error error;
    struct system_options options = system_options_default();
    options.clip = true;
    if (!lens_open(&db, text_of("phone-80deg"), &fixture.arena, &fixture.lens, &error) ||
        !system_compile(&fixture.lens, 0.5875618, &options, &fixture.arena, &fixture.system,
                        &error)) {
        fprintf(stderr, "bench: %s\n", error.message);
        exit(1);
    }
    fixture.start = rays_new(&fixture.arena, RAYS);
    fixture.rays = rays_new(&fixture.arena, RAYS);
    for (size_t i = 0; i < RAYS; i++) {
        struct ray ray = ray_of(i);
        ray.point[0] *= 0.05;
        ray.point[1] *= 0.05;
        rays_set(&fixture.start, i, 1, &ray);
    }
    double figure = million(&fixture, time_rays(&fixture, NULL, 5));
    arena_free(&fixture.arena);
    return figure;
}

/* All first derivatives of x and y by curvatures, thicknesses, indices and the entrance ray. */
static double time_derivatives(struct fixture *fixture)
{
    struct derivative_layout layout;
    derivative_layout(&fixture->system, 0, &fixture->arena, &layout);
    struct derivative_tape tape = derivative_tape_new(&fixture->system, &fixture->arena);
    double *gradient = ARENA_ARRAY(&fixture->arena, layout.rows * RAYS_BLOCK, double);
    static struct ray_block adjoint;
    double best = 1e9;
    for (int turn = 0; turn < TURNS; turn++) {
        double began = clock_time();
        for (int again = 0; again < 5; again++) {
            for (size_t i = 0; i < rays_blocks(&fixture->start); i++) {
                derivative_trace(&fixture->system, &fixture->start.blocks[i], SET_BEST, &tape);
                for (int output = 0; output < 2; output++) {
                    memset(&adjoint, 0, sizeof adjoint);
                    for (int lane = 0; lane < RAYS_BLOCK; lane++) {
                        (output == 0 ? adjoint.x : adjoint.y)[lane] = 1;
                    }
                    derivative_sweep(&fixture->system, &layout, SET_BEST, &tape, &adjoint,
                                     gradient);
                }
            }
        }
        best = fmin(best, (clock_time() - began) / 5);
    }
    return best;
}

/* A trace that is kept and `count` tangents: curvatures of the first surfaces. */
static double time_tangents(struct fixture *fixture, size_t count)
{
    struct derivative_tape tape = derivative_tape_new(&fixture->system, &fixture->arena);
    struct rays tangents = rays_new(&fixture->arena, count * RAYS_BLOCK);
    struct parameter by[TANGENTS_MOST];
    double best = 1e9;
    for (size_t j = 0; j < count; j++) {
        by[j] = (struct parameter){j < 5 ? j : j + 1, PARAMETER_CURVATURE, 0};
    }
    for (int turn = 0; turn < TURNS * 4; turn++) {
        double began = clock_time();
        for (int again = 0; again < 5; again++) {
            for (size_t i = 0; i < rays_blocks(&fixture->start); i++) {
                derivative_trace(&fixture->system, &fixture->start.blocks[i], SET_BEST, &tape);
                memset(tangents.blocks, 0, count * sizeof *tangents.blocks);
                tangent_trace(&fixture->system, by, count, SET_BEST, &tape, tangents.blocks);
            }
        }
        best = fmin(best, (clock_time() - began) / 5);
    }
    return best;
}

static double gain(size_t count)
{
    struct fixture fixture = {0};
    set_up(&fixture, gauss, true, false, count);
    const struct trace_way two = {SET_BEST, 2};
    double one = 1e9, both = 1e9;
    for (int i = 0; i < TURNS / 2; i++) {
        double began = clock_time();
        rays_trace(&fixture.system, &fixture.start, NULL);
        one = fmin(one, clock_time() - began);
        began = clock_time();
        rays_trace(&fixture.system, &fixture.start, &two);
        both = fmin(both, clock_time() - began);
    }
    arena_free(&fixture.arena);
    return one / both;
}

int main(void)
{
    struct fixture fixture = {0};
    set_up(&fixture, gauss, true, false, RAYS);
    double plain = plain_time(TURNS), base = 0;
    printf("plain %.0f\n", million(&fixture, plain));
    for (enum instruction_set set = SET_SSE2; set <= SET_AVX512; set++) {
        if (instruction_set_works(set)) {
            const struct trace_way way = {set, 1};
            double seconds = time_rays(&fixture, &way, 5);
            plain = fmin(plain, plain_time(TURNS));
            printf("%s %.0f\n%s/plain %.2f\n", instruction_set_name(set),
                   million(&fixture, seconds), instruction_set_name(set), plain / seconds);
            /* 10 spheres are all that needs the divider much; planes count, but cost little */
            const double limit = divider_spheres(set) * 12 / 10.8;
            if (limit > 0) {
                printf("%s_limit %.0f\n%s/limit %.3f\n", instruction_set_name(set), limit,
                       instruction_set_name(set), million(&fixture, seconds) / limit);
            }
            base = seconds;
        }
    }
    base = fmin(base, time_rays(&fixture, NULL, 5));
    printf("path %.2f\n", cost("", true, base));
    printf("conic %.2f\n", cost(" k=-0.01", false, base));
    printf("asphere %.2f\n", cost(" k=-0.01 A4=1e-8 A6=1e-12 A8=1e-16", false, base));
    printf("phone %.3f\n", phone() / million(&fixture, base));
    printf("derivatives %.2f\n", time_derivatives(&fixture) / base);
    for (size_t count = 1; count <= TANGENTS_MOST; count *= 2) {
        printf("tangents_%zu %.2f\n", count, time_tangents(&fixture, count) / base);
    }
    printf("threads_1e5 %.2f\n", gain(100000));
    printf("threads_1e6 %.2f\n", gain(1000000));
    arena_free(&fixture.arena);
    return 0;
}
