/* trace/kernel/step.h - what the kernels need of one surface: uniform numbers for all rays. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_KERNEL_STEP_H
#define LENSCALC_TRACE_KERNEL_STEP_H

#include "trace/kernel/rays.h"

#include <stdbool.h>
#include <stddef.h>

enum step_kind {
    STEP_MOVE,     /* into another frame: no surface */
    STEP_PLANE,    /* c = 0 */
    STEP_SPHERE,   /* */
    STEP_CONIC,    /* k */
    STEP_CYLINDER, /* curved in one section, conic */
    STEP_ASPHERE,  /* conic and a polynomial of r^2 */
    STEP_TROUGH,   /* the same, curved in one section */
    STEP_ODD,      /* with odd powers of r, curved in both sections or in one */
    STEP_THICK     /* an ideal thick lens: optics/thick_lens */
};

enum step_action { ACTION_PASS, ACTION_REFRACT, ACTION_REFLECT };

enum { STEP_TERMS = 10 }; /* even ones, and as many odd ones */

/* r^2 up to this is the vertex, where 1/r counts as 0: 1/r^3 of what is above is finite. */
#define STEP_TINY 1e-200

/*
 * n is the index before, n' behind; c the curvature of the conic, k its constant. `direction` is
 * +1 where light meets the surface towards +z, -1 after an odd number of mirrors.
 */
struct step {
    _Alignas(64) enum step_kind kind;
    enum step_action action;
    bool hop;  /* go to the vertex plane first: t is long against the radius */
    int terms; /* of the polynomial, up to the last that is not 0 */
    size_t surface;
    double c, k, one_k;      /* 1/mm, 1, 1 + k */
    double t;                /* from the frame the rays are in, mm */
    double n11, n22;         /* n^2, n'^2 */
    double cn;               /* c n^2 */
    double dn;               /* (n' - n)(n' + n) */
    double start_c, start_k; /* of an asphere: c and 1 + k of the conic to start from */
    /* of an asphere: details of the shape are larger than a part of this radius, mm */
    double inner;
    double rim2;  /* where a search ends that Newton's method has lost, mm^2 */
    double depth; /* |z| of the surface is less than this up to there, mm */
    double direction;
    double clear2;             /* squared clear semi-diameter, mm^2; infinite = none */
    double weight_x, weight_y; /* of a cylinder: 1 in the curved section, else 0 */
    double miss, clipped, reflected, unconverged; /* what to write into `lost` of a kernel */
    double coefficient[STEP_TERMS];               /* A2, A4 ..: S = sum of A_2i u^i, u = r^2 */
    double slope[STEP_TERMS];                     /* of dS/du: i A_2i */
    /* STEP_ODD: S gains r sum of odd_i u^i, dS/du gains sum of odd_slope_i u^i / r */
    double odd[STEP_TERMS], odd_slope[STEP_TERMS];
    double turn[9], shift[3]; /* STEP_MOVE: X' = turn (X - shift) */
    /* STEP_THICK, with `coefficient` as d1 .. d3: slopes behind are ratio (u + w d) - bend h, with
       w = u - h near_object; the ray goes on at z = leave */
    double ratio, bend, near_object, leave;
    const struct clip *clip; /* beside clear2; null = nothing (trace/kernel/clip.h) */
};

/*
 * Take one block through steps.
 *
 * Given     path   also count the optical path, and keep |p| = n'
 *           lanes  the first so many: as kernel_lanes or kernel_lanes_few say
 * Source    see trace/system.h
 */
typedef void kernel_trace(const struct step *steps, size_t count, bool path, int lanes,
                          struct ray_block *block);

/*
 * The same; what lies behind step i is kept in blocks[i + 1]. Lost rays are NaN in the last only.
 */
typedef void kernel_tape(const struct step *steps, size_t count, bool path, int lanes,
                         struct ray_block *blocks);

/* Where rays are looked at: behind a step, by r^2 `over` the clear radius squared, less 1. */
struct rim_watch {
    size_t step;
    double over;   /* 1/mm^2 */
    double number; /* what names it */
    double *row;   /* receives the excess */
};

/* The watches of a way, in the order of its steps, and the worst of them for each ray. */
struct rim_watch_request {
    const struct rim_watch *watches;
    size_t count;
    double *excess, *number; /* -1 and 0 at least */
};

/*
 * Take one block through steps as kernel_trace does, and look at it on the way.
 *
 * Result    rows of rays that are not finite are NaN; others go on behind a miss, as numbers that
 *           mean nothing
 */
typedef void kernel_watch(const struct step *steps, size_t count, bool path, int lanes,
                          const struct rim_watch_request *watching, struct ray_block *block);

kernel_watch kernel_watch_few, kernel_watch_sse2, kernel_watch_avx2, kernel_watch_avx512;
kernel_tape kernel_tape_sse2, kernel_tape_avx2, kernel_tape_avx512;
kernel_trace kernel_trace_sse2, kernel_trace_avx2, kernel_trace_avx512;

/* Up to RAYS_FEW lanes only. */
kernel_trace kernel_trace_few;

/* Loops over fewer lanes would not pay: the stages of the others follow each other lanes apart. */
enum { KERNEL_LEAST = 3 * RAYS_FEW, RAYS_FEWEST = 4 };

/* How many lanes kernel_trace_few takes for so many rays. */
static inline int kernel_lanes_few(size_t rays)
{
    return (int)((rays + RAYS_FEWEST - 1) / RAYS_FEWEST * RAYS_FEWEST);
}

/* How many lanes the others take for so many rays, of which there may be more than a block. */
static inline int kernel_lanes(size_t rays)
{
    size_t lanes = (rays + RAYS_FEW - 1) / RAYS_FEW * RAYS_FEW;
    if (lanes > RAYS_BLOCK) {
        return RAYS_BLOCK;
    }
    return lanes < KERNEL_LEAST ? KERNEL_LEAST : (int)lanes;
}

#endif
