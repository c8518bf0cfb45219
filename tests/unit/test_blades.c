/* tests/unit/test_blades.c - irises: areas, edges, and what of a beam passes them. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "check.h"
#include "file/lens_file.h"
#include "optics/blades.h"
#include "trace/dispatch.h"

#include <string.h>

static struct arena arena;
static struct error error;

static double polygon_area(const struct aperture *aperture)
{
    double sum = 0;
    for (size_t i = 0; i < aperture->point_count; i++) {
        const struct figure *p = aperture->points[i];
        const struct figure *q = aperture->points[(i + 1) % aperture->point_count];
        sum += p[0].value.hi * q[1].value.hi - q[0].value.hi * p[1].value.hi;
    }
    return sum / 2;
}

/*
 * Straight: (n/2) r^2 sin(2 pi/n). Circle: pi r^2. Half rounded with 6 blades, r = 1, by hand: R =
 * 2, sin a = 1/4, a = 0.252680255142, segment 4 (a - sqrt(15)/16) = 0.0424751774, 6 of them beside
 * 3 sqrt(3)/2 = 2.5980762114.
 */
static void test_areas(void)
{
    static const unsigned counts[] = {3, 5, 6, 8, 9, 64};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        const double n = counts[i];
        const struct blades flat = {counts[i], 0.3, 0}, round = {counts[i], 0, 1};
        CHECK_RELATIVE(blades_area(&flat, 7), n / 2 * 49 * sin(2 * PI / n), 1e-14, "straight");
        CHECK_RELATIVE(blades_area(&round, 7), 49 * PI, 1e-14, "round");
    }
    const struct blades half = {6, 0, 0.5};
    const double segment = 4 * (asin(0.25) - sqrt(15) / 16);
    CHECK_RELATIVE(blades_area(&half, 1), 6 * segment + 1.5 * sqrt(3), 1e-14, "half rounded");
    CHECK_RELATIVE(segment, 0.0424751774, 1e-5, "by hand");
    /* the polygons that stand for them; none bends inwards */
    static const double roundings[] = {0, 1e-7, 1e-5, 0.001, 0.03, 0.3, 0.9, 1};
    for (size_t i = 0; i < 6 * 8; i++) {
        const struct blades blades = {counts[i % 6], 0.1, roundings[i / 6]};
        struct aperture aperture;
        CHECK(blades_aperture(&blades, 7, &arena, &aperture, &error));
        CHECK(aperture_check(&aperture, &error) && !aperture_is_round(&aperture));
        CHECK(aperture.point_count <= 400);
        CHECK_RELATIVE(polygon_area(&aperture), blades_area(&blades, 7), 1e-9, "area");
        CHECK(aperture_hull(&aperture, &arena).point_count == aperture.point_count);
    }
}

/* The edge: at a corner, and in the middle of a blade at r cos(pi/n) + R - sqrt(R^2 - s^2). */
static void test_edges(void)
{
    static const double roundings[] = {0, 0.001, 0.25, 1};
    for (size_t i = 0; i < 4; i++) {
        const struct blades blades = {7, 0.4, roundings[i]};
        struct aperture aperture;
        CHECK(blades_aperture(&blades, 5, &arena, &aperture, &error));
        const struct aperture_form form = aperture_form_of(&aperture, &arena);
        const double s = 5 * sin(PI / 7), R = 5 / (roundings[i] + 1e-300);
        const double bulge = roundings[i] > 0 ? s * s / (R + sqrt(R * R - s * s)) : 0;
        for (int k = 0; k < 14; k++) {
            const double angle = 0.4 + k * PI / 7;
            const double edge = k % 2 == 0 ? 5 : 5 * cos(PI / 7) + bulge;
            for (int side = -1; side <= 1; side += 2) {
                const double r = edge + side * 5 * 1.01e-4;
                CHECK(aperture_passes(&form, r * cos(angle), r * sin(angle)) == (side < 0));
            }
        }
    }
}

/* A beam on a grid through the stop of a lens: what passes is the area, and what was cut stays. */
static void test_beam(void)
{
    static const char *text = "aperture stop\nstop - 5 air 20\nblock circle 2\n"
                              "surface - 10 air 40\n";
    struct lens lens, bladed;
    struct system system;
    struct system_options options = system_options_default();
    options.clip = true;
    CHECK(lens_read("t.lens", text_of(text), NULL, &arena, &lens, &error));
    const struct blades blades = {5, 0.2, 0.4};
    CHECK(blades_stop(&lens, &blades, 6, &arena, &bladed, &error));
    CHECK(lens.surfaces[0].aperture_count == 1 && bladed.surfaces[0].aperture_count == 2);
    CHECK(system_compile(&bladed, 0.55, &options, &arena, &system, &error));
    enum { SIDE = 400 };
    struct rays rays = rays_new(&arena, SIDE * SIDE);
    for (size_t i = 0; i < SIDE * SIDE; i++) {
        const double x = ((double)(i % SIDE) + 0.5) / SIDE, y = ((double)(i / SIDE) + 0.5) / SIDE;
        const struct ray ray = {.point = {14 * x - 7, 14 * y - 7, -1}, .cosine = {0, 0, 1}};
        rays_set(&rays, i, 1, &ray);
    }
    rays_trace(&system, &rays, NULL);
    size_t passed = 0;
    for (size_t i = 0; i < SIDE * SIDE; i++) {
        passed += ray_block_status(&rays.blocks[i / RAYS_BLOCK], i % RAYS_BLOCK) == RAY_OK;
    }
    CHECK_RELATIVE((double)passed * 196 / (SIDE * SIDE), blades_area(&blades, 6) - PI, 1e-3,
                   "area that passes");
}

/* The quick answers near the middle and far away are those of the edge, notches and all. */
static void test_quick(void)
{
    static const double corners[6][2] = {{4, 0}, {1, 1}, {0, 4}, {-1, 1}, {-4, 0}, {0, -4}};
    struct figure star[6][2];
    for (int i = 0; i < 12; i++) {
        star[i / 2][i % 2] = (struct figure){.value = {corners[i / 2][i % 2], 0}};
    }
    for (int blocks = 0; blocks < 2; blocks++) {
        struct aperture aperture = aperture_of(SHAPE_POLYGON, blocks == 1);
        aperture.points = (const struct figure(*)[2])star;
        aperture.point_count = 6;
        aperture.decenter[0].value.hi = 0.5;
        aperture.turn.value.hi = 0.7;
        const struct aperture_form form = aperture_form_of(&aperture, &arena);
        struct aperture_form slow = form;
        slow.within2 = 0;
        int equal = 0;
        for (int i = 0; i < 10000; i++) {
            const double x = (i % 100) * 0.1 - 4.97, y = i / 100 * 0.1 - 4.96;
            equal += aperture_passes(&form, x, y) == aperture_passes(&slow, x, y);
        }
        CHECK(equal == 10000 && form.within2 > 0);
        CHECK(!aperture_passes(&form, NAN, 0));
    }
}

static void refused(unsigned count, double turn, double rounding, double radius)
{
    const struct blades blades = {count, turn, rounding};
    struct aperture aperture;
    CHECK(!blades_aperture(&blades, radius, &arena, &aperture, &error) &&
          error.code == ERROR_DOMAIN);
}

static void test_refused(void)
{
    refused(2, 0, 0, 1);
    refused(65, 0, 0, 1);
    refused(7, NAN, 0, 1);
    refused(7, 0, -0.1, 1);
    refused(7, 0, 1.1, 1);
    refused(7, 0, NAN, 1);
    refused(7, 0, 0, 0);
    refused(7, 0, 0, -1);
    refused(7, 0, 0, NAN);
    const struct blades blades = {7, 0, 0};
    struct lens lens, bladed;
    CHECK(lens_read("t.lens", text_of("surface 30 6 1.6 22\nsurface - 10 air 22\n"), NULL, &arena,
                    &lens, &error));
    CHECK(!blades_stop(&lens, &blades, 3, &arena, &bladed, &error));
}

int main(void)
{
    test_areas();
    test_edges();
    test_beam();
    test_quick();
    test_refused();
    arena_free(&arena);
    return check_report();
}
