/* exchange/oslo/oslo_words.c - what a word of an OSLO file loses. */
/* SPDX-License-Identifier: MIT */
#include "exchange/oslo/oslo_words.h"

#include <stdarg.h>
#include <stdio.h>

bool oslo_lose(struct oslo *oslo, struct error *error, const char *format, ...)
{
    char message[sizeof error->message];
    const struct command_word *word = &oslo->commands.words[0];
    const struct lens_words place = commands_place(&oslo->commands, word);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    return foreign_loss(oslo->job, &place, word->text, error, "%.*s: %s",
                        (int)(word->text.length < 20 ? word->text.length : 20), word->text.start,
                        message);
}
