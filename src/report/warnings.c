/* report/warnings.c - what is doubtful about a question, said once each beside the answer. */
/* SPDX-License-Identifier: MIT */
#include "report/warnings.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void warnings_add(struct warnings *doubts, const char *format, ...)
{
    enum { LONGEST = 4000 }; /* a lens file may have much that is doubtful */
    char text[LONGEST];
    va_list values;
    if (doubts == NULL) {
        return;
    }
    va_start(values, format);
    vsnprintf(text, sizeof text, format, values);
    va_end(values);
    for (size_t i = 0; i < doubts->count; i++) {
        if (strcmp(doubts->texts[i], text) == 0) {
            return;
        }
    }
    if (doubts->count < WARNINGS_MOST) {
        doubts->texts[doubts->count++] = arena_string(&doubts->arena, text, strlen(text));
    } else {
        doubts->left_out++;
    }
}

const char *warnings_left_out(struct warnings *doubts)
{
    return doubts->left_out == 0
               ? NULL
               : arena_printf(&doubts->arena, "and %zu more like these", doubts->left_out);
}
