/* tests/bench/skips.c - steps that a lens does without: what they would cost, and change. */
/* SPDX-License-Identifier: MIT */
#include "double_gauss.h"

/*
 * Prints a line for each, "NAME RATIO DIFFERENCE": time with what is left out over time without it,
 * and by how much, mm, a ray's last point moves at most (0: the same bits).
 */

static const char plates[] = "medium 1\nfield angle 0\naperture stop\n"
                             "surface - 2 1.5 60\nsurface - 2 air 60\nsurface - 2 1.6 60\n"
                             "surface - 2 air 60\nsurface - 2 1.7 60\nstop - 2 air 40\n"
                             "surface - 2 1.5 60\nsurface - 2 air 60\nsurface - 2 1.6 60\n"
                             "surface - 2 air 60\n";
/* the same with radii that no plane's rays can tell from none */
static const char bent_plates[] =
    "medium 1\nfield angle 0\naperture stop\n"
    "surface 1e16 2 1.5 60\nsurface 1e16 2 air 60\nsurface 1e16 2 1.6 60\n"
    "surface 1e16 2 air 60\nsurface 1e16 2 1.7 60\nstop - 2 air 40\n"
    "surface 1e16 2 1.5 60\nsurface 1e16 2 air 60\nsurface 1e16 2 1.6 60\n"
    "surface 1e16 2 air 60\n";

static double difference(const struct fixture *a, const struct fixture *b)
{
    double most = 0;
    for (size_t i = 0; i < RAYS; i++) {
        const struct ray one = rays_get(&a->rays, i, 1), other = rays_get(&b->rays, i, 1);
        if (one.status == RAY_OK && other.status == RAY_OK) {
            most = fmax(most, hypot(one.point[0] - other.point[0], one.point[1] - other.point[1]));
        }
    }
    return most;
}

/* Both in turns, so that what else the machine does slows both. */
static void compare(const char *name, struct fixture *less, struct fixture *more)
{
    double without = 1e9, with = 1e9;
    for (int turn = 0; turn < 4; turn++) {
        without = fmin(without, time_rays(less, NULL, 5));
        with = fmin(with, time_rays(more, NULL, 5));
    }
    printf("%s %.3f %.3g\n", name, with / without, difference(less, more));
}

int main(void)
{
    struct fixture least = {0}, more = {0};
    set_up(&least, gauss, false, false, RAYS);
    set_up(&more, gauss, true, false, RAYS);
    compare("clip", &least, &more);
    set_up(&more, gauss, false, true, RAYS);
    compare("path", &least, &more);
    set_up(&more, gauss_with(&more.arena, " k=1e-18"), false, false, RAYS);
    compare("spheres", &least, &more);
    struct fixture flat = {0}, bent = {0};
    set_up(&flat, plates, false, false, RAYS);
    set_up(&bent, bent_plates, false, false, RAYS);
    compare("planes", &flat, &bent);
    arena_free(&least.arena);
    arena_free(&more.arena);
    arena_free(&flat.arena);
    arena_free(&bent.arena);
    return 0;
}
