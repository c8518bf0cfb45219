/* base/error.h - one error, carried up by return value. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_ERROR_H
#define LENSCALC_BASE_ERROR_H

#include "base/text.h"

#include <stdbool.h>
#include <stddef.h>

/* What went wrong; the values are the exit statuses of the program. */
enum error_code {
    ERROR_NONE = 0,
    ERROR_DOMAIN = 1, /* no answer: outside the domain, nothing found */
    ERROR_USAGE = 2,  /* the command line is wrong */
    ERROR_ROWS = 3,   /* some rows of a batch failed */
    ERROR_DATA = 4,   /* a data file is bad */
    ERROR_IO = 5,     /* reading or writing failed, or memory is used up */
    ERROR_PIPE = 141  /* who read standard output has left, and is told nothing: the status that
                         shells give to a program that SIGPIPE ended */
};

/*
 * Where a message names a quantity that may have been given. The formulas know quantities, not
 * options and columns: a format says "{distance} %g mm lies within {the focal length} %g mm", the
 * message is "distance 40 mm lies within the focal length 50 mm", and who read the two can put
 * "--distance" or "column 's'" in their places with error_name. A command, which knows its options,
 * says "{--distance}".
 */
struct mention {
    short at, length; /* of the words between the braces, in the text */
};

enum { ERROR_MENTIONS = 12 };

/* A text with the quantities it names, in their order. */
struct mentions {
    int count;
    struct mention all[ERROR_MENTIONS];
};

struct error {
    enum error_code code;
    long line;         /* in `source`, 1-based; 0 = none */
    int column;        /* character in that line, 1-based; 0 = none */
    int caret;         /* byte of `text` where what is wrong begins, 1-based; 0 = none */
    char source[256];  /* file name; "" = the command line */
    char message[512]; /* lower case, one line, no full stop */
    char text[128];    /* the offending text, shown above the caret */
    char hint[240];    /* "did you mean '50mm'?" */
    struct mentions in_message, in_hint;
    const char *more; /* further lines, each with its end, or null; where the work's arena is */
};

/*
 * Record an error and return false, so that a function ends with `return fail(e, ...)`.
 *
 * Given     error   where to record; every field is overwritten
 *           code    what kind it is
 *           format  printf format of the message, quantities in braces: "{focal length}", or
 *                   "{%s}" for one that an argument names
 */
bool fail(struct error *error, enum error_code code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/*
 * The same, pointing at one character of a text that is shown with a caret under it. A long text
 * is cut to a window around the caret; control characters are shown as '?'.
 *
 * Given     text   the offending one
 *           caret  the byte where the wrong character begins, 1-based
 */
bool fail_at(struct error *error, enum error_code code, struct text text, size_t caret,
             const char *format, ...) __attribute__((format(printf, 5, 6)));

/*
 * The text that the caret stands under is part of a longer one: show that, and the caret where it
 * was. Returns false.
 *
 * Given     part  inside `whole`, as it was read, with or without blanks around it
 */
bool error_within(struct error *error, struct text whole, struct text part);

/* Say where in a file the error lies (line and column 1-based, 0 = unknown). Returns false. */
bool error_locate(struct error *error, const char *source, long line, size_t column);

/* ERROR_DATA, as fail and error_locate say it. */
#define fail_in(error, source, line, column, ...)                                                  \
    (fail((error), ERROR_DATA, __VA_ARGS__), error_locate((error), (source), (line), (column)))

/* The column is that of a byte: make it that of the character of the line. Returns false. */
bool error_count_characters(struct error *error, struct text line);

/* Add the line "did you mean '...'?" or any other advice. Returns false. */
bool error_hint(struct error *error, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Put words before the message, to say whose text was wrong. Returns false. */
bool error_prefix(struct error *error, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/*
 * Say by what its quantities were given.
 *
 * Given     name_of  what to call a quantity ("focal length", without an article), or null to leave
 *                    the words as they are. `asked`: no value stands behind it, so that the
 *                    message may ask for what was not given
 *           context  its first argument
 */
void error_name(struct error *error,
                const char *(*name_of)(void *context, struct text quantity, bool asked),
                void *context);

#endif
