/* scene/light_tree.c - light tree: one of many emitters, near and bright ones more often. */
/* SPDX-License-Identifier: MIT */
#include "scene/light_tree.h"

#include "scene/discrete.h"

/* -------- making it -------- */

struct emitter_item {
    struct emitter emitter;
    size_t given; /* its number */
    float at[3], radius;
    double power;
};

struct emitter_extent {
    float low[3], high[3];
};

/* About the middles, or about all of the emitters. */
static struct emitter_extent emitter_extent_of(const struct emitter_item *items, size_t count,
                                               bool whole)
{
    struct emitter_extent extent;
    for (int axis = 0; axis < 3; axis++) {
        extent.low[axis] = INFINITY;
        extent.high[axis] = -INFINITY;
    }
    for (size_t i = 0; i < count; i++) {
        const float radius = whole ? items[i].radius : 0;
        for (int axis = 0; axis < 3; axis++) {
            extent.low[axis] = fminf(extent.low[axis], items[i].at[axis] - radius);
            extent.high[axis] = fmaxf(extent.high[axis], items[i].at[axis] + radius);
        }
    }
    return extent;
}

/* Bring the `middle` items that are least along an axis before the others. [Hoare61] */
static void partition_at_median(struct emitter_item *items, size_t count, size_t middle, int axis)
{
    long low = 0, high = (long)count - 1;
    const long wanted = (long)middle;
    while (low < high) {
        const float pivot = items[low + (high - low) / 2].at[axis];
        long i = low, j = high;
        while (i <= j) {
            while (items[i].at[axis] < pivot) {
                i++;
            }
            while (pivot < items[j].at[axis]) {
                j--;
            }
            if (i <= j) {
                const struct emitter_item other = items[i];
                items[i++] = items[j];
                items[j--] = other;
            }
        }
        if (wanted > j && wanted < i) {
            return;
        }
        if (wanted <= j) {
            high = j;
        } else {
            low = i;
        }
    }
}

static size_t first_half(size_t count)
{
    return count / 2;
}

/* Behind a node are the nodes of its first half, one less than twice its emitters. */
static size_t second_node(size_t node, size_t count)
{
    return node + 2 * first_half(count);
}

/* A stretch of the items that has a node. */
struct tree_range {
    size_t begin, count, node;
};

enum { DEPTH_MOST = 64 }; /* halves of halves of any number */

void light_tree_open(const struct scene *scene, const struct emitter *emitters, const double *power,
                     size_t count, struct arena *arena, struct light_tree *tree)
{
    *tree = (struct light_tree){.count = count};
    if (count == 0) {
        return;
    }
    tree->emitters = ARENA_ARRAY(arena, count, struct emitter);
    tree->leaf_of = ARENA_ARRAY(arena, count, size_t);
    tree->nodes = ARENA_ARRAY(arena, 2 * count - 1, struct light_tree_node);
    struct arena spare = arena_within(arena);
    struct emitter_item *items = ARENA_ARRAY(&spare, count, struct emitter_item);
    for (size_t i = 0; i < count; i++) {
        const struct emitter_bounds bounds = emitter_bounds(scene, &emitters[i]);
        items[i] = (struct emitter_item){
            .emitter = emitters[i],
            .given = i,
            .at = {(float)bounds.middle.x, (float)bounds.middle.y, (float)bounds.middle.z},
            .radius = (float)bounds.radius,
            .power = power[i]};
    }
    struct tree_range open[DEPTH_MOST + 1] = {{0, count, 0}};
    size_t left = 1;
    while (left > 0) {
        const struct tree_range at = open[--left];
        struct emitter_item *own = items + at.begin;
        const struct emitter_extent extent = emitter_extent_of(own, at.count, true);
        struct light_tree_node node = {.power = 0};
        double square = 0;
        for (int axis = 0; axis < 3; axis++) {
            const double half = ((double)extent.high[axis] - (double)extent.low[axis]) / 2;
            node.at[axis] = (float)((double)extent.low[axis] + half);
            square += half * half;
        }
        node.radius = (float)sqrt(square);
        for (size_t i = 0; i < at.count; i++) {
            node.power += own[i].power;
        }
        tree->nodes[at.node] = node;
        if (at.count > 1) {
            const struct emitter_extent middles = emitter_extent_of(own, at.count, false);
            const size_t half = first_half(at.count);
            int axis = 0; /* the longest */
            for (int i = 1; i < 3; i++) {
                axis = middles.high[i] - middles.low[i] > middles.high[axis] - middles.low[axis]
                           ? i
                           : axis;
            }
            partition_at_median(own, at.count, half, axis);
            open[left++] = (struct tree_range){at.begin + half, at.count - half,
                                               second_node(at.node, at.count)};
            open[left++] = (struct tree_range){at.begin, half, at.node + 1};
        }
    }
    for (size_t i = 0; i < count; i++) {
        tree->emitters[i] = items[i].emitter;
        tree->leaf_of[items[i].given] = i;
    }
    arena_free(&spare);
}

/* -------- asking it -------- */

static double light_of(const struct light_tree_node *node, struct vector from)
{
    const double x = from.x - (double)node->at[0], y = from.y - (double)node->at[1];
    const double z = from.z - (double)node->at[2], radius = (double)node->radius;
    const double square = fmax(x * x + y * y + z * z, radius * radius / 2);
    /* on a point itself all of its light */
    return node->power > 0 ? node->power / fmax(square, 1e-200) : 0;
}

double light_tree_importance(const struct light_tree *tree, struct vector from)
{
    return tree->count > 0 ? light_of(&tree->nodes[0], from) : 0;
}

/* The share of the first half. */
static double first_share(const struct light_tree *tree, struct vector from, size_t node,
                          size_t count)
{
    const double first = light_of(&tree->nodes[node + 1], from);
    const double second = light_of(&tree->nodes[second_node(node, count)], from);
    const double share = first / (first + second);
    return share <= 1 ? share : 0; /* 0/0: nothing shines */
}

size_t light_tree_sample(const struct light_tree *tree, struct vector from, double *u,
                         double *chance)
{
    size_t node = 0, begin = 0, count = tree->count;
    *chance = tree->nodes[0].power > 0 ? 1 : 0;
    while (count > 1) {
        const size_t half = first_half(count);
        const double share = first_share(tree, from, node, count);
        if (*u < share) {
            *u = discrete_remainder(*u, 0, share);
            *chance *= share;
            node++;
            count = half;
        } else {
            *u = discrete_remainder(*u, share, 1);
            *chance *= 1 - share;
            node = second_node(node, count);
            begin += half;
            count -= half;
        }
    }
    return begin;
}

double light_tree_probability(const struct light_tree *tree, struct vector from, size_t emitter)
{
    const size_t leaf = tree->leaf_of[emitter];
    size_t node = 0, begin = 0, count = tree->count;
    double chance = tree->nodes[0].power > 0 ? 1 : 0;
    while (count > 1) {
        const size_t half = first_half(count);
        const double share = first_share(tree, from, node, count);
        if (leaf < begin + half) {
            chance *= share;
            node++;
            count = half;
        } else {
            chance *= 1 - share;
            node = second_node(node, count);
            begin += half;
            count -= half;
        }
    }
    return chance;
}
