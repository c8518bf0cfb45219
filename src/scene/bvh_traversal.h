/* scene/bvh_traversal.h - traversal of a bounding volume hierarchy, near leaves first. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_SCENE_BVH_TRAVERSAL_H
#define LENSCALC_SCENE_BVH_TRAVERSAL_H

#include "scene/bvh.h"

/* A child that is still to be looked at, and the distance at which the ray enters it, mm. */
struct bvh_pending {
    double near;
    uint32_t child, count;
};

struct bvh_traversal {
    const struct bvh_node *nodes;
    double origin[3], inverse[3]; /* 1/direction */
    int near[3];                  /* the side that the ray passes first */
    size_t count;
    struct bvh_pending pending[BVH_PENDING];
};

/* Finite, so that no side of a box times it is 0 times infinity. */
static inline double bvh_inverse(double direction)
{
    const double least = 1e-270;
    return 1 / (fabs(direction) < least ? copysign(least, direction) : direction);
}

static inline void bvh_traversal_start(struct bvh_traversal *walk, const struct bvh *tree,
                                       struct vector from, struct vector direction)
{
    walk->nodes = tree->nodes;
    walk->origin[0] = from.x;
    walk->origin[1] = from.y;
    walk->origin[2] = from.z;
    walk->inverse[0] = bvh_inverse(direction.x);
    walk->inverse[1] = bvh_inverse(direction.y);
    walk->inverse[2] = bvh_inverse(direction.z);
    for (int k = 0; k < 3; k++) {
        walk->near[k] = walk->inverse[k] < 0;
    }
    walk->count = tree->count > 0 ? 1 : 0;
    walk->pending[0] = (struct bvh_pending){0, 0, 0};
}

/* Where the ray enters and leaves each of a node's children, mm; it enters none before 0. */
struct bvh_spans {
    double in[BVH_WIDTH], out[BVH_WIDTH];
};

static inline void bvh_node_intersect(const struct bvh_traversal *walk, const struct bvh_node *node,
                                      double farthest, struct bvh_spans *spans)
{
    const float *in_x = node->side[walk->near[0]][0], *out_x = node->side[!walk->near[0]][0];
    const float *in_y = node->side[walk->near[1]][1], *out_y = node->side[!walk->near[1]][1];
    const float *in_z = node->side[walk->near[2]][2], *out_z = node->side[!walk->near[2]][2];
    const double x = walk->origin[0], y = walk->origin[1], z = walk->origin[2];
    const double over_x = walk->inverse[0], over_y = walk->inverse[1], over_z = walk->inverse[2];
    /* 3 units of rounding in each distance, and those of what is looked for within [Ize13] */
    const double room = 1 + 0x1p-48;
/* unrolled it would be no vectors: half as fast */
#pragma GCC unroll 1
    for (int i = 0; i < BVH_WIDTH; i++) {
        const double ax = ((double)in_x[i] - x) * over_x, bx = ((double)out_x[i] - x) * over_x;
        const double ay = ((double)in_y[i] - y) * over_y, by = ((double)out_y[i] - y) * over_y;
        const double az = ((double)in_z[i] - z) * over_z, bz = ((double)out_z[i] - z) * over_z;
        const double axy = ax > ay ? ax : ay, bxy = bx < by ? bx : by;
        const double in = axy > az ? axy : az, out = (bxy < bz ? bxy : bz) * room;
        spans->in[i] = in > 0 ? in : 0;
        spans->out[i] = out < farthest ? out : farthest;
    }
}

/*
 * The next leaf.
 *
 * Given     farthest  mm: what begins behind it is left out; it may have become less
 * Result    leaf      its first item and how many; false: there is none
 */
static inline bool bvh_traversal_next(struct bvh_traversal *walk, double farthest,
                                      struct bvh_pending *leaf)
{
    while (walk->count > 0) {
        const struct bvh_pending here = walk->pending[--walk->count];
        if (!(here.near < farthest)) {
            continue;
        }
        if (here.count > 0) {
            *leaf = here;
            return true;
        }
        const struct bvh_node *node = &walk->nodes[here.child];
        struct bvh_spans spans;
        bvh_node_intersect(walk, node, farthest, &spans);
        const size_t begin = walk->count;
        for (int i = 0; i < BVH_WIDTH; i++) {
            if (spans.in[i] <= spans.out[i]) {
                size_t at = walk->count++;
                for (; at > begin && walk->pending[at - 1].near < spans.in[i]; at--) {
                    walk->pending[at] = walk->pending[at - 1];
                }
                walk->pending[at] =
                    (struct bvh_pending){spans.in[i], node->child[i], node->count[i]};
            }
        }
    }
    return false;
}

#endif
