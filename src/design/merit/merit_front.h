/* design/merit/merit_front.h - a few real rays on their way from surface to surface. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_MERIT_MERIT_FRONT_H
#define LENSCALC_DESIGN_MERIT_MERIT_FRONT_H

#include "design/merit/merit_ray.h"
#include "trace/kernel/rays.h"
#include "trace/system.h"

/* Where they are now, without derivatives. */
struct merit_front {
    struct system system;
    struct rays rays;
    size_t count;
};

/*
 * Before the first surface.
 *
 * Given     light   their wavelength
 *           starts  of merit_ray_start; null: a ray that could not be aimed, and is lost
 * Errors    merit->why: as system_compile
 */
bool merit_front_open(struct merit *merit, const struct merit_ray_question *question,
                      struct merit_ray *const *starts, size_t count, struct merit_front *front);

/* Through one more surface, from before it. */
void merit_front_pass(struct merit_front *front, size_t surface);

struct merit_ray merit_front_ray(const struct merit_front *front, size_t i);
bool merit_front_lost(const struct merit_front *front, size_t i);

#endif
