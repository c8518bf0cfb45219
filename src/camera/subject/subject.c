/* camera/subject/subject.c - rays from a lens to a card, a relief, or into a scene. */
/* SPDX-License-Identifier: MIT */
#include "camera/subject/subject.h"

#include <string.h>

bool subject_meets(const struct ray_block *rays, size_t i, double distance, double at[2])
{
    const double way = (-distance - rays->z[i]) / rays->r[i];
    at[0] = rays->x[i] + way * rays->p[i];
    at[1] = rays->y[i] + way * rays->q[i];
    return rays->lost[i] == 0 && way > 0;
}

struct depth_card_ray subject_ray(const struct ray_block *rays, size_t i, double plane)
{
    const double slope[2] = {rays->p[i] / rays->r[i], rays->q[i] / rays->r[i]};
    const double way = plane - rays->z[i];
    return (struct depth_card_ray){{rays->x[i] + way * slope[0], rays->y[i] + way * slope[1]},
                                   {slope[0], slope[1]}};
}

static void take_light(struct card_light from, double light[SUBJECT_CHANNELS])
{
    for (size_t k = 0; k < SUBJECT_CHANNELS; k++) {
        light[k] = (double)from.of[k];
    }
}

static void look_at_card(const struct subject *subject, const struct subject_rays *rays,
                         uint64_t sights[DEPTH_CARD_SIGHTS], subject_light light)
{
    (void)sights;
    memset(light, 0, sizeof(subject_light));
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        double at[2];
        if (subject_meets(rays->block, i, subject->card->distance, at)) {
            take_light(card_look(subject->card, at[0], at[1]), light[i]);
        }
    }
}

static void look_at_relief(const struct subject *subject, const struct subject_rays *rays,
                           uint64_t sights[DEPTH_CARD_SIGHTS], subject_light light)
{
    const struct ray_block *block = rays->block;
    memset(light, 0, sizeof(subject_light));
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        if (block->lost[i] == 0 && block->r[i] < 0) {
            const struct depth_card_ray ray = subject_ray(block, i, subject->relief->pupil);
            enum depth_card_sight sight;
            take_light(depth_card_look(subject->relief, &ray, &sight), light[i]);
            sights[sight]++;
        }
    }
}

static void look_into_scene(const struct subject *subject, const struct subject_rays *rays,
                            uint64_t sights[DEPTH_CARD_SIGHTS], subject_light light)
{
    const struct view *view = subject->view;
    const struct ray_block *block = rays->block;
    const struct lanes *lanes = rays->lanes;
    (void)sights;
    memset(light, 0, sizeof(subject_light));
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        if (block->lost[i] != 0 || !(rays->weights[i] > 0)) {
            continue;
        }
        const struct world_ray ray = view_ray(&view->camera, view->pupil, block, i, rays->times[i]);
        struct sampler points = sampler_of(rays->sequence, rays->number, (uint32_t)i);
        struct radiance radiance;
        path_radiance(view->path, &ray, lanes, &points, &radiance);
        for (size_t lane = 0; lane < lanes->count; lane++) {
            const double *rgb = view->bands->rgb[lanes->band[lane]];
            for (size_t k = 0; k < SUBJECT_CHANNELS; k++) {
                light[i][k] += radiance.of[lane] * rgb[k];
            }
        }
    }
}

struct subject subject_card(const struct card *card)
{
    return (struct subject){.look = look_at_card, .card = card};
}

struct subject subject_relief(const struct depth_card *relief)
{
    return (struct subject){.look = look_at_relief, .relief = relief};
}

struct subject subject_scene(const struct view *view)
{
    return (struct subject){.look = look_into_scene, .view = view};
}
