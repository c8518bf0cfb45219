/* trace/aim/aim.h - rays of a field point that cross the stop where they should. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_AIM_AIM_H
#define LENSCALC_TRACE_AIM_AIM_H

#include "base/arena.h"
#include "base/error.h"
#include "optics/first_order.h"
#include "trace/aim/beam.h"
#include "trace/aim/sample.h"
#include "trace/kernel/rays.h"
#include "trace/system.h"

#include <stdbool.h>
#include <stddef.h>

/* A beam whose chief ray is known. */
struct aim {
    const struct system *system; /* without clipping; must outlive the aim. Null: there is no stop
                                    that could be aimed at, and nothing else is set */
    struct beam beam;
    double chief[2];      /* its coordinates in the beam, mm */
    double centre[2];     /* where it crosses the stop, mm: 0 but with aim_open_at */
    double slope[4];      /* there: d(x, y in the stop)/d(a, b), row by row */
    bool has_chief;       /* false: what stands for the chief ray is another one */
    enum ray_status lost; /* what most rays towards the centre of the stop are lost by then, */
    size_t lost_surface;  /* and where, 1-based */
    double stop_radius;   /* mm */
    size_t sought;        /* rays looked at in search of the chief ray, times the surfaces each, of
                             which aspheres count for several */
    struct rays work;     /* one block */
};

/*
 * Find the chief ray: the one through the centre of the stop, which moves with it where the stop is
 * decentred or tilted.
 *
 * Given     system  compiled with clip off, forward
 *           aim     receives the beam and its chief ray
 * Formula   meridional: the height in the stop is sampled along the beam, over the clear aperture
 *           of the first surface as this field sees it, finer until it changes its sign; of several
 *           roots the one where it runs as near the axis, and of these the one that passes all
 *           clear apertures, or is nearest to the paraxial one. The bracket is then closed
 *           (base/roots). Lenses that are not symmetric about their axis: a grid, then Newton
 * Errors    ERROR_DOMAIN: no stop, or no radius of it; no ray of the beam arrives there, with the
 *           surface where most are lost
 */
static inline bool aim_open(const struct system *system, const struct beam *beam,
                            struct arena *arena, struct aim *aim, struct error *error);

/* What is known of a chief ray where others are looked for beside it. */
struct aim_near {
    bool is_known;
    double chief[2], slope[4]; /* as in struct aim */
};

/*
 * The same from the chief ray of a beam near by, where there is one.
 *
 * Given     near  receives the new chief ray; not known, or null: aim_open
 * Formula   Newton's method; where it does not lead straight to a ray on the same sheet, aim_open
 */
bool aim_open_near(const struct system *system, const struct beam *beam, struct aim_near *near,
                   struct arena *arena, struct aim *aim, struct error *error);

static inline bool aim_open(const struct system *system, const struct beam *beam,
                            struct arena *arena, struct aim *aim, struct error *error)
{
    return aim_open_near(system, beam, NULL, arena, aim, error);
}

/*
 * The same where aim_open finds no chief ray, from another ray that reaches the stop.
 *
 * Given     aim  as aim_open left it, which said why there is no chief ray
 *           at   that ray, in coordinates of the beam
 * Result    false: the rays about it do not reach the stop, or there is none that could be aimed at
 */
bool aim_open_at(struct aim *aim, const double at[2]);

/*
 * Aim rays at points of the stop.
 *
 * Given     points  in units of the stop's radius
 *           rays    room for `count`; receives the rays where they start, ready for rays_trace
 * Result    how many have been aimed. One that could not be is marked as lost, with the status and
 *           the surface that stopped the search (RAY_NOT_CONVERGED: the surfaces are passed, but
 *           the point is not reached): it stays as far as the search has come
 * Formula   Newton's method for all rays at once, the Jacobian kept by Broyden's rank-one
 *           correction, as long as whole steps lead nearer; it ends at rounding: 1e-9 of the radius
 *           counts as reached, of a tiny stop what rounding of the start is there; 1e-14 is usual.
 *           Where the pupil is folded a point has several rays; the one that is meant is joined to
 *           the chief ray by those of the line between them in the stop, with the chief ray's sign
 *           of the Jacobian. Where the search ends with the other sign or goes astray the ray is
 *           led along that line in small steps (continuation); if these end at the fold it is not
 *           converged
 * Source    [Broyden65]
 */
size_t aim_rays(const struct aim *aim, const struct pupil_point *points, size_t count,
                const struct rays *rays);

/*
 * The same to 1e-12 of the radius, as far as whole steps of Broyden's method lead there.
 *
 * Result    false: for some they do not, or the pupil may be folded
 */
bool aim_rays_straight(const struct aim *aim, const struct pupil_point *points, size_t count,
                       const struct rays *rays);

/* The same as aim_rays for one point. */
struct ray aim_ray(const struct aim *aim, double x, double y);

/* The chief ray, at its start. */
struct ray aim_chief(const struct aim *aim);

/*
 * A ray through the paraxial entrance pupil: no search.
 *
 * Given     beam, first  with the pupil's place and diameter (first_order_aperture)
 *           x, y         in units of its radius; of a telecentric object space in units of the
 *                        slope of the marginal ray
 * Errors    ERROR_DOMAIN: no stop or no aperture; a pupil infinitely far away and an object there;
 *           an object in the plane of the pupil; a field of 90 degrees or more
 */
bool aim_at_entrance(const struct beam *beam, const struct first_order *first, double x, double y,
                     struct ray *ray, struct error *error);

#endif
