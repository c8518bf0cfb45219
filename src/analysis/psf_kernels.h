/* analysis/psf_kernels.h - the inner loops of images of points. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_PSF_KERNELS_H
#define LENSCALC_ANALYSIS_PSF_KERNELS_H

#include <stddef.h>

/* A row of complex numbers. */
struct psf_row {
    double *re, *im;
    size_t count;
};

/* Add a plane wave: amplitude exp(2 pi i (turns + step i)) at place i. */
struct psf_wave {
    double amplitude, turns, step;
};
typedef void psf_add_wave(const struct psf_wave *wave, const struct psf_row *row);

/* Add another row, times a complex number. */
typedef void psf_add_row(const struct psf_row *from, double re, double im,
                         const struct psf_row *row);

/*
 * Add a wavelet of a sphere about the origin of the image: at x = first + pitch i and y
 * amplitude exp(2 pi i (turns - waves (r - R))) R/r, r = sqrt(R^2 + x^2 + y^2 + 2 (bx x + by y)).
 */
struct psf_wavelet {
    double amplitude, turns, waves, radius;
    double bx, by; /* mm */
    double first, pitch, y;
};
typedef void psf_add_wavelet(const struct psf_wavelet *wavelet, const struct psf_row *row);

/* Compiled once for each instruction set, with the same bits. */
struct psf_kernels {
    psf_add_wave *add_wave;
    psf_add_row *add_row;
    psf_add_wavelet *add_wavelet;
};
extern const struct psf_kernels psf_kernels_sse2, psf_kernels_avx2, psf_kernels_avx512;

#endif
