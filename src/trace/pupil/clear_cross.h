/* trace/pupil/clear_cross.h - a few rays that show what the rims let through of a beam. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_PUPIL_CLEAR_CROSS_H
#define LENSCALC_TRACE_PUPIL_CLEAR_CROSS_H

#include "base/arena.h"
#include "trace/pupil/edges.h"
#include "trace/pupil/pupil_inside.h"

/* Five rays of what passes: its middle, and its edges across. */
struct clear_cross {
    bool is_empty;
    double centre[2];          /* between the edges, mm */
    struct clear_edge ends[4]; /* towards +a, +b, -a, -b from there */
};

/*
 * The middle and the edges of a beam, without its shape: for a few rays that show it.
 *
 * Given     is_round  the lens is the same in all directions: the middle lies in the meridional
 *                     plane, a = 0, and the two edges aside mirror each other
 *           guess     best a ray that passes: then nothing is searched for
 * Formula   through a ray inside across (a), through the middle of that up and down (b), through
 *           the middle of that across again. Edges: edges_find, and about
 *           what that says the last ray that passes; what mirrors an edge is not looked for
 */
void clear_across(const struct system *system, const struct beam *beam,
                  const struct clear_guess *guess, bool is_round, struct arena *arena,
                  struct clear_cross *cross);

#endif
