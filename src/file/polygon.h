/* file/polygon.h - polygons as triangles. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_POLYGON_H
#define LENSCALC_FILE_POLYGON_H

#include "base/arena.h"
#include "scene/vector.h"

#include <stddef.h>

enum { POLYGON_FAN_MOST = 8 };

enum polygon_cut {
    POLYGON_CONVEX, /* a fan about its first corner, or by halves */
    POLYGON_EARS,   /* concave */
    POLYGON_CROSSED /* it crosses itself, or has no area: there is no such cut */
};

/*
 * Cut a polygon along its diagonals. Slivers of a fan lie in each other's boxes, and rays ask them
 * all: a convex one of more than POLYGON_FAN_MOST corners is cut in the middle of its way round,
 * and so is each half.
 *
 * Given     corners    `count` >= 3 of them, either way round; a polygon with holes goes to each
 *                      hole and back along one line
 *           triangles  receives `count` - 2 numbers of corners, wound as the polygon is; a fan if
 *                      it is crossed. Corners that leave no other way make triangles without area
 * Formula   along the axis that is nearest to the normal, sum of p_i x p_(i+1), corners lie on a
 *           plane. Their turns make 2 pi together. Ears, corners that turn the polygon's way with
 *           no other corner in their triangle, are cut off in turn; only corners that do not turn
 *           so can be in it, and those near it are looked up in a grid
 * Source    [Meisters75]; the normal is M. Newell's
 * Limits    of what crosses itself only what has other turns, or no ear left, is found; of a
 *           polygon that is not plane, what its shadow on that plane does counts
 */
enum polygon_cut polygon_triangles(const struct vector *corners, size_t count,
                                   size_t (*triangles)[3], struct arena *arena);

#endif
