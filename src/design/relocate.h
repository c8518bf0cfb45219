/* design/relocate.h - out of minima of a search by elements that are put in elsewhere. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_RELOCATE_H
#define LENSCALC_DESIGN_RELOCATE_H

#include "design/optimize_global.h"

/*
 * From the best lenses of a search to others with as many elements: each element in turn is taken
 * out and put in elsewhere without power (design/null_element.h). With that one held the others
 * come to their minimum, which without it is one of a lens with an element less; then it is bent to
 * either side, and both descents are followed.
 *
 * Given     global  after its search
 *           most    so many lenses: each time the best that it has not been done with, those that
 *                   were found among them
 * Result    moved of the start that led to each; moved_evaluations
 */
void optimize_relocate(struct optimize_global *global, size_t most, struct arena *arena);

#endif
