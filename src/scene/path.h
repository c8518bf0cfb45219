/* scene/path.h - path tracing: the radiance that comes along a ray. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_SCENE_PATH_H
#define LENSCALC_SCENE_PATH_H

#include "light/bands.h"
#include "scene/lights.h"
#include "scene/sampler.h"
#include "scene/world.h"

/* What paths go through; the scene and bands of both are the same. */
struct path {
    const struct world *world;
    const struct lights *lights;
    /* How often light may be reflected on its way: 0: only what shines is seen; 1: what it lights
       as well; more: what that lights */
    int bounces;
    /* What is seen directly where others look for that as well; null: `lights`, nobody does. Of it
       counts what path_power_heuristic says, by the pdf of the rays that begin paths, per sr */
    const struct lights *seen;
    double pdf;
    const bool *is_left_out; /* things whose light rays that begin paths leave out; null: none */
};

/* Multiple importance sampling: the weight of light sampled by one pdf that another one samples
   as well, by the power heuristic. */
double path_power_heuristic(double pdf, double other);

/* Does nothing stand between a point and what lights_sample has found from there? */
bool path_is_unoccluded(const struct path *path, struct vector from, double time,
                        const struct light_sample *sample);

/*
 * Radiance along a ray, towards its origin.
 *
 * Given     ray     its farthest is INFINITY
 *           lanes   bands that are asked for
 *           sampler  numbers of the ray; those used are taken
 * Result    light   radiance of each lane, in cd/m^2 where the band is white. Its mean over many
 *                   rays is that of the scene, whatever the number of them; its numbers depend on
 *                   the sampler alone
 * Formula   a path from the ray backwards: at each surface light is looked for in two ways, towards
 *           something that shines, and as the surface reflects, and what both find is weighed by
 *           the squares of their pdfs; after three surfaces a path goes on only as often as it
 *           still carries light, and counts so much more. Pdfs don't depend on the lanes,
 *           but for that last one, and each lane's mean is right by itself
 *           Cosines are to the smooth normal; what is behind the surface itself lights nothing
 * Source    [Kajiya86] (paths); [Veach97] sections 9.2.3 (power heuristic), 10.4.1 (roulette)
 * Limits    light that a mirror sends onto a surface is met only as that surface reflects: of small
 *           emitters rarely, and much of it at once
 */
void path_radiance(const struct path *path, const struct world_ray *ray, const struct lanes *lanes,
                   struct sampler *sampler, struct radiance *light);

#endif
