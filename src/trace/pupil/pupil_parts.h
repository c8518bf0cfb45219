/* trace/pupil/pupil_parts.h - which separate parts of a pupil pass light, as a coarse grid sees them. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_PUPIL_PUPIL_PARTS_H
#define LENSCALC_TRACE_PUPIL_PUPIL_PARTS_H

#include "trace/pupil/clearances.h"

#include <stdbool.h>
#include <stddef.h>

enum { PUPIL_PARTS_SIDE = 128 };

/* Cells of a grid over u, v, row after row. */
struct pupil_parts {
    double low[2], step[2]; /* the middle of the first cell; from one to the next */
    unsigned short
        part[PUPIL_PARTS_SIDE * PUPIL_PARTS_SIDE]; /* 0: dark; cells that touch have one number */
    double excess[PUPIL_PARTS_SIDE * PUPIL_PARTS_SIDE]; /* of those that pass; of others above 0 */
    size_t count;                                       /* of parts: numbers go up to it */
};

/*
 * Where it is worth looking, in u, v: all that the first surface lets in as the beam sees it, and
 * no less than twice the pupil.
 */
void pupil_parts_bound(const struct clearances *margins, double low[2], double high[2]);

/*
 * Look at the middle of every cell.
 *
 * Given     low, high  corners in u, v; null: pupil_parts_bound
 */
void pupil_parts_find(const struct clearances *margins, const double low[2], const double high[2],
                      struct pupil_parts *parts);

/* The u and v of a cell. */
void pupil_parts_point(const struct pupil_parts *parts, size_t cell, double point[2]);

/* The ray of the largest part that passes best; false: all is dark. */
bool pupil_parts_middle(const struct pupil_parts *parts, double point[2]);

#endif
