/* camera/lens_room.h - what of a scene stands where the lens is. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_LENS_ROOM_H
#define LENSCALC_CAMERA_LENS_ROOM_H

#include "scene/world.h"

#include <stdbool.h>

/* A cylinder about the axis of a camera's own frame, whose z is backwards; mm. */
struct lens_room {
    double radius, front, back; /* from z = front to back */
};

/*
 * Does the surface of a thing pass through it?
 *
 * Given     camera  where it is
 *           time    s
 *           thing   receives the number of one that does
 * Result    by lines to and fro in what the cylinder has in common with the box about each thing,
 *           a sixteenth of that apart: what is thinner may be missed. A thing all around is none
 */
bool lens_room_holds(const struct lens_room *room, const struct world *world,
                     const struct scene_place *camera, double time, size_t *thing);

#endif
