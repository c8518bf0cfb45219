/* file/lens_words.h - the words of a .lens file, and the numbers in them. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_LENS_WORDS_H
#define LENSCALC_FILE_LENS_WORDS_H

#include "base/arena.h"
#include "base/error.h"
#include "base/text.h"
#include "optics/lens.h"

#include <stdbool.h>
#include <stddef.h>

/* A .lens file while it is read, line by line. Texts point into the content. */
struct lens_words {
    const char *source;        /* for messages */
    struct text rest;          /* lines that are still to read */
    struct text line;          /* the present one, without its end and its comment */
    long number;               /* of that line, 1-based */
    const char *at;            /* where the next word of the line begins */
    struct number_scale scale; /* unit of a length in mm */
    const char *comment;       /* what begins a comment, where a word may begin; null = nothing */
    struct arena *arena;
};

/*
 * Begin to read.
 *
 * Errors    ERROR_DATA: NUL bytes or a mark of UTF-16
 */
bool lens_words_open(struct lens_words *words, const char *source, struct text content,
                     struct arena *arena, struct error *error);

/*
 * Control characters but tabs and line ends have no place in a prescription, and would reach the
 * terminal with its title: those of ASCII, and U+0080 to U+009F.
 *
 * Errors    ERROR_DATA with line and column
 */
bool lens_words_plain(const char *source, struct text content, struct error *error);

/*
 * Go to the next line that has words; false at the end. CRLF and comments are passed over; of
 * another program's file `comment` is set after lens_words_open.
 */
bool lens_words_line(struct lens_words *words);

/*
 * The next word of the line: up to a blank outside of {...} and "..."; its length is 0 at the end
 * of the line.
 */
struct text lens_words_next(struct lens_words *words);

/* All that is left of the line, trimmed. */
struct text lens_words_rest(struct lens_words *words);

/* Is the line at its end? Says what does not belong there. */
bool lens_words_end(struct lens_words *words, struct error *error);

/* Where a word of the line stands. */
struct typed_place lens_words_place(const struct lens_words *words, struct text word);

/* Report something wrong with a word of the line; `word` may lie behind its end. Returns false. */
bool lens_words_fail(const struct lens_words *words, struct text word, struct error *error,
                     const char *format, ...) __attribute__((format(printf, 4, 5)));

/*
 * A number as it is typed.
 *
 * Given     text   the whole number, a part of the present line
 *           scale  of its unit
 *           what   for messages: "radius"
 * Errors    ERROR_DATA with line and column: no finite number
 */
bool lens_words_figure(const struct lens_words *words, struct text text, struct number_scale scale,
                       const char *what, struct figure *figure, struct error *error);

/* The same of a number of the lens, in the unit that a file has it in: mm, 1/mm, rad result. */
bool lens_words_number(const struct lens_words *words, struct text text, enum parameter_kind kind,
                       int order, struct figure *figure, struct error *error);

/* The name of a number of a surface, as parameter_read has it, with its message at the name. */
bool lens_words_parameter(const struct lens_words *words, struct text name,
                          bool (*takes)(enum parameter_kind kind), struct parameter *parameter,
                          struct error *error);

/* A number of 1/length^power in 1/mm^power, of one in the unit of this scale. */
struct pair lens_words_per_length(struct pair value, struct number_scale scale, int power);

/* A list of figures up to the end of the line, in the arena. */
bool lens_words_figures(struct lens_words *words, struct number_scale scale, const char *what,
                        struct figure **figures, size_t *count, struct error *error);

/*
 * Points of the field up to the end of the line, in the arena: y, or x,y; with a weight y:w, x,y:w.
 *
 * Given     kind  of them: angles are degrees, other fields lengths
 * Errors    ERROR_DATA with line and column: no number, none at all, as lens_field_angle, a
 *           weight below 0
 */
bool lens_words_fields(struct lens_words *words, enum field_kind kind, struct lens_field **fields,
                       size_t *count, struct error *error);

/* Such points in one word, with ';' between them. */
bool lens_words_points(const struct lens_words *words, struct text list, enum field_kind kind,
                       struct lens_points *points, struct error *error);

/* A wavelength with its unit, or the name of a line, in um. */
bool lens_words_wavelength(const struct lens_words *words, struct text text, double *wavelength,
                           struct error *error);

/* The same with its weight, "F:0.5". */
bool lens_words_light(const struct lens_words *words, struct text word,
                      struct lens_wavelength *wavelength, struct error *error);

/*
 * What stands in the column of the medium: air, an index, nd/Vd, {...}, or the name of a glass.
 */
bool lens_words_medium(const struct lens_words *words, struct text text, struct medium *medium,
                       struct error *error);

/* Two or three numbers with commas between. */
struct vector_form {
    const char *what; /* "decentre" */
    size_t count;
    struct number_scale scale;
    double factor; /* 0 = 1 */
};

/* Read them; those not given stay 0. */
bool lens_words_vector(const struct lens_words *words, struct text text,
                       const struct vector_form *form, struct figure *figures, struct error *error);

#endif
