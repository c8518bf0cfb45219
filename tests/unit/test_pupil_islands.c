/* tests/unit/test_pupil_islands.c - light beyond gaps, against a grid fine enough to trust. */
/* SPDX-License-Identifier: MIT */
#include "analysis/pupil/quadrature.h"
#include "analysis/setup/setup.h"
#include "base/constants.h"
#include "check.h"
#include "exchange/lens_open.h"
#include "trace/dispatch.h"

enum { SIDE = 700 };

/* Clear cells of a fine grid over u, v from -4 to 4: all, and those joined with the middle. */
static void count_cells(const struct stop_beam *pupil, struct arena *arena, size_t *all,
                        size_t *joined)
{
    struct rays rays = rays_new(arena, (size_t)SIDE * SIDE);
    char *state = arena_array(arena, (size_t)SIDE * SIDE, 1);
    size_t *waiting = ARENA_ARRAY(arena, (size_t)SIDE * SIDE, size_t), count = 0;
    for (size_t i = 0; i < (size_t)SIDE * SIDE; i++) {
        double at[2];
        stop_beam_place(pupil, 8 * ((double)(i % SIDE) + 0.5) / SIDE - 4,
                        8 * ((double)(i / SIDE) + 0.5) / SIDE - 4, at);
        const struct ray ray = beam_ray(pupil->beam, at[0], at[1]);
        rays_set(&rays, i, pupil->system->index_first, &ray);
    }
    rays_trace(pupil->system, &rays, NULL);
    *all = *joined = 0;
    for (size_t i = 0; i < (size_t)SIDE * SIDE; i++) {
        state[i] = ray_block_status(&rays.blocks[i / RAYS_BLOCK], i % RAYS_BLOCK) == RAY_OK;
        *all += state[i] == 1;
    }
    waiting[count++] = (size_t)(SIDE / 2) * SIDE + SIDE / 2;
    CHECK(state[waiting[0]] == 1);
    state[waiting[0]] = 2;
    while (count > 0) {
        const size_t cell = waiting[--count];
        const size_t beside[] = {cell - 1, cell + 1, cell - SIDE, cell + SIDE};
        (*joined)++;
        for (size_t k = 0; k < 4; k++) {
            if (beside[k] < (size_t)SIDE * SIDE && state[beside[k]] == 1) {
                state[beside[k]] = 2;
                waiting[count++] = beside[k];
            }
        }
    }
}

/* What a quadrature leaves out of all that is clear: beside islands what no star can hold. */
static double left_out(struct quadrature_region *region, size_t all, struct arena *arena)
{
    const struct quadrature quadrature = quadrature_fill(region, 2000, arena);
    double sum = 0;
    for (size_t i = 0; i < quadrature.sample.count; i++) {
        sum += quadrature.sample.points[i].weight;
    }
    return 1 - PI * sum / ((double)all * 64 / ((double)SIDE * SIDE));
}

/* has_arms: of the same part some lies beyond a gap, as seen from its middle. */
static void test_lens(const char *name, double degrees, bool has_islands, bool has_arms)
{
    struct arena arena = {0};
    struct lensdb db = {.arena = &arena};
    struct lens lens;
    struct setup setup;
    struct error error;
    struct beam beam;
    struct aim aim;
    size_t all, joined;
    const struct setup_field field = {{FIELD_ANGLE, {0, degrees * RADIANS_PER_DEGREE}}, 1};
    CHECK(lens_open(&db, text_of(name), &arena, &lens, &error));
    const struct setup_question question = {
        .lens = &lens, .wavelength = NAN, .fnumber = NAN, .fields = &field, .field_count = 1};
    CHECK(setup_open(&question, &arena, &setup, &error));
    const struct system *open = setup_system(&setup, 0, SETUP_OPEN, &error);
    const struct system *clear = setup_system(&setup, 0, SETUP_CLIPPED, &error);
    CHECK(setup_beam(&setup, &field.point, &beam, &error));
    CHECK(aim_open(open, &beam, &arena, &aim, &error));
    const struct stop_beam pupil = stop_beam_of_stop(&aim, clear, WEIGHT_BEAM);
    struct quadrature_region region = quadrature_open(&pupil, &arena);
    const struct pupil_islands islands = quadrature_islands(&region, &arena);
    count_cells(&pupil, &arena, &all, &joined);
    double share = has_arms ? left_out(&region, all, &arena) : 1 - (double)joined / (double)all;
    CHECK((islands.share > 0) == has_islands);
    CHECK_NEAR(islands.share, share, 0.25 * share + 1e-4, name);
    arena_free(&arena);
}

int main(void)
{
    test_lens("cooke-triplet-50", 14, true, false);
    test_lens("cooke-triplet-50", 20, true, false);
    test_lens("laikin75-petzval", 7, true, false);
    test_lens("rudolph-tessar-100", 35, true, true);
    test_lens("double-gauss", 14, false, false);
    test_lens("nikkor-z-58-f095", 18, false, false);
    return check_report();
}
