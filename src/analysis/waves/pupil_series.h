/* analysis/waves/pupil_series.h - functions of a disc as sums of polynomials, many places at once. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_WAVES_PUPIL_SERIES_H
#define LENSCALC_ANALYSIS_WAVES_PUPIL_SERIES_H

#include "base/arena.h"

#include <stdbool.h>
#include <stddef.h>

enum { PUPIL_ORDERS = 19, PUPIL_RADIAL = 18, PUPIL_TERMS = 504, PUPIL_LANES = 8 };

/*
 * Terms T_j(2 r^2 - 1) r^m cos m phi for m = 0, 1 .. and j = 0 .. radial[m] - 1; behind those of
 * each m > 0 the ones with the sine. T: Chebyshev's polynomials.
 */
struct pupil_form {
    size_t orders; /* m below it */
    size_t radial[PUPIL_ORDERS];
    size_t terms;
};

/*
 * Terms that k rings of 2 k + 1 points tell apart: m <= k, and a degree below 2 k, where the
 * quadrature of those points makes Zernike's polynomials orthogonal; k at most 18: of more the
 * least squares of a distorted pupil lose their digits.
 */
struct pupil_form pupil_form_of(size_t points);

/* All terms up to a degree in x and y, which is below PUPIL_RADIAL. */
struct pupil_form pupil_form_of_degree(size_t degree);

/* The multiple of PUPIL_LANES that has room for so many. */
static inline size_t pupil_room(size_t count)
{
    return (count + PUPIL_LANES - 1) / PUPIL_LANES * PUPIL_LANES;
}

/* Two functions at places: count is a multiple of PUPIL_LANES. */
struct pupil_look {
    size_t count;
    const double *x, *y;
    double *value[2];
    double *slope[2][2]; /* by x and y; null: neither wanted nor there */
};

/* What the two make of an area at place i: the determinant of their slopes. */
static inline double pupil_area(double *slope[2][2], size_t i)
{
    return slope[0][0][i] * slope[1][1][i] - slope[0][1][i] * slope[1][0][i];
}

/* The functions with coefficients c, into value and slope. */
void pupil_look(const struct pupil_form *form, const double *const c[2],
                const struct pupil_look *look);

/* The other way round: sums over all places of value times each term plus slope times its slope. */
void pupil_gather(const struct pupil_form *form, const struct pupil_look *look,
                  double *const sums[2]);

/* Least squares of some places. */
struct pupil_fit {
    const struct pupil_form *form;
    size_t count; /* a multiple of PUPIL_LANES; places that are none weigh 0 */
    const double *x, *y, *weights;
    double *factor; /* terms x terms; receives that of pupil_fit_open */
    double *room;   /* count times terms */
};

/* Result    false: the places do not tell the terms apart */
bool pupil_fit_open(const struct pupil_fit *fit);

/* Sums of pupil_gather become coefficients; and what they are by, the other way round. */
void pupil_fit_solve(const struct pupil_fit *fit, double *sums);

/* Fit two functions, one number a place each: to coefficients c. Given `work`: twice `count`. */
void pupil_fit_find(const struct pupil_fit *fit, const double *const values[2],
                    double *const work[2], double *const c[2]);

/* Places of an overlap: W in turns and amplitudes at both, and weights. */
struct pupil_cross {
    size_t count;
    const double *waves[2], *amplitudes[2], *weights;
    double *re, *im; /* receive weight A A' cos and sin of 2 pi (W - W') */
    double *size;    /* receives weight A A'; or null */
};

void pupil_cross(const struct pupil_cross *cross);

/* Internal: one variant an instruction set, with the same bits. */
typedef void kernel_pupil_look(const struct pupil_form *form, const double *const c[2],
                               const struct pupil_look *look);
typedef void kernel_pupil_gather(const struct pupil_form *form, const struct pupil_look *look,
                                 double *const sums[2]);
typedef void kernel_pupil_gram(const struct pupil_fit *fit);
typedef void kernel_pupil_cross(const struct pupil_cross *cross);
kernel_pupil_look kernel_pupil_look_sse2, kernel_pupil_look_avx2, kernel_pupil_look_avx512;
kernel_pupil_gather kernel_pupil_gather_sse2, kernel_pupil_gather_avx2, kernel_pupil_gather_avx512;
kernel_pupil_gram kernel_pupil_gram_sse2, kernel_pupil_gram_avx2, kernel_pupil_gram_avx512;
kernel_pupil_cross kernel_pupil_cross_sse2, kernel_pupil_cross_avx2, kernel_pupil_cross_avx512;

#endif
