/* tests/unit/test_aperture.c - listed apertures: the same bits everywhere, and quadrature. */
/* SPDX-License-Identifier: MIT */
#include "analysis/pupil/quadrature.h"
#include "base/constants.h"
#include "check.h"
#include "file/lens_file.h"
#include "optics/aperture.h"
#include "trace/dispatch.h"

#include <string.h>

static struct system system_of(const char *text, struct lens *lens, struct arena *arena)
{
    struct system system;
    struct error error = {0};
    struct system_options options = system_options_default();
    options.clip = true;
    CHECK(lens_read("t.lens", text_of(text), NULL, arena, lens, &error));
    CHECK(system_compile(lens, 0.55, &options, arena, &system, &error));
    return system;
}

/* Ray by ray the same fate and the same bits, in blocks and a few at a time. */
static void test_bits(void)
{
    static const char *text = "aperture stop\nstop - 5 air 20\nblock spider 1 3 turn=20\n"
                              "surface 30 6 1.6 22 k=-0.5 decenter=0.3,0.2 tilt=3,2\n"
                              "pass polygon -9,-8 9,-8 8,8 0,5 -8,8 turn=7\nblock ring 3 5\n"
                              "surface -80 40 air 22 A4=1e-6\npass ellipse 18 14\n";
    static const enum instruction_set sets[] = {SET_SSE2, SET_AVX2, SET_AVX512};
    struct arena arena = {0};
    struct lens lens;
    const struct system system = system_of(text, &lens, &arena);
    enum { COUNT = 40 * RAYS_BLOCK };
    struct rays rays[3], few = rays_new(&arena, RAYS_FEW);
    size_t clipped = 0;
    for (size_t s = 0; s < 3; s++) {
        rays[s] = rays_new(&arena, COUNT);
        for (size_t i = 0; i < COUNT; i++) {
            const struct ray ray = {.point = {12 * sin((double)i), 12 * sin(1.7 * (double)i), -3},
                                    .cosine = {0, 0, 1}};
            rays_set(&rays[s], i, 1, &ray);
        }
        const struct trace_way way = {instruction_set_works(sets[s]) ? sets[s] : SET_SSE2, 1};
        for (size_t i = 0; i < RAYS_FEW; i++) {
            const struct ray ray = rays_get(&rays[s], i, 1);
            rays_set(&few, i, 1, &ray);
        }
        rays_trace(&system, &rays[s], &way);
        CHECK(memcmp(rays[0].blocks, rays[s].blocks, rays_blocks(rays) * sizeof *rays->blocks) ==
              0);
    }
    rays_trace(&system, &few, NULL);
    for (size_t i = 0; i < RAYS_FEW; i++) {
        CHECK(memcmp(&few.blocks->x[i], &rays->blocks->x[i], sizeof(double)) == 0);
        CHECK(memcmp(&few.blocks->lost[i], &rays->blocks->lost[i], sizeof(double)) == 0);
    }
    for (size_t i = 0; i < COUNT; i++) {
        clipped += ray_block_status(&rays->blocks[i / RAYS_BLOCK], i % RAYS_BLOCK) == RAY_CLIPPED;
    }
    CHECK(clipped > COUNT / 2 && clipped < COUNT);
    arena_free(&arena);
}

/*
 * Two squares of 2 mm, 4 mm apart, and a square with a hole: what joins their parts is no edge, and
 * lets no light pass. Distances from the edges are those of the parts.
 */
static void test_seams(void)
{
    static const double corners[][10][2] = {
        {{-3, -1}, {-1, -1}, {-1, 1}, {-3, 1}, {-3, -1}, {1, -1}, {3, -1}, {3, 1}, {1, 1}, {1, -1}},
        {{-3, -3},
         {3, -3},
         {3, 3},
         {-3, 3},
         {-3, -3},
         {-1, -1},
         {-1, 1},
         {1, 1},
         {1, -1},
         {-1, -1}}};
    static const struct {
        int polygon;
        double x, y;
        double beyond; /* mm from the edge of a part; below 0 within it */
    } cases[] = {{0, 0, -1, 1},      {0, 0.5, -1, 0.5},
                 {0, 0, 0, 1},       {0, 2, 0, -1},
                 {0, -1.5, 0, -0.5}, {0, 2, -0.75, -0.25},
                 {0, 1, -1, 0},      {0, 0, -2, 1.4142135623730951},
                 {1, -2, -2, -1},    {1, 0, 0, 1},
                 {1, 2, 0, -1},      {1, -1.5, -1.5, -0.7071067811865476}};
    struct arena arena = {0};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct figure points[10][2] = {0};
        struct error error = {0};
        struct aperture aperture = aperture_of(SHAPE_POLYGON, false);
        for (size_t k = 0; k < 20; k++) {
            points[k / 2][k % 2].value.hi = corners[cases[i].polygon][k / 2][k % 2];
        }
        aperture.points = (const struct figure(*)[2])points;
        aperture.point_count = 10;
        CHECK(aperture_check(&aperture, &error));
        const struct aperture_form form = aperture_form_of(&aperture, &arena);
        CHECK_NEAR(aperture_excess(&form, cases[i].x, cases[i].y) * form.radius, cases[i].beyond,
                   1e-15, "beyond the edge of a part");
        CHECK(aperture_passes(&form, cases[i].x, cases[i].y) == (cases[i].beyond <= 0));
        CHECK(aperture_part(&form, cases[i].x, cases[i].y) != 4);
        CHECK(aperture_part(&form, cases[i].x, cases[i].y) != 9);
    }
    arena_free(&arena);
}

/* The weights add up to the clear share of the stop, and r^2 has its mean over it. */
static void test_quadrature(void)
{
    static const struct {
        const char *apertures;
        double share, square; /* integrals of 1 and of r^2 over the stop of radius 1, over pi */
        double tolerance;
    } cases[] = {
        {"block circle 10\n", 0.75, (1 - 1 / 16.0) / 2, 1e-10},
        {"pass rectangle 10 8\n", 80 / (100 * PI), 80 * (100 + 64) / (12 * 1e4 * PI), 1e-6},
        {"pass ring 6 16\n", 0.64 - 0.09, (0.4096 - 0.0081) / 2, 1e-9},
        {"block ellipse 8 4\n", 1 - 0.08, 0.5 - 0.08 * (0.16 + 0.04) / 4, 1e-7}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct arena arena = {0};
        struct lens lens;
        const char *text = arena_printf(&arena,
                                        "aperture stop\nstop - 5 air 20\n%s"
                                        "thick 100 100 air 40\n",
                                        cases[i].apertures);
        const struct system system = system_of(text, &lens, &arena);
        const struct beam beam = beam_from_infinity((double[2]){0, 0}, 1);
        const struct stop_beam stop = {
            .system = &system, .beam = &beam, .axes = {10, 0, 0, 10}, .radius = 10};
        const struct quadrature all = quadrature_make(&stop, 400, &arena);
        double sum = 0, square = 0;
        for (size_t k = 0; k < all.sample.count; k++) {
            const struct pupil_point *point = &all.sample.points[k];
            sum += point->weight;
            square += point->weight * (point->x * point->x + point->y * point->y);
        }
        CHECK(!all.is_empty);
        CHECK_RELATIVE(sum, cases[i].share, cases[i].tolerance, cases[i].apertures);
        CHECK_RELATIVE(square, cases[i].square, cases[i].tolerance, "mean of r^2");
        rays_trace(&system, &all.rays, NULL);
        for (size_t k = 0; k < all.sample.count; k++) {
            CHECK(rays_get(&all.rays, k, 1).status == RAY_OK);
        }
        arena_free(&arena);
    }
}

int main(void)
{
    test_bits();
    test_seams();
    test_quadrature();
    return check_report();
}
