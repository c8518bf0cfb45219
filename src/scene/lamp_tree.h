/* scene/lamp_tree.h - many lamps: one of them by chance, near and bright ones more often. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_SCENE_LAMP_TREE_H
#define LENSCALC_SCENE_LAMP_TREE_H

#include "base/arena.h"
#include "scene/lamp.h"

#include <stdbool.h>
#include <stddef.h>

/* All lamps below it, as one point of their light. Chances only: single precision is enough. */
struct lamp_node {
    float at[3];  /* middle of the box about them, mm */
    float radius; /* of that box, mm */
    double power; /* luminance times area, or intensity in the same unit, cd mm^2/m^2 */
};

/*
 * A node halves its lamps and has the first half behind it, all its nodes, and then the second.
 * Read-only afterwards.
 */
struct lamp_tree {
    size_t count;
    struct lamp *lamps; /* as the leaves have them */
    size_t *leaf_of;    /* of the lamps as they were given */
    struct lamp_node *nodes;
};

/*
 * Given     lamps  copied; at the time 0, near which they stay: a lamp that moves far is picked by
 *                  where it was, which costs samples, not truth
 *           power  of each, 0 or more
 */
void lamp_tree_open(const struct scene *scene, const struct lamp *lamps, const double *power,
                    size_t count, struct arena *arena, struct lamp_tree *tree);

/* Light of all of them, roughly: luminance times solid angle, lx. */
double lamp_tree_light(const struct lamp_tree *tree, struct vector from);

/*
 * Pick a lamp.
 *
 * Given     u       in 0..1; becomes what it says beyond the choice
 *           chance  receives that of the lamp, 0: none shines
 * Formula   at each node one half or the other by power/max(d^2, r^2/2)
 * Source    [Conty18], without bounds of directions
 * Result    its leaf
 */
size_t lamp_tree_pick(const struct lamp_tree *tree, struct vector from, double *u, double *chance);

/* The chance of a lamp, by its number as it was given. */
double lamp_tree_chance(const struct lamp_tree *tree, struct vector from, size_t lamp);

#endif
