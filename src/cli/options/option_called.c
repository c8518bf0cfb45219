/* cli/options/option_called.c - what a message calls an option. */
/* SPDX-License-Identifier: MIT */
#include "cli/options/option.h"

#include <stdio.h>

const char *option_called(const struct option *option, struct called *room)
{
    if (option->called != NULL) {
        return option->called;
    }
    snprintf(room->text, sizeof room->text, "--%s", option->name);
    return room->text;
}

bool option_is_quantity(const struct option *option, struct text quantity)
{
    const char *own = option->quantity != NULL ? option->quantity : option->name;
    size_t i = 0;
    for (; i < quantity.length && own[i] != '\0'; i++) {
        char c = own[i] == '-' && option->quantity == NULL ? ' ' : own[i];
        if (c != quantity.start[i]) {
            return false;
        }
    }
    return i == quantity.length && own[i] == '\0';
}
