/* tests/unit/test_trace_derivative.c - adjoint derivatives against differences of 113 bits. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "file/lens_file.h"
#include "quad.h"
#include "trace/derivative.h"
#include "trace/tangent.h"

/* A lens, its derivatives, and how far they are off. */
struct under_test {
    struct arena arena;
    struct lens lens;
    struct system system;
    struct derivative_layout layout;
    struct derivative_tape tape;
    struct ray_block start;
    double *gradient[4];
    struct ray_block adjoint[4];
    double worst;
    const char *text;
};

enum { LANES = 8, OUTPUTS = 4 }; /* x, y, q, path of the last point */

static const double starts[LANES][6] = {
    {0, 0, -5, 0, 0, 1},      {3, 0, -5, 0, 0, 1},       {0, 4, -5, 0, 0.1, 0.99},
    {-2, 3, -5, 0.1, 0, 1},   {1, -3, -5, 0.05, 0.1, 1}, {2, 2, -5, -0.1, -0.1, 1},
    {-4, -1, -5, 0.05, 0, 1}, {0.5, 0.1, -5, 0, 0.2, 1},
};

static double *output_of(struct ray_block *block, int output)
{
    double *members[OUTPUTS] = {block->x, block->y, block->q, block->path};
    return members[output];
}

static bool set_up(struct under_test *test, const char *text, bool reverse)
{
    struct error error;
    struct system_options options = system_options_default();
    options.path = true;
    options.reverse = reverse;
    options.image = 40;
    *test = (struct under_test){.text = text};
    if (!lens_read("test", text_of(text), NULL, &test->arena, &test->lens, &error) ||
        !system_compile(&test->lens, 0.55, &options, &test->arena, &test->system, &error)) {
        printf("%s\n", error.message);
        return false;
    }
    derivative_layout(&test->system,
                      DERIVE_CONIC | DERIVE_SERIES | DERIVE_DISPLACEMENT | DERIVE_BREAK |
                          (strstr(text, "A3") != NULL ? DERIVE_ODD : 0),
                      &test->arena, &test->layout);
    test->tape = derivative_tape_new(&test->system, &test->arena);
    for (int i = 0; i < RAYS_BLOCK; i++) {
        const double *s = starts[i % LANES];
        /* light that goes back spreads behind the mirrors: narrower, to stay well conditioned */
        double sign = reverse ? -1 : 1, narrow = reverse ? 0.5 : 1;
        double L = narrow * s[3], M = narrow * s[4], N = sign * s[5];
        double n = test->system.index_first / sqrt(L * L + M * M + N * N);
        test->start.x[i] = narrow * s[0];
        test->start.y[i] = narrow * s[1];
        test->start.z[i] = sign * s[2];
        test->start.p[i] = n * L;
        test->start.q[i] = n * M;
        test->start.r[i] = n * N;
    }
    return true;
}

static void sweep(struct under_test *test, enum instruction_set set)
{
    const struct ray_block *end = derivative_trace(&test->system, &test->start, set, &test->tape);
    for (int i = 0; i < LANES; i++) {
        CHECK(end->lost[i] == 0);
    }
    for (int output = 0; output < OUTPUTS; output++) {
        memset(&test->adjoint[output], 0, sizeof test->adjoint[output]);
        for (int i = 0; i < RAYS_BLOCK; i++) {
            output_of(&test->adjoint[output], output)[i] = 1;
        }
        size_t numbers = test->layout.rows * RAYS_BLOCK;
        test->gradient[output] = ARENA_ARRAY(&test->arena, numbers, double);
        derivative_sweep(&test->system, &test->layout, set, &test->tape, &test->adjoint[output],
                         test->gradient[output]);
    }
}

/* The outputs of one lane in 113 bits, with the lens and indices as they are. */
static void trace_precisely(const struct under_test *test, int lane, real *outputs)
{
    const struct ray_block *s = &test->start;
    struct precise_ray ray = {.x = {s->x[lane], s->y[lane], s->z[lane]},
                              .p = {s->p[lane], s->q[lane], s->r[lane]}};
    CHECK(precise_trace(&ray, &test->system));
    outputs[0] = ray.x[0];
    outputs[1] = ray.x[1];
    outputs[2] = ray.p[1];
    outputs[3] = ray.path;
}

static void compare(struct under_test *test, int lane, int output, real difference, double value,
                    double scale, const char *what, size_t surface)
{
    double expected = (double)difference, error = fabs(value - expected);
    bool good = error <= 1e-14 * scale;
    if (!good) {
        printf("%s\nlane %d output %d by %s of surface %zu: %.17g, expected %.17g\n", test->text,
               lane, output, what, surface, value, expected);
    }
    CHECK(good);
    test->worst = fmax(test->worst, error / scale);
}

static void nudge(struct pair *value, double by)
{
    *value = pair_add(*value, pair_of(by));
}

/* Central difference by one number of the lens, against the row of the gradient. */
static void check_parameter(struct under_test *test, struct pair *value, enum parameter_kind kind,
                            int order, size_t surface, const char *what)
{
    const double step = 1e-13;
    size_t row = derivative_row(&test->layout, (struct parameter){surface, kind, order});
    CHECK(row != LENS_NONE);
    struct pair kept = *value;
    /* what goes with r^order has half as many times the rounding error of r^2 */
    double power = fmax((double)order / 2, 1);
    double scale[OUTPUTS] = {0};
    for (int output = 0; output < OUTPUTS; output++) {
        for (int lane = 0; lane < LANES; lane++) {
            double here = test->gradient[output][row * RAYS_BLOCK + (size_t)lane];
            scale[output] = fmax(scale[output], fabs(here));
        }
    }
    /* h and 2 h: the error is of fourth order */
    for (int lane = 0; lane < LANES; lane++) {
        real at[4][OUTPUTS];
        const double steps[4] = {-2 * step, -step, step, 2 * step};
        for (int i = 0; i < 4; i++) {
            nudge(value, steps[i]);
            trace_precisely(test, lane, at[i]);
            *value = kept;
        }
        for (int output = 0; output < OUTPUTS; output++) {
            real slope = (at[0][output] - at[3][output] + 8 * (at[2][output] - at[1][output])) /
                         (12 * (real)step);
            compare(test, lane, output, slope,
                    test->gradient[output][row * RAYS_BLOCK + (size_t)lane],
                    fmax(scale[output], 4) * power, what, surface);
        }
    }
}

static void check_surface(struct under_test *test, size_t i)
{
    struct surface *surface = &test->lens.surfaces[i];
    struct displacement moved = {0}, *was = NULL;
    surface->has_curvature = true;
    surface->curvature.value =
        surface->is_plane && surface->curvature.value.hi == 0
            ? pair_of(0)
            : (surface->is_plane ? surface->curvature.value
                                 : pair_divide(pair_of(1), surface->radius.value));
    if (surface->kind != SURFACE_STOP) {
        check_parameter(test, &surface->curvature.value, PARAMETER_CURVATURE, 0, i, "curvature");
        check_parameter(test, &surface->conic.value, PARAMETER_CONIC, 0, i, "conic");
        for (int j = 0; j < 4; j++) {
            check_parameter(test, &surface->coefficient[j].value, PARAMETER_COEFFICIENT, 2 * j + 2,
                            i, "coefficient");
            if ((test->layout.what & DERIVE_ODD) != 0) {
                check_parameter(test, &surface->coefficient[LENS_EVEN + j].value,
                                PARAMETER_COEFFICIENT, 2 * j + 1, i, "odd power");
            }
        }
    }
    if (i + 1 < test->lens.surface_count) {
        check_parameter(test, &surface->thickness.value, PARAMETER_THICKNESS, 0, i, "thickness");
    }
    if (surface->kind == SURFACE_REFRACT) {
        struct pair *n = (struct pair *)test->system.n + i + 1;
        check_parameter(test, n, PARAMETER_INDEX, 0, i, "index");
    }
    was = (struct displacement *)surface->decentre;
    moved = was != NULL ? *was : moved;
    surface->decentre = &moved;
    static const char *const names[] = {"decenter x", "decenter y", "tilt x", "tilt y", "tilt z"};
    for (int j = 0; j < 5; j++) {
        struct pair *value = j < 2 ? &moved.decenter[j].value : &moved.tilt[j - 2].value;
        check_parameter(test, value, (enum parameter_kind)(PARAMETER_DECENTER_X + j), 0, i,
                        names[j]);
    }
    surface->decentre = was;
    was = (struct displacement *)surface->coordinate_break;
    moved = was != NULL ? *was : (struct displacement){0};
    surface->coordinate_break = &moved;
    for (int j = 0; j < 5; j++) {
        struct pair *value = j < 2 ? &moved.decenter[j].value : &moved.tilt[j - 2].value;
        check_parameter(test, value, (enum parameter_kind)(PARAMETER_BREAK_DECENTER_X + j), 0, i,
                        names[j]);
    }
    surface->coordinate_break = was;
}

/* A surface that shifts along z makes the way before it longer and that behind it shorter. */
static void check_shift(struct under_test *test, size_t i)
{
    const struct surface *surface = &test->lens.surfaces[i];
    const bool bends = surface->coordinate_break != NULL || surface[1].coordinate_break != NULL;
    if (bends || test->system.options.reverse) {
        return;
    }
    const size_t before =
        derivative_row(&test->layout, (struct parameter){i - 1, PARAMETER_THICKNESS, 0});
    const size_t behind =
        derivative_row(&test->layout, (struct parameter){i, PARAMETER_THICKNESS, 0});
    const size_t shift =
        derivative_row(&test->layout, (struct parameter){i, PARAMETER_DECENTER_X, 0}) +
        DERIVE_SHIFT_Z;
    for (int output = 0; output < OUTPUTS; output++) {
        const double *rows = test->gradient[output];
        for (size_t lane = 0; lane < LANES; lane++) {
            const double longer = rows[before * RAYS_BLOCK + lane];
            const double shorter = rows[behind * RAYS_BLOCK + lane];
            const double scale = fabs(longer) + fabs(shorter) + 4;
            compare(test, (int)lane, output, (real)(longer - shorter),
                    rows[shift * RAYS_BLOCK + lane], scale, "shift along z", i);
        }
    }
}

/* Forwards a few at a time, against the rows of the sweeps back. */
static void check_tangents(struct under_test *test, const struct parameter *by, size_t count,
                           enum instruction_set set)
{
    struct rays rays = rays_new(&test->arena, count * RAYS_BLOCK);
    struct ray_block *tangents = rays.blocks;
    memset(tangents, 0, count * sizeof *tangents);
    tangent_trace(&test->system, by, count, set, &test->tape, tangents);
    struct rays again = rays_new(&test->arena, count * RAYS_BLOCK);
    memset(again.blocks, 0, count * sizeof *tangents);
    tangent_trace(&test->system, by, count, SET_SSE2, &test->tape, again.blocks);
    CHECK(memcmp(again.blocks, tangents, count * sizeof *tangents) == 0);
    for (size_t j = 0; j < count; j++) {
        size_t row = derivative_row(&test->layout, by[j]);
        for (int output = 0; output < OUTPUTS; output++) {
            const double *back = test->gradient[output] + row * RAYS_BLOCK;
            const double *forward = output_of(&tangents[j], output);
            double scale = 4;
            for (int lane = 0; lane < LANES; lane++) {
                scale = fmax(scale, fabs(back[lane]));
            }
            double power = fmax((double)by[j].order / 2, 1);
            for (int lane = 0; lane < LANES; lane++) {
                compare(test, lane, output, (real)back[lane], forward[lane], scale * power * 2,
                        "forward", by[j].surface + (size_t)100 * by[j].kind);
            }
        }
    }
}

static void check_forward(struct under_test *test, enum instruction_set set)
{
    static const size_t sizes[] = {1, 2, 4, 8};
    struct parameter all[TANGENTS_MOST];
    size_t count = 0, next = 0, tested = 0;
    for (size_t s = 0; s <= test->lens.surface_count; s++) {
        for (struct parameter by = {.surface = s - 1}; by.kind < PARAMETER_KINDS;
             by = parameter_next(by)) {
            if (derivative_row(&test->layout, by) == LENS_NONE) {
                continue;
            }
            all[count++] = by;
            tested++;
            if (count == sizes[next % 4]) {
                check_tangents(test, all, count, set);
                count = 0;
                next++;
            }
        }
    }
    check_tangents(test, all, count, set);
    /* and of each surface by itself its shift along z: check_shift */
    CHECK(tested + test->lens.surface_count >= test->layout.rows);
}

/* Of the starting rays: the columns of the matrix whose rows the sweeps give. */
static void check_forward_start(struct under_test *test)
{
    struct rays rays = rays_new(&test->arena, (size_t)6 * RAYS_BLOCK);
    struct ray_block *tangents = rays.blocks;
    memset(tangents, 0, 6 * sizeof *tangents);
    for (int i = 0; i < RAYS_BLOCK; i++) {
        tangents[0].x[i] = tangents[1].y[i] = tangents[2].z[i] = 1;
        tangents[3].p[i] = tangents[4].q[i] = tangents[5].r[i] = 1;
    }
    tangent_trace(&test->system, NULL, 6, SET_BEST, &test->tape, tangents);
    for (int output = 0; output < OUTPUTS; output++) {
        const struct ray_block *a = &test->adjoint[output];
        const double *back[6] = {a->x, a->y, a->z, a->p, a->q, a->r};
        for (int j = 0; j < 6; j++) {
            for (int lane = 0; lane < LANES; lane++) {
                compare(test, lane, output, (real)back[j][lane],
                        output_of(&tangents[j], output)[lane], 4 + 2 * fabs(back[j][lane]),
                        "forward start", (size_t)j);
            }
        }
    }
}

/* The entrance ray, by its point and direction. */
static void check_start(struct under_test *test)
{
    double *members[6] = {test->start.x, test->start.y, test->start.z,
                          test->start.p, test->start.q, test->start.r};
    for (int j = 0; j < 3; j++) {
        for (int lane = 0; lane < LANES; lane++) {
            real at[2][OUTPUTS];
            double kept = members[j][lane], step = 0x1p-30;
            for (int i = 0; i < 2; i++) {
                members[j][lane] = kept + (i == 0 ? -step : step);
                trace_precisely(test, lane, at[i]);
                members[j][lane] = kept;
            }
            for (int output = 0; output < OUTPUTS; output++) {
                struct ray_block *a = &test->adjoint[output];
                double *by[3] = {a->x, a->y, a->z};
                compare(test, lane, output, (at[1][output] - at[0][output]) / (2 * (real)step),
                        by[j][lane], 4, "start", 0);
            }
        }
    }
}

/* A ray that passes the lens by has no derivatives, its neighbours keep theirs. */
static void check_lost(struct under_test *test)
{
    enum { LOST = 9 };
    double kept = test->start.y[LOST], *first[OUTPUTS];
    memcpy(first, test->gradient, sizeof first);
    test->start.y[LOST] = 1e4;
    sweep(test, SET_BEST);
    struct parameter by = {.surface = 0, .kind = PARAMETER_CURVATURE};
    size_t row = derivative_row(&test->layout, by);
    struct rays rays = rays_new(&test->arena, RAYS_BLOCK);
    memset(rays.blocks, 0, sizeof *rays.blocks);
    tangent_trace(&test->system, &by, 1, SET_BEST, &test->tape, rays.blocks);
    for (int output = 0; output < OUTPUTS; output++) {
        const double *here = test->gradient[output] + row * RAYS_BLOCK;
        CHECK(isnan(here[LOST]) && isnan(output_of(rays.blocks, output)[LOST]));
        CHECK(memcmp(here, first[output] + row * RAYS_BLOCK, LANES * sizeof *here) == 0);
        CHECK(!isnan(output_of(rays.blocks, output)[LOST - 1]));
    }
    test->start.y[LOST] = kept;
}

/* Rows of a lens by one parameter, beside differences of 113 bits that are good to 1e-20. */
static void check_relative(struct under_test *test, struct parameter what, struct pair *value)
{
    const size_t row = derivative_row(&test->layout, what);
    const struct pair kept = *value;
    const double h = 1e-9;
    real outputs[2][OUTPUTS];
    for (int side = 0; side < 2; side++) {
        *value = pair_add(kept, pair_of(side == 0 ? h : -h));
        trace_precisely(test, 3, outputs[side]);
        *value = kept;
    }
    for (int i = 0; i < 2; i++) {
        const double expected = (double)((outputs[0][i] - outputs[1][i]) / (2 * (real)h));
        CHECK_RELATIVE(test->gradient[i][row * RAYS_BLOCK + 3], expected, 1e-11, "of a flat one");
    }
}

/*
 * Decentring a flat surface moves a ray by 1e-9 of it, and no rounding of the rest counts. One
 * that bends nothing moves it not at all, whatever its shape.
 */
static void test_flat(void)
{
    static struct under_test test;
    CHECK(set_up(&test,
                 "surface 50 6 1.6 -\nsurface 2e8 3 1 - decenter=0.1,0.2\n"
                 "surface 40 3 1 - k=-0.5\nsurface -60 2 1.5 -\n",
                 false));
    sweep(&test, SET_SSE2);
    struct displacement moved = *test.lens.surfaces[1].decentre;
    test.lens.surfaces[1].decentre = &moved;
    check_relative(&test, (struct parameter){1, PARAMETER_DECENTER_X, 0}, &moved.decenter[0].value);
    check_relative(&test, (struct parameter){1, PARAMETER_DECENTER_Y, 0}, &moved.decenter[1].value);
    const size_t row = derivative_row(&test.layout, (struct parameter){2, PARAMETER_CONIC, 0});
    for (int i = 0; i < OUTPUTS; i++) {
        CHECK_NEAR(test.gradient[i][row * RAYS_BLOCK + 3], 0, 1e-18, "by k of what bends nothing");
    }
    arena_free(&test.arena);
}

int main(void)
{
    static const char *const lenses[] = {
        "surface 50 6 1.6 -\nsurface -80 3 air -\nsurface -40 2 1.7 -\nstop - 5 air -\n"
        "surface 70 4 1.5 -\nsurface -35 0 air -\n",
        "medium 1.33\nsurface 40 6 1.6 - k=-0.7\nsurface - 3 1.2 -\n"
        "surface -60 5 1.8 - k=2 A4=1e-5 A6=-2e-8 A8=1e-11\nsurface 90 0 1.1 - A2=0.001\n",
        "surface 60 -30 mirror - k=-1\nsurface 200 35 mirror - A4=1e-7\nsurface 50 3 1.5 -\n",
        "surface 50 6 1.6 - decenter=0.5,-0.3 tilt=3,-2\nbend decenter=0.2,0.1 tilt=4,-3,10\n"
        "surface -80 3 air - cyl=x\nsurface -70 2 1.5 - cyl=y k=-2 A4=1e-6\n",
        "surface 50 6 1.6 -\nsurface - 3 1.2 - tilt=2,1\nsurface -60 5 1.8 - tilt=-3,4\n",
        /* no ray hits a vertex, where odd powers have no second derivative */
        "surface 50 6 1.6 - k=-0.7 A3=2e-4 A4=-1e-5 A5=1e-6 decenter=0.7,-0.3\n"
        "surface - 3 1.2 - A3=-1e-4 decenter=-0.4,0.8 tilt=2,1\n"
        "surface -60 5 1.8 - A7=-2e-9 A8=1e-11 decenter=0.3,0.2\n"
        "surface 90 0 1.1 - cyl=x A3=1e-4 decenter=-0.5,0.6\n",
        "surface -300 -20 mirror - k=-1 A3=2e-5 decenter=0.3,0.7\n"
        "surface 400 25 mirror - A5=1e-7 decenter=0.6,0.4\n"
        "surface 50 3 1.5 - A1=0.01 A9=1e-12 decenter=4.5,-3.5\n",
    };
    if (sizeof(real) == sizeof(double)) {
        printf("derivatives: skipped, no number has more than 53 bits\n");
        return check_report();
    }
    for (size_t i = 0; i < sizeof lenses / sizeof lenses[0]; i++) {
        static struct under_test test;
        CHECK(set_up(&test, lenses[i], false));
        sweep(&test, SET_SSE2);
        size_t bytes = test.layout.rows * RAYS_BLOCK * sizeof(double);
        for (enum instruction_set set = SET_AVX2; set <= SET_AVX512; set++) {
            if (instruction_set_works(set)) {
                double *first[OUTPUTS];
                memcpy(first, test.gradient, sizeof first);
                sweep(&test, set);
                for (int output = 0; output < OUTPUTS; output++) {
                    CHECK(memcmp(first[output], test.gradient[output], bytes) == 0);
                }
            }
        }
        for (size_t s = 0; s < test.lens.surface_count; s++) {
            check_surface(&test, s);
            if (s > 0 && s + 1 < test.lens.surface_count) {
                check_shift(&test, s);
            }
        }
        check_start(&test);
        check_forward(&test, SET_SSE2);
        check_forward(&test, SET_BEST);
        check_forward_start(&test);
        check_lost(&test);
        printf("derivatives: worst error %.2g of scale\n", test.worst);
        arena_free(&test.arena);
    }
    for (size_t i = 0; i < sizeof lenses / sizeof lenses[0]; i++) {
        static struct under_test test;
        CHECK(set_up(&test, lenses[i], true));
        sweep(&test, SET_BEST);
        for (size_t s = 0; s < test.lens.surface_count; s++) {
            check_surface(&test, s);
            if (s > 0 && s + 1 < test.lens.surface_count) {
                check_shift(&test, s);
            }
        }
        check_start(&test);
        check_forward(&test, SET_BEST);
        check_forward_start(&test);
        printf("derivatives of light that goes back: worst error %.2g of scale\n", test.worst);
        arena_free(&test.arena);
    }
    test_flat();
    return check_report();
}
