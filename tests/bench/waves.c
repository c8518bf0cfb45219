/* tests/bench/waves.c - wave fronts, contrast, images of points, and Fourier transforms. */
/* SPDX-License-Identifier: MIT */
#include "analysis/image/mtf.h"
#include "analysis/image/psf.h"
#include "analysis/waves/wavefront.h"
#include "base/constants.h"
#include "base/fft.h"
#include "clock.h"
#include "exchange/lens_open.h"
#include "trace/dispatch.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/*
 * Prints one figure a line, "name value": Fourier transforms of squares; a map of the wave front of
 * the double Gauss at f/8 and 10 degrees over 64 x 64 points, against the bare trace of its rays;
 * contrasts of three fields at 10, 20, 40 and 80 per mm in both directions; images of a point with
 * 128 x 128 pixels by plane waves and by wavelets. All at the d line. Times are of the processor,
 * the least of some turns.
 */
enum { MAP = 64, FIELDS = 3 };

struct fixture {
    struct arena arena;
    struct lens lens;
    struct setup setup;
    struct setup_field fields[FIELDS];
};

static void stop(const struct error *error)
{
    fprintf(stderr, "waves: %s\n", error->message);
    exit(1);
}

static void set_up(struct fixture *fixture)
{
    static const double degrees[FIELDS] = {0, 10, 14};
    struct arena *arena = &fixture->arena;
    struct lensdb db = {.arena = arena};
    struct error error;
    for (size_t f = 0; f < FIELDS; f++) {
        fixture->fields[f] =
            (struct setup_field){{FIELD_ANGLE, {0, degrees[f] * RADIANS_PER_DEGREE}}, 1};
    }
    const struct setup_question question = {.lens = &fixture->lens,
                                            .wavelength = NAN,
                                            .wavelengths = WAVELENGTHS_PRIMARY,
                                            .fnumber = 8,
                                            .fields = fixture->fields,
                                            .field_count = FIELDS};
    if (!lens_open(&db, text_of("double-gauss"), arena, &fixture->lens, &error) ||
        !setup_open(&question, arena, &fixture->setup, &error) ||
        !setup_place_image(&fixture->setup, &(struct plane_value){.kind = PLANE_PARAXIAL},
                           &error)) {
        stop(&error);
    }
}

static struct bundle_question bundle_of(const struct fixture *fixture, size_t field)
{
    return (struct bundle_question){
        .setup = &fixture->setup, .field = &fixture->fields[field].point, .clip = true};
}

static double time_fft(struct arena *arena, size_t size, int turns)
{
    const struct arena_mark mark = arena_mark(arena);
    const struct fft fft = fft_open(size, arena);
    double *re = ARENA_ARRAY(arena, size * size, double), best = INFINITY;
    double *im = ARENA_ARRAY(arena, size * size, double);
    for (int turn = 0; turn < turns; turn++) {
        for (size_t i = 0; i < size * size; i++) {
            re[i] = (double)(i % 17);
            im[i] = (double)(i % 5);
        }
        const double began = processor_time();
        fft_plane(&fft, turn % 2 == 0, re, im, arena);
        best = fmin(best, processor_time() - began);
    }
    arena_reset(arena, mark);
    return best;
}

/* A map, and the bare trace of as many rays as lie in its circle. */
static void time_map(struct fixture *fixture, double *map, double *trace)
{
    struct wavefront_source source;
    struct error error;
    struct arena *arena = &fixture->arena;
    const struct wavefront_question question = {.bundle = bundle_of(fixture, 1), .error = 1e-4};
    if (!wavefront_open(&question, arena, &source, &error)) {
        stop(&error);
    }
    const struct system *system = source.lights.list[0].system;
    struct rays rays = rays_new(arena, (size_t)(PI / 4 * MAP * MAP));
    *map = *trace = INFINITY;
    for (int turn = 0; turn < 100; turn++) {
        const struct arena_mark mark = arena_mark(arena);
        double began = processor_time();
        wavefront_map(&source, MAP, arena);
        *map = fmin(*map, processor_time() - began);
        for (size_t i = 0; i < rays.count; i++) {
            rays_set(&rays, i, 1, &source.lights.list[0].source.chief);
        }
        began = processor_time();
        rays_trace(system, &rays, NULL);
        *trace = fmin(*trace, processor_time() - began);
        arena_reset(arena, mark);
    }
}

static double time_mtf(struct fixture *fixture)
{
    static const double frequencies[] = {10, 20, 40, 80};
    double best = INFINITY;
    for (int turn = 0; turn < 20; turn++) {
        const struct arena_mark mark = arena_mark(&fixture->arena);
        const double began = processor_time();
        for (size_t f = 0; f < FIELDS; f++) {
            const struct mtf_question question = {.bundle = bundle_of(fixture, f), .error = 1e-5};
            struct mtf_source source;
            struct mtf mtf;
            struct error error;
            if (!mtf_open(&question, &fixture->arena, &source, &error)) {
                stop(&error);
            }
            for (size_t i = 0; i < sizeof frequencies / sizeof frequencies[0]; i++) {
                if (!mtf_find(&source, frequencies[i], &fixture->arena, &mtf, &error)) {
                    stop(&error);
                }
            }
        }
        best = fmin(best, processor_time() - began);
        arena_reset(&fixture->arena, mark);
    }
    return best;
}

static double time_psf(struct fixture *fixture, enum psf_method method, int turns)
{
    const struct psf_question question = {
        .bundle = bundle_of(fixture, 0), .method = method, .size = 128, .pitch = NAN};
    double best = INFINITY;
    for (int turn = 0; turn < turns; turn++) {
        const struct arena_mark mark = arena_mark(&fixture->arena);
        struct psf psf;
        struct error error;
        const double began = processor_time();
        if (!psf_find(&question, &fixture->arena, &psf, &error)) {
            stop(&error);
        }
        best = fmin(best, processor_time() - began);
        arena_reset(&fixture->arena, mark);
    }
    return best;
}

int main(void)
{
    static struct fixture fixture;
    double map, trace;
    set_up(&fixture);
    printf("fft256 %.3f\nfft512 %.3f\n", 1e3 * time_fft(&fixture.arena, 256, 100),
           1e3 * time_fft(&fixture.arena, 512, 40));
    time_map(&fixture, &map, &trace);
    printf("map %.3f\nmap/trace %.2f\n", 1e3 * map, map / trace);
    printf("mtf %.2f\n", 1e3 * time_mtf(&fixture));
    printf("plane %.2f\nfft %.2f\nhuygens %.1f\n", 1e3 * time_psf(&fixture, PSF_PLANE, 10),
           1e3 * time_psf(&fixture, PSF_FFT, 5), 1e3 * time_psf(&fixture, PSF_HUYGENS, 2));
    arena_free(&fixture.arena);
    return 0;
}
