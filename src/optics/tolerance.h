/* optics/tolerance.h - what a shop gets wrong, as it is written down: by how much, and where. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_OPTICS_TOLERANCE_H
#define LENSCALC_OPTICS_TOLERANCE_H

#include "base/arena.h"
#include "base/distribution.h"
#include "optics/surface.h"

#include <stdbool.h>
#include <stddef.h>

/* Of what: a row of tolerance.c says how it is written, in which units, and what it belongs to. */
enum tolerance_kind {
    TOLERANCE_RADIUS,
    TOLERANCE_THICKNESS, /* of glass; in a line of a file of whatever lies behind the surface */
    TOLERANCE_AIR,       /* of an air space */
    TOLERANCE_INDEX,     /* nd behind the surface */
    TOLERANCE_ABBE,      /* Vd behind the surface */
    TOLERANCE_TILT,      /* of a surface about its vertex */
    TOLERANCE_DECENTER,  /* of a surface */
    TOLERANCE_ELEMENT_TILT,
    TOLERANCE_ELEMENT_DECENTER,
    TOLERANCE_ELEMENT_ROLL, /* about the centre of curvature of the surface that it is seated on */
    TOLERANCE_WEDGE,        /* of an element: its last surface tilted, by total indicator runout */
    TOLERANCE_IRREGULARITY, /* of a surface, from peak to valley over its clear aperture */
    TOLERANCE_CONIC,
    TOLERANCE_COEFFICIENT, /* A2, A4 .. */
    TOLERANCE_FOCUS,       /* the place of the image plane */
    TOLERANCE_KINDS
};

/* What its amount is in. Lengths, angles are mm and rad here, whatever they were typed in. */
enum tolerance_unit {
    TOLERANCE_LENGTH,
    TOLERANCE_ANGLE,
    TOLERANCE_NUMBER,  /* of an index, an Abbe number, a conic; mm^(1 - n) of A_n */
    TOLERANCE_PERCENT, /* of the number itself */
    TOLERANCE_FRINGES, /* half waves of 546.07 nm, of sag at the edge of the clear aperture */
    TOLERANCE_UNITS
};

/* One fringe: half a wave of the green mercury line, mm. */
#define TOLERANCE_WAVE_MM   546.07e-6
#define TOLERANCE_FRINGE_MM (TOLERANCE_WAVE_MM / 2)

/* What a tolerance belongs to. */
enum tolerance_owner { TOLERANCE_OF_SURFACE, TOLERANCE_OF_ELEMENT, TOLERANCE_OF_LENS };

struct tolerance_type {
    const char *word;              /* in files, behind `surface 3` or `element 3..5`: "radius" */
    enum parameter_kind parameter; /* whose name is another way to write it: R3; _KINDS: none */
    enum tolerance_owner owner;
    unsigned units; /* bits of enum tolerance_unit: 1 << TOLERANCE_LENGTH */
};
const struct tolerance_type *tolerance_type(enum tolerance_kind kind);

/* A line with `tolerance`. */
struct lens_tolerance {
    enum tolerance_kind kind;
    size_t first, last;   /* surfaces, from 0; of the focus 0 */
    bool is_range;        /* each surface or element of first..last; false: they are one thing */
    int order;            /* of a coefficient */
    struct figure amount; /* half the range, plus and minus, above 0; typed with its unit,
                             but of a coefficient in that of the file */
    enum tolerance_unit unit;
    enum distribution distribution;
    double sigmas;      /* of normal and truncated: the amount in standard deviations */
    size_t pivot;       /* surface about whose vertex an element tilts (LENS_NONE: about the middle
                           between its outer vertices), on which it rolls (its first), whose wedge
                           it is (its last) */
    struct text text;   /* the line, for messages */
    const char *source; /* the file; null = none */
    long line;
    size_t column; /* where what it is of begins in that, from 1 */
};

/* Several of them. */
struct tolerances {
    const struct lens_tolerance *list;
    size_t count;
};

/* What it is of, as files have it: "R1..R11", "surface 3 tilt", "element 3..5 decenter". */
const char *tolerance_name(const struct lens_tolerance *tolerance, struct arena *arena);

#endif
