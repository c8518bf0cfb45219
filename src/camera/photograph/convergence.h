/* camera/photograph/convergence.h - how far the tiles of a picture have come, and how exact it is. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_PHOTOGRAPH_CONVERGENCE_H
#define LENSCALC_CAMERA_PHOTOGRAPH_CONVERGENCE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What is counted of tiles: sums, which do not depend on the order of threads and parts. */
enum convergence_count {
    CONVERGENCE_TILES,
    CONVERGENCE_RAYS,   /* of a pixel and colour, over the tiles */
    CONVERGENCE_MISSED, /* tiles that have not reached the error */
    /* errors as multiples of the one asked for: of tiles that reached it, of the others; in units
       of their own */
    CONVERGENCE_SQUARES,
    CONVERGENCE_MISSED_SQUARES,
    CONVERGENCE_COUNTS
};

/* Rays of a pixel before the first estimate, that the halves of a few do not agree by chance. */
enum { CONVERGENCE_LEAST = 16 };

/*
 * Error of a mean, from its halves.
 *
 * Given     first, both  sums of n numbers, and of these and n more, `count` of each
 *           n
 * Result    root mean square of (mean of the first n - mean of the other n)/2
 * Formula   of random points the standard error; of the halves of a sequence of low discrepancy,
 *           whose errors lie on opposite sides rather, more than the error: a bound
 * Source    derived here: |A - B|/2 with A, B of equal variance
 */
double convergence_halves(const double *first, const double *both, size_t count, double n);

/* What is asked for of light without a white of its own. */
struct convergence_goal {
    double error; /* share of each number */
    double white; /* what of them becomes white in a picture */
};

/*
 * The same, each as a multiple of what it may be: a share of the smaller mean of its halves, or a
 * grey level there if that is more.
 *
 * Given     as convergence_halves
 * Result    root mean square; 1: as asked for
 * Formula   y = mean/white; a level of sRGB with 8 bits is dy = 1/(255 s'), s' = 0.4396 y^-0.583,
 *           12.92 at most: with sqrt alone, the same bits everywhere, as 0.4396 y^-0.5625, within
 *           11 %
 * Source    [IEC99] 5.2
 */
double convergence_relative(const struct convergence_goal *goal, const double *first,
                            const double *both, size_t count, double n);

/* Count a tile: its error as a multiple of the one asked for, and the rays of its pixels. */
void convergence_add(uint64_t counts[CONVERGENCE_COUNTS], double error, size_t rays);

/* Root mean square of the errors of all tiles, or of those that missed, in the same multiples. */
double convergence_error(const uint64_t counts[CONVERGENCE_COUNTS], bool missed);

#endif
