/* exchange/json_write.c - texts and numbers as JSON has them. */
/* SPDX-License-Identifier: MIT */
#include "exchange/json_write.h"

#include "base/number.h"

#include <math.h>

void json_put_text(struct text_buffer *to, struct text text)
{
    growing_string(to, "\"");
    for (size_t i = 0; i < text.length;) {
        const unsigned char *at = (const unsigned char *)text.start + i;
        size_t length = text_utf8_length(text.start + i, text.length - i);
        if (length == 0) {
            growing_string(to, "\xef\xbf\xbd"); /* the replacement character */
        } else if (*at == '"' || *at == '\\') {
            growing_format(to, "\\%c", *at);
        } else if (*at < 0x20) {
            growing_format(to, "\\u%04x", *at);
        } else {
            growing_text(to, (struct text){text.start + i, length});
        }
        i += length > 0 ? length : 1;
    }
    growing_string(to, "\"");
}

void json_put_string(struct text_buffer *to, const char *string)
{
    if (string == NULL) {
        growing_string(to, "null");
    } else {
        json_put_text(to, text_of(string));
    }
}

void json_put_number(struct text_buffer *to, double value)
{
    if (isfinite(value)) {
        char text[NUMBER_LENGTH];
        growing_text(to, text_between(text, number_write_shortest(text, value)));
    } else {
        growing_string(to, "null");
    }
}

/* All digits that a pair has: what is read again has the same bits. */
void json_put_pair(struct text_buffer *to, struct pair value)
{
    char text[PAIR_LENGTH];
    if (!isfinite(value.hi)) {
        growing_string(to, "null");
    } else {
        growing_text(to, text_between(text, pair_write_shortest(text, value, NUMBER_UNSCALED)));
    }
}
