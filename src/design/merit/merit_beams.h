/* design/merit/merit_beams.h - the rays of the fields and wavelengths of an operand, kept aimed. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_MERIT_MERIT_BEAMS_H
#define LENSCALC_DESIGN_MERIT_MERIT_BEAMS_H

#include "design/merit/merit_bundle.h"
#include "design/merit/merit_sphere.h"
#include "design/merit/merit_state.h"

struct merit_beams {
    struct merit_bundle bundle;
    struct merit_spheres *spheres; /* of paths; null: they are not wanted */
    struct bundle_links *links;    /* one a light */
};

/*
 * Choose them: of the fields and wavelengths of the operand, or of the position.
 *
 * Given     path   paths to reference spheres are wanted
 *           whole  all points of the pupil, whatever is alike by symmetry
 * Errors    as merit_bundle_open
 */
bool merit_beams_open(struct merit *merit, const struct merit_slot *slot, bool path, bool whole,
                      struct arena *arena, struct merit_beams *beams, struct error *error);

/* Those of a wish, without spheres. */
bool merit_beams_begin(struct merit *merit, const struct merit_slot *slot, struct bundle_wish *wish,
                       struct arena *arena, struct merit_beams *beams, struct error *error);

/*
 * The lens as it is now: aim, unless rays are held, with what moves them besides, and find the
 * spheres. What that takes of merit->arena stays: no mark may be set before.
 *
 * Result    false: merit->why
 */
bool merit_beams_aim(struct merit *merit, const struct merit_slot *slot, struct merit_beams *beams);

/* merit_bundle_settle and merit_bundle_deform of all of them. */
void merit_beams_settle(struct merit_beams *beams, bool holds);
bool merit_beams_deform(struct merit_beams *beams, struct error *error);

#endif
