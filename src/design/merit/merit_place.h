/* design/merit/merit_place.h - the positions of a lens that is looked at, and its numbers there. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_MERIT_MERIT_PLACE_H
#define LENSCALC_DESIGN_MERIT_MERIT_PLACE_H

#include "design/merit/merit_state.h"

/* A merit of this question, with nothing ready. */
void merit_begin(struct merit *merit, const struct merit_question *question, struct arena *arena);

/*
 * Its places, with the wavelengths that are asked for.
 *
 * Errors    as setup_open
 */
bool merit_places_open(struct merit *merit, struct arena *arena, struct error *error);

/* The lens with these numbers, in all places, for who looks at slots by himself; derives: with
   derivatives. */
void merit_put_lens(struct merit *merit, const double *parameters, bool derives);

#endif
