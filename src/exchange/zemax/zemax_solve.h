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
 * What a solve that follows a ray gives in some lens.
 *
 * Given     is_curvature  the curvature's, else that of the thickness
 * Result    false: it follows none, or has no answer
 */
bool zemax_solve_in(const struct solver_state *solving, size_t at, bool is_curvature,
                    const struct lens *lens, struct arena *arena, struct pair *value);

/*
 * What the solves give against the numbers that the program has stored beside them. Within what
 * rounding and editions of catalogues may do a note says both. Beyond that
 * the lens is not the one that the program had: a loss, and the file's number is kept.
 */
void zemax_check_solves(struct solver_state *solving);

/* A curvature of a surface, 1/mm: as a radius where a short one has it as its reciprocal. */
void zemax_set_curvature(struct zemax_file *file, struct figure curvature, struct surface *to);

#endif
