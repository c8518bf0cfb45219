/* design/tolerance/perturbation_place.h - where a tolerance is, and what may be wrong there. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_TOLERANCE_PERTURBATION_PLACE_H
#define LENSCALC_DESIGN_TOLERANCE_PERTURBATION_PLACE_H

#include "design/tolerance/perturbation.h"
#include "optics/element.h"

/* A lens that tolerances are laid upon. */
struct tolerance_site {
    const struct lens *all;  /* in all its positions */
    const struct lens *lens; /* in the first */
    const struct element *elements;
    size_t element_count;
    struct arena *arena;
};

/* One thing that a tolerance is of: a surface, or an element. */
struct tolerance_place {
    const struct lens_tolerance *from;
    enum tolerance_kind kind; /* THICKNESS only of glass */
    size_t first, last;
    size_t space; /* AIR: the first surface of its airspace, of which it is one gap; else `first` */
};

/*
 * Has the lens such a thing there?
 *
 * Result    null, or in words why not: ranges pass over it, one by itself is refused
 */
const char *tolerance_place_wrong(const struct tolerance_site *site,
                                  const struct tolerance_place *place);

/* What a thickness of the space behind a surface is of: TOLERANCE_THICKNESS or TOLERANCE_AIR. */
enum tolerance_kind tolerance_place_space(const struct tolerance_site *site, size_t surface);

/*
 * The airspace that the gap behind a surface is part of: a stop that does nothing else does not
 * divide it, and one spacer makes it.
 *
 * Given     place  of kind AIR; receives the airspace
 * Result    is this its widest gap, the first of two alike, to which an error of it is added?
 */
bool tolerance_place_find_airspace(const struct tolerance_site *site,
                                   struct tolerance_place *place);

/*
 * By how much the thing may be off.
 *
 * Given     place   nothing is wrong with it
 *           result  receives amount, what and pivot
 * Result    null, or in words why it cannot be
 */
const char *tolerance_place_amount(const struct tolerance_site *site,
                                   const struct tolerance_place *place,
                                   struct perturbation *result);

/* Its name: "R1", "element 3..5 tilt". */
const char *tolerance_place_name(const struct tolerance_site *site,
                                 const struct tolerance_place *place);

#endif
