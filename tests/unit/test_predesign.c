/* tests/unit/test_predesign.c - layouts by third-order theory, against thin-lens relations. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "design/predesign.h"

#include <math.h>
#include <string.h>

static struct predesign_wish wish_of(size_t elements, double fnumber, double field)
{
    return (struct predesign_wish){.elements = elements,
                                   .fnumber = fnumber,
                                   .field = field,
                                   .is_achromatic = true,
                                   .back = 0.1,
                                   .track = 2,
                                   .clear = 1 / fnumber,
                                   .curvature = 6,
                                   .center = {0.005, 0.1},
                                   .gap = {0.002, 0.5}};
}

/* A parallel ray of height 1 through the thick elements, one after the other; its slope at the end
   and, for colour, the sum of y^2 power/V. */
static double slope_behind(const struct predesign *design, double *colour)
{
    double y = 1, u = 0;
    *colour = 0;
    for (size_t i = 0; i < design->elements; i++) {
        const double n = design->index[i], front = design->curvature[2 * i],
                     rear = design->curvature[2 * i + 1];
        *colour += y * y * (n - 1) * (front - rear) / design->abbe[i];
        u = (u - y * front * (n - 1)) / n;
        y += u * design->center[i];
        u = n * u - y * rear * (1 - n);
        y += u * design->gap[i];
    }
    return u;
}

static void test_achromat(struct arena *arena)
{
    const struct predesign_wish wish = wish_of(2, 10, 0.02);
    size_t found = 0;
    for (uint32_t number = 0; number < 5; number++) {
        struct predesign design, again;
        double colour;
        if (!predesign_find(&wish, 1, 1, number, arena, &design)) {
            continue;
        }
        found++;
        /* thick instead of thin: a few percent */
        CHECK_NEAR(slope_behind(&design, &colour), -1, 0.05, "achromat: slope");
        /* a thin crown alone has 1/V, 0.018 and more */
        CHECK(fabs(colour) < 0.002);
        CHECK(predesign_find(&wish, 1, 1, number, arena, &again) &&
              memcmp(&again, &design, sizeof design) == 0);
    }
    CHECK(found >= 4);
}

/* Shorter than its focal length: a positive part before a negative one. */
static void test_telephoto(struct arena *arena)
{
    struct predesign_wish wish = wish_of(4, 5.6, 0.1);
    struct predesign design;
    double colour;
    wish.track = 0.75;
    CHECK(predesign_find(&wish, 2, 1, 3, arena, &design));
    double length = 0;
    for (size_t i = 0; i < design.elements; i++) {
        CHECK(design.center[i] >= wish.center[0] && design.center[i] <= wish.center[1]);
        length += design.center[i] + design.gap[i];
    }
    CHECK(length < 0.9);
    CHECK(slope_behind(&design, &colour) < -0.8); /* thick elements so near have more power */
}

/* A Petzval sum: sum power/n of three thin separated elements that is less than half of that of
   one lens of crown, 1/1.6, on the average. */
static void test_petzval(struct arena *arena)
{
    const struct predesign_wish wish = wish_of(3, 4, 0.36);
    double sum = 0;
    for (uint32_t number = 0; number < 10; number++) {
        struct predesign design;
        CHECK(predesign_find(&wish, 1 + number % 2, 2, number, arena, &design));
        for (size_t i = 0; i < design.elements; i++) {
            const double *c = &design.curvature[2 * i];
            sum += (design.index[i] - 1) * (c[0] - c[1]) / design.index[i];
        }
    }
    CHECK(sum / 10 < 0.6 / 1.6);
}

int main(void)
{
    struct arena arena = {0};
    test_achromat(&arena);
    test_telephoto(&arena);
    test_petzval(&arena);
    arena_free(&arena);
    return check_report();
}
