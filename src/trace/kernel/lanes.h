/* trace/kernel/lanes.h - what the kernels that trace have in common. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_KERNEL_LANES_H
#define LENSCALC_TRACE_KERNEL_LANES_H

#include "trace/kernel/step.h"

#include <float.h>
#include <math.h>
#include <string.h>

/*
 * Every loop over lanes is free of branches and calls but sqrt, so that the compiler makes vectors
 * of it; the Makefile compiles the kernels with KERNEL set to sse2, avx2 and avx512. All three do
 * the same operations in the same order on every ray: the same bits.
 */
#define NAME_(name, set) name##_##set
#define NAME(name, set)  NAME_(name, set)
#define INLINE           static inline __attribute__((always_inline))

/*
 * How many lanes of a block are traced: those that are asked for, which are some times RAYS_FEW.
 * That they are is told to the compiler, which then makes no loop for the rest of a vector. The set
 * `few` is for searches that need up to RAYS_FEW, some times RAYS_FEWEST; it has the instructions
 * that every processor has.
 */
#ifdef KERNEL_FEW
enum { KERNEL_LANES = RAYS_FEW };
#define LANES_OF(lanes) ((lanes) / RAYS_FEWEST * RAYS_FEWEST)
#else
enum { KERNEL_LANES = RAYS_BLOCK };
#define LANES_OF(lanes) ((lanes) / RAYS_FEW * RAYS_FEW)
#endif

/* The state of one lane. */
struct lane {
    double x, y, z, p, q, r, path;
};

INLINE struct lane load(const struct ray_block *block, int i, double t)
{
    return (struct lane){block->x[i], block->y[i], block->z[i] - t, block->p[i],
                         block->q[i], block->r[i], block->path[i]};
}

INLINE void store_point(struct ray_block *block, int i, const struct lane *ray, bool path)
{
    block->x[i] = ray->x;
    block->y[i] = ray->y;
    block->z[i] = ray->z;
    if (path) {
        block->path[i] = ray->path;
    }
}

INLINE void store_direction(struct ray_block *block, int i, const struct lane *ray)
{
    block->p[i] = ray->p;
    block->q[i] = ray->q;
    block->r[i] = ray->r;
}

/* What may be written into `lost`; local copies, so that choosing one is no branch. */
struct codes {
    double miss, clipped, reflected;
};

INLINE struct codes codes_of(const struct step *s)
{
    return (struct codes){s->miss, s->clipped, s->reflected};
}

/*
 * On one surface a miss comes before the clear aperture, and the clear aperture before total
 * reflection. Codes fall from surface to surface, so that the largest is the first loss of a ray. A
 * point that is not there has NaN everywhere: not met.
 */
INLINE void note(struct ray_block *block, int i, struct codes codes, bool met, bool inside,
                 bool leaves)
{
    double loss = leaves ? 0 : codes.reflected, old = block->lost[i];
    loss = inside ? loss : codes.clipped;
    loss = met ? loss : codes.miss;
    block->lost[i] = old > loss ? old : loss;
}

/* Go along the ray; d is in units of 1/n. */
INLINE void advance(struct lane *ray, double d)
{
    ray->x += d * ray->p;
    ray->y += d * ray->q;
    ray->z += d * ray->r;
}

/* Keep |p| = n': rounding would add up in the path. No root: the error is a few ulp. */
INLINE void normalize(struct lane *ray, const struct step *s)
{
    double rest = s->n22 - (ray->p * ray->p + ray->q * ray->q + ray->r * ray->r);
    double more = rest * (0.5 / s->n22);
    ray->p += more * ray->p;
    ray->q += more * ray->q;
    ray->r += more * ray->r;
}

/*
 * To the vertex plane, where the quadratic is well conditioned; returns the way. Rays that go along
 * the plane or against it (a fisheye has such) go to where they come nearest to the vertex.
 */
INLINE double hop(struct lane *ray, const struct step *s)
{
    double over = ray->x * ray->p + ray->y * ray->q + ray->z * ray->r;
    double to_plane = -ray->z / ray->r, nearest = -over * (1 / s->n11);
    bool steep = s->direction * ray->r * fabs(ray->r) * 16 > s->n11;
    double d = steep ? to_plane : nearest, z = ray->z + d * ray->r;
    ray->x += d * ray->p;
    ray->y += d * ray->q;
    ray->z = steep ? 0 : z;
    return d;
}

#ifdef KERNEL_FEW
/* Stages of a surface, one after the other. */
#define LANES(lanes) for (int lane = 0; lane < LANES_OF(lanes); lane++)
/* clang-format off */
#define IN_TURN(lanes, FIRST, SECOND, THIRD, FOURTH)                                               \
    do {                                                                                           \
        LANES(lanes) { FIRST(lane); }                                                              \
        LANES(lanes) { SECOND(lane); }                                                             \
        LANES(lanes) { THIRD(lane); }                                                              \
        LANES(lanes) { FOURTH(lane); }                                                             \
    } while (0)
#define IN_TURN_SMALL IN_TURN
/* clang-format on */
#else
/*
 * Stages of a surface. A root or quotient takes as long as twenty sums, and whatever waits for one
 * stands in the way of the rest; so each loop does different stages for different lanes, LATE lanes
 * apart, and none waits for what it has just begun. There are KERNEL_LEAST lanes at least.
 */
#ifdef __AVX512F__
enum { LATE = 16 };
#else
enum { LATE = 8 };
#endif
#define LANES(from, to) for (int lane = (from)*LATE; lane < (to)*LATE; lane++)
#define LATER(turns)    (lane - (turns)*LATE)
/* clang-format off */
#define IN_TURN(lanes, FIRST, SECOND, THIRD, FOURTH)                                               \
    do {                                                                                           \
        const int END = (lanes) / RAYS_FEW * (RAYS_FEW / LATE);                                    \
        LANES(0, 1) { FIRST(lane); }                                                               \
        LANES(1, 2) { FIRST(lane); SECOND(LATER(1)); }                                             \
        LANES(2, 3) { FIRST(lane); SECOND(LATER(1)); THIRD(LATER(2)); }                            \
        LANES(3, END) { FIRST(lane); SECOND(LATER(1)); THIRD(LATER(2)); FOURTH(LATER(3)); }        \
        LANES(END, END + 1) { SECOND(LATER(1)); THIRD(LATER(2)); FOURTH(LATER(3)); }               \
        LANES(END + 1, END + 2) { THIRD(LATER(2)); FOURTH(LATER(3)); }                             \
        LANES(END + 2, END + 3) { FOURTH(LATER(3)); }                                              \
    } while (0)

/*
 * The same in half the text and up to 3 % more time: what leads up to the loop in the middle and
 * what is left after it are loops of one stage each.
 */
#define ONE_BY_ONE(from, to) _Pragma("GCC unroll 1") LANES(from, to)
#define IN_TURN_SMALL(lanes, FIRST, SECOND, THIRD, FOURTH)                                         \
    do {                                                                                           \
        const int END = (lanes) / RAYS_FEW * (RAYS_FEW / LATE);                                    \
        ONE_BY_ONE(0, 3) { FIRST(lane); }                                                          \
        ONE_BY_ONE(0, 2) { SECOND(lane); }                                                         \
        ONE_BY_ONE(0, 1) { THIRD(lane); }                                                          \
        LANES(3, END) { FIRST(lane); SECOND(LATER(1)); THIRD(LATER(2)); FOURTH(LATER(3)); }        \
        ONE_BY_ONE(END - 1, END) { SECOND(lane); }                                                 \
        ONE_BY_ONE(END - 2, END) { THIRD(lane); }                                                  \
        ONE_BY_ONE(END - 3, END) { FOURTH(lane); }                                                 \
    } while (0)
/* clang-format on */
#endif

/* What the stages hand on, one row each. */
struct found {
    double square[KERNEL_LANES];                               /* a root is to be drawn of it */
    double numerator[KERNEL_LANES], denominator[KERNEL_LANES]; /* to be divided .. */
    double way[KERNEL_LANES];                                  /* .. is this: d, later g */
    double bend[KERNEL_LANES];                                 /* D; of spheres g */
    double f[KERNEL_LANES], G[KERNEL_LANES];                   /* of the normal of an asphere */
    double open[KERNEL_LANES];                                 /* 1 = Newton's method goes on */
};

INLINE void divide(struct found *found, int i)
{
    found->way[i] = found->numerator[i] / found->denominator[i];
}
#define DIVIDE(i) divide(&found, i)

#define NOTHING(i) ((void)(i))

/* Of kernel_conic.c: one step of that kind. */
typedef void kernel_step(struct ray_block *block, const struct step *step, bool path, int lanes);
kernel_step NAME(kernel_conic, KERNEL), NAME(kernel_asphere, KERNEL);

#endif
