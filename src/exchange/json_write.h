/* exchange/json_write.h - texts and numbers as JSON has them. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_JSON_WRITE_H
#define LENSCALC_EXCHANGE_JSON_WRITE_H

#include "optics/growing.h"

/* In quotes, escaped; what is no UTF-8 becomes the replacement character. A null one is null. */
void json_put_text(struct text_buffer *to, struct text text);
void json_put_string(struct text_buffer *to, const char *string);

/* With the shortest digits that read back to the same bits; null where it is not finite. */
void json_put_number(struct text_buffer *to, double value);
void json_put_pair(struct text_buffer *to, struct pair value);

#endif
