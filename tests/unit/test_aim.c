/* tests/unit/test_aim.c - rays aimed at the stop: every lens of lensdb over its field. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "check.h"
#include "exchange/lens_open.h"
#include "trace/aim/aim.h"
#include "trace/aim/aim_block.h"
#include "trace/aim/aim_map.h"
#include "trace/aim/beam.h"
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

/* Fields at which rays of the margin are totally reflected: beside these the stop hardly moves. */
static bool is_steep(const char *name)
{
    static const char *const names[] = {"cooke-anamorphic-bad", "merte-biotar-14-100",
                                        "zeiss-biotar-100"};
    bool is = false;
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        is = is || strcmp(name, names[i]) == 0;
    }
    return is;
}

/* Aim at the rim and inside; what arrives must cross the stop there. */
static void check_sample(const char *name, const struct opened *opened, const struct aim *aim,
                         const struct sample *sample, struct arena *arena)
{
    struct rays rays = rays_new(arena, sample->count);
    size_t aimed = aim_rays(aim, sample->points, sample->count, &rays), apart = 0;
    struct rays start = rays_new(arena, sample->count), few = rays_new(arena, RAYS_BLOCK);
    memcpy(start.blocks, rays.blocks, rays_blocks(&rays) * sizeof *rays.blocks);
    rays_trace_part(&opened->system, 0, opened->system.stop + 1, &rays, NULL);
    double worst = 0;
    for (size_t i = 0; i < sample->count; i++) {
        struct ray ray = rays_get(&rays, i, 1);
        if (ray.status == RAY_OK) {
            double off = hypot(ray.point[0] - sample->points[i].x * aim->stop_radius,
                               ray.point[1] - sample->points[i].y * aim->stop_radius);
            worst = fmax(worst, off / aim->stop_radius);
        }
    }
    /* 1.3e-14 at most; a search whose steps do not become right fast ends at 1e-12 */
    CHECK(worst <= (is_steep(name) ? 1e-9 : 1e-13));
    /* many go by a map of the pupil, a few do not: the same rays are found */
    for (size_t done = 0; done < sample->count; done += RAYS_BLOCK) {
        size_t left = sample->count - done, here = left < RAYS_BLOCK ? left : RAYS_BLOCK;
        apart += aim_rays(aim, sample->points + done, here, &few);
        for (size_t i = 0; i < here; i++) {
            struct ray one = rays_get(&few, i, 1), other = rays_get(&start, done + i, 1);
            double off = hypot(one.point[0] - other.point[0], one.point[1] - other.point[1]);
            CHECK(one.status == other.status && one.surface == other.surface);
            CHECK(one.status != RAY_OK || off <= 1e-9 * opened->at->surfaces[0].diameter.value.hi ||
                  !opened->at->surfaces[0].has_diameter);
        }
    }
    CHECK(aimed == apart);
    if (getenv("AIM_SHOW") != NULL) {
        printf("%-28s chief %10.5g %10.5g aimed %zu/%zu worst %.2g", name, aim->chief[0],
               aim->chief[1], aimed, sample->count, worst);
        for (size_t i = 0; i < sample->count; i++) {
            struct ray ray = rays_get(&start, i, 1);
            if (ray.status != RAY_OK) {
                printf(" %s at %zu", ray_status_name(ray.status), ray.surface);
                break;
            }
        }
        printf("\n");
    }
}

static void check_field(const char *name, const struct opened *opened,
                        const struct field_point *field, struct arena *arena)
{
    static const size_t counts[] = {60, 700};
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
    for (size_t k = 0; k < sizeof counts / sizeof counts[0]; k++) {
        CHECK(sample_make(PATTERN_HEXAPOLAR, counts[k], 0, arena, &sample, &error));
        check_sample(name, opened, &aim, &sample, arena);
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
            KERNEL_FOR(sets[k], kernel_beam)
            (&beams[trial % 2], blocks[0].goal_x, blocks[0].goal_y, 117, &rays[k]);
            CHECK(memcmp(&rays[k], &rays[0], sizeof rays[0]) == 0);
        }
        for (size_t k = 3; k-- > 0;) {
            if (instruction_set_works(sets[k])) {
                blocks[k] = blocks[0];
                KERNEL_FOR(sets[k], kernel_aim)(&rays[0], 1e-3, 1e-6, &blocks[k]);
            }
        }
        for (size_t k = 1; k < 3; k++) {
            CHECK(!instruction_set_works(sets[k]) ||
                  memcmp(&blocks[k], &blocks[0], sizeof blocks[0]) == 0);
        }
    }
}

/* The map of a pupil too. */
static void test_maps(void)
{
    static const enum instruction_set sets[] = {SET_SSE2, SET_AVX2, SET_AVX512};
    static struct map_block blocks[3];
    static struct ray_block at;
    double nodes[MAP_NODES][2], a[MAP_NODES], b[MAP_NODES];
    struct aim_map map;
    unsigned state = 7;
    aim_map_nodes(nodes);
    for (size_t i = 0; i < MAP_NODES; i++) {
        /* a polynomial of the third degree, which it meets */
        const double x = nodes[i][0], y = nodes[i][1];
        a[i] = 3 * x + 0.2 * x * y - 0.1 * x * (x * x + y * y);
        b[i] = 1 + 2 * y + 0.3 * x * x - 0.1 * y * y * y;
    }
    aim_map_fit(a, b, &map);
    for (size_t k = 0; k < 3; k++) {
        memset(&blocks[k], 0, sizeof blocks[k]);
        blocks[k].lanes = kernel_lanes(117);
    }
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        for (size_t k = 0; k < 3; k++) {
            const double x = k == 0 ? 0.7 * next_number(&state) : blocks[0].x[i];
            const double y = k == 0 ? 0.7 * next_number(&state) : blocks[0].y[i];
            blocks[k].x[i] = blocks[k].goal_x[i] = x;
            blocks[k].y[i] = blocks[k].goal_y[i] = y;
        }
        at.x[i] = 2 * (blocks[0].x[i] + 0.01 * next_number(&state));
        at.y[i] = 2 * (blocks[0].y[i] + 0.01 * next_number(&state));
    }
    for (size_t k = 0; k < 3; k++) {
        if (!instruction_set_works(sets[k])) {
            continue;
        }
        KERNEL_FOR(sets[k], kernel_map)(&map, NULL, 0.5, &blocks[k]);
        for (size_t i = 0; i < 117; i++) {
            const double x = blocks[k].x[i], y = blocks[k].y[i];
            CHECK_NEAR(blocks[k].a[i], 3 * x + 0.2 * x * y - 0.1 * x * (x * x + y * y), 1e-14, "a");
            CHECK_NEAR(blocks[k].b[i], 1 + 2 * y + 0.3 * x * x - 0.1 * y * y * y, 1e-14, "b");
        }
        KERNEL_FOR(sets[k], kernel_map)(&map, &at, 0.5, &blocks[k]);
        CHECK(memcmp(&blocks[k], &blocks[0], sizeof blocks[0]) == 0);
    }
}

/* A stop wider than can be traced: the aim says so, and is asked for nothing more. */
static void test_widest_stop(void)
{
    struct arena arena = {0};
    struct opened opened;
    struct beam beam = beam_along((double[3]){0, 0, 1}, 1);
    struct aim aim;
    struct error error = {0};
    memset(&aim, 0xff, sizeof aim);
    CHECK(open_lens("double-gauss", 0, &arena, &opened));
    opened.system.stop_radius = 1e101;
    CHECK(!aim_open(&opened.system, &beam, &arena, &aim, &error));
    CHECK(strstr(error.message, "1e+101 mm") != NULL);
    CHECK(aim.system == NULL && !aim_open_at(&aim, (double[2]){0, 0}));
    arena_free(&arena);
}

int main(void)
{
    test_instruction_sets();
    test_maps();
    test_widest_stop();
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
