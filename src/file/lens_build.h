/* file/lens_build.h - put a lens together while another program's file is read. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_LENS_BUILD_H
#define LENSCALC_FILE_LENS_BUILD_H

#include "base/arena.h"
#include "optics/lens.h"

/* A lens that grows; arrays live in the arena. */
struct lens_build {
    struct lens *lens;
    struct arena *arena;
    size_t surface_room, variable_room, note_room, wavelength_room, field_room;
};

/* Begin with nothing: mm, object at infinity in air, paraxial focus. */
void lens_build_begin(struct lens_build *build, struct lens *lens, struct arena *arena);

/*
 * One surface more: a refracting plane with thickness 0, air behind it and no diameter.
 *
 * Result    the surface; valid until the next one is added
 */
struct surface *lens_build_surface(struct lens_build *build);

/* A surface that is the stop: a plane of its own if it neither bends nor turns light. */
void lens_build_stop(struct lens_build *build, size_t surface);

/*
 * A title, note or name as a .lens file can hold it: control characters become blanks, and '#'
 * where a word begins, which would begin a comment, becomes "No."
 */
const char *lens_build_string(struct lens_build *build, struct text text);

/* One more of each; the note is copied, a wavelength has the name of its line if it is one. */
void lens_build_note(struct lens_build *build, struct text note);
struct lens_wavelength *lens_build_wavelength(struct lens_build *build, double micrometres,
                                              double weight);
struct lens_field *lens_build_field(struct lens_build *build);

/*
 * A number that stands for a cell in every position.
 *
 * Given     name    copied; values  one a position, in the arena
 * Result    its index, for figure.variable
 */
size_t lens_build_variable(struct lens_build *build, const char *name, const struct figure *values);

/*
 * A figure of a computed number, with digits that read back to the same pair.
 *
 * Given     value  in the program's own unit (mm, rad, 1/mm)
 *           unit   of the file, in the same: the digits are those of value/unit. What they say is
 *                  what the figure's value becomes, so that writing and reading change nothing
 */
struct figure figure_computed(struct pair value, struct number_scale unit, struct arena *arena);

/* The same rounded to a double of the unit: the shortest digits; for what rays decide. */
struct figure figure_rounded(struct pair value, struct number_scale unit, struct arena *arena);

/* Half a unit of the last digit typed, in the value's unit; 0 of a computed figure. */
double figure_rounding(const struct figure *figure);

/* "0" */
struct figure figure_zero(void);

/* A figure with the other sign, digits and value; 0 and a variable stay. */
struct figure figure_negate(struct figure figure, struct arena *arena);

/* The same of a double: the shortest digits that read back to it. */
struct figure figure_of(double value, struct arena *arena);

/* The same digits as a number of another dimension: the unit ("mm", "in" ..) to a power. */
struct figure figure_per_length(struct figure figure, const char *unit, int power);

/*
 * The radius whose reciprocal a curvature is.
 *
 * Given     curvature  typed digits and value, 1/mm, of a program that stores 1/R as a double
 *           unit       of the lens
 *           radius     receives it with its digits
 * Result    true where an R of at most 12 digits has this reciprocal: of a curvature with 15 to 24
 *           digits computed in doubles, as it was rounded; else to 28 digits (then, of a curvature
 *           with 25 digits or more, an R of at most 20 digits)
 */
bool figure_radius_of(const struct figure *curvature, const char *unit, struct arena *arena,
                      struct figure *radius);

#endif
