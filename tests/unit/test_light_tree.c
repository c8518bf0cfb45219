/* tests/unit/test_light_tree.c - boxes about emitters, halved and halved again. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "scene/light_tree.h"

/*
 * A node of the tree and all below it, of leaves begin .. begin + count - 1: the box about their
 * spheres, along whose longest axis no middle of the first half lies beyond one of the second.
 */
static void check_tree(const struct scene *scene, const struct light_tree *tree, size_t node,
                       size_t begin, size_t count)
{
    const struct light_tree_node *own = &tree->nodes[node];
    const size_t half = count / 2;
    double square = 0, power = 0, longest = 0;
    bool is_apart = count == 1;
    for (int axis = 0; axis < 3; axis++) {
        double low = INFINITY, high = -INFINITY, least[2], most[2];
        least[0] = least[1] = INFINITY;
        most[0] = most[1] = -INFINITY;
        for (size_t i = begin; i < begin + count; i++) {
            const struct scene_thing *lamp = &scene->things[tree->emitters[i].thing];
            const struct vector at = lamp->where.at;
            const double middle = axis == 0 ? at.x : axis == 1 ? at.y : at.z;
            const size_t side = i < begin + half ? 0 : 1;
            low = fmin(low, middle - lamp->radius);
            high = fmax(high, middle + lamp->radius);
            least[side] = fmin(least[side], middle);
            most[side] = fmax(most[side], middle);
            power += axis == 0 ? 1 + (double)tree->emitters[i].thing : 0;
        }
        const double length = fmax(most[0], most[1]) - fmin(least[0], least[1]);
        if (count > 1 && length > longest) {
            longest = length;
            is_apart = most[0] <= least[1];
        }
        square += (high - low) * (high - low) / 4;
        CHECK_NEAR((double)own->at[axis], (low + high) / 2, 1e-3, "middle of the box");
    }
    CHECK_RELATIVE((double)own->radius, sqrt(square), 1e-6, "half of its diagonal");
    CHECK_RELATIVE(own->power, power, 1e-12, "light of all");
    CHECK(is_apart);
    if (count > 1) {
        check_tree(scene, tree, node + 1, begin, half);
        check_tree(scene, tree, node + 2 * half, begin + half, count - half);
    }
}

/* Of spheres of three sizes, in a room that is longer than high and higher than wide. */
static void test_tree(void)
{
    enum { LAMPS = 23 };
    static struct scene_thing lamps[LAMPS];
    struct arena arena = {0};
    struct emitter emitters[LAMPS];
    double power[LAMPS], all = 0;
    struct light_tree tree;
    for (uint32_t i = 0; i < LAMPS; i++) {
        double u[3];
        for (uint32_t k = 0; k < 3; k++) {
            u[k] = (double)((7919 * (i + 1) * (k + 3) * (k + 5)) % 1009) / 1009;
        }
        lamps[i] = (struct scene_thing){.shape = SHAPE_SPHERE,
                                        .where.at = {4000 * u[0] - 900, 3000 * u[1], -2500 * u[2]},
                                        .radius = 5 + 30 * (i % 3)};
        emitters[i] = (struct emitter){i, 0};
        power[i] = 1 + i;
        all += power[i];
    }
    const struct scene scene = {.things = lamps, .thing_count = LAMPS};
    light_tree_open(&scene, emitters, power, LAMPS, &arena, &tree);
    check_tree(&scene, &tree, 0, 0, LAMPS);
    /* power/max(d^2, r^2/2) */
    const struct light_tree_node *root = &tree.nodes[0];
    const double r = (double)root->radius;
    for (int k = 0; k < 8; k++) {
        const int step = k / 2;
        const double share = 0.2 + 0.4 * step, away = share * r / sqrt(3);
        const struct vector from = {(double)root->at[0] + away, (double)root->at[1] - away,
                                    (double)root->at[2] + (k % 2 == 0 ? away : -away)};
        CHECK_RELATIVE(light_tree_importance(&tree, from), all / (r * r * fmax(share * share, 0.5)),
                       1e-9, "as one point");
    }
    for (size_t i = 0; i < LAMPS; i++) {
        CHECK(tree.emitters[tree.leaf_of[i]].thing == i);
    }
    arena_free(&arena);
}

int main(void)
{
    test_tree();
    return check_report();
}
