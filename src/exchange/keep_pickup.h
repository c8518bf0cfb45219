/* exchange/keep_pickup.h - pick-ups of other programs' files, as those of a lens. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_KEEP_PICKUP_H
#define LENSCALC_EXCHANGE_KEEP_PICKUP_H

#include "optics/lens.h"

/*
 * Give a lens that is whole a pick-up, where it says what the lens has, to the last bit: what other
 * programs understand by one may be more, and then the number stands alone.
 *
 * Given     factor, offset  what = factor from + offset; offset in mm, 1/mm, rad or 1
 */
void keep_pickup(struct lens *lens, struct parameter what, struct parameter from,
                 struct pair factor, struct pair offset, struct arena *arena);

#endif
