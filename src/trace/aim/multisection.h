/* trace/aim/multisection.h - where to look for a root with several rays at a time. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_AIM_MULTISECTION_H
#define LENSCALC_TRACE_AIM_MULTISECTION_H

#include <stddef.h>

/* What a function is at one place; a value that is not known, or none, is not finite. */
struct multisection_point {
    double at, value;
};

/*
 * Places between two neighbours with a root between them, to be tried next.
 *
 * Given     points, count  ascending
 *           between        the root lies between points[between - 1] and points[between]
 *           wanted         how many places, an even number up to 62
 *           places         receives them, ascending; near rounding some may be equal to each other
 *                          or to the neighbours
 * Formula   about an estimate of the root, by halves, a thousandth .. 2^-40 of the way to either
 *           neighbour: the better the estimate, the smaller the part that holds the root. The
 *           estimate is the polynomial of the place by the value through two points on either side;
 *           the secant where that leaves the bracket. Equal parts where a neighbour's value is not
 *           finite or both have one sign, and where the neighbours are nearly at rounding: 1e-14
 * Limits    in the worst case a turn leaves half of the bracket
 */
void multisection_places(const struct multisection_point *points, size_t count, size_t between,
                         size_t wanted, double *places);

#endif
