/* scene/bvh.h - bounding volume hierarchy: boxes in boxes, a ray tests what it passes. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_SCENE_BVH_H
#define LENSCALC_SCENE_BVH_H

#include "base/arena.h"
#include "scene/vector.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/*
 * A node has so many children; no tree is deeper than BVH_DEPTH nodes, whatever is in it: below
 * BVH_UNEVEN of them its parts are halved by number. A walk keeps all but one child of each.
 */
enum { BVH_WIDTH = 4, BVH_UNEVEN = 48, BVH_DEPTH = BVH_UNEVEN + 32 };
enum { BVH_PENDING = BVH_DEPTH * (BVH_WIDTH - 1) + 1 };

/* Coordinates are smaller than that, mm. */
#define BVH_REACH 1e32

struct bvh_box {
    float low[3], high[3];
};

struct bvh_node {
    float side[2][3][BVH_WIDTH]; /* lower, upper; x, y, z; of each child. None: from inf to -inf */
    uint32_t child[BVH_WIDTH];   /* a node, or the first item of a leaf */
    uint32_t count[BVH_WIDTH];   /* items of a leaf; 0: it is a node */
};

/* Read-only afterwards. */
struct bvh {
    const struct bvh_node *nodes; /* the first is the root; none in an empty tree */
    size_t node_count;
    const uint32_t *items; /* leaf by leaf, by their numbers in what it was made of */
    size_t count;
};

/*
 * The box from low to high in floats, with room for the rounding errors of who looks within.
 *
 * Given     room  mm, to each side
 */
struct bvh_box bvh_box_of(struct vector low, struct vector high, double room);

/*
 * Make the tree.
 *
 * Given     boxes  of the items, within BVH_REACH; at most 2^32 - 1 of them
 *           most   items in a leaf
 * Formula   surface area heuristic in 16 bins along each axis [Wald07]; of a node's parts the one
 *           with the largest surface is divided next, until it has four
 */
void bvh_open(const struct bvh_box *boxes, size_t count, size_t most, struct arena *arena,
              struct bvh *tree);

#endif
