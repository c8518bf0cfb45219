/* file/lens_words.h - the numbers of a .lens file, its fields, wavelengths and media. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_LENS_WORDS_H
#define LENSCALC_FILE_LENS_WORDS_H

#include "file/file_words.h"
#include "optics/lens.h"

#include <stdbool.h>
#include <stddef.h>

/*
 * A number as it is typed.
 *
 * Given     text   the whole number, a part of the present line
 *           scale  of its unit
 *           what   for messages: "radius"
 * Errors    ERROR_DATA with line and column: no finite number
 */
bool lens_words_figure(const struct file_words *words, struct text text, struct number_scale scale,
                       const char *what, struct figure *figure);

/* The same of a number of the lens, in the unit that a file has it in: mm, 1/mm, rad result. */
bool lens_words_number(const struct file_words *words, struct text text, enum parameter_kind kind,
                       int order, struct figure *figure);

/* The name of a number of a surface, as parameter_read has it, with its message at the name. */
bool lens_words_parameter(const struct file_words *words, struct text name,
                          bool (*takes)(enum parameter_kind kind), struct parameter *parameter);

/* A number of 1/length^power in 1/mm^power, of one in the unit of this scale. */
struct pair lens_words_per_length(struct pair value, struct number_scale scale, int power);

/* A list of figures up to the end of the line, in the arena. */
bool lens_words_figures(struct file_words *words, struct number_scale scale, const char *what,
                        struct figure **figures, size_t *count);

/*
 * Points of the field up to the end of the line, in the arena: y, or x,y; with a weight y:w, x,y:w.
 *
 * Given     kind  of them: angles are degrees, other fields lengths
 * Errors    ERROR_DATA with line and column: no number, none at all, as lens_field_angle, a
 *           weight below 0
 */
bool lens_words_fields(struct file_words *words, enum field_kind kind, struct lens_field **fields,
                       size_t *count);

/* Such points in one word, with ';' between them. */
bool lens_words_points(const struct file_words *words, struct text list, enum field_kind kind,
                       struct lens_points *points);

/* A wavelength with its unit, or the name of a line, in um. */
bool lens_words_wavelength(const struct file_words *words, struct text text, double *wavelength);

/* The same with its weight, "F:0.5". */
bool lens_words_light(const struct file_words *words, struct text word,
                      struct lens_wavelength *wavelength);

/*
 * What stands in the column of the medium: air, an index, nd/Vd, {...}, or the name of a glass.
 */
bool lens_words_medium(const struct file_words *words, struct text text, struct medium *medium);

/* Two or three numbers with commas between. */
struct vector_form {
    const char *what; /* "decentre" */
    size_t count;
    struct number_scale scale;
    double factor; /* 0 = 1 */
};

/* Read them; those not given stay 0. */
bool lens_words_vector(const struct file_words *words, struct text text,
                       const struct vector_form *form, struct figure *figures);

#endif
