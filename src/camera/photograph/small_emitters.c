/* camera/photograph/small_emitters.c - lights that few rays of their pixel meet. */
/* SPDX-License-Identifier: MIT */
#include "camera/photograph/small_emitters.h"

#include "base/constants.h"

/* So many are looked at for each tile. */
enum { MOST = 10000 };

/* Things that are one lamp, and rest. */
static bool may_be_small(const struct path *path, size_t i)
{
    const struct lights *lights = path->lights;
    const struct scene_thing *thing = &lights->scene->things[i];
    return (path->is_left_out == NULL || !path->is_left_out[i]) && thing->shape != SHAPE_PLANE &&
           lights->first[i] != SCENE_NONE && !scene_place_moves(&thing->where) &&
           emitter_parts(thing) == 1;
}

struct small_emitters small_emitters_open(const struct view *view, struct arena *arena)
{
    const struct lights *lights = view->path->seen != NULL ? view->path->seen : view->path->lights;
    const struct scene *scene = lights->scene;
    const size_t discs = lights->distant.count;
    size_t count = discs;
    for (size_t i = 0; i < scene->thing_count; i++) {
        count += may_be_small(view->path, i) ? 1 : 0;
    }
    if (count > MOST || scene_place_moves(&view->camera)) {
        return (struct small_emitters){.count = 0};
    }
    struct small_light *all = ARENA_ARRAY(arena, count, struct small_light);
    size_t next = 0;
    for (size_t i = 0; i < discs; i++) {
        const struct distant_light *disc = &lights->distant.all[i];
        if (disc->luminance > 0) {
            all[next++] = (struct small_light){disc->direction, disc->radius,
                                               PI * disc->radius * disc->radius};
        }
    }
    const struct vector at = scene_pose_at(&view->camera, 0).at;
    for (size_t i = 0; i < scene->thing_count; i++) {
        if (may_be_small(view->path, i)) {
            const struct emitter lamp = {i, 0};
            const struct emitter_bounds bounds = emitter_bounds(scene, &lamp);
            const struct vector to = vector_minus(bounds.middle, at);
            const double away = vector_length(to);
            if (away > bounds.radius) {
                all[next++] =
                    (struct small_light){vector_times(1 / away, to), asin(bounds.radius / away),
                                         bounds.area / (away * away)};
            }
        }
    }
    return (struct small_emitters){all, next};
}

static double small_emitters_angle_between(struct vector a, struct vector b)
{
    return 2 * asin(fmin(1, vector_length(vector_minus(a, b)) / 2));
}

double small_emitters_samples(const struct small_emitters *lights, const struct tile_rays *rays,
                              const struct film_plan *plan, struct tile_scratch *scratch)
{
    static const double hits = 8, around = 1.1;
    const struct view *view = rays->subject.view;
    /* the middle, and the corners */
    static const double shares[5][2] = {{0.5, 0.5}, {0, 0}, {0, 1}, {1, 0}, {1, 1}};
    struct vector way[5];
    double cone = 0, most = 0;
    if (lights->count == 0) {
        return 0;
    }
    for (int i = 0; i < 5; i++) {
        const double at[2] = {plan->left + shares[i][0] * plan->width,
                              plan->bottom + shares[i][1] * plan->height};
        lens_film_chief(rays->film, at, &scratch->samples, &scratch->rays);
        if (scratch->rays.blocks->lost[0] != 0) {
            return 0;
        }
        way[i] = view_ray(&view->camera, view->pupil, scratch->rays.blocks, 0, 0).direction;
        cone = fmax(cone, small_emitters_angle_between(way[0], way[i]));
    }
    const double pixel = vector_length(vector_minus(way[1], way[2])) *
                         vector_length(vector_minus(way[1], way[3])) / TILE_PIXELS;
    for (size_t i = 0; i < lights->count; i++) {
        const struct small_light *light = &lights->all[i];
        if (small_emitters_angle_between(way[0], light->way) <= around * cone + light->angle) {
            most = fmax(most, hits * pixel / light->size);
        }
    }
    return most;
}
