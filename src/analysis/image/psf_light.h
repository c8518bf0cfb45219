/* analysis/image/psf_light.h - the light of one wavelength over the pixels of an image. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_IMAGE_PSF_LIGHT_H
#define LENSCALC_ANALYSIS_IMAGE_PSF_LIGHT_H

#include "analysis/image/psf.h"
#include "base/nufft.h"

#include <stddef.h>

enum { PSF_LANES = 16, PSF_NODES = 4, PSF_ROWS_MOST = 256 };

/*
 * A wavelet of a sphere about the origin of the image: at x and y amplitude
 * exp(2 pi i (turns - waves (r - R))) R/r, r = sqrt(R^2 + x^2 + y^2 + 2 (bx x + by y)).
 */
struct psf_wavelet {
    double amplitude, turns, waves, radius;
    double bx, by; /* mm */
};

/* How to step along rows: where to look, and what the first row and its differences are of it. */
struct psf_steps {
    size_t rows;                              /* at most PSF_ROWS_MOST */
    double at[PSF_NODES];                     /* in rows from the first */
    double differences[PSF_NODES][PSF_NODES]; /* [0]: the value at the first row */
};

/* PSF_LANES columns of pixels, row by row, from x and y of the first on. */
struct psf_strip {
    double x, y, pitch; /* mm */
    double *re, *im;
};

/*
 * Add a wavelet to the rows of a strip. The phase along a column is a cubic through the nodes, so
 * that the wave of the next row is this one's times that of the difference, and so on; the
 * amplitude R/r likewise, by sums.
 */
typedef void kernel_psf(const struct psf_wavelet *wavelet, const struct psf_steps *steps,
                        const struct psf_strip *strip);

/* Compiled once for each instruction set, with the same bits. */
kernel_psf kernel_psf_sse2, kernel_psf_avx2, kernel_psf_avx512;

/* Pixels at work; mm, or of an image infinitely far away sines of angles. */
struct psf_plane {
    const struct exit_pupil *pupil;
    size_t size;
    double pitch;
    double spread;    /* of rays from the reference, at most: the slope of the wave front */
    bool is_perfect;  /* W = 0 */
    const char *unit; /* of a thousandth of that, for messages */
    double *re, *im;  /* size * size, 0 at first; receive the amplitude, scaled by the pitch */
    double perfect;   /* receives the amplitude of W = 0 at the reference */
    int threads;      /* that may work on it, for wavelets */
    double along[2];  /* of unit length, that lines of points follow; 0, 0: x */
    struct arena *arena;
};

/* The ways of it. Errors as psf_find. */
typedef bool psf_way(struct psf_plane *plane, struct error *error);
psf_way psf_by_plane, psf_by_fft, psf_by_huygens;

/* Points of the pupil, line by line. */
struct psf_points {
    double (*at)[2];            /* direction cosines; a line along x has one of the second */
    double *waves, *amplitudes; /* W, wavelengths; times what each counts */
    size_t *ends;               /* behind each line, which has one point at least */
    double *widths;             /* of each line, which its amplitudes are times */
    size_t lines, count;
    double total; /* of the amplitudes */
};

/* How often the phase turns across the pupil at the edge of the image. */
double psf_points_turns(const struct psf_plane *plane);

/* Does the phase turn as rarely as sums take? Errors: ERROR_DOMAIN: it does not, and what would. */
bool psf_points_fit(const struct psf_plane *plane, struct error *error);

/*
 * Gauss's points between the edges of the pupil, along lines, and over the angle that
 * struct exit_piece has from one line to the next.
 *
 * Formula   exp(i k x) over -1..1 is a polynomial of degree k and some more, which half as many
 *           points integrate: pi/2 = 1.6 a turn along a line. Of exp(i k sin u) over a half turn
 *           of u the slope is pi/2 times that in the middle: 2.5 a turn. Some more of both leave
 *           1e-8 of the peak, of 2 to 300 turns
 * Errors    as psf_points_fit
 */
bool psf_points_put(const struct psf_plane *plane, struct psf_points *points, struct error *error);

/* Sums over the points of FFT_LANES lines, fft.length cells each. */
struct psf_cells {
    double *re, *im;
    struct arena *arena;
};
struct psf_cells psf_cells_new(const struct nufft *nufft, struct arena *arena);

/*
 * The sums of amplitude exp(2 pi i (W - f x)) over the points of lines, at the places x of a
 * nufft.
 *
 * Given     across_place  f of a point is its product with that, turns from a place to the next
 *           first         of the lines
 *           cells         receives each sum at nufft_cell, to be divided by nufft->left
 * Result    how many lines
 */
size_t psf_lines_transform(const struct nufft *nufft, const struct psf_points *points,
                           const double across_place[2], size_t first, struct psf_cells *cells);

#endif
