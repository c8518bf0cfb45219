/* tests/unit/test_emitter.c - places on a lamp itself; spheres from within and from outside. */
/* SPDX-License-Identifier: MIT */
#include "scene/emitter.h"

#include "base/constants.h"
#include "check.h"

static const struct scene_thing box = {
    .shape = SHAPE_BOX,
    .where = {.turned = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
    .size = {20, 16, 12},
};

/* How many of 100 samples there are, and the nearest. */
static int count_samples(struct vector from, double *nearest)
{
    const struct scene_pose pose = {box.where.at, box.where.turned};
    int count = 0;
    *nearest = INFINITY;
    for (int i = 0; i < 100; i++) {
        const double u[2] = {(i + 0.5) / 100, fmod(i * 0.6180339887498949, 1)};
        struct emitter_sample ray;
        if (emitter_sample(&box, 0, &pose, from, u, &ray)) {
            count++;
            *nearest = fmin(*nearest, ray.distance);
        }
    }
    return count;
}

/*
 * Of a sphere about its middle all directions are alike: the mean of each component's square is a
 * third. From h = 5 radii away all lie in its cone, of 1 - cos t = 1 - sqrt(1 - 1/25).
 */
static void check_sphere(void)
{
    enum { ACROSS = 64, AROUND = 32, COUNT = ACROSS * AROUND };
    const struct scene_thing sphere = {
        .shape = SHAPE_SPHERE, .where = {.turned = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, .radius = 2};
    const struct scene_pose pose = {sphere.where.at, sphere.where.turned};
    const struct vector places[] = {{0, 0, 0}, {6, -8, 0}};
    const double cap = 1 - sqrt(1 - 1 / 25.0);
    for (int k = 0; k < 2; k++) {
        const struct vector from = places[k], to_middle = {-0.6, 0.8, 0};
        double squares[3] = {0}, highest = 0, heights = 0;
        for (int i = 0; i < COUNT; i++) {
            const double u[2] = {(i % ACROSS + 0.5) / ACROSS, (i / ACROSS + 0.5) / AROUND};
            struct emitter_sample ray;
            CHECK(emitter_sample(&sphere, 0, &pose, from, u, &ray));
            const struct vector at = vector_along(from, ray.distance, ray.direction);
            CHECK_NEAR(vector_length(ray.direction), 1, 1e-14, "a direction");
            CHECK_NEAR(vector_length(at), 2, 1e-12, "on the sphere");
            CHECK_RELATIVE(ray.pdf, k == 0 ? 1 / (4 * PI) : 1 / (2 * PI * cap), 1e-12, "pdf");
            squares[0] += ray.direction.x * ray.direction.x / COUNT;
            squares[1] += ray.direction.y * ray.direction.y / COUNT;
            squares[2] += ray.direction.z * ray.direction.z / COUNT;
            const double height = 1 - vector_dot(ray.direction, to_middle);
            highest = fmax(highest, height);
            heights += height / COUNT;
            CHECK(k == 0 || ray.distance < 10);
        }
        for (int axis = 0; axis < 3 && k == 0; axis++) {
            CHECK_NEAR(squares[axis], 1 / 3.0, 1e-3, "all directions alike");
        }
        CHECK(k == 0 || highest <= cap);
        CHECK_NEAR(heights, k == 0 ? 1 : cap / 2, 1e-9, "evenly over the cap");
    }
}

/* On its own side a box lights nothing; within, the other five sides do, all of that. */
int main(void)
{
    double nearest;
    CHECK(count_samples((struct vector){1, 8 + 1e-12, 2}, &nearest) == 0);
    CHECK(count_samples((struct vector){1, 8 + 1e-3, 2}, &nearest) == 100);
    CHECK(count_samples((struct vector){1, 8 - 1e-12, 2}, &nearest) == 100 && nearest > 4);
    /* on two sides at once, an edge */
    CHECK(count_samples((struct vector){10 + 1e-12, 8 + 1e-12, 2}, &nearest) == 0);
    CHECK(count_samples((struct vector){10 - 1e-12, 8 - 1e-12, 2}, &nearest) == 100 && nearest > 4);
    check_sphere();
    return check_report();
}
