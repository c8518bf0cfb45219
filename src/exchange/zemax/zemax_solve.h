/* exchange/zemax/zemax_solve.h - solves and pick-ups of a .zmx file. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_ZEMAX_ZEMAX_SOLVE_H
#define LENSCALC_EXCHANGE_ZEMAX_ZEMAX_SOLVE_H

#include "exchange/zemax/zemax_surface.h"

/* The thicknesses, by the file's surface numbers. */
struct solver_state {
    struct zemax_file *file;
    const size_t *places;
    struct lens lens;
    struct figure *thickness;
    struct figure *curvature; /* solved ones; else typed.start is null */
    struct number_scale unit;
};

/*
 * Solve the curvature and the thickness of a surface.
 *
 * Result    in solving->thickness, curvature and lens. Of a solve that lenscalc does not know, or
 *           that has no answer, the file's number stands: zemax_stands
 */
void zemax_solve_surface(struct solver_state *solving, size_t at);

/*
 * What a solve that follows a ray gives in some lens.
 *
 * Given     is_curvature  the curvature's, else that of the thickness
 * Result    false: it follows none, or has no answer
 */
bool zemax_solve_in(const struct solver_state *solving, size_t at, bool is_curvature,
                    const struct lens *lens, struct arena *arena, struct pair *value);

/* Pick-ups of curvatures and thicknesses become those of the lens, whose numbers are all set. */
void zemax_keep_pickups(const struct solver_state *solving);

/* A curvature of a surface, 1/mm: as a radius where a short one has it as its reciprocal. */
void zemax_set_curvature(struct zemax_file *file, struct figure curvature, struct surface *to);

#endif
