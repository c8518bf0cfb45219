/* tests/unit/test_trace_wide.c - rays from behind the first vertex: fisheyes past 90 degrees. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "check.h"
#include "exchange/lens_open.h"
#include "trace/dispatch.h"
#include "trace/verify.h"

enum { ACROSS = 2048 };

/*
 * A fan of parallel rays at an angle, started 200 mm outside the first surface; those that arrive
 * agree with 80 bits, and light sent back along them comes out where they began.
 */
static size_t check_fan(const struct system *forward, const struct system *back, double angle)
{
    struct arena arena = {0};
    struct rays rays = rays_new(&arena, ACROSS), again = rays_new(&arena, ACROSS);
    struct ray starts[ACROSS];
    const struct surface *first = &forward->lens->surfaces[0];
    double reach = first->diameter.value.hi / 2, sine = sin(angle), cosine = cos(angle);
    size_t arrived = 0;
    for (size_t i = 0; i < ACROSS; i++) {
        double across = reach * (2 * ((double)i + 0.5) / ACROSS - 1);
        starts[i] = (struct ray){
            .point = {0.2, across * cosine - 200 * sine, reach - across * sine - 200 * cosine},
            .cosine = {0, sine, cosine}};
        rays_set(&rays, i, forward->index_first, &starts[i]);
    }
    rays_trace(forward, &rays, NULL);
    for (size_t i = 0; i < ACROSS; i++) {
        struct ray end = rays_get(&rays, i, forward->index_last);
        struct verification check = verify_ray(forward, &starts[i], &end);
        struct ray home = end;
        CHECK((end.status == RAY_OK) == isfinite(end.point[0]) || end.status == RAY_CLIPPED);
        /* clear apertures are not looked at there, nor here */
        CHECK(end.status == check.ray.status);
        if (end.status == RAY_OK) {
            arrived++;
            CHECK_NEAR(check.point_error, 0, 5e-11, "point");
            CHECK_NEAR(check.cosine_error, 0, 1e-12, "cosines");
        }
        for (int j = 0; j < 3; j++) {
            home.cosine[j] = -end.cosine[j];
        }
        rays_set(&again, i, back->index_first, &home);
    }
    rays_trace(back, &again, NULL);
    for (size_t i = 0; i < ACROSS; i++) {
        if (rays_get(&rays, i, 1).status == RAY_OK) {
            struct ray home = rays_get(&again, i, back->index_last);
            CHECK(home.status == RAY_OK);
            CHECK_NEAR(home.cosine[1], -sine, 1e-11, "direction of light sent back");
            CHECK_NEAR(home.cosine[2], -cosine, 1e-11, "direction of light sent back");
        }
    }
    arena_free(&arena);
    return arrived;
}

static void check_fisheye(const char *name, double degrees, size_t fans)
{
    struct arena arena = {0};
    struct lensdb db = {.arena = &arena};
    struct lens lens;
    struct system forward, back;
    struct error error;
    struct system_options options = system_options_default();
    CHECK(lens_open(&db, text_of(name), &arena, &lens, &error));
    CHECK(system_compile(&lens, 0.5875618, &options, &arena, &forward, &error));
    options.reverse = true;
    CHECK(system_compile(&lens, 0.5875618, &options, &arena, &back, &error));
    for (size_t i = 0; i <= fans; i++) {
        double angle = degrees * (double)i / (double)fans;
        size_t arrived = check_fan(&forward, &back, angle * RADIANS_PER_DEGREE);
        if (arrived == 0) {
            printf("%s: no ray at %g degrees\n", name, angle);
        }
        CHECK(arrived > 0);
    }
    arena_free(&arena);
}

int main(void)
{
    volatile long double one = 1, tiny = 0x1p-60L;
    if (one + tiny == one) {
        printf("wide rays: skipped, long double has 53 bits here\n");
        return check_report();
    }
    check_fisheye("fisheye-270", 130, 26);
    check_fisheye("minolta-fisheye-1", 90, 18);
    return check_report();
}
