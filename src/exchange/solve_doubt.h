/* exchange/solve_doubt.h - solves of other programs' files against the numbers beside them. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_SOLVE_DOUBT_H
#define LENSCALC_EXCHANGE_SOLVE_DOUBT_H

#include "base/arena.h"
#include "optics/lens.h"

#include <stdbool.h>

/* What a solve gives in a lens, mm or 1/mm; false: nothing. */
typedef bool solve_answer(const void *context, const struct lens *lens, struct arena *arena,
                          double *value);

/*
 * How far what a solve gives may be from what another program has solved, though both have the same
 * lens: by rounded numbers of the file, and by indices that are not known better.
 *
 * Given     lens      of one position
 *           surface   that the solve is of: what stands before it matters
 *           relative  rounding of the file's numbers
 *           answer    the solve
 * Formula   sum over the curvatures c, gaps d and indices n up to the surface of
 *           |da/d(ln c)| relative, |da/d(ln d)| relative, |da/dn| u: u = 1e-5 for a glass of a
 *           catalogue, of which editions differ by that, and a tenth of n - nd for one of which
 *           only nd and Vd are known
 */
double solve_doubt(const struct lens *lens, size_t surface, double relative, solve_answer *answer,
                   const void *context, struct arena *arena);

#endif
