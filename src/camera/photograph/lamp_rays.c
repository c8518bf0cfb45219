/* camera/photograph/lamp_rays.c - blocks of rays from a lamp through the lens to the film. */
/* SPDX-License-Identifier: MIT */
#include "camera/photograph/lamp_rays.h"

#include "base/constants.h"

#include <math.h>
#include <string.h>

/* To an emitter from a point of the scene. */
static bool lamp_look(const struct lamps *lamps, const struct lamp *lamp, struct vector from,
                      double time, const double u[2], struct light_sample *to)
{
    if (lamp->distant != NULL) {
        const double sine = sin(lamp->distant->radius / 2);
        to->direction = distant_light_direction(lamp->distant, u);
        to->distance = INFINITY;
        to->pdf = 1 / (4 * PI * sine * sine);
        return true;
    }
    const struct scene_thing *thing =
        &lamps->rays->subject.view->path->lights->scene->things[lamp->thing];
    const struct scene_pose pose = scene_pose_at(&thing->where, time);
    struct emitter_sample sample;
    if (!emitter_sample(thing, 0, &pose, from, u, &sample)) {
        return false;
    }
    to->direction = sample.direction;
    to->distance = sample.distance;
    to->pdf = sample.pdf;
    return true;
}

void lamp_start(const struct lamps *lamps, const struct lamp *lamp, struct lamp_rays *rays)
{
    static const double near_enough = 1000; /* mm */
    const struct view *view = lamps->rays->subject.view;
    const double width = lamp->high[0] - lamp->low[0], height = lamp->high[1] - lamp->low[1];
    struct ray_block *block = &rays->start;
    memset(rays->is_free, 0, sizeof rays->is_free);
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        const double time = lamps->begin + rays->u[U_TIME][i] * (lamps->end - lamps->begin);
        const struct scene_pose pose = scene_pose_at(&view->camera, time);
        const struct vector place = {lamp->low[0] + width * rays->u[U_PLACE][i],
                                     lamp->low[1] + height * rays->u[U_PLACE + 1][i],
                                     lamp->plane - view->pupil};
        const struct vector from = vector_along(pose.at, 1, frame_out(&pose.turned, place));
        const double u[2] = {rays->u[U_EMITTER][i], rays->u[U_EMITTER + 1][i]};
        struct light_sample *to = &rays->to[i];
        struct vector way = {0, 0, 0};
        rays->times[i] = time;
        rays->sent[i] = 0;
        if (lamp_look(lamps, lamp, from, time, u, to)) {
            way = frame_in(&pose.turned, to->direction);
        }
        const double to_front = way.z < 0 ? -lamp->plane / way.z : INFINITY;
        double away = 0;
        if (to_front < to->distance) {
            rays->sent[i] = width * height * -way.z / to->pdf;
            rays->front[i] = vector_along(from, to_front, to->direction);
            to->distance -= to_front;
            away = to_front + fmin(near_enough, to->distance);
        } else {
            way = (struct vector){0, 0, -1};
        }
        block->x[i] = place.x + away * way.x;
        block->y[i] = place.y + away * way.y;
        block->z[i] = lamp->plane + away * way.z;
        block->p[i] = -way.x;
        block->q[i] = -way.y;
        block->r[i] = -way.z;
        block->path[i] = block->lost[i] = 0;
    }
}

/* When a shutter lets them pass that have arrived: those of another time are lost. */
static void lamp_shut(const struct lamps *lamps, size_t wavelength, struct lamp_rays *rays)
{
    const struct lens_film *film = lamps->rays->film;
    const struct ray_block *block = rays->rays.blocks;
    struct ray_block *back = rays->back.blocks;
    const double share = (lamps->end - lamps->begin) / film->shutter->time;
    *back = *block;
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        rays->samples.x[i] = block->x[i];
        rays->samples.y[i] = block->y[i];
        back->z[i] = film->region.film;
        back->p[i] = -block->p[i];
        back->q[i] = -block->q[i];
        back->r[i] = -block->r[i];
        back->path[i] = back->lost[i] = 0;
    }
    lens_film_trace(film, wavelength, &rays->samples, &rays->back);
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        const bool is_open =
            rays->times[i] >= rays->samples.begin[i] && rays->times[i] < rays->samples.end[i];
        rays->flux[i] *= is_open ? share : 0;
    }
}

void lamp_trace(const struct lamps *lamps, size_t wavelength, struct lamp_rays *rays)
{
    const struct ray_model *model = &lamps->models[wavelength];
    const double index = model->system->index_first;
    struct ray_block *block = rays->rays.blocks;
    *block = rays->start;
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        block->p[i] *= index;
        block->q[i] *= index;
        block->r[i] *= index;
    }
    ray_model_trace(model, &rays->rays, NULL);
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        /* ideal lenses keep areas of places and slopes, of which etendue has the fourth power of
           the cosine: the flux is that of the luminance which rays from the film see */
        const double by =
            lamps->is_ideal ? block->r[i] / model->system->index_last / rays->start.r[i] : 1;
        rays->samples.weight[i] = block->lost[i] == 0 ? rays->sent[i] * by * by * by * by : 0;
        if (block->lost[i] != 0) { /* numbers for what comes now */
            block->x[i] = block->y[i] = block->p[i] = block->q[i] = 0;
            block->r[i] = lamps->rays->film->region.index;
        }
    }
    acceptance_weigh(lamps->rays->film->acceptance, rays->rays.blocks, &rays->samples);
    memcpy(rays->flux, rays->samples.weight, sizeof rays->flux);
    if (lamps->rays->film->shutter != NULL) {
        lamp_shut(lamps, wavelength, rays);
    }
}

struct lamp_rays *lamp_rays_new(struct arena *arena)
{
    struct lamp_rays *rays = ARENA_NEW(arena, struct lamp_rays);
    rays->rays = rays_new(arena, RAYS_BLOCK);
    rays->back = rays_new(arena, RAYS_BLOCK);
    return rays;
}
