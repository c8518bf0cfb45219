/* photo/dof_plan.h - focus stacks, and equal depth of field on another format. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_DOF_PLAN_H
#define LENSCALC_PHOTO_DOF_PLAN_H

#include <stdbool.h>

#include "base/error.h"
#include "photo/dof.h"

enum { DOF_PLAN_LIMIT = 100000 };

/* A focus stack: shot k is focused where the image stands first x exp(k log_step) from the pupil.
 */
struct dof_plan {
    struct dof_setting setting; /* f, N, c, P of every shot; s is not used */
    double first;               /* Z'/f of the first (nearest) shot, m + P */
    double log_step;            /* < 0; 0 for a single shot */
    long count;                 /* 1 .. DOF_PLAN_LIMIT */
};

/*
 * Shots whose depths of field together cover [near, far], with the fewest shots.
 *
 * Given     setting    f, N, c, P; s is ignored
 *           near, far  mm from the front principal plane; f < near < far; far may be inf
 *           overlap    0 .. 0.95, the part of a shot's image-side depth of focus (image_near -
 *                      image_far) that the next shot covers again, at least
 * Result    plan for dof_plan_shot. The first shot's near limit is `near`, the last one's far limit
 *           is `far`, and the steps between are equal ratios; spreading them evenly makes the
 *           overlap a little larger than asked. One shot that covers more than is wanted has its
 *           surplus divided evenly.
 * Formula   Z' = f(m + P) image from exit pupil, h = N c/(f P): a shot covers Z'/(1 + h) .. Z'/(1 -
 *           h). Overlap o: ratio of successive Z' = 1 - (1 - o) 2h/(1 + h)
 * Source    Derived here: photo/dof.h, image side
 * Errors    as dof_check; near <= f, near >= far; overlap out of range; c = 0; N c >= f P, where
 *           any focus covers everything; more than DOF_PLAN_LIMIT shots
 * Limits    The lens moves as a whole (f and P keep their values).
 */
bool dof_plan_make(const struct dof_setting *setting, double near, double far, double overlap,
                   struct dof_plan *plan, struct error *error);

/*
 * One shot of a stack.
 *
 * Given     plan   from dof_plan_make
 *           index  0 (nearest) .. count - 1
 * Result    shot   the setting with its s; may be inf
 *           dof    its exact depth of field
 * Errors    index out of range
 */
bool dof_plan_shot(const struct dof_plan *plan, long index, struct dof_setting *shot,
                   struct dof *dof, struct error *error);

/*
 * Depth of field at a magnification, by itself.
 *
 * Given     setting  N, P > 0, c >= 0; f, or NaN: not known; s is ignored
 *           m        magnification, > 0
 * Result    depth    mm; inf from e = 1 on
 * Formula   T = 2 N c (1/m + 1/P)/(m (1 - e^2)), e = N c/(m f), 0 where f is not known
 * Source    Derived here: dof_compute's total at a magnification; without f and for P = 1 the
 *           2 N c (1 + m)/m^2 of [Ray02]
 * Errors    a number outside its range
 * Limits    Without f the depth is too small by e^2, less than 1 % for f > 10 N c/m
 */
bool dof_depth_at(const struct dof_setting *setting, double m, double *depth, struct error *error);

/* A focus stack of a camera on a rail; lengths in mm. */
struct dof_rail {
    double depth;  /* of field, of each shot */
    double step;   /* of the rail between two shots */
    double travel; /* of the rail from the first shot to the last */
    long count;    /* of shots, 1 .. DOF_PLAN_LIMIT */
};

/*
 * Shots that cover a depth while camera and lens move along a rail, so that all have one
 * magnification.
 *
 * Given     setting  N, c, P; f, or NaN: not known; s is ignored
 *           m        magnification, > 0
 *           covered  depth to cover, mm, > 0
 *           overlap  0 .. 0.95, the part of a shot's depth that the next one covers again, at least
 * Formula   T = 2 N c (1/m + 1/P)/(m (1 - e^2)), e = N c/(m f), 0 where f is not known;
 *           n = 1 + ceil((covered - T)/(T (1 - overlap))), step = (covered - T)/(n - 1): spread
 *           evenly the overlap is a little larger than asked
 * Source    Derived here: dof_compute's total at a magnification
 * Errors    as dof_check but for s; m or covered not above 0; overlap out of range; c = 0; e >= 1,
 *           where a shot covers everything; more than DOF_PLAN_LIMIT shots
 * Limits    Without f the depth is too small by e^2, less than 1 % for f > 10 N c/m. Diffraction
 *           widens a point to 2.44 wavelength N (1 + m/P), whatever c says
 */
bool dof_rail_plan(const struct dof_setting *setting, double m, double covered, double overlap,
                   struct dof_rail *rail, struct error *error);

/*
 * The same picture on another format: same place, same framing, same depth of field.
 *
 * Given     setting  on this format
 *           k        diagonal of the other format / diagonal of this one, > 0
 * Result    other    same s and P; m' = k m, c' = k c, and N' for the same depth of field
 * Formula   f' = s m'/(1 + m') = k s f/(s - f + k f), k f at infinity
 *           P = 1: N' = N f'/f gives the same near and the same far
 *           P != 1: near and far cannot both stay. N' gives the same total; where that is infinite,
 *           the same near limit
 * Source    Derived here: eps = N c/(f m) and s alone fix near and far for P = 1
 * Errors    as dof_check; k <= 0 or not finite; no N' that does it
 * Limits    Distances from the front principal plane, which stays in its place.
 */
bool dof_equal(const struct dof_setting *setting, double k, struct dof_setting *other,
               struct error *error);

#endif
