/* scene/backdrop.c - uniform background: where rays of a cone meet nothing but one even light. */
/* SPDX-License-Identifier: MIT */
#include "scene/backdrop.h"

#include "base/constants.h"

#include <math.h>

/* -------- made ready -------- */

static bool has_one_colour(const struct image *picture)
{
    const size_t count = picture->width * picture->height * picture->channels;
    bool has = true;
    for (size_t i = picture->channels; i < count && has; i++) {
        has = picture->pixels[i] == picture->pixels[i % picture->channels];
    }
    return has;
}

struct backdrop backdrop_open(const struct world *world, const struct lights *lights)
{
    struct backdrop backdrop = {world, lights, lights->environment_count == 0, false};
    for (size_t i = 0; i < lights->environment_count; i++) {
        const struct scene_light *light = lights->environments[i].light;
        backdrop.has_views = backdrop.has_views ||
                             (light->kind == LIGHT_ENVIRONMENT && !has_one_colour(light->picture));
    }
    return backdrop;
}

/* -------- what rays pass -------- */

static double angle_between(struct vector a, struct vector b)
{
    return atan2(vector_length(vector_cross(a, b)), vector_dot(a, b));
}

/* Rounding, and more. */
static const double slight = 1e-9;

/* May one of them meet a ball? */
static bool may_meet(const struct backdrop_rays *rays, struct vector middle, double radius)
{
    const struct vector to = vector_minus(middle, rays->center);
    const double away = vector_length(to), both = (rays->radius + radius) * (1 + slight);
    return !(away > both) ||
           angle_between(to, rays->direction) <= rays->angle + asin(both / away) + slight;
}

static bool may_meet_child(const struct backdrop_rays *rays, const struct bvh_node *node, int child)
{
    double middle[3], square = 0;
    if (!(node->side[0][0][child] <= node->side[1][0][child])) {
        return false; /* there is none */
    }
    for (int k = 0; k < 3; k++) {
        const double low = (double)node->side[0][k][child], high = (double)node->side[1][k][child];
        middle[k] = (low + high) / 2;
        square += (high - low) * (high - low) / 4;
    }
    return may_meet(rays, (struct vector){middle[0], middle[1], middle[2]}, sqrt(square));
}

static bool may_meet_tree(const struct bvh *tree, const struct backdrop_rays *rays)
{
    uint32_t kept[BVH_PENDING];
    size_t count = 0;
    bool may = false;
    if (tree->count > 0) {
        kept[count++] = 0;
    }
    while (count > 0 && !may) {
        const struct bvh_node *node = &tree->nodes[kept[--count]];
        for (int child = 0; child < BVH_WIDTH && !may; child++) {
            if (may_meet_child(rays, node, child)) {
                may = node->count[child] > 0;
                kept[count] = node->child[child];
                count += !may;
            }
        }
    }
    return may;
}

/* -------- what is behind -------- */

static bool is_even_light(const struct scene_light *light, const struct backdrop_rays *rays)
{
    const struct vector up = {0, 1, 0};
    const double from_zenith = angle_between(up, rays->direction), angle = rays->angle + slight;
    switch (light->kind) {
    case LIGHT_SUN:
    case LIGHT_STAR:
        return angle_between(light->direction, rays->direction) > angle + light->diameter / 2;
    case LIGHT_SKY:
        return from_zenith - angle > PI / 2 ||
               (light->sky == SKY_UNIFORM && from_zenith + angle < PI / 2);
    case LIGHT_POINT: /* nobody sees it */
    case LIGHT_ENVIRONMENT:
        break;
    }
    return true;
}

bool backdrop_is_uniform(const struct backdrop *backdrop, const struct backdrop_rays *rays,
                         const struct lanes *lanes, struct radiance *light)
{
    const struct world *world = backdrop->world;
    const struct scene *scene = world->scene;
    bool is_even = !backdrop->has_views && rays->angle < PI / 2;
    for (size_t i = 0; i < world->endless_count && is_even; i++) {
        const struct world_thing *thing = &world->things[world->endless[i]];
        const struct vector up = thing->pose.turned.z;
        const double above = vector_dot(up, vector_minus(rays->center, thing->pose.at));
        const struct vector away = vector_times(above < 0 ? -1 : 1, up);
        is_even = !thing->moves && fabs(above) > rays->radius * (1 + slight) &&
                  !(angle_between(away, rays->direction) + rays->angle + slight >= PI / 2);
    }
    for (size_t i = 0; i < scene->light_count && is_even; i++) {
        is_even = is_even_light(&scene->lights[i], rays);
    }
    if (!is_even || may_meet_tree(&world->tree, rays)) {
        return false;
    }
    lights_background(backdrop->lights, rays->direction, lanes, light);
    return true;
}
