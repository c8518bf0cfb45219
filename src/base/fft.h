/* base/fft.h - discrete Fourier transforms of lengths 2^a 3^b 5^c. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_FFT_H
#define LENSCALC_BASE_FFT_H

#include "base/arena.h"
#include "base/instruction_set.h"

#include <stdbool.h>
#include <stddef.h>

enum {
    FFT_LANES = 8,      /* lines that are transformed side by side */
    FFT_PASSES = 24,    /* at most, of one transform */
    FFT_MOST = 1 << 20, /* the largest length */
};

/* One step of a transform: `radix` parts, each `length` of what is left apart. */
struct fft_pass {
    size_t radix, length;
    const double *cosine, *sine; /* length * (radix - 1) twiddles */
};

/* A length made ready; read-only afterwards. */
struct fft {
    size_t length, count;
    struct fft_pass passes[FFT_PASSES];
};

/* Is it 2^a 3^b 5^c, and at most FFT_MOST? */
bool fft_has(size_t length);

/* The least such length that is not below `length`; `length` <= FFT_MOST. */
size_t fft_length_from(size_t length);

/* Make a length ready, one that fft_has. */
struct fft fft_open(size_t length, struct arena *arena);

/* Where the numbers of lines lie: number k of line i at i * line + k * step. */
struct fft_lines {
    double *re, *im;
    size_t count, line, step;
};

/*
 * Transform lines in place.
 *
 * Given     inverse  the other sign; neither is divided by the length
 * Formula   X_k = sum_j x_j exp(-+ 2 pi i j k/n), by Stockham's passes, which need no reordering:
 *           of radix 4, then 2, 3 and 5, FFT_LANES lines side by side
 * Source    [VanLoan92] 1.7; tested against the sum in long double
 */
void fft_transform(const struct fft *fft, bool inverse, const struct fft_lines *lines,
                   enum instruction_set set, struct arena *arena);

/* The same of both directions of a square, row by row. */
void fft_plane(const struct fft *fft, bool inverse, double *re, double *im, struct arena *arena);

/* FFT_LANES lines, their numbers side by side: re, im receive them, spare has room for as many. */
typedef void kernel_fft(const struct fft *fft, double *re, double *im, double *spare_re,
                        double *spare_im);
kernel_fft kernel_fft_sse2, kernel_fft_avx2, kernel_fft_avx512;

#endif
