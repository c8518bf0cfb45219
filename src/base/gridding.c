/* base/gridding.c - nonuniform Fourier transforms: waves of any frequencies at even places. */
/* SPDX-License-Identifier: MIT */
#include "base/gridding.h"

#include "base/constants.h"

#include <math.h>

enum { LENGTH_LEAST = 2 * GRIDDING_TAPS }; /* so that no wave meets itself */

/*
 * exp(x) of |x| <= 4, without a call, as base/turns.h has sines: the series of an eighth of it to
 * the 12th power, squared three times; 2e-13 at the ends.
 */
static double gridding_exp(double x)
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

struct gridding gridding_open(size_t count, struct arena *arena)
{
    const size_t wanted = 2 * count > LENGTH_LEAST ? 2 * count : LENGTH_LEAST;
    struct gridding gridding = {.count = count, .fft = fft_open(fft_length_from(wanted), arena)};
    const double length = (double)gridding.fft.length, ratio = length / (double)count;
    /* as wide as what comes back of the sums' copies and what is cut off the Gaussian allow */
    gridding.wide = GRIDDING_REACH * ratio / (PI * (ratio - 0.5));
    const double base = gridding_exp(-1 / gridding.wide);
    for (int k = 0; k < GRIDDING_TAPS; k++) {
        const int z = k - GRIDDING_REACH + 1;
        gridding.taps[k] = 1;
        for (int power = 0; power < z * z; power++) {
            gridding.taps[k] *= base;
        }
    }
    gridding.left = ARENA_ARRAY(arena, count, double);
    for (size_t i = 0; i < count; i++) {
        const double turns = ((double)i - (double)(count / 2)) / length;
        gridding.left[i] =
            sqrt(PI * gridding.wide) * gridding_exp(-gridding.wide * (PI * turns) * (PI * turns));
    }
    return gridding;
}

struct gridding_wave gridding_wave(const struct gridding *gridding, double turns)
{
    const double length = (double)gridding->fft.length;
    const double at = (turns - floor(turns)) * length, cell = fmin(floor(at), length - 1);
    const double off = at - cell;
    /* exp(-(k - off)^2/wide) is that of off, of k, and a power of what they have in common */
    const double middle = gridding_exp(-off * off / gridding->wide);
    const double base = gridding_exp(2 * off / gridding->wide);
    const size_t before = GRIDDING_REACH - 1, here = (size_t)cell;
    struct gridding_wave wave;
    wave.first = here >= before ? here - before : here + gridding->fft.length - before;
    double power = middle;
    for (size_t k = before; k < GRIDDING_TAPS; k++, power *= base) {
        wave.shares[k] = power * gridding->taps[k];
    }
    power = middle / base;
    for (size_t k = before; k-- > 0; power /= base) {
        wave.shares[k] = power * gridding->taps[k];
    }
    return wave;
}
