/* trace/adjoint.h - what the adjoint kernels are given. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_ADJOINT_H
#define LENSCALC_TRACE_ADJOINT_H

#include "trace/dispatch.h"
#include "trace/kernel/step.h"

/* A surface that moves by itself: along three axes and about three through its vertex. */
struct adjoint_motion {
    double shift[9], turn[9]; /* axes as the surface sees them, one a row */
    double *rows;             /* six: along x, y; about three; along z */
};

/* Rows of RAYS_BLOCK numbers that a step fills. Indices are added to, the others written. */
struct adjoint_rows {
    double *curvature, *thickness, *index_before, *index_after;
    double *conic;       /* null = not wanted, where the surface is a sphere or plane */
    double *coefficient; /* STEP_TERMS rows; null = not wanted where there is no polynomial */
    double *odd;         /* STEP_TERMS rows; null = not wanted where there are no odd powers */
    const struct adjoint_motion *motion; /* null = not wanted */
    double thickness_sign;
    bool along_behind; /* of a STEP_MOVE: the way lies along the axis that is turned to */
    int lanes;         /* the first so many: as kernel_lanes says */
};

/*
 * Take the adjoint of one step's result to that of what it was given.
 *
 * Given     before, after  the rays in front of the step and behind it
 *           adjoint        derivatives of something by x, y, z, p, q, r, path behind; receives
 *                          those in front
 * Formula   see trace/derivative.h
 */
typedef void kernel_adjoint(const struct step *step, const struct ray_block *before,
                            const struct ray_block *after, struct ray_block *adjoint,
                            const struct adjoint_rows *rows);
kernel_adjoint kernel_adjoint_sse2, kernel_adjoint_avx2, kernel_adjoint_avx512;

/* The kernels for a set of instructions, in trace/dispatch.c. */

#endif
