/* exchange/json_write.h - texts and numbers as JSON has them. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_JSON_WRITE_H
#define LENSCALC_EXCHANGE_JSON_WRITE_H

#include "optics/growing.h"

/* In quotes, escaped; what is no UTF-8 becomes the replacement character. A null one is null. */
const char *json_of_text(struct arena *arena, struct text text);
const char *json_of_string(struct arena *arena, const char *string);

/* With the shortest digits that read back to the same bits; null where it is not finite. */
const char *json_of_number(struct arena *arena, double value);
const char *json_of_pair(struct arena *arena, struct pair value);

#endif
