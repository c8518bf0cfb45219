/* commands/lens/focus_gaps.h - the gaps of a lens that focus it, as typed: "d5,10:-1,last". */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_LENS_FOCUS_GAPS_H
#define LENSCALC_COMMANDS_LENS_FOCUS_GAPS_H

#include "base/arena.h"
#include "optics/focusing.h"
#include "photo/distance_from.h"

/* A gap, and how it was called. */
struct named_gap {
    struct focus_gap gap;
    struct text name;
};

/*
 * Read NAME[:WEIGHT],... where NAME is a variable of the lens that stands for thicknesses, or any
 * name of parameter_gap_find: `last` is the gap to the image plane.
 *
 * Given     lens  as read, with its variables
 *           gaps  room for FOCUS_GAPS
 * Errors    ERROR_USAGE: an unknown name, a weight that is no number or 0, a gap named twice, more
 *           than FOCUS_GAPS
 */
bool focus_gaps_read(struct text text, const struct lens *lens, struct named_gap *gaps,
                     size_t *count, struct error *error);

/*
 * A lens to be focused by its gaps before its own paraxial image plane.
 *
 * Given     text      of the gaps
 *           typed     as read, with its variables;  lens  the same in its position
 *           focusing  with wavelength and section; receives lens, gaps and image plane
 * Errors    as focus_gaps_read and first_order_of_lens
 */
bool focus_gaps_open(struct text text, const struct lens *typed, const struct lens *lens,
                     struct arena *arena, struct focus_mechanism *focusing, struct error *error);

/* The same place for conjugates. */
enum conjugate_from focus_from(enum distance_from from);

#endif
