/* file/lens_change.h - a lens scaled, turned around, in another unit; its digits follow. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_LENS_CHANGE_H
#define LENSCALC_FILE_LENS_CHANGE_H

#include "base/arena.h"
#include "base/error.h"
#include "optics/lens.h"

/*
 * All lengths times a factor, the stated ones too; angles, indices and f-numbers stay.
 *
 * Given     factor   above 0
 *           rounded  digits of doubles instead of all digits: for a factor that is no short decimal
 * Result    bounds, what pick-ups add, and tolerances are scaled too, fringes as the lengths of sag
 *           that they are; goals are left out: they are of the lens as it was
 * Formula   R, t, diameters, heights k; curvatures 1/k; A2i: k^(1 - 2i)
 * Limits    products of decimals are exact to 31 digits
 */
const struct lens *lens_scaled(const struct lens *lens, struct pair factor, bool rounded,
                               struct arena *arena);

/* The same lens written in another unit: "mm", "cm", "m" or "in". */
const struct lens *lens_in_unit(const struct lens *lens, const char *unit, struct arena *arena);

/*
 * The lens in one of its positions only: without variables, and what is stated of that position.
 * The mark of a number of a word is then one of its first cell, and others follow it by pick-ups.
 */
const struct lens *lens_one_position(const struct lens *lens, size_t position, struct arena *arena);

/*
 * The lens turned around by half a turn about y: light enters where it left.
 *
 * Result    object and image change places where both are at a finite distance; else the lens
 *           looks at infinity again, with the image at the paraxial focus. An aperture given as
 *           f-number, entrance pupil or NA becomes the diameter that the stop has with it. Marks
 *           of thicknesses and glasses go to the surface that they lie behind now; those behind
 *           the last are left out, and so are pick-ups between numbers of which one has no place,
 *           tolerances behind the last surface, and goals: lens_marks_left_out names all but goals
 * Formula   an even number of mirrors: R -> -R, A -> -A, t as it is; an odd one: R and A as they
 *           are, t -> -t; the signs are in optics/parameter. A coordinate break is undone in
 *           the order z, y, x, shift, each on a plane of its own
 * Source    derived here: the property tests turn lenses twice
 * Errors    ERROR_DOMAIN: an aperture that is not at the stop and no stop; distances of the object
 *           or apertures that change between positions; variable distances beside an odd number of
 *           mirrors
 */
const char *lens_marks_left_out(const struct lens *lens, struct arena *arena); /* null: none */
const struct lens *lens_reversed(const struct lens *lens, struct arena *arena, struct error *error);

#endif
