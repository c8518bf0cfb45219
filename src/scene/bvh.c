/* scene/bvh.c - bounding volume hierarchy: boxes in boxes, a ray tests what it passes. */
/* SPDX-License-Identifier: MIT */
#include "scene/bvh.h"

#include <float.h>
#include <string.h>

enum { AXES = 3, BINS = 16 };

/* What is sorted: a box and whose it is. */
struct bvh_item {
    struct bvh_box box;
    uint32_t which;
};

/* Items that lie together, and what becomes of them. */
struct bvh_range {
    size_t first, count;
    struct bvh_box box;
    int depth;
    uint32_t parent, place; /* the node whose child it is; the root has no parent */
};

struct bin {
    struct bvh_box box;
    size_t count;
};

/* Where a range is cut: between bins `before` - 1 and `before` of an axis. */
struct bvh_cut {
    int axis, before; /* 0: nowhere */
    double cost;
    double low, scale; /* of the bins, in sums of an item's two sides */
};

struct builder {
    struct bvh_item *items;
    size_t most;
    struct bvh_node *nodes;
    size_t node_count;
};

static const struct bvh_box nothing = {{INFINITY, INFINITY, INFINITY},
                                       {-INFINITY, -INFINITY, -INFINITY}};

struct bvh_box bvh_box_of(struct vector low, struct vector high, double room)
{
    const double from[] = {low.x, low.y, low.z}, to[] = {high.x, high.y, high.z};
    struct bvh_box box;
    for (int k = 0; k < AXES; k++) {
        const float least = (float)(from[k] - room), largest = (float)(to[k] + room);
        /* rounded to the nearest they may be half a unit inside */
        box.low[k] = least - (fabsf(least) * FLT_EPSILON + FLT_MIN);
        box.high[k] = largest + (fabsf(largest) * FLT_EPSILON + FLT_MIN);
    }
    return box;
}

static void box_grow(struct bvh_box *box, const struct bvh_box *by)
{
    for (int k = 0; k < AXES; k++) {
        box->low[k] = by->low[k] < box->low[k] ? by->low[k] : box->low[k];
        box->high[k] = by->high[k] > box->high[k] ? by->high[k] : box->high[k];
    }
}

/* Half the surface of a box; of none 0. */
static double box_half_surface(const struct bvh_box *box)
{
    const double x = (double)box->high[0] - (double)box->low[0];
    const double y = (double)box->high[1] - (double)box->low[1];
    const double z = (double)box->high[2] - (double)box->low[2];
    return x >= 0 ? x * y + y * z + z * x : 0;
}

/* -------- one cut -------- */

/* Twice its middle along an axis. */
static double item_middle(const struct bvh_item *item, int axis)
{
    return (double)item->box.low[axis] + (double)item->box.high[axis];
}

static int bin_of(const struct bvh_cut *cut, double middle)
{
    const int bin = (int)((middle - cut->low) * cut->scale);
    return bin < BINS ? bin : BINS - 1;
}

/* The cheapest cut between bins of one axis, if it is cheaper than that found so far. */
static void cut_choose(const struct bin *bins, const struct bvh_cut *along, struct bvh_cut *best)
{
    double behind[BINS];
    size_t count = 0;
    struct bvh_box box = nothing;
    for (int k = BINS - 1; k > 0; k--) {
        box_grow(&box, &bins[k].box);
        count += bins[k].count;
        behind[k] = count > 0 ? box_half_surface(&box) * (double)count : INFINITY;
    }
    box = nothing;
    count = 0;
    for (int k = 1; k < BINS; k++) {
        box_grow(&box, &bins[k - 1].box);
        count += bins[k - 1].count;
        const double cost = box_half_surface(&box) * (double)count + behind[k];
        if (count > 0 && cost < best->cost) {
            *best = *along;
            best->before = k;
            best->cost = cost;
        }
    }
}

static struct bvh_box box_around(const struct bvh_item *items, size_t count)
{
    struct bvh_box box = nothing;
    for (size_t i = 0; i < count; i++) {
        box_grow(&box, &items[i].box);
    }
    return box;
}

/* Those of the cut's lower bins to the front: how many they are. */
static size_t part_items(struct bvh_item *items, size_t count, const struct bvh_cut *cut)
{
    size_t first = 0, end = count;
    while (first < end) {
        if (bin_of(cut, item_middle(&items[first], cut->axis)) < cut->before) {
            first++;
        } else {
            const struct bvh_item other = items[--end];
            items[end] = items[first];
            items[first] = other;
        }
    }
    return first;
}

/* The range becomes its first part; returns the second. */
static struct bvh_range bvh_cut_range(const struct builder *builder, struct bvh_range *range)
{
    struct bvh_item *items = builder->items + range->first;
    struct bvh_cut cut = {.before = 0, .cost = INFINITY};
    if (range->depth < BVH_UNEVEN) {
        struct bvh_cut along[AXES];
        double low[AXES] = {INFINITY, INFINITY, INFINITY};
        double high[AXES] = {-INFINITY, -INFINITY, -INFINITY};
        for (size_t i = 0; i < range->count; i++) {
            for (int k = 0; k < AXES; k++) {
                const double middle = item_middle(&items[i], k);
                low[k] = middle < low[k] ? middle : low[k];
                high[k] = middle > high[k] ? middle : high[k];
            }
        }
        struct bin bins[AXES][BINS];
        for (int k = 0; k < AXES; k++) {
            const double width = high[k] - low[k];
            along[k] = (struct bvh_cut){k, 0, INFINITY, low[k], width > 0 ? BINS / width : 0};
            for (int b = 0; b < BINS; b++) {
                bins[k][b] = (struct bin){nothing, 0};
            }
        }
        for (size_t i = 0; i < range->count; i++) {
            for (int k = 0; k < AXES; k++) {
                struct bin *bin = &bins[k][bin_of(&along[k], item_middle(&items[i], k))];
                box_grow(&bin->box, &items[i].box);
                bin->count++;
            }
        }
        for (int k = 0; k < AXES; k++) {
            cut_choose(bins[k], &along[k], &cut);
        }
    }
    const size_t before = cut.before > 0 ? part_items(items, range->count, &cut) : range->count / 2;
    struct bvh_range second = *range;
    second.first += before;
    second.count -= before;
    second.box = box_around(items + before, second.count);
    range->count = before;
    range->box = box_around(items, before);
    return second;
}

/* -------- a tree of them -------- */

/* A node of a range: up to four parts; those that become nodes go on the heap. */
static size_t make_node(struct builder *builder, const struct bvh_range *range,
                        struct bvh_range *heap)
{
    struct bvh_range parts[BVH_WIDTH] = {*range};
    size_t count = 1, kept = 0;
    while (count < BVH_WIDTH) {
        /* which part is divided next; `count`: none, they are all leaves */
        const bool by_number = range->depth >= BVH_UNEVEN;
        size_t next = count;
        double largest = -1;
        for (size_t i = 0; i < count; i++) {
            const double size =
                by_number ? (double)parts[i].count : box_half_surface(&parts[i].box);
            if (parts[i].count > builder->most && size > largest) {
                next = i;
                largest = size;
            }
        }
        if (next == count) {
            break;
        }
        parts[count] = bvh_cut_range(builder, &parts[next]);
        count++;
    }
    const uint32_t number = (uint32_t)builder->node_count++;
    struct bvh_node *node = &builder->nodes[number];
    for (size_t i = 0; i < BVH_WIDTH; i++) {
        const struct bvh_range *part = i < count ? &parts[i] : &(struct bvh_range){.box = nothing};
        for (int k = 0; k < AXES; k++) {
            node->side[0][k][i] = part->box.low[k];
            node->side[1][k][i] = part->box.high[k];
        }
        node->child[i] = (uint32_t)part->first;
        node->count[i] = (uint32_t)part->count;
        if (part->count > builder->most) {
            node->count[i] = 0;
            heap[kept] = *part;
            heap[kept].depth++;
            heap[kept].parent = number;
            heap[kept++].place = (uint32_t)i;
        }
    }
    return kept;
}

void bvh_open(const struct bvh_box *boxes, size_t count, size_t most, struct arena *arena,
              struct bvh *tree)
{
    *tree = (struct bvh){.count = count};
    if (count == 0) {
        return;
    }
    struct arena work = {0};
    /* each node has at least two children but the root; pages of those that are not made cost
       nothing */
    struct builder builder = {
        .items = arena_buffer_array(&work, count, sizeof *builder.items),
        .most = most,
        .nodes = arena_buffer_array(&work, count, sizeof *builder.nodes),
    };
    for (size_t i = 0; i < count; i++) {
        builder.items[i] = (struct bvh_item){boxes[i], (uint32_t)i};
    }
    struct bvh_range heap[BVH_PENDING + BVH_WIDTH];
    size_t kept = 1;
    heap[0] = (struct bvh_range){.count = count, .box = box_around(builder.items, count)};
    while (kept > 0) {
        const struct bvh_range range = heap[--kept];
        if (builder.node_count > 0) {
            builder.nodes[range.parent].child[range.place] = (uint32_t)builder.node_count;
        }
        kept += make_node(&builder, &range, &heap[kept]);
    }
    struct bvh_node *nodes = arena_buffer_array(arena, builder.node_count, sizeof *nodes);
    memcpy(nodes, builder.nodes, builder.node_count * sizeof *nodes);
    uint32_t *items = arena_buffer_array(arena, count, sizeof *items);
    for (size_t i = 0; i < count; i++) {
        items[i] = builder.items[i].which;
    }
    tree->nodes = nodes;
    tree->node_count = builder.node_count;
    tree->items = items;
    arena_free(&work);
}
