/* scene/light_tree.h - light tree: one of many emitters, near and bright ones more often. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_SCENE_LIGHT_TREE_H
#define LENSCALC_SCENE_LIGHT_TREE_H

#include "base/arena.h"
#include "scene/emitter.h"

#include <stdbool.h>
#include <stddef.h>

/* All emitters below it, as one point of their light. Chances only: single precision is enough. */
struct light_tree_node {
    float at[3];  /* middle of the box about them, mm */
    float radius; /* of that box, mm */
    double power; /* luminance times area, or intensity in the same unit, cd mm^2/m^2 */
};

/*
 * A node halves its emitters and has the first half behind it, all its nodes, and then the second.
 * Read-only afterwards.
 */
struct light_tree {
    size_t count;
    struct emitter *emitters; /* as the leaves have them */
    size_t *leaf_of;          /* of the emitters as they were given */
    struct light_tree_node *nodes;
};

/*
 * Given     emitters  copied; at the time 0, near which they stay: one that moves far is sampled by
 *                     where it was, which costs samples, not truth
 *           power     of each, 0 or more
 */
void light_tree_open(const struct scene *scene, const struct emitter *emitters, const double *power,
                     size_t count, struct arena *arena, struct light_tree *tree);

/* Light of all of them, roughly: luminance times solid angle, lx. */
double light_tree_importance(const struct light_tree *tree, struct vector from);

/*
 * Pick an emitter.
 *
 * Given     u       in 0..1; becomes what it says beyond the choice
 *           chance  receives that of the emitter, 0: none shines
 * Formula   at each node one half or the other by power/max(d^2, r^2/2)
 * Source    [Conty18], without bounds of directions
 * Result    its leaf
 */
size_t light_tree_sample(const struct light_tree *tree, struct vector from, double *u,
                         double *chance);

/* The chance of an emitter, by its number as it was given. */
double light_tree_probability(const struct light_tree *tree, struct vector from, size_t emitter);

#endif
