/* tests/unit/test_aim.c - rays aimed at the stop: every lens of lensdb over its field. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "check.h"
#include "exchange/lens_open.h"
#include "trace/aim.h"
#include "trace/aim_block.h"
#include "trace/beam_block.h"
#include "trace/dispatch.h"

#include <stdlib.h>
#include <string.h>

static const double degree = RADIANS_PER_DEGREE;

struct opened {
    struct lens lens;
    const struct lens *at;
    struct system system;
    struct first_order first;
    struct conjugate_object object;
};

static bool open_lens(const char *name, size_t position, struct arena *arena, struct opened *opened)
{
    struct lensdb db = {.arena = arena};
    struct error error;
    struct system_options options = system_options_default();
    if (!lens_open(&db, text_of(name), arena, &opened->lens, &error)) {
        printf("%s: %s\n", name, error.message);
        return false;
    }
    opened->at = lens_at_position(&opened->lens, position, arena);
    double wavelength = lens_primary_wavelength(opened->at);
    opened->object = lens_object(opened->at);
    if (!system_compile(opened->at, wavelength, &options, arena, &opened->system, &error) ||
        !first_order_of_lens(opened->at, wavelength, SECTION_Y, arena, &opened->first, &error)) {
        printf("%s: %s\n", name, error.message);
        return false;
    }
    return true;
}

/* Aim at the rim and inside; what arrives must cross the stop there. */
static void check_field(const char *name, const struct opened *opened,
                        const struct field_point *field, struct arena *arena)
{
    struct error error;
    struct beam beam;
    struct aim aim;
    struct sample sample;
    if (!beam_of_field(field, &opened->object, &opened->first, &beam, &error) ||
        !aim_open(&opened->system, &beam, arena, &aim, &error)) {
        printf("%s field %g: %s\n", name, field->value[1], error.message);
        CHECK(false);
        return;
    }
    sample_make(PATTERN_HEXAPOLAR, 60, 0, arena, &sample, &error);
    struct rays rays = rays_new(arena, sample.count);
    size_t aimed = aim_rays(&aim, sample.points, sample.count, &rays);
    struct rays start = rays_new(arena, sample.count);
    memcpy(start.blocks, rays.blocks, rays_blocks(&rays) * sizeof *rays.blocks);
    rays_trace_part(&opened->system, 0, opened->system.stop + 1, &rays, NULL);
    double worst = 0;
    for (size_t i = 0; i < sample.count; i++) {
        struct ray ray = rays_get(&rays, i, 1);
        if (ray.status == RAY_OK) {
            double off = hypot(ray.point[0] - sample.points[i].x * aim.stop_radius,
                               ray.point[1] - sample.points[i].y * aim.stop_radius);
            worst = fmax(worst, off / aim.stop_radius);
        }
    }
    /* 1.3e-14 at most; a search whose steps do not become right fast ends at 1e-12 */
    CHECK(worst <= 1e-13);
    if (getenv("AIM_SHOW") != NULL) {
        printf("%-28s field %10.5g chief %10.5g %10.5g aimed %zu/%zu worst %.2g", name,
               field->value[1], aim.chief[0], aim.chief[1], aimed, sample.count, worst);
        for (size_t i = 0; i < sample.count; i++) {
            struct ray ray = rays_get(&start, i, 1);
            if (ray.status != RAY_OK) {
                printf(" %s at %zu", ray_status_name(ray.status), ray.surface);
                break;
            }
        }
        printf("\n");
    }
}

static void check_lens(const char *name)
{
    struct arena arena = {0};
    struct opened opened;
    size_t positions = 1;
    for (size_t p = 0; p < positions; p++) {
        if (!open_lens(name, p, &arena, &opened)) {
            CHECK(false);
            break;
        }
        positions = opened.lens.position_count > 0 ? opened.lens.position_count : 1;
        if (opened.at->stop == LENS_NONE || isnan(opened.system.stop_radius)) {
            printf("%s: no stop\n", name);
            break;
        }
        for (size_t i = 0; i < opened.at->field_count; i++) {
            struct field_point field = {opened.at->field_kind,
                                        {0, opened.at->fields[i].at[1].value.hi}};
            check_field(name, &opened, &field, &arena);
        }
        if (opened.at->field_count == 0) {
            struct field_point field = {FIELD_ANGLE, {0, 5 * degree}};
            check_field(name, &opened, &field, &arena);
        }
    }
    arena_free(&arena);
}

/* Numbers that look like chance, from -1 to 1. */
static double next_number(unsigned *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (double)(*state >> 8) / 8388608.0 - 1;
}

/* Every instruction set starts rays and steps towards goals with the same bits. */
static void test_instruction_sets(void)
{
    static const enum instruction_set sets[] = {SET_SSE2, SET_AVX2, SET_AVX512};
    struct beam beams[2] = {{.n = 1}, {.n = 1}};
    struct error error;
    const double angle[2] = {0.1, 0.2}, point[3] = {3, -20, -300};
    beams[0] = beam_from_infinity(angle, 1);
    CHECK(beam_from_point(point, 1.5, &beams[1], &error));
    for (size_t trial = 0; trial < 20; trial++) {
        static struct ray_block rays[3];
        static struct aim_block blocks[3];
        unsigned state = 1 + (unsigned)trial;
        double *numbers = (double *)&blocks[0];
        for (size_t i = 0; i < sizeof blocks[0] / sizeof(double); i++) {
            numbers[i] = next_number(&state);
        }
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            blocks[0].state[i] = (double)(i % 3);
        }
        blocks[0].lanes = RAYS_BLOCK;
        for (size_t k = 0; k < 3; k++) {
            if (!instruction_set_works(sets[k])) {
                continue;
            }
            memset(&rays[k], 0, sizeof rays[k]);
            dispatch_beam(sets[k])(&beams[trial % 2], blocks[0].goal_x, blocks[0].goal_y, 117,
                                   &rays[k]);
            CHECK(memcmp(&rays[k], &rays[0], sizeof rays[0]) == 0);
        }
        for (size_t k = 3; k-- > 0;) {
            if (instruction_set_works(sets[k])) {
                blocks[k] = blocks[0];
                dispatch_aim(sets[k])(&rays[0], 1e-3, 1e-6, &blocks[k]);
            }
        }
        for (size_t k = 1; k < 3; k++) {
            CHECK(!instruction_set_works(sets[k]) ||
                  memcmp(&blocks[k], &blocks[0], sizeof blocks[0]) == 0);
        }
    }
}

int main(void)
{
    test_instruction_sets();
    struct arena arena = {0};
    struct lensdb db = {.arena = &arena};
    struct error error;
    const char *const *names;
    CHECK(lens_open_names(&db, LENSDB_EMBEDDED, &arena, &names, &error));
    for (size_t i = 0; names[i] != NULL; i++) {
        check_lens(names[i]);
    }
    arena_free(&arena);
    return check_report();
}
