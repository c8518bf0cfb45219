/* optics/element.h - the elements of a lens: what is mounted as one piece. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_OPTICS_ELEMENT_H
#define LENSCALC_OPTICS_ELEMENT_H

#include "base/arena.h"
#include "optics/lens.h"

#include <stddef.h>

/* Surfaces between air and air: a single lens, a cemented group, a mirror, a thick lens. */
struct element {
    size_t first, last; /* surfaces, from 0 */
};

/*
 * The elements of a lens, in their order.
 *
 * Given     lens  in one position, or in all: its media there are those of the first
 * Result    elements in the arena; returns how many. Stops and planes in air that bend no ray are
 *           none, and belong to none. The spaces before the first and behind the last surface
 *           count as air, whatever they are: an immersed front is no cement. Light that goes
 *           through glass twice, to a mirror behind it and back, passes one element
 */
size_t elements_of(const struct lens *lens, struct arena *arena, struct element **elements);

/* The element that a surface belongs to; null: to none. */
const struct element *element_at(const struct element *elements, size_t count, size_t surface);

#endif
