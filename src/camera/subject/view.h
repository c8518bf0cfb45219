/* camera/subject/view.h - a camera that stands in a scene. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_SUBJECT_VIEW_H
#define LENSCALC_CAMERA_SUBJECT_VIEW_H

#include "light/bands.h"
#include "scene/path.h"
#include "scene/sampler.h"
#include "scene/scene.h"
#include "scene/world.h"
#include "trace/kernel/rays.h"

/* Read-only: threads share it. */
struct view {
    const struct path *path;
    const struct bands *bands;
    const struct sampler_table *points;
    struct scene_place camera;
    double pupil; /* what of the lens stands at camera.at, behind its first vertex, mm */
};

/*
 * A ray that has left the lens, as the scene sees it.
 *
 * Given     place    of a camera whose x is that of the lens, to the right, y up, and z the way of
 *                    light, backwards
 *           pupil    as struct view has it
 *           rays, i  traced to the first vertex and towards the scene, in the lens's coordinates
 *           time     s: the camera stands where it is then
 * Result    its way has length 1, and no end
 */
struct world_ray view_ray(const struct scene_place *place, double pupil,
                          const struct ray_block *rays, size_t i, double time);

#endif
