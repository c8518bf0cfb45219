/* base/nufft.h - nonuniform Fourier transforms: waves of any frequencies at even places. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_NUFFT_H
#define LENSCALC_BASE_NUFFT_H

#include "base/fft.h"

#include <stddef.h>

enum { NUFFT_REACH = 12, NUFFT_TAPS = 2 * NUFFT_REACH };

/* Sums at `count` places 0, 1 ..., whose phases are 0 at count/2; read-only once open. */
struct nufft {
    size_t count;
    struct fft fft;          /* over twice as many cells and more */
    double wide;             /* of the Gaussian exp(-z^2/wide) of z cells */
    double taps[NUFFT_TAPS]; /* of a wave in the middle of its cell, about it */
    double *left;            /* what the Gaussian leaves at each place; owned by the arena */
};

/* The cells that a wave is spread over: `first`, first + 1 ..., beyond the last the first again. */
struct nufft_wave {
    size_t first;
    double shares[NUFFT_TAPS];
};

/*
 * Make ready for sums at so many places.
 *
 * Given     count  1 .. FFT_MOST/2
 * Formula   sum of c exp(-2 pi i f x) over waves: each is spread by a Gaussian over NUFFT_TAPS
 *           cells of frequency, the cells are transformed, and each place is divided by the
 *           Gaussian's transform there, `left`; spreading, transform and division are the caller's
 * Source    [GreengardLee04]; a test has the sums themselves
 * Limits    off by 1e-11 of the sum of all |c|
 */
struct nufft nufft_open(size_t count, struct arena *arena);

/* A wave of so many turns from one place to the next. */
struct nufft_wave nufft_wave(const struct nufft *nufft, double turns);

/* The cell behind one. */
static inline size_t nufft_next(const struct nufft *nufft, size_t cell)
{
    return cell + 1 < nufft->fft.length ? cell + 1 : 0;
}

/* Which of the transformed cells a place is; its value is to be divided by nufft->left. */
static inline size_t nufft_cell(const struct nufft *nufft, size_t place)
{
    const size_t half = nufft->count / 2;
    return place >= half ? place - half : nufft->fft.length - (half - place);
}

#endif
