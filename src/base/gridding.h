/* base/gridding.h - nonuniform Fourier transforms: waves of any frequencies at even places. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_GRIDDING_H
#define LENSCALC_BASE_GRIDDING_H

#include "base/fft.h"

#include <stddef.h>

enum { GRIDDING_REACH = 12, GRIDDING_TAPS = 2 * GRIDDING_REACH };

/* Sums at `count` places 0, 1 ..., whose phases are 0 at count/2; read-only once open. */
struct gridding {
    size_t count;
    struct fft fft;             /* over twice as many cells and more */
    double wide;                /* of the Gaussian exp(-z^2/wide) of z cells */
    double taps[GRIDDING_TAPS]; /* of a wave in the middle of its cell, about it */
    double *left;               /* what the Gaussian leaves at each place; owned by the arena */
};

/* The cells that a wave is spread over: `first`, first + 1 ..., beyond the last the first again. */
struct gridding_wave {
    size_t first;
    double shares[GRIDDING_TAPS];
};

/*
 * Make ready for sums at so many places.
 *
 * Given     count  1 .. FFT_MOST/2
 * Formula   sum of c exp(-2 pi i f x) over waves: each is spread by a Gaussian over GRIDDING_TAPS
 *           cells of frequency, the cells are transformed, and each place is divided by the
 *           Gaussian's transform there, which gridding_places does
 * Source    [GreengardLee04]; a test has the sums themselves
 * Limits    off by 1e-11 of the sum of all |c|
 */
struct gridding gridding_open(size_t count, struct arena *arena);

/* A wave of so many turns from one place to the next. */
struct gridding_wave gridding_wave(const struct gridding *gridding, double turns);

/* The cell behind one. */
static inline size_t gridding_next(const struct gridding *gridding, size_t cell)
{
    return cell + 1 < gridding->fft.length ? cell + 1 : 0;
}

/* Which of the transformed cells a place is; its value is to be divided by gridding->left. */
static inline size_t gridding_cell(const struct gridding *gridding, size_t place)
{
    const size_t half = gridding->count / 2;
    return place >= half ? place - half : gridding->fft.length - (half - place);
}

#endif
