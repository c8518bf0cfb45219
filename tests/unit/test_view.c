/* tests/unit/test_view.c - a camera in a scene: where its rays start, and where they go. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "camera/subject/view.h"
#include "check.h"

static void check_vector(struct vector found, struct vector wanted, const char *what)
{
    CHECK_NEAR(found.x, wanted.x, 1e-12, what);
    CHECK_NEAR(found.y, wanted.y, 1e-12, what);
    CHECK_NEAR(found.z, wanted.z, 1e-12, what);
}

/* A ray 1 mm right of and 2 mm above the vertex of the first surface, at z = 3 of the lens, whose
   entrance pupil lies 20 mm behind the vertex; it goes to the left: 3, 4, 12 and 13. */
static const struct ray_block rays = {.x = {9, 1},
                                      .y = {9, 2},
                                      .z = {9, 3},
                                      .p = {0, -3.0 / 13},
                                      .q = {0, 4.0 / 13},
                                      .r = {-1, -12.0 / 13}};

int main(void)
{
    /* upright, at (100, 200, 300): the pupil is there, and the ray starts 17 mm before it */
    struct scene_place place = {
        .at = {100, 200, 300}, .turned = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, .axis = {0, 1, 0}};
    struct world_ray ray = view_ray(&place, 20, &rays, 1, 0);
    check_vector(ray.origin, (struct vector){101, 202, 283}, "upright: from");
    check_vector(ray.direction, (struct vector){-3.0 / 13, 4.0 / 13, -12.0 / 13}, "upright: way");
    CHECK(ray.time == 0 && isinf(ray.farthest));

    /* it looks along +x: its right is +z, its back -x */
    place.turned = (struct frame){{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}};
    ray = view_ray(&place, 20, &rays, 1, 0);
    check_vector(ray.origin, (struct vector){117, 202, 301}, "to the right: from");
    check_vector(ray.direction, (struct vector){12.0 / 13, 4.0 / 13, -3.0 / 13},
                 "to the right: way");

    /* after 0.5 s: 5 mm along y, and a quarter turn about y, right-handed: +x goes to -z */
    place.velocity = (struct vector){0, 10, 0};
    place.spin = PI;
    ray = view_ray(&place, 20, &rays, 1, 0.5);
    check_vector(ray.origin, (struct vector){101, 207, 283}, "later: from");
    check_vector(ray.direction, (struct vector){-3.0 / 13, 4.0 / 13, -12.0 / 13}, "later: way");
    CHECK(ray.time == 0.5);

    /* a way that is not of length 1 becomes one */
    struct ray_block twice = rays;
    twice.r[0] = -2;
    check_vector(view_ray(&place, 20, &twice, 0, 0).direction, (struct vector){1, 0, 0},
                 "of length 1");
    return check_report();
}
