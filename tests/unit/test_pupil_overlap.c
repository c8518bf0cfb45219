/* tests/unit/test_pupil_overlap.c - a pupil laid over itself, and what the sum is by its rays. */
/* SPDX-License-Identifier: MIT */
#include "analysis/waves/pupil_overlap.h"

#include "base/constants.h"
#include "base/processor.h"
#include "check.h"

#include <math.h>
#include <string.h>

enum { STEPS = 4 };

/* A pupil whose rays lie anywhere near (x, y), with a wave front of a few wavelengths. */
struct bench {
    struct arena arena;
    struct pupil_rule rule;
    struct pupil_wave wave;
    struct pupil_spot spot;
    struct pupil_overlap overlap;
};

static void open_bench(struct bench *bench, size_t rays, struct pupil_mirrors mirrors)
{
    struct sample sample;
    struct error error;
    *bench = (struct bench){.arena = {0}};
    CHECK(sample_make(PATTERN_GAUSS, rays, 0, &bench->arena, &sample, &error));
    CHECK(pupil_rule_open(sample.points, sample.count, &bench->arena, &bench->rule, &error));
    pupil_wave_open(&bench->rule, &bench->arena, &bench->wave);
    pupil_spot_open(&bench->rule, &bench->arena, &bench->spot);
    pupil_overlap_open(&bench->wave, 2 * bench->rule.form.orders, mirrors, &bench->arena,
                       &bench->overlap);
}

/* A perfect pupil of numerical aperture 0.1, turned about as by a lens. */
static void set_perfect(struct bench *bench)
{
    for (size_t i = 0; i < bench->rule.count; i++) {
        const double x = bench->rule.x[i], y = bench->rule.y[i];
        bench->wave.parts[PUPIL_TO_X][i] = -0.1 * x;
        bench->wave.parts[PUPIL_TO_Y][i] = 0.2 - 0.1 * y;
        bench->wave.parts[PUPIL_WAVE][i] = 0;
        bench->wave.parts[PUPIL_FROM_X][i] = 5 * x;
        bench->wave.parts[PUPIL_FROM_Y][i] = 5 * y;
    }
}

/* [Goodman05] (6-32): 2/pi (acos s - s sqrt(1 - s^2)), s in shares of the cut-off. */
static void check_circle(void)
{
    static const struct pupil_mirrors all[] = {
        {false, false}, {true, false}, {false, true}, {true, true}};
    for (size_t m = 0; m < 4; m++) {
        for (int k = 1; k < 20; k++) {
            const double share = k / 20., root = sqrt(1 - share * share);
            struct bench bench;
            struct error error;
            open_bench(&bench, 36, all[m]);
            set_perfect(&bench);
            bench.overlap.shift[0] = m == 0 ? 0.2 * share * 0.6 : 0;
            bench.overlap.shift[1] = m == 0 ? 0.2 * share * 0.8 : 0.2 * share;
            CHECK(pupil_wave_find(&bench.wave, &error) &&
                  pupil_overlap_find(&bench.overlap, false, &error));
            CHECK_NEAR(bench.wave.energy, 25 * PI, 1e-12, "the area of the beam");
            CHECK_NEAR(bench.overlap.cutoff, 0.2, 1e-14, "the cut-off");
            CHECK_NEAR(bench.overlap.re / bench.wave.energy, 2 / PI * (acos(share) - share * root),
                       m == 0 ? 1e-9 : 2e-8, "a perfect pupil");
            CHECK_NEAR(bench.overlap.im, 0, 1e-12, "it has no phase");
            arena_free(&bench.arena);
        }
    }
}

/* Beyond the cut-off there is nothing, nor a derivative. */
static void check_beyond(void)
{
    struct bench bench;
    struct error error;
    open_bench(&bench, 10, (struct pupil_mirrors){false, false});
    set_perfect(&bench);
    bench.overlap.shift[0] = 0.2001;
    CHECK(pupil_wave_find(&bench.wave, &error) && pupil_overlap_find(&bench.overlap, true, &error));
    CHECK(bench.overlap.is_empty && bench.overlap.re == 0 && bench.overlap.im == 0);
    pupil_wave_begin_back(&bench.wave);
    pupil_overlap_back(&bench.overlap, (const double[]){1, 1});
    pupil_wave_back(&bench.wave);
    for (size_t i = 0; i < bench.rule.count; i++) {
        CHECK_NEAR(bench.wave.back[PUPIL_WAVE][i], 0, 0, "nothing moves it");
    }
    arena_free(&bench.arena);
}

/* A beam that is folded within the pupil, and light that all goes one way. */
static void check_refused(void)
{
    struct bench bench;
    struct error error = {.code = ERROR_NONE};
    open_bench(&bench, 36, (struct pupil_mirrors){false, false});
    set_perfect(&bench);
    for (size_t i = 0; i < bench.rule.count; i++) {
        bench.wave.parts[PUPIL_FROM_X][i] = 5 * bench.rule.x[i] * bench.rule.x[i];
    }
    CHECK(!pupil_wave_find(&bench.wave, &error) &&
          strstr(error.message, "folded within the pupil"));
    set_perfect(&bench);
    for (size_t i = 0; i < bench.rule.count; i++) {
        bench.wave.parts[PUPIL_TO_X][i] = 0;
    }
    error = (struct error){.code = ERROR_NONE};
    CHECK(!pupil_wave_find(&bench.wave, &error) && strstr(error.message, "from one direction"));
    arena_free(&bench.arena);
}

/* -------- derivatives -------- */

/* -1 .. 1, [Knuth97] 3.3.4: line 26 of table 1. */
static double chance(unsigned long long *state)
{
    *state = *state * 6364136223846793005ULL + 1442695040888963407ULL;
    return ldexp((double)(*state >> 11), -52) - 1;
}

/* Parts of each ray, with noise that no polynomial has, moved along a direction of all of them. */
static void set_moved(const struct bench *bench, double *const parts[PUPIL_PARTS], double way,
                      unsigned long long seed)
{
    unsigned long long state = seed;
    for (size_t i = 0; i < bench->rule.count; i++) {
        const double x = bench->rule.x[i], y = bench->rule.y[i], q = x * x + y * y;
        parts[PUPIL_TO_X][i] = -0.1 * x + 0.02 * y + 0.004 * x * q + 0.003 * x * y;
        parts[PUPIL_TO_Y][i] = 0.2 - 0.08 * y + 0.006 * y * y - 0.002 * y * q;
        parts[PUPIL_WAVE][i] = 0.7 * q + 0.9 * y * q - 0.5 * x * x + 0.3 * x * y * q + 0.2 * q * q;
        parts[PUPIL_FROM_X][i] = -5 * x + 0.3 * x * y;
        parts[PUPIL_FROM_Y][i] = 4 * y + 0.2 * q - 0.1 * y * q;
        for (int part = 0; part < PUPIL_PARTS; part++) {
            static const double sizes[PUPIL_PARTS] = {1e-3, 1e-3, 0.1, 0.05, 0.05};
            const double noise = chance(&state), direction = chance(&state);
            parts[part][i] += sizes[part] * (0.05 * noise + way * direction);
        }
    }
}

/* What the direction gains by `back`. */
static double gain_of(const struct bench *bench, double *const back[PUPIL_PARTS],
                      unsigned long long seed)
{
    double *moved[PUPIL_PARTS], *rest[PUPIL_PARTS], sum = 0;
    struct arena arena = {0};
    for (int part = 0; part < PUPIL_PARTS; part++) {
        moved[part] = ARENA_ARRAY(&arena, bench->rule.room, double);
        rest[part] = ARENA_ARRAY(&arena, bench->rule.room, double);
    }
    set_moved(bench, moved, 1, seed);
    set_moved(bench, rest, 0, seed);
    for (int part = 0; part < PUPIL_PARTS; part++) {
        for (size_t i = 0; i < bench->rule.count; i++) {
            sum += back[part][i] * (moved[part][i] - rest[part][i]);
        }
    }
    arena_free(&arena);
    return sum;
}

/* Some function of the sum and of the light. */
static double waves_at(struct bench *bench, double way, unsigned long long seed, bool derives)
{
    struct error error;
    set_moved(bench, bench->wave.parts, way, seed);
    CHECK(pupil_wave_find(&bench->wave, &error) &&
          pupil_overlap_find(&bench->overlap, derives, &error));
    return (0.3 * bench->overlap.re - 0.8 * bench->overlap.im + 0.1 * bench->wave.energy) / 50;
}

static double rays_at(struct bench *bench, double way, unsigned long long seed)
{
    struct error error;
    struct pupil_spot *spot = &bench->spot;
    double sum = 0;
    set_moved(bench, spot->wave.parts, way, seed);
    CHECK(pupil_spot_find(spot, &error));
    for (size_t i = 0; i < bench->rule.fine_count; i++) {
        sum += spot->area[i] * spot->place[0][i] * (1 + spot->place[1][i]);
        spot->by_place[0][i] = spot->area[i] * (1 + spot->place[1][i]);
        spot->by_place[1][i] = spot->area[i] * spot->place[0][i];
        spot->by_area[i] = spot->place[0][i] * (1 + spot->place[1][i]);
    }
    return sum;
}

/* Central differences of eighth order. */
static double difference(struct bench *bench, unsigned long long seed, bool by_rays)
{
    static const double factors[STEPS] = {4. / 5, -1. / 5, 4. / 105, -1. / 280}, h = 0.004;
    double sum = 0;
    for (int k = 1; k <= STEPS; k++) {
        for (int side = -1; side <= 1; side += 2) {
            const double way = side * k * h;
            sum += side * factors[k - 1] *
                   (by_rays ? rays_at(bench, way, seed) : waves_at(bench, way, seed, false));
        }
    }
    return sum / h;
}

static void check_derivatives(size_t rays, double shift)
{
    for (unsigned long long seed = 1; seed <= 6; seed++) {
        struct bench bench;
        open_bench(&bench, rays, (struct pupil_mirrors){false, false});
        bench.overlap.shift[0] = shift * (seed % 2 == 0 ? 1 : 0.6);
        bench.overlap.shift[1] = shift * (seed % 2 == 0 ? 0 : -0.8);
        const double slope = difference(&bench, seed, false);
        waves_at(&bench, 0, seed, true);
        pupil_wave_begin_back(&bench.wave);
        bench.wave.by_energy = 0.1 / 50;
        pupil_overlap_back(&bench.overlap, (const double[]){0.3 / 50, -0.8 / 50});
        pupil_wave_back(&bench.wave);
        CHECK_NEAR(gain_of(&bench, bench.wave.back, seed), slope, 1e-10 * fmax(1, fabs(slope)),
                   "a sum by its rays");
        const double spread = difference(&bench, seed, true);
        rays_at(&bench, 0, seed);
        pupil_spot_back(&bench.spot);
        CHECK_NEAR(gain_of(&bench, bench.spot.wave.back, seed), spread,
                   1e-10 * fmax(1, fabs(spread)), "a sum over rays by them");
        arena_free(&bench.arena);
    }
}

/* -------- every set of instructions gives the same bits -------- */

/* All that kernels write, one behind the other. */
enum { PLACES = 56, NUMBERS = 6 * PLACES + 2 * PUPIL_TERMS + PUPIL_TERMS * PUPIL_TERMS };

struct kernels {
    kernel_pupil_look *look;
    kernel_pupil_gather *gather;
    kernel_pupil_gram *gram;
    kernel_pupil_cross *cross;
};

#define KERNELS(set)                                                                               \
    {                                                                                              \
        kernel_pupil_look_##set, kernel_pupil_gather_##set, kernel_pupil_gram_##set,               \
            kernel_pupil_cross_##set                                                               \
    }

static void run_kernels(const struct kernels *kernels, struct arena *arena, double *to)
{
    const struct pupil_form form = pupil_form_of(136);
    double *numbers = ARENA_ARRAY(arena, 4 * PLACES + 2 * PUPIL_TERMS, double), *end = to;
    unsigned long long state = 5;
    for (int i = 0; i < 4 * PLACES + 2 * PUPIL_TERMS; i++) {
        numbers[i] = 0.7 * chance(&state);
    }
    const double *const c[2] = {numbers + 4 * PLACES, numbers + 4 * PLACES + PUPIL_TERMS};
    double *out[6];
    for (int i = 0; i < 6; i++, end += PLACES) {
        out[i] = end;
    }
    const struct pupil_look look = {
        PLACES, numbers, numbers + PLACES, {out[0], out[1]}, {{out[2], out[3]}, {out[4], out[5]}}};
    kernels->look(&form, c, &look);
    kernels->gather(&form, &look, (double *const[]){end, end + PUPIL_TERMS});
    const struct pupil_fit fit = {&form,
                                  PLACES,
                                  numbers,
                                  numbers + PLACES,
                                  numbers + 2 * PLACES,
                                  end + 2 * PUPIL_TERMS,
                                  ARENA_ARRAY(arena, PLACES * PUPIL_TERMS, double)};
    kernels->gram(&fit);
    const struct pupil_cross cross = {
        PLACES, {numbers, numbers + PLACES}, {out[1], out[2]}, numbers + PLACES, out[3], out[4],
        NULL};
    kernels->cross(&cross);
}

static void check_sets(void)
{
    static const struct kernels sse2 = KERNELS(sse2), avx2 = KERNELS(avx2),
                                avx512 = KERNELS(avx512);
    static double first[NUMBERS], other[NUMBERS];
    struct arena arena = {0};
    run_kernels(&sse2, &arena, first);
    CHECK(first[0] != 0 && first[3 * PLACES] != 0 && first[6 * PLACES] != 0);
    if (processor_has_avx2()) {
        run_kernels(&avx2, &arena, other);
        CHECK(memcmp(first, other, sizeof first) == 0);
    }
    if (processor_has_avx512()) {
        run_kernels(&avx512, &arena, other);
        CHECK(memcmp(first, other, sizeof first) == 0);
    }
    arena_free(&arena);
}

int main(void)
{
    check_sets();
    check_circle();
    check_beyond();
    check_refused();
    check_derivatives(3, 0.05);
    check_derivatives(36, 0.02);
    check_derivatives(36, 0.11);
    check_derivatives(36, 0.15);
    check_derivatives(210, 0.05);
    return check_report();
}
