/* trace/aim/aimed.h - rays that stay aimed while the lens changes, and their derivatives. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_AIM_AIMED_H
#define LENSCALC_TRACE_AIM_AIMED_H

#include "base/arena.h"
#include "base/error.h"
#include "trace/aim/aim.h"
#include "trace/aim/beam.h"
#include "trace/derivative.h"

#include <stdbool.h>
#include <stddef.h>

/*
 * A block of rays through points of the pupil, of a lens that changes from one look at it to the
 * next: compile the system anew, aim, trace, sweep. A ray that is aimed at the stop starts
 * elsewhere as the lens changes, and so its image moves: d is meant with that, of a ray that goes
 * through the same share of the stop's radius.
 */

/* Rays of one beam: consecutive lanes. */
struct aimed_beam {
    struct beam beam;
    struct aim_near near; /* its chief ray, as it was found last */
    int first, count;
};

/* What blocks share that are looked at one after the other. */
struct aimed_work {
    struct derivative_tape tape;
    struct ray_block *start;    /* one */
    struct ray_block *slopes;   /* two: of the start by a and b */
    struct ray_block *tangents; /* two: the same behind the stop */
};

struct aimed {
    const struct system *system; /* as the lens is now: not clipped, forward */
    enum instruction_set set;
    struct aimed_work *work;
    struct aimed_beam *beams;
    size_t beam_count;
    int count, lanes;
    bool at_stop;                        /* else at the paraxial entrance pupil */
    bool keeps;                          /* the tape holds the rays without derivatives too */
    bool is_known;                       /* a, b and inverse are those of a lens near by */
    double x[RAYS_BLOCK], y[RAYS_BLOCK]; /* points, in radii of the pupil */
    double a[RAYS_BLOCK], b[RAYS_BLOCK]; /* coordinates in the beam, mm */
    double inverse[4][RAYS_BLOCK];       /* d(a, b)/d(x, y in the stop) */
    double by_radius[2][RAYS_BLOCK], by_place[2][RAYS_BLOCK]; /* da, db: of the entrance pupil */
    /* where aimed_at_stop failed: the surface 1-based, 0 where all are passed */
    size_t lost_beam, lost_surface;
    /* the caller's: what a function that is swept is by a and b themselves, however rays end; null:
       it is not */
    const double *by_start[2];
};

/* Room for systems like this one, of which later ones may move more surfaces. */
void aimed_work_open(const struct system *system, struct arena *arena, struct aimed_work *work);

/*
 * A block, without rays' points: the caller sets x and y of the first `count` lanes.
 *
 * Given     beams  first and count of each set, one behind the other from 0; kept
 */
void aimed_open(struct aimed_beam *beams, size_t beam_count, bool at_stop, struct aimed_work *work,
                struct aimed *aimed);

/*
 * Aim at the stop of the system.
 *
 * Given     system  its stop_radius is that of the points
 *           arena   for searches; reset by the caller
 * Formula   Broyden's steps of all rays at once, from where they were aimed at in the lens before;
 *           where these lead astray, aim_open and aim_rays
 * Errors    as aim_open; ERROR_DOMAIN: a ray cannot be aimed
 */
bool aimed_at_stop(struct aimed *aimed, const struct system *system, struct arena *arena,
                   struct error *error);

/*
 * Aim at a paraxial entrance pupil.
 *
 * Given     first  with the pupil's place and diameter
 * Errors    as aim_at_entrance
 */
bool aimed_at_entrance(struct aimed *aimed, const struct system *system,
                       const struct first_order *first, struct error *error);

/*
 * Trace.
 *
 * Given     derives  sweeps follow, before another block is traced with the same work
 *           end      receives the rays behind the last place
 */
void aimed_trace(struct aimed *aimed, bool derives, struct ray_block *end);

/* Derivatives of a function of rays, one a ray. */
struct aimed_rates {
    double radius[RAYS_BLOCK]; /* by that of the stop, or of the entrance pupil, 1/mm */
    double place[RAYS_BLOCK];  /* by the z of the entrance pupil, 1/mm; 0 of rays to the stop */
};

/*
 * Derivatives of one function of the rays before a place by all parameters, the aim looked after.
 *
 * Given     layout    of the system
 *           place     system->places: of the final rays
 *           adjoint   as for derivative_sweep; receives the derivatives by the starting ray, aim
 *                     looked after: of one that starts elsewhere or otherwise
 *           gradient  as there
 *           aimed->by_start  of a function that knows where rays start, too
 * Formula   s the place in the stop, T its aim, e the stop's radius: df = df/dp - df/d(a, b)
 *           (ds/d(a, b))^-1 (ds/dp - T de/dp). So behind the stop the adjoint gains
 *           -df/d(a, b) (ds/d(a, b))^-1 in x and y, and what comes before counts with it;
 *           d/d(a, b) there is carried forwards (trace/tangent.h), or of what lies before the stop
 *           comes from a sweep of its own
 * Source    derived here: the theorem of implicit functions for s(a, b, p) = e T
 */
void aimed_sweep(const struct aimed *aimed, const struct derivative_layout *layout, size_t place,
                 struct ray_block *adjoint, double *gradient, struct aimed_rates *rates);

/*
 * The same of a function of directions at surfaces on the way, and of nothing else.
 *
 * Given     seeds    what it gains there
 *           adjoint  receives the derivatives by the starting ray
 */
void aimed_sweep_seeds(const struct aimed *aimed, const struct derivative_layout *layout,
                       const struct derivative_seeds *seeds, struct ray_block *adjoint,
                       double *gradient, struct aimed_rates *rates);

#endif
