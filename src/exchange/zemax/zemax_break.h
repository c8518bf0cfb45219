/* exchange/zemax/zemax_break.h - what shifts and turns the axis in .zmx files. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_ZEMAX_ZEMAX_BREAK_H
#define LENSCALC_EXCHANGE_ZEMAX_ZEMAX_BREAK_H

#include "exchange/zemax/zemax_parse.h"

/* The medium before the next surface to add. */
struct medium zemax_medium_before(const struct lens *lens);

/* The next surface has the break; one that waits already goes to a plane. */
void zemax_hold_break(struct zemax_file *file, const struct displacement *coordinate_break);

/* A plane that does nothing but carry the break that waits, if one does. */
void zemax_add_plane(struct zemax_file *file);

/* COORDBRK: shift, then turn about x, y, z; with PARM 6 turn about z, y, x, then shift. */
void zemax_add_break(struct zemax_file *file, size_t at);

/* Does the break do nothing else, and a surface follow? Then it needs no plane of its own. */
bool zemax_is_bare(const struct zemax_file *file, size_t at);

/*
 * SCBD: the axis shifted and turned before a surface, and behind it before its distance, as
 * coordinate breaks there would do.
 *
 * Given     behind  the second of them: a plane has it, whose distance is that of the surface
 * Source    DDE codes 51 to 66 of surface data: order 0 shifts first, 1 turns first; status behind
 *           the surface 0 its own numbers, 1 those before it, 2 those before it undone
 * Errors    a loss: numbers that follow another surface
 */
void zemax_add_shift(struct zemax_file *file, size_t at, bool behind);

#endif
