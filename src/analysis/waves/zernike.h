/* analysis/waves/zernike.h - Zernike's circle polynomials in the orders that are in use. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_WAVES_ZERNIKE_H
#define LENSCALC_ANALYSIS_WAVES_ZERNIKE_H

#include <stddef.h>

enum zernike_kind {
    ZERNIKE_NOLL,   /* from 1; orthonormal: mean square over the disc 1 */
    ZERNIKE_FRINGE, /* from 1, by n + |m|, the 37th n = 12, m = 0; 1 at the edge */
    ZERNIKE_ANSI    /* ISO 24157, ANSI Z80.28: from 0; orthonormal */
};

enum { ZERNIKE_MOST = 496, ZERNIKE_ORDER = 60 };

struct zernike_term {
    int index; /* as its order counts */
    int n, m;  /* radial order; m >= 0: cos(m angle), m < 0: sin(|m| angle) */
};

/*
 * Term i of an order, i from 0, below ZERNIKE_MOST.
 *
 * Source    [Noll76] table I; fringe: j = (1 + (n + |m|)/2)^2 - 2|m|, and 1 more of sines, but for
 *           the 37th, with which the set of interferometers ends: n = 12, m = 0, whose place, the
 *           49th, n = m = 6 takes; [ISO24157]: (n(n + 2) + m)/2
 */
struct zernike_term zernike_term(enum zernike_kind kind, size_t i);

/*
 * The first `count` polynomials at a point of the unit disc, the angle counted from +x towards +y.
 *
 * Formula   R_n^m from R_(n-2)^m and R_(n-4)^m: sums of powers lose their digits from n = 20 on
 * Source    [Kintner76] (8)
 */
void zernike_fill(enum zernike_kind kind, size_t count, double x, double y, double *values);

#endif
