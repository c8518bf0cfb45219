/* base/nufft.c - nonuniform Fourier transforms: waves of any frequencies at even places. */
/* SPDX-License-Identifier: MIT */
#include "base/nufft.h"

#include "base/constants.h"

#include <math.h>

enum { LENGTH_LEAST = 2 * NUFFT_TAPS }; /* so that no wave meets itself */

/*
 * exp(x) of |x| <= 4, without a call, as base/turns.h has sines: the series of an eighth of it to
 * the 12th power, squared three times; 2e-13 at the ends.
 */
static double nufft_exp(double x)
{
    static const double over[] = {1,      1. / 2, 1. / 3, 1. / 4,  1. / 5,  1. / 6,
                                  1. / 7, 1. / 8, 1. / 9, 1. / 10, 1. / 11, 1. / 12};
    double sum = 1;
    for (size_t k = sizeof over / sizeof *over; k-- > 0;) {
        sum = 1 + sum * (x / 8 * over[k]);
    }
    sum *= sum;
    sum *= sum;
    return sum * sum;
}

struct nufft nufft_open(size_t count, struct arena *arena)
{
    const size_t wanted = 2 * count > LENGTH_LEAST ? 2 * count : LENGTH_LEAST;
    struct nufft nufft = {.count = count, .fft = fft_open(fft_length_from(wanted), arena)};
    const double length = (double)nufft.fft.length, ratio = length / (double)count;
    /* as wide as what comes back of the sums' copies and what is cut off the Gaussian allow */
    nufft.wide = NUFFT_REACH * ratio / (PI * (ratio - 0.5));
    const double base = nufft_exp(-1 / nufft.wide);
    for (int k = 0; k < NUFFT_TAPS; k++) {
        const int z = k - NUFFT_REACH + 1;
        nufft.taps[k] = 1;
        for (int power = 0; power < z * z; power++) {
            nufft.taps[k] *= base;
        }
    }
    nufft.left = ARENA_ARRAY(arena, count, double);
    for (size_t i = 0; i < count; i++) {
        const double turns = ((double)i - (double)(count / 2)) / length;
        nufft.left[i] =
            sqrt(PI * nufft.wide) * nufft_exp(-nufft.wide * (PI * turns) * (PI * turns));
    }
    return nufft;
}

struct nufft_wave nufft_wave(const struct nufft *nufft, double turns)
{
    const double length = (double)nufft->fft.length;
    const double at = (turns - floor(turns)) * length, cell = fmin(floor(at), length - 1);
    const double off = at - cell;
    /* exp(-(k - off)^2/wide) is that of off, of k, and a power of what they have in common */
    const double middle = nufft_exp(-off * off / nufft->wide);
    const double base = nufft_exp(2 * off / nufft->wide);
    const size_t before = NUFFT_REACH - 1, here = (size_t)cell;
    struct nufft_wave wave;
    wave.first = here >= before ? here - before : here + nufft->fft.length - before;
    double power = middle;
    for (size_t k = before; k < NUFFT_TAPS; k++, power *= base) {
        wave.shares[k] = power * nufft->taps[k];
    }
    power = middle / base;
    for (size_t k = before; k-- > 0; power /= base) {
        wave.shares[k] = power * nufft->taps[k];
    }
    return wave;
}
