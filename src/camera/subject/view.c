/* camera/subject/view.c - from the coordinates of a lens to those of a scene. */
/* SPDX-License-Identifier: MIT */
#include "camera/subject/view.h"

struct world_ray view_ray(const struct scene_place *place, double pupil,
                          const struct ray_block *rays, size_t i, double time)
{
    const struct scene_pose pose = scene_pose_at(place, time);
    const struct vector from = {rays->x[i], rays->y[i], rays->z[i] - pupil};
    const struct vector way = {rays->p[i], rays->q[i], rays->r[i]};
    return (struct world_ray){.origin = vector_along(pose.at, 1, frame_out(&pose.turned, from)),
                              .direction = vector_unit(frame_out(&pose.turned, way)),
                              .time = time,
                              .farthest = INFINITY};
}
