/* tests/unit/test_hopkins.c - contrast by overlap: round pupils, Zernike's terms, grids. */
/* SPDX-License-Identifier: MIT */
#include "analysis/waves/hopkins.h"

#include "analysis/waves/zernike.h"
#include "base/constants.h"
#include "base/fft.h"
#include "base/turns.h"
#include "check.h"
#include "file/lens_file.h"
#include "trace/aim/sample.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A paraboloid of f = 100 with its stop, so slow that its pupil is even to 1e-7. */
#define MIRROR "wavelength d\nobject inf\naperture stop\nsurface -200 -100 mirror 0.2 k=-1 stop\n"
static const double wavelength = 587.5618e-6, radius = 0.1, focus = 100;

/* A made-ready pupil. */
struct fixture {
    struct arena arena;
    struct lens lens;
    struct setup setup;
    struct field_point field;
    struct exit_pupils pupils;
    struct exit_pupil pupil;
};

static bool open_fixture(const char *text, double image, double angle, struct fixture *fixture)
{
    struct error error = {0};
    struct arena *arena = &fixture->arena;
    const struct setup_question question = {.lens = &fixture->lens,
                                            .wavelength = NAN,
                                            .fnumber = NAN,
                                            .wavelengths = WAVELENGTHS_PRIMARY};
    const struct plane_value plane = {PLANE_AT, image};
    fixture->field = (struct field_point){FIELD_ANGLE, {0, angle}};
    const struct bundle_question bundle = {
        .setup = &fixture->setup, .field = &fixture->field, .clip = true};
    const bool opened = lens_read("test", text_of(text), NULL, arena, &fixture->lens, &error) &&
                        setup_open(&question, arena, &fixture->setup, &error) &&
                        setup_place_image(&fixture->setup, &plane, &error) &&
                        exit_pupils_open(&bundle, arena, &fixture->pupils, &error);
    if (!opened) {
        printf("%s\n", error.message);
    }
    CHECK(opened);
    if (opened) {
        fixture->pupil = fixture->pupils.list[0];
    }
    return opened;
}

/* Contrast along a direction at a shift in units of the pupil's width. */
static struct overlap contrast(struct fixture *fixture, double x, double y, double share)
{
    const double along[2] = {x, y};
    struct exit_lines lines;
    exit_lines_find(&fixture->pupil, along, &fixture->arena, &lines);
    double range[2];
    exit_pupil_range(&fixture->pupil, along, range);
    struct exit_front front;
    exit_front_find(&fixture->pupil, &lines, 1e-7, &fixture->arena, &front);
    struct overlap sum = overlap_find(&front, gauss_rules_new(&fixture->arena),
                                      share * (range[1] - range[0]), 1e-7, false);
    sum.re /= fixture->pupil.energy;
    sum.im /= fixture->pupil.energy;
    sum.perfect /= fixture->pupil.energy;
    return sum;
}

/* (2/pi)(acos s - s sqrt(1 - s^2)) */
static void test_round(void)
{
    struct fixture fixture = {0};
    if (open_fixture(MIRROR, -100, 0, &fixture)) {
        CHECK_RELATIVE(fixture.pupil.half[0], radius / focus, 1e-5, "sine of the cone");
        for (double s = 0; s < 1; s += 0.09) {
            const double exact = 2 / PI * (acos(s) - s * sqrt(1 - s * s));
            const struct overlap across = contrast(&fixture, 1, 0, s);
            const struct overlap askew = contrast(&fixture, 0.6, 0.8, s);
            CHECK_NEAR(across.re, exact, 1e-6, "round pupil");
            CHECK_NEAR(across.im, 0, 1e-8, "its phase");
            CHECK_NEAR(askew.re, exact, 1e-6, "askew");
        }
        CHECK_NEAR(contrast(&fixture, 1, 0, 1.02).re, 0, 1e-9, "beyond the cut-off");
    }
    arena_free(&fixture.arena);
}

/* The plane off focus by so much that the rim is off by `waves`: an integral over the overlap. */
static double defocused(double waves, double s)
{
    enum { STEPS = 20000 };
    double sum = 0;
    for (int i = 0; i < STEPS; i++) {
        const double x = (1 - s) * (2 * (i + 0.5) / STEPS - 1);
        const double y = sqrt(1 - (fabs(x) + s) * (fabs(x) + s));
        sum += 2 * y * cos(8 * PI * waves * s * x) * 2 * (1 - s) / STEPS;
    }
    return sum / PI;
}

static void test_defocus(void)
{
    for (double waves = 0.5; waves < 5; waves += 1.5) {
        struct fixture fixture = {0};
        const double off = waves * wavelength * 2 * focus * focus / (radius * radius);
        if (open_fixture(MIRROR, -100 - off, 0, &fixture)) {
            for (double s = 0.05; s < 1; s += 0.15) {
                const double here = contrast(&fixture, 0, 1, s).re;
                /* a millimetre of defocus moves the cone by a part in a thousand */
                CHECK_NEAR(here, defocused(waves * focus / (focus + off), s), 3e-4, "defocus");
            }
        }
        arena_free(&fixture.arena);
    }
}

/*
 * The same of a grid by Fourier transforms: light of the image, and of that its transform. Its edge
 * is as fine as cells partly clear make it, which is why it meets the overlap to 3e-4 only.
 */
static void test_transform(void)
{
    enum { SIDE = 256, FINE = 5, ACROSS = SIDE / 2 };
    struct fixture fixture = {0};
    const double off = 1.3 * wavelength * 2 * focus * focus / (radius * radius);
    if (!open_fixture(MIRROR, -100 - off, 0, &fixture)) {
        return;
    }
    struct arena *arena = &fixture.arena;
    const struct exit_pupil *pupil = &fixture.pupil;
    const double step = 2 * pupil->half[0] / (ACROSS - 2);
    double *re = ARENA_ARRAY(arena, SIDE * SIDE, double);
    double *im = ARENA_ARRAY(arena, SIDE * SIDE, double);
    for (size_t i = 0; i < (size_t)SIDE * SIDE; i++) {
        double at[1][2] = {{0}}, wave, amplitude, c, s;
        const double x = (double)(i % SIDE) - ACROSS / 2, y = (double)(i / SIDE) - ACROSS / 2;
        size_t limit, clear = 0;
        re[i] = im[i] = 0;
        if (!(hypot(x, y) < ACROSS / 2 + 2)) {
            continue;
        }
        const bool inside = hypot(x, y) < ACROSS / 2 - 4;
        for (size_t k = 0; k < (size_t)FINE * FINE && !inside; k++) {
            at[0][0] = pupil->middle[0] + step * (x + ((double)(k % FINE) + 0.5) / FINE - 0.5);
            at[0][1] = pupil->middle[1] + step * (y + ((double)(k / FINE) + 0.5) / FINE - 0.5);
            exit_pupil_look(pupil, (const double(*)[2])at, 1, &limit);
            clear += limit == EXIT_PUPIL_CLEAR;
        }
        at[0][0] = pupil->middle[0] + step * x;
        at[0][1] = pupil->middle[1] + step * y;
        exit_pupil_values(pupil, (const double(*)[2])at, 1, &wave, &amplitude);
        turns_of(wave, &c, &s);
        amplitude *= inside ? 1 : (double)clear / (FINE * FINE);
        re[i] = amplitude * c;
        im[i] = amplitude * s;
    }
    const struct fft fft = fft_open(SIDE, arena);
    fft_plane(&fft, false, re, im, arena);
    for (size_t i = 0; i < (size_t)SIDE * SIDE; i++) {
        re[i] = re[i] * re[i] + im[i] * im[i];
        im[i] = 0;
    }
    fft_plane(&fft, true, re, im, arena);
    for (size_t k = 6; k < ACROSS; k += 12) {
        const double share = (double)k * step / (2 * pupil->half[0]);
        const double here = contrast(&fixture, 1, 0, share).re;
        CHECK_NEAR(re[k] / (SIDE * SIDE) * step * step / pupil->energy, here, 3e-4, "by transform");
    }
    arena_free(arena);
}

/* -------- Zernike's terms -------- */

enum { TERM_ORDER = 8, TERM_COUNT = 45, TERM_POINTS = 120 };
static const double term_waves = 0.3; /* each, times its norm */

/* One of them by powers, which are exact enough at order 8. */
struct shape {
    int m;
    size_t count;
    double powers[TERM_ORDER / 2 + 1]; /* of r^2, beside r^|m| */
};

/* Its norm is sqrt(n + 1) or sqrt(2(n + 1)). */
static struct shape shape_of(const struct zernike_term *term)
{
    const int m = abs(term->m), half = (term->n - m) / 2;
    struct shape shape = {term->m, (size_t)half + 1, {0}};
    for (int k = 0; k <= half; k++) {
        const double below = tgamma(k + 1) * tgamma(half + m - k + 1) * tgamma(half - k + 1);
        shape.powers[half - k] = term_waves * sqrt(m == 0 ? term->n + 1 : 2 * (term->n + 1)) *
                                 (k % 2 == 0 ? 1 : -1) * tgamma(term->n - k + 1) / below;
    }
    return shape;
}

static double shape_value(const struct shape *shape, double x, double y)
{
    double sum = 0, re = 1, im = 0;
    for (size_t i = shape->count; i-- > 0;) {
        sum = sum * (x * x + y * y) + shape->powers[i];
    }
    for (int k = 0; k < abs(shape->m); k++) {
        const double before = re;
        re = re * x - im * y;
        im = before * y + im * x;
    }
    return sum * (shape->m < 0 ? im : re);
}

/* Give a pupil that wave front, exactly: powers of r^2 by nodes as Chebyshev's polynomials. */
static void set_term(struct exit_pupil *pupil, const struct shape *term)
{
    enum { NODES = 24 };
    const double reach = pupil->scale[0] / pupil->half[0];
    memset(pupil->form[0], 0, pupil->terms.terms * sizeof(double));
    for (size_t m = 0, first = 0; m < pupil->terms.orders; m++) {
        for (int sine = 0; sine < (m > 0 ? 2 : 1); first += pupil->terms.radial[m], sine++) {
            for (size_t j = 0; j < pupil->terms.radial[m]; j++) {
                for (int k = 0; k < NODES && term->m == (sine == 1 ? -(int)m : (int)m); k++) {
                    const double u = PI * (k + 0.5) / NODES, q = (1 + cos(u)) / 2 * reach * reach;
                    double sum = 0;
                    for (size_t i = term->count; i-- > 0;) {
                        sum = sum * q + term->powers[i];
                    }
                    pupil->form[0][first + j] +=
                        sum * pow(reach, (double)m) * cos((double)j * u) * (j > 0 ? 2 : 1) / NODES;
                }
            }
        }
    }
    pupil->off_waves = 0;
    /* at one place no term is 0: it stays or turns its sign on the other side of a mirror */
    const double here = shape_value(term, 0.31, 0.47);
    pupil->is_mirrored[0] = fabs(shape_value(term, -0.31, 0.47) - here) < 1e-9;
    pupil->is_mirrored[1] = fabs(shape_value(term, 0.31, -0.47) - here) < 1e-9;
}

/* The overlap of two discs of radius 1 at x = -shift/2 and shift/2, or y, by Gauss's rule. */
static void sum_term(const struct shape *term, bool upwards, double shift, size_t points,
                     double sum[2])
{
    double nodes[TERM_POINTS], weights[TERM_POINTS];
    const double high = sqrt(1 - shift * shift / 4);
    gauss_rule(points, nodes, weights);
    sum[0] = sum[1] = 0;
    for (size_t i = 0; i < points * points; i++) {
        const double angle = PI * (nodes[i % points] - 0.5), t = high * sin(angle);
        const double length = sqrt(1 - t * t) - shift / 2;
        const double s = length * (2 * nodes[i / points] - 1), a = s - shift / 2, b = s + shift / 2;
        const double turn = 2 * PI *
                            (upwards ? shape_value(term, t, a) - shape_value(term, t, b)
                                     : shape_value(term, a, t) - shape_value(term, b, t));
        const double weight =
            weights[i % points] * weights[i / points] * PI * high * cos(angle) * 2 * length / PI;
        sum[0] += weight * cos(turn);
        sum[1] += weight * sin(turn);
    }
}

/* As many points as make no difference any more. */
static void expect_term(const struct shape *term, bool upwards, double shift, double sum[2])
{
    double before[2] = {NAN, NAN};
    sum_term(term, upwards, shift, 24, sum);
    for (size_t points = 40;
         points <= TERM_POINTS && !(hypot(sum[0] - before[0], sum[1] - before[1]) < 5e-7);
         points += 16) {
        before[0] = sum[0], before[1] = sum[1];
        sum_term(term, upwards, shift, points, sum);
    }
    CHECK_NEAR(hypot(sum[0] - before[0], sum[1] - before[1]), 0, 5e-7, "points enough");
}

static void test_terms(void)
{
    struct fixture fixture = {0};
    if (!open_fixture(MIRROR, -100, 0, &fixture)) {
        return;
    }
    for (size_t j = 1; j < TERM_COUNT; j++) {
        const struct zernike_term named = zernike_term(ZERNIKE_NOLL, j);
        const struct shape term = shape_of(&named);
        set_term(&fixture.pupil, &term);
        for (int k = 0; k < 4; k++) {
            const double share = k < 2 ? 0.12 : 0.45;
            double expected[2];
            expect_term(&term, k % 2 == 1, 2 * share, expected);
            /* the second place counts from the first: W1 - W2, 1 at half the shift against it */
            const struct overlap here = contrast(&fixture, k % 2 == 0, k % 2 == 1, share);
            CHECK_NEAR(here.re, expected[0], 2e-6, "real part");
            CHECK_NEAR(here.im, expected[1], 2e-6, "imaginary part");
        }
    }
    arena_free(&fixture.arena);
}

/*
 * Any function on a grid: the transform of the light of its image is its overlap with itself, to
 * rounding, where a grid is all there is.
 */
static void test_grid(void)
{
    enum { SIDE = 64, ACROSS = 30 };
    struct arena arena = {0};
    double *re = ARENA_ARRAY(&arena, SIDE * SIDE, double),
           *f = ARENA_ARRAY(&arena, SIDE * SIDE, double);
    double *im = ARENA_ARRAY(&arena, SIDE * SIDE, double),
           *g = ARENA_ARRAY(&arena, SIDE * SIDE, double);
    for (int i = 0; i < SIDE * SIDE; i++) {
        const double x = (i % SIDE - 14.5) / 15, y = (i / SIDE - 14.5) / 15;
        const double turn = 2 * PI * (0.8 * x * x * y - 0.6 * x * x + 1.1 * y * y * y + 0.4 * x);
        const bool inside = x * x + y * y < 1 && i % SIDE < ACROSS && i / SIDE < ACROSS;
        re[i] = f[i] = inside ? (1 + 0.3 * x) * cos(turn) : 0;
        im[i] = g[i] = inside ? (1 + 0.3 * x) * sin(turn) : 0;
    }
    const struct fft fft = fft_open(SIDE, &arena);
    fft_plane(&fft, false, re, im, &arena);
    for (int i = 0; i < SIDE * SIDE; i++) {
        re[i] = re[i] * re[i] + im[i] * im[i];
        im[i] = 0;
    }
    fft_plane(&fft, true, re, im, &arena);
    for (int shift = 0; shift < ACROSS; shift++) {
        double along[2] = {0}, up[2] = {0};
        for (int i = 0; i < SIDE * (SIDE - ACROSS); i++) {
            const int a = i + shift, b = i + shift * SIDE;
            along[0] += f[a] * f[i] + g[a] * g[i], along[1] += g[a] * f[i] - f[a] * g[i];
            up[0] += f[b] * f[i] + g[b] * g[i], up[1] += g[b] * f[i] - f[b] * g[i];
        }
        CHECK_NEAR(re[shift] / (SIDE * SIDE), along[0], 1e-10, "along, real");
        CHECK_NEAR(im[shift] / (SIDE * SIDE), along[1], 1e-10, "along, imaginary");
        CHECK_NEAR(re[shift * SIDE] / (SIDE * SIDE), up[0], 1e-10, "up, real");
        CHECK_NEAR(im[shift * SIDE] / (SIDE * SIDE), up[1], 1e-10, "up, imaginary");
    }
    arena_free(&arena);
}

int main(void)
{
    test_grid();
    test_terms();
    test_transform();
    test_round();
    test_defocus();
    return check_report();
}
