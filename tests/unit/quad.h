/* tests/unit/quad.h - rays in 113 bits, where the compiler has them. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_UNIT_QUAD_H
#define LENSCALC_TESTS_UNIT_QUAD_H

#if defined(__SIZEOF_FLOAT128__) || defined(__FLOAT128__)
__extension__ typedef __float128 real;
#else
typedef long double real;
#endif
#define REAL real
#include "trace/precise.h"

/* Where a ray crosses the stop, about the vertex and in the axes of that surface by itself. */
static inline bool quad_to_stop(const struct system *system, struct precise_ray ray, real place[2])
{
    for (size_t i = 0; i <= system->stop; i++) {
        if (!precise_surface(&ray, system, i)) {
            return false;
        }
    }
    const struct displacement *decentre = system->lens->surfaces[system->stop].decentre;
    if (decentre != NULL) {
        precise_move(&ray, decentre, 0);
    }
    place[0] = ray.x[0];
    place[1] = ray.x[1];
    return true;
}

#endif
