/* tests/stress/family_merit.c - residuals of rays and their derivatives, of random lenses. */
/* SPDX-License-Identifier: MIT */
#include "stress.h"

#include "../unit/merit_rays_check.h"

#include <stdarg.h>
#include <stdlib.h>

/*
 * Lenses of two to five elements, with aspheres, tilts, a mirror or positions, by everything that
 * can vary, aimed at the stop and at the entrance pupil, with every kind of aperture, field and
 * image plane, against 113 bits.
 */
struct writing {
    struct trial *trial;
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

static void put_name(struct writing *writing, const char *what)
{
    writing->named +=
        (size_t)snprintf(writing->names + writing->named, sizeof writing->names - writing->named,
                         "%s%s%d", writing->named > 0 ? " " : "", what, writing->surface);
}

/* A surface; what of it varies. */
static void put_surface(struct writing *writing, double thickness, const char *medium)
{
    const double R =
        trial_between(writing->trial, 40, 200) * (trial_chance(writing->trial, 0.5) ? 1 : -1);
    const bool curved = trial_chance(writing->trial, 0.5);
    put(writing, "surface %.4g %.4g %s -", R, thickness, medium);
    writing->surface++;
    if (trial_chance(writing->trial, 0.3)) {
        put(writing, " k=%.3g A4=%.3g", trial_between(writing->trial, -2, 1),
            trial_between(writing->trial, -1e-6, 1e-6));
        put_name(writing, "k");
        put_name(writing, "A4_");
    }
    if (trial_chance(writing->trial, 0.15)) {
        put(writing, " tilt=%.3g,%.3g decenter=%.3g,%.3g", trial_between(writing->trial, -1, 1),
            trial_between(writing->trial, -1, 1), trial_between(writing->trial, -0.3, 0.3),
            trial_between(writing->trial, -0.3, 0.3));
        put_name(writing, trial_chance(writing->trial, 0.5) ? "tilt_x" : "decenter_y");
    }
    put(writing, "\n");
    put_name(writing, curved ? "c" : "R");
    if (trial_chance(writing->trial, 0.2)) {
        static const char *const ways[] = {"decenter_x",      "decenter_y",  "tilt_x",
                                           "tilt_y",          "bend_tilt_x", "bend_tilt_y",
                                           "bend_decenter_x", "tilt_z"};
        put_name(writing, ways[(size_t)trial_between(writing->trial, 0, 7.999)]);
    }
}

static void put_element(struct writing *writing, bool zooms, int number)
{
    char medium[40];
    const bool is_model = trial_chance(writing->trial, 0.7);
    if (is_model) { /* about the line of the glasses */
        const double share = trial_draw(writing->trial);
        snprintf(medium, sizeof medium, "%.4g/%.3g",
                 1.5 + 0.25 * share + trial_between(writing->trial, 0, 0.04), 64 - 35 * share);
    } else {
        snprintf(medium, sizeof medium, "%.4g", trial_between(writing->trial, 1.48, 1.8));
    }
    put_surface(writing, trial_between(writing->trial, 2, 6), medium);
    put_name(writing, "n");
    if (is_model) {
        put_name(writing, "V");
    }
    put_name(writing, "t");
    if (zooms) {
        char gap[20];
        snprintf(gap, sizeof gap, "d%d", number);
        put(writing, "surface %.4g %s air -\n",
            trial_between(writing->trial, 40, 200) * (trial_chance(writing->trial, 0.5) ? 1 : -1),
            gap);
        writing->surface++;
        put_name(writing, "R");
    } else {
        put_surface(writing, trial_between(writing->trial, 1, 6), "air");
        put_name(writing, "t");
    }
}

static void put_head(struct writing *writing, bool zooms, int elements)
{
    const bool near = trial_chance(writing->trial, 0.3), image = trial_chance(writing->trial, 0.3);
    put(writing, "wavelength d F\n");
    if (near) {
        put(writing, "object %.4g\n", trial_between(writing->trial, 200, 900));
    }
    put(writing, "field %s 0 %.3g\n",
        image  ? "image"
        : near ? "height"
               : "angle",
        trial_between(writing->trial, 1, 6));
    if (near && trial_chance(writing->trial, 0.4)) {
        put(writing, "aperture na %.3g\n", trial_between(writing->trial, 0.003, 0.01));
    } else {
        const double kind = trial_between(writing->trial, 0, 3);
        put(writing, "aperture ");
        if (kind < 1) {
            put(writing, "f/%.3g\n", trial_between(writing->trial, 8, 20));
        } else if (kind < 2) {
            put(writing, "epd %.3g\n", trial_between(writing->trial, 4, 8));
        } else {
            put(writing, "stop\n");
        }
    }
    put(writing, "focus %s\n", trial_chance(writing->trial, 0.5) ? "table" : "paraxial");
    if (zooms) {
        put(writing, "position wide tele\n");
        for (int i = 0; i < elements; i++) {
            put(writing, "let d%d %.3g %.3g\n", i, trial_between(writing->trial, 1, 8),
                trial_between(writing->trial, 1, 8));
        }
    }
}

static void write_lens(struct writing *writing)
{
    const int elements = (int)trial_between(writing->trial, 2, 5.99),
              stop = (int)trial_between(writing->trial, 0, elements);
    const bool zooms = trial_chance(writing->trial, 0.2),
               mirrors = !zooms && trial_chance(writing->trial, 0.2);
    *writing = (struct writing){.trial = writing->trial};
    put_head(writing, zooms, elements);
    for (int i = 0; i < elements; i++) {
        if (i == stop) {
            put(writing, "stop - %.3g air %.3g\n", trial_between(writing->trial, 1, 4),
                trial_between(writing->trial, 4, 8));
            writing->surface++;
        }
        put_element(writing, zooms, i);
    }
    if (mirrors) { /* there and back */
        put(writing, "surface %.4g %.4g mirror -\n", trial_between(writing->trial, -900, -300),
            -trial_between(writing->trial, 20, 30));
        writing->surface++;
        put_name(writing, "R");
        put(writing, "surface %.4g %.4g mirror -\n", trial_between(writing->trial, -900, -300),
            trial_between(writing->trial, 40, 60));
        writing->surface++;
        put_name(writing, "k");
        return;
    }
    /* the last gap is that to the image */
    put(writing, "surface %.4g %.4g air -\n", trial_between(writing->trial, -300, -60),
        trial_between(writing->trial, 60, 120));
    writing->surface++;
    put_name(writing, "R");
    put_name(writing, "t");
}

void try_merit(struct trial *trial)
{
    static struct under_test test;
    static struct writing writing;
    static const enum operand_kind kinds[] = {OPERAND_SPOT, OPERAND_POLY, OPERAND_OPD};
    const struct merit_question question = {.fnumber = (double)NAN,
                                            .from_entrance = trial_chance(trial, 0.4),
                                            .pattern = PATTERN_GAUSS,
                                            .rays = 3};
    struct error error = {0};
    writing.trial = trial;
    write_lens(&writing);
    char *text = arena_array(&trial->arena, writing.length + writing.named + 40, 1);
    sprintf(text, "%svary %s, %s\n", writing.text, writing.names,
            question.from_entrance ? "entrance" : "stop");
    trial->about = text;
    const int failed = checks_failed;
    const bool judged = open_test(&test, writing.text, writing.names, &question,
                                  kinds[trial_whole(trial, 0, 2)], &error) &&
                        check_all(&test);
    if (judged || checks_failed > failed) {
        trial_verdict(trial, checks_failed == failed, "%d checks", checks_failed - failed);
    } else {
        trial_skip(trial); /* rays that are lost, or no image */
    }
    arena_free(&test.arena);
}
