/* file/zemax_solve.h - what follows from rays or other surfaces in a .zmx file: the solves. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_ZEMAX_SOLVE_H
#define LENSCALC_FILE_ZEMAX_SOLVE_H

#include "exchange/zemax/zemax_surface.h"

/* The thicknesses in one position, by the file's surface numbers. */
struct solving {
    struct zemax_file *file;
    const size_t *places;
    struct lens lens; /* in this position */
    struct figure *thickness;
    struct figure *curvature; /* solved ones; else typed.start is null */
    size_t position;
    struct number_scale unit;
};

/*
 * Solve the curvature and the thickness of a surface, in the position that `solving` has.
 *
 * Result    in solving->thickness, curvature and lens. A solve that lenscalc does not know, or that
 *           has no answer, is a loss: the file's number stands
 */
bool zemax_solve_surface(struct solving *solving, size_t at, struct error *error);

/* Notes of the lens where a solve gives another number than the file has, beyond its rounding. */
void zemax_remark_solves(const struct solving *solving);

#endif
