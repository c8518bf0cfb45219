/* tests/bench/trace.c - exact rays: lanes of each instruction set against a plain loop. */
/* SPDX-License-Identifier: MIT */
#include "base/parallel.h"
#include "clock.h"
#include "divider.h"
#include "double_gauss.h"
#include "exchange/lens_open.h"
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
