/* exchange/writing.h - the digits and names of a lens as CODE V and OSLO files have them. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_WRITING_H
#define LENSCALC_EXCHANGE_WRITING_H

#include "base/arena.h"
#include "base/text.h"
#include "exchange/foreign.h"
#include "optics/growing.h"
#include "optics/lens.h"

#include <stdbool.h>
#include <stddef.h>

/* A file being written. */
struct lens_writer {
    struct arena *arena;
    const struct lens *lens;
    const char *unit;          /* of the file's lengths, as lens.unit has it */
    struct number_scale scale; /* of that unit, in mm */
    int shift; /* power of ten that takes a length from the lens's unit to the file's */
    struct text_buffer text;
};

/* Begin; a lens in metres is written in millimetres where the program has no metres. */
void writing_begin(struct lens_writer *writing, const struct lens *lens, bool has_metres,
                   struct arena *arena);

/*
 * The digits of a figure: those typed, or, of a computed number, as many as it needs.
 *
 * Given     power  of the length in it: 1 of a thickness, -1 of a curvature, 0 of a plain number
 */
struct text writing_length(const struct lens_writer *writing, const struct figure *figure,
                           int power);

/* The digits of an angle, in degrees. */
struct text writing_degrees(const struct lens_writer *writing, const struct figure *figure);

/* The digits of a wavelength, in nm (power 3) or um (power 0). */
struct text writing_wave(const struct lens_writer *writing, double micrometres, struct text typed,
                         int power);

/* A text without the characters that would end it; `has_lost` tells that some had to go. */
struct text writing_quotable(const struct lens_writer *writing, const char *string, const char *bad,
                             bool *has_lost);

/*
 * The diameter of the entrance pupil in one position, with digits in the file's unit.
 *
 * Result    false where it has none, or an infinite one: then *pupil is unchanged
 */
bool writing_pupil(const struct lens_writer *writing, size_t position, struct figure *pupil);

/*
 * The name of a glass in the file's own spelling, and its catalogue (empty if it is not known).
 *
 * Given     medium  of a glass
 * Result    without '-', '_' and blanks, where no other glass of the catalogue has that name
 */
void writing_glass(const struct lens_writer *writing, const struct foreign_job *job,
                   const struct medium *medium, struct text *name, struct text *catalog);

#endif
