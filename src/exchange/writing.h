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
    struct foreign_job *job;
    struct arena *arena; /* the job's */
    const struct lens *lens;
    const char *unit;          /* of the file's lengths, as lens.unit has it */
    struct number_scale scale; /* of that unit, in mm */
    int shift; /* power of ten that takes a length from the lens's unit to the file's */
    struct text_buffer text;
};

/* Begin; a lens in metres is written in millimetres where the program has no metres. */
void writing_begin(struct lens_writer *writing, struct foreign_job *job, const struct lens *lens,
                   bool has_metres);

/* Write as printf does. */
#define writing_put(writing, ...) growing_format(&(writing)->text, __VA_ARGS__)

/*
 * The digits of a figure: those typed, or, of a computed number, as many as it needs.
 *
 * Given     power  of the length in it: 1 of a thickness, -1 of a curvature, 0 of a plain number
 */
const char *writing_length(const struct lens_writer *writing, const struct figure *figure,
                           int power);

/* The digits of half a length. */
const char *writing_half(const struct lens_writer *writing, const struct figure *figure);

/* The digits of an angle in degrees, and of one that turns the other way. */
const char *writing_degrees(const struct lens_writer *writing, const struct figure *figure);
const char *writing_turned(const struct lens_writer *writing, const struct figure *figure);

/* The digits of a wavelength, in nm (power 3) or um (power 0). */
const char *writing_wave(const struct lens_writer *writing, double micrometres, struct text typed,
                         int power);

/* The digits of a weight; `one` where it was not typed. */
const char *writing_weight(const struct lens_writer *writing, struct text typed, const char *one);

/* A text without the characters that would end it; `has_lost` tells that some had to go. */
const char *writing_quotable(const struct lens_writer *writing, const char *string, const char *bad,
                             bool *has_lost);

/* The loss of one of a surface's apertures: "surface 3: a circle that blocks: WHY". */
void writing_lose_aperture(const struct lens_writer *writing, const struct surface *surface,
                           const struct aperture *aperture, const char *why);

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
void writing_glass(const struct lens_writer *writing, const struct medium *medium,
                   struct text *name, struct text *catalog);

#endif
