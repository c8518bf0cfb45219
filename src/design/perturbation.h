/* design/perturbation.h - what may be wrong with a lens that is made: independent numbers. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_PERTURBATION_H
#define LENSCALC_DESIGN_PERTURBATION_H

#include "base/arena.h"
#include "base/error.h"
#include "optics/lens.h"
#include "optics/tolerance.h"

#include <stdbool.h>
#include <stddef.h>

/* Of what is two numbers: a decentre along x or y, a tilt about x or y. */
enum perturbation_axis { PERTURBATION_ROUND, PERTURBATION_X, PERTURBATION_Y };

/*
 * One independent random number of the lens: it adds amount times a number of `spread`
 * (base/distribution.h).
 */
struct perturbation {
    enum tolerance_kind kind; /* THICKNESS is of glass, AIR of air; never ELEMENT_ROLL: that is
                                 an ELEMENT_TILT about its centre of curvature */
    size_t first, last;       /* surfaces, from 0; the same but of an element */
    struct parameter what;    /* the number it is added to, of RADIUS to DECENTER, WEDGE, CONIC,
                                 COEFFICIENT; a radius in fringes, and that of a plane, is a
                                 curvature. Kind PARAMETER_KINDS: it is of elements, irregularity
                                 or the focus. Not parameter_check'ed: an index may be that of a
                                 catalogue's glass, a thickness a word of the positions */
    enum perturbation_axis axis;
    double amount; /* half range, above 0: mm, 1/mm, 1 or rad; of irregularity waves of
                      546.07 nm from peak to valley of the surface */
    struct spread spread;
    double pivot;     /* of an element's tilt: mm from the vertex of `first`, along the axis */
    const char *name; /* "R1", "t3", "element 3..5 tilt x", for rows and messages */
};

#endif
