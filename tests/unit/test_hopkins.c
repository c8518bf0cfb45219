/* tests/unit/test_hopkins.c - contrast by overlap: round pupils, defocus, rings, off the axis. */
/* SPDX-License-Identifier: MIT */
#include "analysis/hopkins.h"

#include "base/constants.h"
#include "base/fft.h"
#include "base/turns.h"
#include "check.h"
#include "file/lens_file.h"

#include <math.h>

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
    const double shift = share * (range[1] - range[0]);
    struct overlap sum = overlap_find(&fixture->pupil, &lines, overlap_rules_new(&fixture->arena),
                                      shift, 1e-7, &fixture->arena);
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
 * is as fine as cells partly clear make it.
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

int main(void)
{
    test_transform();
    test_round();
    test_defocus();
    return check_report();
}
