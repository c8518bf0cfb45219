/* design/predesign.h - lenses from nothing: powers, bendings and gaps by third-order theory. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_PREDESIGN_H
#define LENSCALC_DESIGN_PREDESIGN_H

#include "base/arena.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { PREDESIGN_MOST = 10 }; /* elements */

/* What a lens shall be; all lengths in focal lengths. */
struct predesign_wish {
    size_t elements; /* 1 .. PREDESIGN_MOST */
    double fnumber;
    double field;       /* tangent of the largest angle in object space; of a near object its height
                           over its distance */
    double vergence;    /* 1/distance of the object; 0: infinite */
    bool is_achromatic; /* several wavelengths count */
    double back, track; /* vertex of the last surface to the image at least, of the first at most */
    double clear;       /* diameter that thicknesses are chosen for */
    double curvature;   /* of a surface at most */
    double center[2], gap[2]; /* of glass and air, least and most */
};

/* Elements in air, one after the other, with model glasses. */
struct predesign {
    size_t elements, stop;                /* the stop lies behind so many elements */
    double curvature[2 * PREDESIGN_MOST]; /* front and rear of each element */
    double index[PREDESIGN_MOST], abbe[PREDESIGN_MOST], center[PREDESIGN_MOST];
    double gap[PREDESIGN_MOST]; /* behind each, the stop's parts together; the last to the image */
    double before;              /* of the gap with the stop what lies in front of it; of a stop in
                                   front of the lens all of it, behind the lens too */
};

/*
 * A layout to begin with.
 *
 * Given     stop    0 .. elements: in which gap
 *           seed, number  which of the layouts by chance
 *           arena   for work; given back
 * Result    false: theory found none
 * Formula   thin elements, positive ones of crown, negative ones of flint, with signs, powers,
 *           bendings and gaps by chance; then least squares, by curvatures and gaps, on the power,
 *           the back focus, the track, axial and lateral colour (y^2 and y ybar over f V), the sums
 *           S1 .. S5 (with the Petzval sum) as transverse aberrations, and, with less weight, on
 *           the S1 .. S3 of each surface and its curvature, whose higher orders spoil a fast lens;
 *           of some such the best. Then centres are made thick enough for edges, and gaps give
 *           what principal planes take. Derivatives by the complex step
 * Source    [Welford86] 6 and 8 (sums, stop shift); [Squire98]
 */
bool predesign_find(const struct predesign_wish *wish, size_t stop, uint64_t seed, uint32_t number,
                    struct arena *arena, struct predesign *design);

#endif
