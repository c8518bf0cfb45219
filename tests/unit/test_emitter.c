/* tests/unit/test_emitter.c - places on a lamp itself. */
/* SPDX-License-Identifier: MIT */
#include "scene/emitter.h"

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
    return check_report();
}
