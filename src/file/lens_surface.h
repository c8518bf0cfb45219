/* file/lens_surface.h - one surface line of a .lens file. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_LENS_SURFACE_H
#define LENSCALC_FILE_LENS_SURFACE_H

#include "file/file_words.h"
#include "optics/aperture.h"
#include "optics/growing.h"
#include "optics/lens.h"

/* A thick lens without a hiatus is written so. */
#define LENS_THIN_WORD "thin"

/* The variables of a lens being read, and where each was first used. */
struct lens_variables {
    struct lens *lens;
    struct file_words *lines;
    size_t room;
};

/* The index of the variable of this name, made if there is none. */
size_t lens_variable_find(struct lens_variables *variables, const struct file_words *words,
                          struct text name);

/*
 * Read what follows the word `surface`, `stop`, `thick` or `thin`.
 *
 * Given     kind    SURFACE_REFRACT for `surface`, SURFACE_STOP, SURFACE_THICK for both others.
 *                   Behind the focal length of those everything may be missing: then the medium is
 *                   the one before
 *           before  the medium before the surface; what a mirror leaves it in
 */
bool lens_surface_read(struct file_words *words, enum surface_kind kind,
                       const struct medium *before, struct lens_variables *variables,
                       struct surface *surface);

/* Read what follows `bend`, a coordinate break. */
bool lens_coordinate_break_read(struct file_words *words,
                                const struct displacement **coordinate_break);

/*
 * Read what follows `pass` or `block`: SHAPE SIZES decenter=x,y turn=a.
 *
 * Given     surface  the one above it, which has one aperture more then; null: there is none
 *           room     of its list, 0 before the first
 * Errors    ERROR_DATA with line and column
 */
bool lens_aperture_read(struct file_words *words, bool blocks, struct surface *surface,
                        size_t *room);

/* The line of an aperture, with its end; lengths in the unit of the lens. */
void lens_aperture_write(const struct aperture *aperture, struct number_scale unit,
                         struct text_buffer *text);

#endif
