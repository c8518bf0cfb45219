/* tests/stress/stress_merit.c - residuals of rays and their derivatives, of random lenses. */
/* SPDX-License-Identifier: MIT */
#include "../unit/merit_rays_check.h"

#include <stdarg.h>
#include <stdlib.h>
#include <time.h>

/*
 * stress_merit SECONDS SEED: lenses of two to five elements, with aspheres, tilts, a mirror or
 * positions, by everything that can vary, aimed at the stop and at the entrance pupil, with every
 * kind of aperture, field and image plane, against 113 bits.
 */
static unsigned long long state;

/* 0 .. 1 (splitmix64) */
static double draw(void)
{
    state += 0x9e3779b97f4a7c15u;
    unsigned long long z = state;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (double)((z ^ (z >> 31)) >> 11) / 9007199254740992.0;
}

static double between(double low, double high)
{
    return low + (high - low) * draw();
}

static bool chance(double share)
{
    return draw() < share;
}

struct writing {
    char text[4000], names[1000];
    size_t length, named;
    int surface;
};

static void __attribute__((format(printf, 2, 3)))
put(struct writing *writing, const char *form, ...)
{
    va_list list;
    va_start(list, form);
    writing->length += (size_t)vsnprintf(writing->text + writing->length,
                                         sizeof writing->text - writing->length, form, list);
    va_end(list);
}

static void name(struct writing *writing, const char *what)
{
    writing->named +=
        (size_t)snprintf(writing->names + writing->named, sizeof writing->names - writing->named,
                         "%s%s%d", writing->named > 0 ? " " : "", what, writing->surface);
}

/* A surface; what of it varies. */
static void put_surface(struct writing *writing, double thickness, const char *medium)
{
    const double R = between(40, 200) * (chance(0.5) ? 1 : -1);
    const bool curved = chance(0.5);
    put(writing, "surface %.4g %.4g %s -", R, thickness, medium);
    writing->surface++;
    if (chance(0.3)) {
        put(writing, " k=%.3g A4=%.3g", between(-2, 1), between(-1e-6, 1e-6));
        name(writing, "k");
        name(writing, "A4_");
    }
    if (chance(0.15)) {
        put(writing, " tilt=%.3g,%.3g decenter=%.3g,%.3g", between(-1, 1), between(-1, 1),
            between(-0.3, 0.3), between(-0.3, 0.3));
        name(writing, chance(0.5) ? "tilt_x" : "decenter_y");
    }
    put(writing, "\n");
    name(writing, curved ? "c" : "R");
    if (chance(0.2)) {
        static const char *const ways[] = {"decenter_x",      "decenter_y",  "tilt_x",
                                           "tilt_y",          "bend_tilt_x", "bend_tilt_y",
                                           "bend_decenter_x", "tilt_z"};
        name(writing, ways[(size_t)between(0, 7.999)]);
    }
}

static void put_element(struct writing *writing, bool zooms, int number)
{
    char medium[40];
    const bool is_model = chance(0.7);
    if (is_model) { /* about the line of the glasses */
        const double share = draw();
        snprintf(medium, sizeof medium, "%.4g/%.3g", 1.5 + 0.25 * share + between(0, 0.04),
                 64 - 35 * share);
    } else {
        snprintf(medium, sizeof medium, "%.4g", between(1.48, 1.8));
    }
    put_surface(writing, between(2, 6), medium);
    name(writing, "n");
    if (is_model) {
        name(writing, "V");
    }
    name(writing, "t");
    if (zooms) {
        char gap[20];
        snprintf(gap, sizeof gap, "d%d", number);
        put(writing, "surface %.4g %s air -\n", between(40, 200) * (chance(0.5) ? 1 : -1), gap);
        writing->surface++;
        name(writing, "R");
    } else {
        put_surface(writing, between(1, 6), "air");
        name(writing, "t");
    }
}

static void put_head(struct writing *writing, bool zooms, int elements)
{
    const bool near = chance(0.3), image = chance(0.3);
    put(writing, "wavelength d F\n");
    if (near) {
        put(writing, "object %.4g\n", between(200, 900));
    }
    put(writing, "field %s 0 %.3g\n", image ? "image" : near ? "height" : "angle", between(1, 6));
    if (near && chance(0.4)) {
        put(writing, "aperture na %.3g\n", between(0.003, 0.01));
    } else {
        const double kind = between(0, 3);
        put(writing, "aperture ");
        if (kind < 1) {
            put(writing, "f/%.3g\n", between(8, 20));
        } else if (kind < 2) {
            put(writing, "epd %.3g\n", between(4, 8));
        } else {
            put(writing, "stop\n");
        }
    }
    put(writing, "focus %s\n", chance(0.5) ? "table" : "paraxial");
    if (zooms) {
        put(writing, "position wide tele\n");
        for (int i = 0; i < elements; i++) {
            put(writing, "let d%d %.3g %.3g\n", i, between(1, 8), between(1, 8));
        }
    }
}

static void write_lens(struct writing *writing)
{
    const int elements = (int)between(2, 5.99), stop = (int)between(0, elements);
    const bool zooms = chance(0.2), mirrors = !zooms && chance(0.2);
    *writing = (struct writing){.length = 0};
    put_head(writing, zooms, elements);
    for (int i = 0; i < elements; i++) {
        if (i == stop) {
            put(writing, "stop - %.3g air %.3g\n", between(1, 4), between(4, 8));
            writing->surface++;
        }
        put_element(writing, zooms, i);
    }
    if (mirrors) { /* there and back */
        put(writing, "surface %.4g %.4g mirror -\n", between(-900, -300), -between(20, 30));
        writing->surface++;
        name(writing, "R");
        put(writing, "surface %.4g %.4g mirror -\n", between(-900, -300), between(40, 60));
        writing->surface++;
        name(writing, "k");
        return;
    }
    /* the last gap is that to the image */
    put(writing, "surface %.4g %.4g air -\n", between(-300, -60), between(60, 120));
    writing->surface++;
    name(writing, "R");
    name(writing, "t");
}

/* One lens: was it judged? */
static bool try_lens(double *worst)
{
    static struct under_test test;
    static struct writing writing;
    static const enum operand_kind kinds[] = {OPERAND_SPOT, OPERAND_POLY, OPERAND_OPD};
    const struct merit_question question = {
        .fnumber = NAN, .from_entrance = chance(0.4), .pattern = PATTERN_GAUSS, .rays = 3};
    struct error error = {0};
    write_lens(&writing);
    const int failed = checks_failed;
    const bool judged = open_test(&test, writing.text, writing.names, &question,
                                  kinds[(size_t)between(0, 2.999)], &error) &&
                        check_all(&test);
    if (judged) {
        *worst = fmax(*worst, test.worst);
    }
    if (checks_failed > failed) {
        printf("%svary %s, %s\n", writing.text, writing.names,
               question.from_entrance ? "entrance" : "stop");
    }
    arena_free(&test.arena);
    return judged;
}

int main(int count, char **words)
{
    const double seconds = count > 1 ? atof(words[1]) : 10;
    const time_t end = time(NULL) + (time_t)seconds;
    long lenses = 0, tried = 0;
    double worst = 0;
    state = count > 2 ? strtoull(words[2], NULL, 10) : 1;
    while (time(NULL) < end) {
        tried++;
        lenses += try_lens(&worst);
    }
    printf("operands of rays: %ld lenses of %ld, worst error of a derivative %.2g of scale\n",
           lenses, tried, worst);
    CHECK(4 * lenses > tried); /* others have rays that are lost, or no image */
    return check_report();
}
