/* exchange/lens_json_design.h - what of a lens follows, is wanted and allowed, in JSON. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_LENS_JSON_DESIGN_H
#define LENSCALC_EXCHANGE_LENS_JSON_DESIGN_H

#include "exchange/lens_json_reading.h"
#include "optics/growing.h"

/*
 * Pick-ups, goals and tolerances: lists of the lines that a .lens file in mm has of them, where
 * there are any.
 *
 * Given     text  receives them, each list behind a comma
 */
void json_put_design(struct text_buffer *text, const struct lens *lens, struct arena *arena);

/* Such lists; the lens has all else. */
bool json_read_design(struct json_reader *reading, const struct json_value *pickups,
                      const struct json_value *goals, const struct json_value *tolerances,
                      struct error *error);

#endif
