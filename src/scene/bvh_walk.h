/* scene/bvh_walk.h - from leaf to leaf along a ray, the nearer ones first. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_SCENE_BVH_WALK_H
#define LENSCALC_SCENE_BVH_WALK_H

#include "scene/bvh.h"

/* A child that is still to be looked at, and the distance at which the ray enters it, mm. */
struct bvh_kept {
    double near;
    uint32_t child, count;
};

struct bvh_walk {
    const struct bvh_node *nodes;
    double from[3], over[3]; /* 1/way */
    int near[3];             /* the side that the ray passes first */
    size_t count;
    struct bvh_kept kept[BVH_KEPT];
};

/* Finite, so that no side of a box times it is 0 times infinity. */
static inline double bvh_over(double way)
{
    const double least = 1e-270;
    return 1 / (fabs(way) < least ? copysign(least, way) : way);
}

static inline void bvh_start(struct bvh_walk *walk, const struct bvh *tree, struct vector from,
                             struct vector way)
{
    walk->nodes = tree->nodes;
    walk->from[0] = from.x;
    walk->from[1] = from.y;
    walk->from[2] = from.z;
    walk->over[0] = bvh_over(way.x);
    walk->over[1] = bvh_over(way.y);
    walk->over[2] = bvh_over(way.z);
    for (int k = 0; k < 3; k++) {
        walk->near[k] = walk->over[k] < 0;
    }
    walk->count = tree->count > 0 ? 1 : 0;
    walk->kept[0] = (struct bvh_kept){0, 0, 0};
}

/* Where the ray enters and leaves each of a node's children, mm; it enters none before 0. */
struct bvh_spans {
    double in[BVH_WIDTH], out[BVH_WIDTH];
};

static inline void bvh_cross(const struct bvh_walk *walk, const struct bvh_node *node,
                             double farthest, struct bvh_spans *spans)
{
    const float *in_x = node->side[walk->near[0]][0], *out_x = node->side[!walk->near[0]][0];
    const float *in_y = node->side[walk->near[1]][1], *out_y = node->side[!walk->near[1]][1];
    const float *in_z = node->side[walk->near[2]][2], *out_z = node->side[!walk->near[2]][2];
    const double x = walk->from[0], y = walk->from[1], z = walk->from[2];
    const double over_x = walk->over[0], over_y = walk->over[1], over_z = walk->over[2];
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
static inline bool bvh_next(struct bvh_walk *walk, double farthest, struct bvh_kept *leaf)
{
    while (walk->count > 0) {
        const struct bvh_kept here = walk->kept[--walk->count];
        if (!(here.near < farthest)) {
            continue;
        }
        if (here.count > 0) {
            *leaf = here;
            return true;
        }
        const struct bvh_node *node = &walk->nodes[here.child];
        struct bvh_spans spans;
        bvh_cross(walk, node, farthest, &spans);
        const size_t begin = walk->count;
        for (int i = 0; i < BVH_WIDTH; i++) {
            if (spans.in[i] <= spans.out[i]) {
                size_t at = walk->count++;
                for (; at > begin && walk->kept[at - 1].near < spans.in[i]; at--) {
                    walk->kept[at] = walk->kept[at - 1];
                }
                walk->kept[at] = (struct bvh_kept){spans.in[i], node->child[i], node->count[i]};
            }
        }
    }
    return false;
}

#endif
