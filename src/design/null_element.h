/* design/null_element.h - elements of a lens taken out, and put in elsewhere without power. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_NULL_ELEMENT_H
#define LENSCALC_DESIGN_NULL_ELEMENT_H

#include "design/variable.h"

/* An element in air, both of whose curvatures vary: which variables are its numbers; LENS_NONE of
   those that do not vary. */
struct null_slot {
    size_t surface;              /* its first */
    size_t curvature[2], center; /* of front and rear; its thickness */
    size_t gap;                  /* behind it */
    size_t glass[2];             /* nd, and Vd or the share of the glass map; both or none vary */
};

struct null_elements {
    const struct variables *variables;
    const struct null_slot *slots;
    size_t count;
    const struct null_move *moves;
    size_t move_count;
};

/* An element that is taken out, and where one without power is put in. */
struct null_move {
    size_t taken;     /* slot that it leaves */
    size_t put;       /* slot that it is in afterwards, those between moved on by one */
    size_t neighbour; /* slot, afterwards, whose surface and glass it takes */
    bool is_behind;   /* of the neighbour; else in front */
};

/*
 * What can be moved.
 *
 * Result    moves; elements that change places must have glasses that vary, or one glass. The stop
 *           stays where it is, behind as many elements
 */
void null_elements_open(const struct variables *variables, struct arena *arena,
                        struct null_elements *elements);

/*
 * Do it.
 *
 * Given     from     numbers of the variables
 * Result    to       those of a lens whose element `put` is a thin meniscus with its neighbour's
 *                    curvature on both sides, at the smallest distance; within bounds
 *           is_null  of each variable: it is one of that element
 */
void null_elements_move(const struct null_elements *elements, const struct null_move *move,
                        const double *from, double *to, bool *is_null);

/*
 * The meniscus again, after the others have moved, bent by so much on its outer side: in contact
 * with its neighbour it makes a saddle point of a minimum, which both signs lead down from.
 *
 * Given     bend     of the curvature, in natural scales
 *           numbers  changed
 * Source    [Bociort09]
 */
void null_elements_bend(const struct null_elements *elements, const struct null_move *move,
                        double bend, double *numbers);

#endif
