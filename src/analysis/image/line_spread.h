/* analysis/image/line_spread.h - line spread and edge spread functions of a field. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_IMAGE_LINE_SPREAD_H
#define LENSCALC_ANALYSIS_IMAGE_LINE_SPREAD_H

#include "analysis/image/mtf.h"
#include "analysis/image/psf.h"

#include <stdbool.h>
#include <stddef.h>

struct line_spread_question {
    struct bundle_question bundle; /* its wavelength, pattern and weight are not used */
    double farthest;               /* as far from the chief ray as is asked, mm; NaN: as is usual */
};

/* The light of a line's image at even places from the chief ray; tangential: across the section. */
struct line_spread_image {
    double step;                  /* mm; place i of `count` lies at (i - count/2) step */
    size_t count;                 /* odd */
    double usual;                 /* mm: from -usual to usual is most of the light */
    double *line[MTF_DIRECTIONS]; /* share of all light per mm; owned by the arena */
    double *edge[MTF_DIRECTIONS]; /* share of all light up to there: an edge, bright outwards */
    double error[MTF_DIRECTIONS]; /* of the edge */
    struct pupil_islands islands;
};

struct line_spread {
    double line[MTF_DIRECTIONS]; /* share of all light per mm; NaN: beyond the image */
    double edge[MTF_DIRECTIONS]; /* 0 .. 1 */
};

struct line_spread_widths {
    double line[MTF_DIRECTIONS]; /* full width at half maximum, mm */
    double edge[MTF_DIRECTIONS]; /* between 10 and 90 % of an edge, mm; NaN: not within the image */
};

/*
 * Find both functions along the section of axis and field point, and across it.
 *
 * Formula   light at x = sum over wavelengths of integral |F(t, x)|^2 dt, F = integral of
 *           A exp(2 pi i (W - n s x/wavelength)) ds along lines of the pupil, which by Parseval's
 *           theorem is the transform of the complex MTF; the edge is its integral, the light beyond
 *           both ends, which falls as 1/x^2, shared as the last tenths of both sides are
 * Source    [Goodman05] 6.3; tests have a clear circle's and the transform of mtf_find
 * Errors    as psf_look; ERROR_DOMAIN: an image infinitely far away
 * Limits    error: what equal shares would change, and 1e-5
 */
bool line_spread_open(const struct line_spread_question *question, struct arena *arena,
                      struct line_spread_image *image, struct error *error);

/* At a place, mm from the chief ray, by polynomials through eight of those around it. */
struct line_spread line_spread_at(const struct line_spread_image *image, double place);

/* How wide a line's and an edge's images are. */
struct line_spread_widths line_spread_widths_find(const struct line_spread_image *image);

#endif
