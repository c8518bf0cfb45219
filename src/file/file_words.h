/* file/file_words.h - words of a file that is read line by line, and what is wrong with them. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_FILE_WORDS_H
#define LENSCALC_FILE_FILE_WORDS_H

#include "base/arena.h"
#include "base/error.h"
#include "base/number.h"
#include "base/text.h"

#include <stdbool.h>
#include <stddef.h>

/* A file while it is read, line by line. Texts point into the content. */
struct file_words {
    const char *source;        /* for messages */
    struct error *error;       /* receives what is wrong */
    struct text rest;          /* lines that are still to read */
    struct text line;          /* the present one, without its end and its comment */
    long number;               /* of that line, 1-based */
    const char *at;            /* where the next word of the line begins */
    struct number_scale scale; /* unit of a length in mm */
    const char *comment;       /* what begins a comment, where a word may begin; null = nothing */
    bool has_quotes;           /* of values, key="..."; no comment begins between them */
    struct arena *arena;
};

/*
 * Begin to read.
 *
 * Errors    ERROR_DATA: NUL bytes, a mark of UTF-16, lines that end in CR alone
 */
bool file_words_open(struct file_words *words, const char *source, struct text content,
                     struct arena *arena, struct error *error);

/*
 * Control characters but tabs and line ends have no place in such files, and would reach the
 * terminal with a title: those of ASCII, and U+0080 to U+009F.
 *
 * Errors    ERROR_DATA with line and column
 */
bool file_words_plain(const char *source, struct text content, struct error *error);

/*
 * Go to the next line that has words; false at the end. CRLF and comments are passed over; of
 * another program's file `comment` is set after file_words_open, and `has_quotes` where they count.
 */
bool file_words_line(struct file_words *words);

/*
 * The next word of the line: up to a blank outside of {...} and "..."; its length is 0 at the end
 * of the line.
 */
struct text file_words_next(struct file_words *words);

/* All that is left of the line, trimmed. */
struct text file_words_rest(struct file_words *words);

/* Is the line at its end? Says what does not belong there. */
bool file_words_end(struct file_words *words);

/* Where a word of the line stands. */
struct typed_place file_words_place(const struct file_words *words, struct text word);

/* Report something wrong with a word of the line; `word` may lie behind its end. Returns false. */
bool file_words_fail(const struct file_words *words, struct text word, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
