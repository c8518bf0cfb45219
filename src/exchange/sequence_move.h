/* exchange/sequence_move.h - shifted and turned surfaces of CODE V and OSLO files. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_SEQUENCE_MOVE_H
#define LENSCALC_EXCHANGE_SEQUENCE_MOVE_H

#include "exchange/sequence.h"

/* Beside a shift along the axis, which goes into the thicknesses. */
bool sequence_is_decentred(const struct sequence_surface *surface);

/* What the surfaces' shifts along z do to the thicknesses around them. */
void sequence_spread_z(const struct sequence *sequence);

/* Errors    losses: turns whose order a lens does not have */
void sequence_check_move(const struct sequence *sequence, const struct sequence_surface *from);

/* Planes before a surface that is turned about z, y and x before it is shifted. */
void sequence_turn_first(const struct sequence *sequence, const struct sequence_surface *from);

/* Shift and turn a surface. Result: the one whose distance is that to the next. */
struct surface *sequence_move_surface(const struct sequence *sequence,
                                      struct sequence_surface *from, struct surface *surface);

#endif
