/* tests/unit/test_trace_thick.c - exact rays through a thick lens. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "file/lens_file.h"
#include "optics/thick_lens.h"
#include "trace/dispatch.h"
#include "trace/system.h"

/* A plane, the thick lens in water behind, a plane: H at 20, H' at 20 - 4, image 60 behind. */
static const char *const texts[2] = {
    "surface - 20 air -\nthick 50 30 1.33 - hiatus=-4\nsurface - 60 1.33 -\n",
    "object 400\nsurface - 20 air -\nthick 50 30 1.33 - hiatus=-4 distortion=-0.2,0.3,0.1\n"
    "surface - 60 1.33 -\n",
};

static void check_lens(int which)
{
    struct arena arena = {0};
    struct lens lens;
    struct system system;
    struct error error;
    struct system_options options = system_options_default();
    options.image = 60;
    CHECK(lens_read("t.lens", text_of(texts[which]), NULL, &arena, &lens, &error));
    CHECK(system_compile(&lens, 0.55, &options, &arena, &system, &error));
    const struct thick_lens thick = {
        .focal = 50,
        .front = 20,
        .rear = -30,
        .index_object = 1,
        .index_image = 1.33,
        .distortion = {which ? -0.2 : 0, which ? 0.3 : 0, which ? 0.1 : 0},
        .object = which ? 400 : INFINITY};
    for (int i = 0; i < 40; i++) {
        const struct slope_ray in = {3 - 0.3 * i, 0.2 * i, 0.9 - 0.04 * i, 0.02 * i - 0.5};
        const struct slope_ray out = thick_lens_map(&thick, in);
        double length = sqrt(1 + in.p * in.p + in.q * in.q);
        const struct ray start = {.point = {in.x, in.y, 0},
                                  .cosine = {in.p / length, in.q / length, 1 / length}};
        struct rays rays = rays_new(&arena, 1);
        rays_set(&rays, 0, system.index_first, &start);
        rays_trace(&system, &rays, NULL);
        const struct ray end = rays_get(&rays, 0, system.index_last);
        CHECK(end.status == RAY_OK);
        CHECK_NEAR(end.point[0], out.x + 60 * out.p, 1e-12 * (1 + fabs(out.x)), "x in the image");
        CHECK_NEAR(end.point[1], out.y + 60 * out.q, 1e-12 * (1 + fabs(out.y)), "y in the image");
        CHECK_NEAR(end.cosine[0] / end.cosine[2], out.p, 1e-14, "slope");
    }
    arena_free(&arena);
}

/* Back the way it came. */
static void check_reverse(void)
{
    struct arena arena = {0};
    struct lens lens;
    struct system forward, backward;
    struct error error;
    struct system_options options = system_options_default();
    CHECK(lens_read("t.lens", text_of(texts[0]), NULL, &arena, &lens, &error));
    CHECK(system_compile(&lens, 0.55, &options, &arena, &forward, &error));
    options.reverse = true;
    CHECK(system_compile(&lens, 0.55, &options, &arena, &backward, &error));
    const struct ray start = {.point = {2, -3, 0}, .cosine = {0.3, 0.2, sqrt(1 - 0.13)}};
    struct rays rays = rays_new(&arena, 1);
    rays_set(&rays, 0, forward.index_first, &start);
    rays_trace(&forward, &rays, NULL);
    struct ray middle = rays_get(&rays, 0, forward.index_last);
    for (int k = 0; k < 3; k++) {
        middle.cosine[k] = -middle.cosine[k];
    }
    rays_set(&rays, 0, backward.index_first, &middle);
    rays_trace(&backward, &rays, NULL);
    const struct ray end = rays_get(&rays, 0, backward.index_last);
    CHECK_NEAR(end.point[0] - end.point[2] * end.cosine[0] / end.cosine[2], 2, 1e-13, "x again");
    CHECK_NEAR(end.point[1] - end.point[2] * end.cosine[1] / end.cosine[2], -3, 1e-13, "y again");
    CHECK_NEAR(end.cosine[0], -0.3, 1e-14, "direction again");
    CHECK(lens_read("t.lens", text_of(texts[1]), NULL, &arena, &lens, &error));
    CHECK(!system_compile(&lens, 0.55, &options, &arena, &backward, &error));
    CHECK(strstr(error.message, "backwards") != NULL);
    arena_free(&arena);
}

int main(void)
{
    check_lens(0);
    check_lens(1);
    check_reverse();
    return check_report();
}
