/* scene/path.c - path tracing: the radiance that comes along a ray. */
/* SPDX-License-Identifier: MIT */
#include "scene/path.h"

#include <math.h>

/* After so many surfaces paths may end by chance. */
enum { SURE_BOUNCES = 3 };
/*
 * The part of a shadow ray that is tested for occluders. What is left must hold the rounding
 * of both ends along the ray, which is their slack over the cosine at the emitter: 2^-24 suffices
 * where |x|+|y|+|z| along it, over that cosine, is below 2^22. In turn what is nearer to an emitter
 * than 6e-8 of the distance to it throws no shadow: 60 nm at 1 m.
 */
#define BEFORE_LIGHT (1 - 0x1p-24)

/* A path so far, and the ray that it goes on by. */
struct path_state {
    const struct path *path;
    const struct lights *lights; /* that its ray may meet */
    const struct lanes *lanes;
    struct sampler *sampler;
    struct radiance *light; /* found so far */
    struct world_ray ray;
    struct radiance throughput; /* of the path up to this ray */
    double pdf; /* of the ray, by the BSDF that it was sampled from; INFINITY: no choice */
};

double path_power_heuristic(double pdf, double other)
{
    const double ratio = other / pdf; /* of INFINITY 0 */
    return 1 / (1 + ratio * ratio);
}

static void path_add(struct path_state *state, const struct radiance *light, double by)
{
    for (size_t k = 0; k < state->lanes->count; k++) {
        state->light->of[k] += by * state->throughput.of[k] * light->of[k];
    }
}

/* Emission of what the ray has met, or of the background, weighed against direct light. */
static void path_add_emission(struct path_state *state, const struct world_hit *hit)
{
    const struct lights *lights = state->lights;
    const struct materials *materials = &lights->materials;
    const bool *left_out = lights == state->path->seen ? state->path->is_left_out : NULL;
    struct radiance light = {{0}};
    if (hit != NULL && left_out != NULL && left_out[hit->thing]) {
        return;
    }
    if (hit == NULL) {
        lights_background(lights, state->ray.direction, state->lanes, &light);
    } else if (materials_shines(materials, hit->thing)) {
        materials_shine(materials, hit->thing, hit->place, state->lanes, &light);
    } else {
        return;
    }
    const double other = isinf(state->pdf) ? 0
                                           : lights_pdf(lights, state->ray.origin,
                                                        state->ray.direction, state->ray.time, hit);
    path_add(state, &light, path_power_heuristic(state->pdf, other));
}

/* The surface where a path scatters. */
struct path_vertex {
    const struct world_hit *hit;
    struct bsdf bsdf;
    struct frame frame;
    struct vector from, out; /* where rays leave it; where the path comes from, in the frame */
};

bool path_is_unoccluded(const struct path *path, struct vector from, double time,
                        const struct light_sample *sample)
{
    const struct world_ray ray = {from, sample->direction, time, sample->distance * BEFORE_LIGHT};
    return world_is_unoccluded(path->world, &ray);
}

/* Next-event estimation: light from one emitter, sampled from the vertex. */
static void path_add_direct_light(struct path_state *state, const struct path_vertex *vertex)
{
    const struct path *path = state->path;
    double u[3];
    struct light_sample sample;
    struct radiance value;
    for (int i = 0; i < 3; i++) {
        u[i] = sampler_next(state->sampler);
    }
    if (!lights_sample(path->lights, vertex->from, state->ray.time, u, state->lanes, &sample) ||
        !(vector_dot(sample.direction, vertex->hit->face) > 0)) {
        return;
    }
    const double pdf =
        bsdf_value(&vertex->bsdf, vertex->out, frame_in(&vertex->frame, sample.direction), &value);
    if (!(pdf > 0) || !path_is_unoccluded(path, vertex->from, state->ray.time, &sample)) {
        return;
    }
    for (size_t k = 0; k < state->lanes->count; k++) {
        value.of[k] *= sample.light.of[k];
    }
    path_add(state, &value,
             (sample.is_point ? 1 : path_power_heuristic(sample.pdf, pdf)) / sample.pdf);
}

/* Russian roulette: end the path with probability 1 - q, q its largest throughput, and divide by
   q. Before SURE_BOUNCES surfaces it goes on unless it carries nothing. */
static bool path_survives_roulette(struct path_state *state, int bounces)
{
    double q = 0;
    for (size_t k = 0; k < state->lanes->count; k++) {
        q = fmax(q, state->throughput.of[k]);
    }
    if (bounces < SURE_BOUNCES || !(q < 1)) {
        return q > 0;
    }
    if (!(sampler_next(state->sampler) < q)) {
        return false;
    }
    for (size_t k = 0; k < state->lanes->count; k++) {
        state->throughput.of[k] /= q;
    }
    return true;
}

/* Add direct light at a surface, and scatter; false: the path ends. */
static bool path_reflect(struct path_state *state, const struct world_hit *hit)
{
    struct path_vertex vertex = {.hit = hit, .from = world_ray_origin(hit)};
    const struct vector back = vector_times(-1, state->ray.direction);
    if (!materials_bsdf(&state->path->lights->materials, hit->thing, hit->place, state->lanes,
                        &vertex.bsdf)) {
        return false;
    }
    /* smooth normals at the edge of a shape may turn away from who sees it */
    vertex.frame = frame_about(vector_dot(back, hit->normal) > 0 ? hit->normal : hit->face);
    vertex.out = frame_in(&vertex.frame, back);
    if (vertex.bsdf.kind != MATERIAL_MIRROR) {
        path_add_direct_light(state, &vertex);
    }
    /* sample the BSDF for the next direction; false: the path is absorbed */
    double u[3] = {0};
    struct bsdf_sample sample;
    const bool is_mirror = vertex.bsdf.kind == MATERIAL_MIRROR;
    for (int i = vertex.bsdf.kind == MATERIAL_GLOSSY ? 0 : 1; i < 3 && !is_mirror; i++) {
        u[i] = sampler_next(state->sampler);
    }
    if (!bsdf_sample(&vertex.bsdf, vertex.out, u, &sample)) {
        return false;
    }
    state->ray.origin = vertex.from;
    state->ray.direction = frame_out(&vertex.frame, sample.direction);
    state->pdf = sample.pdf;
    state->lights = state->path->lights;
    for (size_t k = 0; k < state->lanes->count; k++) {
        state->throughput.of[k] *= sample.throughput.of[k];
    }
    return vector_dot(state->ray.direction, vertex.hit->face) > 0;
}

void path_radiance(const struct path *path, const struct world_ray *ray, const struct lanes *lanes,
                   struct sampler *sampler, struct radiance *light)
{
    struct path_state state = {.path = path,
                               .lights = path->seen != NULL ? path->seen : path->lights,
                               .lanes = lanes,
                               .sampler = sampler,
                               .light = light,
                               .ray = *ray,
                               .pdf = path->seen != NULL ? path->pdf : INFINITY};
    *light = (struct radiance){{0}};
    for (size_t k = 0; k < lanes->count; k++) {
        state.throughput.of[k] = 1;
    }
    for (int bounces = 0;; bounces++) {
        struct world_hit hit;
        const bool meets = world_intersect(path->world, &state.ray, &hit);
        path_add_emission(&state, meets ? &hit : NULL);
        if (!meets || bounces == path->bounces || !path_survives_roulette(&state, bounces) ||
            !path_reflect(&state, &hit)) {
            return;
        }
    }
}
