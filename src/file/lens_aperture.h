/* file/lens_aperture.h - a line with an aperture of a .lens file, read and written. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_LENS_APERTURE_H
#define LENSCALC_FILE_LENS_APERTURE_H

#include "file/file_words.h"
#include "optics/aperture.h"
#include "optics/growing.h"

/*
 * Read what follows `pass` or `block`: SHAPE SIZES decenter=x,y turn=a.
 *
 * Given     surface  the one above it, which has one aperture more then; null: there is none
 *           room     of its list, 0 before the first
 * Errors    ERROR_DATA with line and column
 */
bool lens_aperture_read(struct file_words *words, bool blocks, struct surface *surface,
                        size_t *room, struct error *error);

/* The line of an aperture, with its end; lengths in the unit of the lens. */
void lens_aperture_write(const struct aperture *aperture, struct number_scale unit,
                         struct text_buffer *text);

#endif
