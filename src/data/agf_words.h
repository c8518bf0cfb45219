/* data/agf_words.h - the words of an AGF file, line by line. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DATA_AGF_WORDS_H
#define LENSCALC_DATA_AGF_WORDS_H

#include "base/error.h"
#include "base/text.h"

#include <stdbool.h>

/* A file while it is read. */
struct agf_words {
    const char *source;
    struct text rest, line, at; /* lines to come, the present one, what is left of that */
    long number;                /* of the line, 1-based */
    bool touches;               /* only the end of a line parts the last word from the one before */
};

/* Go to the next line; false at the end. */
bool agf_words_line(struct agf_words *words);

/*
 * The next word. A line that begins with a number goes on with the one before it, for no keyword
 * does: so editors and mail wrap long lines.
 *
 * Result    empty at the end of the line, or of the last one that goes on with it
 */
struct text agf_words_next(struct agf_words *words);

/* A bad word, or a bad line: ERROR_DATA with its place. Returns false. */
bool agf_words_fail(const struct agf_words *words, struct text word, struct error *error,
                    const char *what);
bool agf_words_fail_line(const struct agf_words *words, struct error *error, const char *what);

#endif
