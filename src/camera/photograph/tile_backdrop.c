/* camera/photograph/tile_backdrop.c - the rays of a tile as a ball and a cone of ways in the scene. */
/* SPDX-License-Identifier: MIT */
#include "camera/photograph/tile_backdrop.h"

#include <math.h>

enum { X, Y };

bool tile_sees_backdrop(const struct view *view, const struct backdrop *backdrop,
                        const struct tile_rims *rims, struct card_light *light)
{
    /* the middle of where they start, and of where they go, in the lens's coordinates */
    struct ray_block middle = {.z = {0}};
    double count = 0;
    for (size_t pass = 0; pass < rims->passes; pass++) {
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            if (rims->passed[pass][i]) {
                const struct depth_card_ray *ray = &rims->ray[pass][i];
                const double r =
                    -1 / sqrt(1 + ray->slope[X] * ray->slope[X] + ray->slope[Y] * ray->slope[Y]);
                middle.x[0] += ray->x[X];
                middle.y[0] += ray->x[Y];
                middle.p[0] += r * ray->slope[X];
                middle.q[0] += r * ray->slope[Y];
                middle.r[0] += r;
                count++;
            }
        }
    }
    middle.x[0] /= count;
    middle.y[0] /= count;
    /* the same in the scene, with what is around them */
    const struct vector way = vector_unit((struct vector){middle.p[0], middle.q[0], middle.r[0]});
    const struct world_ray ray = view_ray(&view->camera, view->pupil, &middle, 0, 0);
    struct backdrop_rays rays = {.center = ray.origin, .direction = ray.direction};
    for (size_t pass = 0; pass < rims->passes; pass++) {
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            if (rims->passed[pass][i]) {
                const struct depth_card_ray *rim = &rims->ray[pass][i];
                const struct vector along = {-rim->slope[X], -rim->slope[Y], -1};
                rays.radius =
                    fmax(rays.radius, hypot(rim->x[X] - middle.x[0], rim->x[Y] - middle.y[0]));
                rays.angle = fmax(rays.angle, atan2(vector_length(vector_cross(way, along)),
                                                    vector_dot(way, along)));
            }
        }
    }
    rays.radius = (1 + 2 * rims->around) * (rays.radius + rims->before);
    rays.angle *= 1 + 2 * rims->around;
    const struct lanes lanes = {CARD_CHANNELS, {0, 1, 2}};
    struct radiance radiance;
    if (!backdrop_is_uniform(backdrop, &rays, &lanes, &radiance)) {
        return false;
    }
    for (size_t lane = 0; lane < lanes.count; lane++) {
        for (size_t k = 0; k < CARD_CHANNELS; k++) {
            light->of[k] += (float)(radiance.of[lane] * view->bands->rgb[lane][k]);
        }
    }
    return true;
}
