/* trace/pupil/clearances.h - by how much rays of a pupil pass what may stop them: smooth numbers. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_PUPIL_CLEARANCES_H
#define LENSCALC_TRACE_PUPIL_CLEARANCES_H

#include "base/arena.h"
#include "trace/kernel/clip.h"
#include "trace/kernel/rays.h"
#include "trace/kernel/step.h"
#include "trace/pupil/stop_beam.h"

#include <stdbool.h>
#include <stddef.h>

/* Something that ends a bundle: its excess over 0 is smooth in u and v, but for lists. */
struct clearance {
    size_t place;            /* behind which it is looked at: surfaces in the order of light + 1 */
    size_t surface;          /* LENS_NONE: the disc of u and v */
    double clear2;           /* squared clear radius, mm^2; infinite: none */
    const struct clip *clip; /* null: no list of apertures */
};

/* What is looked at, and one block to do it in. */
struct clearances {
    const struct stop_beam *beam;
    const struct system *system; /* of the edge: unobstructed */
    const struct system *full;   /* with what blocks within the edge; null: nothing does */
    const struct clearance *all;
    size_t count;
    bool *counts;   /* which of them are looked at: all at first */
    bool is_listed; /* some surface has apertures beside its diameter */
    struct rays work;
    double *rows;    /* one a margin, RAYS_BLOCK numbers each */
    double *excess;  /* the largest of them; infinite where a ray is lost */
    size_t *limit;   /* which that is; clearances_lost: lost there */
    double *numbers; /* the same while a kernel works */
    struct rim_watch *watches;
    bool is_mirrored; /* what lies on one side of u = 0 mirrors the other */
    bool is_plain;    /* all are clear radii of surfaces that stand where the lens does */
};

struct clearances clearances_open(const struct stop_beam *beam, struct arena *arena);

/*
 * Take up to RAYS_BLOCK rays at u, v through the system: rows, excess and limit of each. What
 * passes has an excess of 0 and less: r^2/a^2 - 1 of a clear radius a.
 */
void clearances_look(const struct clearances *margins, const double (*points)[2], size_t count);

/*
 * The same for who wants to know only which rays pass: where all of them are found not to, their
 * excess is infinite and the rest of the way is spared. All margins count.
 */
void clearances_sift(const struct clearances *margins, const double (*points)[2], size_t count);

/* Look only at those that come near to 0: an excess above -0.3 of a ray looked at last. */
void clearances_narrow(const struct clearances *margins, size_t rays);

/* Look at all of them again. */
void clearances_widen(const struct clearances *margins);

/* A number for rays that are lost otherwise, more than that of any margin. */
static inline bool clearances_lost(size_t limit)
{
    return limit >= ((size_t)1 << 32);
}

/* That of a ray that misses a surface, and has passed or missed no rim before. */
static inline size_t clearances_missed(size_t surface)
{
    return ((size_t)1 << 32) + 8 * (surface + 1) + RAY_MISS;
}

/* Rays at u, v, where they start; in the last block more may follow. */
void clearances_start(const struct clearances *margins, const double (*points)[2],
                      const struct rays *rays);

/* Take rays at u, v to before a place; they stand in the block. */
void clearances_go(const struct clearances *margins, const double (*points)[2], size_t count,
                   size_t to);

/*
 * Which piece of an aperture's edge rays are nearest to that end at it.
 *
 * Given     at        up to RAYS_BLOCK rays that pass, by their coordinates in the beam
 *           surfaces  what ends each; LENS_NONE: something else
 *           parts     receives a number of the piece, 0 where no list of apertures ends the ray
 */
void clearances_parts(const struct clearances *margins, const double (*at)[2], size_t count,
                      const size_t *surfaces, size_t *parts);

/*
 * How far within something that blocks rays come: the largest clip_depth of all surfaces.
 *
 * Given     margins  full is not null
 *           at       up to RAYS_BLOCK rays, by their coordinates in the beam
 *           depth  receives it: 0 and less passes
 *           part   a number of the piece of an edge that decides
 */
void clearances_depth(const struct clearances *margins, const double (*at)[2], size_t count,
                      double *depth, size_t *part);

/* Where ray i, that stands there, crosses a surface, in its own frame. */
void clearances_cross(const struct clearances *margins, size_t surface, size_t i, double point[3]);

#endif
