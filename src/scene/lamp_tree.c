/* scene/lamp_tree.c - lamps in halves of halves. */
/* SPDX-License-Identifier: MIT */
#include "scene/lamp_tree.h"

#include "scene/pick.h"

/* -------- making it -------- */

struct item {
    struct lamp lamp;
    size_t given; /* its number */
    float at[3], radius;
    double power;
};

struct extent {
    float low[3], high[3];
};

/* About the middles, or about all of the lamps. */
static struct extent extent_of(const struct item *items, size_t count, bool whole)
{
    struct extent extent;
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

static int longest(const struct extent *extent)
{
    int axis = 0;
    for (int i = 1; i < 3; i++) {
        axis = extent->high[i] - extent->low[i] > extent->high[axis] - extent->low[axis] ? i : axis;
    }
    return axis;
}

/* Bring the `middle` items that are least along an axis before the others. [Hoare61] */
static void halve(struct item *items, size_t count, size_t middle, int axis)
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
                const struct item other = items[i];
                items[i++] = items[j];
                items[j--] = other;
            }
        }
        if (wanted > j && wanted < i) {
            return;
        }
        *(wanted <= j ? &high : &low) = wanted <= j ? j : i;
    }
}

static size_t first_half(size_t count)
{
    return count / 2;
}

/* Behind a node are the nodes of its first half, one less than twice its lamps. */
static size_t second_node(size_t node, size_t count)
{
    return node + 2 * first_half(count);
}

static struct lamp_node node_of(const struct item *items, size_t count)
{
    const struct extent extent = extent_of(items, count, true);
    struct lamp_node node = {.power = 0};
    double square = 0;
    for (int axis = 0; axis < 3; axis++) {
        const double half = ((double)extent.high[axis] - (double)extent.low[axis]) / 2;
        node.at[axis] = (float)((double)extent.low[axis] + half);
        square += half * half;
    }
    node.radius = (float)sqrt(square);
    for (size_t i = 0; i < count; i++) {
        node.power += items[i].power;
    }
    return node;
}

/* A stretch of the items that has a node. */
struct stretch {
    size_t begin, count, node;
};

enum { DEPTH_MOST = 64 }; /* halves of halves of any number */

static void build(struct item *items, size_t count, struct lamp_node *nodes)
{
    struct stretch open[DEPTH_MOST + 1] = {{0, count, 0}};
    size_t left = 1;
    while (left > 0) {
        const struct stretch at = open[--left];
        struct item *own = items + at.begin;
        nodes[at.node] = node_of(own, at.count);
        if (at.count > 1) {
            const struct extent middles = extent_of(own, at.count, false);
            const size_t half = first_half(at.count);
            halve(own, at.count, half, longest(&middles));
            open[left++] =
                (struct stretch){at.begin + half, at.count - half, second_node(at.node, at.count)};
            open[left++] = (struct stretch){at.begin, half, at.node + 1};
        }
    }
}

static struct item item_of(const struct scene *scene, const struct lamp *lamp, size_t given,
                           double power)
{
    const struct lamp_bounds bounds = lamp_bounds(scene, lamp);
    return (struct item){
        .lamp = *lamp,
        .given = given,
        .at = {(float)bounds.middle.x, (float)bounds.middle.y, (float)bounds.middle.z},
        .radius = (float)bounds.radius,
        .power = power};
}

void lamp_tree_open(const struct scene *scene, const struct lamp *lamps, const double *power,
                    size_t count, struct arena *arena, struct lamp_tree *tree)
{
    *tree = (struct lamp_tree){.count = count};
    if (count == 0) {
        return;
    }
    tree->lamps = ARENA_ARRAY(arena, count, struct lamp);
    tree->leaf_of = ARENA_ARRAY(arena, count, size_t);
    tree->nodes = ARENA_ARRAY(arena, 2 * count - 1, struct lamp_node);
    struct arena spare = arena_within(arena);
    struct item *items = ARENA_ARRAY(&spare, count, struct item);
    for (size_t i = 0; i < count; i++) {
        items[i] = item_of(scene, &lamps[i], i, power[i]);
    }
    build(items, count, tree->nodes);
    for (size_t i = 0; i < count; i++) {
        tree->lamps[i] = items[i].lamp;
        tree->leaf_of[items[i].given] = i;
    }
    arena_free(&spare);
}

/* -------- asking it -------- */

static double light_of(const struct lamp_node *node, struct vector from)
{
    const double x = from.x - (double)node->at[0], y = from.y - (double)node->at[1];
    const double z = from.z - (double)node->at[2], radius = (double)node->radius;
    const double square = fmax(x * x + y * y + z * z, radius * radius / 2);
    /* on a point itself all of its light */
    return node->power > 0 ? node->power / fmax(square, 1e-200) : 0;
}

double lamp_tree_light(const struct lamp_tree *tree, struct vector from)
{
    return tree->count > 0 ? light_of(&tree->nodes[0], from) : 0;
}

/* The share of the first half. */
static double first_share(const struct lamp_tree *tree, struct vector from, size_t node,
                          size_t count)
{
    const double first = light_of(&tree->nodes[node + 1], from);
    const double second = light_of(&tree->nodes[second_node(node, count)], from);
    const double share = first / (first + second);
    return share <= 1 ? share : 0; /* 0/0: nothing shines */
}

size_t lamp_tree_pick(const struct lamp_tree *tree, struct vector from, double *u, double *chance)
{
    size_t node = 0, begin = 0, count = tree->count;
    *chance = tree->nodes[0].power > 0 ? 1 : 0;
    while (count > 1) {
        const size_t half = first_half(count);
        const double share = first_share(tree, from, node, count);
        if (*u < share) {
            *u = pick_rest(*u, 0, share);
            *chance *= share;
            node++;
            count = half;
        } else {
            *u = pick_rest(*u, share, 1);
            *chance *= 1 - share;
            node = second_node(node, count);
            begin += half;
            count -= half;
        }
    }
    return begin;
}

double lamp_tree_chance(const struct lamp_tree *tree, struct vector from, size_t lamp)
{
    const size_t leaf = tree->leaf_of[lamp];
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
