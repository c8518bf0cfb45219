/* camera/subject/lens_clearance.h - what of a scene stands where the lens is. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_SUBJECT_LENS_CLEARANCE_H
#define LENSCALC_CAMERA_SUBJECT_LENS_CLEARANCE_H

#include "analysis/setup/setup.h"
#include "base/arena.h"
#include "scene/world.h"

#include <stdbool.h>

/* Of a surface: how far out it reaches, and its vertex along the camera's z, which is backwards. */
struct lens_rim {
    const struct surface *surface; /* null: a plane, the film */
    double radius, vertex;         /* mm; the vertex from the camera's place */
    bool is_glass;                 /* behind it, up to the next */
};

/* A body about the axis of a camera's own frame: what lies between surfaces, and up to the film. */
struct lens_clearance {
    double radius, front, back; /* of a cylinder about all of it, from z = front to back; mm */
    const struct lens_rim *rims;
    size_t count; /* of rims, 2 and more */
};

/*
 * Where a camera's place lies behind the first vertex, mm: in the entrance pupil, or, where that is
 * more than 1000 km away, at 0: numbers of that size would not tell surfaces apart.
 */
double lens_clearance_pupil(const struct setup *setup);

/*
 * Where the lens is.
 *
 * Result    surfaces reach as far out as light may pass them, of a surface that does not say how
 *           far as far as the entrance pupil, or as the stop if that pupil is so far away; the
 *           narrower surface of a piece of glass goes on as a flat, and rims with air between them
 *           are joined by a cone. Stops are left out; a lens with decentred or tilted surfaces is a
 *           cylinder as wide as the entrance pupil
 */
struct lens_clearance lens_clearance_of(const struct setup *setup, struct arena *arena);

/*
 * Is the surface of a thing in it at some time?
 *
 * Given     camera  where it is
 *           span    times, from .. to, s
 *           thing   receives the number of one that is,
 *           time    and when: about the first time that it is
 * Result    by lines to and fro in what the cylinder has in common with the box about each thing,
 *           a sixteenth of that apart: what is thinner may be missed. A thing all around is none.
 *           What moves is looked at wherever it may be in the cylinder, again when it has come a
 *           quarter of its radius or length on, or after a 4096th of the span if that is later
 * Formula   what is a gap away takes at least gap/speed to come in, where no point that is as near
 *           as the cylinder is faster in the camera's frame than what both move and spin, these
 *           times their levers, together
 */
bool lens_clearance_holds(const struct lens_clearance *room, const struct world *world,
                          const struct scene_place *camera, const double span[2], size_t *thing,
                          double *time);

#endif
