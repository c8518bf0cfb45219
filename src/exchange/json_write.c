/* exchange/json_write.c - texts and numbers as JSON has them. */
/* SPDX-License-Identifier: MIT */
#include "exchange/json_write.h"

#include "base/number.h"

#include <math.h>

const char *json_of_text(struct arena *arena, struct text text)
{
    struct text_buffer to = {.arena = arena};
    growing_string(&to, "\"");
    for (size_t i = 0; i < text.length;) {
        const unsigned char *at = (const unsigned char *)text.start + i;
        size_t length = text_utf8_length(text.start + i, text.length - i);
        if (length == 0) {
            growing_string(&to, "\xef\xbf\xbd"); /* the replacement character */
        } else if (*at == '"' || *at == '\\') {
            growing_format(&to, "\\%c", *at);
        } else if (*at < 0x20) {
            growing_format(&to, "\\u%04x", *at);
        } else {
            growing_text(&to, (struct text){text.start + i, length});
        }
        i += length > 0 ? length : 1;
    }
    growing_put(&to, "\"", sizeof "\"");
    return to.data;
}

const char *json_of_string(struct arena *arena, const char *string)
{
    return string != NULL ? json_of_text(arena, text_of(string)) : "null";
}

const char *json_of_number(struct arena *arena, double value)
{
    char text[NUMBER_LENGTH];
    return isfinite(value)
               ? arena_string(arena, text, (size_t)(number_write_shortest(text, value) - text))
               : "null";
}

/* All digits that a pair has: what is read again has the same bits. */
const char *json_of_pair(struct arena *arena, struct pair value)
{
    char text[PAIR_LENGTH];
    if (!isfinite(value.hi)) {
        return "null";
    }
    const char *end = pair_write_shortest(text, value, NUMBER_UNSCALED);
    return arena_string(arena, text, (size_t)(end - text));
}
