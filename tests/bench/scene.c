/* tests/bench/scene.c - rays through scenes, against triangles that are tried one after another. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "base/parallel.h"
#include "base/random.h"
#include "clock.h"
#include "scene/world.h"

#include <stdio.h>
#include <stdlib.h>

/*
 * Prints one figure a line, "name value". The mesh is a globe with hills of two sizes. Random rays
 * are chords of a sphere about it, whose neighbours have nothing to do with each other; those of a
 * picture come row by row from one place. Times are of the processor, the least of many turns;
 * those of threads by the clock.
 */
enum { TURNS = 7, RAYS = 1 << 18, TRIED = 100, SIDE = 512 };

static const double radius = 100, around = 130;

struct fixture {
    struct arena arena;
    struct scene_mesh mesh;
    struct scene_thing thing;
    struct scene scene;
    struct world world;
    struct world_ray *random, *picture;
    size_t met;
};

/* -------- what is looked at -------- */

static struct vector on_globe(double down, double turn)
{
    const double hills = 0.1 * sin(9 * turn) * sin(11 * down);
    const double r = radius * (1 + hills * sin(down) + 0.02 * sin(70 * down) * sin(64 * turn));
    return (struct vector){r * sin(down) * cos(turn), r * cos(down), r * sin(down) * sin(turn)};
}

/* Of rows x 2 rows x 2 triangles. */
static void fill_mesh(struct fixture *fixture, size_t rows)
{
    const size_t columns = 2 * rows;
    struct vector *corners = ARENA_ARRAY(&fixture->arena, (rows + 1) * columns, struct vector);
    size_t(*triangles)[3] = arena_array(&fixture->arena, 2 * rows * columns, sizeof *triangles);
    size_t count = 0;
    for (size_t i = 0; i <= rows; i++) {
        for (size_t j = 0; j < columns; j++) {
            corners[i * columns + j] =
                on_globe(PI * (double)i / (double)rows, 2 * PI * (double)j / (double)columns);
        }
    }
    for (size_t i = 0; i < rows * columns; i++) {
        const size_t right = i % columns + 1 < columns ? i + 1 : i + 1 - columns;
        const size_t of[2][3] = {{i, right, i + columns}, {right, right + columns, i + columns}};
        for (size_t k = 0; k < 6; k++) {
            triangles[count + k / 3][k % 3] = of[k / 3][k % 3];
        }
        count += 2;
    }
    fixture->mesh = (struct scene_mesh){.file = "globe.obj",
                                        .corner_count = (rows + 1) * columns,
                                        .triangle_count = count,
                                        .corners = corners,
                                        .triangles = (const size_t(*)[3])triangles};
}

static struct vector on_sphere(struct random_pair u)
{
    const double z = 2 * u.u - 1, turn = 2 * PI * u.v, r = around * sqrt(1 - z * z);
    return (struct vector){r * cos(turn), r * sin(turn), around * z};
}

static void fill_rays(struct fixture *fixture)
{
    fixture->random = ARENA_ARRAY(&fixture->arena, RAYS, struct world_ray);
    fixture->picture = ARENA_ARRAY(&fixture->arena, RAYS, struct world_ray);
    for (size_t i = 0; i < RAYS; i++) {
        const struct vector from = on_sphere(random_pair(1, i, 0));
        const struct vector to = on_sphere(random_pair(1, i, 1));
        const double x = (double)(i % SIDE) / SIDE - 0.5, y = (double)(i / SIDE) / SIDE - 0.5;
        fixture->random[i] =
            (struct world_ray){from, vector_unit(vector_minus(to, from)), 0, INFINITY};
        fixture->picture[i] = (struct world_ray){
            {0, 0, 400}, vector_unit((struct vector){0.6 * x, 0.6 * y, -1}), 0, INFINITY};
    }
}

/* Returns the seconds that making the scene ready takes. */
static double set_up(struct fixture *fixture, size_t rows)
{
    struct error error;
    fill_mesh(fixture, rows);
    fixture->thing = (struct scene_thing){.shape = SHAPE_MESH,
                                          .where.turned = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                          .mesh = &fixture->mesh};
    fixture->scene = (struct scene){.things = &fixture->thing, .thing_count = 1};
    const double began = processor_time();
    if (!world_open(&fixture->scene, (const double[2]){0, 0}, &fixture->arena, &fixture->world,
                    &error)) {
        fprintf(stderr, "scene: %s\n", error.message);
        exit(1);
    }
    return processor_time() - began;
}

/* -------- how long it takes -------- */

static double time_rays(struct fixture *fixture, const struct world_ray *rays)
{
    double best = INFINITY;
    for (int turn = 0; turn < TURNS; turn++) {
        const double began = processor_time();
        for (size_t i = 0; i < RAYS; i++) {
            struct world_hit hit;
            fixture->met += world_intersect(&fixture->world, &rays[i], &hit) ? 1 : 0;
        }
        best = fmin(best, processor_time() - began);
    }
    return best / RAYS;
}

/* Moeller and Trumbore's way to meet a triangle. */
static bool meets(const struct scene_mesh *mesh, size_t triangle, const struct world_ray *ray)
{
    const size_t *of = mesh->triangles[triangle];
    const struct vector a = mesh->corners[of[0]];
    const struct vector e = vector_minus(mesh->corners[of[1]], a);
    const struct vector f = vector_minus(mesh->corners[of[2]], a);
    const struct vector p = vector_cross(ray->direction, f), s = vector_minus(ray->origin, a);
    const double over = 1 / vector_dot(e, p), u = vector_dot(s, p) * over;
    const struct vector q = vector_cross(s, e);
    const double v = vector_dot(ray->direction, q) * over;
    return u >= 0 && v >= 0 && u + v <= 1 && vector_dot(f, q) * over > 0;
}

/* A ray with the first triangles, without any tree. */
static double time_tries(struct fixture *fixture)
{
    double best = INFINITY;
    for (int turn = 0; turn < TURNS; turn++) {
        const double began = processor_time();
        for (size_t i = 0; i < RAYS / TRIED; i++) {
            for (size_t k = 0; k < TRIED; k++) {
                fixture->met += meets(&fixture->mesh, k, &fixture->random[i]) ? 1 : 0;
            }
        }
        best = fmin(best, processor_time() - began);
    }
    return best / (RAYS / TRIED);
}

static void look(void *context, size_t begin, size_t end)
{
    const struct fixture *fixture = context;
    for (size_t i = begin; i < end; i++) {
        struct world_hit hit;
        world_intersect(&fixture->world, &fixture->random[i], &hit);
    }
}

static double time_threads(struct fixture *fixture, int threads)
{
    double best = INFINITY;
    for (int turn = 0; turn < TURNS; turn++) {
        const double began = clock_time();
        parallel_for(threads, RAYS, RAYS / 64, look, fixture);
        best = fmin(best, clock_time() - began);
    }
    return best;
}

int main(void)
{
    static struct fixture fixture, large;
    set_up(&fixture, 158); /* 99856 triangles */
    fill_rays(&fixture);
    const double random = time_rays(&fixture, fixture.random);
    printf("random %.2f\n", 1e-6 / random);
    printf("picture %.2f\n", 1e-6 / time_rays(&fixture, fixture.picture));
    printf("tries %.2f\n", random / time_tries(&fixture));
    printf("threads %.2f\n", time_threads(&fixture, 1) / time_threads(&fixture, 2));
    printf("build %.2f\n", set_up(&large, 500)); /* 1000000 */
    arena_free(&fixture.arena);
    arena_free(&large.arena);
    return fixture.met > 0 ? 0 : 1;
}
