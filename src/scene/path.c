/* scene/path.c - the light that a ray meets, after as many turns as it likes. */
/* SPDX-License-Identifier: MIT */
#include "scene/path.h"

#include <math.h>

/* After so many surfaces paths may end by chance. */
enum { SURE_BOUNCES = 3 };
/*
 * Of the way to what shines, where something else may stand. What is left must hold the rounding
 * of both ends along the ray, which is their slack over the cosine at the lamp: 2^-24 suffices
 * where |x|+|y|+|z| over the way, over that cosine, is below 2^22. In turn what is nearer to a lamp
 * than 6e-8 of the way to it throws no shadow: 60 nm at 1 m.
 */
#define BEFORE_LIGHT (1 - 0x1p-24)

/* A path so far: the ray that it goes on by. */
struct walk {
    const struct path *path;
    const struct lights *lights; /* that its ray may meet */
    const struct lanes *lanes;
    struct points *points;
    struct radiance *light; /* found so far */
    struct world_ray ray;
    struct radiance share; /* of light from there that comes back to the beginning */
    double density;        /* by which the surface chose it; INFINITY: there was no choice */
};

double path_weight(double density, double other)
{
    const double ratio = other / density; /* of INFINITY 0 */
    return 1 / (1 + ratio * ratio);
}

static void add(struct walk *walk, const struct radiance *light, double by)
{
    for (size_t k = 0; k < walk->lanes->count; k++) {
        walk->light->of[k] += by * walk->share.of[k] * light->of[k];
    }
}

/* The light of what the ray has met, or of what is behind everything. */
static void add_met(struct walk *walk, const struct world_hit *hit)
{
    const struct lights *lights = walk->lights;
    const struct materials *materials = &lights->materials;
    struct radiance light = {{0}};
    if (hit == NULL) {
        lights_background(lights, walk->ray.way, walk->lanes, &light);
    } else if (materials_shines(materials, hit->thing)) {
        materials_shine(materials, hit->thing, hit->place, walk->lanes, &light);
    } else {
        return;
    }
    const double other = isinf(walk->density) ? 0
                                              : lights_density(lights, walk->ray.from,
                                                               walk->ray.way, walk->ray.time, hit);
    add(walk, &light, path_weight(walk->density, other));
}

/* The surface where a path goes on. */
struct corner {
    const struct world_hit *hit;
    struct scatter scatter;
    struct frame frame;
    struct vector from, out; /* where rays leave it; where the path comes from, in the frame */
};

bool path_is_clear(const struct path *path, struct vector from, double time,
                   const struct light_sample *sample)
{
    const struct world_ray ray = {from, sample->way, time, sample->distance * BEFORE_LIGHT};
    return world_is_clear(path->world, &ray);
}

/* Its light from one of those things that shine. */
static void add_lit(struct walk *walk, const struct corner *corner)
{
    const struct path *path = walk->path;
    double u[3];
    struct light_sample sample;
    struct radiance value;
    for (int i = 0; i < 3; i++) {
        u[i] = points_next(walk->points);
    }
    if (!lights_sample(path->lights, corner->from, walk->ray.time, u, walk->lanes, &sample) ||
        !(vector_dot(sample.way, corner->hit->face) > 0)) {
        return;
    }
    const double density =
        scatter_value(&corner->scatter, corner->out, frame_in(&corner->frame, sample.way), &value);
    if (!(density > 0) || !path_is_clear(path, corner->from, walk->ray.time, &sample)) {
        return;
    }
    for (size_t k = 0; k < walk->lanes->count; k++) {
        value.of[k] *= sample.light.of[k];
    }
    add(walk, &value,
        (sample.is_point ? 1 : path_weight(sample.density, density)) / sample.density);
}

/* Does the path go on after `bounces` surfaces? Then it stands for those that do not, too. */
static bool goes_on(struct walk *walk, int bounces)
{
    double most = 0;
    for (size_t k = 0; k < walk->lanes->count; k++) {
        most = fmax(most, walk->share.of[k]);
    }
    if (bounces < SURE_BOUNCES || !(most < 1)) {
        return most > 0;
    }
    if (!(points_next(walk->points) < most)) {
        return false;
    }
    for (size_t k = 0; k < walk->lanes->count; k++) {
        walk->share.of[k] /= most;
    }
    return true;
}

/* Turn the path where it has met a surface; false: it ends there. */
static bool turn(struct walk *walk, struct corner *corner)
{
    double u[3] = {0};
    struct scatter_sample sample;
    const bool is_mirror = corner->scatter.kind == MATERIAL_MIRROR;
    for (int i = corner->scatter.kind == MATERIAL_GLOSSY ? 0 : 1; i < 3 && !is_mirror; i++) {
        u[i] = points_next(walk->points);
    }
    if (!scatter_sample(&corner->scatter, corner->out, u, &sample)) {
        return false;
    }
    walk->ray.from = corner->from;
    walk->ray.way = frame_out(&corner->frame, sample.way);
    walk->density = sample.density;
    walk->lights = walk->path->lights;
    for (size_t k = 0; k < walk->lanes->count; k++) {
        walk->share.of[k] *= sample.share.of[k];
    }
    return vector_dot(walk->ray.way, corner->hit->face) > 0;
}

/* Add what a surface is lit by, and go on from there; false: nothing more comes. */
static bool reflect(struct walk *walk, const struct world_hit *hit)
{
    struct corner corner = {.hit = hit, .from = world_leave(hit)};
    const struct vector back = vector_times(-1, walk->ray.way);
    if (!materials_scatter(&walk->path->lights->materials, hit->thing, hit->place, walk->lanes,
                           &corner.scatter)) {
        return false;
    }
    /* smooth normals at the edge of a shape may turn away from who sees it */
    corner.frame = frame_about(vector_dot(back, hit->normal) > 0 ? hit->normal : hit->face);
    corner.out = frame_in(&corner.frame, back);
    if (corner.scatter.kind != MATERIAL_MIRROR) {
        add_lit(walk, &corner);
    }
    return turn(walk, &corner);
}

void path_look(const struct path *path, const struct world_ray *ray, const struct lanes *lanes,
               struct points *points, struct radiance *light)
{
    struct walk walk = {.path = path,
                        .lights = path->seen != NULL ? path->seen : path->lights,
                        .lanes = lanes,
                        .points = points,
                        .light = light,
                        .ray = *ray,
                        .density = path->seen != NULL ? path->density : INFINITY};
    *light = (struct radiance){{0}};
    for (size_t k = 0; k < lanes->count; k++) {
        walk.share.of[k] = 1;
    }
    for (int bounces = 0;; bounces++) {
        struct world_hit hit;
        const bool meets = world_look(path->world, &walk.ray, &hit);
        add_met(&walk, meets ? &hit : NULL);
        if (!meets || bounces == path->bounces || !goes_on(&walk, bounces) ||
            !reflect(&walk, &hit)) {
            return;
        }
    }
}
