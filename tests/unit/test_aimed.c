/* tests/unit/test_aimed.c - derivatives of rays that stay aimed, against 113 bits aimed anew. */
/* SPDX-License-Identifier: MIT */
#include "aimed_truth.h"
#include "check.h"
#include "file/lens_file.h"
#include "optics/lens_numbers.h"
#include "trace/aim/aimed.h"

enum { PER_BEAM = 9, BEAMS = 3 };

struct under_test {
    struct arena arena;
    struct lens lens;
    struct lens_numbers numbers;
    struct system_options options;
    struct system system;
    struct aimed_work work;
    struct aimed_beam beams[BEAMS];
    struct aimed aimed;
    struct derivative_layout layout;
    double *gradient[TRUTHS];
    struct aimed_rates rates[TRUTHS];
    real inverse[RAYS_BLOCK][4];
    const char *text;
    double worst;
};

/* Few rays for each number, others for the next: steps in 113 bits are as slow as exact. */
enum { STRIDE = 13 };
static const double step = 0x1p-40;

/* A few points of the pupil, one on its edge. */
static const double points[PER_BEAM][2] = {{0, 0},      {0, 1},      {0.6, 0.8},
                                           {-0.3, 0.1}, {0.5, -0.5}, {0, -0.9},
                                           {0.9, 0},    {-0.7, 0.6}, {0.1, 0.2}};

static bool compile(struct under_test *test)
{
    struct error error;
    bool done = system_compile(&test->numbers.lens, 0.55, &test->options, &test->arena,
                               &test->system, &error);
    if (!done) {
        printf("%s\n", error.message);
    }
    return done;
}

static bool open_test(struct under_test *test, const char *text, double field)
{
    struct error error;
    *test = (struct under_test){.text = text};
    if (!lens_read("test", text_of(text), NULL, &test->arena, &test->lens, &error)) {
        printf("%s\n", error.message);
        return false;
    }
    lens_numbers_open(&test->lens, &test->arena, &test->numbers);
    test->options = system_options_default();
    test->options.path = true;
    test->options.image = 40;
    test->options.stop_radius = 3;
    if (!compile(test)) {
        return false;
    }
    for (int g = 0; g < BEAMS; g++) {
        const double n = test->system.index_first, share = (double)g / (BEAMS - 1);
        struct aimed_beam *at = &test->beams[g];
        *at = (struct aimed_beam){.first = g * PER_BEAM, .count = PER_BEAM};
        if (test->lens.object_is_infinite) {
            at->beam = beam_from_infinity((double[2]){0.1 * share * field, share * field}, n);
        } else {
            const double height = -400 * share * field;
            const double point[3] = {0.2 * height, height, -test->lens.object.value.hi};
            CHECK(beam_from_point(point, n, &at->beam, &error));
        }
    }
    aimed_work_open(&test->system, &test->arena, &test->work);
    aimed_open(test->beams, BEAMS, true, &test->work, &test->aimed);
    for (int i = 0; i < test->aimed.count; i++) {
        test->aimed.x[i] = points[i % PER_BEAM][0];
        test->aimed.y[i] = points[i % PER_BEAM][1];
    }
    return true;
}

static void sweep(struct under_test *test, unsigned what)
{
    derivative_layout(&test->system, what, &test->arena, &test->layout);
    struct ray_block end;
    aimed_trace(&test->aimed, true, &end);
    for (int output = 0; output < TRUTHS; output++) {
        struct ray_block adjoint;
        memset(&adjoint, 0, sizeof adjoint);
        double *of[TRUTHS] = {adjoint.x, adjoint.y, adjoint.path};
        for (int i = 0; i < RAYS_BLOCK; i++) {
            of[output][i] = 1;
        }
        test->gradient[output] = ARENA_ARRAY(&test->arena, test->layout.rows * RAYS_BLOCK, double);
        aimed_sweep(&test->aimed, &test->layout, test->system.places, &adjoint,
                    test->gradient[output], &test->rates[output]);
    }
}

/* The ends of a ray aimed anew, or from the entrance coordinates that it has. */
static bool ends_of(const struct under_test *test, int lane, double radius, real ends[TRUTHS])
{
    const struct beam *beam = &test->beams[lane / PER_BEAM].beam;
    real at[2] = {test->aimed.a[lane], test->aimed.b[lane]};
    const real goal[2] = {(real)test->aimed.x[lane] * (real)radius,
                          (real)test->aimed.y[lane] * (real)radius};
    return truth_aim(&test->system, beam, test->inverse[lane], goal, at) &&
           truth_end(&test->system, beam, at, ends);
}

/* One ray at a time: which ones changes from one number to the next. */
static void compare(struct under_test *test, const double *row, int lane, real difference,
                    const char *what)
{
    const double expected = (double)difference;
    double scale = 1;
    for (int i = 0; i < test->aimed.count; i++) {
        scale = fmax(scale, fabs(row[i]));
    }
    const double off = fabs(row[lane] - expected) / scale;
    test->worst = fmax(test->worst, off);
    if (!(off <= 1e-12)) {
        printf("%s\nlane %d by %s: %.15g, expected %.15g\n", test->text, lane, what, row[lane],
               expected);
    }
    CHECK(off <= 1e-12);
}

/* Numbers as pairs, so that 113 bits have small steps. */
static struct pair *number_of(struct under_test *test, struct parameter by)
{
    if (by.kind == PARAMETER_INDEX) {
        return by.surface == LENS_NONE || !surface_reflects(&test->lens.surfaces[by.surface])
                   ? (struct pair *)&test->system.n[by.surface + 1]
                   : NULL;
    }
    const struct figure *figure = NULL;
    figure = parameter_figure(&test->numbers.lens.surfaces[by.surface], by.kind, by.order);
    return figure != NULL ? (struct pair *)&figure->value : NULL;
}

/* Mirrors behind a medium stand in it too. */
static void set_number(struct under_test *test, struct parameter by, struct pair *number,
                       struct pair value)
{
    *number = value;
    for (size_t i = by.surface + 1; by.kind == PARAMETER_INDEX && i < test->lens.surface_count &&
                                    surface_reflects(&test->lens.surfaces[i]);
         i++) {
        ((struct pair *)test->system.n)[i + 1] = value;
    }
}

static void check_by(struct under_test *test, struct parameter by)
{
    struct pair *number = number_of(test, by);
    const size_t row = derivative_row(&test->layout, by);
    const bool is_image =
        by.kind == PARAMETER_THICKNESS && by.surface + 1 == test->lens.surface_count;
    if (number == NULL || row == LENS_NONE) {
        return;
    }
    const struct pair kept = *number;
    for (int lane = (int)(row % STRIDE); lane < test->aimed.count; lane += STRIDE) {
        real at[2][TRUTHS];
        for (int i = 0; i < 2; i++) {
            const double by_step = i == 0 ? -step : step;
            set_number(test, by, number, pair_add(kept, pair_of(by_step)));
            test->system.options.image = test->options.image + (is_image ? by_step : 0);
            CHECK(ends_of(test, lane, test->system.stop_radius, at[i]));
        }
        set_number(test, by, number, kept);
        test->system.options.image = test->options.image;
        for (int output = 0; output < TRUTHS; output++) {
            compare(test, test->gradient[output] + row * RAYS_BLOCK, lane,
                    (at[1][output] - at[0][output]) / (2 * (real)step),
                    parameter_write(by, &test->arena));
        }
    }
}

/* A curvature, a conic and the like where there is none would be another step of the kernels. */
static void give_numbers(struct under_test *test)
{
    for (size_t i = 0; i < test->lens.surface_count; i++) {
        struct surface *surface = &test->numbers.lens.surfaces[i];
        const struct parameter c = {i, PARAMETER_CURVATURE, 0};
        if (parameter_suits(PARAMETER_CURVATURE, surface)) {
            const double value = parameter_get(&test->numbers.lens, c);
            surface->has_curvature = surface->is_plane = true;
            surface->curvature.value = pair_of(value);
        }
        for (int k = 0; k < 10; k++) {
            const enum parameter_kind kind = (enum parameter_kind)(PARAMETER_DECENTER_X + k);
            lens_numbers_set(&test->numbers, (struct parameter){i, kind, 0}, 1e-9);
            lens_numbers_set(&test->numbers, (struct parameter){i, kind, 0},
                             parameter_get(&test->lens, (struct parameter){i, kind, 0}));
        }
    }
}

static void check_radius(struct under_test *test)
{
    const double R = test->system.stop_radius;
    for (int lane = 0; lane < test->aimed.count; lane++) {
        real at[2][TRUTHS];
        CHECK(ends_of(test, lane, R - step, at[0]) && ends_of(test, lane, R + step, at[1]));
        for (int output = 0; output < TRUTHS; output++) {
            compare(test, test->rates[output].radius, lane,
                    (at[1][output] - at[0][output]) / (2 * (real)step), "stop radius");
        }
    }
}

static void find_inverses(struct under_test *test)
{
    for (int lane = 0; lane < test->aimed.count; lane++) {
        const real at[2] = {test->aimed.a[lane], test->aimed.b[lane]};
        CHECK(truth_inverse(&test->system, &test->beams[lane / PER_BEAM].beam, at,
                            test->inverse[lane]));
    }
}

/* Rows of some parameters only are the same. */
static void check_some(struct under_test *test)
{
    struct parameter list[RAYS_BLOCK];
    struct derivative_layout few;
    size_t count = 0, seen = 0;
    for (size_t i = LENS_NONE; i + 1 <= test->lens.surface_count; i++) {
        for (struct parameter by = {.surface = i}; by.kind < PARAMETER_KINDS;
             by = parameter_next(by)) {
            if (derivative_row(&test->layout, by) != LENS_NONE && seen++ % 5 == 0) {
                list[count++] = by;
            }
        }
    }
    derivative_layout_of(&test->system, list, count, &test->arena, &few);
    CHECK(few.rows < test->layout.rows);
    double *gradient = ARENA_ARRAY(&test->arena, few.rows * RAYS_BLOCK, double);
    struct ray_block adjoint;
    struct aimed_rates rates;
    memset(&adjoint, 0, sizeof adjoint);
    for (int i = 0; i < RAYS_BLOCK; i++) {
        adjoint.y[i] = 1;
    }
    aimed_sweep(&test->aimed, &few, test->system.places, &adjoint, gradient, &rates);
    const size_t bytes = (size_t)test->aimed.count * sizeof(double);
    for (size_t k = 0; k < count; k++) {
        const double *all = test->gradient[1] + derivative_row(&test->layout, list[k]) * RAYS_BLOCK;
        CHECK(memcmp(all, gradient + derivative_row(&few, list[k]) * RAYS_BLOCK, bytes) == 0);
    }
    CHECK(memcmp(rates.radius, test->rates[1].radius, bytes) == 0);
}

/* From one lens to the next the rays are found again, as if they were looked for from nothing. */
static void check_again(struct under_test *test)
{
    static const double steps[] = {1e-9, 1e-5, 1e-3, -1e-3, 1e-2};
    const struct parameter c = {0, PARAMETER_CURVATURE, 0};
    const double was = parameter_get(&test->numbers.lens, c);
    struct arena within = arena_within(&test->arena);
    const struct arena_mark mark = arena_mark(&within);
    struct error error;
    for (size_t i = 0; i < sizeof steps / sizeof steps[0]; i++) {
        lens_numbers_set(&test->numbers, c, was * (1 + steps[i]));
        CHECK(compile(test));
        struct aimed fresh = test->aimed;
        fresh.is_known = false;
        CHECK(aimed_at_stop(&fresh, &test->system, &within, &error));
        arena_reset(&within, mark);
        CHECK(test->aimed.is_known);
        CHECK(aimed_at_stop(&test->aimed, &test->system, &test->arena, &error));
        for (int lane = 0; lane < test->aimed.count; lane++) {
            CHECK_NEAR(test->aimed.a[lane], fresh.a[lane], 1e-12, "a");
            CHECK_NEAR(test->aimed.b[lane], fresh.b[lane], 1e-12, "b");
        }
    }
}

static void check_stop(const char *text, double field)
{
    static struct under_test test;
    struct error error;
    if (!open_test(&test, text, field)) {
        CHECK(false);
        return;
    }
    give_numbers(&test);
    CHECK(compile(&test));
    aimed_work_open(&test.system, &test.arena, &test.work);
    const bool aims = aimed_at_stop(&test.aimed, &test.system, &test.arena, &error);
    CHECK(aims);
    if (!aims) {
        printf("%s\n%s\n", text, error.message);
        return;
    }
    sweep(&test, DERIVE_CONIC | DERIVE_SERIES | DERIVE_DISPLACEMENT | DERIVE_BREAK);
    find_inverses(&test);
    for (size_t i = LENS_NONE; i + 1 <= test.lens.surface_count; i++) {
        for (struct parameter by = {.surface = i}; by.kind < PARAMETER_KINDS;
             by = parameter_next(by)) {
            const bool is_high =
                by.kind == PARAMETER_COEFFICIENT && (by.order > 8 || by.order % 2 == 1);
            if ((i == LENS_NONE && by.kind != PARAMETER_INDEX) || is_high) {
                continue;
            }
            check_by(&test, by);
        }
    }
    check_radius(&test);
    check_some(&test);
    check_again(&test);
    printf("aimed at the stop: worst error %.2g of scale\n", test.worst);
    arena_free(&test.arena);
}

/* Coordinates of a ray through a point of the entrance pupil. */
static void place_in(const struct beam *beam, const real target[3], real at[2])
{
    real along = 0, sum[2] = {0, 0};
    for (int i = 0; i < 3; i++) {
        along += target[i] * (real)beam->axis[i];
        sum[0] += target[i] * (real)beam->across[0][i];
        sum[1] += target[i] * (real)beam->across[1][i];
    }
    const real d = isinf(beam->distance) ? 1 : (real)beam->distance;
    const real scale = isinf(beam->distance) ? 1 : d / (d + along);
    at[0] = sum[0] * scale;
    at[1] = sum[1] * scale;
}

/* By the place of the paraxial entrance pupil and by its radius. */
static void check_entrance(const char *text)
{
    static struct under_test test;
    const struct first_order first = {.entrance_pupil = 7.5, .entrance_diameter = 6};
    struct error error;
    CHECK(open_test(&test, text, 0.15));
    test.aimed.at_stop = false;
    CHECK(aimed_at_entrance(&test.aimed, &test.system, &first, &error));
    sweep(&test, 0);
    for (int lane = 0; lane < test.aimed.count; lane++) {
        const struct beam *beam = &test.beams[lane / PER_BEAM].beam;
        for (int k = 0; k < 2; k++) {
            real ends[2][TRUTHS];
            for (int i = 0; i < 2; i++) {
                const real by = i == 0 ? -step : step, radius = 3 + (k == 0 ? by : 0);
                const real target[3] = {test.aimed.x[lane] * radius, test.aimed.y[lane] * radius,
                                        (real)7.5 + (k == 1 ? by : 0)};
                real at[2];
                place_in(beam, target, at);
                CHECK(truth_end(&test.system, beam, at, ends[i]));
            }
            for (int output = 0; output < TRUTHS; output++) {
                const struct aimed_rates *rates = &test.rates[output];
                compare(&test, k == 0 ? rates->radius : rates->place, lane,
                        (ends[1][output] - ends[0][output]) / (2 * (real)step), "entrance pupil");
            }
        }
    }
    printf("aimed at the entrance pupil: worst error %.2g of scale\n", test.worst);
    arena_free(&test.arena);
}

int main(void)
{
    static const char *const lenses[] = {
        "surface 50 6 1.6 -\nsurface -80 3 air -\nsurface -40 2 1.7 -\nstop - 5 air -\n"
        "surface 70 4 1.5 -\nsurface -35 0 air -\n",
        "object 300\nmedium 1.33\nsurface 40 6 1.6 - k=-0.7\nsurface - 3 1.2 -\nstop - 2 1.2 -\n"
        "surface -60 5 1.8 - k=2 A4=1e-5 A6=-2e-8 A8=1e-11\nsurface 90 0 1.1 - A2=0.001\n",
        "surface -160 -30 mirror - k=-1\nstop - -5 air -\nsurface -200 35 mirror - A4=1e-7\n"
        "surface 50 3 1.5 -\n",
        "surface 50 6 1.6 - decenter=0.5,-0.3 tilt=3,-2\nbend decenter=0.2,0.1 tilt=4,-3,10\n"
        "surface -80 3 air - cyl=x\nstop - 2 air - tilt=2,1 decenter=0.3,0.1\n"
        "surface -70 2 1.5 - cyl=y k=-2 A4=1e-6\n",
    };
    if (sizeof(real) == sizeof(double)) {
        printf("aimed rays: skipped, no number has more than 53 bits\n");
        return check_report();
    }
    for (size_t i = 0; i < sizeof lenses / sizeof lenses[0]; i++) {
        check_stop(lenses[i], i == 2 ? 0.03 : 0.15);
    }
    check_entrance(lenses[0]);
    check_entrance(lenses[1]);
    return check_report();
}
