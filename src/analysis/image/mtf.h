/* analysis/image/mtf.h - modulation transfer function of a field, diffraction or geometric. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_IMAGE_MTF_H
#define LENSCALC_ANALYSIS_IMAGE_MTF_H

#include "analysis/waves/hopkins.h"
#include "analysis/waves/wave_reference.h"

#include <stdbool.h>
#include <stddef.h>

enum { MTF_RAYS_LANES = 16 };

/* Compiled once for each instruction set: sums[0] += weight cos(2 pi frequency x), [1] the sine. */
typedef void kernel_mtf_rays(const double *places, const double *weights, size_t count,
                             double frequency, double sums[2]);
kernel_mtf_rays kernel_mtf_rays_sse2, kernel_mtf_rays_avx2, kernel_mtf_rays_avx512;

struct mtf_question {
    struct bundle_question bundle; /* its wavelength, pattern and weight are not used */
    bool by_rays;
    double error; /* of contrasts, absolute */
};

enum { MTF_TANGENTIAL, MTF_SAGITTAL, MTF_DIRECTIONS };

/* A field made ready. */
struct mtf_source {
    const struct mtf_question *question;
    struct exit_pupils pupils;
    struct exit_lines *lines;   /* [wavelength][direction] */
    struct exit_front *fronts;  /* the same */
    double off[MTF_DIRECTIONS]; /* what series of wave fronts may make of contrast, at the worst */
    struct gauss_rules *rules;
    struct mtf_rays *rays;           /* internal; null: by waves */
    double along[MTF_DIRECTIONS][2]; /* in the image plane, of unit length */
    double cutoff[MTF_DIRECTIONS];   /* 1/mm: no wavelength has contrast beyond it; NaN: no paths */
    size_t directions;               /* that differ: one of a round lens on its axis, else both */
};

struct mtf {
    double contrast[MTF_DIRECTIONS]; /* NaN: the wave front is too steep or too rough */
    double phase[MTF_DIRECTIONS];    /* rad, of the Fourier transform about the reference */
    double limit[MTF_DIRECTIONS];    /* of the same pupils with perfect wave fronts */
    double error;                    /* of the contrasts */
    bool has_converged;
};

/*
 * Make a field ready.
 *
 * Result    by rays a lens without optical paths has no pupils.list, no cut-off and no limits
 * Errors    as exit_pupils_open; ERROR_DOMAIN: an image infinitely far away
 */
bool mtf_open(const struct mtf_question *question, struct arena *arena, struct mtf_source *source,
              struct error *error);

/*
 * Contrasts at a frequency.
 *
 * Given     frequency  1/mm in the image plane, >= 0: along the section of axis and field point
 *                      (tangential: lines across it), and across that
 * Formula   overlap_find of each wavelength at the shift wavelength frequency/n, added by their
 *           weights and light; by rays: mtf_rays_find
 * Source    [Hopkins55], [Goodman05] 6.3
 * Errors    as bundle_trace
 */
bool mtf_find(const struct mtf_source *source, double frequency, struct arena *arena,
              struct mtf *mtf, struct error *error);

/* What square pixels leave of a frequency, with its sign: sin(pi f p)/(pi f p); NaN p: 1. */
double mtf_square_pixels(double frequency, double pitch);

/*
 * Contrasts of square bars, as test charts have them, between the middles of bars and gaps.
 *
 * Given     frequency  of pairs of a bar and a gap, 1/mm
 *           pitch      of square pixels, whose MTF is included, mm; NaN: none
 * Result    as mtf_find, phase that of the fundamental; the contrast of wide bars is 1, and that of
 *           narrow ones up to 4/pi times that of sines
 * Formula   4/pi times the sum over odd n of (-1)^((n-1)/2) M(n f)/n cos(phase(n f) - n phase(f)),
 *           up to the cut-off, or 127 terms and half the next
 * Source    [Coltman54]
 * Errors    as mtf_find
 */
bool mtf_square_find(const struct mtf_source *source, double frequency, double pitch,
                     struct arena *arena, struct mtf *mtf, struct error *error);

#endif
