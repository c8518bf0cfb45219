/* tests/unit/test_bvh.c - trees of boxes: what is in them, and cuts of rows by trying all. */
/* SPDX-License-Identifier: MIT */
#include "scene/bvh.h"

#include "check.h"
#include "stream.h"

static struct stream stream = {.seed = 17};

static double surface(const struct bvh_box *box)
{
    const double x = (double)(box->high[0] - box->low[0]), y = (double)(box->high[1] - box->low[1]);
    const double z = (double)(box->high[2] - box->low[2]);
    return x * y + y * z + z * x;
}

static struct bvh_box around(const struct bvh_box *boxes, size_t first, size_t end)
{
    struct bvh_box all = boxes[first];
    for (size_t i = first; i < end; i++) {
        for (int k = 0; k < 3; k++) {
            all.low[k] = fminf(all.low[k], boxes[i].low[k]);
            all.high[k] = fmaxf(all.high[k], boxes[i].high[k]);
        }
    }
    return all;
}

/* Where the sum of surfaces times numbers of both sides is least. */
static size_t cheapest(const struct bvh_box *boxes, size_t first, size_t end)
{
    double least = INFINITY;
    size_t best = first;
    for (size_t at = first + 1; at < end; at++) {
        const struct bvh_box lower = around(boxes, first, at), upper = around(boxes, at, end);
        const double cost =
            surface(&lower) * (double)(at - first) + surface(&upper) * (double)(end - at);
        if (cost < least) {
            least = cost;
            best = at;
        }
    }
    return best;
}

/* The child of the root that has just this box, and the items first .. end - 1. */
static bool has_child(const struct bvh *tree, const struct bvh_box *boxes, size_t first, size_t end,
                      size_t most)
{
    const struct bvh_box box = around(boxes, first, end);
    const struct bvh_node *root = &tree->nodes[0];
    for (int c = 0; c < BVH_WIDTH; c++) {
        bool same = end - first > most ? root->count[c] == 0 : root->count[c] == end - first;
        for (int k = 0; k < 3; k++) {
            same = same && root->side[0][k][c] == box.low[k] && root->side[1][k][c] == box.high[k];
        }
        for (size_t i = 0; i < root->count[c] && same; i++) {
            const size_t which = tree->items[root->child[c] + i];
            same = which >= first && which < end;
        }
        if (same) {
            return true;
        }
    }
    return false;
}

/*
 * Boxes whose middles lie in a row, evenly apart, have a bin each: the cheapest cuts of all are
 * found, of the part with the largest surface first.
 */
static void test_rows(void)
{
    enum { COUNT = 16 };
    for (int trial = 0; trial < 60; trial++) {
        const int axis = trial % 3;
        const size_t most = 1 + (size_t)(trial % 4), count = COUNT - (size_t)(trial % 5);
        struct bvh_box boxes[COUNT];
        for (size_t i = 0; i < count; i++) {
            for (int k = 0; k < 3; k++) {
                const float half = (float)floor(between(&stream, 1, 40)) / 8;
                const float middle = k == axis ? (float)i : 5;
                boxes[i].low[k] = middle - half;
                boxes[i].high[k] = middle + half;
            }
        }
        struct arena arena = {0};
        struct bvh tree;
        bvh_open(boxes, count, most, &arena, &tree);
        size_t first[BVH_WIDTH] = {0}, end[BVH_WIDTH] = {count}, parts = 1;
        while (parts < BVH_WIDTH) {
            size_t next = BVH_WIDTH;
            double largest = -1;
            for (size_t i = 0; i < parts; i++) {
                const struct bvh_box box = around(boxes, first[i], end[i]);
                if (end[i] - first[i] > most && surface(&box) > largest) {
                    largest = surface(&box);
                    next = i;
                }
            }
            if (next == BVH_WIDTH) {
                break;
            }
            const size_t at = cheapest(boxes, first[next], end[next]);
            first[parts] = at;
            end[parts++] = end[next];
            end[next] = at;
        }
        for (size_t i = 0; i < parts; i++) {
            CHECK(has_child(&tree, boxes, first[i], end[i], most));
        }
        arena_free(&arena);
    }
}

/* All items once, no more than `most` a leaf, within the boxes of all nodes above; or an error. */
static size_t count_items(const struct bvh *tree, const struct bvh_box *boxes, size_t node,
                          size_t most, int depth, unsigned char *seen)
{
    const struct bvh_node *at = &tree->nodes[node];
    size_t found = 0;
    CHECK(depth < BVH_DEPTH && node < tree->node_count);
    for (int c = 0; c < BVH_WIDTH; c++) {
        struct bvh_box inside = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
        if (at->side[0][0][c] > at->side[1][0][c]) {
            CHECK(at->count[c] == 0);
            continue; /* none */
        }
        if (at->count[c] == 0) {
            const struct bvh_node *below = &tree->nodes[at->child[c]];
            found += count_items(tree, boxes, at->child[c], most, depth + 1, seen);
            for (int k = 0; k < 3; k++) {
                for (int i = 0; i < BVH_WIDTH; i++) {
                    inside.low[k] = fminf(inside.low[k], below->side[0][k][i]);
                    inside.high[k] = fmaxf(inside.high[k], below->side[1][k][i]);
                }
            }
        }
        CHECK(at->count[c] <= most);
        for (size_t i = 0; i < at->count[c]; i++) {
            const uint32_t which = tree->items[at->child[c] + i];
            seen[which]++;
            found++;
            for (int k = 0; k < 3; k++) {
                inside.low[k] = fminf(inside.low[k], boxes[which].low[k]);
                inside.high[k] = fmaxf(inside.high[k], boxes[which].high[k]);
            }
        }
        for (int k = 0; k < 3; k++) {
            CHECK(at->side[0][k][c] == inside.low[k] && at->side[1][k][c] == inside.high[k]);
        }
    }
    return found;
}

/* Scattered, many in one place, each twice as far as the one before, one alone, none. */
static void test_items(void)
{
    enum { COUNT = 700 };
    static const size_t counts[] = {COUNT, COUNT, 100, 1, 5};
    static struct bvh_box boxes[COUNT];
    for (size_t n = 0; n < sizeof counts / sizeof counts[0]; n++) {
        unsigned char seen[COUNT] = {0};
        for (size_t i = 0; i < counts[n]; i++) {
            const struct vector at = vector_in(&stream, 100), half = vector_in(&stream, 3);
            const double far = n == 2 ? ldexp(1, (int)i) : 1;
            const struct vector place = n == 1 && i > 3 ? (struct vector){1, 2, 3} : at;
            const struct vector h = {fabs(half.x), fabs(half.y), fabs(half.z)};
            boxes[i] = bvh_box_of(vector_along(vector_along(place, far - 1, place), -1, h),
                                  vector_along(vector_along(place, far - 1, place), 1, h), 0);
        }
        struct arena arena = {0};
        struct bvh tree;
        bvh_open(boxes, counts[n], 4, &arena, &tree);
        CHECK(tree.count == counts[n]);
        CHECK(count_items(&tree, boxes, 0, 4, 0, seen) == counts[n]);
        for (size_t i = 0; i < counts[n]; i++) {
            CHECK(seen[i] == 1);
        }
        arena_free(&arena);
    }
    struct bvh none;
    bvh_open(boxes, 0, 4, NULL, &none);
    CHECK(none.count == 0 && none.node_count == 0);
}

/* Never inside what it is around, and not by more than a few units of rounding outside. */
static void test_box(void)
{
    for (int i = 0; i < 100; i++) {
        const struct vector low = vector_in(&stream, 1000);
        const struct vector high = {low.x + 1, low.y + 2, low.z + 1e-7};
        const struct bvh_box box = bvh_box_of(low, high, 0.25);
        const double from[] = {low.x, low.y, low.z}, to[] = {high.x, high.y, high.z};
        for (int k = 0; k < 3; k++) {
            const double below = from[k] - 0.25 - (double)box.low[k];
            const double above = (double)box.high[k] - to[k] - 0.25;
            CHECK(below >= 0 && below < 4e-7 * 1001 && above >= 0 && above < 4e-7 * 1003);
        }
    }
}

int main(void)
{
    test_rows();
    test_items();
    test_box();
    return check_report();
}
