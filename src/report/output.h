/* report/output.h - buffered writing to standard output or to a file that appears whole. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_REPORT_OUTPUT_H
#define LENSCALC_REPORT_OUTPUT_H

#include "base/arena.h"
#include "base/error.h"
#include "base/text.h"

#include <stdbool.h>
#include <stddef.h>

/* Where results go. A failed write is remembered and reported by output_close. */
struct output {
    int descriptor;
    int failure;         /* errno of the first failed write, 0 = none */
    const char *path;    /* null = standard output */
    bool is_renamed;     /* to `path` when it is complete */
    bool is_nameless;    /* the file has no name before that */
    bool is_unused;      /* set by who has nothing to write: there will be no file */
    const char *beside;  /* its name before that, if it has one */
    struct arena *arena; /* of the names */
    char *buffer;
    size_t used, size;
    size_t width;                        /* of the terminal that shows it; 0 = it is none */
    bool has_color;                      /* output_style writes something */
    bool is_guarded;                     /* what a terminal would obey is '?', see terminal_guard */
    void (*before_write)(void *context); /* called before anything is handed over; or null */
    void *context;
    struct text remarks; /* lines for standard error when all went well */
    /* of output_inside: what was handed over */
    char *kept;
    size_t kept_length, kept_room;
};

/*
 * Open for writing. A file is written beside its final place and renamed when complete.
 *
 * Given     path    the file; null for standard output
 *           arena   owns buffer and names
 * Errors    ERROR_IO: the file cannot be made
 */
bool output_open(struct output *output, const char *path, struct arena *arena, struct error *error);

/* Write to what is open already: standard error. Ends with output_flush. */
void output_begin(struct output *output, int descriptor, struct arena *arena);

/* Keep what is written in memory: it goes nowhere. */
void output_inside(struct output *output, struct arena *arena);

/* What it has kept, in its arena. */
struct text output_kept(struct output *output);

/* Room for `length` characters (at most OUTPUT_RESERVE): write there, then output_advance. */
enum { OUTPUT_RESERVE = 4096 };
char *output_reserve(struct output *output, size_t length);
void output_advance(struct output *output, const char *end);

void output_text(struct output *output, const char *start, size_t length);
void output_string(struct output *output, const char *string);
void output_character(struct output *output, char c);

/* A text as HTML and XML have it: & < and > escaped; what XML cannot hold is shown as '?'. */
void output_escaped(struct output *output, struct text text);

/*
 * A text broken at blanks into lines of at most `width` characters; ends with a line feed.
 *
 * Given     at      characters that stand in its first line already
 *           indent  blanks before every other line
 */
void output_paragraph(struct output *output, const char *text, size_t at, size_t indent,
                      size_t width);

/* The same from the beginning of a line. */
void output_wrapped(struct output *output, const char *text, size_t width);
void output_spaces(struct output *output, size_t count);
void output_printf(struct output *output, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* How a stretch of text looks where there are colours. */
enum style { STYLE_PLAIN, STYLE_HEAD, STYLE_WARNING, STYLE_ERROR };

/* From here on; what ends it is STYLE_PLAIN. Nothing without colours. */
void output_style(struct output *output, enum style style);

/* A string in such a style. */
void output_styled(struct output *output, enum style style, const char *string);

/* Hand over what is buffered now, so that a reader of the pipe sees it. */
void output_flush(struct output *output);

/* Take away what has a name of a file that is not finished, while another thread writes to it. */
void output_abandon(const struct output *output);

/*
 * Have a file that is not complete appear beside the one it was to be: "x-incomplete.png" for
 * "x.png", which stays as it is, or is not there.
 *
 * Result    its name, in the arena; null: it is written to where it stands already
 */
const char *output_set_aside(struct output *output);

/*
 * Finish. With `keep` false, or after a failed write, a file is removed instead of renamed.
 *
 * Errors    ERROR_IO naming the file and the reason; ERROR_PIPE: standard output is a pipe that
 *           nobody reads any more
 */
bool output_close(struct output *output, bool keep, struct error *error);

#endif
